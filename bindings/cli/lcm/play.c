/* SPDX-License-Identifier: MIT
 * play.c: a log of LCM, published again as it was recorded. */
#include "play.h"

#include "../interrupt.h"
#include "bus.h"
#include "../log_file.h"
#include "../pace.h"
#include "../say.h"
#include "../stats.h"

#include <fnmatch.h>
#include <inttypes.h>
#include <stdio.h>
#include <unistd.h>

#define SHOW_NS 100000000u
/* Messages sent without a pause, as the sink does it by itself: more would run over the buffer that a listener has as a
 * rule. */
#define BURST 64
#define BURST_PAUSE 0.001 /* s */

struct play {
    struct log_file *log;
    lcm_t *lcm;
    const char *glob;
    struct pace pace;
    int64_t first_us;
    uint64_t sent, failed, bytes;
};

static void show(const struct play *p, double seconds)
{
    fprintf(stderr, "\r%3.0f %%  %.1f s of the recording, %" PRIu64 " messages ",
            100.0 * (double)log_file_position(p->log) / (double)log_file_size(p->log), seconds, p->sent);
}

static void play(struct play *p)
{
    struct log_event event;
    const int shown = isatty(STDERR_FILENO);
    uint64_t next = clock_ns(), count = 0, burst = 0;
    while (!interrupt_came() && log_file_next(p->log, &event)) {
        p->first_us = count++ == 0 ? event.time_us : p->first_us;
        const double time = (double)(event.time_us - p->first_us) * 1e-6;
        if (shown && clock_ns() >= next) {
            next = clock_ns() + SHOW_NS;
            show(p, time);
        }
        if (p->glob != NULL && fnmatch(p->glob, event.channel, 0) != 0) {
            continue;
        }
        burst = pace_wait(&p->pace, time > 0 ? time : 0) ? 0 : burst + 1;
        if (interrupt_came()) {
            break;
        }
        const int failed = lcm_publish(p->lcm, event.channel, event.data, (unsigned)event.size) != 0;
        p->failed += (uint64_t)failed;
        p->sent += (uint64_t)!failed;
        p->bytes += event.size;
        if (burst == BURST) {
            pace_sleep(BURST_PAUSE);
            burst = 0;
        }
    }
    if (shown) {
        fprintf(stderr, "\r%60s\r", "");
    }
}

int play_log(const char *path, const char *url, const char *glob, double speed)
{
    struct play p = {.glob = glob, .pace = {0, speed}};
    p.log = log_file_open(path);
    p.lcm = p.log != NULL ? bus_open_to_speak(url) : NULL;
    if (p.lcm == NULL) {
        log_file_close(p.log);
        return EXIT_USAGE;
    }
    interrupt_watch();
    play(&p);
    lcm_destroy(p.lcm);
    const uint64_t damages = log_file_damages(p.log);
    printf("%s: %" PRIu64 " messages, %.2f MB to %s; %" PRIu64 " could not be published\n", path, p.sent,
           (double)p.bytes / 1e6, bus_url(url), p.failed);
    if (damages > 0) {
        printf("  damaged    the file, in %" PRIu64 " place%s\n", damages, damages == 1 ? "" : "s");
    }
    log_file_close(p.log);
    return p.failed > 0 || damages > 0 ? EXIT_CHECK_FAILED : EXIT_GOOD;
}

/* SPDX-License-Identifier: MIT
 * record.c: `tahr record`. */
#include "record.h"

#include "../argument.h"
#include "../interrupt.h"
#include "bus.h"
#include "roster.h"
#include "../say.h"
#include "../stats.h"

#include <errno.h>
#include <fnmatch.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct recording {
    const char *url, *glob, *path; /* glob: NULL: all channels */
    double seconds;
    lcm_eventlog_t *log;
    uint64_t began, events, bytes;
    int failed; /* errno of a write */
    int shown;  /* 1: progress on a terminal */
    struct roster roster;
};

static void hear(void *user, const lcm_recv_buf_t *raw, const char *channel)
{
    struct recording *r = user;
    struct message message;
    if (r->glob != NULL && fnmatch(r->glob, channel, 0) != 0) {
        return;
    }
    lcm_eventlog_event_t event = {.timestamp = raw->recv_utime,
                                  .channellen = (int32_t)strlen(channel),
                                  .datalen = (int32_t)raw->data_size,
                                  .channel = (char *)channel,
                                  .data = raw->data};
    errno = 0;
    if (lcm_eventlog_write_event(r->log, &event) != 0) {
        r->failed = errno != 0 ? errno : EIO;
        return;
    }
    r->events++;
    r->bytes += 28 + strlen(channel) + raw->data_size; /* 28: the head of an event */
    const enum message_verdict verdict = message_read(&message, channel, raw->data, raw->data_size);
    r->roster.foreign += verdict == MESSAGE_FOREIGN;
    if (verdict == MESSAGE_OURS) {
        roster_hear(&r->roster, &message, channel);
        message_free(&message);
    }
}

static void pause_recording(void *user)
{
    struct recording *r = user;
    if (!r->failed && fflush(r->log->f) != 0) {
        r->failed = errno;
    }
    if (r->shown) {
        fprintf(stderr, "\r%.1f s  %" PRIu64 " messages, %.2f MB, %" PRIu64 " lost ",
                (double)(clock_ns() - r->began) * 1e-9, r->events, (double)r->bytes / 1e6, r->roster.lost);
    }
}

static int is_done(void *user)
{
    return ((const struct recording *)user)->failed != 0;
}

static int record(struct recording *r)
{
    lcm_t *lcm = bus_open_to_hear(r->url);
    if (lcm == NULL) {
        return EXIT_USAGE;
    }
    r->log = lcm_eventlog_create(r->path, "w");
    if (r->log == NULL) {
        say_error("cannot write '%s': %s", r->path, strerror(errno));
        lcm_destroy(lcm);
        return EXIT_USAGE;
    }
    r->began = clock_ns();
    r->shown = isatty(STDERR_FILENO);
    interrupt_watch();
    const struct bus_listener listener = {hear, pause_recording, is_done, r, r->seconds};
    int failed = bus_listen(lcm, &listener);
    lcm_destroy(lcm);
    if (r->shown) {
        fputc('\n', stderr);
    }
    if (r->failed) {
        say_error("'%s': cannot write: %s; what was written before is kept", r->path, strerror(r->failed));
        failed = -1;
    }
    lcm_eventlog_destroy(r->log);
    printf("%s: %" PRIu64 " messages, %.2f MB, %.1f s; of characters %" PRIu64 ", of them lost on the way %" PRIu64
           ", of another package or version %" PRIu64 "\n",
           r->path, r->events, (double)r->bytes / 1e6, (double)(clock_ns() - r->began) * 1e-9, r->roster.messages,
           r->roster.lost, r->roster.foreign);
    roster_close(&r->roster);
    return failed ? EXIT_CHECK_FAILED : EXIT_GOOD;
}

void record_help(void)
{
    puts("usage: tahr record [options] FILE.lcmlog\n"
         "\n"
         "Keeps what is published over LCM as an ordinary LCM event log, for `tahr replay` and lcm-logplayer. Ctrl-C\n"
         "ends it well.\n"
         "\n"
         "  --lcm URL        udpm://ADDRESS:PORT?ttl=N (the environment's LCM_DEFAULT_URL, or else\n"
         "                   udpm://239.255.76.67:7667?ttl=0)\n"
         "  --channel GLOB   only these channels: 'TAHR_*' (all, of others too)\n"
         "  --seconds S      ends after so long\n"
         "\n"
         "Exit code: 0 ended as asked; 1 the file could not be written to its end; 2 wrong usage, no way to listen,\n"
         "or a file that cannot be written.");
}

int record_command(int argc, char **argv)
{
    enum { LCM = 256, CHANNEL, SECONDS, HELP };
    static const struct option known[] = {{"lcm", required_argument, NULL, LCM},
                                          {"channel", required_argument, NULL, CHANNEL},
                                          {"seconds", required_argument, NULL, SECONDS},
                                          {"help", no_argument, NULL, HELP},
                                          {NULL, 0, NULL, 0}};
    struct recording r = {0};
    int option, failed = 0;
    while (!failed && (option = argument_next(argc, argv, known)) != -1) {
        switch (option) {
        case LCM: r.url = optarg; break;
        case CHANNEL: r.glob = optarg; break;
        case SECONDS: failed = argument_number("seconds", optarg, 1e-3, 1e9, &r.seconds); break;
        case HELP: record_help(); return EXIT_GOOD;
        default: failed = -1;
        }
    }
    if (!failed && optind != argc - 1) {
        say_error("record: expected the name of one file; see `tahr record --help`");
        failed = -1;
    }
    if (failed) {
        return EXIT_USAGE;
    }
    r.path = argv[optind];
    return record(&r);
}

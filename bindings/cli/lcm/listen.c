/* SPDX-License-Identifier: MIT
 * listen.c: `tahr listen`. */
#include "listen.h"

#include "../argument.h"
#include "../interrupt.h"
#include "bus.h"
#include "lines.h"
#include "table.h"
#include "../say.h"
#include "../stats.h"

#include <fnmatch.h>
#include <inttypes.h>
#include <stdio.h>
#include <tahr/telemetry.h>
#include <unistd.h>

#define DRAW_NS 200000000u /* between two looks of the table */
#define RATE_NS 1000000000u

struct listening {
    const char *url, *glob; /* glob: NULL: all channels */
    double seconds;
    uint64_t count; /* 0: no end */
    int json, live; /* live: a table */
    struct roster roster;
    struct table table;
    uint64_t drawn, rated, rated_messages; /* when, and how many there were */
    double rate;
};

static void hear(void *user, const lcm_recv_buf_t *raw, const char *channel)
{
    struct listening *l = user;
    struct message message;
    if (l->glob != NULL && fnmatch(l->glob, channel, 0) != 0) {
        return;
    }
    const enum message_verdict verdict = message_read(&message, channel, raw->data, raw->data_size);
    l->roster.foreign += verdict == MESSAGE_FOREIGN;
    if (verdict != MESSAGE_OURS) {
        return;
    }
    l->roster.bytes += raw->data_size;
    if (roster_hear(&l->roster, &message, channel) && !l->live) {
        (l->json ? line_json : line_words)(stdout, channel, &message);
    }
    message_free(&message);
}

static void draw(struct listening *l)
{
    char title[300];
    snprintf(title, sizeof title, "tahr listen --lcm %s (Ctrl-C ends)", l->url);
    l->drawn = clock_ns();
    table_draw(&l->table, &l->roster, title, l->rate);
}

static void pause_listening(void *user)
{
    struct listening *l = user;
    const uint64_t now = clock_ns();
    if (now - l->rated >= RATE_NS) {
        const double seconds = (double)(now - l->rated) * 1e-9;
        l->rate = (double)(l->roster.messages - l->rated_messages) / seconds;
        roster_take_rates(&l->roster, seconds);
        l->rated = now;
        l->rated_messages = l->roster.messages;
    }
    if (!l->live) {
        fflush(stdout);
    } else if (now - l->drawn >= DRAW_NS) {
        draw(l);
    }
}

static int is_done(void *user)
{
    const struct listening *l = user;
    return (l->count > 0 && l->roster.messages >= l->count) || ferror(stdout);
}

/* On standard error: what is listed on the other one may be read by programs. */
static void summarize(const struct listening *l, double seconds)
{
    fprintf(stderr, "tahr: heard %" PRIu64 " messages in %.1f s on %s:", l->roster.messages, seconds, l->url);
    for (uint32_t kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        fprintf(stderr, "%s %" PRIu64 " %s", kind ? "," : "", l->roster.by_kind[kind], tahr_message_name(kind));
    }
    fprintf(stderr, "; %" PRIu64 " lost on the way\n", l->roster.lost);
    for (size_t p = 0; p < l->roster.publisher_count; p++) {
        const struct roster_publisher *publisher = &l->roster.publishers[p];
        if (publisher->dropped > 0 || publisher->failed > 0) {
            say_error("'%s' says that it dropped %" PRId64 " messages itself, and could not publish %" PRId64,
                      publisher->prefix, publisher->dropped, publisher->failed);
        }
    }
    if (l->roster.foreign > 0) {
        say_error("ignored %" PRIu64 " messages of another package or version on channels of ours", l->roster.foreign);
    }
    if (l->roster.strange > 0) {
        say_error("ignored %" PRIu64 " messages of characters that cannot be (expected ids from 0 to 2^20 - 1), or of "
                  "too many publishers",
                  l->roster.strange);
    }
}

static int listen_on(struct listening *l)
{
    l->url = bus_url(l->url);
    lcm_t *lcm = bus_open_to_hear(l->url);
    if (lcm == NULL) {
        return EXIT_USAGE;
    }
    const uint64_t began = clock_ns();
    l->rated = began;
    interrupt_watch();
    const struct bus_listener listener = {hear, pause_listening, is_done, l, l->seconds};
    const int failed = bus_listen(lcm, &listener);
    if (l->live) {
        draw(l);
    }
    fflush(stdout);
    summarize(l, (double)(clock_ns() - began) * 1e-9);
    lcm_destroy(lcm);
    const int enough = l->roster.messages >= l->count;
    if (!enough) {
        say_error("--count %" PRIu64 ": only %" PRIu64 " messages came", l->count, l->roster.messages);
    }
    roster_close(&l->roster);
    return failed || !enough ? EXIT_CHECK_FAILED : EXIT_GOOD;
}

void listen_help(void)
{
    puts("usage: tahr listen [options]\n"
         "\n"
         "Shows what characters do elsewhere while they do it: what `tahr run --lcm`, or a program with the sink of\n"
         "tahr/lcm.h, publishes over LCM. On a terminal a table with a row for each character (floor: m below it,\n"
         "^ too steep to stand on; Hz: messages of it per second; lost: numbers missing in their sequences); else a\n"
         "line for each message. In the end, on standard error, how much was heard and how much lost.\n"
         "\n"
         "  --lcm URL        udpm://ADDRESS:PORT?ttl=N, or file:///PATH of an LCM event log, played back as it was\n"
         "                   recorded (the environment's LCM_DEFAULT_URL, or else udpm://239.255.76.67:7667?ttl=0)\n"
         "  --channel GLOB   only these channels: '*STATE*' (all)\n"
         "  --json           one JSON object for each message, with the fields of the .lcm files\n"
         "  --seconds S      ends after so long\n"
         "  --count N        ends after so many messages\n"
         "\n"
         "Exit code: 0 ended as asked, by Ctrl-C too; 1 fewer than --count messages came; 2 wrong usage, or no way to\n"
         "listen.");
}

int listen_command(int argc, char **argv)
{
    enum { LCM = 256, CHANNEL, JSON, SECONDS, COUNT, HELP };
    static const struct option known[] = {{"lcm", required_argument, NULL, LCM},
                                          {"channel", required_argument, NULL, CHANNEL},
                                          {"json", no_argument, NULL, JSON},
                                          {"seconds", required_argument, NULL, SECONDS},
                                          {"count", required_argument, NULL, COUNT},
                                          {"help", no_argument, NULL, HELP},
                                          {NULL, 0, NULL, 0}};
    struct listening l = {0};
    int option, failed = 0;
    while (!failed && (option = argument_next(argc, argv, known)) != -1) {
        switch (option) {
        case LCM: l.url = optarg; break;
        case CHANNEL: l.glob = optarg; break;
        case JSON: l.json = 1; break;
        case SECONDS: failed = argument_number("seconds", optarg, 1e-3, 1e9, &l.seconds); break;
        case COUNT: failed = argument_whole("count", optarg, 1, INT64_MAX, &l.count); break;
        case HELP: listen_help(); return EXIT_GOOD;
        default: failed = -1;
        }
    }
    if (!failed && optind < argc) {
        say_error("listen: unexpected argument '%s'; a URL is given with --lcm URL", argv[optind]);
        failed = -1;
    }
    l.live = !l.json && isatty(STDOUT_FILENO);
    return failed ? EXIT_USAGE : listen_on(&l);
}

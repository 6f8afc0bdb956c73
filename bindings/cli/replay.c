/* SPDX-License-Identifier: MIT
 * replay.c: `tahr replay`: a trace is repeated; a log of LCM is played, or proven. The first bytes say which it is. */
#include "replay.h"

#include "argument.h"
#include "log_file.h"
#include "options.h"
#include "replay_trace.h"
#include "say.h"

#ifdef TAHR_HAVE_LCM
#include "lcm/play.h"
#include "lcm/verify.h"
#endif

#include <stdio.h>
#include <stdlib.h>

struct asked {
    const char *path, *url, *glob;
    double speed;
    int trace;                /* 1: it must be one */
    int verify, json, played; /* played: what only counts for that was given */
    int level_argc;           /* the options of a level; 1: none */
    char **level_argv;
};

void replay_help(void)
{
    puts(
        "usage: tahr replay [--trace] FILE\n"
        "       tahr replay FILE.lcmlog [--lcm URL] [--speed X] [--channel GLOB]\n"
        "       tahr replay FILE.lcmlog --verify [--json] [--channel GLOB] [--level FILE] [--up y|z] [--2d] ...\n"
        "\n"
        "A trace (of `tahr run --trace FILE`, or of a program that calls tahr_world_record with the recorder of\n"
        "trace.h) is repeated without its collision engine and its level: every query has to be the one that was\n"
        "recorded, and every state the same to the bit.\n"
        "\n"
        "An LCM event log (of `tahr record`, `tahr run --lcm file:///PATH`, lcm-logger) is published again, with the\n"
        "time between its messages:\n"
        "  --lcm URL        udpm://ADDRESS:PORT?ttl=N (the environment's LCM_DEFAULT_URL, or else\n"
        "                   udpm://239.255.76.67:7667?ttl=0)\n"
        "  --speed X        X times as fast; 0: as fast as it goes (1)\n"
        "  --channel GLOB   only these channels (all)\n"
        "\n"
        "  --verify         instead of that every recorded step is taken again, in the level and on the collision\n"
        "                   engine of the recording, and the hash of every state compared, and what the messages of\n"
        "                   states and (but for crowds) events say. The level is opened by the options of `tahr run`:\n"
        "                   --level, --up, --2d, --pixels-per-metre, --tiles; --backend only where it comes from a\n"
        "                   shared object. What was lost on the way to the log is a gap: from there to the next\n"
        "                   snapshot nothing is proven\n"
        "  --json           what was found as JSON: counts of everything, and the first twelve of each kind\n"
        "\n"
        "Exit code: 0 all is equal, or played; 1 a step differs (the first is named), is not proven, or the file is\n"
        "damaged; 2 wrong usage, or a file that is neither.");
}

/* 0: go on; 1: help was asked for and shown; -1: wrong usage, said so. */
static int read_arguments(struct asked *a, int argc, char **argv)
{
    enum { TRACE = 256, LCM, SPEED, CHANNEL, VERIFY, JSON, HELP };
    static const struct option known[] = {
        {"trace", optional_argument, NULL, TRACE}, {"lcm", required_argument, NULL, LCM},
        {"speed", required_argument, NULL, SPEED}, {"channel", required_argument, NULL, CHANNEL},
        {"verify", no_argument, NULL, VERIFY},     {"json", no_argument, NULL, JSON},
        {"help", no_argument, NULL, HELP},         {NULL, 0, NULL, 0}};
    int option, failed = 0;
    while (!failed && (option = argument_next(argc, argv, known)) != -1) {
        a->played |= option == LCM || option == SPEED;
        switch (option) {
        case TRACE:
            a->trace = 1;
            a->path = optarg;
            break;
        case LCM: a->url = optarg; break;
        case SPEED: failed = argument_number("speed", optarg, 0, 1e6, &a->speed); break;
        case CHANNEL: a->glob = optarg; break;
        case VERIFY: a->verify = 1; break;
        case JSON: a->json = 1; break;
        case HELP: replay_help(); return 1;
        default: failed = -1;
        }
    }
    if (!failed && optind != argc - (a->path == NULL)) {
        say_error("replay: expected the name of one file; see `tahr replay --help`");
        failed = -1;
    }
    a->path = a->path == NULL && !failed ? argv[optind] : a->path;
    return failed;
}

/* What single options cannot see. */
static int check_together(const struct asked *a, enum log_kind kind)
{
    if (kind == LOG_UNKNOWN) {
        say_error("cannot replay '%s': byte 0: no trace (those begin with TAHRTRC) and no LCM event log (ED A1 DA 01)",
                  a->path);
    } else if (a->trace && kind != LOG_TRACE) {
        say_error("--trace '%s': byte 0: no trace, but an LCM event log", a->path);
    } else if (kind == LOG_TRACE && (a->verify || a->played || a->glob != NULL || a->level_argc > 1)) {
        say_error("'%s' is a trace, which is repeated from itself alone; --verify, --lcm, --speed, --channel and the "
                  "options of a level are for LCM event logs",
                  a->path);
    } else if (a->verify && a->played) {
        say_error("--verify: publishes nothing; not with --lcm or --speed");
    } else if (!a->verify && a->json) {
        say_error("--json: only with --verify");
    } else if (!a->verify && a->level_argc > 1) {
        say_error("%s: only with --verify", a->level_argv[1]);
    } else {
        return 0;
    }
    return -1;
}

#ifdef TAHR_HAVE_LCM
static int verify(const struct asked *a)
{
    struct options options;
    int code = EXIT_USAGE;
    optind = 1; /* a second command line */
    if (options_parse(&options, a->level_argc, a->level_argv) == 0) {
        options.json = a->json;
        code = verify_log(a->path, a->glob, &options);
    }
    options_close(&options);
    return code;
}

static int replay_log(const struct asked *a)
{
    return a->verify ? verify(a) : play_log(a->path, a->url, a->glob, a->speed);
}
#else
static int replay_log(const struct asked *a)
{
    say_error("'%s' is an LCM event log, but this tahr was built without LCM", a->path);
    return EXIT_USAGE;
}
#endif

int replay_command(int argc, char **argv)
{
    struct asked asked = {.speed = 1};
    enum log_kind kind = LOG_UNKNOWN;
    asked.level_argv = memory_new((size_t)argc + 1, sizeof *asked.level_argv);
    asked.level_argc = options_of_level(&argc, argv, asked.level_argv);
    const int parsed = read_arguments(&asked, argc, argv);
    int code = parsed > 0 ? EXIT_GOOD : EXIT_USAGE;
    if (parsed == 0 && log_file_kind(asked.path, &kind) == 0 && check_together(&asked, kind) == 0) {
        code = kind == LOG_TRACE ? replay_trace(asked.path) : replay_log(&asked);
    }
    free(asked.level_argv);
    return code;
}

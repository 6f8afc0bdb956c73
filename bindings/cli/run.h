/* SPDX-License-Identifier: MIT
 * run.h: characters walk through a level and are watched. */
#ifndef TAHR_CLI_RUN_H
#define TAHR_CLI_RUN_H

#include "level.h"
#include "options.h"
#include "stats.h"
#include "track.h"

/* Where something went wrong. */
struct finding {
    const char *what; /* static text */
    uint32_t character;
    uint64_t step;
    double time;        /* s */
    tahr_vec3 position; /* of the character's centre, m */
};

enum { MAX_FINDINGS = 20, MODES = TAHR_MODE_CUSTOM + 1, EVENT_TYPES = TAHR_EVENT_CUSTOM + 1 };

/* What became of the messages of --lcm. */
struct feed_counts {
    int open; /* 0: not asked for, or not there */
    uint64_t sent, thinned, dropped, failed;
};

/* What a run found. */
struct result {
    uint64_t steps; /* of all characters */
    struct times times;
    double clock_cost; /* ns, taken off every step's time */
    uint64_t sweeps, contact_queries, rays, triangle_tests, gathers, escapes;
    uint64_t saved[TAHR_SHORTCUT_COUNT]; /* as tahr_report.saved */
    uint32_t most_queries;               /* in one step */
    uint64_t modes[MODES];               /* steps that ended in each mode */
    uint64_t events[EVENT_TYPES];
    uint64_t fell_out, stuck, hung, bad_states, unknown, query_caps;
    double time_lost; /* s */
    uint64_t checked, tunnels;
    uint64_t crushed, crushed_alone; /* of the steps looked at; alone: with no mover near */
    double least_clearance;          /* m; CHECK_REACH if nothing came closer */
    double deepest;                  /* m, deepest penetration of the true shape */
    double least_apart; /* m, of two with --crowd that were apart before; CHECK_REACH if none came closer */
    uint64_t state_hash;
    uint64_t world_bytes;
    uint64_t trace_bytes; /* written by --trace */
    struct feed_counts lcm;
    double ended; /* s, when a signal ended it early; else 0 */
    double load_seconds, open_seconds, wall_seconds;
    int failed;                            /* a check did not hold */
    struct finding findings[MAX_FINDINGS]; /* the first ones */
    size_t finding_count;
};

/* Opens the level that the options name and has its world described. 0, or -1 after a message. */
int run_describe(const struct options *options, const tahr_log *to);

/* `tahr run`. Returns an exit code. */
int run_command(int argc, char **argv);

#endif

/* SPDX-License-Identifier: MIT
 * walk.h: wandering characters on a level with one setting: what a step costs, and what an independent look at the
 * mesh finds wrong meanwhile. */
#ifndef TAHR_CHART_WALK_H
#define TAHR_CHART_WALK_H

#include "row.h"
#include "scene_solid.h"
#include "setting.h"

typedef struct chart_walk {
    const bench_world *level;
    const chart_setting *setting;
    const scene_solid *solid; /* NULL: nobody looks */
    uint32_t walkers;         /* each with a mover of its own */
    double seconds;           /* simulated, by each */
    int idle;                 /* they want nothing */
} chart_walk;

typedef struct chart_pace {
    uint64_t steps, judged;
    double ns_p50, ns_p99, ns_mean;    /* per step: single ones by the monotonic clock, the mean by processor time */
    double queries, tests, iterations; /* per step */
    double saved[TAHR_SHORTCUT_COUNT]; /* per step, by every shortcut */
    double penetration;                /* m, deepest that was seen; NAN if nobody looked */
    uint32_t crossed, embedded;        /* went through a triangle; deeper than 1 mm */
    uint32_t unknown, stuck, crushed, capped;
    uint32_t lost;        /* walked out of the level, and were put back: levels of others have open edges */
    double build_seconds; /* processor time of opening the world */
    uint64_t bytes;       /* that it holds */
    uint64_t hash;        /* of where everybody is in the end */
} chart_pace;

/* Returns 0 and says why (capacity 256) if it cannot be run. */
int chart_walk_run(const chart_walk *walk, chart_pace *pace, char *why);

/* What went wrong, apart from the pace: into row.failed and row.why; and everything else. */
void chart_walk_fill(chart_row *row, const chart_pace *pace, double rate);

#endif

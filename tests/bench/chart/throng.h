/* SPDX-License-Identifier: MIT
 * throng.h: many characters: plain movers, which do not meet each other, or a crowd. */
#ifndef TAHR_CHART_THRONG_H
#define TAHR_CHART_THRONG_H

#include <tahr/crowd.h>

#include "bench_world.h"

typedef struct chart_throng_desc {
    const bench_world *level;
    uint32_t count;
    uint32_t threads; /* 0: plain movers */
    int alone;        /* of a crowd: nobody meets anybody */
    double budget;    /* m, of each who is alone */
} chart_throng_desc;

/* Everybody, and what steps them. */
typedef struct chart_throng {
    uint32_t count;
    tahr_world *world;
    tahr_mover **movers;
    tahr_crowd *crowd;
    void *threads; /* of libtahr_threads, or NULL */
    tahr_state *states;
    tahr_input *inputs;
    tahr_member *members; /* NULL: they meet each other */
    tahr_delay *delays;
    scene_wanderer *wanderers;
} chart_throng;

/* Ground that holds so many: hills, or a plane. */
void chart_throng_ground(bench_world *level, int hills, uint32_t most);

/* Free it also after a failure. */
tahr_status chart_throng_make(chart_throng *throng, const chart_throng_desc *desc);
void chart_throng_free(chart_throng *throng);

/* Everybody wants something, and moves for 1/60 s. Returns the wall-clock time of the steps alone, s, or less than 0
 * where one failed. */
double chart_throng_tick(chart_throng *throng);

#endif

/* SPDX-License-Identifier: MIT
 * bench_crowd.h: characters that wander through a world, one by one. */
#ifndef TAHR_BENCH_CROWD_H
#define TAHR_BENCH_CROWD_H

#include "bench_run.h"

typedef struct bench_crowd {
    uint32_t count;
    tahr_mover **movers;
    tahr_state *states;
    scene_wanderer *wanderers;
    uint64_t seed;
    tahr_config config;
} bench_crowd;

/* count and seed: as the caller set them, the rest zero. Returns 0 and an explanation in error (capacity 256) if it
 * could not; free it in any case. */
int bench_crowd_make(bench_crowd *crowd, bench_opened *opened, const bench_world *world, char *error);
void bench_crowd_free(bench_crowd *crowd);

/* Whether a character fell out of the world. */
int bench_crowd_is_lost(const bench_crowd *crowd, const bench_world *world, uint32_t character);

#endif

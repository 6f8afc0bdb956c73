/* SPDX-License-Identifier: MIT
 * bench_run.h: one measurement: a world, a backend, a number of wandering characters. */
#ifndef TAHR_BENCH_RUN_H
#define TAHR_BENCH_RUN_H

#include "bench_world.h"

typedef struct bench_result {
    uint32_t characters;
    uint64_t steps;
    double ns_median, ns_p99; /* single steps, by the monotonic clock less its own cost */
    double ns_cpu;            /* mean, by the processor time of the thread */
    double sweeps, contact_queries, rays, triangle_tests, iterations, gathers, escapes; /* per step */
    double walking; /* share of the steps that end on a floor */
    uint64_t bytes_per_mover;
    uint64_t lost; /* characters that left the world and were put back */
} bench_result;

typedef struct bench_opened {
    tahr_world *world;
    double build_seconds; /* processor time of tahr_world_open */
    uint64_t bytes;       /* held by the open world */
    uint64_t held;        /* by everything, changes as movers come and go */
} bench_opened;

/* Opens a world on a backend; opened must stay where it is until closed. Returns a status. */
tahr_status bench_open(bench_opened *opened, const bench_world *world, const scene_backend *backend);
void bench_close(bench_opened *opened);

/* Measures. Returns 0 and an explanation in error (capacity 256) if it could not. */
int bench_run(bench_opened *opened, const bench_world *world, uint32_t characters, uint32_t ticks, bench_result *result,
              char *error);

#endif

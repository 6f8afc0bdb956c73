/* SPDX-License-Identifier: MIT
 * bench_telemetry.h: what telemetry adds to a step, on the thread that takes it. */
#ifndef TAHR_BENCH_TELEMETRY_H
#define TAHR_BENCH_TELEMETRY_H

#include "bench_run.h"

/* ns of single steps by the monotonic clock less its own cost, some ticks off and some on by turns. */
typedef struct bench_telemetry_result {
    uint32_t characters;
    uint64_t steps;                       /* of each */
    double off_median, off_p99, off_p999; /* without telemetry */
    double on_median, on_p99, on_p999;    /* with tahr_telemetry_begin and _push */
    double alone;                         /* those two by themselves, median of batches */
    uint64_t dropped;
} bench_telemetry_result;

/* Measures on an open world, with a sink that counts, or stalled: that does not return until the end, as over a network
 * that hangs. Returns 0 and an explanation in error (capacity 256) if it could
 * not. */
int bench_telemetry_run(bench_opened *opened, const bench_world *world, uint32_t characters, int stalled,
                        bench_telemetry_result *result, char *error);

#endif

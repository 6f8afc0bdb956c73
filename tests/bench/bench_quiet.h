/* SPDX-License-Identifier: MIT
 * bench_quiet.h: what costs next to nothing: who sleeps, and who falls where nothing is. */
#ifndef TAHR_BENCH_QUIET_H
#define TAHR_BENCH_QUIET_H

#include "bench_run.h"

enum { BENCH_QUIET = 3 };

/* "asleep", "asleep_crowd", "free_fall"; NULL beyond the last. */
const char *bench_quiet_name(int index);

/* Measures one of them on native. Too short to be timed one by one: times are of batches of a thousand steps and more,
 * by the monotonic clock, divided by their number. Returns 0 and an explanation in error (capacity 256) if it could
 * not. */
int bench_quiet_run(int index, uint32_t characters, bench_result *result, char *error);

#endif

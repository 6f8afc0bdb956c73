/* SPDX-License-Identifier: MIT
 * stats.h: step times and counts of a run. */
#ifndef TAHR_CLI_STATS_H
#define TAHR_CLI_STATS_H

#include <stdint.h>

/* Nanoseconds up to 65 us are counted one by one; above that in 64 bins per doubling, which is 1.1 % wide. */
enum { TIMES_EXACT = 65536, TIMES_PER_DOUBLING = 64, TIMES_BINS = TIMES_EXACT + 48 * TIMES_PER_DOUBLING };

struct times {
    uint64_t *bins;
    uint64_t count, sum, greatest;
};

void times_open(struct times *times);
void times_add(struct times *times, uint64_t ns);
/* The time that `part` (0..1) of all samples do not exceed; 0 without samples. */
double times_quantile(const struct times *times, double part);
double times_mean(const struct times *times);
void times_close(struct times *times);

/* Monotonic nanoseconds, and what asking for them costs (the median of many pairs). */
uint64_t clock_ns(void);
double clock_cost(void);

#endif

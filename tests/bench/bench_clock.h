/* SPDX-License-Identifier: MIT
 * bench_clock.h: the clocks of whatever is timed. */
#ifndef TAHR_BENCH_CLOCK_H
#define TAHR_BENCH_CLOCK_H

#include <stddef.h>
#include <stdint.h>
#include <time.h>

uint64_t bench_nanoseconds(clockid_t clock);

/* ns that reading the monotonic clock twice adds to what is measured. */
double bench_clock_cost(void);

/* ns of processor time that go by between two readings of the thread's clock with one of either clock in between. */
double bench_cpu_clock_cost(void);

/* Ascending. */
void bench_sort(uint32_t *times, size_t count);

#endif

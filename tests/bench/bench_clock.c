/* SPDX-License-Identifier: MIT
 * bench_clock.c: reads clocks and knows what that costs. */
#include "bench_clock.h"

#include <stdlib.h>

enum { CLOCK_SAMPLES = 2001 };

uint64_t bench_nanoseconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

static int by_value(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

void bench_sort(uint32_t *times, size_t count)
{
    qsort(times, count, sizeof times[0], by_value);
}

double bench_clock_cost(void)
{
    uint32_t samples[CLOCK_SAMPLES];
    for (int i = 0; i < CLOCK_SAMPLES; i++) {
        uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
        samples[i] = (uint32_t)(bench_nanoseconds(CLOCK_MONOTONIC) - before);
    }
    bench_sort(samples, CLOCK_SAMPLES);
    return samples[CLOCK_SAMPLES / 2];
}

double bench_cpu_clock_cost(void)
{
    uint32_t samples[CLOCK_SAMPLES];
    for (int i = 0; i < CLOCK_SAMPLES; i++) {
        uint64_t before = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
        bench_nanoseconds(CLOCK_MONOTONIC);
        bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
        samples[i] = (uint32_t)(bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID) - before);
    }
    bench_sort(samples, CLOCK_SAMPLES);
    return samples[CLOCK_SAMPLES / 2];
}

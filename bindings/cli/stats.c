/* SPDX-License-Identifier: MIT
 * stats.c: step times in a histogram, so that memory does not grow with the length of a run. */
#include "stats.h"

#include "say.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

void times_open(struct times *times)
{
    *times = (struct times){.bins = memory_new(TIMES_BINS, sizeof *times->bins)};
}

static size_t bin_of(uint64_t ns)
{
    int exponent = 0;
    if (ns < TIMES_EXACT) {
        return (size_t)ns;
    }
    double mantissa = frexp((double)ns / TIMES_EXACT, &exponent); /* [0.5, 1) */
    size_t bin = (size_t)TIMES_EXACT + (size_t)(exponent - 1) * TIMES_PER_DOUBLING +
                 (size_t)((mantissa - 0.5) * 2 * TIMES_PER_DOUBLING);
    return bin < TIMES_BINS ? bin : TIMES_BINS - 1;
}

static double middle_of(size_t bin)
{
    if (bin < TIMES_EXACT) {
        return (double)bin;
    }
    size_t above = bin - TIMES_EXACT;
    double part = ((double)(above % TIMES_PER_DOUBLING) + 0.5) / TIMES_PER_DOUBLING;
    return ldexp((1 + part) * TIMES_EXACT, (int)(above / TIMES_PER_DOUBLING));
}

void times_add(struct times *times, uint64_t ns)
{
    times->bins[bin_of(ns)]++;
    times->count++;
    times->sum += ns;
    times->greatest = ns > times->greatest ? ns : times->greatest;
}

double times_quantile(const struct times *times, double part)
{
    uint64_t wanted = (uint64_t)ceil(part * (double)times->count), seen = 0;
    for (size_t i = 0; i < TIMES_BINS; i++) {
        seen += times->bins[i];
        if (seen >= wanted && seen > 0) {
            return middle_of(i);
        }
    }
    return 0;
}

double times_mean(const struct times *times)
{
    return times->count ? (double)times->sum / (double)times->count : 0;
}

void times_close(struct times *times)
{
    free(times->bins);
    *times = (struct times){0};
}

uint64_t clock_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

double clock_cost(void)
{
    struct times times;
    times_open(&times);
    for (int i = 0; i < 2000; i++) {
        uint64_t before = clock_ns();
        times_add(&times, clock_ns() - before);
    }
    double cost = times_quantile(&times, 0.5);
    times_close(&times);
    return cost;
}

/* SPDX-License-Identifier: MIT
 * run.c: budgets, the bar, the clocks. */
#include "run.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BAR = 24, CLOCK_SAMPLES = 2001 };

/* FULL stays under 15 minutes and QUICK under 2 on two idle cores of a 2.2 GHz server. */
const chart_budget CHART_TINY = {"tiny", 1, 32, 48, 2, 2, 0.25, 10, 2000, 0.5};
const chart_budget CHART_QUICK = {"quick", 3, 2, 2, 64, 16, 10, 10000, 500000, 0.1};
const chart_budget CHART_FULL = {"full", 15, 1, 1, 1000, 64, 30, 100000, 5000000, 0.05};

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double chart_processor(void)
{
    return seconds(CLOCK_THREAD_CPUTIME_ID);
}

double chart_monotonic(void)
{
    return seconds(CLOCK_MONOTONIC);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double chart_clock_cost(void)
{
    double samples[CLOCK_SAMPLES];
    for (int i = 0; i < CLOCK_SAMPLES; i++) {
        double before = chart_monotonic();
        samples[i] = 1e9 * (chart_monotonic() - before);
    }
    qsort(samples, CLOCK_SAMPLES, sizeof samples[0], by_value);
    return samples[CLOCK_SAMPLES / 2];
}

int chart_run_next(chart_run *run, const char *scene, const char *name)
{
    char filled[BAR + 1];
    if (run->counting) {
        run->total++;
        return 0;
    }
    uint32_t width = run->total ? run->done * BAR / run->total : 0;
    if (run->bar && run->lines) {
        if (run->done == 0 || width > (run->done - 1) * BAR / run->total) {
            fprintf(run->bar, "tahr_chart: %3u of %u, %4.0f s  %s %s\n", run->done, run->total,
                    chart_monotonic() - run->started, run->family, scene);
        }
    } else if (run->bar) {
        memset(filled, '.', BAR);
        memset(filled, '#', width);
        filled[BAR] = '\0';
        fprintf(run->bar, "\r[%s] %3u of %u, %4.0f s  %-9s %-14.14s %-30.30s", filled, run->done, run->total,
                chart_monotonic() - run->started, run->family, scene, name);
        fflush(run->bar);
    }
    run->done++;
    return 1;
}

void chart_run_write(chart_run *run, const chart_row *row)
{
    chart_row_write(run->csv, run->family, row);
}

void chart_run_fail(chart_run *run, const char *what, const char *why)
{
    fprintf(stderr, "%stahr_chart: %s: %s: %s\n", run->bar && !run->lines ? "\n" : "", run->family, what, why);
    run->failed = 1;
}

void chart_run_skip(chart_run *run, const char *what, const char *why)
{
    fprintf(stderr, "%sSKIP: %s: %s: %s\n", run->bar && !run->lines ? "\n" : "", run->family, what, why);
}

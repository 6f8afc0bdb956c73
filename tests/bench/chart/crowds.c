/* SPDX-License-Identifier: MIT
 * crowds.c: a tick of 1 to 100 000 characters: plain movers, which do not meet each other, and crowds on some threads.
 * Timed by the wall clock: that is what threads are for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ceiling.h"
#include "run.h"
#include "throng.h"

enum { WARM_UP_TICKS = 10, MIN_TICKS = 5, MAX_TICKS = 2000 };

static const uint32_t COUNTS[] = {1, 10, 100, 1000, 10000, 100000};
enum { COUNT_SIZES = sizeof COUNTS / sizeof COUNTS[0] };

static const double TICK_STEPS = 2e5; /* steps of all ticks of one measurement */

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Times of a character in every tick, ns; sorts them. */
static void put_times(chart_row *row, double *ns, uint32_t ticks)
{
    double sum = 0;
    for (uint32_t k = 0; k < ticks; k++) {
        sum += ns[k];
    }
    qsort(ns, ticks, sizeof ns[0], by_value);
    row->ns_p50 = ns[ticks / 2];
    row->ns_p99 = ns[ticks - 1 - ticks / 100];
    row->ns_mean = sum / ticks;
    row->rate = 60;
    row->ns_second = row->ns_mean * 60;
}

static uint32_t ticks_of(uint32_t count)
{
    return (uint32_t)fmin(MAX_TICKS, fmax(MIN_TICKS, TICK_STEPS / count));
}

static int time_ticks(chart_throng *t, chart_row *row)
{
    static double ns[MAX_TICKS];
    uint32_t ticks = ticks_of(t->count);
    for (uint32_t k = 0; k < WARM_UP_TICKS; k++) {
        if (chart_throng_tick(t) < 0) return 0;
    }
    for (uint32_t k = 0; k < ticks; k++) {
        double seconds = chart_throng_tick(t);
        if (seconds < 0) return 0;
        ns[k] = 1e9 * seconds / t->count;
    }
    put_times(row, ns, ticks);
    row->samples = (uint64_t)ticks * t->count;
    return 1;
}

static void measure(chart_run *run, const bench_world *level, uint32_t count, uint32_t threads)
{
    char name[48];
    chart_row row;
    chart_throng t;
    tahr_status status = chart_throng_make(&t, &(chart_throng_desc){level, count, threads, 0, 0});
    chart_row_clear(&row);
    snprintf(name, sizeof name, threads ? "crowd; %u thread%s" : "movers; no obstacles", threads,
             threads == 1 ? "" : "s");
    row.scene = level->name;
    row.curve = row.setting = name;
    row.value = count;
    row.threads = threads ? threads : 1;
    if (status >= 0 && time_ticks(&t, &row)) {
        chart_run_write(run, &row);
    } else {
        chart_run_fail(run, name, status < 0 ? tahr_status_name(status) : "a step failed");
    }
    chart_throng_free(&t);
}

/* As many crowds as threads, side by side and each for itself: no crowd on so many threads can be faster. */
static void measure_ceiling(chart_run *run, const bench_world *level, uint32_t count, uint32_t threads)
{
    static double ns[MAX_TICKS];
    const uint32_t ticks = ticks_of(count);
    char name[48];
    chart_row row;
    chart_row_clear(&row);
    snprintf(name, sizeof name, "machine's ceiling; %u threads", threads);
    row.scene = level->name;
    row.curve = row.setting = name;
    row.value = count;
    row.threads = threads;
    const char *wrong = chart_ceiling(level, count, threads, ns, ticks);
    if (wrong) {
        chart_run_fail(run, name, wrong);
        return;
    }
    put_times(&row, ns, ticks);
    row.samples = (uint64_t)ticks * count;
    chart_run_write(run, &row);
}

/* What a budget of error buys, and what it costs: characters that are alone, each with a budget, beside others that
 * want the same and are exact. */
static const double BUDGETS[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2};
enum { BUDGET_COUNT = sizeof BUDGETS / sizeof BUDGETS[0], BUDGET_CROWD = 1000, BUDGET_TICKS = 180 };

static double apart(const tahr_state *a, const tahr_state *b)
{
    double x = a->position.x - b->position.x, y = a->position.y - b->position.y, z = a->position.z - b->position.z;
    return sqrt(x * x + y * y + z * z);
}

static int compare_ticks(chart_throng *cheap, chart_throng *exact, chart_row *row, double *errors)
{
    double ns[BUDGET_TICKS];
    uint32_t count = 0;
    for (uint32_t k = 0; k < WARM_UP_TICKS + BUDGET_TICKS; k++) {
        double seconds = chart_throng_tick(cheap);
        if (seconds < 0 || chart_throng_tick(exact) < 0) return 0;
        if (k < WARM_UP_TICKS) continue;
        ns[k - WARM_UP_TICKS] = 1e9 * seconds / cheap->count;
        for (uint32_t i = 0; i < cheap->count; i++) {
            errors[count++] = apart(&cheap->states[i], &exact->states[i]);
        }
    }
    put_times(row, ns, BUDGET_TICKS);
    row->samples = count;
    chart_row_errors(row, errors, count);
    return 1;
}

static void measure_budget(chart_run *run, const bench_world *level, double budget, uint32_t count)
{
    char name[48];
    chart_row row;
    chart_throng cheap, exact;
    double *errors = malloc((size_t)count * BUDGET_TICKS * sizeof *errors);
    tahr_status first = chart_throng_make(&cheap, &(chart_throng_desc){level, count, 1, 1, budget});
    tahr_status second = chart_throng_make(&exact, &(chart_throng_desc){level, count, 1, 1, 0});
    chart_row_clear(&row);
    snprintf(name, sizeof name, budget > 0 ? "budget %g mm" : "budget 0; exact", 1e3 * budget);
    row.scene = "budgets";
    row.curve = "budget";
    row.setting = name;
    row.role = budget > 0 ? CHART_KNOB : CHART_DEFAULT;
    row.reference = "the same without a budget";
    row.value = 1e3 * budget;
    if (errors && first >= 0 && second >= 0 && compare_ticks(&cheap, &exact, &row, errors)) {
        chart_run_write(run, &row);
    } else {
        chart_run_fail(run, name, "out of memory, or a step failed");
    }
    chart_throng_free(&cheap);
    chart_throng_free(&exact);
    free(errors);
}

static void measure_budgets(chart_run *run)
{
    uint32_t most = run->budget->max_characters, count = most < BUDGET_CROWD ? most : BUDGET_CROWD;
    bench_world level = {.name = ""};
    if (!run->counting) chart_throng_ground(&level, 0, count);
    for (int i = -1; i < BUDGET_COUNT; i++) {
        double budget = i < 0 ? 0 : BUDGETS[i];
        if (chart_run_next(run, "budgets", "a budget of error")) measure_budget(run, &level, budget, count);
    }
    bench_world_free(&level);
}

void chart_crowds(chart_run *run)
{
    static const uint32_t all[] = {0, 1, 2, 4, 8}; /* threads, of which those that there are processors for */
#ifdef TAHR_HAVE_THREADS
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
#else
    long processors = 1;
#endif
    for (int hills = 0; hills < 2; hills++) {
        bench_world level = {.name = ""};
        if (!run->counting) chart_throng_ground(&level, hills, run->budget->max_characters);
        for (int k = 0; k < 5 && (k < 2 || (long)all[k] <= processors); k++) {
            for (int i = 0; i < COUNT_SIZES && COUNTS[i] <= run->budget->max_characters; i++) {
                char name[48];
                snprintf(name, sizeof name, "%u characters; %u threads", COUNTS[i], all[k]);
                if (chart_run_next(run, hills ? "hills" : "plane", name)) measure(run, &level, COUNTS[i], all[k]);
                if (all[k] > 1 && chart_run_next(run, hills ? "hills" : "plane", "machine's ceiling")) {
                    measure_ceiling(run, &level, COUNTS[i], all[k]);
                }
            }
        }
        bench_world_free(&level);
    }
    measure_budgets(run);
}

/* SPDX-License-Identifier: MIT
 * sweeps.c: every backend and setting asked the sweeps of the stored truth, one at a time, after the announcement that
 * a step would make (where a backend has a use for it).
 *
 * The time of a sweep is the least of some rounds of a few askings each: on a machine shared with others the rest is
 * their noise. Every answer is judged; failures are counted, and no error of theirs is averaged in. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "run.h"
#include "subject.h"
#include "truth_set.h"

enum { ASKINGS = 16 }; /* per reading of the clock, which costs as much as a fast sweep */

typedef struct tally {
    double *errors, *times;
    uint32_t error_count, missed, false_hits, turned, gave_up;
    tahr_query_context context;
} tally;

/* Everything within the sweep and its margin; nothing turns within a sweep. */
static tahr_prepare announcement(const tahr_sweep *q)
{
    const tahr_shape *s = &q->shape;
    double reach = s->half_height + s->half_x + s->half_y + q->margin + 0.01;
    tahr_vec3 a = q->position, b = {a.x + q->motion.x, a.y + q->motion.y, a.z + q->motion.z};
    tahr_prepare p = {.position = a, .up = q->up, .mask = q->mask};
    p.bounds.min = (tahr_vec3){fmin(a.x, b.x) - reach, fmin(a.y, b.y) - reach, fmin(a.z, b.z) - reach};
    p.bounds.max = (tahr_vec3){fmax(a.x, b.x) + reach, fmax(a.y, b.y) + reach, fmax(a.z, b.z) + reach};
    return p;
}

/* One case: asked once for its answer and its counts, and again for its time. */
static void ask(const chart_run *run, const tahr_backend *backend, void *self, const chart_truth_set *set, uint32_t i,
                tally *t)
{
    const tahr_sweep *q = chart_truth_sweep(set, i);
    tahr_hit hit = {0};
    uint32_t count = 0;
    tahr_prepare prepare = announcement(q);
    if (backend->prepare) backend->prepare(self, &t->context, &prepare);
    tahr_status status = backend->sweep(self, &t->context, q, &hit, 1, &count);
    chart_verdict verdict = chart_truth_judge(set, i, status, &hit, count, &t->errors[t->error_count]);
    t->error_count += verdict == CHART_HIT;
    t->missed += verdict == CHART_MISSED;
    t->false_hits += verdict == CHART_FALSE_HIT;
    t->turned += verdict == CHART_WRONG_NORMAL;
    t->gave_up += verdict == CHART_GAVE_UP;
    tahr_query_context unused = {.cache = t->context.cache};
    for (uint32_t round = 0; round < run->budget->sweep_rounds; round++) {
        double before = chart_monotonic();
        for (int k = 0; k < ASKINGS; k++) {
            backend->sweep(self, &unused, q, &hit, 1, &count);
        }
        double each = 1e9 * (chart_monotonic() - before) / ASKINGS;
        t->times[i] = round == 0 || each < t->times[i] ? each : t->times[i];
    }
}

static int ask_all(const chart_run *run, const chart_subject *subject, const chart_truth_set *set, tally *t)
{
    const tahr_backend *backend = subject->get();
    void *self = NULL;
    for (uint32_t i = 0; i < chart_truth_count(set); i++) {
        int same;
        const tahr_body_desc *body = chart_truth_body(set, i, subject->planar, &same);
        if (!same) {
            if (self) backend->close(self);
            self = NULL;
            free(t->context.cache);
            t->context.cache = NULL;
            if (chart_subject_open(subject, body, 1, &self) < 0) return 0;
            if (!chart_subject_cache(subject, self, &t->context)) return 0;
        }
        ask(run, backend, self, set, i, t);
    }
    if (self) backend->close(self);
    return 1;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void fill(chart_row *row, const chart_subject *subject, tally *t, uint32_t count)
{
    row->curve = subject->curve;
    row->setting = subject->setting;
    row->role = subject->role;
    row->value = subject->value;
    row->reference = "truth";
    row->samples = count;
    row->failed = t->missed + t->false_hits + t->turned + t->gave_up;
    if (row->failed) {
        snprintf(row->why, sizeof row->why, "%u missed; %u false; %u normals; %u gave up", t->missed, t->false_hits,
                 t->turned, t->gave_up);
    }
    chart_row_errors(row, t->errors, t->error_count);
    row->ns_mean = 0;
    for (uint32_t i = 0; i < count; i++) {
        row->ns_mean += t->times[i] / count;
    }
    qsort(t->times, count, sizeof t->times[0], by_value);
    row->ns_p50 = t->times[(count - 1) / 2];
    row->ns_p99 = t->times[count - 1 - (count - 1) / 100];
    row->queries = 1;
    row->tests = (double)t->context.narrow_tests / count;
    row->iterations = (double)t->context.narrow_iterations / count;
}

static void measure(chart_run *run, const chart_subject *subject, const char *scene, const chart_truth_set *set)
{
    uint32_t count = chart_truth_count(set);
    tally t = {.errors = malloc((count + 1) * sizeof *t.errors), .times = malloc((count + 1) * sizeof *t.times)};
    chart_row row;
    chart_row_clear(&row);
    row.scene = scene;
    if (!t.errors || !t.times) {
        chart_run_fail(run, subject->setting, "out of memory");
    } else if (!ask_all(run, subject, set, &t)) {
        chart_run_fail(run, subject->setting, "a mesh of the truth cannot be opened, or no memory is left");
    } else {
        fill(&row, subject, &t, count);
        chart_run_write(run, &row);
    }
    free(t.context.cache);
    free(t.errors);
    free(t.times);
}

void chart_sweeps(chart_run *run)
{
    for (int s = 0; s < CHART_TRUTH_SETS; s++) {
        chart_truth_set *set = run->counting ? NULL : chart_truth_load(s, run->budget->sweep_stride);
        if (!set && !run->counting) chart_run_fail(run, chart_truth_name(s), "out of memory");
        const chart_subject *subject;
        for (uint32_t i = 0; (subject = chart_subject_at(i)) != NULL; i++) {
            if (subject->planar && !chart_truth_planar(s)) continue;
            if (chart_run_next(run, chart_truth_name(s), subject->setting) && set) {
                measure(run, subject, chart_truth_name(s), set);
            }
        }
        chart_truth_free(set);
    }
}

/* SPDX-License-Identifier: MIT
 * walk.c: steps wanderers, timing each step, and judges them by the mesh alone. */
#include "walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run.h"

enum { WARM_UP_TICKS = 30, MAX_STEPS = 400000 };

static const double JUDGE_RATE = 60; /* Hz, at most: the way between two looks is taken for straight */

static const double EMBEDDED = 1e-3; /* m: what the design calls penetrating, as the peers are judged */

typedef struct herd {
    const chart_walk *walk;
    tahr_world *world;
    uint32_t count;
    tahr_mover **movers;
    tahr_state *states;
    tahr_vec3 *places; /* when they were last judged */
    scene_wanderer *wanderers;
    uint64_t seed;
    float *times;
    chart_pace *pace;
} herd;

static int by_value(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void herd_free(herd *h)
{
    for (uint32_t i = 0; h->movers && i < h->count; i++) {
        tahr_mover_destroy(h->movers[i]);
    }
    free(h->movers);
    free(h->states);
    free(h->places);
    free(h->wanderers);
    free(h->times);
    tahr_world_close(h->world);
}

static int spawn(herd *h, uint32_t i)
{
    const chart_walk *w = h->walk;
    int ok = scene_wander_spawn(h->world, &w->setting->config, &w->level->spawn, &h->seed, &h->states[i]);
    h->places[i] = h->states[i].position;
    return ok;
}

static int herd_make(herd *h, uint64_t steps, char *why)
{
    const chart_walk *w = h->walk;
    double before = chart_processor();
    tahr_status status = chart_setting_open(w->setting, w->level, &h->world);
    h->pace->build_seconds = chart_processor() - before;
    h->pace->bytes = tahr_world_memory(h->world);
    h->movers = calloc(h->count, sizeof *h->movers);
    h->states = calloc(h->count, sizeof *h->states);
    h->places = calloc(h->count, sizeof *h->places);
    h->wanderers = calloc(h->count, sizeof *h->wanderers);
    h->times = calloc(steps, sizeof *h->times);
    if (status < 0 || !h->movers || !h->states || !h->places || !h->wanderers || !h->times) {
        snprintf(why, 256, "%s", status < 0 ? tahr_status_name(status) : "out of memory");
        return 0;
    }
    for (uint32_t i = 0; i < h->count; i++) {
        status = tahr_mover_create(h->world, &w->setting->config, &h->movers[i]);
        if (status < 0 || !spawn(h, i)) {
            snprintf(why, 256, "%s", status < 0 ? tahr_status_name(status) : "no place to start at");
            return 0;
        }
        scene_wander_start(&h->wanderers[i], 1, i);
    }
    return 1;
}

/* Looks at the mesh: the way since the last look, and how deep it is in. */
static void judge(herd *h, uint32_t i)
{
    const tahr_state *s = &h->states[i];
    const tahr_shape *shape = &h->walk->setting->config.shape;
    double half = shape->half_height - shape->radius;
    tahr_vec3 p = s->position, low = {p.x, p.y, p.z - half}, high = {p.x, p.y, p.z + half};
    double depth = shape->radius - scene_solid_distance(h->walk->solid, low, high, shape->radius, NULL);
    chart_pace *pace = h->pace;
    pace->judged++;
    pace->penetration = fmax(pace->penetration, depth);
    pace->embedded += depth > EMBEDDED;
    pace->crossed += scene_solid_crossed(h->walk->solid, h->places[i], p, NULL) != 0;
    h->places[i] = p;
}

static void note(chart_pace *pace, const tahr_report *r)
{
    pace->queries += r->sweeps + r->contact_queries + r->rays;
    pace->tests += (double)r->triangle_tests;
    pace->iterations += (double)r->narrow_iterations;
    for (int i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        pace->saved[i] += r->saved[i];
    }
    pace->unknown += (r->flags & TAHR_REPORT_UNKNOWN) != 0;
    pace->stuck += (r->flags & TAHR_REPORT_STUCK) != 0;
    pace->crushed += (r->flags & TAHR_REPORT_CRUSHED) != 0;
    pace->capped += (r->flags & TAHR_REPORT_QUERY_CAP) != 0;
}

/* One step of everybody; times NULL: to warm up. */
static int tick(herd *h, float *times, char *why)
{
    const chart_walk *w = h->walk;
    const tahr_bounds *bounds = &w->level->spawn;
    double dt = 1 / w->setting->rate;
    tahr_input still = {.struct_size = sizeof still};
    for (uint32_t i = 0; i < h->count; i++) {
        tahr_report report = {.struct_size = sizeof report};
        const tahr_input *input = w->idle ? &still : bench_world_wish(w->level, &h->wanderers[i], dt);
        double before = chart_monotonic();
        tahr_status status = tahr_mover_step(h->movers[i], input, dt, &h->states[i], &report);
        double after = chart_monotonic();
        if (status < 0) {
            snprintf(why, 256, "a step failed: %s", tahr_status_name(status));
            return 0;
        }
        if (times) {
            times[i] = (float)(1e9 * (after - before));
            note(h->pace, &report);
        }
        tahr_vec3 at = h->states[i].position;
        if (w->level->planar ? at.y < bounds->min.y - 10 : at.z < bounds->min.z - 10) {
            h->pace->lost++;
            if (!spawn(h, i)) {
                snprintf(why, 256, "no place to start at again");
                return 0;
            }
        }
    }
    return 1;
}

static void summarize(herd *h, double cpu)
{
    chart_pace *p = h->pace;
    double cost = chart_clock_cost(), n = (double)p->steps;
    qsort(h->times, p->steps, sizeof h->times[0], by_value);
    p->ns_p50 = fmax(1, h->times[p->steps / 2] - cost); /* a sleeper costs less than the clock can tell */
    p->ns_p99 = fmax(1, h->times[p->steps - 1 - p->steps / 100] - cost);
    p->ns_mean = fmax(1, 1e9 * cpu / n - 2 * cost);
    p->queries /= n;
    p->tests /= n;
    p->iterations /= n;
    for (int i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        p->saved[i] /= n;
    }
    p->hash = 14695981039346656037u;
    for (uint32_t i = 0; i < h->count; i++) {
        p->hash = (p->hash ^ tahr_state_hash(&h->states[i])) * 1099511628211u;
    }
}

int chart_walk_run(const chart_walk *walk, chart_pace *pace, char *why)
{
    uint64_t ticks = (uint64_t)(walk->seconds * walk->setting->rate) + 1;
    if (ticks * walk->walkers > MAX_STEPS) ticks = MAX_STEPS / walk->walkers;
    *pace = (chart_pace){.steps = ticks * walk->walkers};
    herd h = {.walk = walk, .count = walk->walkers, .seed = 17, .pace = pace};
    int ok = herd_make(&h, pace->steps, why);
    for (uint32_t t = 0; ok && t < WARM_UP_TICKS; t++) {
        ok = tick(&h, NULL, why);
    }
    for (uint32_t i = 0; ok && i < h.count; i++) {
        h.places[i] = h.states[i].position;
    }
    pace->lost = 0;
    double cpu = 0; /* without the judge's */
    uint64_t judge_every = walk->setting->rate > JUDGE_RATE ? (uint64_t)(walk->setting->rate / JUDGE_RATE) : 1;
    for (uint64_t t = 0; ok && t < ticks; t++) {
        double before = chart_processor();
        ok = tick(&h, h.times + t * walk->walkers, why);
        cpu += chart_processor() - before;
        for (uint32_t i = 0; ok && walk->solid && t % judge_every == 0 && i < h.count; i++) {
            judge(&h, i);
        }
    }
    if (ok) summarize(&h, cpu);
    if (!walk->solid) pace->penetration = NAN;
    herd_free(&h);
    return ok;
}

void chart_walk_fill(chart_row *row, const chart_pace *p, double rate)
{
    row->ns_p50 = p->ns_p50;
    row->ns_p99 = p->ns_p99;
    row->ns_mean = p->ns_mean;
    row->rate = rate;
    row->ns_second = p->ns_mean * rate;
    row->queries = p->queries;
    row->tests = p->tests;
    row->iterations = p->iterations;
    row->penetration = p->penetration;
    row->samples = p->steps;
    row->failed = p->crossed + p->embedded + p->unknown + p->stuck + p->crushed + p->capped;
    if (row->failed) {
        snprintf(row->why, sizeof row->why, "%u through; %u embedded; %u unknown; %u stuck; %u crushed; %u capped",
                 p->crossed, p->embedded, p->unknown, p->stuck, p->crushed, p->capped);
    }
}

/* SPDX-License-Identifier: MIT
 * course_judge.c: looks at where a method's characters were, with the triangles alone (tests/support/scene_solid.c). It
 * believes nothing that the method says but "grounded", which it only counts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench_clock.h"
#include "course_record.h"

static const double DEEP = 1e-3;  /* m: deeper is a failure */
static const double NEAR = 0.05;  /* m: clearance beyond is not looked for */
static const double STILL = 0.05; /* m, in STRETCH s of wishes */
static const double STRETCH = 5;  /* s: at least two headings, as a rule four */

typedef struct judge {
    const course_run *run;
    course_result *result;
    double wished, made;
    double changes;
    double start[3]; /* of a stretch */
    uint32_t since;  /* ticks of it */
    int bad;         /* the character that is looked at has failed */
} judge;

static tahr_vec3 vector(const course *c, const double p[3], double raise)
{
    tahr_vec3 v = {p[0], p[1], p[2]};
    if (c->level.planar) {
        v.y += raise;
        v.z = 0; /* that is where the outline is judged, whatever the method writes there */
    } else {
        v.z += raise;
    }
    return v;
}

static void fail(judge *j, uint64_t *count, uint32_t tick, uint32_t i)
{
    course_result *r = j->result;
    ++*count;
    j->bad = 1;
    if (r->first_bad_tick == UINT32_MAX || tick < r->first_bad_tick) {
        r->first_bad_tick = tick;
        r->first_bad_character = i;
        memcpy(r->first_bad, course_end_at(j->run, tick, i)->position, sizeof r->first_bad);
    }
}

/* Only the least gap and what is deep count, so nothing farther away than the least yet is looked at. */
static void judge_gap(judge *j, const course_place *end, uint32_t tick, uint32_t i)
{
    const course *c = j->run->course;
    course_result *r = j->result;
    double core = c->character.half_height - c->character.radius;
    double limit = c->character.radius + fmax(r->clearance, 0);
    double d =
        scene_solid_distance(c->solid, vector(c, end->position, -core), vector(c, end->position, core), limit, NULL);
    double gap = d - c->character.radius;
    r->clearance = fmin(r->clearance, gap);
    if (gap < -DEEP) {
        fail(j, &r->embedded, tick, i);
    }
}

/* Returns whether the step is one whose way can be measured. */
static int judge_place(judge *j, uint32_t tick, uint32_t i)
{
    const course *c = j->run->course;
    course_result *r = j->result;
    const course_place *start = course_place_at(j->run, tick, i), *end = course_end_at(j->run, tick, i);
    const double *p = end->position;
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) {
        fail(j, &r->invalid, tick, i);
        return 0;
    }
    if (scene_solid_crossed(c->solid, vector(c, start->position, 0), vector(c, p, 0), NULL)) {
        fail(j, &r->tunnelled, tick, i);
    }
    r->left += end->left;
    judge_gap(j, end, tick, i);
    return 1;
}

static void judge_way(judge *j, uint32_t tick, uint32_t i)
{
    const course_wish *w = course_wish_at(j->run, tick, i);
    const double *from = course_place_at(j->run, tick, i)->position, *to = course_end_at(j->run, tick, i)->position;
    double speed = sqrt(w->velocity[0] * w->velocity[0] + w->velocity[1] * w->velocity[1]);
    if (speed > 0) {
        j->made += ((to[0] - from[0]) * w->velocity[0] + (to[1] - from[1]) * w->velocity[1]) / speed;
        j->wished += speed * j->run->course->character.dt;
    }
}

/* A stretch begins with a place and ends STRETCH later, or when somebody is put elsewhere. */
static void judge_stretch(judge *j, uint32_t tick, uint32_t i)
{
    const course_place *end = course_end_at(j->run, tick, i);
    if (end->left || j->since == 0) {
        memcpy(j->start, course_place_at(j->run, tick + 1, i)->position, sizeof j->start);
        j->since = end->left ? 0 : 1;
        return;
    }
    if (++j->since * j->run->course->character.dt >= STRETCH) {
        double x = end->position[0] - j->start[0], y = end->position[1] - j->start[1],
               z = end->position[2] - j->start[2];
        j->result->stuck += sqrt(x * x + y * y + z * z) < STILL;
        j->since = 0;
    }
}

static void judge_character(judge *j, uint32_t i)
{
    j->bad = 0;
    j->since = 0;
    for (uint32_t tick = 0; tick < j->run->done; tick++) {
        const course_place *end = course_end_at(j->run, tick, i);
        if (judge_place(j, tick, i)) {
            judge_way(j, tick, i);
        }
        judge_stretch(j, tick, i);
        j->result->grounded += end->grounded;
        j->changes += tick > 0 && !end->left && end->grounded != course_end_at(j->run, tick - 1, i)->grounded;
    }
    j->result->bad_characters += j->bad ? 1u : 0u;
}

/* Over the timed ticks of all. Returns 0 without memory. */
static int summarize_times(const course_run *run, course_result *r)
{
    size_t count = (size_t)run->timed_ticks * run->plan.characters;
    uint32_t *times = malloc(sizeof *times * (count + 1));
    double cost = bench_clock_cost();
    if (!times || count == 0) {
        free(times);
        return times != NULL;
    }
    memcpy(times, run->times, sizeof *times * count);
    bench_sort(times, count);
    r->timed = count;
    r->ns_median = fmax(times[count / 2] - cost, 0);
    r->ns_p99 = fmax(times[count - 1 - count / 100] - cost, 0);
    r->ns_worst = fmax(times[count - 1] - cost, 0);
    double clocks = 2 * cost + bench_cpu_clock_cost() / run->plan.characters; /* of a step, and of a tick */
    r->ns_cpu = fmax(1e9 * run->cpu_timed / (double)count - clocks, 0);
    free(times);
    return 1;
}

static int summarize_queries(const course_run *run, course_result *r)
{
    size_t count = (size_t)run->done * run->plan.characters;
    uint32_t *queries = malloc(sizeof *queries * (count + 1));
    if (!queries) {
        return 0;
    }
    for (size_t k = 0; k < count; k++) {
        queries[k] = run->ends[k].queries;
        r->queries += queries[k] / (double)count;
    }
    bench_sort(queries, count);
    r->queries_p99 = count ? queries[count - 1 - count / 100] : 0;
    free(queries);
    return 1;
}

int course_judge(const course_run *run, course_result *r)
{
    judge j = {.run = run, .result = r};
    *r = (course_result){.characters = run->plan.characters,
                         .steps = (uint64_t)run->done * run->plan.characters,
                         .open_seconds = run->open_seconds,
                         .clearance = NEAR,
                         .first_bad_character = UINT32_MAX,
                         .first_bad_tick = UINT32_MAX};
    for (uint32_t i = 0; i < run->plan.characters; i++) {
        judge_character(&j, i);
    }
    double steps = fmax((double)r->steps, 1);
    r->deepest = fmax(-r->clearance, 0);
    r->progress = j.wished > 0 ? j.made / j.wished : 0;
    r->grounded /= steps;
    r->flips = j.changes / (steps * run->course->character.dt);
    return summarize_times(run, r) && summarize_queries(run, r);
}

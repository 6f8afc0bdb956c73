/* SPDX-License-Identifier: MIT
 * course_run.c: steps a method's characters and writes down where they are; course_judge.c looks at it afterwards, so
 * that the judge's own memory does not chase the method's out of the caches between steps. */
#include "course_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_clock.h"
#include "course_record.h"

static const double WARM_UP = 0.5; /* s, in which everybody lands and caches fill */
enum { BATCH_WARM_UP = 2 };        /* ticks: by then the tree, the triangles and the code are back in the caches */
enum { LONG = 100000 };            /* ns: no interruption is shorter that matters beside the clock's own cost */

static void wish(course_run *run, uint32_t tick)
{
    const method_character *who = &run->course->character;
    double scale = who->max_speed * 6 / 5; /* scene_wander asks for 5/6 of a speed */
    for (uint32_t i = 0; i < run->plan.characters; i++) {
        scene_wanderer *w = &run->wanderers[i];
        const tahr_input *input =
            run->course->level.planar ? scene_wander_next_side(w, who->dt) : scene_wander_next(w, who->dt);
        course_wish *out = course_wish_at(run, tick, i);
        out->velocity[0] = scale * input->move.x;
        out->velocity[1] = scale * input->move.y;
        out->jump = (int32_t)input->jump;
    }
}

/* What a long step took while the thread was not running, on a machine shared with others, is taken off it: the
 * processor time since the last look tells. */
typedef struct pause {
    uint64_t wall, cpu; /* ns, at the last look */
} pause;

static uint64_t without_pause(pause *p, uint64_t time)
{
    uint64_t wall = bench_nanoseconds(CLOCK_MONOTONIC), cpu = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    uint64_t passed = wall - p->wall, ran = cpu - p->cpu, away = passed > ran ? passed - ran : 0;
    *p = (pause){wall, cpu};
    return away < time ? time - away : time; /* longer: then it was not in this step */
}

static void step_all(course_run *run, uint32_t tick, uint32_t *times)
{
    const method *m = run->method;
    pause p = {bench_nanoseconds(CLOCK_MONOTONIC), bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID)};
    for (uint32_t i = 0; i < run->plan.characters; i++) {
        const course_wish *w = course_wish_at(run, tick, i);
        const double velocity[3] = {w->velocity[0], w->velocity[1], 0};
        uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
        m->step(run->self, i, velocity, w->jump);
        uint64_t time = bench_nanoseconds(CLOCK_MONOTONIC) - before;
        time = time < LONG ? time : without_pause(&p, time);
        times[i] = time < UINT32_MAX ? (uint32_t)time : UINT32_MAX;
    }
}

static int is_number(const double p[3])
{
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

/* Puts a character at the next start of the list. */
static void put(course_run *run, uint32_t i, uint32_t tick)
{
    const course *c = run->course;
    const double *p = c->spawns[run->spawned++ % c->spawn_count];
    run->method->place(run->self, i, p);
    course_place *at = course_place_at(run, tick + 1, i);
    memcpy(at->position, p, sizeof at->position);
    at->placed = 1;
}

static void look(course_run *run, uint32_t tick)
{
    int up = course_up(run->course);
    for (uint32_t i = 0; i < run->plan.characters; i++) {
        method_place place = {.grounded = 0};
        run->method->look(run->self, i, &place);
        course_place *end = course_end_at(run, tick, i);
        memcpy(end->position, place.position, sizeof end->position);
        end->grounded = place.grounded != 0;
        end->queries = place.queries;
        *course_place_at(run, tick + 1, i) = *end;
        if (!is_number(place.position) || place.position[up] < run->course->bottom) {
            end->left = 1;
            put(run, i, tick);
        }
    }
}

static int has_time(const course_run *run)
{
    return run->plan.seconds <= 0 || run->cpu_timed < run->plan.seconds;
}

uint32_t course_advance(course_run *run, uint32_t ticks)
{
    uint32_t done = 0, warm = (uint32_t)ceil(WARM_UP / run->course->character.dt);
    for (; done < ticks && run->done < run->plan.ticks && has_time(run); done++) {
        uint32_t *times = run->times + (size_t)run->timed_ticks * run->plan.characters;
        wish(run, run->done);
        uint64_t before = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
        step_all(run, run->done, times);
        double cpu = 1e-9 * (double)(bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID) - before);
        look(run, run->done++);
        if (done >= BATCH_WARM_UP && run->done > warm) {
            run->cpu_timed += cpu;
            run->timed_ticks++;
        }
    }
    return done;
}

void course_close(course_run *run)
{
    if (run) {
        if (run->self) {
            run->method->close(run->self);
        }
        free(run->wanderers);
        free(run->places);
        free(run->ends);
        free(run->wishes);
        free(run->times);
        free(run);
    }
}

static course_run *allocate(const course *c, const method *m, const course_plan *plan)
{
    course_run *run = calloc(1, sizeof *run);
    size_t all = (size_t)plan->characters * plan->ticks;
    if (!run) {
        return NULL;
    }
    run->course = c;
    run->method = m;
    run->plan = *plan;
    run->wanderers = calloc(plan->characters, sizeof *run->wanderers);
    run->places = calloc(all + plan->characters, sizeof *run->places);
    run->ends = calloc(all, sizeof *run->ends);
    run->wishes = calloc(all, sizeof *run->wishes);
    run->times = calloc(all, sizeof *run->times);
    if (!run->wanderers || !run->places || !run->ends || !run->wishes || !run->times) {
        course_close(run);
        return NULL;
    }
    return run;
}

course_run *course_open(const course *c, const method *m, const course_plan *plan, char *error)
{
    error[0] = 0;
    if (c->missing[0]) {
        snprintf(error, METHOD_ERROR, "%s", c->missing);
        return NULL;
    }
    course_run *run = plan->characters && plan->ticks ? allocate(c, m, plan) : NULL;
    if (!run) {
        snprintf(error, METHOD_ERROR, "no memory for %u characters and %u ticks", plan->characters, plan->ticks);
        return NULL;
    }
    uint64_t before = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    run->self = m->open(m, &c->level, &c->character, plan->characters, error);
    run->open_seconds = 1e-9 * (double)(bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID) - before);
    if (!run->self) {
        course_close(run);
        return NULL;
    }
    for (uint32_t i = 0; i < plan->characters; i++) {
        scene_wander_start(&run->wanderers[i], 1, i);
        course_place *at = course_place_at(run, 0, i);
        const double *p = c->spawns[run->spawned++ % c->spawn_count];
        m->place(run->self, i, p);
        memcpy(at->position, p, sizeof at->position);
    }
    return run;
}

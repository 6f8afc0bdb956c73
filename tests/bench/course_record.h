/* SPDX-License-Identifier: MIT
 * course_record.h: what a run writes down: between course_run.c and course_judge.c. */
#ifndef TAHR_BENCH_COURSE_RECORD_H
#define TAHR_BENCH_COURSE_RECORD_H

#include "course_run.h"
#include "scene_wander.h"

typedef struct course_place {
    double position[3];
    uint32_t queries;
    uint8_t grounded, left, placed; /* left: the level, or the numbers; placed: put there */
} course_place;

typedef struct course_wish {
    double velocity[2];
    int32_t jump;
} course_wish;

struct course_run {
    const course *course;
    const method *method;
    void *self;
    course_plan plan;
    scene_wanderer *wanderers;
    course_place *places; /* where steps start; one tick more than the plan has */
    course_place *ends;   /* where they end: the start of the next, unless somebody is put back */
    course_wish *wishes;
    uint32_t *times; /* ns, of timed ticks */
    uint32_t done, timed_ticks, spawned;
    double cpu_timed, open_seconds; /* s */
};

static inline course_place *course_place_at(const course_run *run, uint32_t tick, uint32_t i)
{
    return run->places + (size_t)tick * run->plan.characters + i;
}

static inline course_place *course_end_at(const course_run *run, uint32_t tick, uint32_t i)
{
    return run->ends + (size_t)tick * run->plan.characters + i;
}

static inline course_wish *course_wish_at(const course_run *run, uint32_t tick, uint32_t i)
{
    return run->wishes + (size_t)tick * run->plan.characters + i;
}

#endif

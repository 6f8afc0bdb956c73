/* SPDX-License-Identifier: MIT
 * course_run.h: one method on one course: the same starts, the same wishes, every step timed, every place judged. */
#ifndef TAHR_BENCH_COURSE_RUN_H
#define TAHR_BENCH_COURSE_RUN_H

#include "course.h"

typedef struct course_plan {
    uint32_t characters, ticks;
    double seconds; /* of processor time in timed steps, after which a run ends before its last tick; 0: never */
} course_plan;

/* left: of the levels, dungeon and nav_test have borders to walk off; elsewhere who left went through something. A
 * failure is a step that tunnelled, that ended embedded, or invalid. */
typedef struct course_result {
    uint32_t characters;
    uint32_t bad_characters;            /* with any failure */
    uint64_t steps, timed;              /* all were judged; warm-up is not timed */
    double ns_median, ns_p99, ns_worst; /* single steps, by the monotonic clock less its own cost and interruptions */
    double ns_cpu;                      /* mean, by the processor time of the thread, likewise */
    double open_seconds;                /* processor time of the method's open */
    double queries, queries_p99;        /* per step, 0 if the method does not tell */
    uint64_t tunnelled;                 /* steps whose way, centre to centre, leads through a triangle */
    uint64_t embedded;                  /* steps that end more than 1 mm deep */
    uint64_t invalid;                   /* steps that end at no number; put back at a start */
    uint64_t left;                      /* times that somebody fell out of the level; put back too */
    uint64_t stuck;                     /* stretches of 5 s of wishes that end within 5 cm of their start */
    double deepest;                     /* m; with the core line through a triangle: the radius */
    double clearance;                   /* m, least gap to a triangle, negative in it; at most 0.05 */
    double progress;                    /* level way along the wish / way wished */
    double flips;                       /* changes of what the method calls grounded, per second */
    double grounded;                    /* share of the steps */
    double first_bad[3];                /* where the first failure ended */
    uint32_t first_bad_character, first_bad_tick; /* UINT32_MAX: none */
} course_result;

typedef struct course_run course_run;

/* Opens the method and puts everybody at a start. course, its character and method stay as they are until course_close.
 * NULL and an explanation in error (capacity METHOD_ERROR) if it cannot. */
course_run *course_open(const course *c, const method *m, const course_plan *plan, char *error);

/* Steps everybody ticks times, or fewer at the end of the plan. What other methods did to the caches in the meantime is
 * not timed: the first two ticks of a batch never are, nor those of the first half second. Returns the ticks done. */
uint32_t course_advance(course_run *run, uint32_t ticks);

/* Looks at all that was done so far. Returns 0 without memory for it. */
int course_judge(const course_run *run, course_result *result);

void course_close(course_run *run);

#endif

/* SPDX-License-Identifier: MIT
 * puppet.h: a method that goes where a test says, for tests of the judge. */
#ifndef TAHR_TEST_PUPPET_H
#define TAHR_TEST_PUPPET_H

#include "course_run.h"

enum { PUPPETS = 4, PUPPET_TICKS = 700 };

typedef struct puppet puppet;

/* Where a character is after the step of its tick: at is where it was, and is changed. */
typedef void puppet_fn(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at);

struct puppet {
    puppet_fn *move;
    method_place places[PUPPETS];
    uint32_t ticks[PUPPETS];
    double dt;
    double wishes[PUPPETS][PUPPET_TICKS][2]; /* what it was asked for */
    int jumps[PUPPETS][PUPPET_TICKS];
};

/* The puppet is the caller's, and as large as this; the method points to it. */
method puppet_method(puppet *p, puppet_fn *move);

/* Runs PUPPETS characters for ticks steps and judges. */
void puppet_run(const course *c, puppet *p, puppet_fn *move, uint32_t ticks, course_result *result);

#endif

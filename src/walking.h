/* SPDX-License-Identifier: MIT
 * walking.h: one slice of walking. */
#ifndef TAHR_WALKING_H
#define TAHR_WALKING_H

#include "core.h"

/* Walks for at most `time` seconds. On flat ground 2 sweeps moving, 1 standing, 0 standing on a current floor. */
tahr__next tahr__walk(tahr__step *step, double time);

/* The same with one closed form, or one velocity, for the whole slice, config.slide_solver JOINT. */
tahr__next tahr__walk_slice(tahr__step *step, double time);

/* And in slices that each keep one velocity along the path, with STEPPED. */
tahr__next tahr__walk_in_steps(tahr__step *step, double time);

/* Turns the speed along the floor into the velocity of a body that leaves it: the level part of it. */
void tahr__leave_floor(tahr__step *step);

/* Follows the floor down, or rises off it, and says so when it was a step. Queries as for tahr__adjust_height. */
double tahr__settle(tahr__step *step);

#endif

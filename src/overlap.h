/* SPDX-License-Identifier: MIT
 * overlap.h: the sensors that a character is inside of, enters, leaves and passes.
 *
 * Modes say when they were where (tahr__time_*); what a mode does not say is taken for a straight and even way from the
 * place where its slice began to the one where it ended. The legs between are asked about only if a sweep met a sensor
 * there, or the character was inside of one: where no sensor is near nothing is asked. */
#ifndef TAHR_OVERLAP_H
#define TAHR_OVERLAP_H

#include "trail.h"

/* Asks about the legs that have been gone along. */
void tahr__sense(tahr__step *step);

/* A slice of time is over, which began where the last one ended: nothing of it is taken back any more. */
void tahr__end_slice(tahr__step *step);

/* The same at the end of a step, and about what changed without a motion. Only where there is a trail, like the two
 * above. */
void tahr__find_overlaps(tahr__step *step);

/* The character went here between two times (s from the start of the step). */
static inline void tahr__time_even(tahr__step *step, double begin, double end)
{
    if (step->trail) {
        tahr__trail_stamp(step, begin, end);
    }
}

/* The character fell here from now on for `time` seconds, with that velocity at the begin; bent: not as an arc goes. */
static inline void tahr__time_fall(tahr__step *step, vec3 velocity, double time, int bent)
{
    if (step->trail) {
        tahr__trail *trail = step->trail;
        uint32_t known = trail->timed;
        tahr__trail_stamp(step, step->time, step->time + time);
        if (!bent && trail->count == known + 1) {
            trail->legs[known].pace = TAHR__PACE_FALL;
            trail->legs[known].velocity = velocity;
        }
        if (trail->count > TAHR__LEGS / 2 && !trail->held) {
            tahr__sense(step);
        }
    }
}

/* A slice of time is over. */
static inline void tahr__time_slice(tahr__step *step)
{
    if (step->trail) {
        tahr__end_slice(step);
    }
}

#endif

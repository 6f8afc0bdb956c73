/* SPDX-License-Identifier: MIT
 * base_motion.h: riding and leaving bodies that move.
 *
 * The velocity of a character that stands on a body is relative to it. Bodies move before the characters' steps: a step
 * begins by carrying the character with its base, and what remains of it happens on a base at rest. So a jump, a fall
 * off the edge or a landing within the step go relative to the base too, and its velocity is handed over at the end. */
#ifndef TAHR_BASE_MOTION_H
#define TAHR_BASE_MOTION_H

#include "core.h"

void tahr__ride(tahr__step *step, double dt);
void tahr__note_base(tahr__step *step);
void tahr__step_off(tahr__step *step);
void tahr__board(tahr__step *step, uint32_t body);

/* Sweeps the character by motion, bent along what is in the way. Returns m that it fell short. At most 4 moves. */
double tahr__go_along(tahr__step *step, vec3 motion);

/* UpdateBasedMovement: carries the character with its base since the last step, and lets what moved into it push it. */
static inline void tahr__follow_base(tahr__step *step, double dt)
{
    if (step->world->has & TAHR__HAS_BASES) {
        tahr__ride(step, dt);
    }
}

/* Notes what it stands on at the end of the step. What left its base keeps the velocity that the base had. */
static inline void tahr__take_base(tahr__step *step)
{
    if (step->world->has & TAHR__HAS_BASES) {
        tahr__note_base(step);
    }
}

/* Leaves its floor: by a jump, off a ledge. */
static inline void tahr__part_from_base(tahr__step *step)
{
    if (step->world->has & TAHR__HAS_BASES && (step->state.lift_left > 0 || step->config->imparted_half_life > 0)) {
        tahr__step_off(step);
    }
}

/* Lands on a body: from here on the velocity is relative to it. */
static inline void tahr__land_on(tahr__step *step, uint32_t body)
{
    if (step->world->has & TAHR__HAS_BASES) {
        tahr__board(step, body);
    }
}

#endif

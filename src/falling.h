/* SPDX-License-Identifier: MIT
 * falling.h: one slice of falling. */
#ifndef TAHR_FALLING_H
#define TAHR_FALLING_H

#include "core.h"

/* Falls for at most `time` seconds, landing where a floor is met. One sweep per chord of the arc (1 at 60 Hz), one more
 * and the floor's when something is hit. */
tahr__next tahr__fall(tahr__step *step, double time);

/* How the velocity across up answers to a wish across up, between contacts. No query. */
static inline tahr__law tahr__arc_law(const tahr_config *c, vec3 wish)
{
    double size = length(wish);
    tahr__law law = {.wish = size > 0 ? scale(wish, 1.0 / size) : vec(0, 0, 0),
                     .speed = c->max_speed * min_of(size, 1),
                     .acceleration = c->acceleration * c->air_control,
                     .turn_friction = c->air_turn_friction};
    return law;
}

#endif

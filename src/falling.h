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

/* tahr__fall_advance without a hold, and without its division where the terminal speed is far, or reached. */
static inline double fall_for(double v0, double g, double terminal, double t, double *v)
{
    const double gained = g * t;
    if (v0 == -terminal) {
        *v = v0;
        return v0 * t;
    }
    if (v0 > -terminal && v0 + terminal > gained * (1 + 1e-9)) {
        *v = v0 - gained;
        return v0 * t - 0.5 * g * t * t;
    }
    return tahr__fall_advance(v0, g, terminal, 0, t, v);
}

#endif

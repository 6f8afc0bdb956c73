/* SPDX-License-Identifier: MIT
 * turning.h: which way is up, and which way the character faces. */
#ifndef TAHR_TURNING_H
#define TAHR_TURNING_H

#include "core.h"

/* Does the shape stand against gravity? Weightless up stays what it was. */
static inline int is_against_gravity(const tahr__pull *pull, vec3 up)
{
    return pull->size < 1e-6 || dot(pull->up, up) > 1 - 1e-15;
}

static inline int is_upright(const tahr__step *step)
{
    return is_against_gravity(step->pull, step->state.up);
}

/* Rights the shape against gravity, pivoting about its foot, or where that overlaps something about its centre; refused
 * with a flag where both do. The velocity of who walks turns with up, unless by more than a right angle. 1 or 2 contact
 * queries. */
void tahr__right(tahr__step *step);

/* Turns the orientation about up toward input.facing at turn_rate. No query. */
void tahr__face(tahr__step *step, double dt);

/* The same of a shape that may turn, by at most so many radians. */
void tahr__turn_toward(vec3 facing, double most, tahr_state *s);

#endif

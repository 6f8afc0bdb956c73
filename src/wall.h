/* SPDX-License-Identifier: MIT
 * wall.h: walls met in the air: what counts as one, how long it is touched, and the memory of the one jumped off.
 *
 * A wall that was jumped off, or one that faces the same way within 30 degrees, cannot be jumped off again before
 * ground, water, an edge, or the touch of a wall that faces another way: one wall is not climbed, two that face each
 * other are. */
#ifndef TAHR_WALL_H
#define TAHR_WALL_H

#include "core.h"

/* Less than this part of the full input against a wall is no push: 3 degrees off the direction along it. */
#define TAHR__PUSHING 0.05

/* Is a face with this contact normal a wall? No query. */
int tahr__is_wall(const tahr__step *step, vec3 normal);

/* Does the input push against it? */
static inline int pushes_into(const tahr__step *step, vec3 normal)
{
    return dot(step->input->move, normal) < -TAHR__PUSHING;
}

/* Is a wall touched that the input pushes against? Its facing is state.wall_normal. */
static inline int pushes_wall(const tahr__step *step)
{
    return step->state.flags & TAHR_STATE_WALL_TOUCHED && pushes_into(step, step->state.wall_normal);
}

/* m/s, of a fall now: along a wall that is pushed against no more than wall_slide_speed. */
static inline double fastest_fall(const tahr__step *step)
{
    const tahr_config *c = step->config;
    int slides = c->wall_slide_speed > 0 && pushes_wall(step);
    return slides ? min_of(c->terminal_speed, c->wall_slide_speed) : c->terminal_speed;
}

/* Level and of length 1. */
vec3 tahr__facing_of(const tahr__step *step, vec3 normal);

/* Notes the wall that a fall has met. No query. */
void tahr__touch_wall(tahr__step *step, const tahr_hit *hit);

/* Is there a wall within 1.5 skin of this position? One contact query. */
int tahr__is_at_wall(tahr__step *step, vec3 position);

/* The wall that was touched is farther away than that since `when` (s since the begin of the step). No query. */
void tahr__leave_wall(tahr__step *step, double when);

/* A wall within 1.5 skin that may be jumped off, or the one remembered if `remembers`. [out] wall: normal (level),
 * body, feature. Returns 0 if there is none. One contact query. */
int tahr__wall_to_jump_off(tahr__step *step, int remembers, tahr_hit *wall);

/* It is hung on. No query. */
void tahr__hold_wall(tahr__step *step, vec3 facing, uint32_t body, uint32_t feature);

/* It was jumped off. No query. */
void tahr__spend_wall(tahr__step *step, const tahr_hit *wall);

/* No query. */
void tahr__forget_walls(tahr__step *step);

#endif

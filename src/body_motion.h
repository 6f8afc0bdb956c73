/* SPDX-License-Identifier: MIT
 * body_motion.h: how bodies move, and where that takes what goes with them. */
#ifndef TAHR_BODY_MOTION_H
#define TAHR_BODY_MOTION_H

#include "core.h"

/* Motions are no faster than this (m/s): what they impart keeps a state valid. */
#define TAHR__FASTEST_BODY 1e4

/* How a body moves now. Returns TAHR_OK, TAHR_E_NOT_FOUND, TAHR_E_BACKEND. */
tahr_status tahr__body_motion(const tahr_world *world, uint32_t body, tahr_body_motion *motion);

/* m/s, of the point of a body that is `at` now, its conveyor with it; without the part of its turning if !turns. */
vec3 tahr__point_velocity(const tahr_body_motion *motion, vec3 at, int turns);

/* Where a point goes that is fixed to a body on its way between two poses. The same poses: exactly nowhere. In a world
 * of two dimensions nothing goes along z, whatever poses say. */
vec3 tahr__carried(const tahr_world *world, const tahr_pose *from, const tahr_pose *to, vec3 at);

/* A pose between two: straight, turning the shorter way. */
tahr_pose tahr__pose_between(const tahr_pose *from, const tahr_pose *to, double t);

/* Half the angle between two orientations, rad, 0..pi/2; axis: unit, or zero. */
double tahr__half_turn(tahr_quat from, tahr_quat to, vec3 *axis);

/* Does it turn otherwise than about up? Who stays upright is turned then, seen from the body. */
static inline int motion_tilts(const tahr__step *step, const tahr_body_motion *motion)
{
    return length_squared(step_level(step, motion->angular_velocity)) > 0;
}

static inline int quat_equal(tahr_quat a, tahr_quat b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

static inline int pose_equal(const tahr_pose *a, const tahr_pose *b)
{
    return vec_equal(a->position, b->position) && quat_equal(a->orientation, b->orientation);
}

#endif

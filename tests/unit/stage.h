/* SPDX-License-Identifier: MIT
 * stage.h: a rig whose bodies move: a ground, and platforms on it whose poses are functions of time. */
#ifndef STAGE_H
#define STAGE_H

#include "rig.h"

extern const tahr_quat STAGE_LEVEL;

/* A box, axis-aligned, movable. */
tahr_body_desc stage_box(tahr_vec3 at, tahr_vec3 half_extents);
/* The same, never moving: at z = 0 its top. */
tahr_body_desc stage_ground(void);
/* About z. */
tahr_quat stage_yaw(double angle);

/* A slab of 10 x 10 x 0.5 m whose top is at z = 0, over nothing; a character stands on it at (x, y). */
void stage_stand_on_slab(rig *r, const tahr_config *config, double x, double y);
/* The lowest point of the character. */
tahr_vec3 stage_foot(const rig *r);

/* Moves one body and steps the character. Fails the test on an error. */
void stage_step(rig *r, uint32_t body, tahr_pose pose, double dt);

/* Where a point goes that is fixed to a body between two poses: long double, apart from the library's own. */
tahr_vec3 stage_carried(const tahr_pose *from, const tahr_pose *to, tahr_vec3 at);

/* m, |a - b|. */
double stage_distance(tahr_vec3 a, tahr_vec3 b);

#endif

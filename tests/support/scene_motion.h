/* SPDX-License-Identifier: MIT
 * scene_motion.h: bodies of a scene that move: their poses as formulas of the time. */
#ifndef TAHR_TEST_SCENE_MOTION_H
#define TAHR_TEST_SCENE_MOTION_H

#include "scene_file.h"

/* Reads "path" of a body. Returns 0 if it is malformed: s->error says why. */
int scene_motion_read(scene *s, json_t *item, uint32_t body);

/* The pose of a body at a time, s, outside of any frame. */
tahr_pose scene_motion_pose(scene *s, uint32_t body, double time);

/* The same taken into a frame. */
tahr_pose scene_motion_pose_in(scene *s, uint32_t body, double time, const tahr_pose *frame);

/* Moves every body with a path from its pose at one time to that at a later one. */
tahr_status scene_motion_move(scene *s, tahr_world *world, const tahr_pose *frame, double from, double to);

#endif

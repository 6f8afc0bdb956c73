/* SPDX-License-Identifier: MIT
 * scene_wander.h: characters that wander: where they start and what they want, the same for the same seed. */
#ifndef TAHR_TEST_SCENE_WANDER_H
#define TAHR_TEST_SCENE_WANDER_H

#include <tahr/tahr.h>

#include "scene_mesh.h"

typedef struct scene_wanderer {
    uint64_t state, increment; /* of PCG32 */
    tahr_input input;
    double time_left; /* s, until it wants something else */
    uint32_t changes; /* of its mind so far */
} scene_wanderer;

tahr_bounds scene_mesh_bounds(const scene_mesh *mesh);

/* Places a character in free air just above walkable ground of the world, somewhere inside bounds. Up is +z, or +y
 * where config.plane is set: then in the plane z = 0. Returns 0 if no such place was found. */
int scene_wander_spawn(tahr_world *world, const tahr_config *config, const tahr_bounds *bounds, uint64_t *seed,
                       tahr_state *state);

void scene_wander_start(scene_wanderer *wanderer, uint64_t seed, uint32_t character);

/* What it wants during the next step of dt: one way at 5 of the preset's 6 m/s for 0.5 to 2 s, then another; 5 % of the
 * changes come with a jump. */
const tahr_input *scene_wander_next(scene_wanderer *wanderer, double dt);

/* The same in the plane x, y: to the left or to the right, and every other change comes with a jump. */
const tahr_input *scene_wander_next_side(scene_wanderer *wanderer, double dt);

#endif

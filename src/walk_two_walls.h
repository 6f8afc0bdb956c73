/* SPDX-License-Identifier: MIT
 * walk_two_walls.h: walking with config.slide_solver TWO_WALLS. */
#ifndef TAHR_WALK_TWO_WALLS_H
#define TAHR_WALK_TWO_WALLS_H

#include "core.h"

/* PhysWalking: walks in slices of tahr__time_step until the time is used up, or the floor ends. A slice on flat ground
 * asks 2 sweeps moving, 1 standing, 0 standing on a cached floor, and one more when the height is corrected. */
tahr__next tahr__walk_two_walls(tahr__step *step, double time);

/* GetLedgeMove: the level motion beside `delta` (to its right, else to its left) that has a floor under its end, from
 * `from`; zero if neither has. 1 to 4 sweeps. */
vec3 tahr__ledge_move(tahr__step *step, vec3 from, vec3 delta);

#endif

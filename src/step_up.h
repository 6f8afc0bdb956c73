/* SPDX-License-Identifier: MIT
 * step_up.h: getting onto low obstacles. */
#ifndef TAHR_STEP_UP_H
#define TAHR_STEP_UP_H

#include "move.h"

/* Tries to go on over what was hit, by up to step_height above the floor, along the level `motion`.
 * Returns the part of motion that was covered, in (0, 1], with the state's position and floor on the step; or 0 with
 * the state untouched. [in,out] lowered, or NULL: 1: something overhead did not let it rise as high, nor all the way,
 * and nothing was gone since: then a part of the way is no step. A refused tall wall costs 1 sweep, a step 3 or 4
 * sweeps and what the floor asks (TAHR__FLOOR_QUERIES), and with a face too steep to stand on 1 to 6 rays. */
double tahr__step_up(tahr__step *step, vec3 motion, const tahr_hit *obstacle, uint32_t *lowered);

/* The same by config.step_rule, for a motion that was blocked by `obstacle`: BY_CONTACT covers all of it or none. [out]
 * found_floor: 1 if the state's floor is that of the step. */
double tahr__step_up_at(tahr__step *step, vec3 motion, const tahr__swept *obstacle, int *found_floor);

/* StepUp, TAHR_STEP_BY_CONTACT: up by what of step_height is left above the floor, along `motion` and what slides
 * along, down again; judged by where the shape comes down, else everything is as before. Returns 1 if it went up. 3
 * sweeps, at most 2 safe moves more and a floor. */
int tahr__step_up_by_contact(tahr__step *step, vec3 motion, const tahr__swept *obstacle, int *found_floor);

#endif

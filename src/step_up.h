/* SPDX-License-Identifier: MIT
 * step_up.h: getting onto low obstacles. */
#ifndef TAHR_STEP_UP_H
#define TAHR_STEP_UP_H

#include "core.h"

/* Tries to go on over what was hit, by up to step_height above the floor, along the level `motion`.
 * Returns the part of motion that was covered, in (0, 1], with the state's position and floor on the step; or 0 with the
 * state untouched. A refused tall wall costs 1 sweep, a step 3 or 4 sweeps and what the floor asks (TAHR__FLOOR_QUERIES),
 * and with a face too steep to stand on 1 to 6 rays. */
double tahr__step_up(tahr__step *step, vec3 motion, const tahr_hit *obstacle);

#endif

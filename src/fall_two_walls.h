/* SPDX-License-Identifier: MIT
 * fall_two_walls.h: falling with config.slide_solver TWO_WALLS. */
#ifndef TAHR_FALL_TWO_WALLS_H
#define TAHR_FALL_TWO_WALLS_H

#include "core.h"

/* PhysFalling: falls in slices of tahr__time_step, which end at an apex (config.apex_substep), until the time is used
 * up or a floor is landed on. 1 sweep in free air; one slide and one adjustment at walls. */
tahr__next tahr__fall_two_walls(tahr__step *step, double time);

#endif

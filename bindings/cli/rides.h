/* SPDX-License-Identifier: MIT
 * rides.h: the part of the playground that moves, and the places for what is more than walking. */
#ifndef TAHR_CLI_RIDES_H
#define TAHR_CLI_RIDES_H

#include "level.h"

/* The pool, for which the flat floor leaves a hole. */
#define POOL_X0 2.0
#define POOL_X1 12.0
#define POOL_Y0 24.0
#define POOL_Y1 30.0
#define POOL_DEPTH 3.0
#define POOL_SURFACE (-0.2)

/* Lift, shuttle, turntable, press, pool, conveyor, crawl space, wall-jump shaft. */
void rides_add(struct level *level);

#endif

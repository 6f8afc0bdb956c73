/* SPDX-License-Identifier: MIT
 * turning.h: which way is up, and which way the character faces. */
#ifndef TAHR_TURNING_H
#define TAHR_TURNING_H

#include "core.h"

/* Rights the shape against gravity, pivoting about its foot; refused with a flag where it would overlap something. 0 or 1
 * contact query. */
void tahr__right(tahr__step *step);

/* Turns the orientation about up toward input.facing at turn_rate. No query. */
void tahr__face(tahr__step *step, double dt);

#endif

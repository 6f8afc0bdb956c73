/* SPDX-License-Identifier: MIT
 * move.h: moving the character's shape through the world without touching anything. */
#ifndef TAHR_MOVE_H
#define TAHR_MOVE_H

#include "core.h"

/* Sweeps the character by motion, keeping skin, and puts it where the sweep ended. An overlap at the start is resolved
 * first and the motion tried once more. [out] hit. Returns 1 if there was one. One sweep; at most
 * 2 + TAHR__DEPENETRATION_QUERIES. */
int tahr__move(tahr__step *step, vec3 motion, tahr_hit *hit);

/* Pushes the character out of everything that it overlaps, all at once. What cannot be resolved is halved between the
 * walls and reported as crushed. Returns 1 if nothing is overlapped any more. */
int tahr__depenetrate(tahr__step *step);

enum { TAHR__DEPENETRATION_ROUNDS = 4, TAHR__DEPENETRATION_QUERIES = 2 * TAHR__DEPENETRATION_ROUNDS + 1 };

#endif

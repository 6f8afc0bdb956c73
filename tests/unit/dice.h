/* SPDX-License-Identifier: MIT
 * dice.h: random vectors, the same everywhere. */
#ifndef DICE_H
#define DICE_H

#include "oracle.h"

#include <tahr/types.h>

/* Each coordinate uniform in [low, high). */
tahr_vec3 dice_vec(oracle_random *random, double low, double high);
/* A unit vector, uniform over the sphere. */
tahr_vec3 dice_direction(oracle_random *random);

#endif

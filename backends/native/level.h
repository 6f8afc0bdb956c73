/* SPDX-License-Identifier: MIT
 * level.h: a field of heights that is level all around, of more triangles than a cache takes. */
#ifndef TAHR_NATIVE_LEVEL_H
#define TAHR_NATIVE_LEVEL_H

#include "scene.h"

/* Of a cache that could not take all: is all of it one field, of one height? Then a walk over it (footing.h) knows
 * what it needs. Of the query: world, cache, frame, mask, start. */
void tahr__level_learn(tahr__query *query);

/* Takes the triangle at a place on such a field for the one under the spot. 1: the place is well inside of it. */
int tahr__level_find(const tahr__query *query, tahr_vec3 place);

#endif

/* SPDX-License-Identifier: MIT
 * flat.h: bytes as a scene of two dimensions, once in the plane and once drawn out along z for engines of space. */
#ifndef TAHR_FUZZ_FLAT_H
#define TAHR_FUZZ_FLAT_H

#include "scene.h"

/* Bodies that are no chains are the same in both; chains are ribbons in space, of both sides. */
typedef struct flat {
    scene plane, space;
} flat;

/* At most 8 boxes, spheres and capsules, and 4 chains. */
void flat_read(flat *f, bytes *b);

/* A query in space as one in the plane: level, with up along y. */
tahr_sweep flat_sweep(const tahr_sweep *query);

#endif

/* SPDX-License-Identifier: MIT
 * native_world.h: native worlds that several tests ask, and the shapes they ask with. */
#ifndef NATIVE_WORLD_H
#define NATIVE_WORLD_H

#include "common/vec.h"
#include "native_fixture.h"
#include "dice.h"

/* Initialises, opens, and fails the test if that fails. A cache if with_cache. */
void native_open(fixture *f, const tahr_body_desc *bodies, uint32_t count, int with_cache);
/* Closes, and fails the test if memory was left. */
void native_close(fixture *f);

/* A mesh of cells x cells squares of two triangles, corners at multiples of `cell` from the origin on. */
enum { NATIVE_CELLS = 24 };
typedef struct native_grid {
    double vertices[(NATIVE_CELLS + 1) * (NATIVE_CELLS + 1) * 3];
    uint32_t indices[NATIVE_CELLS * NATIVE_CELLS * 6];
} native_grid;

/* Its description, which points into it; height NULL: flat, at z = 0. */
tahr_body_desc native_grid_body(native_grid *grid, uint32_t cells, double cell, double (*height)(double x, double y));

/* A box, axis-aligned. */
tahr_body_desc native_box(tahr_vec3 at, tahr_vec3 half_extents);

/* Bodies of every kind over 12 m x 12 m of hills: body 0 the hills, 1 a turned box, 2 a sphere, 3 a movable lying
 * capsule, 4 a movable box, 5 a sensor. */
enum { NATIVE_HILLS = 6 };
void native_hills(native_grid *grid, tahr_body_desc bodies[NATIVE_HILLS]);

/* Kind 0 a sphere, 1 a capsule, 2 a box. */
enum { NATIVE_KINDS = 3 };
tahr_shape native_shape(int kind);

#endif

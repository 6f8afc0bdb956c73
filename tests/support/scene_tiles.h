/* SPDX-License-Identifier: MIT
 * scene_tiles.h: a side-scroller of a thousand bodies, of a plane and of space alike. */
#ifndef TAHR_TEST_SCENE_TILES_H
#define TAHR_TEST_SCENE_TILES_H

#include <tahr/backend.h>
#include <tahr/tahr.h>

/* 50 pieces of 16 m along x, 20 bodies each: flush tiles of 1 m, a wall to jump over, a one-way platform of two boxes,
 * stairs of 0.25 m, a slope of 27 degrees as a hull; and a wall at either end. Up is +y; all reach 5 m to both sides in
 * z. */
enum { SCENE_TILE_PIECES = 50, SCENE_TILE_BODIES = 20 * SCENE_TILE_PIECES + 2 };

typedef struct scene_tiles {
    tahr_body_desc bodies[SCENE_TILE_BODIES];
    tahr_body_desc with_meshes[SCENE_TILE_BODIES]; /* the same, slopes as meshes */
    double slope[24];                              /* the corners of every slope */
    tahr_bounds bounds;
} scene_tiles;

/* The bodies point into tiles. */
void scene_tiles_make(scene_tiles *tiles);

/* bodies, or with_meshes for a backend that holds no hulls. */
const tahr_body_desc *scene_tiles_for(const scene_tiles *tiles, const tahr_backend *backend);

#endif

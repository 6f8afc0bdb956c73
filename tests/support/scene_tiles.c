/* SPDX-License-Identifier: MIT
 * scene_tiles.c: see scene_tiles.h. */
#include "scene_tiles.h"

#include <string.h>

static const double PIECE = 16, DEPTH = 5, LOW = -1; /* m: long, to either side, lower edge of the ground */

static tahr_body_desc *box(tahr_body_desc *b, double left, double right, double low, double high)
{
    tahr_body_desc_init(b, sizeof *b, TAHR_BODY_BOX);
    b->half_extents = (tahr_vec3){(right - left) / 2, (high - low) / 2, DEPTH};
    b->pose.position = (tahr_vec3){(left + right) / 2, (low + high) / 2, 0};
    return b + 1;
}

/* From (14.5, 0.75) down to (16, 0), as a prism on the level of the tiles' lower edges. */
static void make_slope(double *corner)
{
    static const double outline[4][2] = {{14.5, -1}, {16, -1}, {16, 0}, {14.5, 0.75}};
    for (int i = 0; i < 8; i++) {
        *corner++ = outline[i / 2][0];
        *corner++ = outline[i / 2][1];
        *corner++ = i % 2 ? DEPTH : -DEPTH;
    }
}

static tahr_body_desc *piece(tahr_body_desc *b, const double *slope, double x)
{
    for (int i = 0; i < 12; i++) {
        b = box(b, x + i, x + i + 1, LOW, 0);
    }
    b = box(b, x + 3, x + 3.5, 0, 1.5);
    for (int i = 0; i < 2; i++) {
        b = box(b, x + 6 + 1.5 * i, x + 7.5 + 1.5 * i, 1.2, 1.4);
        b[-1].flags = TAHR_BODY_ONE_WAY;
    }
    for (int i = 0; i < 3; i++) {
        b = box(b, x + 12 + 0.5 * i, x + 12.5 + 0.5 * i, LOW, 0.25 * (i + 1));
    }
    b = box(b, x + 13.5, x + 14.5, LOW, 0.75);
    tahr_body_desc_init(b, sizeof *b, TAHR_BODY_HULL);
    b->vertices = slope;
    b->vertex_count = 8;
    b->pose.position.x = x;
    return b + 1;
}

static void turn_hulls_into_meshes(tahr_body_desc *bodies)
{
    /* Corner 2 i lies at z = -DEPTH, 2 i + 1 at +DEPTH; the outline runs counter-clockwise. */
    static const uint32_t faces[12][3] = {{1, 3, 5}, {1, 5, 7}, {0, 4, 2}, {0, 6, 4}, {0, 2, 3}, {0, 3, 1},
                                          {2, 4, 5}, {2, 5, 3}, {4, 6, 7}, {4, 7, 5}, {6, 0, 1}, {6, 1, 7}};
    for (int i = 0; i < SCENE_TILE_BODIES; i++) {
        tahr_body_desc *b = &bodies[i];
        if (b->type == TAHR_BODY_HULL) {
            b->type = TAHR_BODY_MESH;
            b->indices = faces[0];
            b->triangle_count = 12;
        }
    }
}

const tahr_body_desc *scene_tiles_for(const scene_tiles *tiles, const tahr_backend *backend)
{
    return backend->capabilities & TAHR_CAP_HULLS ? tiles->bodies : tiles->with_meshes;
}

void scene_tiles_make(scene_tiles *tiles)
{
    tahr_body_desc *b = tiles->bodies;
    memset(tiles, 0, sizeof *tiles);
    make_slope(tiles->slope);
    for (int i = 0; i < SCENE_TILE_PIECES; i++) {
        b = piece(b, tiles->slope, PIECE * i);
    }
    b = box(b, -1, 0, LOW, 20);
    box(b, PIECE * SCENE_TILE_PIECES, PIECE * SCENE_TILE_PIECES + 1, LOW, 20);
    memcpy(tiles->with_meshes, tiles->bodies, sizeof tiles->bodies);
    turn_hulls_into_meshes(tiles->with_meshes);
    tiles->bounds = (tahr_bounds){{0, LOW, 0}, {PIECE * SCENE_TILE_PIECES, 4, 0}};
}

/* SPDX-License-Identifier: MIT
 * bench_world.h: the worlds that are measured. */
#ifndef TAHR_BENCH_WORLD_H
#define TAHR_BENCH_WORLD_H

#include <tahr/tahr.h>

#include "scene_tiles.h"
#include "scene_backend.h"
#include "scene_mesh.h"
#include "scene_wander.h"

typedef struct bench_world {
    const char *name;
    uint32_t body_count;
    int planar; /* up is +y, and nobody leaves the plane z = 0 */
    tahr_body_desc one;
    scene_tiles *tiles; /* instead of it */
    scene_mesh mesh;    /* empty if there is none */
    tahr_bounds spawn;  /* where characters start */
    char missing[256];  /* why it cannot be measured, or empty */
} bench_world;

enum { BENCH_WORLDS = 7 };

/* "plane", "playground", "dungeon", "nav_test", "hills_500k", "grid_5cm", "tiles_2d"; NULL beyond the last. */
const char *bench_world_name(int index);

/* Makes one; it points into itself. Free it afterwards. */
void bench_world_make(bench_world *world, int index);
void bench_world_free(bench_world *world);

/* The backends that a world is measured on, those of a plane last and for planar worlds only; NULL beyond the last. */
const scene_backend *bench_world_backend(const bench_world *world, int index);

/* What is opened on a backend: body_count of them. */
const tahr_body_desc *bench_world_bodies(const bench_world *world, const scene_backend *backend);

/* PRECISE, or PLATFORMER in a plane. */
void bench_world_config(const bench_world *world, tahr_config *config);

/* What a wanderer of this world wants next. */
const tahr_input *bench_world_wish(const bench_world *world, scene_wanderer *wanderer, double dt);

#endif

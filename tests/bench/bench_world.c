/* SPDX-License-Identifier: MIT
 * bench_world.c: makes the worlds that are measured. Their sizes are those of the design's benchmark list. */
#include "bench_world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_level.h"

enum { PLANE = 0, HILLS = 4, GRID = 5, TILES = 6 };

static const char *const NAMES[BENCH_WORLDS] = {"plane",      "playground", "dungeon", "nav_test",
                                                "hills_500k", "grid_5cm",   "tiles_2d"};

const char *bench_world_name(int index)
{
    return index >= 0 && index < BENCH_WORLDS ? NAMES[index] : NULL;
}

static void make_mesh(bench_world *w, int index)
{
    if (index == HILLS) {
        scene_mesh_field(&w->mesh, 500, 500, 0.25, scene_hills);
    } else if (index == GRID) {
        scene_mesh_field(&w->mesh, 1000, 1000, 0.05, NULL);
    } else {
        scene_level_make(w->name, &w->mesh, w->missing);
    }
    if (w->mesh.failed) {
        snprintf(w->missing, sizeof w->missing, "out of memory");
    }
}

static void make_tiles(bench_world *w)
{
    w->planar = 1;
    w->tiles = malloc(sizeof *w->tiles);
    if (!w->tiles) {
        snprintf(w->missing, sizeof w->missing, "out of memory");
        return;
    }
    scene_tiles_make(w->tiles);
    w->body_count = SCENE_TILE_BODIES;
    w->spawn = w->tiles->bounds;
}

void bench_world_make(bench_world *w, int index)
{
    memset(w, 0, sizeof *w);
    w->name = NAMES[index];
    if (index == TILES) {
        make_tiles(w);
        return;
    }
    w->body_count = 1;
    if (index == PLANE) {
        tahr_body_desc_init(&w->one, sizeof w->one, TAHR_BODY_BOX);
        w->one.half_extents = (tahr_vec3){1000, 1000, 1};
        w->one.pose.position.z = -1;
        w->spawn = (tahr_bounds){{-50, -50, -1}, {50, 50, 1}};
        return;
    }
    make_mesh(w, index);
    scene_level_body(&w->mesh, &w->one);
    w->one.flags = index < HILLS ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u; /* levels of others, as the shell opens them */
    w->spawn = scene_mesh_bounds(&w->mesh);
}

void bench_world_free(bench_world *w)
{
    scene_mesh_free(&w->mesh);
    free(w->tiles);
}

const scene_backend *bench_world_backend(const bench_world *w, int index)
{
    int more = index - SCENE_BACKEND_COUNT;
    if (more < 0) {
        return &SCENE_BACKENDS[index];
    }
    return w->planar && more < SCENE_PLANAR_BACKEND_COUNT ? &SCENE_PLANAR_BACKENDS[more] : NULL;
}

const tahr_body_desc *bench_world_bodies(const bench_world *w, const scene_backend *backend)
{
    return w->tiles ? scene_tiles_for(w->tiles, backend->get()) : &w->one;
}

void bench_world_config(const bench_world *w, tahr_config *config)
{
    tahr_config_init(config, sizeof *config, w->planar ? TAHR_PRESET_PLATFORMER : TAHR_PRESET_PRECISE);
}

const tahr_input *bench_world_wish(const bench_world *w, scene_wanderer *wanderer, double dt)
{
    return w->planar ? scene_wander_next_side(wanderer, dt) : scene_wander_next(wanderer, dt);
}

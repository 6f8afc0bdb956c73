/* SPDX-License-Identifier: MIT
 * bench_world.c: makes the worlds that are measured. Their sizes are those of the design's benchmark list. */
#include "bench_world.h"

#include <stdio.h>
#include <string.h>

#include "scene_level.h"
#include "scene_wander.h"

static const char *const NAMES[BENCH_WORLDS] = {"plane", "playground", "dungeon", "nav_test", "hills_500k", "grid_5cm"};

const char *bench_world_name(int index)
{
    return index >= 0 && index < BENCH_WORLDS ? NAMES[index] : NULL;
}

static void make_mesh(bench_world *w, int index)
{
    if (index == 4) {
        scene_mesh_field(&w->mesh, 500, 500, 0.25, scene_hills);
    } else if (index == 5) {
        scene_mesh_field(&w->mesh, 1000, 1000, 0.05, NULL);
    } else {
        scene_level_make(w->name, &w->mesh, w->missing);
    }
    if (w->mesh.failed) {
        snprintf(w->missing, sizeof w->missing, "out of memory");
    }
}

void bench_world_make(bench_world *w, int index)
{
    memset(w, 0, sizeof *w);
    w->name = NAMES[index];
    if (index == 0) {
        tahr_body_desc_init(&w->body, sizeof w->body, TAHR_BODY_BOX);
        w->body.half_extents = (tahr_vec3){1000, 1000, 1};
        w->body.pose.position.z = -1;
        w->spawn = (tahr_bounds){{-50, -50, -1}, {50, 50, 1}};
        return;
    }
    make_mesh(w, index);
    scene_level_body(&w->mesh, &w->body);
    w->body.flags = index <= 3 ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u; /* levels of others, as the shell opens them */
    w->spawn = scene_mesh_bounds(&w->mesh);
}

void bench_world_free(bench_world *w)
{
    scene_mesh_free(&w->mesh);
}

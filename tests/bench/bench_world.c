/* SPDX-License-Identifier: MIT
 * bench_world.c: makes the worlds that are measured. Their sizes are those of the design's benchmark list. */
#include "bench_world.h"

#include <stdio.h>
#include <string.h>

#include "scene_obj.h"
#include "scene_wander.h"

static const char *const NAMES[BENCH_WORLDS] = {"plane", "playground", "dungeon", "nav_test", "hills_500k", "grid_5cm"};

const char *bench_world_name(int index)
{
    return index >= 0 && index < BENCH_WORLDS ? NAMES[index] : NULL;
}

static void make_mesh(bench_world *w, int index)
{
    char path[1024];
    if (index == 1) {
        scene_mesh_playground(&w->mesh);
    } else if (index == 4) {
        scene_mesh_field(&w->mesh, 500, 500, 0.25, scene_hills);
    } else if (index == 5) {
        scene_mesh_field(&w->mesh, 1000, 1000, 0.05, NULL);
    } else if (!scene_obj_find(w->name, path, sizeof path)) {
        snprintf(w->missing, sizeof w->missing, "not present");
    } else {
        scene_obj_read(path, &w->mesh, w->missing);
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
    tahr_body_desc_init(&w->body, sizeof w->body, TAHR_BODY_MESH);
    make_mesh(w, index);
    w->body.vertices = w->mesh.vertices;
    w->body.indices = w->mesh.indices;
    w->body.vertex_count = w->mesh.vertex_count;
    w->body.triangle_count = w->mesh.triangle_count;
    w->body.flags = index <= 3 ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u; /* levels of others, as the shell opens them */
    w->spawn = scene_mesh_bounds(&w->mesh);
}

void bench_world_free(bench_world *w)
{
    scene_mesh_free(&w->mesh);
}

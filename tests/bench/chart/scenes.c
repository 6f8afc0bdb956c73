/* SPDX-License-Identifier: MIT
 * scenes.c: hills of more and more triangles: what a step costs, what the world holds, how long it takes to open. Each
 * as native takes them, for the field of heights that they are, and as any mesh (no_fields): its tree. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <tahr/native.h>

#include "run.h"
#include "scene_level.h"
#include "scenes.h"
#include "walk.h"

static const uint32_t TRIANGLES[] = {1000, 10000, 100000, 500000, 1000000, 5000000};
enum { SIZES = sizeof TRIANGLES / sizeof TRIANGLES[0] };

static const double CELL = 0.5;   /* m, of the triangles of constant size */
static const double SIDE = 100.0; /* m, of the ground of constant area */

int chart_hills_make(bench_world *level, uint32_t triangles, int constant_area)
{
    int n = (int)(sqrt(triangles / 2.0) + 0.5);
    memset(level, 0, sizeof *level);
    level->name = "hills";
    level->body_count = 1;
    scene_mesh_field(&level->mesh, n, n, constant_area ? SIDE / n : CELL, scene_hills);
    scene_level_body(&level->mesh, &level->one);
    level->spawn = scene_mesh_bounds(&level->mesh);
    return !level->mesh.failed;
}

/* How the ground grows, and what native may see in it. */
typedef struct growth {
    const char *curve;
    int constant_area;
    uint32_t no_fields;
} growth;

static const growth GROWTHS[] = {
    {"constant size", 0, 0},
    {"constant size; as any mesh", 0, 1},
    {"constant area", 1, 0},
    {"constant area; as any mesh", 1, 1},
};
enum { GROWTH_COUNT = sizeof GROWTHS / sizeof GROWTHS[0] };

static void measure(chart_run *run, uint32_t triangles, const growth *g)
{
    char why[256] = "out of memory";
    bench_world level;
    chart_setting setting;
    chart_pace pace;
    chart_row row;
    const tahr_native_desc native = {.struct_size = sizeof native, .no_fields = g->no_fields};
    int ok = chart_hills_make(&level, triangles, g->constant_area);
    chart_setting_default(&level, &setting);
    memcpy(&setting.options, &native, sizeof native);
    chart_walk walk = {
        .level = &level, .setting = &setting, .walkers = run->budget->walkers, .seconds = run->budget->walk_seconds};
    ok = ok && chart_walk_run(&walk, &pace, why);
    if (ok) {
        chart_row_clear(&row);
        chart_walk_fill(&row, &pace, 60);
        row.scene = "hills";
        row.curve = row.setting = g->curve;
        row.value = level.mesh.triangle_count;
        row.bytes = (double)pace.bytes / level.mesh.triangle_count;
        row.build_seconds = pace.build_seconds;
        chart_run_write(run, &row);
    } else {
        chart_run_fail(run, "hills", why);
    }
    bench_world_free(&level);
}

void chart_scenes(chart_run *run)
{
    for (int k = 0; k < GROWTH_COUNT; k++) {
        for (int i = 0; i < SIZES && TRIANGLES[i] <= run->budget->max_triangles; i++) {
            char name[48];
            snprintf(name, sizeof name, "%u triangles", TRIANGLES[i]);
            if (chart_run_next(run, "hills", name)) measure(run, TRIANGLES[i], &GROWTHS[k]);
        }
    }
}

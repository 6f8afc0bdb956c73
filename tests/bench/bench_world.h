/* SPDX-License-Identifier: MIT
 * bench_world.h: the worlds that are measured. */
#ifndef TAHR_BENCH_WORLD_H
#define TAHR_BENCH_WORLD_H

#include <tahr/tahr.h>

#include "scene_mesh.h"

typedef struct bench_world {
    const char *name;
    tahr_body_desc body;
    scene_mesh mesh;   /* empty if the body is a box */
    tahr_bounds spawn; /* where characters start */
    char missing[256]; /* why it cannot be measured, or empty */
} bench_world;

enum { BENCH_WORLDS = 6 };

/* "plane", "playground", "dungeon", "nav_test", "hills_500k", "grid_5cm"; NULL beyond the last. */
const char *bench_world_name(int index);

/* Makes one. body points into mesh. Free it afterwards. */
void bench_world_make(bench_world *world, int index);
void bench_world_free(bench_world *world);

#endif

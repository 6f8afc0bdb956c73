/* SPDX-License-Identifier: MIT
 * course.h: levels on which methods are measured side by side: triangles, places to start at, who walks there. */
#ifndef TAHR_BENCH_COURSE_H
#define TAHR_BENCH_COURSE_H

#include "method.h"
#include "scene_mesh.h"
#include "scene_solid.h"

enum { COURSES = 10, COURSE_SPAWNS = 2048 };

typedef struct course {
    const char *name;
    method_level level;
    method_character character; /* may be changed before a run: the frame rate, say */
    scene_mesh mesh;            /* what level points to */
    scene_solid *solid;         /* the judge's own view of it, both sides of every triangle */
    double spawns[COURSE_SPAWNS][3];
    uint32_t spawn_count;
    double bottom;     /* m along up: who is lower has left the level */
    char missing[256]; /* why it cannot be walked, or empty */
} course;

/* "plane", "heights_10k", "stairs", "ramps", "playground", "dungeon", "nav_test", "hills_500k", "grid_5cm",
 * "side_2d"; NULL beyond the last. */
const char *course_name(int index);

/* Makes one; it points into itself. Free it afterwards, also if it is missing. */
void course_make(course *c, int index);

/* One made by the caller, whose mesh (taken over) it is: for tests. planar as in method_level, open: it has a sky that
 * every place to start at must see. */
void course_make_of(course *c, const char *name, scene_mesh *mesh, int planar, int open);
void course_free(course *c);

/* The axis along up: 2, or 1 of planar levels. */
int course_up(const course *c);

#endif

/* SPDX-License-Identifier: MIT
 * course_level.h: the levels of courses that are neither a file nor a plain field of heights. */
#ifndef TAHR_BENCH_COURSE_LEVEL_H
#define TAHR_BENCH_COURSE_LEVEL_H

#include "scene_mesh.h"

/* A convex polygon of n points (x, z), counter-clockwise seen from -y, drawn out from y0 to y1: closed, faces outward.
 */
void course_prism(scene_mesh *mesh, const double (*points)[2], int n, double y0, double y1);

/* Four walls around the origin that face inward. */
void course_yard(scene_mesh *mesh, double half_x, double half_y, double low, double high);

/* Flights of steps 0.1 to 0.35 m high, up and down, as one surface between walls. */
void course_stairs(scene_mesh *mesh);

/* Ramps of 20 to 60 degrees, walls that meet at 30 and 15 degrees, ceilings just above the head and down to it. */
void course_ramps(scene_mesh *mesh);

/* A side-scroller: steps, slopes, a pit, platforms and ceilings; up is +y, drawn out along z from -1 to 1. */
void course_side(scene_mesh *mesh);

#endif

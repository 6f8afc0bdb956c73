/* SPDX-License-Identifier: MIT
 * scene_mesh.h: triangle meshes made by rule, for scenes and the benchmark. Z is up, faces are counter-clockwise. */
#ifndef TAHR_TEST_SCENE_MESH_H
#define TAHR_TEST_SCENE_MESH_H

#include <stdint.h>

typedef struct scene_mesh {
    double *vertices;  /* 3 per vertex */
    uint32_t *indices; /* 3 per triangle */
    uint32_t vertex_count, triangle_count;
    uint32_t vertex_capacity, triangle_capacity;
    int failed; /* out of memory; what is there stays valid */
} scene_mesh;

typedef struct scene_stairs {
    int n;
    double rise, run, width, bevel, lead; /* m; bevel cuts the edge at 45 degrees, lead: floor before and behind */
} scene_stairs;

void scene_mesh_free(scene_mesh *mesh);
uint32_t scene_mesh_vertex(scene_mesh *mesh, double x, double y, double z);
void scene_mesh_triangle(scene_mesh *mesh, uint32_t a, uint32_t b, uint32_t c);

/* A line through (x, z) points, widened from y = -width/2 to width/2; faces the left hand of its direction: from left
 * to right it is a floor. */
void scene_mesh_profile(scene_mesh *mesh, const double (*points)[2], int count, double width);

/* A line through (x, y) points seen from above, raised from z0 to z1; faces the left hand of its direction. */
void scene_mesh_plan(scene_mesh *mesh, const double (*points)[2], int count, double z0, double z1);

/* n steps up along +x from x = 0, z = 0, as one profile. */
void scene_mesh_stairs(scene_mesh *mesh, const scene_stairs *stairs);

/* nx x ny cells of a size, centred on the origin, with height(x, y) or flat (NULL). */
void scene_mesh_field(scene_mesh *mesh, int nx, int ny, double cell, double (*height)(double x, double y));

/* Hills without a flight of steps in them: at most 37 degrees steep. */
double scene_hills(double x, double y);

/* 40 x 40 m between walls: floor cells of 1 m, stairs, ramps of 20 to 56 degrees, pillars, single steps. */
void scene_mesh_playground(scene_mesh *mesh);

/* An axis-parallel box, faces outward. */
void scene_mesh_box(scene_mesh *mesh, const double low[3], const double high[3]);

#endif

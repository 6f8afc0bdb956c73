/* SPDX-License-Identifier: MIT
 * course_level.c: makes levels by rule. */
#include "course_level.h"

#include <math.h>
#include <stddef.h>

static const double DEGREE = 3.14159265358979323846 / 180;

enum { MAX_POINTS = 128 };

/* A line that grows to the right. */
typedef struct line {
    double points[MAX_POINTS][2];
    int count;
} line;

static void go(line *l, double dx, double dz)
{
    double x = l->count ? l->points[l->count - 1][0] : 0, z = l->count ? l->points[l->count - 1][1] : 0;
    if (l->count < MAX_POINTS) {
        l->points[l->count][0] = x + dx;
        l->points[l->count++][1] = z + dz;
    }
}

static void go_steps(line *l, int n, double rise, double run)
{
    for (int i = 0; i < n; i++) {
        go(l, 0, rise);
        go(l, run, 0);
    }
}

static const double (*points_of(const line *l))[2]
{
    return (const double(*)[2])l->points;
}

void course_prism(scene_mesh *mesh, const double (*points)[2], int n, double y0, double y1)
{
    uint32_t base = mesh->vertex_count, count = (uint32_t)n;
    for (int i = 0; i < n; i++) {
        scene_mesh_vertex(mesh, points[i][0], y0, points[i][1]);
        scene_mesh_vertex(mesh, points[i][0], y1, points[i][1]);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = base + 2 * i, b = base + 2 * ((i + 1) % count);
        scene_mesh_triangle(mesh, a, a + 1, b + 1);
        scene_mesh_triangle(mesh, a, b + 1, b);
    }
    for (uint32_t i = 1; i + 1 < count; i++) {
        scene_mesh_triangle(mesh, base, base + 2 * i, base + 2 * i + 2);
        scene_mesh_triangle(mesh, base + 1, base + 2 * i + 3, base + 2 * i + 1);
    }
}

void course_yard(scene_mesh *mesh, double half_x, double half_y, double low, double high)
{
    const double corners[5][2] = {
        {-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}};
    scene_mesh_plan(mesh, corners, 5, low, high);
}

static void shift(scene_mesh *mesh, uint32_t from, double x, double y)
{
    for (uint32_t i = from; i < mesh->vertex_count; i++) {
        mesh->vertices[3 * (size_t)i] += x;
        mesh->vertices[3 * (size_t)i + 1] += y;
    }
}

void course_stairs(scene_mesh *mesh)
{
    static const struct {
        int n;
        double rise, run;
    } FLIGHTS[] = {{10, 0.1, 0.3}, {5, 0.2, 0.3}, {8, -0.25, 0.25}, {4, 0.35, 0.3}, {14, -0.1, 0.3}};
    line l = {.count = 0};
    go(&l, 0, 0);
    for (int i = 0; i < 5; i++) {
        go(&l, 2.5, 0);
        go_steps(&l, FLIGHTS[i].n, FLIGHTS[i].rise, FLIGHTS[i].run);
    }
    go(&l, 2.5, 0);
    double length = l.points[l.count - 1][0], inset = 0.3;
    scene_mesh_profile(mesh, points_of(&l), l.count, length);
    shift(mesh, 0, -0.5 * length, 0);
    course_yard(mesh, 0.5 * length - inset, 0.5 * length - inset, -0.5, 6);
}

/* A ramp up, a flat top 2 m high and the ramp down, its foot pushed 0.3 m into the ground. */
static void add_ramp(scene_mesh *mesh, double x, double y, double degrees)
{
    double top = 2, foot = -0.3, way = (top - foot) / tan(degrees * DEGREE);
    const double points[4][2] = {{x - 1 - way, foot}, {x + 1 + way, foot}, {x + 1, top}, {x - 1, top}};
    course_prism(mesh, points, 4, y - 1.5, y + 1.5);
}

/* A wall 0.3 m thick and 3 m high from (x, y) on, turned by an angle; it thickens to the left. */
static void add_wall(scene_mesh *mesh, double x, double y, double length, double degrees)
{
    static const double PROFILE[4][2] = {{0, -0.3}, {1, -0.3}, {1, 3}, {0, 3}};
    uint32_t from = mesh->vertex_count;
    double c = cos(degrees * DEGREE), s = sin(degrees * DEGREE);
    course_prism(mesh, PROFILE, 4, 0, 0.3);
    for (uint32_t i = from; i < mesh->vertex_count; i++) {
        double *v = mesh->vertices + 3 * (size_t)i, along = length * v[0], across = v[1];
        v[0] = x + c * along - s * across;
        v[1] = y + s * along + c * across;
    }
}

void course_ramps(scene_mesh *mesh)
{
    static const double SLOPES[5] = {20, 30, 45, 52, 60};
    /* 5 cm above the head of 1.8 m; and one that comes down to 1 m, so that it presses on who walks under it */
    static const double FLAT[4][2] = {{-17, 1.85}, {-11, 1.85}, {-11, 2.5}, {-17, 2.5}};
    static const double SLANTED[4][2] = {{5, 2.4}, {11, 1.0}, {11, 3.0}, {5, 3.0}};
    scene_mesh_field(mesh, 8, 8, 5, NULL);
    for (int i = 0; i < 5; i++) {
        add_ramp(mesh, -2, -14 + 7.0 * i, SLOPES[i]);
    }
    course_prism(mesh, FLAT, 4, -16, -8);
    course_prism(mesh, SLANTED, 4, -16, -8);
    for (int i = 0; i < 4; i++) { /* two walls each that open toward +x */
        double x = i < 2 ? 9 : -17, y = 1 + 9.0 * (i % 2), half = i % 2 ? 15 : 7.5;
        add_wall(mesh, x, y, 6, half);
        add_wall(mesh, x + 6 * cos(half * DEGREE), y - 6 * sin(half * DEGREE), 6, 180 - half);
    }
    course_yard(mesh, 19.5, 19.5, -0.5, 8);
}

/* What course_prism and profiles make has z up; the plane of a side-scroller is x, y. */
static void lay(scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        double *v = mesh->vertices + 3 * (size_t)i, y = v[1];
        v[1] = v[2];
        v[2] = -y;
    }
}

static void add_block(scene_mesh *mesh, double x, double z, double width, double height)
{
    const double points[4][2] = {{x, z}, {x + width, z}, {x + width, z + height}, {x, z + height}};
    course_prism(mesh, points, 4, -1, 1);
}

void course_side(scene_mesh *mesh)
{
    line l = {.count = 0};
    go(&l, 0, 8);
    go(&l, 0, -8); /* the wall at the left end */
    go(&l, 6, 0);
    go_steps(&l, 8, 0.25, 0.4);
    go(&l, 4, 0);
    go(&l, 4.4, -2); /* 24 degrees down */
    go(&l, 5, 0);
    go_steps(&l, 4, 0.35, 0.5);
    go(&l, 3, 0);
    go(&l, 1.4, -1.4); /* 45 degrees */
    go(&l, 3, 0);
    go(&l, 0, -0.8); /* a pit to jump out of, or to walk out of at the other side */
    go(&l, 3, 0);
    go(&l, 1.4, 0.8);
    for (int i = 0; i < 10; i++) { /* flush tiles */
        go(&l, 1, 0);
    }
    go(&l, 2, 3.3); /* 59 degrees: too steep */
    go(&l, 3, 0);
    go(&l, 0, -3.3);
    go(&l, 8, 0);
    go(&l, 0, 8);
    scene_mesh_profile(mesh, points_of(&l), l.count, 2);
    add_block(mesh, 18.5, 1.9, 3, 0.5); /* a ceiling 10 cm above the head */
    add_block(mesh, 33, 2.2, 2, 0.3);   /* over the pit */
    add_block(mesh, 38, -0.3, 2, 0.9);  /* to be jumped on */
    add_block(mesh, 43, 2.3, 3, 0.3);
    lay(mesh);
}

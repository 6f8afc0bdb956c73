/* SPDX-License-Identifier: MIT
 * course.c: the courses, and where on them characters start: places that a mesh alone decides, so that no method has a
 * say in them. */
#include "course.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "course_level.h"
#include "scene_level.h"
#include "scene_wander.h"

enum { PLANE, HEIGHTS, STAIRS, RAMPS, PLAYGROUND, DUNGEON, NAV_TEST, HILLS, GRID, SIDE };

static const char *const NAMES[COURSES] = {"plane",   "heights_10k", "stairs",     "ramps",    "playground",
                                           "dungeon", "nav_test",    "hills_500k", "grid_5cm", "side_2d"};

/* The character of the yardstick in the design notes: capsule 0.35 x 1.8 m, 5 m/s, 60 Hz, steps of 0.4 m, 50 degrees;
 * jump and gravity are those of TAHR_PRESET_PRECISE. */
static const method_character CHARACTER = {.radius = 0.35,
                                           .half_height = 0.9,
                                           .max_speed = 5,
                                           .jump_speed = 4.2,
                                           .gravity = 9.81,
                                           .step_height = 0.4,
                                           .walkable_angle = 50 * 3.14159265358979323846 / 180,
                                           .dt = 1.0 / 60};

static const double HALF_PLANE = 1000, PLANE_SPAWN = 50; /* m: nobody walks off it */
static const double DROP = 0.2, ROOM = 0.05;             /* m above the ground, and free around, at the start */
static const double BORDER = 0.8; /* m: under a sky nobody starts that near the outermost walls */
static const double LOST = 10;    /* m below all triangles */

const char *course_name(int index)
{
    return index >= 0 && index < COURSES ? NAMES[index] : NULL;
}

int course_up(const course *c)
{
    return c->level.planar ? 1 : 2;
}

static void make_plane(scene_mesh *m)
{
    double x = HALF_PLANE;
    scene_mesh_vertex(m, -x, -x, 0);
    scene_mesh_vertex(m, x, -x, 0);
    scene_mesh_vertex(m, x, x, 0);
    scene_mesh_vertex(m, -x, x, 0);
    scene_mesh_triangle(m, 0, 1, 2);
    scene_mesh_triangle(m, 0, 2, 3);
}

/* The walls stand 0.3 m inside the border of a field of this size, so that nothing gapes. */
static void make_field(scene_mesh *m, int nx, int ny, double cell, double (*height)(double x, double y))
{
    scene_mesh_field(m, nx, ny, cell, height);
    course_yard(m, 0.5 * nx * cell - 0.3, 0.5 * ny * cell - 0.3, -4, 8);
}

static void make_mesh(scene_mesh *m, int index, char *missing)
{
    if (index == PLANE) {
        make_plane(m);
    } else if (index == HEIGHTS) {
        make_field(m, 100, 50, 0.5, scene_hills);
    } else if (index == STAIRS) {
        course_stairs(m);
    } else if (index == RAMPS) {
        course_ramps(m);
    } else if (index == HILLS) {
        make_field(m, 500, 500, 0.25, scene_hills);
    } else if (index == GRID) {
        make_field(m, 1000, 1000, 0.05, NULL);
    } else if (index == SIDE) {
        course_side(m);
    } else {
        scene_level_make(NAMES[index], m, missing);
    }
}

/* splitmix64 (S. Vigna), as a number from 0 to 1 */
static double draw(uint64_t *seed)
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

static void corners_of(const scene_mesh *m, uint32_t triangle, const double *corners[3])
{
    for (int k = 0; k < 3; k++) {
        corners[k] = m->vertices + 3 * (size_t)m->indices[3 * (size_t)triangle + (size_t)k];
    }
}

/* Not of unit length: its length is twice the area. */
static void normal_of(const double *const c[3], double normal[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        normal[k] = (c[1][i] - c[0][i]) * (c[2][j] - c[0][j]) - (c[1][j] - c[0][j]) * (c[2][i] - c[0][i]);
    }
}

/* Sums of the areas of what is less than 45 degrees steep, each up to and with its triangle. */
static double *ground_sums(const course *c)
{
    double sum = 0, *sums = malloc(sizeof *sums * (c->mesh.triangle_count + 1));
    for (uint32_t i = 0; sums && i < c->mesh.triangle_count; i++) {
        const double *corners[3];
        double n[3];
        corners_of(&c->mesh, i, corners);
        normal_of(corners, n);
        double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        sum += n[course_up(c)] > 0.71 * size ? 0.5 * size : 0;
        sums[i] = sum;
    }
    return sums;
}

static uint32_t pick(const double *sums, uint32_t count, double value)
{
    uint32_t low = 0, high = count - 1;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (sums[middle] > value) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static tahr_vec3 raised(const course *c, const double p[3], double by)
{
    tahr_vec3 v = {p[0], p[1], p[2]};
    if (c->level.planar) {
        v.y += by;
    } else {
        v.z += by;
    }
    return v;
}

/* Room for the capsule, in front of what is nearest, and below the sky if there is one. */
static int is_free(const course *c, const double p[3], int open)
{
    const method_character *who = &c->character;
    double core = who->half_height - who->radius;
    tahr_vec3 low = raised(c, p, -core), high = raised(c, p, core);
    uint32_t nearest = UINT32_MAX;
    double limit = who->radius + 1, d = scene_solid_distance(c->solid, low, high, limit, &nearest);
    if (d < who->radius + ROOM || (open && scene_solid_crossed(c->solid, low, raised(c, p, 1000), NULL))) {
        return 0;
    }
    const double *corners[3];
    double n[3], side = 0;
    if (nearest == UINT32_MAX) {
        return 0;
    }
    corners_of(&c->mesh, nearest, corners);
    normal_of(corners, n);
    for (int k = 0; k < 3; k++) {
        side += n[k] * (p[k] - corners[0][k]);
    }
    return side > 0;
}

static void spot(const course *c, uint32_t triangle, uint64_t *seed, double p[3])
{
    const double *corners[3];
    double u = draw(seed), v = draw(seed);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    corners_of(&c->mesh, triangle, corners);
    for (int k = 0; k < 3; k++) {
        p[k] = corners[0][k] + u * (corners[1][k] - corners[0][k]) + v * (corners[2][k] - corners[0][k]);
    }
    p[2] = c->level.planar ? 0 : p[2];
    p[course_up(c)] += c->character.half_height + DROP;
}

static int is_inside(const course *c, const tahr_bounds *b, const double p[3])
{
    int x = p[0] > b->min.x + BORDER && p[0] < b->max.x - BORDER;
    return x && (c->level.planar || (p[1] > b->min.y + BORDER && p[1] < b->max.y - BORDER));
}

static void find_spawns(course *c, int open)
{
    uint64_t seed = 17;
    tahr_bounds bounds = scene_mesh_bounds(&c->mesh);
    uint32_t count = c->mesh.triangle_count;
    double *sums = ground_sums(c);
    for (int i = 0; sums && i < 20 * COURSE_SPAWNS && c->spawn_count < COURSE_SPAWNS; i++) {
        double *p = c->spawns[c->spawn_count];
        spot(c, pick(sums, count, draw(&seed) * sums[count - 1]), &seed, p);
        c->spawn_count += is_free(c, p, open) && (!open || is_inside(c, &bounds, p)) ? 1u : 0u;
    }
    free(sums);
    if (c->spawn_count == 0) {
        snprintf(c->missing, sizeof c->missing, "no place to start at");
    }
}

/* Triangles of 2000 m say nothing about where to be. */
static void find_spawns_of_plane(course *c)
{
    uint64_t seed = 17;
    for (; c->spawn_count < COURSE_SPAWNS; c->spawn_count++) {
        double *p = c->spawns[c->spawn_count];
        p[0] = PLANE_SPAWN * (2 * draw(&seed) - 1);
        p[1] = PLANE_SPAWN * (2 * draw(&seed) - 1);
        p[2] = c->character.half_height + DROP;
    }
}

/* Everything but the places to start at. */
static void finish(course *c, const char *name, int planar)
{
    const scene_mesh *m = &c->mesh;
    c->name = name;
    c->character = CHARACTER;
    c->level = (method_level){.name = name,
                              .vertices = m->vertices,
                              .indices = m->indices,
                              .vertex_count = m->vertex_count,
                              .triangle_count = m->triangle_count,
                              .planar = planar};
    if (!c->missing[0] && !m->failed && m->triangle_count > 0) {
        c->solid = scene_solid_open(m, 1);
    }
    if (!c->missing[0] && !c->solid) {
        snprintf(c->missing, sizeof c->missing, "out of memory");
    }
    c->bottom = HUGE_VAL;
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        c->bottom = fmin(c->bottom, m->vertices[3 * (size_t)i + (size_t)course_up(c)] - LOST);
    }
}

void course_make(course *c, int index)
{
    static const double BOX[6] = {-1000, -1000, -2, 1000, 1000, 0};
    memset(c, 0, sizeof *c);
    make_mesh(&c->mesh, index, c->missing);
    finish(c, NAMES[index], index == SIDE);
    if (c->missing[0]) {
        return;
    }
    if (index == PLANE) {
        c->level.box = BOX;
        find_spawns_of_plane(c);
    } else {
        find_spawns(c, index != DUNGEON && index != NAV_TEST);
    }
}

void course_make_of(course *c, const char *name, scene_mesh *mesh, int planar, int open)
{
    memset(c, 0, sizeof *c);
    c->mesh = *mesh;
    memset(mesh, 0, sizeof *mesh);
    finish(c, name, planar);
    if (!c->missing[0]) {
        find_spawns(c, open);
    }
}

void course_free(course *c)
{
    scene_solid_close(c->solid);
    c->solid = NULL;
    scene_mesh_free(&c->mesh);
}

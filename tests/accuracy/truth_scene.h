/* SPDX-License-Identifier: MIT
 * truth_scene.h: what the makers of truth have in common: bodies, shapes, random numbers, rounding. */
#ifndef TAHR_TRUTH_SCENE_H
#define TAHR_TRUTH_SCENE_H

#include <stdint.h>
#include <string.h>

#include "quad_distance.h"

enum { SPHERE, CAPSULE, CAPSULE_TILTED, BOX, BOX_TILTED, KINDS };
enum { EXACT, FINE, DYADIC, LATTICE }; /* how coordinates are rounded: not, 2^-20, 2^-12, 1/4 */
enum { MAX_VERTICES = 64, MAX_TRIANGLES = 64 };

typedef struct {
    double x, y, z;
} dvec;

typedef struct {
    dvec vertices[MAX_VERTICES];
    int triangles[MAX_TRIANGLES][3];
    int vertex_count, triangle_count;
    int solid; /* 1: the triangles bound a convex solid, counter-clockwise seen from outside */
    int flat;  /* 1: all triangles together are one convex polygon */
    int chain; /* 1: an outline drawn out along z, its corners first at -z, then at z; 2: a ring */
    int is_box;
    double half[3], quat[4]; /* of a box, about centre */
    dvec centre;
} mesh;

typedef struct {
    int type; /* TAHR_SHAPE_* */
    double radius, half_height, half_x, half_y, margin, quat[4];
    dvec position, up, motion;
} query;

static uint64_t seed;

static double uniform(double lo, double hi)
{
    uint64_t z = seed += 0x9E3779B97F4A7C15u; /* splitmix64 */

    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return lo + (hi - lo) * (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static int below(int n)
{
    return (int)uniform(0, n);
}
static dvec add(dvec a, dvec b)
{
    return (dvec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static dvec scaled(dvec a, double s)
{
    return (dvec){a.x * s, a.y * s, a.z * s};
}
static dvec sub(dvec a, dvec b)
{
    return add(a, scaled(b, -1));
}
static double dot(dvec a, dvec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static dvec cross(dvec a, dvec b)
{
    return (dvec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static dvec unit(dvec a)
{
    return scaled(a, 1 / sqrt(dot(a, a)));
}
static dvec in_cube(double r)
{
    return (dvec){uniform(-r, r), uniform(-r, r), uniform(-r, r)};
}

static dvec direction(void)
{
    dvec d;

    do
        d = in_cube(1);
    while (dot(d, d) > 1 || dot(d, d) < 0.01);
    return unit(d);
}

static double rounded(double x, int rounding)
{
    double grid = rounding == FINE ? 0x1p-20 : rounding == DYADIC ? 0x1p-12 : 0.25;
    return rounding == EXACT ? x : floor(x / grid + 0.5) * grid;
}

static dvec round_vec(dvec v, int rounding)
{
    return (dvec){rounded(v.x, rounding), rounded(v.y, rounding), rounded(v.z, rounding)};
}

static vec wide(dvec v)
{
    return (vec){v.x, v.y, v.z};
}
static dvec narrow(vec v)
{
    return (dvec){(double)v.x, (double)v.y, (double)v.z};
}

static vec rotate(const double q[4], vec v)
{
    vec u = {q[0], q[1], q[2]};
    return vadd(v, vmul(vadd(vmul(vcross(u, v), q[3]), vcross(u, vcross(u, v))), 2));
}

static core core_of(const query *q)
{
    core k = {wide(q->position), {{0, 0, 0}}, 0};

    if (q->type == 2 && q->half_height > q->radius) {
        k.axes = 1;
        k.axis[0] = vmul(wide(q->up), (real)q->half_height - q->radius);
    } else if (q->type == 3) {
        k.axes = 3;
        k.axis[0] = rotate(q->quat, (vec){q->half_x, 0, 0});
        k.axis[1] = rotate(q->quat, (vec){0, q->half_y, 0});
        k.axis[2] = rotate(q->quat, (vec){0, 0, q->half_height});
    }
    return k;
}

static triangle triangle_of(const mesh *m, int i)
{
    const int *t = m->triangles[i];
    return (triangle){{wide(m->vertices[t[0]]), wide(m->vertices[t[1]]), wide(m->vertices[t[2]])}};
}

static int vertex(mesh *m, double x, double y, double z)
{
    m->vertices[m->vertex_count] = (dvec){x, y, z};
    return m->vertex_count++;
}

static void face(mesh *m, int a, int b, int c)
{
    int *t = m->triangles[m->triangle_count++];
    t[0] = a, t[1] = b, t[2] = c;
}

static void grid(mesh *m, int n, double cell, double height)
{
    int first = m->vertex_count;

    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            vertex(m, (j - n / 2.0) * cell, (i - n / 2.0) * cell, rounded(uniform(0, height), DYADIC));
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            int a = first + i * (n + 1) + j, c = a + n + 2;
            face(m, a, a + 1, c);
            face(m, a, c, c - 1);
        }
    }
}

#endif

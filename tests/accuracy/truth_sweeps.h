/* SPDX-License-Identifier: MIT
 * truth_sweeps.h: the cases of make_truth.c: shapes, triangles, small meshes, and sweeps aimed at their features. */
#ifndef TAHR_TRUTH_SWEEPS_H
#define TAHR_TRUTH_SWEEPS_H

#include "truth_scene.h"

enum { AIMED, GRAZING, TOUCHING, OVERLAPPING, ANYWHERE, MIXED };

typedef struct {
    const char *name;
    int per_kind, placement, rounding;
    double size_min, size_max, aspect, offset, motion_max;
} family;

static void make_shape(query *q, int kind, int rounding)
{
    static const double margins[] = {0x1p-7, 0x1p-7, 0x1p-7, 0x1p-10, 0x1p-4};
    int grid = rounding == LATTICE;
    dvec axis = direction();
    double angle = kind == BOX && (grid || below(3) == 0) ? 0 : uniform(0, 3);

    memset(q, 0, sizeof *q);
    q->up = (dvec){0, 0, 1};
    q->quat[3] = 1;
    q->margin = grid ? 0x1p-6 : margins[below(5)];
    if (kind <= CAPSULE_TILTED && below(6) == 0) q->margin = 0;
    /* A normal cannot be better than rounding over distance: no bare box next to vertices that floats must round. */
    if (kind >= BOX && rounding == EXACT && q->margin < 0x1p-7) q->margin = 0x1p-7;
    q->radius = kind >= BOX ? 0 : grid ? 0.25 * (1 + below(2)) : rounded(uniform(0.1, 0.5), DYADIC);
    q->type = kind == SPHERE ? 1 : kind >= BOX ? 3 : 2;
    q->half_height = kind == SPHERE ? q->radius : q->radius + (grid ? 0.5 : rounded(uniform(0.1, 0.6), DYADIC));
    if (kind >= BOX) {
        q->half_x = grid ? 0.25 : rounded(uniform(0.1, 0.5), DYADIC);
        q->half_y = grid ? 0.5 : rounded(uniform(0.1, 0.5), DYADIC);
        if (kind == BOX) axis = (dvec){0, 0, 1};
        q->quat[0] = axis.x * sin(angle / 2), q->quat[1] = axis.y * sin(angle / 2);
        q->quat[2] = axis.z * sin(angle / 2), q->quat[3] = cos(angle / 2);
    }
    if (kind == BOX_TILTED) q->up = narrow(rotate(q->quat, (vec){0, 0, 1}));
    if (kind == CAPSULE_TILTED) q->up = grid ? (dvec){1, 0, 0} : direction();
}

static double longest_squared(const dvec v[3])
{
    double longest = 0;

    for (int i = 0; i < 3; i++) {
        dvec edge = sub(v[(i + 1) % 3], v[i]);
        if (dot(edge, edge) > longest) longest = dot(edge, edge);
    }
    return longest;
}

static void make_triangle(mesh *m, const family *f)
{
    double size = uniform(f->size_min, f->size_max), aspect;
    dvec v[3], along;

    m->vertex_count = 3;
    m->triangle_count = 1;
    for (int i = 0; i < 3; i++)
        m->triangles[0][i] = i;
    do {
        for (int i = 0; i < 3; i++)
            v[i] = in_cube(size / 2);
        along = sub(v[1], v[0]);
        if (f->aspect > 0) {
            dvec side = unit(cross(along, direction()));
            double height = sqrt(dot(along, along)) / (f->aspect * exp(uniform(-log(100), 0)));
            v[2] = add(add(v[0], scaled(along, uniform(-0.2, 1.2))), scaled(side, height));
        }
        for (int i = 0; i < 3; i++)
            m->vertices[i] = v[i] = round_vec(v[i], f->rounding);
        along = cross(sub(v[1], v[0]), sub(v[2], v[0]));
        aspect = longest_squared(v) / (sqrt(dot(along, along)) + 1e-30);
    } while (aspect > (f->aspect > 0 ? f->aspect * 2 : 30));
}

/* A unit normal of a feature of the triangle (0 vertex, 1 edge, 2 face), half the time one of the core too. */
static dvec pick_normal(const triangle *t, const core *k, int feature)
{
    dvec v[3] = {narrow(t->v[0]), narrow(t->v[1]), narrow(t->v[2])};
    int e = below(3), flip = below(2), lean = k->axes > 0 && below(2);
    dvec edge = sub(v[(e + 1) % 3], v[e]), n = direction(), axis = k->axes ? narrow(k->axis[below(k->axes)]) : n;

    if (feature == 2) return scaled(unit(cross(edge, sub(v[(e + 2) % 3], v[e]))), flip ? -1 : 1);
    if (feature == 0) {
        if (lean && k->axes == 3 && flip) return unit(axis);
        return lean ? unit(cross(axis, n)) : n;
    }
    if (!lean || dot(cross(edge, axis), cross(edge, axis)) < 1e-12 * dot(edge, edge) * dot(axis, axis)) axis = n;
    n = unit(cross(edge, axis));
    return dot(n, sub(v[(e + 2) % 3], v[e])) > 0 ? scaled(n, -1) : n;
}

/* The position at which the core's extreme point along -n lies at the given distance over the triangle's along n. */
static dvec pose_over(const triangle *t, const core *k, dvec n, double distance)
{
    dvec point = {0, 0, 0}, corner = {0, 0, 0};
    double top = -1e30, sum = 0;
    dvec v[3] = {narrow(t->v[0]), narrow(t->v[1]), narrow(t->v[2])};

    for (int i = 0; i < 3; i++)
        if (dot(v[i], n) > top) top = dot(v[i], n);
    for (int i = 0; i < 3; i++) {
        double w = dot(v[i], n) > top - 1e-9 * sqrt(longest_squared(v)) ? uniform(0, 1) : 0;
        point = add(point, scaled(v[i], w));
        sum += w;
    }
    for (int i = 0; i < k->axes; i++) {
        dvec a = narrow(k->axis[i]);
        double s = dot(a, n);
        corner = add(corner, scaled(a, fabs(s) < 1e-9 ? uniform(-1, 1) : s > 0 ? -1 : 1));
    }
    return sub(add(scaled(point, 1 / sum), scaled(n, distance)), corner);
}

static void place(query *q, const mesh *m, const family *f, int index)
{
    static const double misses[] = {-1e-3, -1e-4, -1e-5, -3e-6, 3e-6, 1e-5, 1e-4, 1e-3};
    int placement = f->placement == MIXED ? index % 4 == 3 ? ANYWHERE : AIMED : f->placement;
    triangle t = triangle_of(m, below(m->triangle_count));
    core k = core_of(q);
    dvec n = pick_normal(&t, &k, index % 3), way = direction(), start;
    double rho = q->radius + q->margin, length = uniform(0.05, f->motion_max), early = uniform(0.02, 1.1);

    if (placement == ANYWHERE) {
        double near = f->size_max > 10 ? 2 : f->size_max;
        start = add(pose_over(&t, &k, n, rho), in_cube(near));
        q->motion = add(in_cube(f->motion_max / 2),
                        scaled(sub(narrow(t.v[below(3)]), start), f->size_max > 10 ? 0 : uniform(0, 1.5)));
    } else if (placement == GRAZING) {
        q->motion = scaled(unit(cross(n, way)), length);
        start = sub(pose_over(&t, &k, n, rho + misses[index % 8]), scaled(q->motion, uniform(0.2, 0.8)));
    } else if (placement == AIMED) {
        if (dot(way, n) > 0) way = scaled(way, -1);
        if (index % 5 == 0) way = unit(add(scaled(way, 0.01), scaled(n, -1)));
        q->motion = scaled(way, length);
        start = sub(pose_over(&t, &k, n, rho), scaled(q->motion, early));
    } else {
        double gap = placement == OVERLAPPING ? -q->radius * uniform(0.001, 0.6) : q->margin * uniform(0.05, 0.98);
        if (fabs(dot(way, n)) < 0.02) way = unit(add(way, n));
        q->motion = scaled(way, length);
        start = pose_over(&t, &k, n, q->radius + gap);
    }
    q->position = round_vec(start, f->rounding);
    q->motion = round_vec(q->motion, f->rounding);
}

static void stairs(mesh *m)
{
    for (int i = 0; i < 5; i++) {
        double x = i * 0.25, z = i * 0.25;
        int a = vertex(m, x, -1, z), b = vertex(m, x, 1, z), c = vertex(m, x, 1, z + 0.25),
            d = vertex(m, x, -1, z + 0.25);
        int e = vertex(m, x + 0.25, 1, z + 0.25), g = vertex(m, x + 0.25, -1, z + 0.25);
        face(m, a, c, b), face(m, a, d, c), face(m, d, e, c), face(m, d, g, e);
    }
}

static void corner(mesh *m)
{
    int o = vertex(m, 0, 0, 0), x = vertex(m, 3, 0, 0), y = vertex(m, 0, 3, 0), z = vertex(m, 0, 0, 3);
    int xy = vertex(m, 3, 3, 0), yz = vertex(m, 0, 3, 3), zx = vertex(m, 3, 0, 3);

    face(m, o, x, xy), face(m, o, xy, y), face(m, o, y, yz), face(m, o, yz, z), face(m, o, z, zx), face(m, o, zx, x);
}

/* Triangles of 1/64 m at the hub and 2 m along: slivers that share a vertex. */
static void fan(mesh *m)
{
    int hub = vertex(m, 0, 0, 0), last = vertex(m, 2, -0.25, 0.25);

    for (int i = 1; i <= 24; i++) {
        int next = vertex(m, 2, -0.25 + i * 0x1p-6, 0.25 + rounded(uniform(0, 0.02), DYADIC));
        face(m, hub, last, next);
        last = next;
    }
}

static void soup(mesh *m)
{
    for (int i = 0; i < 18; i++) {
        dvec c = in_cube(1.5), v[3];
        for (int j = 0; j < 3; j++)
            v[j] = round_vec(add(c, in_cube(0.7)), DYADIC);
        int a = vertex(m, v[0].x, v[0].y, v[0].z), b = vertex(m, v[1].x, v[1].y, v[1].z);
        face(m, a, b, vertex(m, v[2].x, v[2].y, v[2].z));
    }
}

/* Resting within the margin on a flat grid, moving along it, off it or into it: nothing but the floor may be felt. */
static void place_resting(query *q, int index)
{
    double low = q->type == 3 ? q->half_height : q->up.z == 1 ? q->half_height : q->radius;

    q->margin = 0x1p-6;
    q->position = (dvec){rounded(uniform(-0.7, 0.7), index % 2 ? DYADIC : LATTICE), rounded(uniform(-0.7, 0.7), DYADIC),
                         low + (index % 4 < 2 ? 0x1p-6 : 0x1p-8)};
    q->motion = round_vec((dvec){uniform(-1, 1), index % 3 ? uniform(-1, 1) : 0, 0}, DYADIC);
    q->motion.z = index % 5 == 3 ? 0.125 : index % 5 == 4 ? -0.125 : 0;
}

#endif

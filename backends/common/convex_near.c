/* SPDX-License-Identifier: MIT
 * convex_near.c: signed distances and contact normals of any two convex shapes. */
#include "convex_near.h"

/* Nearer than this the direction between the nearest points is rounding: the way out is taken instead. */
#define TOUCHING 1e-10
/* The air between two that have left each other, so that there is a nearest point. */
#define LEFT 1e-6
/* Of the faces of hulls so many are looked at for the shortest way out. */
enum { GUESSED_FACES = 32, GUESSES = 2 * GUESSED_FACES + 16 };

tahr_vec3 tahr__convex_triangle_normal(const tahr_vec3 v[3])
{
    tahr_vec3 n = v_cross(v_sub(v[1], v[0]), v_sub(v[2], v[0]));
    return v_dot(n, n) > 0 ? v_unit(n) : v_make(0, 0, 1);
}

/* --- Out of each other --- */

typedef struct guesses {
    tahr_vec3 normal[GUESSES];
    uint32_t count;
} guesses;

static void guess(guesses *g, tahr_vec3 direction)
{
    double length = v_length(direction);
    if (length > 0 && g->count < GUESSES) g->normal[g->count++] = v_scale(direction, 1 / length);
}

/* Directions in which a shape is likely to be left: along its axes, across its side, and toward where the other is. */
static void guess_of(guesses *g, const tahr__convex *c, const tahr__hull_planes *planes, tahr_vec3 other)
{
    uint32_t axes = c->kind == TAHR__CONVEX_ELLIPSOID ? 3 : c->kind == TAHR__CONVEX_SUM ? c->count : 1;
    tahr_vec3 apart = v_sub(other, c->centre), axis = c->axis[0], radial;
    double length2 = v_dot(axis, axis);

    for (uint32_t i = 0; i < axes && c->kind != TAHR__CONVEX_POINTS; i++)
        guess(g, c->axis[i]);
    if (length2 > 0 && c->radius > 0) {
        radial = v_mad(apart, axis, -v_dot(apart, axis) / length2);
        guess(g, radial);
        if (c->kind == TAHR__CONVEX_CONE && v_dot(radial, radial) > 0)
            guess(g, v_mad(v_scale(axis, c->radius), v_unit(radial), 2 * length2));
    }
    for (uint32_t i = 0; planes && i < planes->count && i < GUESSED_FACES; i++)
        guess(g, c->turn ? m_apply(c->turn, planes->normals[i]) : planes->normals[i]);
}

static double size_of(const tahr__convex *c)
{
    double size = 0;
    for (int i = 0; i < 3; i++) {
        tahr_vec3 n = v_make(i == 0, i == 1, i == 2);
        size = d_max(size, tahr__convex_extent(c, n) + tahr__convex_extent(c, v_scale(n, -1)));
    }
    return 0.5 * size;
}

/* The way for the shape out of the piece: of a mesh to the front or back of the triangle, else the shortest that is
 * found. */
static double depth_of(const tahr__convex_side *shape, const tahr__convex_side *piece, tahr_vec3 *normal)
{
    const tahr__convex *a = &shape->convex, *b = &piece->convex;
    guesses g = {.count = 0};
    double size = size_of(b), own = size_of(a);

    if (piece->ways_out) {
        tahr_vec3 front = tahr__convex_triangle_normal(b->points), back = v_scale(front, -1);
        double depth = tahr__convex_way(a, b, front);
        *normal = front;
        if (!(piece->ways_out & 2)) return depth;
        double other = tahr__convex_way(a, b, back);
        if (other < depth) *normal = back;
        if (!(piece->ways_out & 4)) return d_min(depth, other);
        guess(&g, front);
    }
    guess_of(&g, b, piece->planes, a->centre);
    guess_of(&g, a, shape->planes, b->centre);
    guess(&g, v_sub(a->centre, b->centre));
    if (own > 0 && (own < size || !(size > 0))) size = own;
    return tahr__convex_leave(a, b, g.normal, g.count, size, normal);
}

void tahr__convex_touch(const tahr__convex *a, const tahr__convex *b, double depth, tahr_vec3 normal, tahr__gap *gap)
{
    tahr__convex moved = *a;

    moved.centre = v_mad(moved.centre, normal, depth + LEFT);
    tahr__convex_distance(&moved, b, normal, gap);
}

/* --- Nearest points --- */

/* Which part of a triangle lies nearest. What faces the shape within the accuracy of directions is the face, wherever
 * on it the nearest point was found: of a flat base it is any. */
static uint32_t part_of(const tahr__convex *triangle, const tahr__gap *gap)
{
    tahr_vec3 n = tahr__convex_triangle_normal(triangle->points), tilt;
    const double *w = gap->weight;
    uint32_t least = w[0] <= w[1] ? (w[0] <= w[2] ? 0 : 2) : (w[1] <= w[2] ? 1 : 2), a = (least + 1) % 3,
             b = (least + 2) % 3;

    tilt = v_sub(gap->normal, v_dot(n, gap->normal) < 0 ? v_scale(n, -1) : n);
    if (v_dot(tilt, tilt) < TAHR__SAME_DIRECTION * TAHR__SAME_DIRECTION) return TAHR__FACE;
    if (w[a] < TAHR__SAME_DIRECTION) return TAHR__CORNER + b;
    return w[b] < TAHR__SAME_DIRECTION ? TAHR__CORNER + a : TAHR__EDGE + a;
}

/* A triangle most often faces the shape. */
static tahr_vec3 likely_normal(const tahr__convex_side *piece, tahr_vec3 centre)
{
    if (!piece->ways_out) return v_make(0, 0, 0);
    tahr_vec3 n = tahr__convex_triangle_normal(piece->convex.points);
    return v_dot(n, v_sub(centre, piece->convex.points[0])) < 0 ? v_scale(n, -1) : n;
}

void tahr__convex_measure(const tahr__convex_side *shape, const tahr__convex_side *piece, const tahr__clearance *enough,
                          tahr__near *near)
{
    const tahr__convex *a = &shape->convex, *b = &piece->convex;
    tahr__gap gap;

    tahr__convex_clear(a, b, likely_normal(piece, a->centre), enough, &gap);
    near->rough = 1;
    near->part = TAHR__FACE;
    if (gap.clear || gap.distance > TOUCHING) {
        near->distance = d_max(gap.lower, 0);
        near->normal = gap.normal;
        near->point = gap.on_b;
        if (piece->ways_out && !gap.clear) near->part = part_of(b, &gap);
    } else if (gap.lower > -TOUCHING) { /* the plane between them is as good as a contact */
        near->distance = gap.lower;
        near->normal = gap.normal;
        tahr__convex_touch(a, b, -near->distance, near->normal, &gap);
        near->point = gap.on_b;
        if (piece->ways_out) near->part = part_of(b, &gap);
    } else {
        near->distance = -depth_of(shape, piece, &near->normal);
        tahr__convex_touch(a, b, -near->distance, near->normal, &gap);
        near->point = gap.on_b;
    }
    near->distance -= shape->radius + piece->radius;
    near->point = v_mad(near->point, near->normal, piece->radius);
}

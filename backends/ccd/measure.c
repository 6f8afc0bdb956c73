/* SPDX-License-Identifier: MIT
 * measure.c: signed distances and contact normals of the pieces: by core distance, and where there is none (a cylinder,
 * cone, ellipsoid or hull on either side) by that of convex shapes. libccd has no distance, its depths are wrong by up
 * to the whole depth, and its normals by up to 90 degrees at edges. */
#include "scene.h"

/* Nearer than this the direction between the nearest points is rounding: the way out is taken instead. */
#define TOUCHING 1e-10
/* The air between two that have left each other, so that there is a nearest point. */
#define LEFT 1e-6
/* Of the faces of hulls so many are looked at for the shortest way out. */
enum { GUESSED_FACES = 32, GUESSES = 2 * GUESSED_FACES + 16 };

/* Corners of a box by bit: +x 1, +y 2, +z 4. Two triangles per face. */
static const unsigned char box_triangles[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};

static void measure_triangles(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                              tahr__witness *best)
{
    int count = piece->corner_count == 8 ? 12 : 1;

    for (int i = 0; i < count; i++) {
        tahr_vec3 v[3];
        tahr__witness w;
        for (int j = 0; j < 3; j++)
            v[j] = piece->corner[count == 12 ? box_triangles[i][j] : j];
        tahr__core_distance(&probe->core, centre, v, &w);
        if (i == 0 || w.distance < best->distance) *best = w;
    }
}

/* The piece as a centre and half axes. */
static tahr_vec3 solid_of(const tahr__ccd_piece *piece, tahr__core *solid)
{
    const tahr__ccd_body *b = piece->body;
    tahr_vec3 diagonal = b->type == TAHR_BODY_BOX ? piece->corner[7] : piece->corner[1];

    solid->axis_count = b->type == TAHR_BODY_BOX ? 3 : b->reach > 0 ? 1 : 0;
    if (solid->axis_count == 1) solid->axis[0] = v_scale(v_sub(piece->corner[1], piece->corner[0]), 0.5);
    for (int i = 0; i < 3 && solid->axis_count == 3; i++) {
        solid->axis[i] = v_scale(v_sub(piece->corner[1 << i], piece->corner[0]), 0.5);
    }
    return v_scale(v_add(piece->corner[0], diagonal), 0.5);
}

/* Two axes that meet along a line, or a point on an axis: out sideways, by any direction across. */
static tahr_vec3 across(const tahr__ccd_probe *probe, const tahr__core *solid)
{
    tahr_vec3 along = probe->core.axis_count > 0 ? probe->core.axis[0] : solid->axis[0];

    if (probe->core.axis_count + solid->axis_count == 0) return v_make(0, 0, 1);
    return v_unit(v_cross(fabs(along.x) <= fabs(along.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), along));
}

/* A triangle without neighbours: one may leave it past its edges. */
static int is_alone(const tahr__ccd_piece *piece)
{
    const tahr__triangle *t = &piece->body->mesh.triangles[piece->triangle];
    return t->ring[0] == piece->triangle && t->ring[1] == piece->triangle && t->ring[2] == piece->triangle;
}

/* Depth of the cores in each other, or a negative number. */
static double core_depth(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre, double distance,
                         tahr_vec3 *normal)
{
    tahr__core solid;
    unsigned sides = piece->body->surface.flags & TAHR_BODY_TWO_SIDED ? 3 : 1;

    if (piece->body->type != TAHR_BODY_MESH) {
        tahr_vec3 middle = solid_of(piece, &solid);
        if (distance > TOUCHING && tahr__ccd_is_round(piece)) return -1;
        double depth = tahr__core_leave_solid(&probe->core, centre, &solid, middle, normal);
        if (depth >= 0 || distance > TOUCHING) return depth;
        /* They touch: the axis that almost separates them is the way, if there is any. */
        if (depth < -2 * TOUCHING) *normal = across(probe, &solid);
        return 0;
    }
    if (distance > TOUCHING) return -1;
    if (sides == 3 && is_alone(piece)) sides = 7;
    return tahr__core_leave_triangle(&probe->core, centre, piece->corner, sides, normal);
}

/* --- Any two convex shapes --- */

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

/* The way for a out of the piece b: of a mesh to the front or back of the triangle, else the shortest that is found. */
static double convex_depth(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__convex *a,
                           const tahr__convex *b, tahr_vec3 *normal)
{
    const tahr__ccd_body *body = piece->body;
    guesses g = {.count = 0};
    double size = size_of(b), own = size_of(a);

    if (body->type == TAHR_BODY_MESH) {
        tahr_vec3 front = tahr__ccd_triangle_normal(piece->corner), back = v_scale(front, -1);
        double depth = tahr__convex_way(a, b, front);
        *normal = front;
        if (!(body->surface.flags & TAHR_BODY_TWO_SIDED)) return depth;
        double other = tahr__convex_way(a, b, back);
        if (other < depth) *normal = back;
        if (!is_alone(piece)) return d_min(depth, other);
        guess(&g, front);
    }
    guess_of(&g, b, body->type == TAHR_BODY_HULL ? &body->planes : NULL, a->centre);
    guess_of(&g, a, probe->hull ? &probe->hull->planes : NULL, b->centre);
    guess(&g, v_sub(a->centre, b->centre));
    if (own > 0 && (own < size || !(size > 0))) size = own;
    return tahr__convex_leave(a, b, g.normal, g.count, size, normal);
}

/* Which part of a triangle lies nearest. What faces the shape within the accuracy of directions is the face, wherever on
 * it the nearest point was found: of a flat base it is any. */
static uint32_t part_of(const tahr__ccd_piece *piece, const tahr__gap *gap)
{
    tahr_vec3 n = tahr__ccd_triangle_normal(piece->corner), tilt;
    const double *w = gap->weight;
    uint32_t least = w[0] <= w[1] ? (w[0] <= w[2] ? 0 : 2) : (w[1] <= w[2] ? 1 : 2), a = (least + 1) % 3,
             b = (least + 2) % 3;

    tilt = v_sub(gap->normal, v_dot(n, gap->normal) < 0 ? v_scale(n, -1) : n);
    if (v_dot(tilt, tilt) < TAHR__CCD_SAME_DIRECTION * TAHR__CCD_SAME_DIRECTION) return TAHR__FACE;
    if (w[a] < TAHR__CCD_SAME_DIRECTION) return TAHR__CORNER + b;
    return w[b] < TAHR__CCD_SAME_DIRECTION ? TAHR__CORNER + a : TAHR__EDGE + a;
}

/* Where the shape touches a piece that it has just left along normal, by depth: of two flat faces, some point that both
 * hold. */
static void leave_along(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre, double depth,
                        tahr_vec3 normal, tahr__gap *gap)
{
    tahr__convex a = probe->shape, b;

    a.centre = v_add(v_mad(a.centre, normal, depth + LEFT), centre);
    tahr__ccd_convex(probe, piece, &b);
    tahr__convex_distance(&a, &b, normal, gap);
}

/* A triangle most often faces the shape. */
static tahr_vec3 likely_normal(const tahr__ccd_piece *piece, tahr_vec3 centre)
{
    if (piece->body->type != TAHR_BODY_MESH) return v_make(0, 0, 0);
    tahr_vec3 n = tahr__ccd_triangle_normal(piece->corner);
    return v_dot(n, v_sub(centre, piece->corner[0])) < 0 ? v_scale(n, -1) : n;
}

static void measure_convex(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre, int rough,
                           tahr__ccd_near *near)
{
    tahr__convex a = probe->shape, b;
    tahr__gap gap;

    const tahr__clearance enough = {probe->motion, probe->radius + piece->radius + probe->margin};

    a.centre = v_add(a.centre, centre);
    tahr__ccd_convex(probe, piece, &b);
    tahr__convex_clear(&a, &b, likely_normal(piece, a.centre), rough ? &enough : NULL, &gap);
    near->reserved = 0;
    near->part = TAHR__FACE;
    if (gap.clear || gap.distance > TOUCHING) {
        near->distance = d_max(gap.lower, 0);
        near->normal = gap.normal;
        near->point = gap.on_b;
        if (piece->body->type == TAHR_BODY_MESH && !gap.clear) near->part = part_of(piece, &gap);
    } else if (gap.lower > -TOUCHING) { /* the plane between them is as good as a contact */
        near->distance = gap.lower;
        near->normal = gap.normal;
        leave_along(probe, piece, centre, -near->distance, near->normal, &gap);
        near->point = gap.on_b;
        if (piece->body->type == TAHR_BODY_MESH) near->part = part_of(piece, &gap);
    } else {
        near->distance = -convex_depth(probe, piece, &a, &b, &near->normal);
        leave_along(probe, piece, centre, -near->distance, near->normal, &gap);
        near->point = gap.on_b;
    }
    near->distance -= probe->radius + piece->radius;
    near->point = v_mad(near->point, near->normal, piece->radius);
}

/* --- Cores --- */

static void measure_core(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                         tahr__ccd_near *near)
{
    tahr__witness w = {0};
    tahr__gap gap;
    tahr_vec3 way_out;
    double depth;

    measure_triangles(probe, piece, centre, &w);
    near->point = w.point;
    near->part = w.feature;
    near->reserved = 0;
    depth = core_depth(probe, piece, centre, w.distance, &way_out);
    near->normal = depth >= 0 ? way_out : w.normal;
    near->distance = (depth >= 0 ? -depth : w.distance) - probe->radius - piece->radius;
    if (depth >= 0) {
        near->part = TAHR__FACE;
        leave_along(probe, piece, centre, depth, near->normal, &gap);
        near->point = gap.on_b;
    }
    near->point = v_mad(near->point, near->normal, piece->radius);
}

void tahr__ccd_measure(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                       tahr__ccd_near *near)
{
    if (probe->is_core && !tahr__ccd_is_convex(piece))
        measure_core(probe, piece, centre, near);
    else
        measure_convex(probe, piece, centre, 0, near);
}

void tahr__ccd_measure_far(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                           tahr__ccd_near *near)
{
    if (probe->is_core && !tahr__ccd_is_convex(piece))
        measure_core(probe, piece, centre, near);
    else
        measure_convex(probe, piece, centre, 1, near);
}

int tahr__ccd_in_front(const tahr__ccd_piece *piece, const tahr__ccd_near *near)
{
    if (piece->body->type != TAHR_BODY_MESH || piece->body->surface.flags & TAHR_BODY_TWO_SIDED) return 1;
    return v_dot(near->normal, tahr__ccd_triangle_normal(piece->corner)) >= TAHR__CCD_BEHIND;
}

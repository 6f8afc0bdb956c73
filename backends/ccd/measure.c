/* SPDX-License-Identifier: MIT
 * measure.c: signed distances and contact normals of the pieces: by core distance, and where there is none (a cylinder,
 * cone, ellipsoid or hull on either side) by that of convex shapes. libccd has no distance, its depths are wrong by up
 * to the whole depth, and its normals by up to 90 degrees at edges. */
#include "scene.h"

/* Nearer than this the direction between the nearest points is rounding: the way out is taken instead. */
#define TOUCHING 1e-10
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

/* Depth of the cores in each other, or a negative number. */
static double core_depth(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre, double distance,
                         tahr_vec3 *normal)
{
    tahr__core solid;

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
    return tahr__core_leave_triangle(&probe->core, centre, piece->corner, tahr__ccd_ways_out(piece), normal);
}

static void measure_convex(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre, int rough,
                           tahr__ccd_near *near)
{
    const tahr__clearance enough = {probe->motion, probe->radius + piece->radius + probe->margin};
    tahr__convex_side shape = {probe->shape, probe->radius, probe->hull ? &probe->hull->hull.planes : NULL, 0, 0}, side;

    shape.convex.centre = v_add(shape.convex.centre, centre);
    tahr__ccd_side(probe, piece, &side);
    tahr__convex_measure(&shape, &side, rough ? &enough : NULL, near);
}

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
    near->rough = 0;
    depth = core_depth(probe, piece, centre, w.distance, &way_out);
    near->normal = depth >= 0 ? way_out : w.normal;
    near->distance = (depth >= 0 ? -depth : w.distance) - probe->radius - piece->radius;
    if (depth >= 0) {
        near->part = TAHR__FACE;
        tahr__convex a = probe->shape, b;
        a.centre = v_add(a.centre, centre);
        tahr__ccd_convex(probe, piece, &b);
        tahr__convex_touch(&a, &b, depth, near->normal, &gap);
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
    return v_dot(near->normal, tahr__convex_triangle_normal(piece->corner)) >= TAHR__CCD_BEHIND;
}

/* SPDX-License-Identifier: MIT
 * convex_face.c: which faces of a cylinder, cone, ellipsoid or hull are felt. */
#include "convex_near.h"

/* The face along a direction, of those that hold the nearest point. */
typedef struct choice {
    tahr_vec3 normal, direction;
    double most;
    tahr_vec3 *face;
} choice;

static void take(choice *c, tahr_vec3 n)
{
    if (v_dot(n, c->normal) <= TAHR__SAME_DIRECTION || v_dot(n, c->direction) <= c->most) return;
    c->most = v_dot(n, c->direction);
    *c->face = n;
}

/* From the axis to a point, or where that is on the axis along what the question is about; else any way across. */
static tahr_vec3 outward_of(tahr_vec3 axis, tahr_vec3 point, tahr_vec3 direction)
{
    tahr_vec3 p = v_mad(point, axis, -v_dot(point, axis)), d = v_mad(direction, axis, -v_dot(direction, axis));
    if (v_length(p) > TAHR__SAME_PLACE) return v_unit(p);
    if (v_dot(d, d) > 0) return v_unit(d);
    return v_unit(v_cross(fabs(axis.x) <= fabs(axis.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), axis));
}

/* point: from the centre. */
static void of_cylinder(const tahr__convex *b, tahr_vec3 point, choice *c)
{
    double h = v_length(b->axis[0]);
    tahr_vec3 axis = v_scale(b->axis[0], 1 / h), side = outward_of(axis, point, c->direction);

    if (v_dot(point, axis) > h - TAHR__SAME_PLACE) take(c, axis);
    if (v_dot(point, axis) < -h + TAHR__SAME_PLACE) take(c, v_scale(axis, -1));
    if (v_dot(point, side) > b->radius - TAHR__SAME_PLACE) take(c, side);
}

static void of_cone(const tahr__convex *b, tahr_vec3 point, choice *c)
{
    double h = v_length(b->axis[0]);
    tahr_vec3 axis = v_scale(b->axis[0], 1 / h), side = outward_of(axis, point, c->direction);
    /* The side leans inward by the radius over the whole height. */
    tahr_vec3 n = v_unit(v_mad(v_scale(axis, b->radius), side, 2 * h));

    if (v_dot(point, axis) < -h + TAHR__SAME_PLACE) take(c, v_scale(axis, -1));
    if (v_dot(n, v_sub(point, b->axis[0])) > -TAHR__SAME_PLACE) take(c, n);
}

static void of_ellipsoid(const tahr__convex *b, tahr_vec3 point, tahr_vec3 *face)
{
    tahr_vec3 n = v_make(0, 0, 0);

    for (int i = 0; i < 3; i++) {
        double square = v_dot(b->axis[i], b->axis[i]);
        n = v_mad(n, b->axis[i], v_dot(point, b->axis[i]) / (square * square));
    }
    if (v_dot(n, n) > 0) *face = v_unit(n);
}

static tahr_vec3 plane_normal(const tahr__convex_side *piece, uint32_t i)
{
    tahr_vec3 n = piece->planes->normals[i];
    return piece->convex.turn ? m_apply(piece->convex.turn, n) : n;
}

static void of_hull(const tahr__convex_side *piece, tahr_vec3 point, choice *c)
{
    for (uint32_t i = 0; i < piece->planes->count; i++) {
        tahr_vec3 n = plane_normal(piece, i);
        if (v_dot(n, point) > piece->planes->offsets[i] * piece->convex.scale - TAHR__SAME_PLACE) take(c, n);
    }
}

uint32_t tahr__convex_hull_face(const tahr__convex_side *piece, tahr_vec3 direction)
{
    tahr_vec3 local = piece->convex.turn ? m_unapply(piece->convex.turn, direction) : direction;
    const tahr__hull_planes *planes = piece->planes;
    uint32_t best = 0;

    for (uint32_t i = 1; i < planes->count; i++) {
        if (v_dot(planes->normals[i], local) > v_dot(planes->normals[best], local)) best = i;
    }
    return best;
}

void tahr__convex_face(const tahr__convex_side *piece, const tahr__near *near, tahr_vec3 direction, tahr_vec3 *face)
{
    const tahr__convex *b = &piece->convex;
    tahr_vec3 point = v_sub(near->point, b->centre);
    choice c = {near->normal, direction, -2, face};

    *face = near->normal;
    switch (b->kind) {
    case TAHR__CONVEX_CYLINDER: of_cylinder(b, point, &c); break;
    case TAHR__CONVEX_CONE: of_cone(b, point, &c); break;
    case TAHR__CONVEX_ELLIPSOID: of_ellipsoid(b, point, face); break;
    default: of_hull(piece, point, &c); break;
    }
}

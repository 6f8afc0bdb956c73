/* SPDX-License-Identifier: MIT
 * leave.c: the way out of a primitive that the core has entered. */
#include "leave.h"

/* Of the sizes of two boxes: nearer than this they touch. Their faces leave what they touch to the inside, so the
 * inside must not call it outside by rounding. */
#define TOUCHING 1e-12

/* Does a face of the box keep the core out? Most often one does, and then its edges need not be asked. */
static int outside_a_face(const tahr__core *core, const tahr__core *solid, tahr_vec3 off)
{
    for (int i = 0; i < solid->axis_count; i++) {
        tahr_vec3 n = solid->axis[i];
        if (fabs(v_dot(n, off)) > (v_dot(n, n) + tahr__core_extent(core, n)) * (1 + TOUCHING)) return 1;
    }
    return 0;
}

/* How far and which way out of a hull or box; negative: not inside. */
static double leave_hull(const tahr__query *query, const tahr__body *body, tahr_vec3 centre, tahr_vec3 *normal)
{
    tahr__map map = tahr__map_make(query->frame, body);
    return tahr__hull_leave(&query->core, centre, &body->mesh, &map, normal);
}

/* Is the core certainly outside of a box that is not turned? Most often it is. */
static int beside_box(const tahr__query *query, const tahr__body *body, tahr_vec3 centre)
{
    const tahr_vec3 half = body->half_extents, e = query->extent, o = query->frame->origin;
    const double more = 1 + 2 * TOUCHING;
    if (query->frame->turned || body->turned) return 0;
    tahr_vec3 off = v_abs(v_sub(centre, v_sub(body->position, o)));
    return (off.x > (half.x + e.x) * more) | (off.y > (half.y + e.y) * more) | (off.z > (half.z + e.z) * more);
}

static double leave_box(const tahr__query *query, const tahr__body *body, tahr_vec3 centre, tahr_vec3 *normal)
{
    if (beside_box(query, body, centre)) return -1;
    tahr__map map = tahr__map_make(query->frame, body);
    tahr__core solid;
    solid.axis_count = 3;
    solid.axis[0] = v_make(body->half_extents.x, 0, 0);
    solid.axis[1] = v_make(0, body->half_extents.y, 0);
    solid.axis[2] = v_make(0, 0, body->half_extents.z);
    for (int i = 0; i < 3 && map.turned; i++)
        solid.axis[i] = m_apply(&map.turn, solid.axis[i]);
    if (outside_a_face(&query->core, &solid, v_sub(centre, map.offset))) return -1;
    double depth = tahr__core_leave_solid(&query->core, centre, &solid, map.offset, normal);
    double extent = tahr__core_extent(&solid, *normal) + tahr__core_extent(&query->core, *normal);
    return depth < -TOUCHING * extent ? -1 : d_max(depth, 0);
}

int tahr__leave_solid(const tahr__query *query, const tahr__prim *prim, tahr__probe *out)
{
    const tahr__body *body = &query->world->bodies[prim->body];
    tahr_vec3 centre = query->start;
    double depth = body->type == TAHR_BODY_HULL ? leave_hull(query, body, centre, &out->witness.normal)
                                                : leave_box(query, body, centre, &out->witness.normal);
    /* In the plane of a face too: the faces leave what touches them to the inside. */
    if (depth < 0) return 0;
    tahr_vec3 n = out->witness.normal;
    out->witness.distance = 0;
    out->witness.feature = TAHR__FACE;
    out->witness.beside = 0;
    out->witness.point = v_mad(centre, n, depth - tahr__core_extent(&query->core, n));
    out->gap = -depth - query->radius;
    return 1;
}

/* Out of a round body whose axis the core crosses: across both axes, or sideways. */
static double leave_round(const tahr__core *core, const tahr__prim *prim, tahr_vec3 centre, tahr_vec3 *normal)
{
    tahr__core axis;
    axis.axis_count = 1;
    axis.axis[0] = v_scale(v_sub(prim->facet.v[1], prim->facet.v[0]), 0.5);
    double depth = tahr__core_leave_solid(core, centre, &axis, v_add(prim->facet.v[0], axis.axis[0]), normal);
    if (depth >= 0) return depth;
    /* Nothing has a volume here: any way across the axis will do, up if there is none. */
    tahr_vec3 along = core->axis_count ? core->axis[0] : axis.axis[0];
    *normal = v_make(0, 0, 1);
    if (v_dot(along, along) > 0) {
        *normal = v_unit(v_cross(fabs(along.x) < fabs(along.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), along));
    }
    return 0;
}

static unsigned sides_of(const tahr__query *query, const tahr__prim *prim)
{
    if (!(prim->kind & TAHR__TWO_SIDED)) return 1;
    /* Past its edges only from a triangle that stands alone: beyond an edge with a neighbour lies the neighbour. */
    return tahr__stands_alone(query, prim) ? 7 : 3;
}

int tahr__leave_surface(const tahr__query *query, const tahr__prim *prim, tahr__probe *out)
{
    const tahr__core *core = &query->core;
    double depth;
    if (prim->item & TAHR__ITEM_ROUND) {
        depth = leave_round(core, prim, query->start, &out->witness.normal);
    } else {
        if ((prim->kind & TAHR__OF_BOX) && core->axis_count > 0) return 0; /* its inside answers */
        depth =
            tahr__core_leave_triangle(core, query->start, prim->facet.v, sides_of(query, prim), &out->witness.normal);
        out->witness.feature = TAHR__FACE;
    }
    out->gap = -depth - (query->radius + prim->radius);
    return 1;
}

uint32_t tahr__leave_face(const tahr__query *query, const tahr__prim *prim, tahr_vec3 normal)
{
    const tahr__body *body = &query->world->bodies[prim->body];
    tahr__map map = tahr__map_make(query->frame, body);
    tahr_vec3 n = m_unapply(&map.turn, normal), a = v_abs(n);
    if (body->type == TAHR_BODY_HULL) return tahr__hull_face(&body->mesh, n);
    int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return 2 * (uint32_t)axis + (v_get(n, axis) > 0);
}

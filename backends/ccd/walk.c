/* SPDX-License-Identifier: MIT
 * walk.c: the pieces that may be within reach of a query: bodies through the tree of their bounds, meshes through their
 * own. */
#include "scene.h"

/* Boxes grow by this (m): far more than the rounding of coordinates at 1e7 m, far less than anything it would cost. */
#define SLACK 1e-5

/* Half the extent of the shape along each axis, and a little more where it is not the same both ways. */
static tahr_vec3 half_extent(const tahr__ccd_probe *probe)
{
    tahr_vec3 half = v_make(0, 0, 0);

    if (probe->is_core) {
        for (int i = 0; i < probe->core.axis_count; i++)
            half = v_add(half, v_abs(probe->core.axis[i]));
        return half;
    }
    for (int i = 0; i < 3; i++) {
        tahr_vec3 n = v_make(i == 0, i == 1, i == 2);
        double most = d_max(tahr__convex_extent(&probe->shape, n), tahr__convex_extent(&probe->shape, v_scale(n, -1)));
        half = v_mad(half, n, most);
    }
    return half;
}

void tahr__ccd_walk_begin(tahr__ccd_walk *walk, const tahr__ccd_probe *probe, tahr_vec3 motion, double reach)
{
    tahr_vec3 half = v_add(half_extent(probe), v_make(reach, reach, reach)), zero = v_make(0, 0, 0);
    double metres = 1 / probe->unit;
    tahr_bounds world;

    half = v_add(v_scale(half, metres), v_make(SLACK, SLACK, SLACK));
    motion = v_scale(motion, metres);
    walk->probe = probe;
    walk->box.min = v_sub(v_min(zero, motion), half);
    walk->box.max = v_add(v_max(zero, motion), half);
    walk->inside = walk->first = walk->count = 0;
    world.min = v_add(walk->box.min, probe->origin);
    world.max = v_add(walk->box.max, probe->origin);
    tahr__body_walk_begin(&walk->bodies, &probe->scene->tree, &world, probe->origin);
}

static int overlap(const tahr_bounds *a, const tahr_bounds *b)
{
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y && b->min.y <= a->max.y &&
           a->min.z <= b->max.z && b->min.z <= a->max.z;
}

static int passes(const tahr__ccd_walk *walk, const tahr__ccd_body *body)
{
    tahr_bounds world = {v_add(walk->box.min, walk->probe->origin), v_add(walk->box.max, walk->probe->origin)};
    return tahr__filter_passes(&walk->probe->filter, &body->surface) && overlap(&world, &body->bounds);
}

/* The query's box in the frame of the mesh. */
static void enter_mesh(tahr__ccd_walk *walk, const tahr__ccd_body *body)
{
    tahr_vec3 middle = v_scale(v_add(walk->box.min, walk->box.max), 0.5),
              half = v_scale(v_sub(walk->box.max, walk->box.min), 0.5);
    tahr_vec3 centre = m_unapply(&body->turn, v_add(v_sub(walk->probe->origin, body->position), middle));
    tahr_vec3 start = m_unapply(&body->turn, v_sub(walk->probe->origin, body->position));
    tahr_vec3 extent = v_scale(v_abs(body->turn.row[0]), half.x);
    tahr_bounds box;

    extent = v_mad(extent, v_abs(body->turn.row[1]), half.y);
    extent = v_mad(extent, v_abs(body->turn.row[2]), half.z);
    box.min = v_sub(centre, extent);
    box.max = v_add(centre, extent);
    tahr__bvh_walk_begin(&walk->tree, &body->mesh.bvh, &box, 0, start);
    walk->inside = 1;
    walk->count = 0;
}

int tahr__ccd_walk_next(tahr__ccd_walk *walk, tahr__ccd_piece *piece)
{
    const tahr__ccd_body *bodies = walk->probe->scene->bodies;

    for (;;) {
        if (walk->inside && walk->count > 0) {
            walk->count--;
            tahr__ccd_triangle(walk->probe, &bodies[walk->body], walk->first++, piece);
            return 1;
        }
        if (walk->inside && tahr__bvh_walk_next(&walk->tree, &walk->first, &walk->count)) continue;
        walk->inside = 0;
        do {
            if (!tahr__body_walk_next(&walk->bodies, &walk->body)) return 0;
        } while (!passes(walk, &bodies[walk->body]));
        if (bodies[walk->body].type != TAHR_BODY_MESH) {
            tahr__ccd_whole_body(walk->probe, &bodies[walk->body], piece);
            return 1;
        }
        enter_mesh(walk, &bodies[walk->body]);
    }
}

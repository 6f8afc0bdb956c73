/* SPDX-License-Identifier: MIT
 * walk.c: the pieces that may be within reach of a query: bodies through the tree of their bounds, meshes through their
 * own. */
#include "scene.h"

/* Shapes between these half sizes (m) keep metres for their unit. */
#define SMALL 0.0625
#define LARGE 16.0

/* Others are brought to about 1: libccd's tolerances are absolute. A power of two: scaling by it rounds nothing. */
static double scale_of(const tahr_shape *shape)
{
    double size = d_max(d_max(shape->radius, shape->half_height), d_max(shape->half_x, shape->half_y)), scale = 1;

    if (!(size > 0)) return 0;
    if (size >= SMALL && size <= LARGE) return 1;
    while (size * scale < 0.5)
        scale *= 2;
    while (size * scale > 1)
        scale *= 0.5;
    return scale;
}

static void rewind_walk(tahr__piece_query *q)
{
    tahr__ccd_walk *walk = (tahr__ccd_walk *)q;
    tahr_bounds world = tahr__piece_query_box(q);

    walk->inside = 0;
    tahr__body_walk_begin(&walk->bodies, &tahr__ccd_scene_of(q)->tree, &world, q->start.origin);
}

/* The query's box in the frame of the mesh. */
static void enter_mesh(tahr__ccd_walk *walk, const tahr__scene_body *body)
{
    const tahr__piece_query *q = &walk->query;
    tahr_vec3 middle = v_scale(v_add(q->box.min, q->box.max), 0.5), half = v_scale(v_sub(q->box.max, q->box.min), 0.5);
    tahr_vec3 from_body = v_sub(q->start.origin, body->pose.position);
    tahr_vec3 centre = m_unapply(&body->turn, v_add(from_body, middle));
    tahr_vec3 extent = v_scale(v_abs(body->turn.row[0]), half.x);
    tahr_bounds box;

    extent = v_mad(extent, v_abs(body->turn.row[1]), half.y);
    extent = v_mad(extent, v_abs(body->turn.row[2]), half.z);
    box.min = v_sub(centre, extent);
    box.max = v_add(centre, extent);
    tahr_vec3 near = m_unapply(&body->turn, from_body);
    tahr__wide_walk_begin(&walk->tree, &body->mesh->tree, &box, 0, &near);
    walk->inside = 1;
}

/* A body and a triangle of it. */
static uint64_t name_of(uint32_t body, uint32_t triangle)
{
    return (uint64_t)body << 32 | triangle;
}

static int next(tahr__piece_query *q, uint64_t *name)
{
    tahr__ccd_walk *walk = (tahr__ccd_walk *)q;

    for (;;) {
        uint32_t triangle;
        if (walk->inside && tahr__wide_walk_next(&walk->tree, &triangle)) {
            *name = name_of(walk->body, triangle);
            return 1;
        }
        walk->inside = 0;
        do {
            if (!tahr__body_walk_next(&walk->bodies, &walk->body)) return 0;
        } while (!tahr__piece_wanted(q, &q->scene->bodies[walk->body]));
        *name = name_of(walk->body, 0);
        if (q->scene->bodies[walk->body].kind != TAHR_BODY_MESH) return 1;
        enter_mesh(walk, &q->scene->bodies[walk->body]);
    }
}

static int make(tahr__piece_query *q, tahr__piece_found *found)
{
    tahr__piece_of_body(q, &q->scene->bodies[found->name >> 32], (uint32_t)found->name, found);
    return 1;
}

const tahr__piece_finder tahr__ccd_finder = {
    .scale = scale_of, .rewind = rewind_walk, .next = next, .make = make, .advance = tahr__ccd_advance};

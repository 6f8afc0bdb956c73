/* SPDX-License-Identifier: MIT
 * walk.c: the pieces that may be within reach of a query: bodies in order of their ids, meshes through their trees. */
#include "scene.h"

/* Boxes grow by this (m): far more than the rounding of coordinates at 1e7 m, far less than anything it would cost. */
#define SLACK 1e-5

static tahr_vec3 to_start(const tahr__ccd_probe *probe, const tahr__ccd_body *body, tahr_vec3 local)
{
    return v_add(v_sub(body->position, probe->origin), m_apply(&body->turn, local));
}

void tahr__ccd_triangle(const tahr__ccd_probe *probe, const tahr__ccd_body *body, uint32_t triangle,
                        tahr__ccd_piece *piece)
{
    const tahr__triangle *t = &body->mesh.triangles[triangle];

    piece->body = body;
    piece->corner_count = 3;
    piece->triangle = triangle;
    piece->radius = 0;
    for (int i = 0; i < 3; i++)
        piece->corner[i] = to_start(probe, body, body->mesh.vertices[t->vertex[i]]);
}

static void whole_body(const tahr__ccd_probe *probe, const tahr__ccd_body *body, tahr__ccd_piece *piece)
{
    tahr_vec3 h = body->half_extents;

    piece->body = body;
    piece->triangle = 0;
    piece->radius = body->type == TAHR_BODY_BOX ? 0 : body->radius;
    piece->corner_count = body->type == TAHR_BODY_BOX ? 8 : 3;
    for (int i = 0; i < piece->corner_count; i++) {
        tahr_vec3 p = v_make(i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z);
        /* Round bodies are triangles that shrank to a segment or a point. */
        if (piece->corner_count == 3) p = v_make(0, 0, i == 0 ? -body->reach : body->reach);
        piece->corner[i] = to_start(probe, body, p);
    }
}

void tahr__ccd_walk_begin(tahr__ccd_walk *walk, const tahr__ccd_probe *probe, tahr_vec3 motion, double reach)
{
    tahr_vec3 half = v_make(reach + SLACK, reach + SLACK, reach + SLACK), zero = v_make(0, 0, 0);

    for (int i = 0; i < probe->core.axis_count; i++)
        half = v_add(half, v_abs(probe->core.axis[i]));
    walk->probe = probe;
    walk->box.min = v_sub(v_min(zero, motion), half);
    walk->box.max = v_add(v_max(zero, motion), half);
    walk->body = 0;
    walk->inside = walk->first = walk->count = 0;
}

static int overlap(const tahr_bounds *a, const tahr_bounds *b)
{
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y && b->min.y <= a->max.y &&
           a->min.z <= b->max.z && b->min.z <= a->max.z;
}

static int passes(const tahr__ccd_walk *walk, const tahr__ccd_body *body)
{
    tahr_bounds world = {v_add(walk->box.min, walk->probe->origin), v_add(walk->box.max, walk->probe->origin)};
    uint32_t kind = body->flags & TAHR_BODY_SENSOR ? TAHR__CCD_SENSORS : TAHR__CCD_SOLIDS;
    return walk->probe->leaves_out != kind && (body->mask & walk->probe->mask) != 0 &&
           (body->id == walk->probe->ignore_body) == walk->probe->only_body && overlap(&world, &body->bounds);
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
    const tahr__ccd_scene *scene = walk->probe->scene;

    for (;;) {
        if (walk->inside && walk->count > 0) {
            walk->count--;
            tahr__ccd_triangle(walk->probe, &scene->bodies[walk->body], walk->first++, piece);
            return 1;
        }
        if (walk->inside && tahr__bvh_walk_next(&walk->tree, &walk->first, &walk->count)) continue;
        if (walk->inside) {
            walk->inside = 0;
            walk->body++;
        }
        while (walk->body < scene->body_count && !passes(walk, &scene->bodies[walk->body]))
            walk->body++;
        if (walk->body >= scene->body_count) return 0;
        if (scene->bodies[walk->body].type != TAHR_BODY_MESH) {
            whole_body(walk->probe, &scene->bodies[walk->body++], piece);
            return 1;
        }
        enter_mesh(walk, &scene->bodies[walk->body]);
    }
}

/* SPDX-License-Identifier: MIT
 * query.c: a query's candidates as FCL finds them, and the pieces that they are. */
#include "scene.h"

/* Boxes grow by this (m): far more than the rounding of coordinates at 1e7 m, far less than anything it would cost. */
#define SLACK 1e-5

static int is_finite_vec(tahr_vec3 v)
{
    return v.x * 0 == 0 && v.y * 0 == 0 && v.z * 0 == 0;
}

static int overlap(const tahr_bounds *a, const tahr_bounds *b)
{
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y && b->min.y <= a->max.y &&
           a->min.z <= b->max.z && b->min.z <= a->max.z;
}

static int wants(const void *user, uint32_t body)
{
    const tahr__fcl_query *q = user;

    return tahr__filter_passes(&q->filter, &q->scene->bodies[body].surface);
}

tahr_status tahr__fcl_query_shape(tahr__fcl_query *q, const tahr__shape_source *source)
{
    const tahr_shape *s = source->shape;
    tahr__shape_source found = *source;
    const tahr__fcl_scene *scene = q->scene;

    if (s->type == TAHR_SHAPE_HULL && s->hull < scene->described && scene->bodies[s->hull].kind == TAHR_BODY_HULL)
        found.hull = &scene->bodies[s->hull].hull;
    return tahr__shape_make(&found, &q->shape);
}

/* Of the shape around its centre, without its radius. */
static tahr_bounds shape_bounds(const tahr__shape *shape)
{
    tahr_bounds b = {{0, 0, 0}, {0, 0, 0}};

    for (int i = 0; i < 3; i++) {
        tahr_vec3 n = v_make(i == 0, i == 1, i == 2);
        b.max = v_mad(b.max, n, tahr__shape_extent(shape, n));
        b.min = v_mad(b.min, n, -tahr__shape_extent(shape, v_scale(n, -1)));
    }
    return b;
}

tahr_status tahr__fcl_query_begin(tahr__fcl_query *q, tahr_query_context *context, double reach)
{
    tahr_vec3 half = v_make(reach + SLACK, reach + SLACK, reach + SLACK), zero = v_make(0, 0, 0);
    tahr__fcl_question question;
    tahr_bounds own;
    tahr_status status;

    q->context = context;
    q->count = 0;
    q->frame_body = UINT32_MAX;
    tahr__fcl_list_begin(&q->list, q->scene->host, q->room, TAHR__FCL_ROOM);
    own = shape_bounds(&q->shape);
    own.min = v_sub(own.min, half);
    own.max = v_add(own.max, half);
    if (!is_finite_vec(q->origin) || !is_finite_vec(q->motion) || !is_finite_vec(own.min) || !is_finite_vec(own.max))
        return TAHR_E_ARGUMENT;
    q->motion_length = v_length(q->motion);
    q->box.min = v_add(v_min(zero, q->motion), own.min);
    q->box.max = v_add(v_max(zero, q->motion), own.max);
    question.box.min = v_add(q->box.min, q->origin);
    question.box.max = v_add(q->box.max, q->origin);
    question.wants = wants;
    question.user = q;
    if (tahr__fcl_cache_find(q, &question.box, &q->parts, &q->count)) return TAHR_OK;
    context->gathers++;
    status = tahr__fcl_engine_gather(q->scene->engine, &question, &q->list);
    if (status < 0) return status;
    tahr__fcl_list_sort(&q->list);
    q->parts = q->list.parts;
    q->count = q->list.count;
    return TAHR_OK;
}

void tahr__fcl_query_end(tahr__fcl_query *q)
{
    tahr__fcl_list_free(&q->list);
}

static void enter_frame(tahr__fcl_query *q, uint32_t body)
{
    const tahr__fcl_body *b = &q->scene->bodies[body];
    tahr_pose pose;
    tahr__mat turn;

    if (q->frame_body == body) return;
    q->frame_body = body;
    if (body < q->scene->described || !q->scene->desc.manager) {
        tahr__placement_make(&b->position, &b->turn, q->origin, &q->frame);
        return;
    }
    tahr__fcl_engine_pose(q->scene->engine, body, &pose, &turn);
    tahr__placement_make(&pose.position, &turn, q->origin, &q->frame);
}

/* The same for a cell, before a piece is made of it: most of what an octree lists is out of the box of the query. */
static int cell_within_reach(const tahr__fcl_query *q, tahr_vec3 middle, double half)
{
    tahr_vec3 at = v_add(q->frame.base, middle);
    return q->frame.turned ||
           (at.x - half <= q->box.max.x && at.x + half >= q->box.min.x && at.y - half <= q->box.max.y &&
            at.y + half >= q->box.min.y && at.z - half <= q->box.max.z && at.z + half >= q->box.min.z);
}

static int within_reach(const tahr__fcl_query *q, const tahr__piece *piece)
{
    tahr_bounds bounds = {piece->facet.v[0], piece->facet.v[0]};
    tahr_vec3 half = v_make(piece->radius, piece->radius, piece->radius);

    if (piece->kind == TAHR__HALF_SPACE || piece->kind == TAHR__CONVEX) return 1; /* FCL has looked at its bounds */
    if (piece->kind == TAHR__TRIANGLE) {
        bounds.min = v_min(piece->facet.v[0], v_min(piece->facet.v[1], piece->facet.v[2]));
        bounds.max = v_max(piece->facet.v[0], v_max(piece->facet.v[1], piece->facet.v[2]));
        return overlap(&bounds, &q->box);
    }
    for (int i = 0; i < piece->solid.axis_count; i++)
        half = v_add(half, v_abs(piece->solid.axis[i]));
    bounds.min = v_sub(piece->middle, half);
    bounds.max = v_add(piece->middle, half);
    return overlap(&bounds, &q->box);
}

int tahr__fcl_query_piece(tahr__fcl_query *q, uint32_t i, tahr__piece *piece)
{
    const tahr__fcl_part *part = &q->parts[i];
    const tahr__fcl_body *b = &q->scene->bodies[part->body];
    tahr_vec3 middle = v_make(0, 0, 0), half = b->half_extents;

    if (!wants(q, part->body)) return 0;
    enter_frame(q, part->body);
    switch (b->kind) {
    case TAHR_BODY_MESH: tahr__piece_triangle(&q->frame, &q->scene->meshes[b->mesh], part->triangle, piece); break;
    case TAHR_BODY_SPHERE:
    case TAHR_BODY_CAPSULE: tahr__piece_round(&q->frame, b->radius, b->reach, piece); break;
    case TAHR_BODY_CYLINDER: tahr__piece_swept(&q->frame, TAHR__CONVEX_CYLINDER, b->radius, b->reach, piece); break;
    case TAHR_BODY_CONE: tahr__piece_swept(&q->frame, TAHR__CONVEX_CONE, b->radius, b->reach, piece); break;
    case TAHR_BODY_ELLIPSOID: tahr__piece_ellipsoid(&q->frame, b->half_extents, piece); break;
    case TAHR_BODY_HULL: tahr__piece_hull(&q->frame, &b->hull, piece); break;
    case TAHR__FCL_HALF_SPACE:
    case TAHR__FCL_PLANE: tahr__piece_half_space(&q->frame, b->half_extents, b->radius, piece); break;
    case TAHR__FCL_OCTREE:
        tahr__fcl_cell_box(b, part, &middle, &half);
        if (!cell_within_reach(q, middle, half.x)) return 0;
        /* fallthrough */
    default: tahr__piece_box(&q->frame, middle, half, piece); break;
    }
    piece->two_sided = b->two_sided;
    return within_reach(q, piece);
}

void tahr__fcl_measure(const tahr__fcl_query *q, uint32_t i, const tahr__piece *piece, tahr_vec3 centre,
                       tahr__near *near)
{
    tahr__piece_measure(&q->shape, centre, piece, near);
    if (near->distance < -q->shape.radius && tahr__fcl_query_body(q, i)->kind == TAHR__FCL_OCTREE)
        tahr__fcl_cell_way_out(q, i, piece, centre, near);
}

int tahr__fcl_felt(const tahr__fcl_query *q, uint32_t i, const tahr__piece *piece, tahr_vec3 direction,
                   tahr__near *near, tahr_vec3 *face)
{
    if (!tahr__piece_in_front(piece, near)) return 0;
    if (tahr__fcl_query_body(q, i)->kind == TAHR__FCL_OCTREE && !tahr__fcl_cell_felt(q, i, piece, near)) return 0;
    return tahr__piece_face(piece, direction, near, face);
}

/* Of a cell: ten bits of its place along x and y, nine along z, and the face: one name for all cells within 512 of each
 * other, and the same again whenever the map is opened. */
uint32_t tahr__fcl_feature(const tahr__fcl_query *q, uint32_t i, const tahr__piece *piece, tahr_vec3 normal)
{
    const tahr__fcl_part *p = &q->parts[i];
    uint32_t feature = tahr__piece_feature(piece, normal);

    if (tahr__fcl_query_body(q, i)->kind != TAHR__FCL_OCTREE) return feature;
    return (p->key[2] & 0x1FFu) << 23 | (p->key[1] & 0x3FFu) << 13 | (p->key[0] & 0x3FFu) << 3 | feature;
}

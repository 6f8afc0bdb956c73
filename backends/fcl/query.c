/* SPDX-License-Identifier: MIT
 * query.c: a query's candidates as FCL finds them, and the pieces that they are. */
#include "scene.h"

static int wants(const void *user, uint32_t body)
{
    const tahr__piece_query *q = user;
    return tahr__piece_wanted(q, &q->scene->bodies[body]);
}

static tahr_status begin(tahr__piece_query *q)
{
    tahr__fcl_query *own = (tahr__fcl_query *)q;
    const tahr__fcl_question question = {tahr__piece_query_box(q), wants, q};

    tahr__fcl_list_begin(&own->list, q->scene->host, own->room, TAHR__FCL_ROOM);
    if (tahr__fcl_cache_find(own, &question.box, &own->parts, &own->count)) return TAHR_OK;
    q->context->gathers++;
    tahr_status status = tahr__fcl_engine_gather(tahr__fcl_scene_of(q)->engine, &question, &own->list);
    tahr__fcl_list_sort(&own->list);
    own->parts = own->list.parts;
    own->count = own->list.count;
    return status;
}

static void end(tahr__piece_query *q)
{
    tahr__fcl_list_free(&((tahr__fcl_query *)q)->list);
}

static void rewind_parts(tahr__piece_query *q)
{
    ((tahr__fcl_query *)q)->at = 0;
}

static int next(tahr__piece_query *q, uint64_t *name)
{
    tahr__fcl_query *own = (tahr__fcl_query *)q;

    *name = own->at;
    return own->at++ < own->count;
}

/* Where an attached body is FCL says, at every query. */
static void follow(tahr__piece_query *q, uint32_t body)
{
    const tahr__fcl_scene *scene = tahr__fcl_scene_of(q);
    tahr__mat turn;
    tahr_pose pose;

    if (!scene->desc.manager || q->frame_body == &q->scene->bodies[body]) return;
    tahr__fcl_engine_pose(scene->engine, body, &pose, &turn);
    tahr__placement_make(pose.position, &turn, &q->start, &q->frame);
    q->frame_body = &q->scene->bodies[body];
}

/* Before a piece is made of a cell: most of what an octree lists is out of the box of the query. */
static int cell_within_reach(const tahr__piece_query *q, tahr_vec3 middle, double half)
{
    tahr_vec3 at = v_add(q->frame.base, middle);
    return q->frame.turned ||
           (at.x - half <= q->box.max.x && at.x + half >= q->box.min.x && at.y - half <= q->box.max.y &&
            at.y + half >= q->box.min.y && at.z - half <= q->box.max.z && at.z + half >= q->box.min.z);
}

static int within_reach(const tahr__piece_query *q, const tahr__piece *piece)
{
    tahr_bounds bounds = {piece->facet.v[0], piece->facet.v[0]};
    tahr_vec3 half = v_make(piece->radius, piece->radius, piece->radius);

    if (piece->kind == TAHR__HALF_SPACE || piece->kind == TAHR__CONVEX) return 1; /* FCL has looked at its bounds */
    if (piece->kind == TAHR__TRIANGLE) {
        bounds.min = v_min(piece->facet.v[0], v_min(piece->facet.v[1], piece->facet.v[2]));
        bounds.max = v_max(piece->facet.v[0], v_max(piece->facet.v[1], piece->facet.v[2]));
        return tahr__bounds_meet(&bounds, &q->box);
    }
    for (int i = 0; i < piece->solid.axis_count; i++)
        half = v_add(half, v_abs(piece->solid.axis[i]));
    bounds.min = v_sub(piece->middle, half);
    bounds.max = v_add(piece->middle, half);
    return tahr__bounds_meet(&bounds, &q->box);
}

/* A half space, or a cell. */
static int make_other(tahr__piece_query *q, const tahr__scene_body *b, tahr__piece_found *found)
{
    tahr_vec3 middle, half;

    tahr__piece_enter(q, b, found);
    if (b->kind != TAHR__FCL_OCTREE) {
        tahr__piece_half_space(&q->frame, b->half_extents, b->radius, &found->piece);
        found->piece.two_sided = b->two_sided;
        return 1;
    }
    tahr__fcl_cell_box(b, tahr__fcl_query_part(q, found->name), &middle, &half);
    if (!cell_within_reach(q, middle, half.x)) return 0;
    tahr__piece_box(&q->frame, middle, half, &found->piece);
    found->piece.is_cell = 1;
    return within_reach(q, &found->piece);
}

static int make(tahr__piece_query *q, tahr__piece_found *found)
{
    const tahr__fcl_part *part = tahr__fcl_query_part(q, found->name);
    const tahr__scene_body *b = &q->scene->bodies[part->body];

    if (!tahr__piece_wanted(q, b)) return 0;
    follow(q, part->body);
    if (b->kind >= TAHR__FCL_OCTREE) return make_other(q, b, found);
    tahr__piece_of_body(q, b, part->triangle, found);
    return within_reach(q, &found->piece);
}

static void measure(tahr__piece_query *q, const tahr__piece_found *found, tahr__near *near)
{
    tahr__piece_measure(&q->shape, v_make(0, 0, 0), &found->piece, near);
    if (found->piece.is_cell && near->distance < -q->shape.radius) tahr__fcl_cell_way_out(q, found, near);
}

static int felt(const tahr__piece_query *q, const tahr__piece_found *found, const tahr__near *near)
{
    return !found->piece.is_cell || tahr__fcl_cell_felt(q, found, near);
}

/* Of a cell: ten bits of its place along x and y, nine along z, and the face: one name for all cells within 512 of each
 * other, and the same again whenever the map is opened. */
static uint32_t feature(const tahr__piece_query *q, const tahr__piece_found *found, tahr_vec3 normal)
{
    const tahr__fcl_part *p = tahr__fcl_query_part(q, found->name);
    uint32_t own = tahr__piece_feature(&found->piece, normal);

    if (!found->piece.is_cell) return own;
    return (p->key[2] & 0x1FFu) << 23 | (p->key[1] & 0x3FFu) << 13 | (p->key[0] & 0x3FFu) << 3 | own;
}

const tahr__piece_finder tahr__fcl_finder = {.begin = begin,
                                             .end = end,
                                             .rewind = rewind_parts,
                                             .next = next,
                                             .make = make,
                                             .measure = measure,
                                             .felt = felt,
                                             .feature = feature};

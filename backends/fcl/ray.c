/* SPDX-License-Identifier: MIT
 * ray.c: the ray slot: a point advances by tangents of the core distance, which for a face is one exact step. */
#include "scene.h"

#include "../common/hits.h"
#include "../common/one_way.h"

/* Does the piece lie in the way, by its face? */
static int meet(tahr__fcl_query *q, uint32_t part, double limit, tahr_hit *hit)
{
    const tahr__fcl_body *b = tahr__fcl_query_body(q, part);
    tahr__motion motion = {&q->shape, q->motion, 0, &q->context->narrow_iterations};
    double fraction = 0;
    tahr__piece piece;
    tahr__near near;

    if (!tahr__fcl_query_piece(q, part, &piece)) return 0;
    q->context->narrow_tests++;
    tahr__piece_measure(&q->shape, v_make(0, 0, 0), &piece, &near);
    if (piece.kind != TAHR__TRIANGLE && !piece.two_sided && near.distance <= 0)
        return 0; /* from inside nothing is hit */
    if (tahr__piece_advance(&motion, &piece, limit, &fraction, &near) != TAHR__HIT) return 0;
    tahr__hit_of(&b->surface, hit);
    /* So near to a bare face or edge the direction between the nearest points is rounding: the face's own is not. */
    hit->surface_normal = near.normal;
    tahr__piece_face(&piece, v_scale(q->motion, -1), &near, &hit->surface_normal);
    if (piece.two_sided && v_dot(hit->surface_normal, q->motion) > 0)
        hit->surface_normal = v_scale(hit->surface_normal, -1);
    hit->normal = near.normal = hit->surface_normal;
    if (b->kind == TAHR__FCL_OCTREE && !tahr__fcl_cell_felt(q, part, &piece, &near)) return 0;
    double against = -v_dot(hit->normal, q->motion);
    if (against <= 0) return 0;
    if (tahr__one_way_is(b->surface.flags) && against < TAHR__ONE_WAY_TOP * q->motion_length) return 0;
    hit->fraction = fraction;
    hit->point = v_mad(q->origin, q->motion, fraction);
    hit->feature = tahr__fcl_feature(q, part, &piece, hit->normal);
    return 1;
}

tahr_status tahr__fcl_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                          uint32_t *count)
{
    tahr__fcl_query q;
    tahr_status status;

    *count = 0;
    q.scene = self;
    tahr__shape_point(&q.shape);
    q.margin = 0;
    q.origin = query->origin;
    q.motion = query->motion;
    q.filter = tahr__filter_of_ray(query);
    status = tahr__fcl_query_begin(&q, context, 0);
    for (uint32_t i = 0; status >= 0 && i < q.count; i++) {
        double limit = *count ? d_min(1, hit->fraction * (1 + 1e-9) + 1e-12) : 1;
        tahr_hit candidate;
        if (!meet(&q, i, limit, &candidate)) continue;
        if (*count && !tahr__hit_before(&candidate, hit)) continue;
        *hit = candidate;
        *count = 1;
    }
    tahr__fcl_query_end(&q);
    return status < 0 ? status : TAHR_OK;
}

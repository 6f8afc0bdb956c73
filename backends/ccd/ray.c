/* SPDX-License-Identifier: MIT
 * ray.c: the ray slot. libccd has no rays and no answer for points: a point advances by tangents of the distance, which
 * for a face is one exact step. */
#include "../common/hits.h"
#include "scene.h"

static int visit(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit, tahr_hit *hit)
{
    const tahr__ccd_body *b = piece->body;
    tahr_vec3 centre;
    tahr__ccd_near near;
    double fraction = 0;

    probe->context->narrow_tests++;
    tahr__ccd_measure(probe, piece, v_make(0, 0, 0), &near);
    if (b->type != TAHR_BODY_MESH && near.distance <= 0) return 0; /* from inside nothing is hit */
    if (tahr__ccd_advance(probe, piece, limit, &fraction, &near) != TAHR__CCD_HIT) return 0;
    centre = v_scale(probe->motion, fraction);
    tahr__hit_of(&b->surface, hit);
    /* So near to a bare face or edge the direction between the nearest points is rounding: the face's own is not. */
    tahr__ccd_face(probe, piece, v_scale(probe->motion, -1), &near, &hit->surface_normal);
    if (b->type == TAHR_BODY_MESH && b->surface.flags & TAHR_BODY_TWO_SIDED &&
        v_dot(hit->surface_normal, probe->motion) > 0) {
        hit->surface_normal = v_scale(hit->surface_normal, -1);
    }
    hit->normal = hit->surface_normal;
    double into = -v_dot(hit->normal, probe->motion);
    if (into <= 0 || (tahr__one_way_is(b->surface.flags) && into < TAHR__ONE_WAY_TOP * probe->motion_length)) return 0;
    hit->fraction = fraction;
    hit->point = tahr__ccd_world(probe, centre);
    near.normal = hit->normal;
    hit->feature = tahr__ccd_feature(piece, &near);
    return 1;
}

tahr_status tahr__ccd_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                          uint32_t *count)
{
    tahr__ccd_probe probe = {.scene = self,
                             .context = context,
                             .origin = query->origin,
                             .motion = query->motion,
                             .filter = tahr__filter_of_ray(query)};
    tahr__ccd_walk walk;
    tahr__ccd_piece piece;

    *count = 0;
    if (tahr__ccd_probe_shape(&probe, NULL, v_make(0, 0, 1), (tahr_quat){0, 0, 0, 1}) < 0) return TAHR_E_ARGUMENT;
    tahr__ccd_walk_begin(&walk, &probe, probe.motion, 0);
    while (tahr__ccd_walk_next(&walk, &piece)) {
        tahr_hit candidate;
        double limit = *count ? d_min(1, hit->fraction * (1 + 1e-9) + 1e-12) : 1;
        if (!visit(&probe, &piece, limit, &candidate)) continue;
        if (*count && !tahr__hit_before(&candidate, hit)) continue;
        *hit = candidate;
        *count = 1;
    }
    return TAHR_OK;
}

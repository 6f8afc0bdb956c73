/* SPDX-License-Identifier: MIT
 * plane.h: what the planes of a triangle say about a motion, before anything is measured. Inline: a sweep asks it of
 * every triangle around. */
#ifndef TAHR_NATIVE_PLANE_H
#define TAHR_NATIVE_PLANE_H

#include "scene.h"

/* A fraction that no motion has. */
#define NEVER 2.0

/* Half the extent of an upright segment, or of a point, along n. */
static inline double upright_extent(const tahr__query *query, tahr_vec3 n)
{
    return fabs(query->half * n.z);
}

static inline double extent_along(const tahr__query *query, tahr_vec3 n)
{
    return query->core.axis_count < 2 ? upright_extent(query, n) : tahr__box_extent(query, n);
}

/* Core and triangle are `gap` (> 0) apart along an axis (less the target; times its length) and come nearer by `rate`
 * over the whole motion: the time before which nothing happens; NEVER, if that is beyond the limit or they do not. */
static inline double closing_time(double gap, double rate, double limit)
{
    /* A little more than the limit, so that the quotient alone decides what ties with it. */
    return gap > limit * rate * (1 + 1e-15) ? NEVER : gap / rate;
}

/* Does the core stay behind a one-sided face? Contacts from so far behind fail the test for one-sided faces (1e-6 of
 * the distance) anyway. */
static inline int stays_behind(double first, double last, double extent, double reach, double length)
{
    return d_max(first, last) + extent < -(1e-5 * reach + 1e-8) * length;
}

/* What the plane alone says: a time before which the primitive does not stop the motion; NEVER, if that is beyond
 * limit: the core stays beyond the target on one side of it, or behind a one-sided face, which is all most triangles
 * get. For the distance to the triangle is at least that to any plane that separates. 0: look at the start. */
static inline double plane_earliest(const tahr__query *query, const tahr__prim *prim, double limit)
{
    if (prim->kind & TAHR__PLANELESS) return 0;
    tahr_vec3 n = prim->facet.cross;
    double reach = query->radius + query->margin, length = prim->facet.length, extent = extent_along(query, n);
    double first = v_dot(n, v_sub(query->start, prim->facet.v[0])), change = v_dot(n, query->motion);
    if (!(prim->kind & TAHR__TWO_SIDED) && stays_behind(first, first + change, extent, reach, length)) return NEVER;
    double rate = first < 0 ? change : -change, beyond = fabs(first) - extent;
    if (beyond >= reach * length && beyond - rate >= reach * length) return NEVER;
    /* Half of what counts as arrived is left, so that rounding never makes it late. */
    double gap = beyond - (reach + 0.5 * TAHR__ARRIVED) * length;
    /* Touching the margin from outside and not coming nearer: a walker at rest on its clearance. */
    if (rate <= TAHR__PARALLEL * query->motion_length * length) return gap >= -TAHR__ARRIVED * length ? NEVER : 0;
    /* A target of nothing needs the way there to know its normal. */
    return gap <= 0 || reach < 1e-6 ? 0 : closing_time(gap, rate, limit);
}

/* Taken off distances, so that no rounding of what follows, a thousandth of it, makes a time too late (m). */
#define ROOM 1e-7

/* The same by the edges, not before `earliest`, what the plane says: for ordering and leaving out, not to begin at.
 * Seen along an edge the triangle is a ray, and the core a point h above its line and o beyond its end; the plane
 * through that end across the way to the point separates them. Of the edges the one that is farthest is asked. */
static inline double edges_earliest(const tahr__query *query, const tahr__prim *prim, double limit, double earliest)
{
    if (prim->kind & TAHR__PLANELESS) return earliest;
    const tahr__facet *f = &prim->facet;
    double reach = query->radius + query->margin + ROOM, length2 = f->length * f->length, far2 = 0, far_rate = 0;
    tahr_vec3 n = f->cross, d = v_sub(v_mad(query->start, query->motion, earliest), f->v[0]), x = v_cross(d, n);
    tahr_vec3 e[3] = {v_sub(f->v[1], f->v[0]), v_sub(f->v[2], f->v[1]), v_sub(f->v[0], f->v[2])};
    /* Beyond edge i by out[i] times its length and that of n; the sum of the three is -n . n. */
    double out[3] = {-v_dot(e[0], x), 0, -v_dot(e[2], x)};
    out[1] = -length2 - out[0] - out[2];
    for (int i = 0; i < 3; i++) {
        tahr_vec3 across = v_cross(e[i], n);
        double o = out[i] - extent_along(query, across), e2 = v_dot(e[i], e[i]) * length2;
        if (o <= 0 || o * o <= far2 * e2) continue;
        far2 = o * o / e2;
        far_rate = o * v_dot(across, query->motion) / e2;
    }
    double height = v_dot(n, d), h = d_max(fabs(height) - extent_along(query, n), 0), away2 = far2 + h * h / length2;
    if (far2 == 0 || away2 <= reach * reach) return earliest;
    double h_rate = h * v_dot(n, query->motion) / length2, away = sqrt(away2);
    double rate = -(far_rate + (height < 0 ? -h_rate : h_rate));
    return earliest + closing_time((away - reach) * away, rate, limit - earliest);
}

#endif

/* SPDX-License-Identifier: MIT
 * plane.h: what the planes of a triangle say about a motion, before anything is measured. Inline: a sweep asks it of every
 * triangle around. */
#ifndef TAHR_NATIVE_PLANE_H
#define TAHR_NATIVE_PLANE_H

#include "scene.h"

/* A fraction that no motion has. */
#define NEVER 2.0

/* Core and triangle are `gap` (> 0) apart along an axis (less the target; times its length) and come nearer by `rate` over
 * the whole motion: moves the time before which nothing happens. Returns 0 if that is beyond the limit. */
static inline int apart(double gap, double rate, double limit, double *t)
{
    /* Also: not coming nearer. A little more than the limit, so that the quotient alone decides what ties with it. */
    if (gap > limit * rate * (1 + 1e-15)) return 0;
    if (gap > *t * rate) *t = gap / rate;
    return *t <= limit;
}

/* Half the extent of an upright segment, or of a point, along n. */
static inline double upright_extent(const tahr__query *query, tahr_vec3 n)
{
    return fabs(query->half * n.z);
}

static inline double extent_along(const tahr__query *query, tahr_vec3 n)
{
    return query->core.axis_count < 2 ? upright_extent(query, n) : tahr__core_extent(&query->core, n);
}

/* The upright planes through the edges, which together with the face on either side bound the sum of triangle and upright
 * core. turn: 1 if the face looks up, -1 if down. */
static inline int apart_sideways(const tahr__query *query, const tahr_vec3 v[3], double turn, double limit, double *t)
{
    double reach = query->radius + query->margin + 0.5 * TAHR__ARRIVED, reach2 = reach * reach;
    tahr_vec3 start = query->start;
    for (int i = 0; i < 3; i++) {
        int j = i < 2 ? i + 1 : 0;
        double x = turn * (v[j].y - v[i].y), y = -turn * (v[j].x - v[i].x);
        double out = x * (start.x - v[i].x) + y * (start.y - v[i].y);
        if (!(out > 0)) continue;
        double wide2 = x * x + y * y;
        if (out * out <= reach2 * wide2) continue; /* no root where it decides nothing */
        if (!apart(out - reach * sqrt(wide2), -(x * query->motion.x + y * query->motion.y), limit, t)) return 0;
    }
    return 1;
}

/* What planes alone say: a time before which the primitive does not stop the motion; NEVER, if that is beyond limit: the
 * core stays beyond the target on one side of a plane, or behind a one-sided face, which is all most triangles get. For
 * the distance to the triangle is at least that to any plane that separates. 0: look at the start. */
static inline double plane_earliest(const tahr__query *query, const tahr__prim *prim, double limit)
{
    if ((prim->item & (TAHR__ITEM_ROUND | TAHR__ITEM_SOLID)) || (prim->kind & TAHR__THIN)) return 0;
    tahr_vec3 n = prim->facet.cross;
    double reach = query->radius + query->margin, length = prim->facet.length;
    double first = v_dot(n, v_sub(query->start, prim->facet.v[0])), change = v_dot(n, query->motion);
    double extent = extent_along(query, n), last = first + change;
    double low = d_min(first, last) - extent, high = d_max(first, last) + extent;
    if (low >= reach * length || high <= -reach * length) return NEVER;
    /* Contacts from so far behind fail the test for one-sided faces (1e-6 of the distance) anyway. */
    if (high < 0 && !(prim->kind & TAHR__TWO_SIDED) && high < -(1e-5 * reach + 1e-8) * length) return NEVER;
    double above = fabs(first), rate = first < 0 ? change : -change, t = 0;
    /* Half of what counts as arrived is left, so that rounding never makes it late. */
    double gap = above - extent - (reach + 0.5 * TAHR__ARRIVED) * length;
    /* Touching the margin from outside and not coming nearer: a walker at rest on its clearance. */
    if (rate <= 0 && gap >= -TAHR__ARRIVED * length) return NEVER;
    if (reach < 1e-6) return 0; /* a target of nothing needs the way there to know its normal */
    if (gap > 0 && !apart(gap, rate, limit, &t)) return NEVER;
    if (query->core.axis_count < 2 && !apart_sideways(query, prim->facet.v, n.z < 0 ? -1 : 1, limit, &t)) return NEVER;
    return t;
}

#endif

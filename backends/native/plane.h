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
/* Sine up to which a plane is upright enough for either end of a segment to be the nearest. */
#define UPRIGHT 1e-6

/* The way from the edge of a triangle that a point is farthest beyond. */
typedef struct beyond {
    tahr_vec3 toward; /* m, across the edge to the point, and off the plane by h */
    double away2;     /* m2, its square; 0: it is beyond no edge */
    int edge;
} beyond;

/* d: from the triangle's first corner to the point, or to the middle of a box; h: off the plane. */
static inline beyond edge_beyond(const tahr__query *query, const tahr__facet *f, tahr_vec3 d, const tahr_vec3 e[3],
                                 double h)
{
    const int is_box = query->core.axis_count > 1;
    const tahr_vec3 n = f->cross, x = v_cross(d, n);
    const double length2 = f->length * f->length;
    /* Beyond edge i by out[i] times its length and that of n; the sum of the three is -n . n. */
    double out[3] = {-v_dot(e[0], x), 0, -v_dot(e[2], x)}, o = 0, e2 = 1;
    out[1] = -length2 - out[0] - out[2];
    beyond b = {{0, 0, 0}, 0, 0};
    for (int i = 0; i < 3; i++) {
        const double more = is_box ? out[i] - tahr__box_extent(query, v_cross(e[i], n)) : out[i];
        if (more <= 0) continue;
        const double size2 = v_dot(e[i], e[i]);
        if (more * more * e2 <= o * o * size2) continue;
        o = more;
        e2 = size2;
        b.edge = i;
    }
    if (o == 0) return b;
    const double scale = 1 / (e2 * length2);
    b.toward = v_mad(v_scale(v_cross(e[b.edge], n), o * scale), n, h * e2 * scale);
    b.away2 = (o * o + h * h * e2) * scale;
    return b;
}

/* Across an edge and level: which way a segment and an edge are apart that are nearest somewhere between their ends. */
static inline tahr_vec3 across_level(const beyond *b, tahr_vec3 along)
{
    const double side = along.y * b->toward.x - along.x * b->toward.y;
    return side < 0 ? v_make(-along.y, along.x, 0) : v_make(along.y, -along.x, 0);
}

/* The same by the edges, not before `earliest`, what the plane says: for ordering and leaving out, not to begin at.
 * Seen along an edge the triangle is a ray, and an end of the core a point h above its line and o beyond its end; the
 * plane through that end across the way to the point separates them. Of the edges the one that is farthest is asked, of
 * a segment the end that is nearest to the plane of the triangle, or either, if that is upright. Where the other end is
 * nearer along that way both are as near across the edge and up; then the corners say how far. */
static inline double edges_earliest(const tahr__query *query, const tahr__prim *prim, double limit, double earliest)
{
    if (prim->kind & TAHR__PLANELESS) return earliest;
    const tahr__facet *f = &prim->facet;
    const double reach = query->radius + query->margin + ROOM;
    const tahr_vec3 n = f->cross, e[3] = {v_sub(f->v[1], f->v[0]), v_sub(f->v[2], f->v[1]), v_sub(f->v[0], f->v[2])};
    tahr_vec3 d = v_sub(v_mad(query->start, query->motion, earliest), f->v[0]);
    double height = v_dot(n, d), h = d_max(fabs(height) - extent_along(query, n), 0);
    double end = (height < 0) == (n.z < 0) ? -query->half : query->half;
    h = height < 0 ? -h : h;
    d.z += end;
    beyond b = edge_beyond(query, f, d, e, h);
    if (b.away2 <= reach * reach) return earliest;
    if (b.toward.z * end > 0 && fabs(n.z) < UPRIGHT * f->length) {
        end = -end;
        d.z += 2 * end;
        b = edge_beyond(query, f, d, e, h);
        if (b.away2 <= reach * reach) return earliest;
    }
    double gap = b.away2;
    if (b.toward.z * end > 0) {
        b.toward = across_level(&b, e[b.edge]);
        gap = v_dot(b.toward, d) - d_max(0, d_max(v_dot(b.toward, e[0]), -v_dot(b.toward, e[2])));
        b.away2 = v_dot(b.toward, b.toward);
    }
    gap -= reach * sqrt(b.away2);
    return gap > 0 ? earliest + closing_time(gap, -v_dot(b.toward, query->motion), limit - earliest) : earliest;
}

#endif

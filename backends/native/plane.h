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

/* Where a point is to a triangle that it is not straight over. */
typedef struct off_edge {
    tahr_vec3 toward; /* m, from the nearest point of the edge that it is farthest beyond */
    uint32_t feature; /* TAHR__EDGE + i or TAHR__CORNER + i; TAHR__FACE: it is straight over it */
} off_edge;

/* Which edge a place is farthest beyond, and by how much, times its length and that of n; of a box with its extent. d:
 * from the first corner of the triangle. Returns 3: none. */
static inline uint32_t edge_beyond(const tahr__query *query, const tahr__facet *f, tahr_vec3 d, const tahr_vec3 e[3],
                                   double *far)
{
    const int is_box = query->core.axis_count > 1;
    const tahr_vec3 n = f->cross, x = v_cross(d, n);
    /* The sum of the three is -n . n. */
    double out[3] = {-v_dot(e[0], x), 0, -v_dot(e[2], x)}, size2 = 1;
    uint32_t edge = 3;
    out[1] = -f->length * f->length - out[0] - out[2];
    *far = 0;
    for (uint32_t i = 0; i < 3; i++) {
        const double o = is_box ? out[i] - tahr__box_extent(query, v_cross(e[i], n)) : out[i];
        if (o <= 0) continue;
        const double e2 = v_dot(e[i], e[i]);
        if (edge < 3 && o * o * size2 <= *far * *far * e2) continue;
        *far = o;
        size2 = e2;
        edge = i;
    }
    return edge;
}

static inline off_edge point_beyond(const tahr__query *query, const tahr__facet *f, tahr_vec3 d, const tahr_vec3 e[3])
{
    double far;
    const uint32_t i = edge_beyond(query, f, d, e, &far);
    off_edge b = {d, TAHR__FACE};
    if (i > 2) return b;
    const tahr_vec3 from = i == 0 ? d : v_sub(d, i == 1 ? e[0] : v_scale(e[2], -1));
    const double along = v_dot(from, e[i]), e2 = v_dot(e[i], e[i]);
    b.feature = TAHR__EDGE + i;
    if (along <= 0 || along >= e2) b.feature = TAHR__CORNER + (along <= 0 ? i : (i + 1) % 3);
    b.toward = v_mad(from, e[i], -d_max(0, d_min(along, e2)) / e2);
    return b;
}

/* Across an edge and level, or level from a corner: which way an upright segment and it are apart that are nearest
 * somewhere between the ends of the segment. */
static inline tahr_vec3 level_beyond(const off_edge *b, const tahr_vec3 e[3])
{
    if (b->feature >= TAHR__CORNER) return v_make(b->toward.x, b->toward.y, 0);
    const tahr_vec3 along = e[b->feature - TAHR__EDGE];
    const double side = along.y * b->toward.x - along.x * b->toward.y;
    return side < 0 ? v_make(-along.y, along.x, 0) : v_make(along.y, -along.x, 0);
}

/* m, times the length of `toward`: how far a place is along it from all of a triangle. */
static inline double gap_along(tahr_vec3 toward, tahr_vec3 d, const tahr_vec3 e[3])
{
    return v_dot(toward, d) - d_max(0, d_max(v_dot(toward, e[0]), -v_dot(toward, e[2])));
}

/* Of a box: seen along the edge the triangle is a ray, and the box h above its line and o beyond its end. */
static inline double box_beyond(const tahr__query *query, const tahr__facet *f, tahr_vec3 d, const tahr_vec3 e[3],
                                tahr_vec3 *toward)
{
    double far;
    const uint32_t i = edge_beyond(query, f, d, e, &far);
    *toward = v_make(0, 0, 0);
    if (i > 2) return 0;
    const tahr_vec3 n = f->cross;
    const double height = v_dot(n, d), h = d_max(fabs(height) - tahr__box_extent(query, n), 0);
    const double e2 = v_dot(e[i], e[i]), scale = 1 / (e2 * f->length * f->length);
    *toward = v_mad(v_scale(v_cross(e[i], n), far * scale), n, (height < 0 ? -h : h) * e2 * scale);
    return (far * far + h * h * e2) * scale;
}

/* The same by edges and corners, not before `earliest`, what the plane says: for ordering and leaving out, not to begin
 * at. A place beside the triangle is off the edge that it is farthest beyond, or off the end of that; across the way
 * from there to the place lies a plane that may separate them, and the corners say by how much: the distance is at
 * least that. The place is the end of a segment that is nearest to the plane of the triangle, or either, if that plane
 * is upright; where the other end is nearer along that way, a level way is taken, along which both are alike. */
static inline double edges_earliest(const tahr__query *query, const tahr__prim *prim, double limit, double earliest)
{
    if (prim->kind & TAHR__PLANELESS) return earliest;
    const tahr__facet *f = &prim->facet;
    const double reach = query->radius + query->margin + ROOM;
    const tahr_vec3 n = f->cross, e[3] = {v_sub(f->v[1], f->v[0]), v_sub(f->v[2], f->v[1]), v_sub(f->v[0], f->v[2])};
    tahr_vec3 d = v_sub(v_mad(query->start, query->motion, earliest), f->v[0]), toward;
    double gap;
    if (query->core.axis_count > 1) {
        gap = box_beyond(query, f, d, e, &toward);
    } else {
        double end = (v_dot(n, d) < 0) == (n.z < 0) ? -query->half : query->half;
        d.z += end;
        off_edge b = point_beyond(query, f, d, e);
        if (b.feature == TAHR__FACE) return earliest;
        if (b.toward.z * end > 0 && fabs(n.z) < UPRIGHT * f->length) {
            end = -end;
            d.z += 2 * end;
            b = point_beyond(query, f, d, e);
            if (b.feature == TAHR__FACE) return earliest;
        }
        toward = b.toward.z * end > 0 ? level_beyond(&b, e) : b.toward;
        gap = gap_along(toward, d, e);
    }
    gap -= reach * v_length(toward);
    return gap > 0 ? earliest + closing_time(gap, -v_dot(toward, query->motion), limit - earliest) : earliest;
}

#endif

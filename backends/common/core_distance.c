/* SPDX-License-Identifier: MIT
 * core_distance.c: nearest points between a triangle and a point, a segment or a box. */
#include "core.h"

/* Of the sizes of box and triangle: nearer than this, or less deep, they touch. A thousand times what rounding
 * makes. */
#define TOUCHING 1e-12
/* Pairs of edges with a squared sine below this are parallel: what is across them is rounding. */
#define NEARLY_PARALLEL 1e-20
/* What rounding makes of a height along a unit normal, of the coordinates that it is made of, and more. */
#define ROUNDING 1e-14
/* From as far away (m) as this the nearest points are clear. */
#define CLEAR 1e-6

static void witness_at(tahr__witness *out, tahr_vec3 q, tahr_vec3 p, uint32_t feature)
{
    tahr_vec3 d = v_sub(q, p);
    double g = v_length(d);
    out->distance = g;
    out->point = p;
    out->feature = feature;
    if (g > 0) out->normal = v_scale(d, 1.0 / g);
}

/* Nearest point of edge i to q; clamps land on the corner itself, so that neighbours find the same bits. */
static tahr_vec3 on_edge(tahr_vec3 q, const tahr_vec3 v[3], int i, uint32_t *feature)
{
    tahr_vec3 a = v[i], b = v[(i + 1) % 3], e = v_sub(b, a);
    double along = v_dot(v_sub(q, a), e), length2 = v_dot(e, e);
    if (!(along > 0) || !(length2 > 0)) {
        *feature = TAHR__CORNER + (uint32_t)i;
        return a;
    }
    if (along >= length2) {
        *feature = TAHR__CORNER + (uint32_t)((i + 1) % 3);
        return b;
    }
    *feature = TAHR__EDGE + (uint32_t)i;
    /* Measure from the nearer end: the rounding of a long edge then stays small near both of its ends. */
    if (along + along <= length2) return v_mad(a, e, along / length2);
    return v_mad(b, e, -(v_dot(v_sub(b, q), e) / length2));
}

/* Off the face: the nearest point of the edges that the projection is outside of; for a triangle without area of
 * any. */
static void beside_face(tahr_vec3 q, const tahr_vec3 v[3], const double side[3], int flat, tahr__witness *out)
{
    double best = -1;
    for (int i = 0; i < 3; i++) {
        if (flat && side[i] >= 0) continue;
        uint32_t feature;
        tahr_vec3 p = on_edge(q, v, i, &feature), r = v_sub(q, p);
        double r2 = v_dot(r, r);
        if (best >= 0 && r2 >= best) continue;
        best = r2;
        out->point = p;
        out->feature = feature;
    }
    witness_at(out, q, out->point, out->feature);
}

/* Is q straight over the face? side[i] > 0: it is inside of edge i; their sum is n2, the square of twice the area. */
static inline int is_over(tahr_vec3 q, const tahr__facet *f, double n2, double side[3])
{
    const tahr_vec3 *v = f->v;
    tahr_vec3 e0 = v_sub(v[1], v[0]), e2 = v_sub(v[0], v[2]), x = v_cross(v_sub(q, v[0]), f->cross);
    side[0] = v_dot(e0, x);
    side[2] = v_dot(e2, x);
    side[1] = n2 - side[0] - side[2];
    return n2 > 0 && side[0] >= 0 && side[1] >= 0 && side[2] >= 0;
}

void tahr__point_facet(tahr_vec3 q, const tahr__facet *f, tahr__witness *out)
{
    double side[3], n2 = v_dot(f->cross, f->cross);
    if (is_over(q, f, n2, side))
        tahr__point_face(q, f, out);
    else
        beside_face(q, f->v, side, n2 > 0, out);
}

double tahr__segment_segment(tahr_vec3 p0, tahr_vec3 p1, tahr_vec3 q0, tahr_vec3 q1, double *s, double *t)
{
    tahr_vec3 d1 = v_sub(p1, p0), d2 = v_sub(q1, q0), r = v_sub(p0, q0);
    double a = v_dot(d1, d1), e = v_dot(d2, d2), f = v_dot(d2, r), c = v_dot(d1, r);
    if (!(a > 0) && !(e > 0)) {
        *s = *t = 0;
    } else if (!(a > 0)) {
        *s = 0;
        *t = d_min(1, d_max(0, f / e));
    } else if (!(e > 0)) {
        *t = 0;
        *s = d_min(1, d_max(0, -c / a));
    } else {
        /* The squared sine by a cross product: a*e - b*b would lose it for nearly parallel segments. */
        tahr_vec3 x = v_cross(d1, d2);
        double b = v_dot(d1, d2), det = v_dot(x, x);
        *s = det > 0 ? d_min(1, d_max(0, v_dot(v_cross(d2, r), x) / det)) : 0;
        *t = (b * *s + f) / e;
        if (*t < 0) {
            *t = 0;
            *s = d_min(1, d_max(0, -c / a));
        } else if (*t > 1) {
            *t = 1;
            *s = d_min(1, d_max(0, (b - c) / a));
        }
    }
    tahr_vec3 d = v_sub(v_mad(p0, d1, *s), v_mad(q0, d2, *t));
    return v_dot(d, d);
}

/* Does the segment a b, whose ends are on opposite sides of the triangle's plane, pass through the triangle, and at p?
 * Of one that lies in that plane the sides are rounding, and p may be far from it. */
static int pierces(tahr_vec3 a, tahr_vec3 b, tahr_vec3 p, const tahr__facet *f)
{
    const tahr_vec3 *v = f->v;
    tahr_vec3 d = v_sub(b, a);
    double side[3];
    for (int i = 0; i < 3; i++)
        side[i] = v_dot(d, v_cross(v_sub(v[i], a), v_sub(v[(i + 1) % 3], a)));
    if (!((side[0] >= 0 && side[1] >= 0 && side[2] >= 0) || (side[0] <= 0 && side[1] <= 0 && side[2] <= 0))) return 0;
    tahr__witness w;
    tahr__point_facet(p, f, &w);
    return w.distance <= CLEAR;
}

static void keep_nearer(tahr__witness *out, const tahr__witness *w)
{
    if (w->distance < out->distance) *out = *w;
}

static double sum_of(tahr_vec3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

/* Of a segment against edge i: where on either they are nearest. */
typedef struct passing {
    double s, t;
} passing;

static passing against_edge(tahr_vec3 a, tahr_vec3 b, const tahr_vec3 *v, int i, tahr__witness *out)
{
    const tahr_vec3 q0 = v[i], q1 = v[(i + 1) % 3];
    passing at;
    const double d2 = tahr__segment_segment(a, b, q0, q1, &at.s, &at.t);
    if (!(d2 < out->distance * out->distance)) return at;
    uint32_t feature = TAHR__EDGE + (uint32_t)i;
    tahr_vec3 p = v_mad(q0, v_sub(q1, q0), at.t);
    if (at.t <= 0) {
        feature = TAHR__CORNER + (uint32_t)i;
        p = q0;
    } else if (at.t >= 1) {
        feature = TAHR__CORNER + (uint32_t)((i + 1) % 3);
        p = q1;
    }
    tahr__witness w;
    w.normal = v_make(0, 0, 0);
    w.beside = at.s > 0 && at.s < 1;
    witness_at(&w, v_mad(a, v_sub(b, a), at.s), p, feature);
    keep_nearer(out, &w);
    return at;
}

/* A segment against the edges of the triangle; only interior pairs can beat the ends and the corners. No two sets are
 * nearer than they are along one direction: along the normal found so far most edges are seen to be too far away. */
static void against_edges(tahr_vec3 a, tahr_vec3 b, const tahr_vec3 *v, tahr__witness *out)
{
    const tahr_vec3 n = out->normal, from[2] = {v_sub(a, v[0]), v_sub(b, v[0])};
    const tahr_vec3 to[2] = {v_sub(v[1], v[0]), v_sub(v[2], v[0])};
    const double rounding = ROUNDING * (sum_of(from[0]) + sum_of(from[1]) + sum_of(to[0]) + sum_of(to[1]));
    const double height[3] = {0, v_dot(n, to[0]), v_dot(n, to[1])};
    const double needed = d_min(v_dot(n, from[0]), v_dot(n, from[1])) - out->distance - rounding;
    for (int i = 0; i < 3; i++) {
        if (d_max(height[i], height[(i + 1) % 3]) < needed) continue;
        against_edge(a, b, v, i, out);
    }
}

/* Is this end of a segment its nearest point? The distance is convex along the segment, so the slope at the end tells;
 * 1e-13 m per metre is less than the rounding of the distance itself. */
static int is_nearest_end(const tahr__witness *w, tahr_vec3 inward)
{
    double slope = v_dot(w->normal, inward);
    return !(w->distance > 0) || slope >= 0 || slope * slope <= 1e-26 * v_dot(inward, inward);
}

static void segment_facet(tahr_vec3 a, tahr_vec3 b, const tahr__facet *f, tahr__witness *out)
{
    const tahr_vec3 *v = f->v;
    tahr_vec3 n = f->cross;
    double ha = v_dot(n, v_sub(a, v[0])), hb = v_dot(n, v_sub(b, v[0]));
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) {
        const tahr_vec3 p = v_mad(a, v_sub(b, a), ha / (ha - hb));
        if (pierces(a, b, p, f)) {
            out->distance = 0;
            out->feature = TAHR__FACE;
            out->point = p;
            return;
        }
    }
    /* The end nearer to the plane first: most often it is the nearest point, and the rest is not looked at. */
    tahr_vec3 near = fabs(hb) < fabs(ha) ? b : a, far = fabs(hb) < fabs(ha) ? a : b;
    tahr__point_facet(near, f, out);
    if (is_nearest_end(out, v_sub(far, near))) return;
    tahr__witness w = *out;
    tahr__point_facet(far, f, &w);
    keep_nearer(out, &w);
    if (!is_nearest_end(&w, v_sub(near, far))) against_edges(a, b, v, out);
}

/* Does all of the triangle but p (on it) lie behind the plane through p across n, the farther away the more? */
static int lies_behind(const tahr_vec3 *v, tahr_vec3 p, tahr_vec3 n, uint32_t first, uint32_t end)
{
    static const double SLOPE2 = 1e-8;
    const double n2 = v_dot(n, n);
    for (uint32_t i = first; i < end; i++) {
        const tahr_vec3 off = v_sub(v[i % 3], p);
        const double behind = -v_dot(n, off), off2 = v_dot(off, off);
        if (!(behind > 0 && behind * behind > SLOPE2 * n2 * off2 && off2 > SLOPE2 * n2)) return 0;
    }
    return 1;
}

/* Why no other two points are as near, by more than rounding, and so all else would be passed over, bit for bit: n
 * leads from the edge or corner to the inside of the segment, across both. All else of the triangle lies behind the
 * plane across n (lies_behind); what lies along the edge, which is not parallel (SLANT), or along the segment, has left
 * n sideways, and has far to go before either ends (INSIDE), across the other, which goes along (FAR of the distance).
 * Of a corner both of its edges are asked, in their order, as they would be: their roundings differ. */
int tahr__segment_again(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    static const double INSIDE = 1e-3, SLANT2 = 1e-6, FAR2 = 1e-8, LEAST = 1e-5;
    const tahr_vec3 a = v_sub(centre, core->axis[0]), b = v_add(centre, core->axis[0]), d = v_sub(b, a);
    const uint32_t before = out->feature, corner = before - TAHR__CORNER;
    const int is_corner = before >= TAHR__CORNER;
    const uint32_t edge = is_corner ? (corner + 2) % 3 : before - TAHR__EDGE; /* the one that ends there */
    double least_s = 1, least_t = 1;
    if (before == TAHR__FACE) return 0;
    tahr__witness w;
    w.distance = INFINITY;
    for (uint32_t i = 0; i < 3; i++) {
        if (i != edge && !(is_corner && i == corner)) continue;
        const passing at = against_edge(a, b, f->v, (int)i, &w);
        least_s = d_min(least_s, d_min(at.s, 1 - at.s));
        least_t = d_min(at.t, 1 - at.t);
    }
    const double d2 = v_dot(d, d), g2 = w.distance * w.distance;
    if (!(w.feature == before && w.distance > LEAST && least_s > INSIDE && least_s * least_s * d2 > FAR2 * g2))
        return 0;
    const tahr_vec3 n = w.normal;
    if (is_corner) {
        if (!lies_behind(f->v, w.point, v_scale(n, w.distance), corner + 1, corner + 3)) return 0;
    } else {
        const tahr_vec3 e = v_sub(f->v[(edge + 1) % 3], f->v[edge]), x = v_cross(d, e);
        const double x2 = v_dot(x, x), e2 = v_dot(e, e);
        if (!(least_t > INSIDE && x2 > SLANT2 * d2 * e2 && least_s * least_s * x2 > FAR2 * g2 * e2 &&
              least_t * least_t * x2 > FAR2 * g2 * d2 &&
              lies_behind(f->v, w.point, v_scale(n, w.distance), edge + 2, edge + 3))) {
            return 0;
        }
    }
    *out = w;
    return 1;
}

/* Nearest point of the box to p; the normal points from p, a corner of the triangle, to the box. */
static void corner_to_box(const tahr__core *core, tahr_vec3 centre, tahr_vec3 p, uint32_t feature, tahr__witness *out)
{
    tahr_vec3 d = v_sub(p, centre), q = centre;
    for (int i = 0; i < core->axis_count; i++) {
        double h2 = v_dot(core->axis[i], core->axis[i]);
        if (!(h2 > 0)) continue;
        q = v_mad(q, core->axis[i], d_min(1, d_max(-1, v_dot(d, core->axis[i]) / h2)));
    }
    tahr__witness w;
    w.normal = v_make(0, 0, 0);
    w.beside = 0;
    witness_at(&w, q, p, feature);
    keep_nearer(out, &w);
}

/* Face normals and edge pairs: complete for two polyhedra. */
enum { AXES = 13 };

/* An axis that may separate the box from the triangle with the edges e. */
static inline tahr_vec3 axis_between(const tahr__core *core, const tahr_vec3 e[3], int k)
{
    if (k >= 4) return v_cross(core->axis[(k - 4) / 3], e[(k - 4) % 3]);
    return k == 0 ? v_cross(e[0], e[1]) : core->axis[(k - 1) % 3];
}

/* Is there an axis that does? */
static int separated(const tahr__core *core, const tahr_vec3 r[3])
{
    tahr_vec3 e[3] = {v_sub(r[1], r[0]), v_sub(r[2], r[1]), v_sub(r[0], r[2])};
    for (int k = 0; k < AXES; k++) {
        tahr_vec3 n = axis_between(core, e, k);
        double a = v_dot(n, r[0]), b = v_dot(n, r[1]), c = v_dot(n, r[2]), x = tahr__core_extent(core, n);
        if (d_min(a, d_min(b, c)) > x || d_max(a, d_max(b, c)) < -x) return 1;
    }
    return 0;
}

/* Are there no nearer points of box and triangle? Along the normal between these the two are as far apart. */
static int is_least(const tahr__core *core, tahr_vec3 centre, const tahr_vec3 *v, const tahr__witness *w)
{
    const tahr_vec3 n = w->normal, e1 = v_sub(v[1], v[0]), e2 = v_sub(v[2], v[0]), d = v_sub(centre, v[0]);
    double rounding = ROUNDING * (sum_of(d) + sum_of(e1) + sum_of(e2));
    for (int i = 0; i < 3; i++)
        rounding += ROUNDING * sum_of(core->axis[i]);
    double top = d_max(0, d_max(v_dot(n, e1), v_dot(n, e2)));
    return w->distance > 4 * rounding && v_dot(n, d) - tahr__core_extent(core, n) - top >= w->distance - rounding;
}

static tahr_vec3 corner_of(const tahr__core *core, tahr_vec3 centre, int which)
{
    for (int k = 0; k < 3; k++)
        centre = v_mad(centre, core->axis[k], which >> k & 1 ? 1 : -1);
    return centre;
}

/* A corner of the box that is first on the way to the plane of the triangle, straight over its face. Of a side that
 * lies level on it all are as near, and one will do. Returns 1 if nothing can be nearer. */
static int first_to_face(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    const double height = v_dot(f->cross, v_sub(centre, f->v[0])), n2 = v_dot(f->cross, f->cross);
    int fixed = 0, set = 0;
    for (int k = 0; k < 3; k++) {
        const double along = height < 0 ? -v_dot(f->cross, core->axis[k]) : v_dot(f->cross, core->axis[k]);
        if (fabs(along) <= ROUNDING * f->length * sum_of(core->axis[k])) continue;
        fixed |= 1 << k;
        set |= along < 0 ? 1 << k : 0;
    }
    for (int i = 0; i < 8; i++) {
        double side[3];
        if ((i & fixed) != set) continue;
        tahr_vec3 corner = corner_of(core, centre, i);
        if (!is_over(corner, f, n2, side)) continue;
        tahr__point_face(corner, f, out);
        return is_least(core, centre, f->v, out);
    }
    return 0;
}

static void corners_to_facet(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    for (int i = 0; i < 8; i++) {
        tahr__witness w = *out;
        tahr__point_facet(corner_of(core, centre, i), f, &w);
        keep_nearer(out, &w);
    }
}

static void edges_to_facet(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    tahr_vec3 corner[8];
    for (int i = 0; i < 8; i++)
        corner[i] = corner_of(core, centre, i);
    for (int i = 0; i < 8; i++) {
        for (int bit = 1; bit < 8; bit += bit) {
            if (i & bit) continue;
            const double before = out->distance;
            against_edges(corner[i], corner[i | bit], f->v, out);
            if (out->distance < before && is_least(core, centre, f->v, out)) return;
        }
    }
}

/* What is nearest most often comes first, and the rest is not looked at when nothing can be nearer. */
static void box_facet(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    const tahr_vec3 *v = f->v;
    const tahr_vec3 normal = out->normal;
    out->distance = INFINITY;
    out->feature = TAHR__FACE;
    if (first_to_face(core, centre, f, out)) return;
    for (int i = 0; i < 3; i++)
        corner_to_box(core, centre, v[i], TAHR__CORNER + (uint32_t)i, out);
    if (is_least(core, centre, v, out)) return;
    tahr_vec3 r[3] = {v_sub(v[0], centre), v_sub(v[1], centre), v_sub(v[2], centre)};
    if (!separated(core, r)) {
        out->distance = 0;
        out->feature = TAHR__FACE;
        out->normal = normal;
        out->point = v_scale(v_add(v[0], v_add(v[1], v[2])), 1.0 / 3.0);
        return;
    }
    corners_to_facet(core, centre, f, out);
    if (!is_least(core, centre, v, out)) edges_to_facet(core, centre, f, out);
}

int tahr__box_touches(const tahr__core *box, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    tahr_vec3 r[3] = {v_sub(f->v[0], centre), v_sub(f->v[1], centre), v_sub(f->v[2], centre)};
    tahr_vec3 e[3] = {v_sub(r[1], r[0]), v_sub(r[2], r[1]), v_sub(r[0], r[2])}, normal = v_make(0, 0, 0);
    double size = 0, edges = 0, best = -1e300;
    for (int i = 0; i < 3; i++) {
        size += v_length(box->axis[i]) + v_length(r[i]);
        edges = d_max(edges, v_dot(e[i], e[i]));
    }
    double rounding = TOUCHING * size;
    for (int k = 0; k < AXES; k++) {
        tahr_vec3 n = axis_between(box, e, k);
        double of_box = k < 4 ? 1 : v_dot(box->axis[(k - 4) / 3], box->axis[(k - 4) / 3]), n2 = v_dot(n, n);
        double of_edge = k < 1 ? edges * edges : k < 4 ? 0 : v_dot(e[(k - 4) % 3], e[(k - 4) % 3]);
        if (!(n2 > NEARLY_PARALLEL * of_box * of_edge)) continue;
        n = v_scale(n, 1 / sqrt(n2));
        double a = v_dot(n, r[0]), b = v_dot(n, r[1]), c = v_dot(n, r[2]), extent = tahr__core_extent(box, n);
        double above = d_min(a, d_min(b, c)) - extent, below = -d_max(a, d_max(b, c)) - extent;
        /* One after the other: of those that separate alike the first counts, so the triangle's own. */
        if (d_max(above, below) <= best + (best < -rounding ? 0 : rounding)) continue;
        best = d_max(above, below);
        normal = above > below ? v_scale(n, -1) : n;
    }
    if (best < -rounding) return 0;
    box_facet(box, v_mad(centre, normal, CLEAR), f, out);
    out->normal = normal;
    return 1;
}

void tahr__facet_distance(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out)
{
    out->normal = v_make(0, 0, 0);
    out->beside = 0;
    if (core->axis_count == 0)
        tahr__point_facet(centre, f, out);
    else if (core->axis_count == 1)
        segment_facet(v_sub(centre, core->axis[0]), v_add(centre, core->axis[0]), f, out);
    else
        box_facet(core, centre, f, out);
}

void tahr__core_distance(const tahr__core *core, tahr_vec3 centre, const tahr_vec3 v[3], tahr__witness *out)
{
    tahr__facet f = {.v = {v[0], v[1], v[2]}};
    tahr__facet_finish(&f);
    tahr__facet_distance(core, centre, &f, out);
}

/* Tries to leave along +-n: keeps the shortest way. low and high are the other shape's extent along n around the
 * core. */
static void try_way(tahr_vec3 n, double low, double high, double *depth, tahr_vec3 *normal)
{
    double n2 = v_dot(n, n);
    if (!(n2 > 0)) return;
    double inverse = 1.0 / sqrt(n2);
    if (high * inverse < *depth) {
        *depth = high * inverse;
        *normal = v_scale(n, inverse);
    }
    if (-low * inverse < *depth) {
        *depth = -low * inverse;
        *normal = v_scale(n, -inverse);
    }
}

double tahr__core_leave_triangle(const tahr__core *core, tahr_vec3 centre, const tahr_vec3 v[3], unsigned sides,
                                 tahr_vec3 *normal)
{
    tahr_vec3 r[3] = {v_sub(v[0], centre), v_sub(v[1], centre), v_sub(v[2], centre)};
    tahr_vec3 e[3] = {v_sub(r[1], r[0]), v_sub(r[2], r[1]), v_sub(r[0], r[2])};
    tahr_vec3 n = v_cross(e[0], e[1]);
    double depth = 1e300, none = -1e300;
    *normal = v_make(0, 0, 1);
    double extent = tahr__core_extent(core, n), height = v_dot(n, r[0]);
    if (!(sides & 7u)) sides = 1;
    try_way(n, sides & 2u ? height - extent : none, sides & 1u ? height + extent : 1e300, &depth, normal);
    if (sides & 4u) {
        for (int k = 0; k < core->axis_count * 4; k++) {
            tahr_vec3 u = core->axis[k / 4];
            tahr_vec3 w = k % 4 < 3 ? e[k % 4] : core->axis[(k / 4 + 1) % core->axis_count];
            tahr_vec3 x = v_cross(u, w);
            double a = v_dot(x, r[0]), b = v_dot(x, r[1]), c = v_dot(x, r[2]), ext = tahr__core_extent(core, x);
            try_way(x, d_min(a, d_min(b, c)) - ext, d_max(a, d_max(b, c)) + ext, &depth, normal);
        }
    }
    return depth > 1e299 ? 0 : d_max(depth, 0);
}

double tahr__core_leave_solid(const tahr__core *core, tahr_vec3 centre, const tahr__core *solid, tahr_vec3 solid_centre,
                              tahr_vec3 *normal)
{
    /* The difference of two sums of segments is a sum of segments; its faces are spanned by pairs of them. */
    tahr_vec3 g[6], d = v_sub(solid_centre, centre);
    int count = 0;
    double depth = 1e300;
    for (int i = 0; i < solid->axis_count; i++)
        g[count++] = solid->axis[i];
    for (int i = 0; i < core->axis_count; i++)
        g[count++] = core->axis[i];
    *normal = v_make(0, 0, 1);
    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count; j++) {
            tahr_vec3 n = v_cross(g[i], g[j]);
            /* Nearly parallel pairs span no face; as an axis they would be noise. */
            if (!(v_dot(n, n) > 1e-20 * v_dot(g[i], g[i]) * v_dot(g[j], g[j]))) continue;
            double middle = v_dot(n, d), extent = 0;
            for (int k = 0; k < count; k++)
                extent += fabs(v_dot(n, g[k]));
            try_way(n, middle - extent, middle + extent, &depth, normal);
        }
    }
    return depth > 1e299 ? -1 : depth;
}

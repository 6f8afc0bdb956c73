/* SPDX-License-Identifier: MIT
 * quad_distance.h: distance between a core (point, segment, box) and a triangle by feature pairs, in quad precision (or
 * in TAHR_TRUTH_REAL). First method of make_truth.c, and in long double the judge of the tests that read its files.
 * Everything is squared distance: no square root, so g(t)^2 keeps all its bits. */
#ifndef TAHR_TRUTH_QUAD_DISTANCE_H
#define TAHR_TRUTH_QUAD_DISTANCE_H

#include <math.h>

#ifdef TAHR_TRUTH_REAL
typedef TAHR_TRUTH_REAL real;
#else
typedef __float128 real;
#endif

typedef struct {
    real x, y, z;
} vec;

/* centre + sum of s_i axis_i, s_i in [-1, 1]: no axis is a sphere's core, one a capsule's, three (orthogonal) a box. */
typedef struct {
    vec centre, axis[3];
    int axes;
} core;

typedef struct {
    vec v[3];
} triangle;

/* squared: of the distance; gap: from the triangle's closest point to the core's; point: the triangle's (not set where
 * they cross). */
typedef struct {
    real squared;
    vec gap, point;
} nearest;

static vec vadd(vec a, vec b)
{
    return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static vec vsub(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}
static vec vmul(vec a, real s)
{
    return (vec){a.x * s, a.y * s, a.z * s};
}
static real vdot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static vec vcross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static real clamp01(real t)
{
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

static void nearer(nearest *best, vec on_core, vec on_triangle)
{
    vec gap = vsub(on_core, on_triangle);
    real squared = vdot(gap, gap);

    if (best->squared < 0 || squared < best->squared) *best = (nearest){squared, gap, on_triangle};
}

static vec closest_on_segment(vec p, vec a, vec b)
{
    vec ab = vsub(b, a);
    real length2 = vdot(ab, ab);

    return length2 > 0 ? vadd(a, vmul(ab, clamp01(vdot(vsub(p, a), ab) / length2))) : a;
}

static void point_triangle(nearest *best, vec p, const triangle *t)
{
    vec n = vcross(vsub(t->v[1], t->v[0]), vsub(t->v[2], t->v[0]));
    real n2 = vdot(n, n);
    int inside = n2 > 0;

    for (int i = 0; i < 3; i++) {
        vec a = t->v[i], b = t->v[(i + 1) % 3];
        if (vdot(vcross(vsub(b, a), vsub(p, a)), n) < 0) inside = 0;
        nearer(best, p, closest_on_segment(p, a, b));
    }
    if (inside) nearer(best, p, vsub(p, vmul(n, vdot(vsub(p, t->v[0]), n) / n2)));
}

/* Interior against interior, then the four ends: no clamping order to get wrong. */
static void segment_segment(nearest *best, const vec p[2], const vec q[2])
{
    vec d1 = vsub(p[1], p[0]), d2 = vsub(q[1], q[0]), r = vsub(p[0], q[0]);
    real a = vdot(d1, d1), b = vdot(d1, d2), c = vdot(d2, d2), d = vdot(d1, r), e = vdot(d2, r);
    real det = a * c - b * b;

    for (int i = 0; i < 2; i++) {
        nearer(best, p[i], closest_on_segment(p[i], q[0], q[1]));
        nearer(best, closest_on_segment(q[i], p[0], p[1]), q[i]);
    }
    if (det > 0) {
        real s = (b * e - c * d) / det, t = (a * e - b * d) / det;
        if (s > 0 && s < 1 && t > 0 && t < 1) nearer(best, vadd(p[0], vmul(d1, s)), vadd(q[0], vmul(d2, t)));
    }
}

static real volume(vec a, vec b, vec c, vec d)
{
    return vdot(vcross(vsub(b, a), vsub(c, a)), vsub(d, a));
}

/* A segment that passes properly through the triangle; touching is found by the distances. */
static int segment_crosses(const vec p[2], const triangle *t)
{
    real a = volume(t->v[0], t->v[1], t->v[2], p[0]), b = volume(t->v[0], t->v[1], t->v[2], p[1]);
    real u, v, w;

    if (!((a < 0 && b > 0) || (a > 0 && b < 0))) return 0;
    u = volume(p[0], p[1], t->v[0], t->v[1]);
    v = volume(p[0], p[1], t->v[1], t->v[2]);
    w = volume(p[0], p[1], t->v[2], t->v[0]);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

static vec core_corner(const core *k, int signs)
{
    vec p = k->centre;

    for (int i = 0; i < k->axes; i++)
        p = vadd(p, vmul(k->axis[i], (signs >> i & 1) ? 1 : -1));
    return p;
}

static vec closest_in_box(const core *k, vec p)
{
    vec out = k->centre, d = vsub(p, k->centre);

    for (int i = 0; i < 3; i++) {
        real s = vdot(d, k->axis[i]) / vdot(k->axis[i], k->axis[i]);
        out = vadd(out, vmul(k->axis[i], s < -1 ? -1 : s > 1 ? 1 : s));
    }
    return out;
}

/* Does the segment meet the box? Slabs in the box's own frame. */
static int segment_in_box(const core *k, vec a, vec b)
{
    real lo = 0, hi = 1;

    for (int i = 0; i < 3; i++) {
        real n2 = vdot(k->axis[i], k->axis[i]);
        real s = vdot(vsub(a, k->centre), k->axis[i]) / n2, d = vdot(vsub(b, a), k->axis[i]) / n2;
        if (d == 0) {
            if (s < -1 || s > 1) return 0;
            continue;
        }
        real t0 = (-1 - s) / d, t1 = (1 - s) / d;
        if (t0 > t1) {
            real swap = t0;
            t0 = t1;
            t1 = swap;
        }
        if (t0 > lo) lo = t0;
        if (t1 < hi) hi = t1;
    }
    return lo <= hi;
}

static void box_triangle(nearest *best, const core *k, const triangle *t)
{
    for (int i = 0; i < 3; i++) {
        nearer(best, closest_in_box(k, t->v[i]), t->v[i]);
        if (segment_in_box(k, t->v[i], t->v[(i + 1) % 3])) *best = (nearest){0, {0, 0, 0}, {0, 0, 0}};
    }
    for (int corner = 0; corner < 8; corner++) {
        point_triangle(best, core_corner(k, corner), t);
        for (int i = 0; i < 3; i++) {
            if (corner >> i & 1) continue;
            vec edge[2] = {core_corner(k, corner), core_corner(k, corner | 1 << i)};
            if (segment_crosses(edge, t)) *best = (nearest){0, {0, 0, 0}, {0, 0, 0}};
            for (int j = 0; j < 3; j++)
                segment_segment(best, edge, (vec[2]){t->v[j], t->v[(j + 1) % 3]});
        }
    }
}

static inline nearest core_triangle(const core *k, const triangle *t)
{
    nearest best = {-1, {0, 0, 0}, {0, 0, 0}};

    if (k->axes == 3) {
        box_triangle(&best, k, t);
    } else if (k->axes == 1) {
        vec p[2] = {core_corner(k, 0), core_corner(k, 1)};
        if (segment_crosses(p, t)) return (nearest){0, {0, 0, 0}, {0, 0, 0}};
        for (int i = 0; i < 3; i++)
            segment_segment(&best, p, (vec[2]){t->v[i], t->v[(i + 1) % 3]});
        point_triangle(&best, p[0], t);
        point_triangle(&best, p[1], t);
    } else {
        point_triangle(&best, k->centre, t);
    }
    return best;
}

#endif

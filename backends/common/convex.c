/* SPDX-License-Identifier: MIT
 * convex.c: support functions, and the distance of two convex shapes by GJK.
 *
 * The difference a - b is convex; its point nearest to the origin is the nearest pair. It is approached by simplices of
 * its support points. What makes it robust: the nearest point of a simplex is found without dividing by a volume, by
 * the triangle's own nearest point (Ericson 2005, 5.1.5); of a tetrahedron all faces that the origin may be outside of
 * are looked at; and the iteration ends when nothing is gained, with the last certificate. */
#include "convex.h"

#include <stddef.h>

enum { MAX_ITERATIONS = 128 };

/* The two ends of the bracket differ by this when it is done (m, with shapes of 1 m), or by the rounding of the largest
 * coordinate. */
#define ENOUGH 1e-12
#define ROUNDING 8e-16
/* Squared, of the largest coordinate: a nearest point that is the origin but for rounding. */
#define NOTHING 1e-30
/* What is farther beyond reach than this (m) need be known to this part only. */
#define NEAR 1e-6
#define ROUGH 0.1
/* Squared sine below which a direction is along an axis. */
#define AXIAL 1e-28
/* Volume over the product of three edges: thinner tetrahedra hold nothing that their faces do not. */
#define FLAT 1e-13
/* Squared sine of a corner: of thinner triangles the plane is not known well, and the edges are looked at too. */
#define THIN 1e-10

/* Across the axis twice over: what rounding leaves the first time would lift a point off the disc. Along the axis any
 * point of the disc will do. */
static tahr_vec3 disc_support(tahr_vec3 axis, double radius, tahr_vec3 d)
{
    double a2 = v_dot(axis, axis);
    tahr_vec3 across = v_mad(d, axis, -v_dot(d, axis) / a2);
    across = v_mad(across, axis, -v_dot(across, axis) / a2);
    double length2 = v_dot(across, across);
    return length2 > AXIAL * v_dot(d, d) ? v_scale(across, radius / sqrt(length2)) : v_make(0, 0, 0);
}

static tahr_vec3 points_support(const tahr__convex *c, tahr_vec3 d, uint32_t *index)
{
    tahr_vec3 local = c->turn ? m_unapply(c->turn, d) : d, p;
    uint32_t best = 0;
    double most = v_dot(c->points[0], local);
    for (uint32_t i = 1; i < c->count; i++) {
        double along = v_dot(c->points[i], local);
        if (!(along > most)) continue;
        most = along;
        best = i;
    }
    if (index) *index = best;
    p = v_scale(c->points[best], c->scale);
    return v_add(c->centre, c->turn ? m_apply(c->turn, p) : p);
}

static tahr_vec3 ellipsoid_support(const tahr__convex *c, tahr_vec3 d)
{
    double along[3], length2 = 0;
    tahr_vec3 p = c->centre;
    for (int i = 0; i < 3; i++) {
        along[i] = v_dot(c->axis[i], d);
        length2 += along[i] * along[i];
    }
    double inverse = length2 > 0 ? 1.0 / sqrt(length2) : 0;
    for (int i = 0; i < 3; i++)
        p = v_mad(p, c->axis[i], along[i] * inverse);
    return p;
}

tahr_vec3 tahr__convex_support(const tahr__convex *c, tahr_vec3 d, uint32_t *index)
{
    tahr_vec3 p = c->centre;
    if (index) *index = 0;
    if (c->kind == TAHR__CONVEX_POINTS) return points_support(c, d, index);
    if (c->kind == TAHR__CONVEX_ELLIPSOID) return ellipsoid_support(c, d);
    if (c->kind == TAHR__CONVEX_SUM) {
        for (uint32_t i = 0; i < c->count; i++)
            p = v_mad(p, c->axis[i], v_dot(c->axis[i], d) < 0 ? -1 : 1);
        return p;
    }
    double along = v_dot(c->axis[0], d);
    tahr_vec3 rim = disc_support(c->axis[0], c->radius, d);
    if (c->kind == TAHR__CONVEX_CONE) {
        /* Apex against rim of the base. */
        if (along + along >= v_dot(rim, d)) return v_add(p, c->axis[0]);
        return v_add(v_sub(p, c->axis[0]), rim);
    }
    return v_add(v_mad(p, c->axis[0], along < 0 ? -1 : 1), rim);
}

/* --- Simplices --- */

typedef struct vertex {
    tahr_vec3 w, a, b; /* w = a - b */
    uint32_t index;    /* of b's point */
    uint32_t reserved;
} vertex;

typedef struct simplex {
    vertex v[4];
    double weight[4];
    int count;
    int holds; /* the origin */
} simplex;

/* Nearest to the origin: a point with the weights of the corners that it lies between. */
typedef struct nearest {
    tahr_vec3 point;
    double square;
    double weight[4];
} nearest;

static void keep_nearer(nearest *best, const nearest *n)
{
    if (n->square < best->square) *best = *n;
}

static nearest of_segment(const vertex *v, int i, int j)
{
    nearest n = {.weight = {0, 0, 0, 0}};
    tahr_vec3 p = v[i].w, q = v[j].w, e = v_sub(q, p);
    double length2 = v_dot(e, e), along = -v_dot(p, e), back = v_dot(q, e);
    if (!(along > 0) || !(length2 > 0)) {
        n.point = p;
        n.weight[i] = 1;
    } else if (!(back > 0)) {
        n.point = q;
        n.weight[j] = 1;
    } else {
        /* Measured from the nearer end, whose rounding is less. */
        double t = along / length2, s = back / length2;
        n.point = along <= back ? v_mad(p, e, t) : v_mad(q, e, -s);
        n.weight[i] = along <= back ? 1 - t : s;
        n.weight[j] = along <= back ? t : 1 - s;
    }
    n.square = v_dot(n.point, n.point);
    return n;
}

/* Of the edges of a triangle that the origin may be beyond. */
static void beside_triangle(const vertex *v, const int at[3], const int beyond[3], nearest *n)
{
    for (int m = 0; m < 3; m++) {
        if (!beyond[m]) continue;
        nearest other = of_segment(v, at[(m + 1) % 3], at[(m + 2) % 3]);
        keep_nearer(n, &other);
    }
}

static nearest of_triangle(const vertex *v, int i, int j, int k)
{
    const int at[3] = {i, j, k};
    tahr_vec3 p[3] = {v[i].w, v[j].w, v[k].w}, e = v_sub(p[1], p[0]), f = v_sub(p[2], p[0]);
    tahr_vec3 normal = v_cross(e, f);
    double n2 = v_dot(normal, normal), side[3], sum = 0;
    nearest n = {.square = 1e300};
    int beyond[3], inside = 1, near = 0, thin = !(n2 > THIN * v_dot(e, e) * v_dot(f, f));
    for (int m = 0; m < 3; m++) {
        /* Of the edge across from corner m, as a part of n2. */
        side[m] = v_dot(normal, v_cross(p[(m + 1) % 3], v_sub(p[(m + 2) % 3], p[(m + 1) % 3])));
        beyond[m] = thin || side[m] <= 0;
        inside &= side[m] >= 0;
        sum += side[m];
        if (v_dot(p[m], p[m]) < v_dot(p[near], p[near])) near = m;
    }
    if (inside && sum > 0) {
        for (int m = 0; m < 3; m++) {
            n.weight[at[m]] = side[m] / sum;
            n.point = v_mad(n.point, p[m], side[m] / sum);
        }
        /* The height above the plane is better than that, where the plane is known. */
        if (!thin) n.point = v_scale(normal, v_dot(normal, p[near]) / n2);
        n.square = v_dot(n.point, n.point);
        if (!thin) return n;
    }
    beside_triangle(v, at, beyond, &n);
    return n;
}

/* Is the origin certainly inside of the tetrahedron? outside[m]: it may be beyond the face across from corner m. */
static int holds_origin(const vertex *v, int outside[4])
{
    static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    int inside = 1;
    for (int m = 0; m < 4; m++) {
        tahr_vec3 a = v[face[m][0]].w, e = v_sub(v[face[m][1]].w, a), f = v_sub(v[face[m][2]].w, a);
        tahr_vec3 normal = v_cross(e, f), g = v_sub(v[m].w, a);
        double volume = v_dot(normal, g), height = -v_dot(normal, a);
        double size = v_length(normal) * v_length(g);
        int flat = !(fabs(volume) > FLAT * size);
        outside[m] = flat || (volume > 0 ? height <= 0 : height >= 0);
        inside &= !outside[m];
    }
    return inside;
}

static nearest of_tetrahedron(const vertex *v, int *holds)
{
    int outside[4];
    nearest n = {.square = 1e300}, other;
    *holds = holds_origin(v, outside);
    for (int m = 0; m < 4; m++) {
        if (!outside[m]) continue;
        other = of_triangle(v, (m + 1) & 3, (m + 2) & 3, (m + 3) & 3);
        keep_nearer(&n, &other);
    }
    return n;
}

/* Nearest point of the simplex, which is cut down to the corners that this lies between. */
static nearest solve(simplex *s)
{
    nearest n;
    int kept = 0;
    if (s->count == 1)
        n = (nearest){s->v[0].w, v_dot(s->v[0].w, s->v[0].w), {1, 0, 0, 0}};
    else if (s->count == 2)
        n = of_segment(s->v, 0, 1);
    else if (s->count == 3)
        n = of_triangle(s->v, 0, 1, 2);
    else
        n = of_tetrahedron(s->v, &s->holds);
    if (s->holds) return n;
    for (int i = 0; i < s->count; i++) {
        if (!(n.weight[i] > 0)) continue;
        s->v[kept] = s->v[i];
        s->weight[kept++] = n.weight[i];
    }
    s->count = kept;
    return n;
}

/* --- The iteration --- */

static vertex difference(const tahr__convex *a, const tahr__convex *b, tahr_vec3 toward)
{
    vertex v;
    v.reserved = 0;
    v.a = tahr__convex_support(a, toward, NULL);
    v.b = tahr__convex_support(b, v_scale(toward, -1), &v.index);
    v.w = v_sub(v.a, v.b);
    return v;
}

static int is_known(const simplex *s, tahr_vec3 w)
{
    for (int i = 0; i < s->count; i++) {
        if (s->v[i].w.x == w.x && s->v[i].w.y == w.y && s->v[i].w.z == w.z) return 1;
    }
    return 0;
}

static void write_witness(const simplex *s, const tahr__convex *b, tahr__gap *gap)
{
    gap->on_a = gap->on_b = v_make(0, 0, 0);
    for (int i = 0; i < s->count; i++) {
        gap->on_a = v_mad(gap->on_a, s->v[i].a, s->weight[i]);
        gap->on_b = v_mad(gap->on_b, s->v[i].b, s->weight[i]);
        if (b->kind == TAHR__CONVEX_POINTS && s->v[i].index < 3) gap->weight[s->v[i].index] += s->weight[i];
    }
}

static int is_clear(const tahr__clearance *enough, const tahr__gap *gap)
{
    return enough && gap->lower - enough->reach > d_max(0, -v_dot(enough->motion, gap->normal));
}

/* By how much lower and distance may differ in the end. */
static double allowance(const tahr__clearance *enough, const tahr__gap *gap, double largest2)
{
    if (enough && gap->lower - enough->reach > NEAR) return ROUGH * (gap->lower - enough->reach);
    return ENOUGH + ROUNDING * sqrt(largest2);
}

void tahr__convex_distance(const tahr__convex *a, const tahr__convex *b, tahr_vec3 first, tahr__gap *gap)
{
    tahr__convex_clear(a, b, first, NULL, gap);
}

void tahr__convex_clear(const tahr__convex *a, const tahr__convex *b, tahr_vec3 first, const tahr__clearance *enough,
                        tahr__gap *gap)
{
    simplex s = {.count = 0};
    double square = 1e300, largest = 0;
    tahr_vec3 v = v_dot(first, first) > 0 ? first : v_sub(a->centre, b->centre);
    *gap = (tahr__gap){.lower = -1e300};
    if (!(v_dot(v, v) > 0)) v = v_make(0, 0, 1);
    for (;;) {
        vertex next = difference(a, b, v_scale(v, -1));
        double length = v_length(v), lower = v_dot(v, next.w) / length;
        gap->iterations++;
        largest = d_max(largest, v_dot(next.w, next.w));
        if (lower > gap->lower) {
            gap->lower = lower;
            gap->normal = v_scale(v, 1.0 / length);
            gap->clear = is_clear(enough, gap) != 0;
            if (gap->clear) return;
        }
        if (is_known(&s, next.w)) break;
        if (gap->distance > 0 && gap->distance - gap->lower <= allowance(enough, gap, largest)) break;
        if (gap->iterations >= MAX_ITERATIONS) {
            gap->given_up = 1;
            break;
        }
        simplex before = s;
        s.v[s.count++] = next;
        nearest n = solve(&s);
        /* A plane that passes between them is proof; a thin simplex is none that they overlap. */
        if ((s.holds || !(n.square > NOTHING * largest)) && !(gap->lower > 0)) {
            gap->distance = 0;
            return;
        }
        if (s.holds || !(n.square < square)) {
            s = before;
            break;
        }
        square = n.square;
        gap->distance = sqrt(square);
        v = n.point;
    }
    write_witness(&s, b, gap);
}

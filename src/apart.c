/* SPDX-License-Identifier: MIT
 * apart.c: the distance of two convex shapes, by their support functions.
 *
 * Whatever the direction, along it they are apart by no less than the gap found: it is evaluated with the support
 * functions, so that an iteration that ends early costs room and never lets two shapes meet. For spheres and capsules
 * the closest points of two segments tell the direction; for others the algorithm of Gilbert, Johnson and Keerthi
 * (1988). */
#include "apart.h"

/* m; closer cores than this have no direction of their own: rounding of places as far as 1e4 m away. */
static const double NO_DIRECTION = 1e-9;

/* Of the squared distance: an iteration that gains less is the last one. */
static const double GAIN = 1e-12;

/* Polyhedra need 6 to 12 rounds, curved shapes some 20. */
enum { ROUNDS = 32 };

typedef struct couple {
    const tahr__solid *a, *b;
    vec3 c; /* centre of a seen from b's */
    int flat;
} couple;

tahr__apart tahr__apart_along(const tahr__solid *a, const tahr__solid *b, vec3 c, vec3 n)
{
    tahr__apart r = {.normal = n, .extent = tahr__support(b, n)};
    r.gap = dot(n, c) - tahr__support(a, scale(n, -1)) - r.extent;
    return r;
}

static tahr__apart along(const couple *p, vec3 n)
{
    return tahr__apart_along(p->a, p->b, p->c, n);
}

/* Of two segments, from -a to a around c and from -b to b: the vector between their closest points, to the first. */
static vec3 segments_apart(vec3 c, vec3 a, vec3 b)
{
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), ca = dot(c, a), cb = dot(c, b);
    const double spread = aa * bb - ab * ab;
    double s = 0, t = 0;
    if (spread > 1e-12 * aa * bb) {
        s = clamp((ab * cb - bb * ca) / spread, -1, 1);
    } else if (aa > 0) { /* parallel: over the middle of what lies side by side, or as near to it as there is */
        s = clamp(-ca / aa, -1, 1);
    }
    if (bb > 0) {
        t = clamp((cb + s * ab) / bb, -1, 1);
    }
    if (aa > 0) {
        s = clamp((t * ab - ca) / aa, -1, 1);
    }
    return sub(add_scaled(c, a, s), scale(b, t));
}

/* The point of a simplex nearest to the origin, and the part of it that carries it. */
typedef struct simplex {
    vec3 w[4];
    int count;
} simplex;

static int nearest_on_edge(const simplex *s, int i, int j, vec3 *v)
{
    vec3 e = sub(s->w[j], s->w[i]);
    double ee = dot(e, e), t = -dot(s->w[i], e);
    if (!(t > 0 && t < ee)) {
        return 0;
    }
    *v = add_scaled(s->w[i], e, t / ee);
    return 1;
}

static int nearest_on_face(const simplex *s, int i, int j, int k, vec3 *v)
{
    vec3 a = s->w[i], b = s->w[j], c = s->w[k];
    vec3 n = cross(sub(b, a), sub(c, a));
    double nn = dot(n, n);
    if (!(nn > 0)) {
        return 0;
    }
    double u = dot(n, cross(b, c)), w = dot(n, cross(c, a)), x = dot(n, cross(a, b));
    if (!(u > 0 && w > 0 && x > 0)) {
        return 0;
    }
    *v = scale(n, dot(n, a) / nn);
    return 1;
}

static int holds_origin(const simplex *s)
{
    for (int i = 0; i < 4; i++) {
        vec3 a = s->w[(i + 1) & 3], b = s->w[(i + 2) & 3], c = s->w[(i + 3) & 3];
        vec3 n = cross(sub(b, a), sub(c, a));
        double here = dot(n, sub(s->w[i], a)), there = -dot(n, a);
        if (!(here * there > 0)) {
            return 0;
        }
    }
    return 1;
}

typedef struct reduced {
    vec3 v;
    double best;
    int keep[3], count;
} reduced;

static void consider(reduced *r, vec3 v, int count, int i, int j, int k)
{
    double size = length_squared(v);
    if (size < r->best) {
        *r = (reduced){.v = v, .best = size, .keep = {i, j, k}, .count = count};
    }
}

/* Leaves of the simplex the corners that carry its point nearest to the origin. Returns 0 if it holds the origin. */
static int reduce(simplex *s, vec3 *v)
{
    reduced r = {.best = INFINITY};
    vec3 x;
    if (s->count == 4 && holds_origin(s)) {
        return 0;
    }
    for (int i = 0; i < s->count; i++) {
        consider(&r, s->w[i], 1, i, 0, 0);
        for (int j = i + 1; j < s->count; j++) {
            if (nearest_on_edge(s, i, j, &x)) {
                consider(&r, x, 2, i, j, 0);
            }
            for (int k = j + 1; k < s->count; k++) {
                if (nearest_on_face(s, i, j, k, &x)) {
                    consider(&r, x, 3, i, j, k);
                }
            }
        }
    }
    for (int i = 0; i < r.count; i++) {
        s->w[i] = s->w[r.keep[i]]; /* ascending: nothing is overwritten before it is read */
    }
    s->count = r.count;
    *v = r.v;
    return 1;
}

/* The best direction that the iteration passes. Returns 0 if the cores touch. */
static int iterate(const couple *p, tahr__apart *best)
{
    simplex s = {.count = 0};
    vec3 v = length_squared(p->c) > 0 ? p->c : vec(1, 0, 0);
    best->gap = -INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        vec3 n = unit(v);
        tahr__apart now = along(p, n);
        if (now.gap > best->gap) {
            *best = now;
        }
        vec3 down = scale(n, -1);
        vec3 w = sub(add(p->c, tahr__support_core(p->a, down)), tahr__support_core(p->b, n));
        double v2 = length_squared(v);
        if (round > 0 && (v2 < NO_DIRECTION * NO_DIRECTION || v2 - dot(v, w) <= GAIN * v2)) {
            break;
        }
        s.w[s.count++] = w;
        if (!reduce(&s, &v) || s.count == 4) {
            return 0;
        }
    }
    return length_squared(v) > NO_DIRECTION * NO_DIRECTION;
}

static void try_way(const couple *p, vec3 n, tahr__apart *best)
{
    if (p->flat) {
        n.z = 0;
    }
    n = unit(n);
    if (length_squared(n) > 0) {
        tahr__apart now = along(p, n);
        if (now.gap > best->gap) {
            *best = now;
        }
    }
}

/* Out of an overlap: level first, where that is as short. */
static tahr__apart shortest_way(const couple *p)
{
    const tahr__solid *both[2] = {p->a, p->b};
    tahr__apart best = {.gap = -INFINITY};
    vec3 up = p->a->up, level = reject(p->c, up);
    if (length_squared(level) > NO_DIRECTION * NO_DIRECTION) {
        try_way(p, level, &best);
    } else {
        try_way(p, p->flat ? vec(up.y, -up.x, 0) : cross(up, up.x * up.x > 0.5 ? vec(0, 1, 0) : vec(1, 0, 0)), &best);
    }
    try_way(p, p->c, &best);
    for (int i = 0; i < 2; i++) {
        const tahr__solid *s = both[i];
        if (s->shape->radius == 0) {
            vec3 x = rotate(s->orientation, vec(1, 0, 0)), y = rotate(s->orientation, vec(0, 1, 0));
            try_way(p, dot(x, p->c) < 0 ? scale(x, -1) : x, &best);
            try_way(p, dot(y, p->c) < 0 ? scale(y, -1) : y, &best);
        }
        try_way(p, dot(s->up, p->c) < 0 ? scale(s->up, -1) : s->up, &best);
    }
    return best;
}

static int has_segment_core(const tahr_shape *shape)
{
    return shape->type == TAHR_SHAPE_SPHERE || shape->type == TAHR_SHAPE_CAPSULE;
}

tahr__apart tahr__apart_of(const tahr__solid *a, const tahr__solid *b, vec3 c, int flat)
{
    couple p = {a, b, c, flat};
    tahr__apart best;
    if (flat) {
        p.c.z = 0;
    }
    if (has_segment_core(a->shape) && has_segment_core(b->shape)) {
        vec3 v = segments_apart(p.c, tahr__support_core(a, a->up), tahr__support_core(b, b->up));
        if (length_squared(v) > NO_DIRECTION * NO_DIRECTION) {
            return along(&p, unit(v));
        }
    } else if (iterate(&p, &best)) {
        if (flat && best.normal.z != 0) {
            best.normal.z = 0;
            best = along(&p, unit(best.normal));
        }
        return best;
    }
    return shortest_way(&p);
}

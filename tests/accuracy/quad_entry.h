/* SPDX-License-Identifier: MIT
 * quad_entry.h: time of impact by case analysis, second method of make_truth.c. The core shrinks to a point and the
 * triangle grows by it (Minkowski sum): a handful of triangles and parallelograms that cover the sum's boundary. The
 * point enters their neighbourhood of radius rho through a face, an edge cylinder or a vertex sphere: closed forms. */
#ifndef TAHR_TRUTH_QUAD_ENTRY_H
#define TAHR_TRUTH_QUAD_ENTRY_H

#include "quad_distance.h"

typedef struct {
    vec v[4];
    int count;
} patch;

enum { MAX_PATCHES = 62 }; /* box: 8 triangles, 18 faces of the box at vertices, 36 pairs of edges */

/* Newton steps take a double square root to full quad precision: 53, 106, all 113 bits. */
static real root(real a)
{
    real x;

    if (a <= 0) return 0;
    x = (real)sqrt((double)a);
    if (x == 0) return 0;
    x = (x + a / x) / 2;
    x = (x + a / x) / 2;
    return (x + a / x) / 2;
}

static void earlier(real *best, real t)
{
    if (t >= 0 && t <= 1 && t < *best) *best = t;
}

/* First root of a t^2 + 2 b t + c with the point outside (c > 0), in the form that does not cancel. */
static real first_root(real a, real b, real c)
{
    real h = b * b - a * c;

    if (b >= 0 || h < 0 || c < 0) return 2;
    return c / (-b + root(h));
}

static void enter_edge(real *best, vec p, vec m, const vec e[2], real rho)
{
    vec d = vsub(e[1], e[0]), r = vsub(p, e[0]);
    real d2 = vdot(d, d), t, s;
    vec rp, mp;

    if (d2 == 0) return;
    rp = vsub(r, vmul(d, vdot(r, d) / d2));
    mp = vsub(m, vmul(d, vdot(m, d) / d2));
    t = first_root(vdot(mp, mp), vdot(rp, mp), vdot(rp, rp) - rho * rho);
    s = vdot(vadd(r, vmul(m, t)), d) / d2;
    if (s >= 0 && s <= 1) earlier(best, t);
}

static int inside_polygon(const patch *f, vec n, vec p)
{
    for (int i = 0; i < f->count; i++) {
        vec a = f->v[i], b = f->v[(i + 1) % f->count];
        if (vdot(vcross(vsub(b, a), vsub(p, a)), n) < 0) return 0;
    }
    return 1;
}

static void enter_face(real *best, vec p, vec m, const patch *f, real rho)
{
    vec n = vcross(vsub(f->v[1], f->v[0]), vsub(f->v[2], f->v[0]));
    real length = root(vdot(n, n)), height, speed, t;

    if (length == 0) return;
    height = vdot(vsub(p, f->v[0]), n) / length;
    speed = vdot(m, n) / length;
    if (height < 0) {
        height = -height;
        speed = -speed;
    }
    if (speed >= 0 || height < rho) return;
    t = (height - rho) / -speed;
    if (inside_polygon(f, n, vadd(p, vmul(m, t)))) earlier(best, t);
}

static void enter_patch(real *best, vec p, vec m, const patch *f, real rho)
{
    enter_face(best, p, m, f, rho);
    for (int i = 0; i < f->count; i++) {
        vec r = vsub(p, f->v[i]);
        enter_edge(best, p, m, (vec[2]){f->v[i], f->v[(i + 1) % f->count]}, rho);
        earlier(best, first_root(vdot(m, m), vdot(r, m), vdot(r, r) - rho * rho));
    }
}

static real patch_distance_squared(vec p, const patch *f)
{
    vec n = vcross(vsub(f->v[1], f->v[0]), vsub(f->v[2], f->v[0]));
    real n2 = vdot(n, n), best = -1;

    if (n2 > 0 && inside_polygon(f, n, p)) {
        real h = vdot(vsub(p, f->v[0]), n);
        return h * h / n2;
    }
    for (int i = 0; i < f->count; i++) {
        vec g = vsub(p, closest_on_segment(p, f->v[i], f->v[(i + 1) % f->count]));
        real d = vdot(g, g);
        if (best < 0 || d < best) best = d;
    }
    return best;
}

static void add_parallelogram(patch *out, int *count, vec centre, vec a, vec b)
{
    out[*count] = (patch){
        {vsub(vsub(centre, a), b), vsub(vadd(centre, a), b), vadd(vadd(centre, a), b), vadd(vsub(centre, a), b)}, 4};
    ++*count;
}

/* The core is symmetric, so adding it is the same as subtracting it. */
static int grow_triangle(patch out[MAX_PATCHES], const core *k, const triangle *t)
{
    core half = *k;
    int count = 0;

    half.centre = (vec){0, 0, 0};
    for (int corner = 0; corner < 1 << k->axes; corner++) {
        vec c = core_corner(&half, corner);
        out[count++] = (patch){{vadd(t->v[0], c), vadd(t->v[1], c), vadd(t->v[2], c)}, 3};
    }
    for (int i = 0; i < k->axes; i++) {
        for (int e = 0; e < 3; e++) {
            vec a = t->v[e], b = t->v[(e + 1) % 3];
            vec middle = vmul(vadd(a, b), (real)0.5), along = vmul(vsub(b, a), (real)0.5);
            for (int signs = 0; signs < (k->axes == 3 ? 4 : 1); signs++) {
                vec c = middle;
                for (int j = 1; j < k->axes; j++)
                    c = vadd(c, vmul(k->axis[(i + j) % 3], (signs >> (j - 1) & 1) ? 1 : -1));
                add_parallelogram(out, &count, c, along, k->axis[i]);
            }
            for (int side = -1; k->axes == 3 && side <= 1; side += 2)
                add_parallelogram(out, &count, vadd(a, vmul(k->axis[i], side)), k->axis[(i + 1) % 3],
                                  k->axis[(i + 2) % 3]);
        }
    }
    return count;
}

#endif

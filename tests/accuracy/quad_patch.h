/* SPDX-License-Identifier: MIT
 * quad_patch.h: the core shrinks to a point and the triangle grows by it (Minkowski sum): a handful of triangles and
 * parallelograms that cover the sum's boundary, and the distance to them. */
#ifndef TAHR_TRUTH_QUAD_PATCH_H
#define TAHR_TRUTH_QUAD_PATCH_H

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

static int inside_polygon(const patch *f, vec n, vec p)
{
    for (int i = 0; i < f->count; i++) {
        vec a = f->v[i], b = f->v[(i + 1) % f->count];
        if (vdot(vcross(vsub(b, a), vsub(p, a)), n) < 0) return 0;
    }
    return 1;
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

/* SPDX-License-Identifier: MIT
 * slide_catch.h: the catching-up scheme, second method of make_slide.c: x' = the place nearest to x + h u at which
 * nothing is nearer than rho. Of first order; Richardson's extrapolation over h, h/2, h/4, ... takes the orders off one
 * after the other. It knows no faces, edges and pieces, only the convex distance (quad_distance.h) of the core to each
 * triangle or solid, and shares nothing with slide_exact.h but vector arithmetic and the root. */
#ifndef TAHR_TRUTH_SLIDE_CATCH_H
#define TAHR_TRUTH_SLIDE_CATCH_H

#include "quad_patch.h"
#include "truth_scene.h"

enum { MAX_BODIES = 16, MAX_NEAR = 48, LEVELS = 6 };

typedef struct {
    const mesh *bodies;
    int body_count;
    core shape; /* about the origin */
    real rho;
} catch_scene;

typedef struct {
    vec n;
    real offset; /* n . x >= offset */
} half_space;

static void add_half_space(half_space *h, int *count, const nearest *d, vec x, real rho)
{
    real distance = root(d->squared);
    if (*count == MAX_NEAR) abort();
    h[*count].n = vmul(d->gap, 1 / distance);
    h[*count].offset = vdot(h[*count].n, x) + rho - distance;
    ++*count;
}

/* By centres and radii in double, with a centimetre to spare. */
static int is_away(const catch_scene *s, const mesh *m, int i, vec x, real reach)
{
    const int *t = m->triangles[i];
    dvec a = m->vertices[t[0]], b = m->vertices[t[1]], c = m->vertices[t[2]];
    dvec middle = scaled(add(add(a, b), c), 1.0 / 3), d = sub(narrow(x), middle);
    double span = fmax(dot(sub(a, middle), sub(a, middle)), dot(sub(b, middle), sub(b, middle)));
    double far = sqrt(fmax(span, dot(sub(c, middle), sub(c, middle)))) + (double)(s->rho + reach) + 0.01;

    for (int j = 0; j < s->shape.axes; j++)
        far += sqrt((double)vdot(s->shape.axis[j], s->shape.axis[j]));
    return dot(d, d) > far * far;
}

/* Planes tangent at x to all that is near: of what is convex as a whole the nearest one, of a mesh every triangle's. */
static int tangents(half_space out[MAX_NEAR], const catch_scene *s, vec x, real reach)
{
    int count = 0;
    core k = s->shape;

    k.centre = x;
    for (int b = 0; b < s->body_count; b++) {
        const mesh *m = &s->bodies[b];
        nearest best = {-1, {0, 0, 0}, {0, 0, 0}};
        for (int i = 0; i < m->triangle_count; i++) {
            if (is_away(s, m, i, x, reach)) continue;
            triangle t = triangle_of(m, i);
            nearest d = core_triangle(&k, &t);
            if (d.squared > (s->rho + reach) * (s->rho + reach)) continue;
            if (!m->solid && !m->flat)
                add_half_space(out, &count, &d, x, s->rho);
            else if (best.squared < 0 || d.squared < best.squared)
                best = d;
        }
        if (best.squared >= 0) add_half_space(out, &count, &best, x, s->rho);
    }
    return count;
}

static int holds_all(const half_space *h, int count, vec x)
{
    for (int i = 0; i < count; i++)
        if (vdot(h[i].n, x) < h[i].offset - (real)1e-26) return 0;
    return 1;
}

static void consider(vec *best, real *least, const half_space *h, int count, vec x, vec y)
{
    vec d = vsub(x, y);
    if ((*least < 0 || vdot(d, d) < *least) && holds_all(h, count, x)) {
        *least = vdot(d, d);
        *best = x;
    }
}

/* The point of all half-spaces that is nearest to y; y if there is none. */
static vec nearest_in(const half_space *h, int count, vec y)
{
    vec best = y;
    real least = -1;

    if (holds_all(h, count, y)) return y;
    for (int i = 0; i < count; i++) {
        real ri = h[i].offset - vdot(h[i].n, y);
        consider(&best, &least, h, count, vadd(y, vmul(h[i].n, ri)), y);
        for (int j = 0; j < i; j++) {
            real rj = h[j].offset - vdot(h[j].n, y), g = vdot(h[i].n, h[j].n);
            vec c = vcross(h[i].n, h[j].n);
            real det = vdot(c, c);
            if (det < (real)1e-20) continue;
            consider(&best, &least, h, count,
                     vadd(y, vadd(vmul(h[i].n, (ri - g * rj) / det), vmul(h[j].n, (rj - g * ri) / det))), y);
            for (int k = 0; k < j; k++) {
                real volume = vdot(c, h[k].n);
                if (volume * volume < (real)1e-20) continue;
                vec sum = vmul(vcross(h[j].n, h[k].n), h[i].offset);
                sum = vadd(sum, vmul(vcross(h[k].n, h[i].n), h[j].offset));
                sum = vadd(sum, vmul(c, h[k].offset));
                consider(&best, &least, h, count, vmul(sum, 1 / volume), y);
            }
        }
    }
    return best;
}

/* Newton's way: the nearest point of the tangents at the last guess, until it stays. */
static vec catch_up(const catch_scene *s, vec x, vec motion)
{
    half_space h[MAX_NEAR];
    vec y = vadd(x, motion), z = x; /* from outside: what begins deep in something has no gradient */
    real reach = 2 * root(vdot(motion, motion)) + (real)1e-12;

    for (int i = 0; i < 300; i++) {
        int count = tangents(h, s, z, reach);
        vec w = nearest_in(h, count, y), d = vsub(w, z);
        z = w;
        if (i > 0 && vdot(d, d) < (real)1e-54) break;
    }
    return z;
}

/* Where it is after a time, from x: `first` steps, twice as many, four times, ..., extrapolated to none. [out] doubt:
 * what the last two extrapolations differ by. */
static vec catch_to(const catch_scene *s, vec x, vec u, real time, int first, real *doubt)
{
    vec table[LEVELS] = {{0, 0, 0}};

    for (int level = 0; level < LEVELS; level++) {
        int steps = first << level;
        vec at = x, last;
        for (int i = 0; i < steps; i++)
            at = catch_up(s, at, vmul(u, time / steps));
        for (int k = 0; k <= level; k++) { /* Neville: table[k] becomes the value without the first k orders */
            vec old = table[k];
            table[k] = at;
            if (k < level) at = vadd(at, vmul(vsub(at, old), 1 / ((real)(2 << k) - 1)));
        }
        last = vsub(table[level], table[level > 0 ? level - 1 : 0]);
        *doubt = root(vdot(last, last));
    }
    return table[LEVELS - 1];
}

#endif

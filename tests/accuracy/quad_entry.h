/* SPDX-License-Identifier: MIT
 * quad_entry.h: time of impact by case analysis, second method of make_truth.c. The point that the core shrank to
 * enters the neighbourhood of radius rho of a grown triangle (quad_patch.h) through a face, an edge cylinder or a vertex
 * sphere: closed forms. */
#ifndef TAHR_TRUTH_QUAD_ENTRY_H
#define TAHR_TRUTH_QUAD_ENTRY_H

#include "quad_patch.h"

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

#endif

/* SPDX-License-Identifier: MIT
 * slide_exact.h: how something that wants to go along u slides, event by event: first method of make_slide.c.
 *
 * The law: x' = the velocity nearest to u that leads into nothing that is touched (a sweeping process; no inertia). The
 * character shrinks to a point, what is there grows by its core (quad_patch.h) and is kept at a distance rho. Between
 * two events the point moves straight (along nothing, faces, creases) or along a circle about an edge or a vertex: with
 * phi the angle between the normal and -u across the edge, phi' = |u| sin phi / rho, so tan(phi / 2) grows as
 * exp(|u| t / rho): closed forms. Events (something else is met, what is touched ends) are found by looking 1024 times
 * a second and bisecting: what is met for less than a millisecond could be overlooked, and the second method would
 * tell. Creases of curved surfaces have no closed form: refused. */
#ifndef TAHR_TRUTH_SLIDE_EXACT_H
#define TAHR_TRUTH_SLIDE_EXACT_H

#include "quad_patch.h"

/* m. INTO: this much nearer is met; OFF: this much further is no longer touched; NEAR: touches. Ten orders below what
 * is asked for, ten above rounding. */
static const real INTO = (real)1e-20, OFF = (real)1e-18, NEAR = (real)1e-17;

enum { MAX_OBSTACLE = 4096, MAX_PIECES = 512, MAX_TOUCHED = 64, SAMPLES = 1024 };

typedef struct {
    patch patches[MAX_OBSTACLE];
    vec middle[MAX_OBSTACLE];
    real size[MAX_OBSTACLE]; /* of a ball about middle */
    int count;
    real rho;
} obstacle;

enum { STRAIGHT, ROUND };

/* One piece of a path, from its own time 0. ROUND: about axis (zero: about a point): centre, radius, and n0, w unit and
 * at right angles: the normal is n0 cos a + w sin a, with a from a0 on, and along it goes with speed. */
typedef struct {
    int kind;
    vec start, velocity; /* STRAIGHT: all there is; ROUND: velocity along the axis */
    vec centre, back, across;
    real radius, speed, half_tangent, duration;
    int holders[3], holder_count;
} piece;

typedef struct {
    vec n, point;
    int patch;
    int kind;  /* 0 face, 1 edge, 2 vertex */
    vec along; /* of an edge, unit */
} touch;

/* exp and tan(a/2) -> angle functions, by their series and rational forms: libquadmath is not needed. */
static real quad_exp(real x)
{
    real sum = 1, term = 1;
    int halvings = 0;

    while (x > (real)0.01 || x < (real)-0.01) {
        x /= 2;
        halvings++;
    }
    for (int i = 1; i < 24; i++) {
        term *= x / i;
        sum += term;
    }
    while (halvings-- > 0)
        sum *= sum;
    return sum;
}

/* Newton on exp, from the double's logarithm. */
static real quad_log(real x)
{
    real y = log((double)x);

    for (int i = 0; i < 3; i++) {
        real e = quad_exp(y);
        y += 2 * (x - e) / (x + e);
    }
    return y;
}

static vec piece_at(const piece *p, real t)
{
    if (p->kind == STRAIGHT) return vadd(p->start, vmul(p->velocity, t));
    real k = p->half_tangent * quad_exp(p->speed * t / p->radius); /* tan(phi / 2) */
    real c = (1 - k * k) / (1 + k * k), s = 2 * k / (1 + k * k);
    return vadd(vadd(p->centre, vmul(p->velocity, t)), vmul(vadd(vmul(p->back, c), vmul(p->across, s)), p->radius));
}

static vec piece_velocity(const piece *p, real t)
{
    if (p->kind == STRAIGHT) return p->velocity;
    real k = p->half_tangent * quad_exp(p->speed * t / p->radius);
    real c = (1 - k * k) / (1 + k * k), s = 2 * k / (1 + k * k);
    return vadd(p->velocity, vmul(vadd(vmul(p->back, -s), vmul(p->across, c)), p->speed * s));
}

static int patch_is_far(const obstacle *o, int i, vec p, real reach)
{
    vec d = vsub(p, o->middle[i]);
    real far = o->size[i] + reach;
    return vdot(d, d) > far * far;
}

static void add_patch(obstacle *o, const patch *p)
{
    vec sum = {0, 0, 0};
    real size = 0;
    vec n = vcross(vsub(p->v[1], p->v[0]), vsub(p->v[2], p->v[0]));

    for (int i = 0; i < p->count; i++)
        sum = vadd(sum, p->v[i]);
    sum = vmul(sum, (real)1 / p->count);
    for (int i = 0; i < p->count; i++) {
        vec d = vsub(p->v[i], sum);
        if (vdot(d, d) > size) size = vdot(d, d);
    }
    if (o->count == MAX_OBSTACLE || !(vdot(n, n) >= 0)) abort();
    o->patches[o->count] = *p;
    o->middle[o->count] = sum;
    o->size[o->count++] = root(size) * (real)1.001;
}

/* Where a patch is nearest, and on what of it. */
static void touch_of(touch *out, const patch *f, vec p)
{
    vec n = vcross(vsub(f->v[1], f->v[0]), vsub(f->v[2], f->v[0])), gap;
    real n2 = vdot(n, n), best = -1;

    out->kind = 0;
    if (n2 > 0 && inside_polygon(f, n, p)) {
        out->point = vsub(p, vmul(n, vdot(vsub(p, f->v[0]), n) / n2));
    } else {
        for (int i = 0; i < f->count; i++) {
            vec a = f->v[i], b = f->v[(i + 1) % f->count], ab = vsub(b, a), q = closest_on_segment(p, a, b);
            vec g = vsub(p, q);
            if (best >= 0 && vdot(g, g) >= best) continue;
            best = vdot(g, g);
            real s = vdot(vsub(p, a), ab);
            out->point = q;
            out->kind = s > 0 && s < vdot(ab, ab) ? 1 : 2;
            if (vdot(ab, ab) > 0) out->along = vmul(ab, 1 / root(vdot(ab, ab)));
        }
    }
    gap = vsub(p, out->point);
    out->n = vmul(gap, 1 / root(vdot(gap, gap)));
}

static int find_touches(touch out[MAX_TOUCHED], const obstacle *o, vec p)
{
    real reach = (o->rho + NEAR) * (o->rho + NEAR);
    int count = 0;

    for (int i = 0; i < o->count; i++) {
        if (patch_is_far(o, i, p, o->rho * 2) || patch_distance_squared(p, &o->patches[i]) > reach) continue;
        touch t = {.patch = i};
        int known = 0;
        touch_of(&t, &o->patches[i], p);
        for (int j = 0; j < count && !known; j++) {
            vec d = vsub(t.n, out[j].n);
            known = vdot(d, d) < (real)1e-40;
            if (known && t.kind < out[j].kind) out[j] = t; /* a face has edges inside of it where patches overlap */
        }
        if (known) continue;
        if (count == MAX_TOUCHED) abort();
        out[count++] = t;
    }
    return count;
}

static int leads_into_none(const touch *t, int count, vec v, real slack)
{
    for (int i = 0; i < count; i++)
        if (vdot(t[i].n, v) < -slack) return 0;
    return 1;
}

/* The velocity nearest to u that leads into nothing: Karush, Kuhn and Tucker by enumeration. holders: what pushes. */
static vec project_velocity(const touch *t, int count, vec u, int holders[3], int *holder_count)
{
    real size = root(vdot(u, u)), slack = (real)1e-15 * size, tiny = (real)1e-22;

    *holder_count = 0;
    if (leads_into_none(t, count, u, 0)) return u;
    for (int i = 0; i < count; i++) {
        real l = -vdot(t[i].n, u);
        vec v = vadd(u, vmul(t[i].n, l));
        if (l < 0 || !leads_into_none(t, count, v, slack)) continue;
        *holder_count = 1;
        holders[0] = i;
        return v;
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < i; j++) {
            vec line = vcross(t[i].n, t[j].n);
            real l2 = vdot(line, line), g = vdot(t[i].n, t[j].n), a = -vdot(t[i].n, u), b = -vdot(t[j].n, u);
            if (l2 < tiny) continue;
            vec v = vmul(line, vdot(line, u) / l2);
            if ((a - g * b) < 0 || (b - g * a) < 0 || !leads_into_none(t, count, v, slack)) continue;
            *holder_count = 2;
            holders[0] = j, holders[1] = i;
            return v;
        }
    }
    *holder_count = 3; /* in a corner: nothing moves, so it does not matter by which three */
    return (vec){0, 0, 0};
}

/* Nothing of what holds changes its normal along v. */
static int goes_straight(const touch *t, const int *holders, int count, vec v)
{
    real v2 = vdot(v, v);

    for (int i = 0; i < count; i++) {
        const touch *h = &t[holders[i]];
        if (h->kind == 0) continue;
        vec across = h->kind == 1 ? vsub(v, vmul(h->along, vdot(h->along, v))) : v;
        if (vdot(across, across) > (real)1e-40 * v2) return 0;
    }
    return 1;
}

static void make_round(piece *p, const touch *h, vec x, vec u, real rho)
{
    vec axis = h->kind == 1 ? vmul(h->along, vdot(h->along, u)) : (vec){0, 0, 0};
    vec across = vsub(u, axis);
    real speed = root(vdot(across, across)), c, s;

    p->kind = ROUND;
    p->velocity = axis;
    p->centre = vsub(x, vmul(h->n, rho));
    p->radius = rho;
    p->speed = speed;
    p->back = vmul(across, -1 / speed);
    c = vdot(h->n, p->back);
    p->across = vsub(h->n, vmul(p->back, c));
    s = root(vdot(p->across, p->across));
    p->across = vmul(p->across, 1 / s);
    p->half_tangent = s / (1 + c);
    p->duration = -quad_log(p->half_tangent) * rho / speed; /* then u leads off it */
}

/* What ends a piece at t: something is met, or nothing that held it is touched any more. */
static int is_over(const obstacle *o, const piece *p, const real *start, real t)
{
    vec x = piece_at(p, t);

    for (int i = 0; i < o->count; i++) {
        if (patch_is_far(o, i, x, o->rho * 2)) continue;
        real d2 = patch_distance_squared(x, &o->patches[i]), least = start[i] < o->rho ? start[i] : o->rho;
        if (d2 < (least - INTO) * (least - INTO)) return 1;
    }
    for (int i = 0; i < p->holder_count; i++) {
        real d2 = patch_distance_squared(x, &o->patches[p->holders[i]]), most = o->rho + OFF;
        if (start[p->holders[i]] > o->rho) most = start[p->holders[i]] + OFF;
        if (d2 > most * most) return 1;
    }
    return 0;
}

static real find_end(const obstacle *o, const piece *p, real longest)
{
    static real start[MAX_OBSTACLE];
    vec x = piece_at(p, 0);
    real lo = 0, hi = longest;
    int samples = (int)(longest * SAMPLES) + 1, i = 1;

    for (int j = 0; j < o->count; j++)
        start[j] = patch_is_far(o, j, x, o->rho * 2) ? 2 * o->rho : root(patch_distance_squared(x, &o->patches[j]));
    while (i <= samples && !is_over(o, p, start, longest * i / samples))
        i++;
    if (i > samples) return longest;
    lo = longest * (i - 1) / samples, hi = longest * i / samples;
    for (int k = 0; k < 105; k++) {
        real mid = (lo + hi) / 2;
        if (is_over(o, p, start, mid))
            hi = mid;
        else
            lo = mid;
    }
    return hi; /* just past it, by less than INTO or OFF: the next piece begins with what was met */
}

/* The whole path. Returns the number of pieces, 0 if there is no closed form (why says what). */
static int slide_exactly(piece out[MAX_PIECES], const obstacle *o, vec x, vec u, real duration, const char **why)
{
    real left = duration;
    int count = 0;

    while (left > 0) {
        touch touches[MAX_TOUCHED];
        int holders[3], touched = find_touches(touches, o, x);
        piece *p = &out[count];
        memset(p, 0, sizeof *p);
        p->start = x;
        p->velocity = project_velocity(touches, touched, u, holders, &p->holder_count);
        p->duration = left;
        for (int i = 0; i < p->holder_count && p->holder_count < 3; i++)
            p->holders[i] = touches[holders[i]].patch;
        if (p->holder_count == 3 || vdot(p->velocity, p->velocity) == 0) {
            p->velocity = (vec){0, 0, 0};
            return count + 1;
        }
        if (!goes_straight(touches, holders, p->holder_count, p->velocity)) {
            if (p->holder_count > 1) {
                *why = "a crease of curved surfaces";
                return 0;
            }
            make_round(p, &touches[holders[0]], x, u, o->rho);
            if (p->duration > left) p->duration = left;
        }
        p->duration = find_end(o, p, p->duration);
        x = piece_at(p, p->duration);
        left -= p->duration;
        if (++count == MAX_PIECES) {
            *why = "too many pieces";
            return 0;
        }
    }
    return count;
}

#endif

/* SPDX-License-Identifier: MIT
 * flight.c: the time at which one primitive under way has come down to its target.
 *
 * The distance between convex sets under translation is a convex function of time. Newton's method from the left on a
 * convex function never passes the root: every iterate is proven free. A plane is reached in one step, a curved contact
 * quadratically. */
#include "flight.h"

enum { ITERATIONS = 64 };

/* Every so many steps a leap is tried, and before the first one where the sine to the surface is no more than that. */
#define LEAPS 4
#define FLAT 0.03
/* The square of the sine between a surface and a motion that meets it, from which on Newton arrives soon. */
#define STEEP 1e-4
/* The square of the sine up to which an edge of the core is across a normal. */
#define ACROSS 1e-12

/* To a triangle wholly below the lower end of an upright segment that end is the nearest, to one wholly above it the
 * upper one, and a third of the work: of two points over each other that are both above a point of the triangle the
 * lower one is nearer, and tahr__facet_distance comes to that end by the same operations (no_capsule_ends). Of what
 * touches it rounding decides which part is nearest: there the whole is measured. */
void tahr__flight_measure(const tahr__query *query, const tahr__prim *prim, tahr_vec3 centre, tahr__witness *out)
{
    const tahr_vec3 *v = prim->facet.v;
    if (query->core.axis_count == 1) {
        if (out->beside && tahr__segment_again(&query->core, centre, &prim->facet, out)) return;
        out->beside = 0;
        double half = query->core.axis[0].z;
        tahr_vec3 low = v_make(centre.x, centre.y, centre.z - half), high = v_make(centre.x, centre.y, centre.z + half);
        int below = v[0].z <= low.z && v[1].z <= low.z && v[2].z <= low.z;
        int above = v[0].z >= high.z && v[1].z >= high.z && v[2].z >= high.z;
        if ((below | above) && !query->world->no_capsule_ends) {
            tahr__point_facet(below ? low : high, &prim->facet, out);
            if (out->distance > TAHR__BLURRED) {
                query->context->ends++;
                return;
            }
        }
    }
    tahr__facet_distance(&query->core, centre, &prim->facet, out);
}

/* When the two nearest points that were found last are at the target, or nearest, if they stay the nearest; along an
 * edge of either the point goes with the other. */
static double foresee(const tahr__flight *f)
{
    const tahr__query *query = f->query;
    const tahr__witness *w = &f->probe.witness;
    const double target = f->target + 0.9 * TAHR__ARRIVED;
    tahr_vec3 m = query->motion;
    if (w->feature > TAHR__FACE && w->feature < TAHR__CORNER) {
        const uint32_t i = w->feature - TAHR__EDGE;
        tahr_vec3 e = v_sub(f->prim->facet.v[(i + 1) % 3], f->prim->facet.v[i]);
        m = v_mad(m, e, -v_dot(m, e) / v_dot(e, e));
    }
    for (int i = 0; i < query->core.axis_count; i++) {
        const tahr_vec3 a = query->core.axis[i];
        const double along = v_dot(a, w->normal), a2 = v_dot(a, a);
        if (along * along <= ACROSS * a2) m = v_mad(m, a, -v_dot(m, a) / a2);
    }
    const double m2 = v_dot(m, m), b = -w->distance * v_dot(w->normal, m),
                 c = w->distance * w->distance - target * target;
    const double rest = b * b - m2 * c;
    if (!(m2 > 0 && b > 0) || rest > STEEP * m2 * target * target) return f->t;
    return f->t + (rest > 0 ? c / (b + sqrt(rest)) : b / m2);
}

/* The lowest that a distance may come, less the target, of what is passed: at the margin a graze is no contact
 * (graze.h), and at a target of so much what is not passed is met at a slope that counts as one. */
static double least_beside(const tahr__flight *f)
{
    static const double ROUND = 2e-5;
    const int may_graze = f->targets == 0 && f->target > ROUND && !(f->prim->kind & TAHR__ONE_WAY);
    return may_graze ? -TAHR__GRAZE : TAHR__ARRIVED;
}

/* Newton halves what is left where the way only grazes: instead to where those points tell, if that is farther than
 * next, Newton's step. The distance is convex, so tangents prove what is between: 1: the flight is farther on; 0: it is
 * not; -1: it never arrives. */
static int leap(tahr__flight *f, double next, double limit)
{
    const tahr__query *query = f->query;
    const tahr__witness before = f->probe.witness;
    const double rest = before.distance - f->target, rate = v_dot(query->motion, before.normal);
    const double to = d_min(foresee(f), limit);
    if (!(to > next)) return 0;
    tahr__witness w = before;
    f->wanders = 1;
    tahr__flight_measure(query, f->prim, v_mad(query->start, query->motion, to), &w);
    query->context->narrow_iterations++;
    const double rest_there = w.distance - f->target, rate_there = v_dot(query->motion, w.normal);
    if (w.distance < TAHR__BLURRED) return 0;
    if (rest_there > 0 && rate_there < 0) {
        if (f->leaps == 1) {
            f->before.target = f->target;
            f->before.t = f->t;
            f->before.witness = before;
            f->before.targets = f->targets;
        }
        f->t = to;
        f->probe.witness = w;
        return 1;
    }
    const double least = least_beside(f);
    if (rest_there <= d_min(least, 0) || rate_there < 0) return 0;
    const double meet = (rest_there - rate_there * (to - f->t) - rest) / (rate - rate_there);
    return rest + rate * meet > least ? -1 : 0;
}

/* Newton from the left until the distance is target. 1: arrived; 0: never; -1: not decided within the cap. */
static int advance(tahr__flight *f, double limit)
{
    const tahr__query *query = f->query;
    const int from = f->steps;
    f->steps = 0;
    for (int i = from; i < ITERATIONS; i++) {
        tahr__witness *w = &f->probe.witness;
        double rest = w->distance - f->target, rate = v_dot(query->motion, w->normal);
        if (rate >= -TAHR__PARALLEL * query->motion_length) return 0;
        if (rest <= TAHR__ARRIVED) return 1;
        double next = f->t + rest / -rate;
        if (next > limit) return 0;
        if (f->leaps && (i % LEAPS == 1 || (i == 0 && rate > -FLAT * query->motion_length))) {
            const int leaped = leap(f, next, limit);
            if (leaped > 0 && f->leaps == 1) f->before.steps = i;
            if (leaped != 0) f->leaps = 2;
            if (leaped < 0) return 0;
            if (leaped > 0) continue;
        }
        f->t = next;
        tahr__witness before = *w;
        tahr__flight_measure(query, f->prim, v_mad(query->start, query->motion, f->t), w);
        if (w->distance < TAHR__BLURRED) {
            w->normal = before.normal;
            /* A box that touches may find no point to name, nor a feature of the triangle. */
            if (query->core.axis_count == 3) {
                w->point = before.point;
                w->feature = before.feature;
            }
        }
        f->wanders |= w->feature < TAHR__CORNER || !tahr__same_vec(&w->point, &before.point);
        query->context->narrow_iterations++;
    }
    return -1;
}

/* Is the corner that is touched the nearest of the triangle to q, clear of its edges? */
static int is_off_edges(const tahr__flight *f, tahr_vec3 q)
{
    const uint32_t k = f->probe.witness.feature - TAHR__CORNER;
    const tahr_vec3 *v = f->prim->facet.v, off = v_sub(q, v[k]);
    for (uint32_t i = 1; i < 3; i++) {
        const tahr_vec3 e = v_sub(v[(k + i) % 3], v[k]);
        const double along = v_dot(off, e);
        if (!(along < 0 && along * along > 1e-18 * v_dot(off, off) * v_dot(e, e))) return 0;
    }
    return 1;
}

/* A point that comes to a corner does so alike over each of the triangles there to which the corner is nearest all the
 * way; it is that where it is at both ends of a straight way. Only for ways that nothing leaps over (foresee): those
 * hang on the limit too. */
static int comes_again(tahr__flight *f, const tahr__corner_met *c)
{
    const tahr__query *query = f->query;
    tahr__witness *w = &f->probe.witness;
    if (!c->flown || f->t != c->from || f->target != c->target || w->distance != c->first.distance ||
        !tahr__same_vec(&w->point, &c->first.point) || !tahr__same_vec(&w->normal, &c->first.normal) ||
        !is_off_edges(f, v_mad(query->start, query->motion, f->t)) ||
        !is_off_edges(f, v_mad(query->start, query->motion, c->t))) {
        return 0;
    }
    f->t = c->t;
    w->distance = c->last.distance;
    w->normal = c->last.normal;
    return 1;
}

int tahr__flight_arrive(tahr__flight *f, double limit, int first)
{
    tahr__corner_met *c = f->query->corner;
    const int to_corner = first && c && f->query->core.axis_count == 0 && f->probe.witness.feature >= TAHR__CORNER;
    const double from = f->t;
    if (to_corner) {
        if (comes_again(f, c)) return f->t <= limit;
        c->flown = 0;
        c->first = f->probe.witness;
        f->wanders = 0;
    }
    const int arrived = advance(f, limit);
    if (to_corner && arrived == 1 && !f->wanders) {
        c->flown = 1;
        c->from = from;
        c->target = f->target;
        c->t = f->t;
        c->last = f->probe.witness;
    }
    return arrived;
}

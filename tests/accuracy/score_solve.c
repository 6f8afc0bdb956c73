/* SPDX-License-Identifier: MIT
 * score_solve.c: the truth of a sweep, found on the spot. */
#include "score_distance.h"

/* m: nearer to the core than this there is no way out that rounding does not turn. */
static const double CORE_TOUCHES = 1e-6;

static vec motion_of(const tahr_sweep *query)
{
    return (vec){query->motion.x, query->motion.y, query->motion.z};
}

static nearest at_time(core k, const triangle *t, vec motion, real time)
{
    k.centre = vmul(motion, time);
    return core_triangle(&k, t);
}

/* Time of the smallest distance, which is a convex function of time; 64 steps leave 5e-14 of the motion, and the
 * distance is flat there. */
static real time_of_minimum(core k, const triangle *t, vec motion)
{
    const real ratio = 0.61803398874989484820459L;
    real lo = 0, hi = 1, a = hi - ratio, b = lo + ratio;
    real fa = at_time(k, t, motion, a).squared, fb = at_time(k, t, motion, b).squared;

    for (int i = 0; i < 64; i++) {
        if (fa <= fb) {
            hi = b, b = a, fb = fa, a = hi - ratio * (hi - lo);
            fa = at_time(k, t, motion, a).squared;
        } else {
            lo = a, a = b, fa = fb, b = lo + ratio * (hi - lo);
            fb = at_time(k, t, motion, b).squared;
        }
    }
    a = (lo + hi) / 2;
    if (at_time(k, t, motion, 0).squared <= at_time(k, t, motion, a).squared) {
        a = 0;
    }
    return at_time(k, t, motion, 1).squared <= at_time(k, t, motion, a).squared ? 1 : a;
}

/* First time at which the distance is rho; it is beyond rho at 0 and not at hi. */
static real time_of_entry(core k, const triangle *t, vec motion, real hi, real rho)
{
    real lo = 0;

    for (int i = 0; i < 70; i++) {
        real mid = (lo + hi) / 2;
        if (at_time(k, t, motion, mid).squared > rho * rho) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    return hi;
}

static int holds(const triangle *t, vec point)
{
    nearest found = {-1, {0, 0, 0}, {0, 0, 0}};
    point_triangle(&found, point, t);
    return found.squared < 1e-24L;
}

/* Entering the neighbourhood of a triangle is meeting it only if its nearest point is the nearest one of all that hold
 * that point: an edge between what is rested on and what goes on behind it is not met. */
static int is_nearest_around(const score_scene *scene, const tahr_sweep *query, real time, const nearest *found)
{
    core k = score__core(query, time);
    real least = sqrtl(found->squared);

    for (uint32_t b = 0; b < scene->body_count; b++) {
        for (uint32_t i = 0; i < scene->bodies[b].triangle_count; i++) {
            triangle t = score__triangle(&scene->bodies[b], query, i);
            if (!holds(&t, found->point)) {
                continue;
            }
            nearest other = core_triangle(&k, &t);
            if (sqrtl(other.squared) < least - 1e-12L) {
                return 0;
            }
        }
    }
    return 1;
}

/* Does what was entered at an edge of what is rested on come to be the nearest itself, while the motion goes on toward
 * it? Then when it blocks is a matter of definition. */
static int bends(const score_scene *scene, const tahr_sweep *query, const triangle *t, real entered, real minimum)
{
    enum { SAMPLES = 64 };
    vec motion = motion_of(query);
    core k = score__core(query, 0);

    for (int i = 1; i <= SAMPLES; i++) {
        real time = entered + (minimum - entered) * i / SAMPLES;
        nearest found = at_time(k, t, motion, time);
        real flat = 1e-9L * sqrtl(found.squared * vdot(motion, motion));
        if (vdot(found.gap, motion) < -flat && is_nearest_around(scene, query, time, &found)) {
            return 1;
        }
    }
    return 0;
}

typedef struct {
    real time, smallest; /* smallest: squared, of what can be met; or < 0 */
    vec gap;
    real doubt; /* the earliest time at which something may block or not */
} entry;

static void meet(entry *e, real time, vec gap)
{
    if (time < e->time) {
        e->time = time;
        e->gap = gap;
    }
}

/* What is within the margin at the start blocks there or, as its distance is convex, never. */
static void enter_triangle(const score_scene *scene, const tahr_sweep *query, const triangle *t, int resting, entry *e)
{
    vec motion = motion_of(query);
    core k = score__core(query, 0);
    real rho = (real)query->shape.radius + query->margin, time = 0;
    nearest found = core_triangle(&k, t);
    real flat = 1e-12L * sqrtl(found.squared * vdot(motion, motion));
    int near = found.squared <= rho * rho;

    if (near && vdot(found.gap, motion) >= -flat) {
        return;
    }
    real minimum = time_of_minimum(k, t, motion), least = at_time(k, t, motion, minimum).squared;
    if (!near && least <= rho * rho) {
        time = time_of_entry(k, t, motion, minimum, rho);
        found = at_time(k, t, motion, time);
    }
    if (resting && least <= rho * rho && !is_nearest_around(scene, query, time, &found)) {
        if (time < e->doubt && bends(scene, query, t, time, minimum)) {
            e->doubt = time;
        }
        return;
    }
    if (e->smallest < 0 || least < e->smallest) {
        e->smallest = least;
    }
    if (least <= rho * rho) {
        meet(e, time, found.gap);
    }
}

static entry enter(const score_scene *scene, const tahr_sweep *query, int resting)
{
    vec motion = motion_of(query);
    double way = sqrt((double)vdot(motion, motion)), rho = query->shape.radius + query->margin;
    entry e = {2, -1, {0, 0, 0}, 2};

    for (uint32_t b = 0; b < scene->body_count; b++) {
        for (uint32_t i = 0; i < scene->bodies[b].triangle_count; i++) {
            triangle t = score__triangle(&scene->bodies[b], query, i);
            if (!score__beyond(query, &t, way, rho + 1e-3)) {
                enter_triangle(scene, query, &t, resting, &e);
            }
        }
    }
    return e;
}

static tahr_vec3 unit_of(vec v)
{
    real length = sqrtl(vdot(v, v));
    if (length == 0) {
        return (tahr_vec3){0, 0, 0};
    }
    return (tahr_vec3){(double)(v.x / length), (double)(v.y / length), (double)(v.z / length)};
}

static int solve_motion(const score_scene *scene, const tahr_sweep *query, score_truth *out)
{
    entry e = enter(scene, query, out->start_gap <= query->margin);

    if (e.doubt < e.time) {
        return 0;
    }
    if (e.smallest >= 0) {
        out->min_gap = (double)(sqrtl(e.smallest) - query->shape.radius - query->margin);
    }
    if (e.time <= 1) {
        out->status = SCORE_HIT;
        out->fraction = (double)e.time;
        out->normal = unit_of(e.gap);
    }
    return 1;
}

int score_solve(const score_scene *scene, const tahr_sweep *query, score_truth *truth)
{
    nearest start = score__nearest(scene, query, 0, INFINITY);
    score_truth out = {SCORE_FREE, 0, INFINITY, 1, INFINITY, {0, 0, 0}, {0, 0, 0}};

    if (start.squared >= 0) {
        real distance = sqrtl(start.squared);
        if (distance < CORE_TOUCHES) {
            return 0;
        }
        out.start_gap = (double)(distance - query->shape.radius);
        out.start_normal = out.normal = unit_of(start.gap);
        out.min_gap = out.start_gap - query->margin;
    }
    if (out.start_gap < 0) {
        out.status = SCORE_OVERLAP;
        out.fraction = 0;
    } else if (!solve_motion(scene, query, &out)) {
        return 0;
    }
    *truth = out;
    return 1;
}

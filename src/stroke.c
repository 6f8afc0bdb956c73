/* SPDX-License-Identifier: MIT
 * stroke.c: the linear equation of swimming: exponentials in the deep, a damped spring at the surface. */
#include "stroke.h"

#include "elementary.h"
#include "velocity.h"

/* From this damping on (drag^2 over spring) the two exponentials of the spring lie far enough apart to be taken one by
 * one; below it a power series is exact to rounding for half a radian of the spring. */
static const double OVERDAMPED = 16;
static const double SERIES_ANGLE = 0.5;

/* (1 - e^(-k t)) / k */
static double decayed(double k, double t)
{
    double x = min_of(k * t, 700); /* the domain of expm1; beyond it nothing is left */
    if (x < 1e-4) {
        return t * (1 - x * (0.5 - x * (1.0 / 6 - x * (1.0 / 24))));
    }
    return -tahr__expm1(-x) / k;
}

/* v' = push - k v */
static double relax(double v0, double push, double k, double t, double *v)
{
    double x = k * t, one = decayed(k, t);
    double two =
        x < 1e-2 ? t * t * (0.5 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x * (1.0 / 720))))) : (t - one) / k;
    *v = v0 * (1 - k * one) + push * one;
    return v0 * one + push * two;
}

/* v' = push - k v - spring z with k^2 well above 4 spring: two decays, a fast one and a slow one. */
static double creep(const tahr__stroke *s, double v0, double t, double *v)
{
    double root = sqrt(0.25 * s->drag * s->drag - s->spring);
    double fast = 0.5 * s->drag + root, slow = s->spring / fast, apart = fast - slow;
    double a = decayed(slow, t), b = decayed(fast, t);
    double answer = (fast * b - slow * a) / apart; /* to a unit of velocity */
    *v = v0 * (fast * (1 - fast * b) - slow * (1 - slow * a)) / apart + s->push * answer;
    return v0 * answer + s->push * (a - b) / apart;
}

/* The same by the series of its solution: c[n+2] (n+1)(n+2) = -(k (n+1) c[n+1] + spring c[n]), and push in c[2]. 30
 * terms of an argument of at most 2 are far below rounding. */
static double bob(const tahr__stroke *s, double v0, double t, double *v)
{
    double kt = s->drag * t, st = s->spring * t * t;
    double a = 0, b = v0 * t; /* the last two terms of z; their rate, times t, is n times as much */
    double z = b, rate = b;
    for (int n = 0; n < 30; n++) {
        double c = -(kt * (n + 1) * b + st * a) / ((double)(n + 1) * (n + 2));
        c += n == 0 ? 0.5 * s->push * t * t : 0;
        z += c;
        rate += (n + 2) * c;
        a = b;
        b = c;
    }
    *v = t > 0 ? rate / t : v0;
    return z;
}

static double rise_at(const tahr__stroke *s, double v0, double t, double *v)
{
    if (s->spring == 0) {
        return relax(v0, s->push, s->drag, t, v);
    }
    return s->drag * s->drag >= OVERDAMPED * s->spring ? creep(s, v0, t, v) : bob(s, v0, t, v);
}

vec3 tahr__stroke_at(const tahr__stroke *s, vec3 v, double t, vec3 *velocity)
{
    double along = dot(v, s->up), then;
    double one = decayed(s->rate, t), rise = rise_at(s, along, t, &then);
    vec3 off = sub(add_scaled(v, s->up, -along), s->target);
    *velocity = add_scaled(add_scaled(s->target, off, 1 - s->rate * one), s->up, then);
    return add_scaled(add_scaled(scale(s->target, t), off, one), s->up, rise);
}

double tahr__stroke_longest(const tahr__stroke *s)
{
    if (s->spring == 0 || s->drag * s->drag >= OVERDAMPED * s->spring) {
        return INFINITY;
    }
    return SERIES_ANGLE / sqrt(s->spring);
}

/* When something that changes once from no to yes does so within [low, high]: halved until the doubles run out. */
static double turning_point(const tahr__stroke *s, double v0, double t)
{
    double low = 0, high = t, v;
    int up = v0 > 0;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        rise_at(s, v0, middle, &v);
        *((v > 0) == up ? &low : &high) = middle;
    }
    return high;
}

static double passing(const tahr__stroke *s, double v0, double from, double to, double bound, int upward)
{
    double v;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (from + to), z = rise_at(s, v0, middle, &v);
        *((upward ? z > bound : z < bound) ? &to : &from) = middle;
    }
    return to;
}

/* m of rise that are not left. */
typedef struct band {
    double low, high;
} band;

/* On a part of the time on which the rise only rises or only sinks. */
static int passes(const tahr__stroke *s, double v0, double from, double to, const band *b, double *at)
{
    double v, z = rise_at(s, v0, to, &v);
    if (z <= b->high && z >= b->low) {
        return 0;
    }
    *at = passing(s, v0, from, to, z > b->high ? b->high : b->low, z > b->high);
    return 1;
}

double tahr__stroke_leaves(const tahr__stroke *s, vec3 velocity, double t, double low, double high)
{
    const band between = {low, high};
    double v0 = dot(velocity, s->up), v, at = t;
    rise_at(s, v0, t, &v);
    double turn = (v0 > 0 && v < 0) || (v0 < 0 && v > 0) ? turning_point(s, v0, t) : 0;
    if (turn > 0 && passes(s, v0, 0, turn, &between, &at)) {
        return at;
    }
    passes(s, v0, turn, t, &between, &at);
    return at;
}

double tahr__stroke_time(const tahr__stroke *s, vec3 v, double t, vec3 whole, double part)
{
    double low = 0, high = t, at = part * t, size2 = length_squared(whole);
    if (part <= 0 || part >= 1 || size2 == 0) {
        return part <= 0 ? 0 : t;
    }
    vec3 measure = scale(whole, 1.0 / size2), then;
    for (int i = 0; i < 24; i++) { /* Newton, held within its bracket */
        double over = dot(tahr__stroke_at(s, v, at, &then), measure) - part;
        double rate = dot(then, measure);
        double next = newton_next(at, over, rate, &low, &high);
        if (next == at) {
            break;
        }
        at = next;
    }
    return at;
}

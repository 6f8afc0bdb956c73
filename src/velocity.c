/* SPDX-License-Identifier: MIT
 * velocity.c: acceleration, turning, braking, jump and fall as exact solutions, so that a second of movement is the same
 * at 10 and at 1000 Hz.
 *
 * With p, q the velocity along and across the wish, A acceleration, f turn friction, V the speed asked for:
 *   q(t) = q0 e^(-f t),  p(t) = min(p0 + A t, c(t)),  c = sqrt(V^2 - q^2).
 * The cap c is concave, so the free line meets it at most once. Without a wish, or above V:
 *   v' = -F v - B along the fixed direction, which stops at ln(1 + F v / B) / F. */
#include "velocity.h"

#include "elementary.h"

/* Below this f t the quotient expm1(-f t) / f is replaced by its series, which keeps 1 ulp down to f = 0. */
static const double SMALL = 1e-4;

/* Relative excess over the asked speed that is rounding, not over-speed. */
static const double ROUNDING = 1e-12;

/* (1 - e^(-f t)) / f */
static double decay_integral(double f, double t)
{
    double x = f * t;
    if (x < SMALL) {
        return t * (1 - x * (0.5 - x * (1.0 / 6 - x * (1.0 / 24))));
    }
    return -tahr__expm1(-x) / f;
}

/* Time to brake from v to v1 < v. */
static double brake_time(double v, double v1, double b, double f)
{
    if (f * (v - v1) < SMALL * b) { /* ln(1 + y) / f with y = f (v - v1) / (b + f v1) */
        double w = (v - v1) / (b + f * v1);
        double y = f * w;
        return w * (1 - y * (0.5 - y * (1.0 / 3 - y * 0.25)));
    }
    return b + f * v1 > 0 ? tahr__log1p(f * (v - v1) / (b + f * v1)) / f : INFINITY;
}

/* Speed and distance after braking for t, not beyond standstill. */
static double brake(double v, double b, double f, double t, double *distance)
{
    double d = decay_integral(f, t);
    double v1 = v - (f * v + b) * d;
    /* Integral of v: with I = (1 - e^-ft)/f it is v I - b (t - I) / f; (t - I) / f cancels for small f t. */
    double x = f * t;
    double rest =
        x < 1e-2 ? t * t * (0.5 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x * (1.0 / 720 - x * (1.0 / 5040))))))
                 : (t - d) / f;
    *distance = v * d - b * rest;
    return v1 > 0 ? v1 : 0;
}

/* When the free line p0 + A s crosses the cap upward; INFINITY if not within t. F(s) = p0 + A s - c(s) is convex, and as
 * c <= V it is not negative at (V - p0) / A: Newton from there falls monotonically onto the upper root, which is the
 * crossing (a lower root at s = 0 belongs to a velocity wholly across the wish). 8 rounds reach rounding. q1 = q(t). */
static double meeting_time(const tahr__law *law, double p0, double q0, double q1, double t)
{
    double v = law->speed, a = law->acceleration, f = law->turn_friction;
    double c0 = sqrt(max_of(v * v - q0 * q0, 0));
    if (p0 >= c0 && a * c0 >= f * q0 * q0) { /* on the cap, and the line is steeper: stays on it */
        return 0;
    }
    if (p0 + a * t <= sqrt(max_of(v * v - q1 * q1, 0))) {
        return INFINITY;
    }
    double s = min_of(t, (v - p0) / a);
    for (int i = 0; i < 8 && q0 > 0; i++) {
        double q = q0 * (1 + tahr__expm1(-f * s));
        double c = sqrt(max_of(v * v - q * q, 0));
        double value = p0 + a * s - c;
        double slope = c > 0 ? a - f * q * q / c : 0;
        if (value <= 0 || slope <= 0) {
            break;
        }
        s = max_of(s - value / slope, 0);
    }
    return s;
}

/* Along the cap from q0 to q1 = q0 (1 + e), e = expm1(-f t): p and its integral. The integral of c is
 * V t + (V ln((V + c1)/(V + c0)) - (c1 - c0)) / f. */
static double on_cap(const tahr__law *law, double q0, double e, double t, double *distance)
{
    double v = law->speed, f = law->turn_friction;
    double q1 = q0 * (1 + e);
    double c0 = sqrt(max_of(v * v - q0 * q0, 0));
    double c1 = sqrt(max_of(v * v - q1 * q1, 0));
    if (f * t < 1e-12 || c0 + c1 <= 0) {
        *distance = c0 * t;
        return c1;
    }
    double rise = -q0 * q0 * e * (2 + e) / (c0 + c1); /* c1 - c0 without cancellation */
    *distance = v * t + (v * tahr__log1p(rise / (v + c0)) - rise) / f;
    return c1;
}

/* No wish, or above the speed asked for. Returns the time used: all of t, or until the speed fell to the wish's. */
static double brake_phase(const tahr__law *law, vec3 v, double t, tahr__motion *m)
{
    double speed = length(v);
    double floor_speed = length_squared(law->wish) > 0 ? law->speed : 0;
    double until = law->braking + law->drag > 0 ? brake_time(speed, floor_speed, law->braking, law->drag) : INFINITY;
    double used = min_of(t, until);
    double distance;
    double end = brake(speed, law->braking, law->drag, used, &distance);
    vec3 direction = scale(v, 1.0 / speed);
    if (until <= t) {
        end = floor_speed;
        m->stop_time = floor_speed == 0 ? until : -1;
    }
    m->velocity = scale(direction, end);
    m->displacement = scale(direction, distance);
    return until <= t && floor_speed == 0 ? t : used;
}

static void wish_phase(const tahr__law *law, vec3 v, double t, tahr__motion *m)
{
    double speed = law->speed, f = law->turn_friction;
    double p = dot(v, law->wish);
    vec3 across = reject(v, law->wish);
    double q = length(across);
    vec3 side = q > 0 ? scale(across, 1.0 / q) : vec(0, 0, 0);
    q = min_of(q, speed);    /* more is only rounding: over-speed was braked before */
    if (q < 1e-15 * speed) { /* and so is a part across the wish of less than half a unit in the last place */
        q = 0;
    }
    p = min_of(p, sqrt(max_of(speed * speed - q * q, 0)));
    double e = q > 0 ? tahr__expm1(-f * t) : 0;
    double q1 = q * (1 + e);
    double meet = law->acceleration > 0 ? meeting_time(law, p, q, q1, t) : INFINITY;
    double free = min_of(t, meet);
    double along = p * free + 0.5 * law->acceleration * free * free;
    double sideways = q > 0 ? q * (f * t < SMALL ? decay_integral(f, t) : -e / f) : 0;
    double p1 = p + law->acceleration * free;
    if (meet < t) {
        double on;
        double qm = free > 0 ? q * (1 + tahr__expm1(-f * free)) : q;
        p1 = on_cap(law, qm, free > 0 && q > 0 ? tahr__expm1(-f * (t - free)) : e, t - free, &on);
        along += on;
    }
    m->displacement = add(m->displacement, add(scale(law->wish, along), scale(side, sideways)));
    m->velocity = add(scale(law->wish, p1), scale(side, q1));
}

tahr__motion tahr__law_advance(const tahr__law *law, vec3 v, double t)
{
    tahr__motion m = {{0, 0, 0}, v, -1};
    double speed = length(v);
    int wishes = length_squared(law->wish) > 0 && law->speed > 0;
    double rest = t;
    if (speed == 0 && !wishes) {
        return m;
    }
    if (!wishes || speed > law->speed * (1 + ROUNDING)) {
        rest = t - brake_phase(law, v, t, &m);
    }
    if (wishes && rest > 0) {
        wish_phase(law, m.velocity, rest, &m);
    }
    return m;
}

double tahr__fall_advance(double v0, double g, double terminal, double hold, double t, double *v)
{
    double coast = min_of(hold, t);
    double rise = v0 * coast;
    double rest = t - coast;
    if (v0 < -terminal) { /* thrown down faster than terminal: held to it */
        v0 = -terminal;
    }
    double to_terminal = g > 0 ? (v0 + terminal) / g : INFINITY;
    double free = min_of(rest, to_terminal);
    rise += v0 * free - 0.5 * g * free * free;
    *v = v0 - g * free;
    if (rest > free) {
        *v = -terminal;
        rise -= terminal * (rest - free);
    }
    return rise;
}

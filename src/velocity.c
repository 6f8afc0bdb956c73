/* SPDX-License-Identifier: MIT
 * velocity.c: acceleration, turning, braking, jump and fall as exact solutions, so that a second of movement is the
 * same at 10 and at 1000 Hz.
 *
 * With p, q the velocity along and across the wish, A acceleration, f turn friction, V the speed asked for:
 *   q(t) = q0 e^(-f t),  p(t) = min(p0 + A t, c(t)),  c = sqrt(V^2 - q^2).
 * The cap c is concave, so the free line meets it at most once. Without a wish, or above V:
 *   v' = -F v - B along the fixed direction, which stops at ln(1 + F v / B) / F. */
#include "velocity.h"

#include "elementary.h"

static const double SMALL = TAHR__SMALL_DECAY;

/* A Newton step of this part of the time leaves an error of its square: the last one. */
static const double NEWTON_ENDS = 1e-9;

/* (1 - e^(-f t)) / f */
static double decay_integral(double f, double t)
{
    const double x = f * t;
    return x < SMALL ? decay_series(x, t) : -tahr__expm1(-x) / f;
}

tahr__decay tahr__decay_of(double exponent)
{
    const tahr__decay decay = {exponent, tahr__expm1(-exponent)};
    return decay;
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

static double cap(const tahr__law *law, double q2)
{
    return sqrt(max_of(law->speed * law->speed - q2, 0));
}

/* When the free line p0 + A s crosses the cap upward; t if not before. q2 = q(0)^2, e = expm1(-f t). The function p0 +
 * A s - c(s) is convex, and as c <= V not negative at (V - p0) / A: Newton from there falls monotonically onto the
 * upper root, which is the crossing (a lower root at s = 0 belongs to a velocity wholly across the wish). 8 rounds
 * reach rounding; after a step of a billionth the next one would be of its square. */
static double meeting_time(const tahr__law *law, double p0, double q2, double e, double t)
{
    double a = law->acceleration, f = law->turn_friction;
    if (p0 + a * t <= cap(law, q2 * (1 + e) * (1 + e))) {
        return t;
    }
    double s = min_of(t, (law->speed - p0) / a);
    for (int i = 0; i < 8; i++) {
        double decay = 1 + tahr__expm1(-f * s);
        double qs2 = q2 * decay * decay;
        double c = cap(law, qs2);
        double value = p0 + a * s - c;
        double slope = c > 0 ? a - f * qs2 / c : 0;
        if (value <= 0 || slope <= 0) {
            break;
        }
        double back = value / slope;
        s = max_of(s - back, 0);
        if (back < NEWTON_ENDS * s) {
            break;
        }
    }
    return s;
}

/* Along the cap from c0 = c(0) for t, e = expm1(-f t): the way, [out] c(t). The integral of c is
 * V t + (V ln((V + c1)/(V + c0)) - (c1 - c0)) / f. */
static double on_cap(const tahr__law *law, double q2, double c0, double e, double t, double *c1)
{
    double v = law->speed, f = law->turn_friction;
    *c1 = cap(law, q2 * (1 + e) * (1 + e));
    if (f * t < 1e-12 || c0 + *c1 <= 0) {
        return c0 * t;
    }
    double rise = -q2 * e * (2 + e) / (c0 + *c1); /* c1 - c0 without cancellation */
    return v * t + (v * tahr__log1p(rise / (v + c0)) - rise) / f;
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

/* Of a speed on the cap, which is what the last step left: forty times what rounding does to it, and less than a
 * billionth of a micrometre in a step. Who is told to be below it looks for the way back there. */
#define ON_CAP (1 - 1e-14)

double tahr__law_bent(const tahr__law *law, double p, double q2, double e, double t, double *p1)
{
    double f = law->turn_friction, a = law->acceleration, c = cap(law, q2);
    if (p >= c * ON_CAP && a > 0 && a * c >= f * q2) { /* on the cap, and the line is steeper: stays on it */
        return on_cap(law, q2, c, e, t, p1);
    }
    p = min_of(p, c);
    double free = a > 0 ? meeting_time(law, p, q2, e, t) : t;
    double along = p * free + 0.5 * a * free * free;
    *p1 = p + a * free;
    if (free < t) {
        double decay = free > 0 ? 1 + tahr__expm1(-f * free) : 1;
        q2 *= decay * decay;
        along += on_cap(law, q2, cap(law, q2), free > 0 ? tahr__expm1(-f * (t - free)) : e, t - free, p1);
    }
    return along;
}

double tahr__decayed(double x)
{
    return tahr__expm1(-x);
}

tahr__motion tahr__law_turn(const tahr__law *law, vec3 across, double p, double t)
{
    return law_turn(law, across, p, t);
}

/* Brakes to rest or to the speed asked for, and goes on from there. */
static tahr__motion brake_first(const tahr__law *law, vec3 v, double t, int wishes)
{
    tahr__motion m = {{0, 0, 0}, v, -1};
    double rest = t - brake_phase(law, v, t, &m);
    if (wishes && rest > 0) {
        tahr__motion then = law_toward_wish(law, m.velocity, rest);
        m.displacement = add(m.displacement, then.displacement);
        m.velocity = then.velocity;
    }
    return m;
}

tahr__motion tahr__law_brake(const tahr__law *law, vec3 v, double t)
{
    const int wishes = law_wishes(law);
    if (wishes || length_squared(v) > 0) {
        return brake_first(law, v, t, wishes);
    }
    tahr__motion rest = {{0, 0, 0}, v, -1};
    return rest;
}

tahr__motion tahr__law_advance(const tahr__law *law, vec3 v, double t)
{
    return law_advance(law, law_wishes(law), v, t);
}

/* Across the wish it decays; along it the cap takes no more than the acceleration is, or it would not stay on it. */
double tahr__law_bending(const tahr__law *law, vec3 v)
{
    vec3 across = reject(v, law->wish);
    int straight = length_squared(across) <= 1e-12 * length_squared(v);
    return law->speed > 0 && !straight ? law->acceleration + law->turn_friction * length(across) : 0;
}

/* Two bounds. |a| t^2 / 8 of any curve. And while it turns, of the way to its side: that decays, to no more than q / f
 * in all, and way and chord lie on the same side of it; going back at first is over after p^2 / (2 A). */
double tahr__law_sagitta(const tahr__law *law, vec3 v, double t)
{
    double bent = tahr__law_bending(law, v) * t * t / 8, p = dot(v, law->wish);
    if (bent == 0 || law_brakes(law, v) || !(law->turn_friction > 0)) {
        return bent;
    }
    double across = length(reject(v, law->wish)), aside = across * min_of(t, 1 / law->turn_friction);
    double back = p >= 0 ? 0 : law->acceleration > 0 ? p * p / (2 * law->acceleration) : INFINITY;
    return min_of(bent, aside + back);
}

/* Straight at the wish, not backward: when a way is covered. */
static double straight_time(const tahr__law *law, double p, double way)
{
    double v = law->speed, a = law->acceleration;
    double gain = v * v - p * p; /* on the free line 2 A way */
    if (p >= v || (a > 0 && 2 * a * way > gain)) {
        double free = p < v ? (v - p) / a : 0;
        return free + (way - 0.5 * (p + v) * free) / v;
    }
    return 2 * way / (p + sqrt(p * p + 2 * a * way));
}

/* Newton, held within the duration, from the root for a constant acceleration (from rest the rate at a small part is
 * nearly 0, and any other guess halves its way down): 6 rounds reach rounding. */
double tahr__law_time(const tahr__law *law, vec3 v, double duration, vec3 whole, double part)
{
    double low = 0, high = duration, size2 = length_squared(whole);
    vec3 measure = scale(whole, 1.0 / size2);
    double rate = dot(v, measure);
    if (law->speed > 0 && rate > 0 && !law_brakes(law, v)) {
        double p = dot(v, law->wish), most = law->speed;
        double q2 = length_squared(add_scaled(v, law->wish, -p));
        if (p > 0 && q2 <= TAHR__STRAIGHT * most * most) {
            return min_of(straight_time(law, min_of(p, most), part * dot(whole, law->wish)), duration);
        }
    }
    double gain = (1 - rate * high) / (high * high);
    double root = sqrt(max_of(rate * rate + 4 * gain * part, 0));
    double t = rate >= 0 ? 2 * part / (rate + root) : (root - rate) / (2 * gain);
    t = t >= 0 && t <= high ? t : part * high;
    for (int i = 0; i < 6; i++) {
        tahr__motion m = tahr__law_advance(law, v, t);
        double over = dot(m.displacement, measure) - part;
        rate = dot(m.velocity, measure);
        double next = newton_next(t, over, rate, &low, &high);
        double moved = next > t ? next - t : t - next;
        t = next;
        if (moved <= NEWTON_ENDS * duration) {
            break;
        }
    }
    return t;
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

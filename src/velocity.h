/* SPDX-License-Identifier: MIT
 * velocity.h: velocity and displacement over a time, in closed form. Asks nothing, allocates nothing. */
#ifndef TAHR_VELOCITY_H
#define TAHR_VELOCITY_H

#include "vec.h"

/* What is left of the part across a wish after a time, less 1: worked out once for many steps of one length. All zero:
 * nothing is known, and that too is true. */
typedef struct tahr__decay {
    double exponent; /* turn_friction times the time */
    double rate;     /* expm1(-exponent) */
} tahr__decay;

/* How a velocity across up answers to a wish. */
typedef struct tahr__law {
    vec3 wish;            /* unit direction across up, or zero: no input */
    double speed;         /* m/s asked for, >= 0 */
    double acceleration;  /* m/s2 along the wish */
    double turn_friction; /* 1/s decay of the part across the wish */
    tahr__decay decay;    /* of a whole step, or zero: a result that is known, no setting */
    double braking;       /* m/s2 without input or above speed */
    double drag;          /* 1/s added to it */
} tahr__law;

typedef struct tahr__motion {
    vec3 displacement;
    vec3 velocity;
    double stop_time; /* s at which the velocity became zero; < 0: it did not during this time */
} tahr__motion;

tahr__decay tahr__decay_of(double exponent);

/* Works out the decay of a step of t seconds, unless it is known. */
static inline void decay_learn(tahr__decay *decay, double friction, double t)
{
    const double exponent = friction * t;
    if (exponent != decay->exponent) {
        *decay = tahr__decay_of(exponent);
    }
}

/* Advances the velocity v (across up) by t >= 0 seconds. Composes: two halves give the whole, to rounding. */
tahr__motion tahr__law_advance(const tahr__law *law, vec3 v, double t);

/* Relative excess over the asked speed that is rounding, not over-speed. */
#define TAHR__OVER_SPEED 1e-12

/* A part across the wish, squared and relative to the speed asked for, of less than half a unit in the last place is
 * rounding too. */
#define TAHR__STRAIGHT 1e-30

/* The rarer parts of it: of a velocity not above the speed asked for, `across` and p along the wish; and of all that is
 * above it, or without a wish. */
tahr__motion tahr__law_turn(const tahr__law *law, vec3 across, double p, double t);
tahr__motion tahr__law_brake(const tahr__law *law, vec3 v, double t);

static inline int law_wishes(const tahr__law *law)
{
    return law->speed > 0 && length_squared(law->wish) > 0;
}

static inline int law_brakes(const tahr__law *law, vec3 v)
{
    const double most = law->speed * (1 + TAHR__OVER_SPEED);
    return length_squared(v) > most * most;
}

/* Along the wish while the part across it is too small to bend the cap: the free line, and from where it meets the
 * speed asked for that speed. Returns the way, [out] the speed at the end. */
static inline double law_straight(const tahr__law *law, double p, double t, double *p1)
{
    double v = law->speed, a = law->acceleration;
    double free = t;
    if (p >= v && a > 0) {
        *p1 = v;
        return v * t;
    }
    if (p + a * t > v) {
        free = min_of(t, (v - p) / a);
    }
    double along = p * free + 0.5 * a * free * free;
    *p1 = free < t ? v : p + a * free;
    return free < t ? along + v * (t - free) : along;
}

/* From a velocity that is not above the speed asked for. */
static inline tahr__motion law_toward_wish(const tahr__law *law, vec3 v, double t)
{
    const double most = law->speed, p = dot(v, law->wish);
    const vec3 across = add_scaled(v, law->wish, -p);
    double p1;
    if (!(length_squared(across) <= TAHR__STRAIGHT * most * most)) {
        return tahr__law_turn(law, across, p, t);
    }
    const double along = law_straight(law, min_of(p, most), t, &p1);
    const tahr__motion m = {scale(law->wish, along), scale(law->wish, p1), -1};
    return m;
}

/* tahr__law_advance, for where every call counts. wishes: law_wishes. */
static inline tahr__motion law_advance(const tahr__law *law, int wishes, vec3 v, double t)
{
    return wishes && !law_brakes(law, v) ? law_toward_wish(law, v, t) : tahr__law_brake(law, v, t);
}

/* Below this f t the quotient expm1(-f t) / f is replaced by its series, which keeps 1 ulp down to f = 0. */
#define TAHR__SMALL_DECAY 1e-4

static inline double decay_series(double x, double t)
{
    return t * (1 - x * (0.5 - x * (1.0 / 6 - x * (1.0 / 24))));
}

/* expm1(-x) */
double tahr__decayed(double x);

/* Along the wish: the free line, and from where it meets the cap along the cap. q2 = q(0)^2, e = expm1(-f t). Returns
 * the way, [out] the speed at the end. */
double tahr__law_bent(const tahr__law *law, double p, double q2, double e, double t, double *p1);

/* A part across the wish, squared and relative to the speed asked for: up to here V - c and what it takes off the way
 * are below half a unit in the last place, q^2 / (2 V^2). */
#define TAHR__FLAT_CAP 2.5e-17

/* tahr__law_turn. */
static inline tahr__motion law_turn(const tahr__law *law, vec3 across, double p, double t)
{
    const double most = law->speed, f = law->turn_friction, x = f * t, q2 = length_squared(across);
    const double e = x == law->decay.exponent ? law->decay.rate : tahr__decayed(x);
    const double sideways = x < TAHR__SMALL_DECAY ? decay_series(x, t) : -e / f;
    double p1;
    const double along = q2 <= TAHR__FLAT_CAP * most * most ? law_straight(law, min_of(p, most), t, &p1)
                                                            : tahr__law_bent(law, p, q2, e, t, &p1);
    const tahr__motion m = {.displacement = add_scaled(scale(law->wish, along), across, sideways),
                            .velocity = add_scaled(scale(law->wish, p1), across, 1 + e),
                            .stop_time = -1};
    return m;
}

/* law_advance of a velocity (x, y, 0) and a wish without z, which adds no more than zeros to the sums. */
static inline tahr__motion law_advance_level(const tahr__law *law, int wishes, double x, double y, double t)
{
    const double most = law->speed, over = most * (1 + TAHR__OVER_SPEED);
    if (!wishes || x * x + y * y > over * over) {
        return tahr__law_brake(law, vec(x, y, 0), t);
    }
    const double p = x * law->wish.x + y * law->wish.y;
    const vec3 across = vec(x + law->wish.x * -p, y + law->wish.y * -p, 0);
    double p1;
    if (!(across.x * across.x + across.y * across.y <= TAHR__STRAIGHT * most * most)) {
        return law_turn(law, across, p, t);
    }
    const double along = law_straight(law, min_of(p, most), t, &p1);
    const tahr__motion m = {vec(law->wish.x * along, law->wish.y * along, 0),
                            vec(law->wish.x * p1, law->wish.y * p1, 0), -1};
    return m;
}

/* s within duration at which a part (0..1) of the way is covered, measured along the whole of it; whole is the
 * displacement after duration and not zero. The speed changes on the way, so the part of the time is not the part of
 * the way. */
double tahr__law_time(const tahr__law *law, vec3 v, double duration, vec3 whole, double part);

/* m/s2: no acceleration across the way is more; 0 while it goes straight along the wish, or brakes. A chord of t
 * seconds lies off the way by an eighth of it times t^2. */
double tahr__law_bending(const tahr__law *law, vec3 v);

/* m: the way of t seconds lies off its chord by no more. */
double tahr__law_sagitta(const tahr__law *law, vec3 v, double t);

/* One round of a Newton that is held within [low, high], for a function that rises through zero: over is its value at
 * t, rate its slope there. Narrows the bracket and returns where to look next. */
static inline double newton_next(double t, double over, double rate, double *low, double *high)
{
    *(over > 0 ? high : low) = t;
    double next = rate > 0 ? t - over / rate : 0.5 * (*low + *high);
    return next >= *low && next <= *high ? next : 0.5 * (*low + *high);
}

/* A fall: the velocity along up is v0 at the start, gravity g (m/s2, > 0, along -up) acts after `hold` seconds, and the
 * fall is never faster than terminal. Returns the rise after t seconds, [out] v the velocity then. */
double tahr__fall_advance(double v0, double g, double terminal, double hold, double t, double *v);

#endif

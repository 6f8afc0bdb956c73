/* SPDX-License-Identifier: MIT
 * vec.h: vectors and quaternions of the core. Fixed evaluation order, no contraction: the same bits everywhere. */
#ifndef TAHR_VEC_H
#define TAHR_VEC_H

#include <math.h>
#include <stdint.h>
#include <string.h>
#include <tahr/types.h>

#ifdef __FAST_MATH__
#error "Tahr must not be compiled with -ffast-math: its results would differ from machine to machine"
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

typedef tahr_vec3 vec3;

static inline vec3 vec(double x, double y, double z)
{
    vec3 v = {x, y, z};
    return v;
}

static inline vec3 add(vec3 a, vec3 b)
{
    return vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline vec3 sub(vec3 a, vec3 b)
{
    return vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline vec3 scale(vec3 a, double s)
{
    return vec(a.x * s, a.y * s, a.z * s);
}

/* a + b * s */
static inline vec3 add_scaled(vec3 a, vec3 b, double s)
{
    return vec(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

static inline double dot(vec3 a, vec3 b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

static inline vec3 cross(vec3 a, vec3 b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double length_squared(vec3 a)
{
    return dot(a, a);
}

static inline double length(vec3 a)
{
    return sqrt(dot(a, a));
}

/* The zero vector stays zero. */
static inline vec3 unit(vec3 a)
{
    double l = length(a);
    return l > 0 ? scale(a, 1.0 / l) : vec(0, 0, 0);
}

/* The part of a across the unit vector n. */
static inline vec3 reject(vec3 a, vec3 n)
{
    return add_scaled(a, n, -dot(a, n));
}

static inline double min_of(double a, double b)
{
    return b < a ? b : a;
}

static inline double max_of(double a, double b)
{
    return b > a ? b : a;
}

static inline double clamp(double x, double low, double high)
{
    return x < low ? low : (x > high ? high : x);
}

/* False for NaN and both infinities. */
static inline int is_finite(double x)
{
    return x - x == 0;
}

static inline int vec_is_finite(vec3 a)
{
    return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

static inline int vec_equal(vec3 a, vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static inline uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* 0 if they are equal to the bit, so that 0.0 is not -0.0: many such tests make one branch. */
static inline uint64_t other_bits(const vec3 *a, const vec3 *b)
{
    return (bits_of(a->x) ^ bits_of(b->x)) | (bits_of(a->y) ^ bits_of(b->y)) | (bits_of(a->z) ^ bits_of(b->z));
}

static inline vec3 rotate(tahr_quat q, vec3 v)
{
    vec3 u = vec(q.x, q.y, q.z);
    vec3 t = scale(cross(u, v), 2);
    return add(add_scaled(v, t, q.w), cross(u, t));
}

/* First b, then a. Only sums: GCC 12 makes fused instructions of differences beside sums where the machine has them,
 * whatever -ffp-contract says, and that is other bits. */
static inline tahr_quat quat_multiply(tahr_quat a, tahr_quat b)
{
    const double x = -a.x, y = -a.y, z = -a.z;
    tahr_quat r = {a.w * b.x + a.x * b.w + a.y * b.z + z * b.y, a.w * b.y + x * b.z + a.y * b.w + a.z * b.x,
                   a.w * b.z + a.x * b.y + y * b.x + a.z * b.w, a.w * b.w + x * b.x + y * b.y + z * b.z};
    return r;
}

/* Of a unit quaternion. */
static inline tahr_quat quat_inverse(tahr_quat q)
{
    tahr_quat r = {-q.x, -q.y, -q.z, q.w};
    return r;
}

static inline tahr_quat quat_unit(tahr_quat q)
{
    double l = sqrt((q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w));
    tahr_quat identity = {0, 0, 0, 1};
    tahr_quat r = {q.x / l, q.y / l, q.z / l, q.w / l};
    return l > 0 ? r : identity;
}

/* The shortest turn that takes the unit vector a to the unit vector b. */
static inline tahr_quat quat_between(vec3 a, vec3 b)
{
    vec3 c = cross(a, b);
    tahr_quat q = {c.x, c.y, c.z, 1 + dot(a, b)};
    if (q.w < 1e-12) { /* opposite: half a turn about any axis across a */
        vec3 axis = unit(cross(a, a.x * a.x < 0.5 ? vec(1, 0, 0) : vec(0, 1, 0)));
        tahr_quat half = {axis.x, axis.y, axis.z, 0};
        return half;
    }
    return quat_unit(q);
}

#endif

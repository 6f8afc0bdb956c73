/* SPDX-License-Identifier: MIT
 * vec.h: vectors of the shell. */
#ifndef TAHR_CLI_VEC_H
#define TAHR_CLI_VEC_H

#include <math.h>
#include <tahr/types.h>

static inline tahr_vec3 vec_add(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline tahr_vec3 vec_sub(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline tahr_vec3 vec_scale(tahr_vec3 a, double s)
{
    return (tahr_vec3){a.x * s, a.y * s, a.z * s};
}

static inline double vec_dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline tahr_vec3 vec_cross(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double vec_length(tahr_vec3 a)
{
    return sqrt(vec_dot(a, a));
}

static inline tahr_vec3 vec_turn(tahr_quat q, tahr_vec3 v)
{
    tahr_vec3 axis = {q.x, q.y, q.z};
    tahr_vec3 t = vec_scale(vec_cross(axis, v), 2);
    return vec_add(vec_add(v, vec_scale(t, q.w)), vec_cross(axis, t));
}

static inline tahr_vec3 vec_turn_back(tahr_quat q, tahr_vec3 v)
{
    return vec_turn((tahr_quat){-q.x, -q.y, -q.z, q.w}, v);
}

static inline int vec_finite(tahr_vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static inline double least(double a, double b)
{
    return a < b ? a : b;
}

static inline double most(double a, double b)
{
    return a > b ? a : b;
}

static inline double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

#endif

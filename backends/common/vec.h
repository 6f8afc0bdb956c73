/* SPDX-License-Identifier: MIT
 * vec.h: the few vector operations that backends need; every one in double, without contraction, in a fixed order. */
#ifndef TAHR_COMMON_VEC_H
#define TAHR_COMMON_VEC_H

#include <tahr/types.h>

#include <math.h>

#if defined(__FAST_MATH__)
#error "Tahr must not be compiled with -ffast-math: answers would depend on the compiler"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

static inline tahr_vec3 v_make(double x, double y, double z)
{
    tahr_vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline tahr_vec3 v_add(tahr_vec3 a, tahr_vec3 b)
{
    return v_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline tahr_vec3 v_sub(tahr_vec3 a, tahr_vec3 b)
{
    return v_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline tahr_vec3 v_scale(tahr_vec3 a, double s)
{
    return v_make(a.x * s, a.y * s, a.z * s);
}

/* a + b * s */
static inline tahr_vec3 v_mad(tahr_vec3 a, tahr_vec3 b, double s)
{
    return v_make(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

static inline double v_dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline tahr_vec3 v_cross(tahr_vec3 a, tahr_vec3 b)
{
    return v_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double v_length(tahr_vec3 a)
{
    return sqrt(v_dot(a, a));
}

/* The unit vector along a; a itself must not be zero. */
static inline tahr_vec3 v_unit(tahr_vec3 a)
{
    return v_scale(a, 1.0 / v_length(a));
}

static inline double v_get(tahr_vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

static inline double d_min(double a, double b)
{
    return a < b ? a : b;
}

static inline double d_max(double a, double b)
{
    return a > b ? a : b;
}

static inline tahr_vec3 v_min(tahr_vec3 a, tahr_vec3 b)
{
    return v_make(d_min(a.x, b.x), d_min(a.y, b.y), d_min(a.z, b.z));
}

static inline tahr_vec3 v_max(tahr_vec3 a, tahr_vec3 b)
{
    return v_make(d_max(a.x, b.x), d_max(a.y, b.y), d_max(a.z, b.z));
}

static inline tahr_vec3 v_abs(tahr_vec3 a)
{
    return v_make(fabs(a.x), fabs(a.y), fabs(a.z));
}

/* A float not above (down) or not below (up) a double: the relative slack is four float ulps, the absolute one covers
 * zero and denormals. Bounds that are rounded outward can only make a cull keep more. */
static inline float d_down(double x)
{
    return (float)(x - (fabs(x) * 2.4e-7 + 1e-30));
}

static inline float d_up(double x)
{
    return (float)(x + (fabs(x) * 2.4e-7 + 1e-30));
}

/* Rows of a rotation matrix. */
typedef struct tahr__mat {
    tahr_vec3 row[3];
} tahr__mat;

static inline tahr_vec3 m_apply(const tahr__mat *m, tahr_vec3 v)
{
    return v_make(v_dot(m->row[0], v), v_dot(m->row[1], v), v_dot(m->row[2], v));
}

/* The inverse of a rotation. */
static inline tahr_vec3 m_unapply(const tahr__mat *m, tahr_vec3 v)
{
    return v_make(m->row[0].x * v.x + m->row[1].x * v.y + m->row[2].x * v.z,
                  m->row[0].y * v.x + m->row[1].y * v.y + m->row[2].y * v.z,
                  m->row[0].z * v.x + m->row[1].z * v.y + m->row[2].z * v.z);
}

static inline tahr__mat m_identity(void)
{
    tahr__mat m;
    m.row[0] = v_make(1, 0, 0);
    m.row[1] = v_make(0, 1, 0);
    m.row[2] = v_make(0, 0, 1);
    return m;
}

/* a * b */
static inline tahr__mat m_mul(const tahr__mat *a, const tahr__mat *b)
{
    tahr__mat m;
    for (int i = 0; i < 3; i++)
        m.row[i] = m_unapply(b, a->row[i]);
    return m;
}

/* From a quaternion of any length; zero means identity. Exact for the identity. */
static inline tahr__mat m_from_quat(tahr_quat q)
{
    double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (!(n > 0)) return m_identity();
    double s = 2.0 / n, back = -q.w; /* only sums: see quat_multiply in src/vec.h */
    tahr__mat m;
    m.row[0] = v_make(1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y + q.z * back), s * (q.x * q.z + q.y * q.w));
    m.row[1] = v_make(s * (q.x * q.y + q.z * q.w), 1 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z + q.x * back));
    m.row[2] = v_make(s * (q.x * q.z + q.y * back), s * (q.y * q.z + q.x * q.w), 1 - s * (q.x * q.x + q.y * q.y));
    return m;
}

/* A rotation that takes the unit vector up to +z; the identity, exactly, for +z itself. Rotates by the shortest way for
 * the upper half space; the lower half is turned about x first, so that the division is by at least 1 everywhere. */
static inline tahr__mat m_upright(tahr_vec3 up)
{
    double flip = up.z < 0 ? -1.0 : 1.0;
    double a = up.x, b = up.y * flip, c = up.z * flip;
    double k = 1.0 / (1.0 + c);
    tahr__mat m;
    m.row[0] = v_make(1 - a * a * k, (-a * b * k) * flip, -a * flip);
    m.row[1] = v_make(-a * b * k, (1 - b * b * k) * flip, -b * flip);
    m.row[2] = v_make(a, b * flip, c * flip);
    return m;
}

#endif

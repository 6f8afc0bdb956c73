/* SPDX-License-Identifier: MIT
 * lane_4.h: four floats at a time by the compiler's vectors, which every machine has; for a file that then includes a
 * kernel. With GCC and clang alone. */
#ifndef TAHR_COMMON_LANE_4_H
#define TAHR_COMMON_LANE_4_H

#include <math.h>
#include <stdint.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

enum { WIDTH = 4 };

typedef float lane __attribute__((vector_size(16)));
typedef int32_t mask __attribute__((vector_size(16)));

static inline lane splat(float x)
{
    return (lane){x, x, x, x};
}

/* One bit per lane. */
static inline unsigned bits(mask m)
{
#if defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)m);
#else
    return (unsigned)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

/* a > b ? a : b; one instruction where the compiler does not see that by itself. */
static inline lane larger(lane a, lane b)
{
#if defined(__SSE2__)
    return (lane)_mm_max_ps((__m128)a, (__m128)b);
#else
    mask m = a > b;
    return (lane)(((mask)a & m) | ((mask)b & ~m));
#endif
}

static inline lane root(lane a)
{
#if defined(__SSE2__)
    return (lane)_mm_sqrt_ps((__m128)a);
#else
    return (lane){sqrtf(a[0]), sqrtf(a[1]), sqrtf(a[2]), sqrtf(a[3])};
#endif
}

#endif

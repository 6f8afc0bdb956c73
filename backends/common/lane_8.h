/* SPDX-License-Identifier: MIT
 * lane_8.h: eight floats at a time, as lane_4.h; for a file that has asked for AVX2. */
#ifndef TAHR_COMMON_LANE_8_H
#define TAHR_COMMON_LANE_8_H

#include <stdint.h>

#include <immintrin.h>

enum { WIDTH = 8 };

typedef float lane __attribute__((vector_size(32)));
typedef int32_t mask __attribute__((vector_size(32)));

static inline lane splat(float x)
{
    return (lane){x, x, x, x, x, x, x, x};
}

/* One bit per lane. */
static inline unsigned bits(mask m)
{
    return (unsigned)_mm256_movemask_ps((__m256)m);
}

/* a > b ? a : b */
static inline lane larger(lane a, lane b)
{
    return (lane)_mm256_max_ps((__m256)a, (__m256)b);
}

static inline lane root(lane a)
{
    return (lane)_mm256_sqrt_ps((__m256)a);
}

#endif

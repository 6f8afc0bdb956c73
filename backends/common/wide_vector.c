/* SPDX-License-Identifier: MIT
 * wide_vector.c: the look at a node four children at a time, which every machine has by its compiler's vectors, and
 * which one to take. */
#include "wide.h"

#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#if defined(__GNUC__)

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

static inline uint32_t bits_within(lane x, float limit)
{
    mask m = x <= splat(limit);
#if defined(__SSE2__)
    return (uint32_t)_mm_movemask_ps((__m128)m);
#else
    return (uint32_t)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

static inline lane steps(const uint8_t *p)
{
#if defined(__SSE2__)
    int32_t four;
    memcpy(&four, p, sizeof four);
    __m128i zero = _mm_setzero_si128(), x = _mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero);
    return (lane)_mm_cvtepi32_ps(_mm_unpacklo_epi16(x, zero));
#else
    return (lane){(float)p[0], (float)p[1], (float)p[2], (float)p[3]};
#endif
}

#include "wide_kernel.h"

uint32_t tahr__wide_test_4(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    return wide_test(node, box, point, away);
}

#else

uint32_t tahr__wide_test_4(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    return tahr__wide_test_1(node, box, point, away);
}

#endif

tahr__wide_fn *tahr__wide_best(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return tahr__wide_test_8;
#endif
    return tahr__wide_test_4;
}

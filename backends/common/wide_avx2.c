/* SPDX-License-Identifier: MIT
 * wide_avx2.c: the look at a node, all eight children at once. Only called where the processor has AVX2; without FMA,
 * so that it does the operations of the scalar twin. */
#include "wide.h"

#include <string.h>

#if defined(__GNUC__) && defined(__x86_64__)

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#include <immintrin.h>

enum { WIDTH = 8 };

typedef float lane __attribute__((vector_size(32)));

static inline lane splat(float x)
{
    return (lane){x, x, x, x, x, x, x, x};
}

static inline lane larger(lane a, lane b)
{
    return (lane)_mm256_max_ps((__m256)a, (__m256)b);
}

static inline uint32_t bits_within(lane x, float limit)
{
    return (uint32_t)_mm256_movemask_ps((__m256)(x <= splat(limit)));
}

static inline lane steps(const uint8_t *p)
{
    int64_t eight;
    memcpy(&eight, p, sizeof eight);
    return (lane)_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(eight)));
}

#include "wide_kernel.h"

uint32_t tahr__wide_test_8(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    return wide_test(node, box, point, away);
}

#if defined(__clang__)
#pragma clang attribute pop
#endif

#else

uint32_t tahr__wide_test_8(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    return tahr__wide_test_4(node, box, point, away);
}

#endif

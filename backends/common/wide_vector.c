/* SPDX-License-Identifier: MIT
 * wide_vector.c: the look at a node four children at a time, which every machine has by its compiler's vectors, and
 * which one to take. */
#include "wide.h"

#include "processor.h"

#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#if defined(__GNUC__)

#include "lane_4.h"

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
    return tahr__has_avx2() ? tahr__wide_test_8 : tahr__wide_test_4;
}

tahr__wide_items_fn *tahr__wide_items_best(void)
{
    if (tahr__has_avx512()) return tahr__wide_items_512;
    return tahr__has_avx2() ? tahr__wide_items_8 : tahr__wide_items_1;
}

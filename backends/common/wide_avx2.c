/* SPDX-License-Identifier: MIT
 * wide_avx2.c: the look at a node, all eight children at once. Only called where the processor has AVX2; without FMA,
 * so that it does the operations of the scalar twin. */
#include "wide.h"

#include <string.h>

#if defined(__GNUC__) && defined(__x86_64__)

#include "avx2_begin.h"

#include "lane_8.h"

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

#include "avx2_end.h"

#else

uint32_t tahr__wide_test_8(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    return tahr__wide_test_4(node, box, point, away);
}

#endif

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

#include "wide_ends.h"

/* As that of the scalar twin: each end is compared with those of all children at once. */
static inline uint32_t meets(const tahr__wide_node *n, const tahr__wide_box *box)
{
    __m128i ends;
    if (!ends_of(n, box, &ends)) return 0;
    /* The children's bounds are low x, y, z, high x, y, z, eight bytes each; ends 0, 1, 2 and 4, 5, 6 bound them. */
    const __m128i low_xy = _mm_loadu_si128((const __m128i *)(const void *)n->lo[0]);
    const __m128i low_z_high_x = _mm_loadu_si128((const __m128i *)(const void *)n->lo[2]);
    const __m128i high_yz = _mm_loadu_si128((const __m128i *)(const void *)n->hi[1]);
    const __m128i to_xy = _mm_shuffle_epi8(ends, _mm_set_epi64x(0x0101010101010101, 0));
    const __m128i to_z_from_x = _mm_shuffle_epi8(ends, _mm_set_epi64x(0x0404040404040404, 0x0202020202020202));
    const __m128i from_yz = _mm_shuffle_epi8(ends, _mm_set_epi64x(0x0606060606060606, 0x0505050505050505));
    /* What is left of a difference that does not go below zero: nothing, where they meet. */
    const __m128i above = _mm_subs_epu8(low_z_high_x, to_z_from_x), below = _mm_subs_epu8(to_z_from_x, low_z_high_x);
    const __m128i mixed = _mm_castpd_si128(_mm_move_sd(_mm_castsi128_pd(below), _mm_castsi128_pd(above)));
    const __m128i apart =
        _mm_or_si128(_mm_or_si128(_mm_subs_epu8(low_xy, to_xy), _mm_subs_epu8(from_yz, high_yz)), mixed);
    const uint32_t met = (uint32_t)_mm_movemask_epi8(_mm_cmpeq_epi8(apart, _mm_setzero_si128()));
    return met & met >> 8 & (0xFFu >> (7 - (n->base[0] >> 29)));
}

/* The numbers of up to four bits. */
static inline uint32_t put_four(uint32_t *to, uint32_t first, uint32_t bits)
{
    /* The numbers of the bits of 0 to 15, a byte each, and how many they are, four bits each. */
    static const uint32_t numbers[16] = {0, 0,     1,     0x100,   2,     0x200,   0x201,   0x20100,
                                         3, 0x300, 0x301, 0x30100, 0x302, 0x30200, 0x30201, 0x3020100};
    const uint64_t counts = 0x4332322132212110;
    const __m128i each = _mm_cvtepu8_epi32(_mm_cvtsi32_si128((int32_t)numbers[bits]));
    _mm_storeu_si128((__m128i *)(void *)to, _mm_add_epi32(each, _mm_set1_epi32((int32_t)first)));
    return counts >> (4 * bits) & 15;
}

static inline uint32_t put_bits(uint32_t *to, uint32_t first, uint32_t bits)
{
    const uint32_t count = put_four(to, first, bits & 15);
    return count + put_four(to + count, first + 4, bits >> 4);
}

#include "wide_collect.h"

uint32_t tahr__wide_items_8(const tahr__wide *tree, const tahr__wide_box *box, uint32_t *items, uint32_t capacity)
{
    return wide_collect(tree, box, items, capacity);
}

#include "avx2_end.h"

#else

uint32_t tahr__wide_items_8(const tahr__wide *tree, const tahr__wide_box *box, uint32_t *items, uint32_t capacity)
{
    return tahr__wide_items_1(tree, box, items, capacity);
}

uint32_t tahr__wide_test_8(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    return tahr__wide_test_4(node, box, point, away);
}

#endif

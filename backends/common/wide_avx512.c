/* SPDX-License-Identifier: MIT
 * wide_avx512.c: all items that a box meets: a node is one vector, and the numbers of its children are written at once.
 * Only called where tahr__has_avx512 says so. */
#include "wide.h"

#if defined(__GNUC__) && defined(__x86_64__)

#include "avx512_begin.h"

#include <immintrin.h>

#include "wide_ends.h"

_Static_assert(sizeof(tahr__wide_node) == 64 && offsetof(tahr__wide_node, lo) == 16, "the children's bounds end it");

static inline uint32_t meets(const tahr__wide_node *n, const tahr__wide_box *box)
{
    __m128i ends;
    if (!ends_of(n, box, &ends)) return 0;
    /* Eight bytes each: what the children's bounds are held against. */
    const __m512i places = _mm512_set_epi64(0x0606060606060606, 0x0505050505050505, 0x0404040404040404,
                                            0x0202020202020202, 0x0101010101010101, 0, 0, 0);
    const __m512i node = _mm512_loadu_si512(n), against = _mm512_shuffle_epi8(_mm512_broadcast_i32x4(ends), places);
    const uint64_t low = _mm512_cmple_epu8_mask(node, against) >> 16;
    const uint64_t high = _mm512_cmpge_epu8_mask(node, against) >> 40;
    const uint64_t met = low & high;
    return (uint32_t)(met & met >> 8 & met >> 16) & (0xFFu >> (7 - (n->base[0] >> 29)));
}

static inline uint32_t put_bits(uint32_t *to, uint32_t first, uint32_t bits)
{
    const __m256i all = _mm256_add_epi32(_mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0), _mm256_set1_epi32((int32_t)first));
    _mm256_storeu_si256((__m256i *)(void *)to, _mm256_maskz_compress_epi32((__mmask8)bits, all));
    return (uint32_t)__builtin_popcount(bits);
}

#include "wide_collect.h"

uint32_t tahr__wide_items_512(const tahr__wide *tree, const tahr__wide_box *box, uint32_t *items, uint32_t capacity)
{
    return wide_collect(tree, box, items, capacity);
}

#include "avx2_end.h"

#else

uint32_t tahr__wide_items_512(const tahr__wide *tree, const tahr__wide_box *box, uint32_t *items, uint32_t capacity)
{
    return tahr__wide_items_1(tree, box, items, capacity);
}

#endif

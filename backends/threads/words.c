/* SPDX-License-Identifier: MIT
 * words.c: compares words, packs them by a mask, and unpacks them. */
#include "words.h"

#ifdef __SSE2__
#include <emmintrin.h>

/* one: aligned. */
static __m128i same(const char *one, const char *other)
{
    return _mm_cmpeq_epi32(_mm_load_si128((const void *)one), _mm_loadu_si128((const void *)other));
}

/* Of 8 words: 4 comparisons of 4 halves each become 16 bits, and those 8. Most lines do not change from step to step,
 * and cost no more than that. */
static uint64_t line_differs(const char *a, const char *b)
{
    const __m128i low = _mm_packs_epi32(same(a, b), same(a + 16, b + 16));
    const __m128i high = _mm_packs_epi32(same(a + 32, b + 32), same(a + 48, b + 48));
    uint32_t halves = ~(uint32_t)_mm_movemask_epi8(_mm_packs_epi16(low, high)) & 0xFFFFu;
    if (halves == 0) return 0;
    halves = (halves | halves >> 1) & 0x5555u;
    halves = (halves | halves >> 1) & 0x3333u;
    halves = (halves | halves >> 2) & 0x0F0Fu;
    return (halves | halves >> 4) & 0xFFu;
}
#else
static uint64_t line_differs(const char *a, const char *b)
{
    uint64_t differ = 0;
    for (int i = 0; i < 8; i++)
        differ |= (uint64_t)(tahr__word_of(a, i) != tahr__word_of(b, i)) << i;
    return differ;
}
#endif

uint64_t tahr__words_differ(const void *one, const void *other)
{
    const char *a = one, *b = other;
    uint64_t differ = 0;
    for (int i = 0; i < 64; i += 8)
        differ |= line_differs(a + 8 * i, b + 8 * i) << i;
    return differ;
}

uint64_t *tahr__words_pack(uint64_t *to, const void *object, uint64_t mask)
{
    *to++ = mask;
    for (; mask; mask &= mask - 1)
        *to++ = tahr__word_of(object, tahr__lowest_bit(mask));
    return to;
}

const uint64_t *tahr__words_unpack(const uint64_t *from, void *object)
{
    uint64_t mask = *from++;
    for (; mask; mask &= mask - 1)
        memcpy((char *)object + 8 * tahr__lowest_bit(mask), from++, 8);
    return from;
}

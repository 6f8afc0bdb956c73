/* SPDX-License-Identifier: MIT
 * words.c: compares words, and unpacks them by a mask. */
#include "words.h"

#if defined(__GNUC__) && defined(__x86_64__)
#include <immintrin.h>

#include "../common/avx2_begin.h"

static uint64_t same_4(const char *one, const char *other)
{
    const __m256i equal =
        _mm256_cmpeq_epi64(_mm256_load_si256((const void *)one), _mm256_loadu_si256((const void *)other));
    return (uint64_t)_mm256_movemask_pd(_mm256_castsi256_pd(equal));
}

static uint64_t same_16(const char *a, const char *b)
{
    return same_4(a, b) | same_4(a + 32, b + 32) << 4 | same_4(a + 64, b + 64) << 8 | same_4(a + 96, b + 96) << 12;
}

uint64_t tahr__words_differ_wide(const void *one, const void *other)
{
    const char *a = one, *b = other;
    return ~(same_16(a, b) | same_16(a + 128, b + 128) << 16 | same_16(a + 256, b + 256) << 32 |
             same_16(a + 384, b + 384) << 48);
}

#include "../common/avx2_end.h"
#else
uint64_t tahr__words_differ_wide(const void *one, const void *other)
{
    return tahr__words_differ(one, other);
}
#endif

#ifdef __SSE2__
#include <emmintrin.h>

/* one: aligned. */
static __m128i same(const char *one, const char *other)
{
    return _mm_cmpeq_epi32(_mm_load_si128((const void *)one), _mm_loadu_si128((const void *)other));
}

/* Of the 16 halves of 8 words, a bit each: which ones differ. */
static uint64_t halves_differ(const char *a, const char *b)
{
    const __m128i low = _mm_packs_epi32(same(a, b), same(a + 16, b + 16));
    const __m128i high = _mm_packs_epi32(same(a + 32, b + 32), same(a + 48, b + 48));
    return (uint64_t)(~_mm_movemask_epi8(_mm_packs_epi16(low, high)) & 0xFFFF);
}

/* Of 32 words, from a bit for each half: neighbours become one, and then the gaps between them are closed. */
static uint64_t bits_of_words(uint64_t halves)
{
    halves = (halves | halves >> 1) & 0x5555555555555555u;
    halves = (halves | halves >> 1) & 0x3333333333333333u;
    halves = (halves | halves >> 2) & 0x0F0F0F0F0F0F0F0Fu;
    halves = (halves | halves >> 4) & 0x00FF00FF00FF00FFu;
    halves = (halves | halves >> 8) & 0x0000FFFF0000FFFFu;
    return (halves | halves >> 16) & 0x00000000FFFFFFFFu;
}

/* Without a branch: which words change is another thing for every character, and nothing to be foreseen. */
static uint64_t differ_32(const char *a, const char *b)
{
    return bits_of_words(halves_differ(a, b) | halves_differ(a + 64, b + 64) << 16 |
                         halves_differ(a + 128, b + 128) << 32 | halves_differ(a + 192, b + 192) << 48);
}
#else
static uint64_t differ_32(const char *a, const char *b)
{
    uint64_t differ = 0;
    for (int i = 0; i < 32; i++)
        differ |= (uint64_t)(tahr__word_of(a, i) != tahr__word_of(b, i)) << i;
    return differ;
}
#endif

uint64_t tahr__words_differ(const void *one, const void *other)
{
    const char *a = one, *b = other;
    return differ_32(a, b) | differ_32(a + 256, b + 256) << 32;
}

const uint64_t *tahr__words_unpack(const uint64_t *from, void *object)
{
    uint64_t mask = *from++;
    for (; mask; mask &= mask - 1)
        memcpy((char *)object + 8 * tahr__lowest_bit(mask), from++, 8);
    return from;
}

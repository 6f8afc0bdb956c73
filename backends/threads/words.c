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

uint64_t tahr__words_differ(const void *one, const void *other)
{
    uint64_t differ = 0;
    for (int i = 0; i < 64; i++)
        differ |= (uint64_t)(tahr__word_of(one, i) != tahr__word_of(other, i)) << i;
    return differ;
}

const uint64_t *tahr__words_unpack(const uint64_t *from, void *object)
{
    uint64_t mask = *from++;
    for (; mask; mask &= mask - 1)
        memcpy((char *)object + 8 * tahr__lowest_bit(mask), from++, 8);
    return from;
}

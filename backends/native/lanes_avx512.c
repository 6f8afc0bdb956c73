/* SPDX-License-Identifier: MIT
 * lanes_avx512.c: the cull eight lanes at a time, which of them in a register of bits, and those that are kept written
 * at once. Only called where tahr__has_avx512 says so; without FMA, so that it does the operations of the scalar twin.
 * Sixteen lanes, of two blocks, were measured too: slower for fewer than a hundred primitives, no faster for more. */
#include "../common/processor.h"
#include "lanes.h"

#if defined(__GNUC__) && defined(__x86_64__)

#include "../common/avx512_begin.h"

#include "../common/lane_8.h"

typedef __mmask8 which;

static inline which no_more(lane a, lane b)
{
    return _mm256_cmp_ps_mask((__m256)a, (__m256)b, _CMP_LE_OQ);
}

static inline which more(lane a, lane b)
{
    return _mm256_cmp_ps_mask((__m256)a, (__m256)b, _CMP_GT_OQ);
}

static inline int any(which m)
{
    return m != 0;
}

static inline lane choose(which m, lane a, lane b)
{
    return (lane)_mm256_mask_blend_ps(m, (__m256)b, (__m256)a);
}

static inline lane only(which m, lane a)
{
    return (lane)_mm256_maskz_mov_ps(m, (__m256)a);
}

_Static_assert(sizeof(tahr__lanes_found) == 8 && offsetof(tahr__lanes_found, index) == 4, "written as one number");

/* Writes all eight of them, those that are kept first. */
static inline uint32_t keep(which near, lane value, uint32_t first, tahr__lanes_found *found)
{
    const __m512i numbers = _mm512_add_epi64(_mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0), _mm512_set1_epi64(first));
    const __m512i values = _mm512_cvtepu32_epi64(_mm256_castps_si256((__m256)value));
    const __m512i all = _mm512_or_si512(_mm512_slli_epi64(numbers, 32), values);
    _mm512_storeu_si512(found, _mm512_maskz_compress_epi64(near, all));
    return (uint32_t)__builtin_popcount(near);
}

#include "lanes_kernel.h"

#include "../common/avx2_end.h"

const tahr__lanes_way *tahr__lanes_of_avx512(void)
{
    static const tahr__lanes_way eight = {lanes_cull, lanes_near, lanes_measure, lanes_pick, "AVX-512"};
    return tahr__has_avx512() ? &eight : NULL;
}

#else

const tahr__lanes_way *tahr__lanes_of_avx512(void)
{
    return NULL;
}

#endif

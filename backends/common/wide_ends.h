/* SPDX-License-Identifier: MIT
 * wide_ends.h: where a box lies in a node, for a file that has asked for AVX2 or AVX-512. */

/* The ends of a box in steps of the node as bytes, which packing clamps: 0, 1, 2: up to where, 4, 5, 6: from where. 0:
 * it is beyond the node's steps. */
static inline int ends_of(const tahr__wide_node *n, const tahr__wide_box *box, __m128i *ends)
{
    const __m128i head = _mm_loadu_si128((const __m128i *)(const void *)n->base);
    const __m128i low = _mm_and_si128(head, _mm_set1_epi32(0xFFFFFF));
    const __m128i shift = _mm_and_si128(_mm_srli_epi32(head, 24), _mm_set1_epi32(31));
    const __m128i less = _mm_sub_epi32(_mm_sllv_epi32(_mm_set1_epi32(1), shift), _mm_set1_epi32(1));
    const __m128i lo = _mm_loadu_si128((const __m128i *)(const void *)box->lo);
    const __m128i hi = _mm_loadu_si128((const __m128i *)(const void *)box->hi);
    const __m128i to = _mm_srav_epi32(_mm_sub_epi32(hi, low), shift);
    const __m128i from = _mm_srav_epi32(_mm_add_epi32(_mm_sub_epi32(lo, low), less), shift);
    const __m128i out = _mm_or_si128(to, _mm_sub_epi32(_mm_set1_epi32(255), from));
    *ends = _mm_packus_epi16(_mm_packs_epi32(to, from), to);
    return !(_mm_movemask_ps(_mm_castsi128_ps(out)) & 7);
}

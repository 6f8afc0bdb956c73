/* SPDX-License-Identifier: MIT
 * lanes.c: the cull four lanes at a time and its scalar twin, and which to take. All do the same IEEE operations in the
 * same order, so they keep the same primitives. */
#include "lanes.h"

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

static float box_distance(const tahr__lanes *lanes, uint32_t i, const float lo[3], const float hi[3])
{
    float square[3];
    for (uint32_t a = 0; a < 3; a++) {
        float under = lanes->blocks[tahr__lane(i, TAHR__LANE_LOW + a)] - hi[a];
        float over = lo[a] - lanes->blocks[tahr__lane(i, TAHR__LANE_HIGH + a)];
        float gap = under > over ? under : over;
        gap = gap > 0 ? gap : 0;
        square[a] = gap * gap;
    }
    return (square[0] + square[1]) + square[2];
}

/* Does the plane stay out of reach, on one side all the way? */
static int beyond_plane(const tahr__lanes *lanes, uint32_t i, const tahr__lanes_query *q)
{
    const float *at = lanes->blocks + tahr__lane(i, TAHR__LANE_NORMAL);
    float x = at[0], y = at[TAHR__LANES], z = at[2 * TAHR__LANES], offset = at[3 * TAHR__LANES];
    float first = ((x * q->start[0] + y * q->start[1]) + z * q->start[2]) - offset;
    float last = first + ((x * q->motion[0] + y * q->motion[1]) + z * q->motion[2]);
    float extent = (z < 0 ? -z : z) * q->half + q->reach;
    return (first > extent && last > extent) || (first < -extent && last < -extent);
}

/* Does an edge keep it out of reach all the way? */
static int beside_edge(const tahr__lanes *lanes, uint32_t i, const tahr__lanes_query *q)
{
    const float *at = lanes->blocks + tahr__lane(i, TAHR__LANE_EDGE);
    int beside = 0;
    for (int k = 0; k < 3; k++, at += 3 * TAHR__LANES) {
        float x = at[0], y = at[TAHR__LANES];
        float first = (x * q->start[0] + y * q->start[1]) - at[2 * TAHR__LANES];
        float last = first + (x * q->motion[0] + y * q->motion[1]);
        beside |= first > q->reach && last > q->reach;
    }
    return beside;
}

uint32_t tahr__lanes_cull_1(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i++) {
        float d = box_distance(lanes, i, query->lo, query->hi);
        if (!(d <= query->limit) || beyond_plane(lanes, i, query) || beside_edge(lanes, i, query)) continue;
        index[kept++] = (uint16_t)i;
    }
    return kept;
}

#if defined(__GNUC__)

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

enum { WIDTH = 4 };

typedef float lane __attribute__((vector_size(16)));
typedef int32_t mask __attribute__((vector_size(16)));

static inline lane splat(float x)
{
    return (lane){x, x, x, x};
}

/* One bit per lane. */
static inline unsigned bits(mask m)
{
#if defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)m);
#else
    return (unsigned)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

/* a > b ? a : b; one instruction where the compiler does not see that by itself. */
static inline lane larger(lane a, lane b)
{
#if defined(__SSE2__)
    return (lane)_mm_max_ps((__m128)a, (__m128)b);
#else
    mask m = a > b;
    return (lane)(((mask)a & m) | ((mask)b & ~m));
#endif
}

#include "lanes_kernel.h"

uint32_t tahr__lanes_cull_4(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    return lanes_cull(lanes, query, index);
}

#else

uint32_t tahr__lanes_cull_4(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    return tahr__lanes_cull_1(lanes, query, index);
}

#endif

tahr__lanes_fn *tahr__lanes_best(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return tahr__lanes_cull_8;
#endif
    return tahr__lanes_cull_4;
}

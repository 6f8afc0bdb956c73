/* SPDX-License-Identifier: MIT
 * lanes.c: the cull in GCC vector types (SSE, NEON, wasm SIMD or plain code, by the compiler) and its scalar twin. Both do
 * the same IEEE operations in the same order, so they keep the same boxes. */
#include "lanes.h"

#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

static float box_distance(const tahr__lanes *lanes, uint32_t i, const float lo[3], const float hi[3])
{
    float square[3];
    for (int a = 0; a < 3; a++) {
        float under = lanes->lo[a][i] - hi[a], over = lo[a] - lanes->hi[a][i];
        float gap = under > over ? under : over;
        gap = gap > 0 ? gap : 0;
        square[a] = gap * gap;
    }
    return (square[0] + square[1]) + square[2];
}

uint32_t tahr__lanes_cull_scalar(const tahr__lanes *lanes, const float lo[3], const float hi[3], float limit, uint16_t *index,
                                 float *distance)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i++) {
        float d = box_distance(lanes, i, lo, hi);
        if (!(d <= limit)) continue;
        index[kept] = (uint16_t)i;
        distance[kept++] = d;
    }
    return kept;
}

#if defined(__GNUC__)

typedef float lane4 __attribute__((vector_size(16)));
typedef int32_t mask4 __attribute__((vector_size(16)));
typedef int64_t mask2 __attribute__((vector_size(16)));

static lane4 splat(float x)
{
    return (lane4){x, x, x, x};
}

/* a where mask is set, else b. */
static lane4 choose(mask4 mask, lane4 a, lane4 b)
{
    return (lane4)(((mask4)a & mask) | ((mask4)b & ~mask));
}

static lane4 square_gap(const float *lo, const float *hi, lane4 box_lo, lane4 box_hi)
{
    const lane4 zero = {0, 0, 0, 0};
    lane4 low, high;
    memcpy(&low, lo, sizeof low);
    memcpy(&high, hi, sizeof high);
    lane4 under = low - box_hi, over = box_lo - high;
    lane4 gap = choose(under > over, under, over);
    gap = choose(gap > zero, gap, zero);
    return gap * gap;
}

uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const float lo[3], const float hi[3], float limit, uint16_t *index,
                          float *distance)
{
    lane4 lo0 = splat(lo[0]), lo1 = splat(lo[1]), lo2 = splat(lo[2]);
    lane4 hi0 = splat(hi[0]), hi1 = splat(hi[1]), hi2 = splat(hi[2]), most = splat(limit);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i += 4) {
        lane4 x = square_gap(lanes->lo[0] + i, lanes->hi[0] + i, lo0, hi0);
        lane4 y = square_gap(lanes->lo[1] + i, lanes->hi[1] + i, lo1, hi1);
        lane4 z = square_gap(lanes->lo[2] + i, lanes->hi[2] + i, lo2, hi2);
        lane4 d = (x + y) + z;
        mask4 near = d <= most;
        mask2 any = (mask2)near;
        if (!(any[0] | any[1])) continue;
        for (uint32_t k = 0; k < 4 && i + k < lanes->count; k++) {
            if (!near[k]) continue;
            index[kept] = (uint16_t)(i + k);
            distance[kept++] = d[k];
        }
    }
    return kept;
}

#else

uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const float lo[3], const float hi[3], float limit, uint16_t *index,
                          float *distance)
{
    return tahr__lanes_cull_scalar(lanes, lo, hi, limit, index, distance);
}

#endif

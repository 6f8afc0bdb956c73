/* SPDX-License-Identifier: MIT
 * lanes.c: the cull in GCC vector types (SSE, NEON, wasm SIMD or plain code, by the compiler) and its scalar twin. Both do
 * the same IEEE operations in the same order, so they keep the same boxes. */
#include "lanes.h"

#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

float tahr__lanes_distance(const tahr__lanes *lanes, uint32_t i, const float lo[3], const float hi[3])
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

/* Does the plane stay out of reach, on one side all the way? */
static int beyond_plane(const tahr__lanes *lanes, uint32_t i, const tahr__lanes_query *q)
{
    float x = lanes->normal[0][i], y = lanes->normal[1][i], z = lanes->normal[2][i];
    float first = ((x * q->start[0] + y * q->start[1]) + z * q->start[2]) - lanes->offset[i];
    float last = first + ((x * q->motion[0] + y * q->motion[1]) + z * q->motion[2]);
    float extent = (z < 0 ? -z : z) * q->half + q->reach;
    return (first > extent && last > extent) || (first < -extent && last < -extent);
}

uint32_t tahr__lanes_cull_scalar(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i++) {
        float d = tahr__lanes_distance(lanes, i, query->lo, query->hi);
        if (!(d <= query->limit) || beyond_plane(lanes, i, query)) continue;
        index[kept++] = (uint16_t)i;
    }
    return kept;
}

#if defined(__GNUC__)

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

typedef float lane4 __attribute__((vector_size(16)));
typedef int32_t mask4 __attribute__((vector_size(16)));

static lane4 splat(float x)
{
    return (lane4){x, x, x, x};
}

static lane4 at(const float *p)
{
    lane4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

/* One bit per lane. */
static unsigned bits(mask4 mask)
{
#if defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)mask);
#else
    return (unsigned)((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}

/* a > b ? a : b; one instruction where the compiler does not see that by itself. */
static lane4 larger(lane4 a, lane4 b)
{
#if defined(__SSE2__)
    return (lane4)_mm_max_ps((__m128)a, (__m128)b);
#else
    mask4 mask = a > b;
    return (lane4)(((mask4)a & mask) | ((mask4)b & ~mask));
#endif
}

static lane4 square_gap(const float *lo, const float *hi, lane4 box_lo, lane4 box_hi)
{
    const lane4 zero = {0, 0, 0, 0};
    lane4 gap = larger(larger(at(lo) - box_hi, box_lo - at(hi)), zero);
    return gap * gap;
}

static mask4 beyond_planes(const tahr__lanes *lanes, uint32_t i, const tahr__lanes_query *q)
{
    lane4 x = at(lanes->normal[0] + i), y = at(lanes->normal[1] + i), z = at(lanes->normal[2] + i);
    lane4 first = ((x * splat(q->start[0]) + y * splat(q->start[1])) + z * splat(q->start[2])) - at(lanes->offset + i);
    lane4 last = first + ((x * splat(q->motion[0]) + y * splat(q->motion[1])) + z * splat(q->motion[2]));
    lane4 extent = larger(-z, z) * splat(q->half) + splat(q->reach);
    /* On one side of the plane both ends have the same sign, and the smaller distance is what counts. */
    lane4 low = -larger(-first, -last), high = larger(first, last);
    return (low > extent) | (high < -extent);
}

uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    lane4 lo0 = splat(query->lo[0]), lo1 = splat(query->lo[1]), lo2 = splat(query->lo[2]);
    lane4 hi0 = splat(query->hi[0]), hi1 = splat(query->hi[1]), hi2 = splat(query->hi[2]), most = splat(query->limit);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i += 4) {
        lane4 x = square_gap(lanes->lo[0] + i, lanes->hi[0] + i, lo0, hi0);
        lane4 y = square_gap(lanes->lo[1] + i, lanes->hi[1] + i, lo1, hi1);
        lane4 z = square_gap(lanes->lo[2] + i, lanes->hi[2] + i, lo2, hi2);
        lane4 d = (x + y) + z;
        unsigned near = bits(d <= most);
        if (!near) continue;
        near &= ~bits(beyond_planes(lanes, i, query));
        for (uint32_t k = 0; near && i + k < lanes->count; k++, near >>= 1) {
            if (!(near & 1)) continue;
            index[kept++] = (uint16_t)(i + k);
        }
    }
    return kept;
}

#else

uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    return tahr__lanes_cull_scalar(lanes, query, index);
}

#endif

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

uint32_t tahr__lanes_cull_scalar(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
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

static lane4 square_gap(const float *block, int axis, lane4 box_lo, lane4 box_hi)
{
    const lane4 zero = {0, 0, 0, 0};
    lane4 lo = at(block + (TAHR__LANE_LOW + axis) * TAHR__LANES), hi = at(block + (TAHR__LANE_HIGH + axis) * TAHR__LANES);
    lane4 gap = larger(larger(lo - box_hi, box_lo - hi), zero);
    return gap * gap;
}

static mask4 beyond_planes(const float *block, const tahr__lanes_query *q)
{
    const float *n = block + TAHR__LANE_NORMAL * TAHR__LANES;
    lane4 x = at(n), y = at(n + TAHR__LANES), z = at(n + 2 * TAHR__LANES), offset = at(n + 3 * TAHR__LANES);
    lane4 first = ((x * splat(q->start[0]) + y * splat(q->start[1])) + z * splat(q->start[2])) - offset;
    lane4 last = first + ((x * splat(q->motion[0]) + y * splat(q->motion[1])) + z * splat(q->motion[2]));
    lane4 extent = larger(-z, z) * splat(q->half) + splat(q->reach);
    /* On one side of the plane both ends have the same sign, and the smaller distance is what counts. */
    lane4 low = -larger(-first, -last), high = larger(first, last);
    return (low > extent) | (high < -extent);
}

static mask4 beside_edges(const float *block, const tahr__lanes_query *q)
{
    const float *e = block + TAHR__LANE_EDGE * TAHR__LANES;
    lane4 start_x = splat(q->start[0]), start_y = splat(q->start[1]), x_rate = splat(q->motion[0]),
          y_rate = splat(q->motion[1]);
    lane4 most = {0, 0, 0, 0};
    for (int k = 0; k < 3; k++, e += 3 * TAHR__LANES) {
        lane4 x = at(e), y = at(e + TAHR__LANES);
        lane4 first = (x * start_x + y * start_y) - at(e + 2 * TAHR__LANES);
        lane4 last = first + (x * x_rate + y * y_rate);
        most = larger(most, -larger(-first, -last));
    }
    return most > splat(q->reach);
}

uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    lane4 lo0 = splat(query->lo[0]), lo1 = splat(query->lo[1]), lo2 = splat(query->lo[2]);
    lane4 hi0 = splat(query->hi[0]), hi1 = splat(query->hi[1]), hi2 = splat(query->hi[2]), most = splat(query->limit);
    uint32_t kept = 0;
    const float *block = lanes->blocks;
    for (uint32_t i = 0; i < lanes->count; i += TAHR__LANES, block += TAHR__LANES * TAHR__LANE_ROWS) {
        lane4 x = square_gap(block, 0, lo0, hi0);
        lane4 y = square_gap(block, 1, lo1, hi1);
        lane4 z = square_gap(block, 2, lo2, hi2);
        lane4 d = (x + y) + z;
        unsigned near = bits(d <= most);
        if (!near) continue;
        near &= ~bits(beyond_planes(block, query));
        if (!near) continue;
        near &= ~bits(beside_edges(block, query));
        /* Unused lanes are far from everything. */
        while (near) {
            index[kept++] = (uint16_t)(i + (unsigned)__builtin_ctz(near));
            near &= near - 1;
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

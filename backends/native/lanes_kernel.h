/* SPDX-License-Identifier: MIT
 * lanes_kernel.h: the cull in GCC vector types, for a file that has said how wide they are: WIDTH, lane, mask, splat,
 * bits, larger. */
#include <string.h>

static inline lane at(const float *p)
{
    lane v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline lane square_gap(const float *block, int axis, lane box_lo, lane box_hi)
{
    lane lo = at(block + (TAHR__LANE_LOW + axis) * TAHR__LANES), hi = at(block + (TAHR__LANE_HIGH + axis) * TAHR__LANES);
    lane gap = larger(larger(lo - box_hi, box_lo - hi), splat(0));
    return gap * gap;
}

static inline mask beyond_planes(const float *block, const tahr__lanes_query *q)
{
    const float *n = block + TAHR__LANE_NORMAL * TAHR__LANES;
    lane x = at(n), y = at(n + TAHR__LANES), z = at(n + 2 * TAHR__LANES), offset = at(n + 3 * TAHR__LANES);
    lane first = ((x * splat(q->start[0]) + y * splat(q->start[1])) + z * splat(q->start[2])) - offset;
    lane last = first + ((x * splat(q->motion[0]) + y * splat(q->motion[1])) + z * splat(q->motion[2]));
    lane extent = larger(-z, z) * splat(q->half) + splat(q->reach);
    /* On one side of the plane both ends have the same sign, and the smaller distance is what counts. */
    lane low = -larger(-first, -last), high = larger(first, last);
    return (low > extent) | (high < -extent);
}

static inline mask beside_edges(const float *block, const tahr__lanes_query *q)
{
    const float *e = block + TAHR__LANE_EDGE * TAHR__LANES;
    lane start_x = splat(q->start[0]), start_y = splat(q->start[1]), x_rate = splat(q->motion[0]),
         y_rate = splat(q->motion[1]), most = splat(0);
    for (int k = 0; k < 3; k++, e += 3 * TAHR__LANES) {
        lane x = at(e), y = at(e + TAHR__LANES);
        lane first = (x * start_x + y * start_y) - at(e + 2 * TAHR__LANES);
        lane last = first + (x * x_rate + y * y_rate);
        most = larger(most, -larger(-first, -last));
    }
    return most > splat(q->reach);
}

static inline uint32_t lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index)
{
    lane lo0 = splat(query->lo[0]), lo1 = splat(query->lo[1]), lo2 = splat(query->lo[2]);
    lane hi0 = splat(query->hi[0]), hi1 = splat(query->hi[1]), hi2 = splat(query->hi[2]), most = splat(query->limit);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i += WIDTH) {
        const float *block = lanes->blocks + tahr__lane(i, 0);
        lane x = square_gap(block, 0, lo0, hi0);
        lane y = square_gap(block, 1, lo1, hi1);
        lane z = square_gap(block, 2, lo2, hi2);
        lane d = (x + y) + z;
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

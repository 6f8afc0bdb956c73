/* SPDX-License-Identifier: MIT
 * lanes_kernel.h: the cull in GCC vector types, for a file that has said how wide they are: WIDTH, lane, mask, splat,
 * bits, larger, root. */
#include <string.h>

static inline lane at(const float *p)
{
    lane v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline lane square_gap(const float *block, int axis, lane box_lo, lane box_hi)
{
    lane lo = at(block + (TAHR__LANE_LOW + axis) * TAHR__LANES),
         hi = at(block + (TAHR__LANE_HIGH + axis) * TAHR__LANES);
    lane gap = larger(larger(lo - box_hi, box_lo - hi), splat(0));
    return gap * gap;
}

/* m ? a : b */
static inline lane choose(mask m, lane a, lane b)
{
    return (lane)(((mask)a & m) | ((mask)b & ~m));
}

static inline lane along(const float *row, const float v[3])
{
    return (at(row) * splat(v[0]) + at(row + TAHR__LANES) * splat(v[1])) + at(row + 2 * TAHR__LANES) * splat(v[2]);
}

/* As time_within of the scalar twin; near loses what stays out of reach. */
static inline lane times_within(const float *block, const tahr__lanes_query *q, mask *near)
{
    const float *n = block + TAHR__LANE_NORMAL * TAHR__LANES, *e = block + TAHR__LANE_EDGE * TAHR__LANES;
    lane zero = splat(0), half = splat(q->half), z = at(n + 2 * TAHR__LANES);
    lane height = along(n, q->start) - at(n + 3 * TAHR__LANES);
    lane h = larger(larger(-height, height) - larger(-z, z) * half, zero);
    lane h_rate = along(n, q->motion), o = zero, o_rate = zero;
    mask below = at(block + (TAHR__LANE_HIGH + 2) * TAHR__LANES) <= splat(q->lowest);
    h_rate = choose(height < zero, -h_rate, h_rate);
    for (int k = 0; k < 3; k++, e += 4 * TAHR__LANES) {
        z = at(e + 2 * TAHR__LANES);
        lane out = along(e, q->start) - at(e + 3 * TAHR__LANES);
        out = out - choose(below, z, larger(-z, z)) * half;
        o_rate = choose(out > o, along(e, q->motion), o_rate);
        o = larger(out, o);
    }
    lane away2 = h * h + o * o, gap = away2 - splat(q->reach) * root(away2), closing = -(h * h_rate + o * o_rate);
    mask later = gap > zero;
    *near &= ~later | (gap <= closing);
    return (lane)((mask)(gap / closing) & later);
}

static inline uint32_t lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    lane lo0 = splat(query->lo[0]), lo1 = splat(query->lo[1]), lo2 = splat(query->lo[2]);
    lane hi0 = splat(query->hi[0]), hi1 = splat(query->hi[1]), hi2 = splat(query->hi[2]), most = splat(query->limit);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i += WIDTH) {
        const float *block = lanes->blocks + tahr__lane(i, 0);
        lane x = square_gap(block, 0, lo0, hi0);
        lane y = square_gap(block, 1, lo1, hi1);
        lane z = square_gap(block, 2, lo2, hi2);
        mask near = (x + y) + z <= most; /* unused lanes are far from everything */
        if (!bits(near)) continue;
        lane time = times_within(block, query, &near);
        for (unsigned left = bits(near); left; left &= left - 1) {
            unsigned k = (unsigned)__builtin_ctz(left);
            found[kept++] = (tahr__lanes_found){time[k], i + k};
        }
    }
    return kept;
}

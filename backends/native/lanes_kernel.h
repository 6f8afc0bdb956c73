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

/* As over_of and beside_of of the scalar twin. */
typedef struct besides {
    lane h, o, h_rate, o_rate;
} besides;

static inline besides over_of(const float *block, const tahr__lanes_query *q)
{
    const float *n = block + TAHR__LANE_NORMAL * TAHR__LANES;
    lane zero = splat(0), z = at(n + 2 * TAHR__LANES);
    lane height = along(n, q->start) - at(n + 3 * TAHR__LANES), h_rate = along(n, q->motion);
    lane h = larger(larger(-height, height) - larger(-z, z) * splat(q->half), zero);
    return (besides){h, zero, choose(height < zero, -h_rate, h_rate), zero};
}

static inline void add_beside(const float *block, const tahr__lanes_query *q, besides *b)
{
    const float *e = block + TAHR__LANE_EDGE * TAHR__LANES;
    lane half = splat(q->half);
    mask below = at(block + (TAHR__LANE_HIGH + 2) * TAHR__LANES) <= splat(q->lowest);
    for (int k = 0; k < 3; k++, e += 4 * TAHR__LANES) {
        lane z = at(e + 2 * TAHR__LANES), out = along(e, q->start) - at(e + 3 * TAHR__LANES);
        out = out - choose(below, z, larger(-z, z)) * half;
        b->o_rate = choose(out > b->o, along(e, q->motion), b->o_rate);
        b->o = larger(out, b->o);
    }
}

static inline besides besides_of(const float *block, const tahr__lanes_query *q)
{
    besides b = over_of(block, q);
    add_beside(block, q, &b);
    return b;
}

/* As time_within of the scalar twin; near loses what stays out of reach. */
static inline lane times_within(const besides *b, float reach, mask *near)
{
    lane away2 = b->h * b->h + b->o * b->o, gap = away2 - splat(reach) * root(away2);
    lane closing = -(b->h * b->h_rate + b->o * b->o_rate);
    mask later = gap > splat(0);
    *near &= ~later | (gap <= closing);
    return (lane)((mask)(gap / closing) & later);
}

static inline uint32_t keep(mask near, lane value, uint32_t first, tahr__lanes_found *found)
{
    uint32_t kept = 0;
    for (unsigned left = bits(near); left; left &= left - 1) {
        unsigned k = (unsigned)__builtin_ctz(left);
        found[kept++] = (tahr__lanes_found){value[k], first + k};
    }
    return kept;
}

/* The query's box in every lane. */
typedef struct box_lanes {
    lane lo[3], hi[3], most;
} box_lanes;

static inline box_lanes box_lanes_of(const tahr__lanes_query *q)
{
    return (box_lanes){{splat(q->lo[0]), splat(q->lo[1]), splat(q->lo[2])},
                       {splat(q->hi[0]), splat(q->hi[1]), splat(q->hi[2])},
                       splat(q->limit)};
}

/* Squared distances of the boxes of a block; unused lanes are far from everything. */
static inline lane square_gaps(const float *block, const box_lanes *b)
{
    lane x = square_gap(block, 0, b->lo[0], b->hi[0]);
    lane y = square_gap(block, 1, b->lo[1], b->hi[1]);
    lane z = square_gap(block, 2, b->lo[2], b->hi[2]);
    return (x + y) + z;
}

static uint32_t lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    const box_lanes box = box_lanes_of(query);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i += WIDTH) {
        const float *block = lanes->blocks + tahr__lane(i, 0);
        mask near = square_gaps(block, &box) <= box.most;
        if (!bits(near)) continue;
        besides b = over_of(block, query);
        near &= (b.h <= splat(query->reach)) | (b.h + b.h_rate <= splat(query->reach));
        if (!bits(near)) continue;
        add_beside(block, query, &b);
        lane time = times_within(&b, query->reach, &near);
        kept += keep(near, time, i, found + kept);
    }
    return kept;
}

static void lanes_measure(const tahr__lanes *lanes, const tahr__lanes_query *query, float *far)
{
    const box_lanes box = box_lanes_of(query);
    const uint32_t whole = (lanes->count + TAHR__LANES - 1) / TAHR__LANES * TAHR__LANES;
    for (uint32_t i = 0; i < whole; i += WIDTH) {
        const float *block = lanes->blocks + tahr__lane(i, 0);
        lane away2 = square_gaps(block, &box);
        mask near = away2 <= box.most;
        if (bits(near)) {
            const besides b = besides_of(block, query);
            away2 = choose(near, larger(b.h * b.h + b.o * b.o, away2), away2);
        }
        const lane away = root(away2);
        memcpy(far + i, &away, sizeof away);
    }
}

static uint32_t lanes_pick(const float *far, const float *lift, uint32_t count, float most, tahr__lanes_found *found)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i += WIDTH) {
        const lane away = lift ? at(far + i) + at(lift + i) : at(far + i);
        kept += keep(away <= splat(most), away, i, found + kept);
    }
    return kept;
}

static uint32_t lanes_near(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    const box_lanes box = box_lanes_of(query);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i += WIDTH) {
        const float *block = lanes->blocks + tahr__lane(i, 0);
        lane box2 = square_gaps(block, &box);
        mask near = box2 <= box.most;
        if (!bits(near)) continue;
        const besides b = besides_of(block, query);
        lane away = root(larger(b.h * b.h + b.o * b.o, box2));
        kept += keep(near & (away <= splat(query->reach)), away, i, found + kept);
    }
    return kept;
}

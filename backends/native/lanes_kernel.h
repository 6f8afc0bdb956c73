/* SPDX-License-Identifier: MIT
 * lanes_kernel.h: the cull in GCC vector types, for a file that has said how wide they are (WIDTH, lane, splat, larger,
 * root) and how it is told which lanes (lanes_which.h: which, no_more, more, any, choose, only, keep). */
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
    return (besides){h, zero, choose(more(zero, height), -h_rate, h_rate), zero};
}

static inline void add_beside(const float *block, const tahr__lanes_query *q, besides *b)
{
    const float *e = block + TAHR__LANE_EDGE * TAHR__LANES;
    lane half = splat(q->half);
    which below = no_more(at(block + (TAHR__LANE_HIGH + 2) * TAHR__LANES), splat(q->lowest));
    for (int k = 0; k < 3; k++, e += 4 * TAHR__LANES) {
        lane z = at(e + 2 * TAHR__LANES), out = along(e, q->start) - at(e + 3 * TAHR__LANES);
        out = out - choose(below, z, larger(-z, z)) * half;
        b->o_rate = choose(more(out, b->o), along(e, q->motion), b->o_rate);
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
static inline lane times_within(const besides *b, float reach, which *near)
{
    lane away2 = b->h * b->h + b->o * b->o, gap = away2 - splat(reach) * root(away2);
    lane closing = -(b->h * b->h_rate + b->o * b->o_rate);
    which later = more(gap, splat(0));
    *near = (which)(*near & (~later | no_more(gap, closing)));
    return only(later, gap / closing);
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
        which near = no_more(square_gaps(block, &box), box.most);
        if (!any(near)) continue;
        besides b = over_of(block, query);
        near &= no_more(b.h, splat(query->reach)) | no_more(b.h + b.h_rate, splat(query->reach));
        if (!any(near)) continue;
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
        which near = no_more(away2, box.most);
        if (any(near)) {
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
        kept += keep(no_more(away, splat(most)), away, i, found + kept);
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
        which near = no_more(box2, box.most);
        if (!any(near)) continue;
        const besides b = besides_of(block, query);
        lane away = root(larger(b.h * b.h + b.o * b.o, box2));
        kept += keep(near & no_more(away, splat(query->reach)), away, i, found + kept);
    }
    return kept;
}

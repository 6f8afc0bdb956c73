/* SPDX-License-Identifier: MIT
 * lanes.h: culling cached primitives eight or four at a time, and one at a time with the same bits. */
#ifndef TAHR_NATIVE_LANES_H
#define TAHR_NATIVE_LANES_H

#include "../common/core.h"

/* What single precision may be off by over the 32 m in which triangles have planes, four times (m): a query adds it to
 * its reach. */
#define TAHR__LANE_SLACK 4e-5

/* What is called unit in lanes is so within single precision: a distance is off by as small a part of itself. */
static inline double tahr__lanes_scale(double square)
{
    return (double)(1.0f / sqrtf((float)square));
}

/* Square of twice the area (m4) below which the direction of a triangle may be rounding. */
#define TAHR__LANE_AREA2 1e-12

/* Blocks of eight primitives, each 22 rows of eight floats: low corner, high corner, plane normal . x = offset, and the
 * planes through the three edges across it, x, y, z, offset each, outward and unit (all zero: none). The lanes of the
 * last block that are not in use lie at 1e30. */
enum {
    TAHR__LANES = 8,
    TAHR__LANE_LOW = 0,
    TAHR__LANE_HIGH = 3,
    TAHR__LANE_NORMAL = 6,
    TAHR__LANE_OFFSET = 9,
    TAHR__LANE_EDGE = 10,
    TAHR__LANE_ROWS = 22
};

typedef struct tahr__lanes {
    const float *blocks;
    uint32_t count;
} tahr__lanes;

/* Where a row of primitive i is. */
static inline uint32_t tahr__lane(uint32_t i, uint32_t row)
{
    return (i / TAHR__LANES * TAHR__LANE_ROWS + row) * TAHR__LANES + i % TAHR__LANES;
}

/* Writes primitive i: its box and the planes of its triangle. facet NULL: it has none that could be trusted. */
void tahr__lanes_put(float *blocks, uint32_t i, const tahr_bounds *box, const tahr__facet *facet);
/* Fills the rest of the last block. */
void tahr__lanes_end(float *blocks, uint32_t count);

/* What is looked for: boxes whose squared distance to [lo, hi] is at most limit, and whose plane and farthest edge do
 * not keep them out of reach of an upright segment of half length half that moves from start by motion. */
typedef struct tahr__lanes_query {
    float lo[3], hi[3], limit;
    float start[3], motion[3], half, reach;
    float lowest; /* that the segment comes */
} tahr__lanes_query;

/* Of an upright segment at rest: what is no farther than reach. */
static inline tahr__lanes_query tahr__lanes_at(tahr_vec3 p, double half, double reach)
{
    double more = reach + TAHR__LANE_SLACK;
    return (tahr__lanes_query){.lo = {d_down(p.x), d_down(p.y), d_down(p.z - half)},
                               .hi = {d_up(p.x), d_up(p.y), d_up(p.z + half)},
                               .limit = d_up(more * more * (1 + 1e-5)),
                               .start = {(float)p.x, (float)p.y, (float)p.z},
                               .half = (float)half,
                               .reach = (float)more,
                               .lowest = d_down(p.z - half)};
}

/* One of them, and the fraction of the motion before which it is out of reach. */
typedef struct tahr__lanes_found {
    float time;
    uint32_t index;
} tahr__lanes_found;

/* Writes all of them, in order, and returns how many. found: room for whole blocks. */
typedef uint32_t tahr__lanes_fn(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found);

/* Distances (m), one a primitive, whole blocks of them. */
typedef void tahr__lanes_measure_fn(const tahr__lanes *lanes, const tahr__lanes_query *query, float *far);
typedef uint32_t tahr__lanes_pick_fn(const float *far, const float *lift, uint32_t count, float most,
                                     tahr__lanes_found *found);

/* cull, as above. near: of a segment at rest, whatever motion says; time: the distance (m) that box, plane and edges
 * keep the primitive off it, within TAHR__LANE_SLACK. measure: that distance of all, by the box alone where that is
 * beyond the limit. pick: those of no more than most, after lift has been added, if it is not NULL. */
typedef struct tahr__lanes_way {
    tahr__lanes_fn *cull, *near;
    tahr__lanes_measure_fn *measure;
    tahr__lanes_pick_fn *pick;
    const char *name;
} tahr__lanes_way;

/* The scalar twin; four lanes by the vectors of the compiler; eight with AVX2; eight with AVX-512. */
enum { TAHR__LANES_SCALAR, TAHR__LANES_FOUR, TAHR__LANES_AVX2, TAHR__LANES_AVX512, TAHR__LANES_WAYS };
/* NULL: not here. */
const tahr__lanes_way *tahr__lanes_of(uint32_t way);
/* lanes_avx2.c, lanes_avx512.c */
const tahr__lanes_way *tahr__lanes_of_avx2(void);
const tahr__lanes_way *tahr__lanes_of_avx512(void);

/* The fastest that this machine can run; or the scalar twin. */
const tahr__lanes_way *tahr__lanes_best(uint32_t no_simd);

#endif

/* SPDX-License-Identifier: MIT
 * lanes.h: culling cached primitives eight or four at a time, and one at a time with the same bits. */
#ifndef TAHR_NATIVE_LANES_H
#define TAHR_NATIVE_LANES_H

#include <stdint.h>

/* Blocks of eight primitives, each 19 rows of eight floats: low corner, high corner, plane normal . x = offset, and the
 * upright planes through the three edges, x, y, offset each, outward and unit (all zero: none). The lanes of the last
 * block that are not in use lie at 1e30. */
enum {
    TAHR__LANES = 8,
    TAHR__LANE_LOW = 0,
    TAHR__LANE_HIGH = 3,
    TAHR__LANE_NORMAL = 6,
    TAHR__LANE_OFFSET = 9,
    TAHR__LANE_EDGE = 10,
    TAHR__LANE_ROWS = 19
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

/* What is looked for: boxes whose squared distance to [lo, hi] is at most limit, and whose planes come within reach of
 * an upright segment of half length half that moves from start by motion. */
typedef struct tahr__lanes_query {
    float lo[3], hi[3], limit;
    float start[3], motion[3], half, reach;
} tahr__lanes_query;

/* Writes their indices, in order, and returns how many. */
typedef uint32_t tahr__lanes_fn(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index);

/* The scalar twin; four lanes, which every machine has by its compiler's vectors; eight, where the processor has AVX2. */
tahr__lanes_fn tahr__lanes_cull_1, tahr__lanes_cull_4, tahr__lanes_cull_8;

/* The fastest that this machine can run. */
tahr__lanes_fn *tahr__lanes_best(void);

#endif

/* SPDX-License-Identifier: MIT
 * lanes.h: culling cached primitives four at a time, and one at a time with the same bits. */
#ifndef TAHR_NATIVE_LANES_H
#define TAHR_NATIVE_LANES_H

#include <stdint.h>

/* Blocks of four primitives, each 19 rows of four floats: low corner, high corner, plane normal . x = offset, and the
 * upright planes through the three edges, x, y, offset each, outward and unit (all zero: none). The lanes of the last
 * block that are not in use lie at 1e30. */
enum {
    TAHR__LANES = 4,
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

/* Their indices, in order. Returns how many. */
uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index);
/* The scalar twin. */
uint32_t tahr__lanes_cull_scalar(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index);

#endif

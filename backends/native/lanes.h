/* SPDX-License-Identifier: MIT
 * lanes.h: culling cached primitives four at a time, and one at a time with the same bits. */
#ifndef TAHR_NATIVE_LANES_H
#define TAHR_NATIVE_LANES_H

#include <stdint.h>

/* Ten arrays of floats, 16-byte aligned, each a multiple of four long: bounds, and planes normal . x = offset (all zero:
 * none). Unused boxes lie at 1e30. */
typedef struct tahr__lanes {
    const float *lo[3], *hi[3];
    const float *normal[3], *offset;
    uint32_t count;
} tahr__lanes;

/* What is looked for: boxes whose squared distance to [lo, hi] is at most limit, and whose plane comes within reach of an
 * upright segment of half length half that moves from start by motion. */
typedef struct tahr__lanes_query {
    float lo[3], hi[3], limit;
    float start[3], motion[3], half, reach;
} tahr__lanes_query;

/* Their indices, in order. Returns how many. */
uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index);
/* The scalar twin. */
uint32_t tahr__lanes_cull_scalar(const tahr__lanes *lanes, const tahr__lanes_query *query, uint16_t *index);

/* Squared distance of one box; the same operations. */
float tahr__lanes_distance(const tahr__lanes *lanes, uint32_t i, const float lo[3], const float hi[3]);

#endif

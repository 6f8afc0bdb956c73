/* SPDX-License-Identifier: MIT
 * lanes.h: culling boxes four at a time, and one at a time with the same bits. */
#ifndef TAHR_NATIVE_LANES_H
#define TAHR_NATIVE_LANES_H

#include <stdint.h>

/* Six arrays of floats, 16-byte aligned, each a multiple of four long; unused boxes lie at 1e30. */
typedef struct tahr__lanes {
    const float *lo[3], *hi[3];
    uint32_t count;
} tahr__lanes;

/* Indices of all boxes whose squared distance to [lo, hi] is at most limit, in order. distance[k] is that of index[k]. */
uint32_t tahr__lanes_cull(const tahr__lanes *lanes, const float lo[3], const float hi[3], float limit, uint16_t *index,
                          float *distance);
/* The scalar twin. */
uint32_t tahr__lanes_cull_scalar(const tahr__lanes *lanes, const float lo[3], const float hi[3], float limit, uint16_t *index,
                                 float *distance);

#endif

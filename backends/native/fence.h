/* SPDX-License-Identifier: MIT
 * fence.h: planes between a place and the primitives nearest to it. Who goes along a wall comes no nearer to it, however
 * far that is: a fence tells, where a distance does not. */
#ifndef TAHR_NATIVE_FENCE_H
#define TAHR_NATIVE_FENCE_H

#include "scene.h"

/* Puts the fence of a primitive of the lanes, seen from an upright segment at rest; index TAHR__NONE: none. 0: the
 * segment is not apart from it, and there is none. */
int tahr__fences_put(tahr__fences *fences, uint32_t i, const float *blocks, uint32_t index,
                     const tahr__lanes_query *at);

/* Is an upright segment farther than reach (m) from all that is fenced off? */
static inline int tahr__fences_hold(const tahr__fences *fences, tahr_vec3 p, double half, double reach)
{
    const float x = (float)p.x, y = (float)p.y, z = (float)p.z, h = (float)half,
                most = (float)(reach + TAHR__LANE_SLACK);
    int beyond = 1;
    for (int i = 0; i < TAHR__FENCES; i++) {
        const float lean = fences->z[i], down = fabsf(lean) * h;
        beyond &= ((fences->x[i] * x + fences->y[i] * y) + lean * z) - down - fences->far[i] > most;
    }
    return beyond;
}

#endif

/* SPDX-License-Identifier: MIT
 * fence.h: planes between a place and the primitives nearest to it. Who goes along a wall comes no nearer to it,
 * however far that is: a fence tells, where a distance does not. */
#ifndef TAHR_NATIVE_FENCE_H
#define TAHR_NATIVE_FENCE_H

#include "scene.h"

/* There are none. */
void tahr__fences_clear(tahr__fences *fences);
/* Puts the fence of a primitive, seen from an upright segment at rest. 0: that is not apart from it, and there is
 * none. */
int tahr__fences_put(tahr__fences *fences, uint32_t i, const tahr__lanes *lanes, uint32_t index,
                     const tahr__lanes_query *at);

/* How far an upright segment, from z up to top, is from what is behind a fence, at least (m). */
static inline float tahr__fence_off(const tahr__fences *f, int i, float x, float y, float z, float top)
{
    const float low = f->z[i] * z, high = f->z[i] * top;
    return ((f->x[i] * x + f->y[i] * y) + (low < high ? low : high)) - f->far[i];
}

/* Is it farther than reach (m) from all that is fenced off? p: its lower end. */
static inline int tahr__fences_hold(const tahr__fences *fences, tahr_vec3 p, double top, double reach)
{
    const float x = (float)p.x, y = (float)p.y, z = (float)p.z, high = (float)top,
                most = (float)(reach + TAHR__LANE_SLACK);
    int beyond = 1;
    for (int i = 0; i < TAHR__FENCES; i++)
        beyond &= tahr__fence_off(fences, i, x, y, z, high) > most;
    return beyond;
}

/* From what it is not, a bit each. */
uint32_t tahr__fences_fail(const tahr__fences *fences, tahr_vec3 p, double top, double reach);

#endif

/* SPDX-License-Identifier: MIT
 * one_way.h: when a body with TAHR_BODY_ONE_WAY is there. The same rule as tahr_one_way_blocks: backends never link
 * libtahr. */
#ifndef TAHR_COMMON_ONE_WAY_H
#define TAHR_COMMON_ONE_WAY_H

#include "vec.h"

/* cos 60 degrees: what leans more is its side or its bottom. */
#define TAHR__ONE_WAY_TOP 0.5

/* distance: signed, where the question begins; normal: the contact normal; flags, margin: those of a sweep. */
static inline int tahr__one_way_blocks(tahr_vec3 up, tahr_vec3 normal, double distance, double margin, uint32_t flags)
{
    int dropped = (flags & TAHR_SWEEP_DROP) && distance <= 2 * margin;
    return distance >= 0 && v_dot(up, normal) >= TAHR__ONE_WAY_TOP && !dropped;
}

#endif

/* SPDX-License-Identifier: MIT
 * core_box.h: exact distance between a point or segment core and a box. */
#ifndef TAHR_COMMON_CORE_BOX_H
#define TAHR_COMMON_CORE_BOX_H

#include "core.h"

typedef struct tahr__box {
    tahr_vec3 middle, half; /* half > 0 */
    const tahr__mat *turn;  /* its frame to that of middle; NULL: the same axes */
} tahr__box;

/* core (0 or 1 axes) at centre against the box. [out] point on the box; distance 0: they touch or overlap, and normal
 * is not set. Of a segment along a face the first of the nearest points is taken. */
void tahr__core_box(const tahr__core *core, tahr_vec3 centre, const tahr__box *box, tahr__witness *out);

#endif

/* SPDX-License-Identifier: MIT
 * lip.h: the front of a step that is too steep to stand on: bevelled, rounded, or marked as never walkable. */
#ifndef TAHR_LIP_H
#define TAHR_LIP_H

#include "core.h"

/* m, of a height that is compared with the step height. */
#define TAHR__HEIGHT_ROUNDING 1e-6

/* Is there a floor behind the unwalkable face of a hit, no lower than the hit and no higher than a step above `base`
 * (m, along up)? 1 or 2 rays. */
int tahr__tread_behind(tahr__step *step, const tahr_hit *hit, double base);

/* Is the unwalkable face of a hit the front of a step, with a floor before it and one behind it? At most 4 rays. */
int tahr__is_lip(tahr__step *step, const tahr_hit *hit);

#endif

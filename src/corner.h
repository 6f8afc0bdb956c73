/* SPDX-License-Identifier: MIT
 * corner.h: a jump that grazes the corner of a ceiling goes past it. */
#ifndef TAHR_CORNER_H
#define TAHR_CORNER_H

#include "core.h"

/* Moves a rising character aside, by the least that clears what its head has hit and by no more than
 * config.corner_correction. Returns 0, where it was, if that is not enough or not free. The velocity stays. [out]
 * aside: the level direction that it was moved in. 3 sweeps for a round head at an edge, at most 12 for a box. */
int tahr__clear_corner(tahr__step *step, const tahr_hit *hit, vec3 *aside);

/* Whether who was moved aside goes, or wishes to go, back to where it came from. */
int tahr__returns_to_corner(const tahr__step *step, vec3 aside);

#endif

/* SPDX-License-Identifier: MIT
 * ledge.h: where a floor ends, and staying on it. */
#ifndef TAHR_LEDGE_H
#define TAHR_LEDGE_H

#include "path.h"

/* Where on the last straight piece of the path, which ends at `to`, the floor ended: [out] the parts of the piece at
 * which the character still stands and already falls. Moves the state's position. 20 times a floor. */
void tahr__floor_end(tahr__step *step, const tahr__path *w, vec3 to, double *inside, double *outside);

/* For characters that may not walk off ledges: stops at the edge that the path has crossed and goes on along it; at
 * most two edges in a slice (a corner of a plateau), then stands. */
void tahr__stay_on_ledge(tahr__step *step, tahr__path *w);

#endif

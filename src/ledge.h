/* SPDX-License-Identifier: MIT
 * ledge.h: staying on a floor that ends. */
#ifndef TAHR_LEDGE_H
#define TAHR_LEDGE_H

#include "path.h"

/* For characters that may not walk off ledges: stops at the edge that the path has crossed and goes on along it; at
 * most two edges in a slice (a corner of a plateau), then stands. beyond: the floor
 * that was found at the end of the path, which does not hold. */
void tahr__stay_on_ledge(tahr__step *step, tahr__path *w, const tahr_floor *beyond);

#endif

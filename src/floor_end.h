/* SPDX-License-Identifier: MIT
 * floor_end.h: where on a way a floor ends. */
#ifndef TAHR_FLOOR_END_H
#define TAHR_FLOOR_END_H

#include "path.h"

/* Where on the last straight piece of a path, which ends at the state's position, the floor ended. */
typedef struct tahr__floor_border {
    double inside, outside; /* parts of the piece at which the character still stands and already falls */
    tahr_floor floor;       /* at `inside` */
} tahr__floor_border;

/* Finds it; beyond: the floor that was found at the end of the piece, which does not hold. Between inside and outside
 * lies no more than 2^-20 of the piece or 7e-9 half widths of the character (2e-9 m), whichever is more; at a straight
 * edge mostly the latter, on a backend that is that exact. Moves the state to `inside`; border->floor was looked at
 * there, and does not hold if the piece had none anywhere. At a straight edge mostly 2 floors, at most 25. */
void tahr__floor_end(tahr__step *step, const tahr__path *w, const tahr_floor *beyond, tahr__floor_border *border);

#endif

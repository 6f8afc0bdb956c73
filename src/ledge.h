/* SPDX-License-Identifier: MIT
 * ledge.h: where a floor ends, and staying on it. */
#ifndef TAHR_LEDGE_H
#define TAHR_LEDGE_H

#include "path.h"

/* Where on the last straight piece of a path, which ends at the state's position, the floor ended. */
typedef struct tahr__ledge {
    double inside, outside; /* parts of the piece at which the character still stands and already falls */
    tahr_floor floor;       /* at `inside` */
} tahr__ledge;

/* Finds it; beyond: the floor that was found at the end of the piece, which does not hold. Between inside and outside
 * lies no more than 2^-20 of the piece, at a straight edge 2e-9 m on a backend that is that exact. Moves the state to
 * `inside`; there end->floor was looked at, and it does not hold if the piece had none anywhere. At a straight edge
 * mostly 2 floors, at most 23. */
void tahr__floor_end(tahr__step *step, const tahr__path *w, const tahr_floor *beyond, tahr__ledge *end);

/* For characters that may not walk off ledges: stops at the edge that the path has crossed and goes on along it; at
 * most two edges in a slice (a corner of a plateau), then stands. beyond: as above. */
void tahr__stay_on_ledge(tahr__step *step, tahr__path *w, const tahr_floor *beyond);

#endif

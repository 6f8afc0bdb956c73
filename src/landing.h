/* SPDX-License-Identifier: MIT
 * landing.h: what a fall may end on, with config.slide_solver TWO_WALLS. */
#ifndef TAHR_LANDING_H
#define TAHR_LANDING_H

#include "floor.h"

/* IsValidLandingSpot: was the lower end of the shape, well inside its rim, swept onto something walkable, and is that a
 * floor? 0 to 6 queries. */
int tahr__is_valid_landing_spot(tahr__step *step, const tahr__swept *swept);

/* ShouldCheckForValidLandingSpot: was an edge met from above, so that a look straight down may still find a floor? No
 * query. */
int tahr__should_check_landing_spot(const tahr__step *step, const tahr_hit *hit);

/* Such a look: a floor, and a valid spot. 1 to 6 queries. */
int tahr__finds_landing_spot(tahr__step *step);

/* ProcessLanded: walks from here on, on the floor that is found and at its height. hit: what was landed on. 1 to 6
 * queries and a safe move. */
void tahr__process_landed(tahr__step *step, const tahr_hit *hit);

#endif

/* SPDX-License-Identifier: MIT
 * sleep.h: a step that left everything as it was is not computed again. */
#ifndef TAHR_SLEEP_H
#define TAHR_SLEEP_H

#include "core.h"

/* Would a step with these arguments repeat the one that was noted? */
int tahr__sleeps_on(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                    const tahr_report *report);

/* What a step reports that was not computed: all that the noted one did but queries. */
void tahr__sleep_report(const tahr_mover *mover, tahr_report *report);

/* Notes a step that changed no bit of the state; forgets the last one after any other. state: as it is now; changed: is
 * it another one than before the step? */
void tahr__sleep_note(tahr_mover *mover, const tahr__step *step, double dt, const tahr_state *state, int changed);

#endif

/* SPDX-License-Identifier: MIT
 * sleep.h: a step that left everything as it was is not computed again. */
#ifndef TAHR_SLEEP_H
#define TAHR_SLEEP_H

#include "core.h"

/* tahr_mover_step for who does not sleep; checks all that it is given. */
tahr_status tahr__step_awake(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report);

/* What a step with a report of these flags returns. */
tahr_status tahr__step_status(uint32_t flags);

/* Notes a step that changed no bit of the state; forgets the last one after any other. state: as it is now; changed: is
 * it another one than before the step? */
void tahr__sleep_note(tahr_mover *mover, const tahr__step *step, double dt, const tahr_state *state, int changed);

#endif

/* SPDX-License-Identifier: MIT
 * short_step.h: a step that is plainly one for the short way, from what it is given to what it writes. Compiled twice:
 * for any processor, and for those with 32-byte vectors (short_way.c, short_way_avx2.c). */
#ifndef TAHR_SHORT_STEP_H
#define TAHR_SHORT_STEP_H

#include "plummet.h"
#include "sleep.h"
#include "stroll.h"

/* tahr__quick_step. It is not asleep, and no step is under way. */
static inline tahr_status quick_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                     tahr_report *report)
{
    int done;
    if (state->mode == TAHR_MODE_WALKING && ready_to_walk(mover, input, dt, state, report)) {
        done = stroll(mover, input, dt, state, report, 1);
    } else if (state->mode == TAHR_MODE_FALLING && ready_to_fall(mover, input, dt, state, report)) {
        done = plummet(mover, input, dt, state, report, 1);
    } else {
        return tahr__step_awake(mover, input, dt, state, report);
    }
    if (!done || mover->short_way.failed) {
        backoff_note(&mover->short_way, done);
    }
    return done ? TAHR_OK : tahr__take_step(mover, input, dt, state, report);
}

#endif

/* SPDX-License-Identifier: MIT
 * short_step.h: a step that is plainly one for the short way, from what it is given to what it writes. Compiled twice:
 * for any processor, and for those with 32-byte vectors (short_way.c, short_way_avx2.c). */
#ifndef TAHR_SHORT_STEP_H
#define TAHR_SHORT_STEP_H

#include "plummet.h"
#include "stroll.h"

/* tahr__short_step. */
static inline uint32_t short_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                  tahr_report *report)
{
    int done;
    if (state->mode == TAHR_MODE_WALKING) {
        if (!ready_to_walk(mover, input, dt, state, report)) {
            return TAHR__NOT_READY;
        }
        done = backoff_tries(&mover->short_way) ? stroll(mover, input, dt, state, report, 1) : -1;
    } else if (state->mode == TAHR_MODE_FALLING && ready_to_fall(mover, input, dt, state, report)) {
        done = backoff_tries(&mover->short_way) ? plummet(mover, input, dt, state, report, 1) : -1;
    } else {
        return TAHR__NOT_READY;
    }
    if (done >= 0) {
        tahr__note_short_way(mover, done);
    }
    return done > 0 ? TAHR__WENT : TAHR__IN_VAIN;
}

#endif

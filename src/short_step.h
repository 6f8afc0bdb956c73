/* SPDX-License-Identifier: MIT
 * short_step.h: a step that is plainly one for the short way, from what it is given to what it writes. Compiled twice:
 * for any processor, and for those with 32-byte vectors (short_way.c, short_way_avx2.c). */
#ifndef TAHR_SHORT_STEP_H
#define TAHR_SHORT_STEP_H

#include "plummet.h"
#include "sleep.h"
#include "stroll.h"

/* Lines of memory at the begin of a cache that a walk reads: asked for as long as the step is looked at, they are there
 * when the backend needs them. Of many characters they lie far away. Asking for what is not there does nothing. */
enum { TAHR__CACHE_LINES = 11 };

static inline void fetch_cache(const tahr_mover *mover)
{
#ifdef __GNUC__
    const uintptr_t cache = (uintptr_t)mover->cache;
    for (uintptr_t i = 0; i < TAHR__CACHE_LINES; i++) {
        __builtin_prefetch((const void *)(cache + 64 * i));
    }
#else
    (void)mover;
#endif
}

/* tahr__quick_step. It is not asleep, and no step is under way. */
static inline tahr_status quick_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                     tahr_report *report)
{
    int done;
    if (state->mode == TAHR_MODE_WALKING) {
        fetch_cache(mover);
    }
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
    return done ? TAHR_OK : tahr__take_step(mover, input, dt, state, report, 1);
}

#endif

/* SPDX-License-Identifier: MIT
 * modes.h: the state machine. */
#ifndef TAHR_MODES_H
#define TAHR_MODES_H

#include "overlap.h"

typedef struct tahr__mode {
    const char *name;
    tahr__next (*run)(tahr__step *step, double time);
} tahr__mode;

/* Indexed by TAHR_MODE_*. */
extern const tahr__mode tahr__modes[TAHR_MODE_CUSTOM + 1];

/* What follows when the mode that ran hands over to another. */
void tahr__end_mode(tahr__step *step, uint32_t ran, uint32_t next);

/* StartNewPhysics: runs the state's mode for at most `time` seconds and changes to the mode that goes on. Returns the
 * time left. */
static inline double tahr__run_mode(tahr__step *step, double time)
{
    const uint32_t mode = step->state.mode;
    step->ahead = 0;
    tahr__next next = tahr__modes[mode].run(step, time);
    step->ahead = 0; /* a mode has moved step->time to where it ended */
    tahr__time_slice(step);
    if (next.mode != step->state.mode) {
        tahr__end_mode(step, mode, next.mode);
    }
    return next.time_left;
}

/* Changes the mode by itself, with its event: only by a transition of the table, any other is refused and reported. */
void tahr__change_mode(tahr__step *step, uint32_t mode);

/* Changes the mode because the input asked for it: from anywhere to anywhere. */
void tahr__grant_mode(tahr__step *step, uint32_t mode);

/* Why a mode may change by itself to another, or NULL: it may not. */
const char *tahr__transition(uint32_t from, uint32_t to);

/* Is there such a mode? */
static inline int tahr__is_mode(uint32_t mode)
{
    return mode <= TAHR_MODE_CUSTOM;
}

#endif

/* SPDX-License-Identifier: MIT
 * modes.h: the state machine. */
#ifndef TAHR_MODES_H
#define TAHR_MODES_H

#include "core.h"

/* Runs the state's mode for at most `time` seconds and changes to the mode that goes on. Returns the time left. */
double tahr__run_mode(tahr__step *step, double time);

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

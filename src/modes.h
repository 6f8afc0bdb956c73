/* SPDX-License-Identifier: MIT
 * modes.h: the state machine. */
#ifndef TAHR_MODES_H
#define TAHR_MODES_H

#include "core.h"

/* Runs the state's mode for at most `time` seconds and changes to the mode that goes on. Returns the time left. */
double tahr__run_mode(tahr__step *step, double time);

/* Changes the mode, with its event. */
void tahr__change_mode(tahr__step *step, uint32_t mode);

/* Is there such a mode? */
static inline int tahr__is_mode(uint32_t mode)
{
    return mode <= TAHR_MODE_CUSTOM;
}

#endif

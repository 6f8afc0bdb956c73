/* SPDX-License-Identifier: MIT
 * falling.h: one slice of falling. */
#ifndef TAHR_FALLING_H
#define TAHR_FALLING_H

#include "core.h"

/* Falls for at most `time` seconds, landing where a floor is met. One sweep per chord of the arc (1 at 60 Hz), one more
 * and the floor's when something is hit. */
tahr__next tahr__fall(tahr__step *step, double time);

#endif

/* SPDX-License-Identifier: MIT
 * custom.h: a mode behind the caller's own function. */
#ifndef TAHR_CUSTOM_H
#define TAHR_CUSTOM_H

#include "core.h"

/* PhysCustom: one slice of at most `time` seconds. Without a function it stays where it is. */
tahr__next tahr__run_custom(tahr__step *step, double time);

#endif

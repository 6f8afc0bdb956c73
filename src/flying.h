/* SPDX-License-Identifier: MIT
 * flying.h: flying, in any direction, without weight. */
#ifndef TAHR_FLYING_H
#define TAHR_FLYING_H

#include "core.h"

/* PhysFlying: one slice of at most `time` seconds. Flying ends only when it is asked to. */
tahr__next tahr__fly(tahr__step *step, double time);

#endif

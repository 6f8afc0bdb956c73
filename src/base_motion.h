/* SPDX-License-Identifier: MIT
 * base_motion.h: riding, being pushed by and leaving bodies that move. */
#ifndef TAHR_BASE_MOTION_H
#define TAHR_BASE_MOTION_H

#include "core.h"

/* Carries the character with its base since the last step, and lets what moved into it push it. */
void tahr__follow_base(tahr__step *step, double dt);

/* Notes what it stands on at the end of the step. */
void tahr__take_base(tahr__step *step);

#endif

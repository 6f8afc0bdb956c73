/* SPDX-License-Identifier: MIT
 * launch.h: velocities from outside: launches, impulses, the drive of an animation. */
#ifndef TAHR_LAUNCH_H
#define TAHR_LAUNCH_H

#include "core.h"

/* What the input adds to the velocity at the begin of a step. */
void tahr__launch(tahr__step *step);

#endif

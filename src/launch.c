/* SPDX-License-Identifier: MIT
 * launch.c: velocities from outside: launches, impulses, the drive of an animation. */
#include "launch.h"

void tahr__launch(tahr__step *step)
{
    (void)step;
}

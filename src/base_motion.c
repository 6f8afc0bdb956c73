/* SPDX-License-Identifier: MIT
 * base_motion.c: riding, being pushed by and leaving bodies that move. */
#include "base_motion.h"

void tahr__follow_base(tahr__step *step, double dt)
{
    (void)step, (void)dt;
}

void tahr__take_base(tahr__step *step)
{
    (void)step;
}

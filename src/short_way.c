/* SPDX-License-Identifier: MIT
 * short_way.c: the short way on any processor. */
#include "short_step.h"

tahr_status tahr__quick_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report)
{
    return quick_step(mover, input, dt, state, report);
}

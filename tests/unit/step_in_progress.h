/* SPDX-License-Identifier: MIT
 * step_in_progress.h: a step of a rig's mover, for tests of the rules that take one. */
#ifndef STEP_IN_PROGRESS_H
#define STEP_IN_PROGRESS_H

#include <string.h>

#include "core.h"
#include "rig.h"

/* As mover.c would make it of the rig's state and input, without a time and without arrays in its report. */
static inline tahr__step step_in_progress(rig *r)
{
    tahr__step step;
    memset(&step, 0, sizeof step);
    step.config = &r->mover->config;
    step.limits = &r->mover->limits;
    step.world = r->world;
    step.ignore_body = TAHR_NO_BODY;
    step.input = &r->input;
    step.pull = &r->mover->limits.pull;
    step.state = r->state;
    return step;
}

#endif

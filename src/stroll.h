/* SPDX-License-Identifier: MIT
 * stroll.h: the step that most steps are, in one go. */
#ifndef TAHR_STROLL_H
#define TAHR_STROLL_H

#include "core.h"

/* May steps of this mover be such? Asked once. No query. */
int tahr__may_stroll(const tahr_world *world, const tahr_config *config, const tahr__limits *limits);

/* Near walls and on rough ground it is tried less and less often: after one, two, four, at most eight steps. */
static inline int tahr__tries_stroll(tahr_mover *mover)
{
    if (mover->stroll_rest > 0) {
        mover->stroll_rest--;
        return 0;
    }
    mover->stroll_rest = (1u << mover->stroll_failed) - 1;
    mover->stroll_failed += mover->stroll_failed < 3;
    return 1;
}

/* A step of a walker with nothing in its way, from a face that holds to one that holds, of a state that remembers
 * nothing and an input that asks for nothing but a direction, both checked: the same bits as the long way, for a third
 * of the work. [out] state, report (or NULL). Returns 1; 0: it is not such a step, or may not be; nothing was written.
 * Two sweeps, if the backend has looked at both already. */
int tahr__stroll(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report);

#endif

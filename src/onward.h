/* SPDX-License-Identifier: MIT
 * onward.h: the last straight piece of a slice, along what was met in it, and the floor under its end in one look (the
 * walk slot), where the backend has it and knows. */
#ifndef TAHR_ONWARD_H
#define TAHR_ONWARD_H

#include "core.h"

/* May a step ask so? For one of a state that remembers nothing, with an input that asks for nothing but a direction:
 * then its sweeps are no more than the slot answers. decisions, queries: is somebody there to see them one by one? */
static inline int may_look_onward(const tahr_mover *mover, const tahr_report *report)
{
    return mover->may_go_short_way && mover->world->backend->walk &&
           !(report && (report->decisions || report->queries));
}

/* Moves the character by `motion`, to where a floor has not been looked for, if nothing is in the way and it is known
 * what its foot meets under the end. [out] below: what the sweep of the whole foot answers there, bit for bit, for a
 * look as deep as config.snap_distance. Returns 1, and counts as the two sweeps that it spares; 0: nothing changed, and
 * nothing was counted. Only with step->onward; tried less often where it is of no use. */
int tahr__go_onward(tahr__step *step, vec3 motion, tahr_hit *below);

#endif

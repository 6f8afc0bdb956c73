/* SPDX-License-Identifier: MIT
 * drop.h: falling through the one-way body that one stands on. */
#ifndef TAHR_DROP_H
#define TAHR_DROP_H

#include "core.h"

/* Is it on its way through? Then its queries do not see one-way bodies that are as near as a floor. */
static inline int is_dropping(const tahr__step *step)
{
    return (step->state.flags & TAHR_STATE_DROPPING) != 0;
}

/* m, the margin of its queries then: half the greatest distance at which a one-way body counts as the floor that it
 * stood on. With PULL_BACK too, whose sweeps else have none. */
static inline double drop_margin(const tahr_config *c)
{
    return c->skin * max_of(1, 0.5 * c->floor_max);
}

/* Is there anything to do for tahr__begin_drop? */
static inline int asks_drop(const tahr__step *step)
{
    return ((step->input->flags & TAHR_INPUT_DROP) | (step->state.flags & TAHR_STATE_DROP_HELD)) != 0;
}

/* The press: who stands on one-way bodies alone falls, through one layer of them. A press that finds another floor, or
 * none, is spent. At most one sweep, and those of a floor that is not known. */
void tahr__begin_drop(tahr__step *step);

/* Ends the drop where all of the foot is below the floor that it stood on, and before the next layer comes so near that
 * it would vanish. At most one sweep while dropping, else none. */
void tahr__watch_drop(tahr__step *step);

/* Was what the fall has met a part of the layer that it drops through? It is gone from here on. If not, that ends the
 * drop. At most one sweep while dropping, else none. */
int tahr__drops_on(tahr__step *step, const tahr_hit *met);

/* The body that it dropped from has moved. No query. */
void tahr__carry_drop(tahr__step *step, const tahr_pose *from, const tahr_pose *to);

/* What else ends it: a floor, another mode. No query. */
void tahr__end_drop(tahr__step *step);

/* Has TAHR_BODY_ONE_WAY; of bodies that the core did not describe their motion says so. No query. */
int tahr__is_one_way(const tahr__step *step, uint32_t body);

#endif

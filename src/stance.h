/* SPDX-License-Identifier: MIT
 * stance.h: crouching and other changes of the shape. */
#ifndef TAHR_STANCE_H
#define TAHR_STANCE_H

#include "core.h"

/* Everything the step measures against, for a character of this size. */
void tahr__use_shape(tahr__step *step, double radius, double half_height);

/* Crouch and UnCrouch: takes the shape that the input asks for, if there is room: shrinks at once, grows where nothing
 * is in the way. On ground the foot stays where it is; in the air the centre does, so that crouching in a jump draws
 * the foot up, and growing gives way to a floor or a ceiling. Frozen and hanging characters keep their shape. 0 to 3
 * contact queries. */
void tahr__take_stance(tahr__step *step);

/* Widens what is announced by what a change of the shape may reach. No query. */
void tahr__announce_stance(const tahr__step *step, tahr_bounds *bounds);

/* May this step have another shape than config.shape, or want one? */
static inline int is_stance_open(const tahr__step *step)
{
    uint32_t asked = step->input->crouch | (step->input->flags & TAHR_INPUT_SHAPE);
    return asked || step->limits == &step->own_limits;
}

static inline int is_crouched(const tahr__step *step)
{
    return (step->state.flags & TAHR_STATE_CROUCHED) != 0;
}

/* Does it fall off ledges, or stop at them? */
static inline int may_walk_off(const tahr__step *step)
{
    const tahr_config *c = step->config;
    return c->walk_off_ledges && (!is_crouched(step) || c->walk_off_ledges_crouched);
}

#endif

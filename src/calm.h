/* SPDX-License-Identifier: MIT
 * calm.h: steps with nothing special near, in worlds that hold something special: bodies that move, carry, can be
 * pushed or are only felt.
 *
 * The distance to a body changes by no more than the way that the character has come and the way that the body has
 * come. So once it is known how much room there is around a place, it need not be looked for again until that is used
 * up. A step that reaches nothing special is taken as in a world without: nothing of what is left out could have found
 * anything. What it would have noted all the same, that bodies moved elsewhere, is put into the state before it. */
#ifndef TAHR_CALM_H
#define TAHR_CALM_H

#include "core.h"

/* What makes a described body special. */
static inline int note_is_special(const tahr__body_note *note)
{
    return (note->flags & (TAHR_BODY_SENSOR | TAHR_BODY_FLUID | TAHR_BODY_MOVABLE)) != 0 ||
           length_squared(note->surface_velocity) > 0 || note->mass > 0;
}

/* Lists the special bodies of a world. TAHR_OK or TAHR_E_MEMORY. */
tahr_status tahr__specials_list(tahr_world *world);
void tahr__specials_free(tahr_world *world);

/* Before bodies are placed: how far the one goes that goes farthest. */
void tahr__specials_go(tahr_world *world, const tahr_body_pose *poses, uint32_t count);

/* No step on this world is calm from now on. */
static inline void world_unrest(tahr_world *world)
{
    world->drift = 1e300;
}

/* Sets up a mover whose limits, pace and short_way are known. */
void tahr__calm_prepare(tahr_mover *mover);

/* tahr_mover_step of a mover that calms, with input and state not NULL and no sleep to go on with. */
tahr_status tahr__step_calmly(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                              tahr_report *report);

/* The step under way, which was taken for a calm one, is none: all is as it was before it. */
void tahr__calm_quit(tahr_mover *mover, tahr_state *state);

#endif

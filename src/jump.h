/* SPDX-License-Identifier: MIT
 * jump.h: when a jump starts, how it is held and cut short, and the timers of what is forgiven.
 *
 * One rule says what a press of the button starts: what comes first of
 *   ground  it walks;
 *   coyote  the floor ended less than coyote_time ago, and no jump or launch has happened since;
 *   wall    within 1.5 skin of a wall, or one was left less than wall_coyote_time ago, that was not jumped off already;
 *   air     fewer than air_jumps since it last stood, swam or hung (walking off a ledge costs none of them).
 * What starts nothing is remembered for jump_buffer seconds and starts at the moment of landing or of meeting a
 * wall. A press starts one jump at most, and a jump ends the coyote time and forgets the press. On an edge
 * (hanging.h) a press climbs instead.
 *
 * A jump from the ground adds jump_speed; every other one raises the speed against gravity to jump_speed, so that
 * none is higher than the one from the ground: jump_speed * jump_hold_time + jump_speed^2 / (2 gravity) above where
 * it began. */
#ifndef TAHR_JUMP_H
#define TAHR_JUMP_H

#include "core.h"

/* CheckJumpInput: looks at the button at the begin of a step. One contact query for a press in the air with wall jumps;
 * an edge costs what climbing does. */
void tahr__look_at_button(tahr__step *step);

static inline void tahr__begin_jump(tahr__step *step)
{
    const tahr_state *s = &step->state;
    const uint32_t pressed = TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMP_SPENT;
    if (step->input->jump || s->flags & pressed || s->jump_hold > 0 || s->coyote_left > 0) {
        tahr__look_at_button(step);
    }
}

/* Notes a wall that a fall has met, and jumps off it if that was asked for a moment ago. Returns 0 if it is no wall. At
 * most one contact query. */
int tahr__meet_wall(tahr__step *step, const tahr_hit *hit);

/* Starts the jump that was asked for in the air, on ground or where a wall was just met. At most one contact query. */
void tahr__use_press(tahr__step *step);

/* Is a press remembered now? */
static inline int press_is_remembered(const tahr__step *step)
{
    return step->state.buffer_left > 0;
}

/* The floor has ended, now: not by a jump or a launch. No query. */
void tahr__floor_ended(tahr__step *step);

/* Falling has ended in another mode: air jumps are given back, walls and edges forgotten, but for what it hangs on. No
 * query. */
void tahr__flight_ended(tahr__step *step, uint32_t mode);

/* What gravity is multiplied by while the speed against it is `rise`. */
double tahr__gravity_factor(const tahr__step *step, double rise);

/* Times at the end of the state's timers. While a step runs they hold what was left at its begin, so that what
 * starts at step->time is set to that more, and is over where step->time reaches it: the same at every frame rate. */
void tahr__count_down(tahr__step *step);

/* At the end of a step. lift_left counts with the base (base_motion.c). */
static inline void tahr__run_timers(tahr__step *step)
{
    const tahr_state *s = &step->state;
    if (s->coyote_left + s->buffer_left + s->wall_left > 0) {
        tahr__count_down(step);
    }
}

#endif

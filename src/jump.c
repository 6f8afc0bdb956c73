/* SPDX-License-Identifier: MIT
 * jump.c: when a jump starts. */
#include "jump.h"

#include "modes.h"
#include "plane.h"
#include "report.h"
#include "swimming.h"
#include "walking.h"

/* A jump that gravity slows down from the start is held up by starting it again in every step: how high it goes depends on
 * the frame rate. Up to a nanosecond is the rounding of a time that was used up. */
static void hold_jump(tahr__step *step)
{
    tahr_state *s = &step->state;
    double rise = dot(s->velocity, s->up), speed = step->config->jump_speed;
    if (step->config->jump_hold_gravity && s->flags & TAHR_STATE_JUMPING && s->jump_hold > 1e-9 && rise < speed) {
        s->velocity = add_scaled(s->velocity, s->up, speed - rise);
    }
}

/* A jump starts when the button goes down on ground. */
void tahr__begin_jump(tahr__step *step)
{
    tahr_state *s = &step->state;
    int held = (s->flags & TAHR_STATE_JUMP_HELD) != 0;
    if (!step->input->jump) {
        s->flags &= ~(uint32_t)TAHR_STATE_JUMP_HELD;
        s->jump_hold = 0;
        return;
    }
    s->flags |= TAHR_STATE_JUMP_HELD;
    if (!held && s->mode == TAHR_MODE_SWIMMING) {
        tahr__jump_from_water(step);
        return;
    }
    if (held || s->mode != TAHR_MODE_WALKING || !may_rise(step)) {
        hold_jump(step);
        return;
    }
    tahr__leave_floor(step);
    s->velocity = add_scaled(s->velocity, s->up, step->config->jump_speed);
    s->jump_hold = step->config->jump_hold_time;
    s->flags |= TAHR_STATE_JUMPING;
    s->floor_revision = 0;
    tahr__event(step, TAHR_EVENT_JUMPED, NULL, step->config->jump_speed);
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_JUMP);
    tahr__decide(step, TAHR_RULE_JUMP, 1, NULL, step->config->jump_speed, 0, "button went down on ground");
    tahr__change_mode(step, TAHR_MODE_FALLING);
}

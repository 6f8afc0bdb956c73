/* SPDX-License-Identifier: MIT
 * jump.c: when a jump starts, how it is held and cut short, and the timers of what is forgiven. */
#include "jump.h"

#include "drop.h"
#include "hanging.h"
#include "modes.h"
#include "plane.h"
#include "report.h"
#include "swimming.h"
#include "walking.h"
#include "wall.h"

/* s, of a timer that is the rounding of the sum of the steps it ran through: it is over. */
static const double MOMENT = 1e-9;

static int is_running(const tahr__step *step, double timer)
{
    return timer - (step->time + step->ahead) > MOMENT;
}

static double after(double timer, double dt)
{
    return timer - dt > MOMENT ? timer - dt : 0;
}

void tahr__count_down(tahr__step *step)
{
    tahr_state *s = &step->state;
    s->coyote_left = after(s->coyote_left, step->dt);
    s->buffer_left = after(s->buffer_left, step->dt);
    s->wall_left = after(s->wall_left, step->dt);
}

void tahr__floor_ended(tahr__step *step)
{
    double time = step->config->coyote_time;
    step->state.coyote_left = time > 0 ? time + step->time : 0;
}

void tahr__flight_ended(tahr__step *step, uint32_t mode)
{
    step->state.coyote_left = 0;
    step->state.jump_count = 0;
    step->state.flags &= ~(uint32_t)TAHR_STATE_EDGE_SPENT;
    if (is_dropping(step)) {
        tahr__end_drop(step);
    }
    if (mode != TAHR_MODE_HANGING) {
        tahr__forget_walls(step);
    }
}

double tahr__gravity_factor(const tahr__step *step, double rise)
{
    const tahr_state *s = &step->state;
    if (rise <= 1e-9 * step->pull->size) { /* less than a nanosecond of rise is the rounding of an apex */
        return step->config->fall_gravity;
    }
    int up = !step->input->jump || !(s->flags & TAHR_STATE_JUMP_SPENT); /* a press in the air is not that of the jump */
    return s->flags & TAHR_STATE_JUMPING && up ? step->config->jump_release_gravity : 1;
}

/* A jump that gravity slows down from the start is held up by starting it again in every step: how high it goes depends
 * on the frame rate. Up to a nanosecond is the rounding of a time that was used up. */
static void hold_jump(tahr__step *step)
{
    tahr_state *s = &step->state;
    double rise = dot(s->velocity, s->up), speed = step->config->jump_speed;
    if (step->config->jump_hold_gravity && s->flags & TAHR_STATE_JUMPING && s->jump_hold > 1e-9 && rise < speed) {
        s->velocity = add_scaled(s->velocity, s->up, speed - rise);
    }
}

/* What all jumps have in common. */
static void take_off(tahr__step *step)
{
    tahr_state *s = &step->state;
    s->jump_hold = step->config->jump_hold_time;
    s->flags |= TAHR_STATE_JUMPING | (step->limits->feel & TAHR__FEEL_JUMPS ? TAHR_STATE_JUMP_SPENT : 0u);
    s->coyote_left = 0;
    s->buffer_left = 0;
}

static int say(tahr__step *step, const char *reason)
{
    tahr__event(step, TAHR_EVENT_JUMPED, NULL, step->config->jump_speed);
    return tahr__decide(step, TAHR_RULE_JUMP, 1, NULL, step->config->jump_speed, 0, reason);
}

static int jump_from_ground(tahr__step *step)
{
    tahr_state *s = &step->state;
    tahr__leave_floor(step);
    s->velocity = add_scaled(s->velocity, s->up, step->config->jump_speed);
    take_off(step);
    s->floor_revision = 0;
    tahr__event(step, TAHR_EVENT_JUMPED, NULL, step->config->jump_speed);
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_JUMP);
    tahr__decide(step, TAHR_RULE_JUMP, 1, NULL, step->config->jump_speed, 0, "button went down on ground");
    tahr__change_mode(step, TAHR_MODE_FALLING);
    return 1;
}

/* Not on top of a speed that it has already: no jump is higher for being the second one. */
static void jump_in_air(tahr__step *step)
{
    tahr_state *s = &step->state;
    double lacks = step->config->jump_speed - dot(s->velocity, s->up);
    s->velocity = add_scaled(s->velocity, s->up, max_of(lacks, 0));
    take_off(step);
}

static int jump_off_wall(tahr__step *step)
{
    tahr_state *s = &step->state;
    tahr_hit wall;
    double speed = step->config->wall_jump_speed;
    if (speed <= 0 || !tahr__wall_to_jump_off(step, is_running(step, s->wall_left), &wall)) {
        return 0;
    }
    double away = dot(s->velocity, wall.normal);
    s->velocity = add_scaled(s->velocity, wall.normal, max_of(speed - away, 0));
    jump_in_air(step);
    tahr__spend_wall(step, &wall);
    tahr__event(step, TAHR_EVENT_WALL_JUMPED, &wall, speed);
    return tahr__decide(step, TAHR_RULE_WALL_JUMP, 1, &wall, speed, 0, "button went down at a wall");
}

/* An edge is climbed if there is room on it, else jumped off, upward. */
static int jump_from_edge(tahr__step *step)
{
    if (tahr__climb_edge(step)) {
        step->state.flags |= TAHR_STATE_JUMP_SPENT;
        return 1;
    }
    tahr__let_go(step);
    tahr__change_mode(step, TAHR_MODE_FALLING);
    jump_in_air(step);
    return say(step, "no room on the edge");
}

static int jump_from_air(tahr__step *step, int pressed)
{
    tahr_state *s = &step->state;
    if (is_running(step, s->coyote_left)) {
        jump_in_air(step);
        return say(step, "the floor has only just ended");
    }
    if (jump_off_wall(step)) {
        return 1;
    }
    if (!pressed || s->jump_count >= step->config->air_jumps) {
        return 0;
    }
    s->jump_count++;
    jump_in_air(step);
    return say(step, "in the air");
}

void tahr__look_at_button(tahr__step *step)
{
    tahr_state *s = &step->state;
    int held = (s->flags & TAHR_STATE_JUMP_HELD) != 0;
    if (s->coyote_left > 0 && step->input->flags & (TAHR_INPUT_LAUNCH | TAHR_INPUT_IMPULSE)) {
        s->coyote_left = 0;
    }
    if (!step->input->jump) {
        s->flags &= ~(uint32_t)(TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMP_SPENT);
        s->jump_hold = 0;
        return;
    }
    s->flags |= TAHR_STATE_JUMP_HELD;
    if (held || !may_rise(step)) {
        hold_jump(step);
        return;
    }
    s->flags &= ~(uint32_t)TAHR_STATE_JUMP_SPENT;
    if (s->mode == TAHR_MODE_WALKING) {
        jump_from_ground(step);
    } else if (s->mode == TAHR_MODE_HANGING) {
        jump_from_edge(step);
    } else if (s->mode == TAHR_MODE_SWIMMING) {
        tahr__jump_from_water(step);
        s->flags |= step->limits->feel & TAHR__FEEL_JUMPS ? TAHR_STATE_JUMP_SPENT : 0u;
    } else if (s->mode == TAHR_MODE_FALLING && !jump_from_air(step, 1)) {
        s->buffer_left = step->config->jump_buffer;
    }
}

int tahr__meet_wall(tahr__step *step, const tahr_hit *hit)
{
    if (!tahr__is_wall(step, hit->normal)) {
        return 0;
    }
    tahr__touch_wall(step, hit);
    if (press_is_remembered(step)) {
        tahr__use_press(step);
    }
    return 1;
}

void tahr__use_press(tahr__step *step)
{
    if (!is_running(step, step->state.buffer_left)) {
        return;
    }
    if (step->state.mode == TAHR_MODE_WALKING) {
        jump_from_ground(step);
    } else if (step->state.mode == TAHR_MODE_FALLING) {
        jump_from_air(step, 0);
    }
}

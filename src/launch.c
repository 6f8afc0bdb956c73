/* SPDX-License-Identifier: MIT
 * launch.c: velocities from outside: launches, impulses, the drive of an animation. */
#include "launch.h"

#include "modes.h"
#include "plane.h"
#include "report.h"
#include "slide.h"
#include "walking.h"

/* m/s: the fastest that a state may hold (mover.h). What is launched again and again stays a valid state. */
static const double FASTEST = 1e5;

/* An impulse along the ground points upward by rounding only. */
static const double LEVEL = 1e-9;

/* The velocity as it goes on in the air; not from where nothing rises. Who flies or swims goes on so. */
static void leave_ground(tahr__step *step)
{
    tahr_state *s = &step->state;
    if (s->mode == TAHR_MODE_WALKING) {
        tahr__leave_floor(step);
        s->floor_revision = 0;
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_LAUNCH);
        tahr__change_mode(step, TAHR_MODE_FALLING);
    } else if (s->mode == TAHR_MODE_HANGING) {
        tahr__change_mode(step, TAHR_MODE_FALLING);
    }
    s->flags &= ~(uint32_t)TAHR_STATE_JUMPING; /* a held button no longer suspends gravity */
    s->jump_hold = 0;
}

static void set_velocity(tahr__step *step, vec3 v)
{
    double size = length(v);
    step->state.velocity = size > FASTEST ? scale(v, FASTEST / size) : v;
}

static void take_launch(tahr__step *step)
{
    const uint32_t flags = step->input->flags;
    vec3 up = step->state.up;
    int rises = may_rise(step);
    if (rises) {
        leave_ground(step);
    }
    vec3 v = step->state.velocity;
    double rise = dot(v, up);
    vec3 level = add_scaled(v, up, -rise);
    vec3 kept = flags & TAHR_INPUT_LAUNCH_LEVEL ? vec(0, 0, 0) : level;
    kept = flags & TAHR_INPUT_LAUNCH_UP ? kept : add_scaled(kept, up, rise);
    set_velocity(step, add(kept, step->input->launch));
    tahr__event(step, TAHR_EVENT_LAUNCHED, NULL, length(step->state.velocity));
}

static void take_impulse(tahr__step *step)
{
    vec3 gain = scale(step->input->impulse, 1.0 / step->config->mass);
    double rise = dot(gain, step->state.up);
    if (step->state.mode == TAHR_MODE_WALKING && !(rise > LEVEL * length(gain) && may_rise(step))) {
        set_velocity(step, add(step->state.velocity, step_level(step, gain))); /* the floor takes the rest */
        return;
    }
    int leaves = step->state.mode == TAHR_MODE_WALKING || step->state.mode == TAHR_MODE_HANGING;
    if (leaves) {
        leave_ground(step);
    }
    set_velocity(step, add(step->state.velocity, gain));
    if (leaves) {
        tahr__event(step, TAHR_EVENT_LAUNCHED, NULL, length(step->state.velocity));
    }
}

/* On ground the floor, and with DRIVE_LEVEL gravity, say how fast it rises. */
static void take_drive(tahr__step *step)
{
    tahr_state *s = &step->state;
    vec3 drive = drive_of(step);
    if (s->mode == TAHR_MODE_WALKING) {
        s->velocity = step_level(step, drive);
    } else if (step->input->flags & TAHR_INPUT_DRIVE_LEVEL) {
        s->velocity = add_scaled(drive, s->up, dot(s->velocity, s->up));
    } else {
        s->velocity = drive;
    }
}

void tahr__launch(tahr__step *step)
{
    const uint32_t flags = step->input->flags;
    if (step->state.mode == TAHR_MODE_NONE) {
        return;
    }
    if (flags & TAHR_INPUT_IMPULSE) {
        take_impulse(step);
    }
    if (flags & TAHR_INPUT_LAUNCH) {
        take_launch(step);
    }
    if (is_driven(step) && step->state.mode != TAHR_MODE_HANGING) {
        take_drive(step);
    }
}

void tahr__drive_piece(tahr__step *step, tahr__path *w)
{
    vec3 drive = step_level(step, step->input->drive);
    w->stop_time = -1; /* what it has of its own may stop, the character does not */
    w->drifts = (uint32_t)is_drifting(step);
    if (w->drifts) {
        w->drift = drive;
        w->wish = tahr__slide(w->walls, w->wall_count, add_scaled(w->wish, drive, w->duration));
        return;
    }
    w->velocity = tahr__slide(w->walls, w->wall_count, drive);
    w->law = drive_law(w->velocity);
    w->wish = scale(w->velocity, w->duration);
    step->state.velocity = w->velocity;
}

/* Newton, held within what is known: 24 rounds of halving alone are a ten-millionth of the duration. */
double tahr__drift_time(const tahr__law *law, vec3 v, vec3 drift, double duration, vec3 whole, double part)
{
    double low = 0, high = duration, t = part * duration;
    vec3 measure = scale(whole, 1.0 / length_squared(whole));
    for (int i = 0; i < 24; i++) {
        tahr__motion m = tahr__law_advance(law, v, t);
        double over = dot(add_scaled(m.displacement, drift, t), measure) - part;
        double rate = dot(add(m.velocity, drift), measure);
        double next = newton_next(t, over, rate, &low, &high);
        if (next == t) {
            break;
        }
        t = next;
    }
    return t;
}

/* SPDX-License-Identifier: MIT
 * custom.c: a mode behind the caller's own function: what it may ask and do, and the check of its answer. */
#include "custom.h"

#include "glide.h"
#include "message.h"
#include "modes.h"
#include "move.h"
#include "plane.h"
#include "query.h"
#include "report.h"

tahr_status tahr_mover_set_custom_mode(tahr_mover *mover, tahr_custom_mode_fn fn, void *user)
{
    if (!mover) {
        return TAHR_E_NULL;
    }
    if (mover->busy) {
        return tahr__complain(&mover->world->log, TAHR_E_REENTRANT, "tahr_mover_set_custom_mode", "mover",
                              "is being stepped");
    }
    mover->custom.run = fn;
    mover->custom.user = user;
    mover->sleep.noted = 0; /* what the last step was is no longer what the next one will be */
    return TAHR_OK;
}

static const char *bad_answer(const tahr_custom_next *next, double time)
{
    if (!(next->time_left >= 0 && next->time_left <= time)) {
        return "custom mode: next.time_left";
    }
    if (next->reserved) {
        return "custom mode: next.reserved";
    }
    return tahr__is_mode(next->mode) && next->mode != TAHR_MODE_HANGING ? NULL : "custom mode: next.mode";
}

tahr__next tahr__run_custom(tahr__step *step, double time)
{
    const tahr__custom *custom = step->custom;
    tahr_custom_next answer = {TAHR_MODE_CUSTOM, 0, 0};
    tahr__next next = {TAHR_MODE_CUSTOM, 0};
    if (!custom->run) {
        step->report.flags |= TAHR_REPORT_MODE_REFUSED;
        step->time += time;
        return next;
    }
    tahr_status status = custom->run(custom->user, step, time, &answer);
    const char *bad = status < 0 ? "custom mode: status" : bad_answer(&answer, time);
    if (bad && step->error >= 0) {
        step->error =
            tahr__complain(&step->world->log, TAHR_E_BACKEND, "tahr_mover_step", bad, "in the answer is invalid");
    }
    if (step->error < 0) {
        return next;
    }
    step->time += time - answer.time_left;
    next.mode = answer.mode;
    next.time_left = answer.time_left;
    return next;
}

const tahr_state *tahr_step_state(const tahr_step *step)
{
    return step ? &step->state : NULL;
}

const tahr_input *tahr_step_input(const tahr_step *step)
{
    return step ? step->input : NULL;
}

const tahr_config *tahr_step_config(const tahr_step *step)
{
    return step ? step->config : NULL;
}

const tahr_vec3 *tahr_step_gravity(const tahr_step *step)
{
    return step ? &step->pull->gravity : NULL;
}

static tahr_status refuse(const tahr__step *step, const char *function, const char *field)
{
    return tahr__complain(&step->world->log, TAHR_E_ARGUMENT, function, field, "is out of range or not finite");
}

/* False too for what is not finite: its square is not either. */
static int is_within(const tahr_vec3 *v, double most)
{
    return length_squared(*v) <= most * most;
}

tahr_status tahr_step_set_velocity(tahr_step *step, const tahr_vec3 *velocity)
{
    if (!step || !velocity) {
        return TAHR_E_NULL;
    }
    if (!is_within(velocity, 1e5)) {
        return refuse(step, "tahr_step_set_velocity", "velocity");
    }
    step->state.velocity = along_plane(step->limits, *velocity);
    return TAHR_OK;
}

tahr_status tahr_step_slide(tahr_step *step, const tahr_vec3 *motion, tahr_step_moved *moved)
{
    if (!step || !motion) {
        return TAHR_E_NULL;
    }
    if (!is_within(motion, 1e6)) {
        return refuse(step, "tahr_step_slide", "motion");
    }
    tahr__glide g;
    tahr_step_moved done = {.last = {.fraction = 1, .body = TAHR_NO_BODY}};
    vec3 start = step->state.position, rest = along_plane(step->limits, *motion);
    tahr__glide_begin(step, &g, 1); /* its time is not used */
    while (tahr__glide_goes_on(step, &g) && length_squared(rest) > 0) {
        tahr_hit hit;
        tahr__move(step, rest, &hit);
        if (!hit.blocking) {
            break;
        }
        done.last = hit;
        done.hits++;
        rest = scale(rest, hit.start_overlap ? 1 : 1 - hit.fraction);
        if (!tahr__glide_meet(step, &g, &hit)) {
            break;
        }
        rest = tahr__glide_bend(&g, rest);
    }
    done.motion = sub(step->state.position, start);
    if (moved && step->error >= 0) {
        *moved = done;
    }
    return step->error;
}

tahr_status tahr_step_sweep(tahr_step *step, const tahr_vec3 *motion, tahr_hit *hit)
{
    if (!step || !motion || !hit) {
        return TAHR_E_NULL;
    }
    if (!is_within(motion, 1e6)) {
        return refuse(step, "tahr_step_sweep", "motion");
    }
    tahr_hit found;
    const vec3 flat = along_plane(step->limits, *motion);
    tahr__sweep(step, &step->limits->shape, step->state.position, flat, step->config->skin, 0, &found);
    if (step->error >= 0) {
        *hit = found;
    }
    return step->error;
}

tahr_status tahr_step_ray(tahr_step *step, const tahr_vec3 *origin, const tahr_vec3 *motion, tahr_hit *hit)
{
    if (!step || !origin || !motion || !hit) {
        return TAHR_E_NULL;
    }
    if (!is_within(origin, 2e7) || !is_within(motion, 1e6)) {
        return refuse(step, "tahr_step_ray", is_within(origin, 2e7) ? "motion" : "origin");
    }
    if (world_is_planar(step->world) && motion->z != 0) {
        return tahr__complain(&step->world->log, TAHR_E_ARGUMENT, "tahr_step_ray", "motion", TAHR__NO_Z);
    }
    tahr_hit found;
    tahr__ray(step, *origin, *motion, &found);
    if (step->error >= 0) {
        *hit = found;
    }
    return step->error;
}

tahr_status tahr_step_fluid(tahr_step *step, tahr_fluid *fluid)
{
    if (!step || !fluid) {
        return TAHR_E_NULL;
    }
    tahr_fluid found = tahr__fluid(step, step->state.position);
    if (step->error >= 0) {
        *fluid = found;
    }
    return step->error;
}

tahr_status tahr_step_event(tahr_step *step, double after, double value)
{
    if (!step) {
        return TAHR_E_NULL;
    }
    if (!(after >= 0 && after <= step->dt - step->time) || !is_finite(value)) {
        return refuse(step, "tahr_step_event", is_finite(value) ? "after" : "value");
    }
    step->ahead = after;
    tahr__event(step, TAHR_EVENT_CUSTOM, NULL, value);
    return TAHR_OK;
}

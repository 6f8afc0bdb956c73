/* SPDX-License-Identifier: MIT
 * mover.c: life cycle, entry checks, the announcement, the loop over slices of time. */
#include <string.h>

#include "arguments.h"
#include "base_motion.h"
#include "calm.h"
#include "core.h"
#include "drop.h"
#include "fit.h"
#include "jump.h"
#include "launch.h"
#include "limits.h"
#include "message.h"
#include "modes.h"
#include "neighbours.h"
#include "onward.h"
#include "overlap.h"
#include "plane.h"
#include "query.h"
#include "record.h"
#include "report.h"
#include "request.h"
#include "short_way.h"
#include "sleep.h"
#include "stance.h"
#include "trail.h"
#include "turning.h"

/* Bytes of a state that a step works on. */
enum { USED = offsetof(tahr_state, reserved) };

tahr_status tahr_mover_create(tahr_world *world, const tahr_config *config, tahr_mover **out)
{
    const char *field = NULL;
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!config || !out) {
        return tahr__complain(&world->log, TAHR_E_NULL, "tahr_mover_create", config ? "mover" : "config", "is NULL");
    }
    tahr_status status = tahr_config_check(config, &field);
    if (status < 0) {
        return tahr__complain(&world->log, status, "tahr_mover_create", field ? field : "config:",
                              field ? "is out of range or not finite" : tahr_status_message(status));
    }
    status = tahr__fit_check(world, config, "tahr_mover_create");
    if (status < 0) {
        return status;
    }
    tahr_allocator a = world->memory.user;
    size_t cache_size = world->backend->cache_size ? world->backend->cache_size(world->self) : 0;
    tahr_mover *mover = a.alloc(a.user, sizeof *mover, 64);
    void *cache = mover && cache_size ? a.alloc(a.user, cache_size, 64) : NULL;
    if (!mover || (cache_size && !cache)) {
        if (mover) {
            a.free(a.user, mover, sizeof *mover, 64);
        }
        return tahr__complain(&world->log, TAHR_E_MEMORY, "tahr_mover_create", "allocator", "returned NULL");
    }
    memset(mover, 0, sizeof *mover);
    if (cache) {
        memset(cache, 0, cache_size);
    }
    mover->world = world;
    mover->wide = mover->sleep.wide = tahr__is_wide();
    memcpy(&mover->config, config, sizeof mover->config);
    mover->limits = tahr__limits_of(&mover->config, &config->shape, world->backend->capabilities);
    mover->plain = !world->has && !mover->limits.feel && !mover->limits.in_plane;
    mover->pace = tahr__pace_of(&mover->config, &mover->limits);
    mover->dive = tahr__dive_of(&mover->config, &mover->limits);
    mover->may_go_short_way = !world->has && tahr__may_go_short_way(world, config, &mover->limits);
    mover->not_quick = !mover->may_go_short_way || !mover->pace.upright;
    tahr__calm_prepare(mover);
    mover->cache = cache;
    mover->cache_size = cache_size;
    *out = mover;
    return TAHR_OK;
}

void tahr_mover_destroy(tahr_mover *mover)
{
    if (mover) {
        tahr_allocator a = mover->world->memory.user;
        if (mover->cache) {
            a.free(a.user, mover->cache, mover->cache_size, 64);
        }
        a.free(a.user, mover, sizeof *mover, 64);
    }
}

/* Everything that a step is expected to ask about: its motion, steps up, snaps and perches down, a few skins. */
static tahr_prepare announcement_of(const tahr_config *c, const tahr__limits *limits, const tahr_state *s, double pull,
                                    double dt)
{
    double level = max_of(length(s->velocity), c->max_speed) * dt + limits->beside;
    double fall = s->mode == TAHR_MODE_FALLING ? 0.5 * pull * dt * dt : 0;
    double rise = max_of(c->step_height, c->jump_speed * dt);
    double drop = limits->below + fall;
    vec3 up = s->up, p = s->position;
    vec3 away = vec(fabs(up.x), fabs(up.y), fabs(up.z));
    double around = limits->around + level;
    vec3 half = add_scaled(vec(around, around, around), away, limits->axis + 0.5 * (rise + drop));
    vec3 middle = add_scaled(p, up, 0.5 * (rise - drop));
    return (tahr_prepare){.bounds = {sub(middle, half), add(middle, half)}, .position = p, .up = up, .mask = c->mask};
}

static void announce(tahr__step *step, double dt, int stance)
{
    tahr_prepare a = announcement_of(step->config, step->limits, &step->state, step->pull->size, dt);
    if (stance) {
        tahr__announce_stance(step, &a.bounds);
    }
    step->announced = a.position;
    tahr__announce(step, &a);
}

int tahr__announce_early(tahr_mover *mover, double dt, const tahr_state *state, tahr_query_context *context)
{
    const tahr__limits *limits = &mover->limits;
    const tahr_prepare a = announcement_of(&mover->config, limits, state, limits->pull.size, dt);
    const tahr_backend *backend = mover->world->backend;
    if (!backend->prepare || backend->prepare(mover->world->self, context, &a) != TAHR_OK) {
        return 0;
    }
    mover->gathers = context->gathers;
    return 1;
}

/* What else a step begins with: the plane, the facing. */
static void prepare_body(tahr__step *step, double dt)
{
    if (is_in_plane(step)) {
        tahr__plane_begin(step);
    }
    if (!is_upright(step)) {
        tahr__right(step);
    }
    if (step->input->flags & TAHR_INPUT_FACING) {
        tahr__face(step, dt);
    }
}

/* And what was asked for. */
static void answer_requests(tahr__step *step, double dt, int stance)
{
    tahr__follow_base(step, dt);
    if (step->around) {
        tahr__meet_neighbours(step);
    }
    if (stance) {
        tahr__take_stance(step);
    }
    if (step->input->flags & ~(uint32_t)(TAHR_INPUT_GRAVITY | TAHR_INPUT_FACING)) {
        tahr__ask_mode(step);
        tahr__launch(step);
    }
}

static void end(tahr__step *step)
{
    if (is_in_plane(step)) {
        tahr__plane_end(step);
    }
    tahr__run_timers(step);
    tahr__take_base(step);
    if (step->trail) {
        tahr__find_overlaps(step);
    }
}

/* PerformMovement. plain: nothing was asked for but to go and to jump, nothing is remembered, and the world holds
 * nothing that moves or is only felt. Most steps are. */
static void run(tahr__step *step, double dt, int plain)
{
    plain = plain && is_upright(step);
    if (!plain) {
        prepare_body(step, dt);
    }
    int stance = !plain && is_stance_open(step);
    announce(step, dt, stance);
    if (!plain) {
        answer_requests(step, dt, stance);
        if (asks_drop(step)) {
            tahr__begin_drop(step);
        }
    }
    tahr__begin_jump(step);
    tahr__time_slice(step);
    double left = dt;
    while (left > TAHR__SHORTEST && step->error >= 0 && step->report.slices < TAHR__MAX_SLICES &&
           !(step->report.flags & TAHR_REPORT_QUERY_CAP)) {
        step->report.slices++;
        if (!plain && press_is_remembered(step) && step->state.mode == TAHR_MODE_WALKING) {
            tahr__use_press(step);
        }
        left = tahr__run_mode(step, left);
    }
    if (left > TAHR__SHORTEST) {
        step->report.time_lost += left;
    }
    if (step->report.time_lost > 0) {
        step->report.time_lost = min_of(step->report.time_lost, dt); /* a sum of parts is rounded */
        step->report.flags |= TAHR_REPORT_TIME_LOST;
    }
    if (!step->limits->usual && step->iterations + step->apexes > step->report.slices) {
        step->report.slices = step->iterations + step->apexes; /* a mode cut its slices into more */
    }
    if (!plain) {
        end(step);
    } else if (step->calm && step->state.mode == TAHR_MODE_WALKING) {
        step->state.velocity = step_level(step, step->state.velocity); /* as tahr__note_base does */
    }
}

/* m/s: the fastest that a state may hold (mover.h), and a little less, so that rounding stays below. */
static const double FASTEST = 1e5, CAPPED = 1e5 * (1 - 1e-15);

/* Bases, walls and settings may add what no launch may. */
static void cap_speed(tahr_state *s)
{
    if (length_squared(s->velocity) > FASTEST * FASTEST) {
        s->velocity = scale(s->velocity, CAPPED / length(s->velocity));
    }
}

/* What a step works on. */
static void hand_over(const tahr__step *step, int remembers, tahr_state *out)
{
    const tahr_state *s = &step->state;
    tahr__clean_state(s, out);
    if (remembers) { /* written clean where it is written */
        memcpy(&out->radius, &s->radius, USED - offsetof(tahr_state, radius));
    }
}

tahr_status tahr__step_status(uint32_t flags)
{
    if (flags & TAHR_REPORT_QUERY_CAP) {
        return TAHR_QUERY_CAP;
    }
    if (flags & TAHR_REPORT_CRUSHED) {
        return TAHR_CRUSHED;
    }
    if (flags & TAHR_REPORT_STUCK) {
        return TAHR_STUCK;
    }
    if (flags & TAHR_REPORT_UNKNOWN) {
        return TAHR_UNKNOWN;
    }
    return flags & TAHR_REPORT_TRUNCATED ? TAHR_TRUNCATED : TAHR_OK;
}

static void finish_report(tahr__step *step)
{
    tahr_report *r = &step->report;
    r->triangle_tests = step->context.narrow_tests;
    r->narrow_iterations = step->context.narrow_iterations;
    r->gathers = step->context.gathers;
    r->escapes = step->context.escapes;
    r->saved[TAHR_SHORTCUT_KNOWN_FLOOR] = (uint32_t)step->context.spared;
    r->saved[TAHR_SHORTCUT_CACHE] = (uint32_t)step->context.cached;
    r->saved[TAHR_SHORTCUT_CAPSULE_END] = (uint32_t)step->context.ends;
}

/* Asked to move, nothing in the way that it could have slid along, and yet not moved: held by an overlap. */
static void detect_stuck(tahr__step *step, const tahr_state *before)
{
    if (!(step->report.flags & (TAHR_REPORT_CRUSHED | TAHR_REPORT_UNKNOWN))) {
        return;
    }
    int wanted = length_squared(step_level(step, step->input->move)) > 0;
    if (wanted && vec_equal(step->state.position, before->position)) {
        step->report.flags |= TAHR_REPORT_STUCK;
        tahr__event(step, TAHR_EVENT_STUCK, NULL, 0);
    }
}

/* Compilers copy more than 256 bytes at once with a slow string instruction. */
static inline void copy_state(tahr_state *to, const tahr_state *from)
{
    const size_t half = sizeof *to / 2;
    memcpy(to, from, half);
    memcpy((char *)to + half, (const char *)from + half, half);
}

tahr_status tahr__take_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report, int plain)
{
    const tahr__neighbours *around = mover->company ? mover->company->neighbours : NULL;
    if (state->mode == TAHR_MODE_WALKING) {
        decay_learn(&mover->limits.decay, mover->pace.law.turn_friction, dt);
    }
    tahr__step step;
    tahr__pull pull;
    tahr__trail trail;
    step.config = &mover->config;
    step.limits = &mover->limits;
    step.custom = &mover->custom;
    step.world = mover->world;
    if (!plain &&
        (state->half_height != mover->config.shape.half_height || state->radius != mover->config.shape.radius)) {
        tahr__use_shape(&step, state->radius, state->half_height);
    }
    step.input = input;
    copy_state(&step.state, state);
    tahr__report_begin(&step.report, report);
    step.context = (tahr_query_context){.cache = mover->cache, .gathers = mover->gathers};
    mover->gathers = 0;
    step.pull = &mover->limits.pull;
    if (input->flags & TAHR_INPUT_GRAVITY) {
        pull = tahr__pull_of(along_plane(&mover->limits, input->gravity));
        step.pull = &pull;
    }
    step.ignore_body = TAHR_NO_BODY;
    step.passes = step.just_teleported = 0;
    step.dt = dt;
    step.push_left = mover->config.max_depenetration;
    step.time = step.ahead = 0;
    step.queries = 0;
    step.error = TAHR_OK;
    step.iterations = step.apexes = 0;
    step.trail = NULL;
    step.inner = NULL;
    step.onward = plain && !around && may_look_onward(mover, report) ? &mover->onward : NULL;
    step.around = around;
    step.neighbours = NULL;
    step.calm = mover->calm.on;
    step.frame_body = TAHR_NO_BODY;
    step.frame_is_base = 0;
    step.decay_mean = 0;
    if (step.world->has & TAHR__HAS_SENSORS && !step.calm) {
        tahr__trail_begin(&trail, &step);
    }
    if (dt > 0) {
        mover->busy = 1;
        mover_wake(mover);
        plain = plain && mover->plain && !around; /* and nothing will be remembered */
        run(&step, dt, plain);
        mover->busy = 0;
        if (step.error < 0) {
            return step.error;
        }
        if (mover->company && company_strays(mover->company, step.state.position)) {
            return TAHR__STRAYED;
        }
        detect_stuck(&step, state);
        if (!plain || step.state.mode != TAHR_MODE_WALKING) { /* a walk of its own gets no faster than it may be */
            cap_speed(&step.state);
        }
        if (vec_equal(step.state.position, state->position)) {
            tahr_state before;
            copy_state(&before, state);
            hand_over(&step, !plain, state);
            tahr__sleep_note(mover, &step, dt, state,
                             around || mover->calm.changed || memcmp(&before, state, sizeof before) != 0);
        } else {
            hand_over(&step, !plain, state);
        }
    }
    finish_report(&step);
    tahr__note_long_way(mover, &step.report, step.state.mode);
    if (report) {
        *report = step.report;
    }
    return step.report.flags == 0 ? TAHR_OK : tahr__step_status(step.report.flags);
}

tahr_status tahr__step_awake(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report)
{
    if (mover->busy) {
        return tahr__complain(&mover->world->log, TAHR_E_REENTRANT, "tahr_mover_step", "mover",
                              "is being stepped already");
    }
    if (mover->world->recording && !mover->is_recorded) {
        return tahr__record_step(mover, input, dt, state, report);
    }
    const int plain = state_is_blank(mover, state) && arguments_are_usual(mover, input, dt, state, report);
    if (!plain) {
        if (mover->calm.on) {
            tahr__calm_quit(mover, state);
        }
        tahr_status status = tahr__check_arguments(mover, input, dt, state, report);
        if (status < 0) {
            return status;
        }
    } else if (tahr__go_short_way(mover, input, dt, state, report)) {
        return TAHR_OK;
    }
    return tahr__take_step(mover, input, dt, state, report, plain && !input->flags);
}

tahr_status tahr_mover_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report)
{
    if (!mover) {
        return TAHR_E_NULL;
    }
    if (!input || !state) {
        return tahr__complain(&mover->world->log, TAHR_E_NULL, "tahr_mover_step", input ? "state" : "input", "is NULL");
    }
    if (mover->dozes) {
        return mover->dozes == 2 ? tahr__step_wide(mover, input, dt, state, report)
                                 : tahr__step_noted(mover, input, dt, state, report);
    }
    if (!tahr__is_quick(mover)) {
        return mover->calm.may ? tahr__step_calmly(mover, input, dt, state, report)
                               : tahr__step_awake(mover, input, dt, state, report);
    }
    return mover->wide ? tahr__quick_step_wide(mover, input, dt, state, report)
                       : tahr__quick_step(mover, input, dt, state, report);
}

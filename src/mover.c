/* SPDX-License-Identifier: MIT
 * mover.c: life cycle, entry checks, the announcement, the loop over slices of time. */
#include <string.h>

#include "core.h"
#include "elementary.h"
#include "message.h"
#include "modes.h"
#include "query.h"
#include "report.h"
#include "shape.h"
#include "sized.h"
#include "turning.h"
#include "walking.h"

/* Bytes of a state that a step works on. */
enum { USED = offsetof(tahr_state, reserved) };

/* Slices shorter than this are rounding of the times of contacts. */
static const double MIN_SLICE = 1e-9;

/* Walking and falling may hand a step to each other this often (a gap as wide as the foot); then it ends, and says so.
 * Each time costs some 40 queries to find where the floor ended. */
enum { MAX_SLICES = 6 };

static tahr__limits limits_of(const tahr_config *c)
{
    tahr__limits limits;
    double sine;
    tahr__sincos(c->walkable_angle, &sine, &limits.walkable);
    tahr__sincos(c->walkable_angle + c->walkable_hysteresis, &sine, &limits.walkable_hysteresis);
    limits.width = shape_width(&c->shape);
    return limits;
}

tahr_status tahr_mover_create(tahr_world *world, const tahr_config *config, tahr_mover **out)
{
    const char *field = NULL;
    if (!world || !out) {
        return TAHR_E_NULL;
    }
    tahr_status status = tahr_config_check(config, &field);
    if (status < 0) {
        return tahr__complain(&world->log, status, "tahr_mover_create", field ? field : "config",
                              field ? "is out of range or not finite" : tahr_status_message(status));
    }
    if (!(world->backend->capabilities & tahr__shape_capability(config->shape.type))) {
        return tahr__complain(&world->log, TAHR_E_UNSUPPORTED, "tahr_mover_create", "shape.type",
                              "is not among the backend's shapes");
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
    memcpy(&mover->config, config, sizeof mover->config);
    mover->limits = limits_of(&mover->config);
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

static const char *bad_input(const tahr_input *in)
{
    if (!vec_is_finite(in->move) || length(in->move) > 1e6) {
        return "input.move";
    }
    if ((in->flags & TAHR_INPUT_FACING) && !(vec_is_finite(in->facing) && length(in->facing) <= 1e6)) {
        return "input.facing";
    }
    if ((in->flags & TAHR_INPUT_GRAVITY) && !(vec_is_finite(in->gravity) && length(in->gravity) <= 1e4)) {
        return "input.gravity";
    }
    if (in->reserved) {
        return "input.reserved";
    }
    return in->flags & ~(uint32_t)(TAHR_INPUT_GRAVITY | TAHR_INPUT_FACING) ? "input.flags" : NULL;
}

static int all_zero(const uint8_t tail[sizeof((tahr_state *)0)->reserved])
{
    uint64_t any = 0, words[8];
    for (size_t at = 0; at < sizeof((tahr_state *)0)->reserved; at += sizeof words) {
        memcpy(words, tail + at, sizeof words);
        any |= (words[0] | words[1] | words[2] | words[3]) | (words[4] | words[5] | words[6] | words[7]);
    }
    return any == 0;
}

static const char *bad_state(const tahr_state *s, const tahr_shape *shape)
{
    tahr_quat q = s->orientation;
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    if (!vec_is_finite(s->position) || length(s->position) > 2e7) {
        return "state.position";
    }
    if (!vec_is_finite(s->velocity) || length(s->velocity) > 1e5) {
        return "state.velocity";
    }
    if (!(q2 > 1 - 1e-6 && q2 < 1 + 1e-6)) {
        return "state.orientation";
    }
    if (!(length_squared(s->up) > 1 - 1e-9 && length_squared(s->up) < 1 + 1e-9)) {
        return "state.up";
    }
    if (shape->type == TAHR_SHAPE_BOX && !(dot(rotate(s->orientation, vec(0, 0, 1)), s->up) > 1 - 1e-6)) {
        return "state.orientation";
    }
    if (!tahr__is_mode(s->mode)) {
        return "state.mode";
    }
    const uint32_t flags = TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMPING | TAHR_STATE_FLOOR_MOVED;
    if (s->flags & ~flags) {
        return "state.flags";
    }
    if (!all_zero(s->reserved)) {
        return "state.reserved";
    }
    int floor_ok = vec_is_finite(s->floor_position) && is_finite(s->floor.perch_distance) &&
                   vec_is_finite(s->floor.normal) && vec_is_finite(s->floor.surface_normal) &&
                   vec_is_finite(s->floor.point) && is_finite(s->floor.distance) && is_finite(s->jump_hold);
    return floor_ok ? NULL : "state.floor";
}

static tahr_status check_arguments(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                                   const tahr_report *report)
{
    const tahr_log *log = &mover->world->log;
    tahr_status status = tahr__sized_check(input, sizeof *input);
    if (status >= 0 && report) {
        uint32_t size;
        memcpy(&size, report, sizeof size);
        status = size < sizeof *report || size > sizeof *report + TAHR__MOST_UNKNOWN ? TAHR_E_STRUCT_SIZE : TAHR_OK;
    }
    if (status < 0) {
        return tahr__complain(log, status, "tahr_mover_step", "input or report", tahr_status_message(status));
    }
    if (!(dt >= 0 && dt <= mover->config.max_dt)) {
        return tahr__complain_value(log, TAHR_E_ARGUMENT, "tahr_mover_step", "dt", dt,
                                    "must be within 0 and config.max_dt");
    }
    const char *bad = bad_input(input);
    bad = bad ? bad : bad_state(state, &mover->config.shape);
    return bad ? tahr__complain(log, TAHR_E_ARGUMENT, "tahr_mover_step", bad, "is out of range or not finite") : TAHR_OK;
}

/* Everything that the step is expected to ask about: its motion, steps up, snaps and perches down, a few skins. */
static void announce(tahr__step *step, double dt)
{
    const tahr_config *c = step->config;
    const tahr_shape *s = &c->shape;
    vec3 v = step->state.velocity;
    double g = length(step->gravity);
    double level = max_of(length(v), c->max_speed) * dt + 4 * c->skin;
    double fall = step->state.mode == TAHR_MODE_FALLING ? 0.5 * g * dt * dt : 0;
    double rise = max_of(c->step_height, c->jump_speed * dt) + level;
    double drop = c->snap_distance + c->perch_extra + fall + level;
    vec3 up = step->state.up;
    vec3 away = vec(max_of(up.x, -up.x), max_of(up.y, -up.y), max_of(up.z, -up.z));
    double width = s->type == TAHR_SHAPE_BOX ? sqrt(s->half_x * s->half_x + s->half_y * s->half_y) : s->radius;
    double core = s->half_height - (s->type == TAHR_SHAPE_BOX ? 0 : s->radius);
    double around = width + level;
    vec3 half = add_scaled(vec(around, around, around), away, core);
    vec3 top = scale(up, rise - level), bottom = scale(up, level - drop);
    vec3 p = step->state.position;
    tahr_bounds b;
    b.min = sub(add(p, vec(min_of(top.x, bottom.x), min_of(top.y, bottom.y), min_of(top.z, bottom.z))), half);
    b.max = add(add(p, vec(max_of(top.x, bottom.x), max_of(top.y, bottom.y), max_of(top.z, bottom.z))), half);
    tahr__announce(step, &b);
}

/* A jump starts when the button goes down on ground. */
static void begin_jump(tahr__step *step)
{
    tahr_state *s = &step->state;
    int held = (s->flags & TAHR_STATE_JUMP_HELD) != 0;
    if (!step->input.jump) {
        s->flags &= ~(uint32_t)TAHR_STATE_JUMP_HELD;
        s->jump_hold = 0;
        return;
    }
    s->flags |= TAHR_STATE_JUMP_HELD;
    if (held || s->mode != TAHR_MODE_WALKING) {
        return;
    }
    tahr__leave_floor(step);
    s->velocity = add_scaled(s->velocity, s->up, step->config->jump_speed);
    s->jump_hold = step->config->jump_hold_time;
    s->flags |= TAHR_STATE_JUMPING;
    s->floor_revision = 0;
    tahr__event(step, TAHR_EVENT_JUMPED, NULL, step->config->jump_speed);
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, 0);
    tahr__decide(step, TAHR_RULE_JUMP, 1, NULL, step->config->jump_speed, 0, "button went down on ground");
    tahr__change_mode(step, TAHR_MODE_FALLING);
}

static void run(tahr__step *step, double dt)
{
    tahr__right(step);
    tahr__face(step, dt);
    begin_jump(step);
    announce(step, dt);
    double left = dt;
    while (left > MIN_SLICE && step->error >= 0 && step->report.slices < MAX_SLICES &&
           !(step->report.flags & TAHR_REPORT_QUERY_CAP)) {
        step->report.slices++;
        left = tahr__run_mode(step, left);
    }
    if (left > MIN_SLICE) {
        step->report.time_lost += left;
    }
}

static void clean(vec3 *v)
{
    v->x += 0.0;
    v->y += 0.0;
    v->z += 0.0;
}

/* -0.0 and 0.0 are one number; a state holds only one of them, so that memcmp agrees with ==. */
static void canonical(tahr_state *s)
{
    clean(&s->position);
    clean(&s->velocity);
    s->orientation.x += 0.0;
    s->orientation.y += 0.0;
    s->orientation.z += 0.0;
    s->orientation.w += 0.0;
    clean(&s->up);
    clean(&s->floor.normal);
    clean(&s->floor.surface_normal);
    clean(&s->floor.point);
    clean(&s->floor_position);
    s->floor.distance += 0.0;
    s->floor.perch_distance += 0.0;
    s->jump_hold += 0.0;
}

static tahr_status worst(uint32_t flags)
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

static void start_report(tahr_report *r, const tahr_report *user)
{
    memset(r, 0, sizeof *r);
    r->struct_size = sizeof *r;
    if (user) {
        r->struct_size = user->struct_size;
        r->events = user->events;
        r->event_capacity = user->events ? user->event_capacity : 0;
        r->decisions = user->decisions;
        r->decision_capacity = user->decisions ? user->decision_capacity : 0;
    }
}

static void finish_report(tahr__step *step)
{
    tahr_report *r = &step->report;
    r->triangle_tests = step->context.narrow_tests;
    r->narrow_iterations = step->context.narrow_iterations;
    r->gathers = step->context.gathers;
    r->escapes = step->context.escapes;
}

/* Asked to move, nothing in the way that it could have slid along, and yet not moved: held by an overlap. */
static void detect_stuck(tahr__step *step, const tahr_state *before)
{
    int wanted = length_squared(step_level(step, step->input.move)) > 0;
    int moved = !vec_equal(step->state.position, before->position);
    if (wanted && !moved && (step->report.flags & (TAHR_REPORT_CRUSHED | TAHR_REPORT_UNKNOWN))) {
        step->report.flags |= TAHR_REPORT_STUCK;
        tahr__event(step, TAHR_EVENT_STUCK, NULL, 0);
    }
}

tahr_status tahr_mover_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    if (!mover || !input || !state) {
        return TAHR_E_NULL;
    }
    if (mover->busy) {
        return tahr__complain(&mover->world->log, TAHR_E_REENTRANT, "tahr_mover_step", "mover",
                              "is being stepped already");
    }
    tahr_status status = check_arguments(mover, input, dt, state, report);
    if (status < 0) {
        return status;
    }
    tahr__step step;
    step.config = &mover->config;
    step.limits = &mover->limits;
    step.world = mover->world;
    step.input = *input;
    memcpy(&step.state, state, USED); /* the tail is zero on both sides of a step, and stays where it is */
    start_report(&step.report, report);
    memset(&step.context, 0, sizeof step.context);
    step.context.cache = mover->cache;
    step.gravity = input->flags & TAHR_INPUT_GRAVITY ? input->gravity : mover->config.gravity;
    step.time = 0;
    step.ahead = 0;
    step.push_left = mover->config.max_depenetration;
    step.queries = 0;
    step.error = TAHR_OK;
    if (dt > 0) {
        mover->busy = 1;
        run(&step, dt);
        mover->busy = 0;
        if (step.error < 0) {
            return step.error;
        }
        canonical(&step.state);
        detect_stuck(&step, state);
        memcpy(state, &step.state, USED);
    }
    finish_report(&step);
    if (report) {
        *report = step.report;
    }
    return worst(step.report.flags);
}

/* SPDX-License-Identifier: MIT
 * mover.c: life cycle, entry checks, the announcement, the loop over slices of time. */
#include <string.h>

#include "core.h"
#include "elementary.h"
#include "floor.h"
#include "message.h"
#include "modes.h"
#include "query.h"
#include "report.h"
#include "shape.h"
#include "sized.h"
#include "sleep.h"
#include "turning.h"
#include "walking.h"

/* Bytes of a state that a step works on. */
enum { USED = offsetof(tahr_state, reserved) };

/* Slices shorter than this are rounding of the times of contacts. */
static const double MIN_SLICE = 1e-9;

/* Walking and falling may hand a step to each other this often (a gap as wide as the foot); then it ends, and says so.
 * Each time costs some 40 queries to find where the floor ended. */
enum { MAX_SLICES = 6 };

static tahr__pull pull_of(vec3 gravity)
{
    double size = length(gravity);
    tahr__pull pull = {gravity, size, size > 0 ? scale(gravity, -1.0 / size) : vec(0, 0, 0)};
    return pull;
}

static tahr__limits limits_of(const tahr_config *c, uint32_t capabilities)
{
    tahr__limits limits;
    double sine;
    tahr__sincos(c->walkable_angle, &sine, &limits.walkable);
    tahr__sincos(c->walkable_angle + c->walkable_hysteresis, &sine, &limits.walkable_hysteresis);
    const tahr_shape *s = &c->shape;
    int box = s->type == TAHR_SHAPE_BOX;
    limits.width = shape_width(s);
    limits.around = box ? sqrt(s->half_x * s->half_x + s->half_y * s->half_y) : s->radius;
    limits.axis = s->half_height - (box ? 0 : s->radius);
    limits.pull = pull_of(c->gravity);
    limits.foot = tahr__foot_of(s, capabilities);
    return limits;
}

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
    mover->limits = limits_of(&mover->config, world->backend->capabilities);
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

/* False too for what is not finite: its square is not either. */
static int is_within(vec3 v, double most)
{
    return length_squared(v) <= most * most;
}

static const char *bad_input(const tahr_input *in)
{
    if (!is_within(in->move, 1e6)) {
        return "input.move";
    }
    if ((in->flags & TAHR_INPUT_FACING) && !is_within(in->facing, 1e6)) {
        return "input.facing";
    }
    if ((in->flags & TAHR_INPUT_GRAVITY) && !is_within(in->gravity, 1e4)) {
        return "input.gravity";
    }
    if (in->reserved) {
        return "input.reserved";
    }
    return in->flags & ~(uint32_t)(TAHR_INPUT_GRAVITY | TAHR_INPUT_FACING) ? "input.flags" : NULL;
}

static int all_zero(const uint8_t tail[sizeof((tahr_state *)0)->reserved])
{
    uint64_t any = 0, word;
    for (size_t at = 0; at < sizeof((tahr_state *)0)->reserved; at += sizeof word) {
        memcpy(&word, tail + at, sizeof word);
        any |= word;
    }
    return any == 0;
}

/* A sum is finite only if all its terms are (and no floor is so far away that it overflows). */
static const char *bad_floor(const tahr_state *s)
{
    const tahr_floor *f = &s->floor;
    const vec3 n = f->normal, surface = f->surface_normal, point = f->point, at = s->floor_position;
    double sum = n.x + n.y + n.z + surface.x + surface.y + surface.z + point.x + point.y + point.z + f->distance;
    if (is_finite(sum + f->perch_distance + at.x + at.y + at.z + s->jump_hold)) {
        return NULL;
    }
    if (!vec_is_finite(n)) {
        return "state.floor.normal";
    }
    if (!vec_is_finite(surface)) {
        return "state.floor.surface_normal";
    }
    if (!vec_is_finite(point)) {
        return "state.floor.point";
    }
    if (!vec_is_finite(at)) {
        return "state.floor_position";
    }
    if (!is_finite(s->jump_hold)) {
        return "state.jump_hold";
    }
    if (!is_finite(f->perch_distance)) {
        return "state.floor.perch_distance";
    }
    return is_finite(f->distance) ? "state.floor" : "state.floor.distance";
}

static const char *bad_state(const tahr_state *s, const tahr_shape *shape)
{
    tahr_quat q = s->orientation;
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    double up2 = length_squared(s->up);
    if (!is_within(s->position, 2e7)) {
        return "state.position";
    }
    if (!is_within(s->velocity, 1e5)) {
        return "state.velocity";
    }
    if (!(q2 > 1 - 1e-6 && q2 < 1 + 1e-6)) {
        return "state.orientation";
    }
    if (!(up2 > 1 - 1e-9 && up2 < 1 + 1e-9)) {
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
    return bad_floor(s);
}

static tahr_status check_arguments(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                                   const tahr_report *report)
{
    const tahr_log *log = &mover->world->log;
    tahr_status status = tahr__sized_check(input, sizeof *input);
    if (status < 0) {
        return tahr__complain(log, status, "tahr_mover_step", "input:", tahr_status_message(status));
    }
    if (report) {
        uint32_t size;
        memcpy(&size, report, sizeof size);
        if (size < sizeof *report || size > sizeof *report + TAHR__MOST_UNKNOWN) {
            return tahr__complain(log, TAHR_E_STRUCT_SIZE, "tahr_mover_step",
                                  "report:", tahr_status_message(TAHR_E_STRUCT_SIZE));
        }
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
    vec3 v = step->state.velocity;
    double level = max_of(length(v), c->max_speed) * dt + 4 * c->skin;
    double fall = step->state.mode == TAHR_MODE_FALLING ? 0.5 * step->pull->size * dt * dt : 0;
    double rise = max_of(c->step_height, c->jump_speed * dt);
    double drop = c->snap_distance + c->perch_extra + fall;
    vec3 up = step->state.up, p = step->state.position;
    vec3 away = vec(max_of(up.x, -up.x), max_of(up.y, -up.y), max_of(up.z, -up.z));
    double around = step->limits->around + level;
    vec3 half = add_scaled(vec(around, around, around), away, step->limits->axis + 0.5 * (rise + drop));
    vec3 middle = add_scaled(p, up, 0.5 * (rise - drop));
    tahr_prepare a = {.bounds = {sub(middle, half), add(middle, half)}, .position = p, .up = up, .mask = c->mask};
    tahr__announce(step, &a);
}

/* A jump starts when the button goes down on ground. */
static void begin_jump(tahr__step *step)
{
    tahr_state *s = &step->state;
    int held = (s->flags & TAHR_STATE_JUMP_HELD) != 0;
    if (!step->input->jump) {
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
    if (!is_upright(step)) {
        tahr__right(step);
    }
    if (step->input->flags & TAHR_INPUT_FACING) {
        tahr__face(step, dt);
    }
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

static vec3 clean(vec3 v)
{
    return vec(v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

/* -0.0 and 0.0 are one number; the caller's state holds only one of them, so that memcmp agrees with ==. The tail is
 * zero on both sides of a step, and stays where it is. */
static void hand_over(const tahr_state *s, tahr_state *out)
{
    const tahr_quat q = s->orientation;
    out->position = clean(s->position);
    out->velocity = clean(s->velocity);
    out->orientation = (tahr_quat){q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};
    out->up = clean(s->up);
    out->mode = s->mode;
    out->flags = s->flags;
    out->floor.normal = clean(s->floor.normal);
    out->floor.surface_normal = clean(s->floor.surface_normal);
    out->floor.point = clean(s->floor.point);
    out->floor.distance = s->floor.distance + 0.0;
    out->floor.perch_distance = s->floor.perch_distance + 0.0;
    out->floor.flags = s->floor.flags;
    out->floor.body = s->floor.body;
    out->floor.feature = s->floor.feature;
    out->floor.surface = s->floor.surface;
    out->floor_position = clean(s->floor_position);
    out->floor_revision = s->floor_revision;
    out->jump_hold = s->jump_hold + 0.0;
}

static tahr_status worst(uint32_t flags)
{
    if (flags == 0) {
        return TAHR_OK;
    }
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
    const size_t half = sizeof *r / 2; /* compilers clear more than 96 bytes at once with a slow string instruction */
    memset(r, 0, half);
    memset((char *)r + half, 0, sizeof *r - half);
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
    if (!(step->report.flags & (TAHR_REPORT_CRUSHED | TAHR_REPORT_UNKNOWN))) {
        return;
    }
    int wanted = length_squared(step_level(step, step->input->move)) > 0;
    if (wanted && vec_equal(step->state.position, before->position)) {
        step->report.flags |= TAHR_REPORT_STUCK;
        tahr__event(step, TAHR_EVENT_STUCK, NULL, 0);
    }
}

tahr_status tahr_mover_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    if (!mover) {
        return TAHR_E_NULL;
    }
    if (!input || !state) {
        return tahr__complain(&mover->world->log, TAHR_E_NULL, "tahr_mover_step", input ? "state" : "input", "is NULL");
    }
    if (mover->busy) {
        return tahr__complain(&mover->world->log, TAHR_E_REENTRANT, "tahr_mover_step", "mover",
                              "is being stepped already");
    }
    tahr_status status = check_arguments(mover, input, dt, state, report);
    if (status < 0) {
        return status;
    }
    if (mover->sleep.noted && tahr__sleeps_on(mover, input, dt, state, report)) {
        if (report) {
            tahr__sleep_report(mover, report);
        }
        return worst(mover->sleep.report.flags);
    }
    tahr__step step;
    tahr__pull pull;
    step.config = &mover->config;
    step.limits = &mover->limits;
    step.world = mover->world;
    step.input = input;
    memcpy(&step.state, state, USED);
    start_report(&step.report, report);
    step.context = (tahr_query_context){.cache = mover->cache};
    step.pull = &mover->limits.pull;
    if (input->flags & TAHR_INPUT_GRAVITY) {
        pull = pull_of(input->gravity);
        step.pull = &pull;
    }
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
        detect_stuck(&step, state);
        if (vec_equal(step.state.position, state->position)) {
            const tahr_state before = *state;
            hand_over(&step.state, state);
            tahr__sleep_note(mover, &step, dt, state, memcmp(&before, state, sizeof before) != 0);
        } else {
            hand_over(&step.state, state);
            mover->sleep.noted = 0;
        }
    }
    finish_report(&step);
    if (report) {
        *report = step.report;
    }
    return worst(step.report.flags);
}

/* SPDX-License-Identifier: MIT
 * record.c: a recorder takes its place between a world and its backend, and is told of what no backend sees. */
#include "record.h"

#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "callbacks.h"
#include "calm.h"
#include "message.h"
#include "scene.h"
#include "sized.h"

static const char FUNCTION[] = "tahr_world_record";

static tahr_record_body body_of(const tahr__body_note *n)
{
    tahr_record_body b = {.pose = n->pose,
                          .before = n->before,
                          .surface_velocity = n->surface_velocity,
                          .dt = n->dt,
                          .reach = n->reach,
                          .mass = n->mass,
                          .fluid_friction = n->fluid_friction,
                          .pose_hash = n->pose_hash,
                          .motion_hash = n->motion_hash,
                          .flags = n->flags,
                          .jumped = n->jumped};
    return b;
}

static tahr__body_note note_of(const tahr_record_body *b)
{
    tahr__body_note n = {.pose = b->pose,
                         .before = b->before,
                         .surface_velocity = b->surface_velocity,
                         .dt = b->dt,
                         .reach = b->reach,
                         .mass = b->mass,
                         .fluid_friction = b->fluid_friction,
                         .pose_hash = b->pose_hash,
                         .motion_hash = b->motion_hash,
                         .flags = b->flags,
                         .jumped = b->jumped};
    return n;
}

/* Where a body may be and how it may move, by the rules of tahr_world_open and _move. Returns the field that is not so,
 * or NULL. */
static const char *bad_body(const tahr_record_body *b)
{
    if (tahr__bad_pose(&b->pose, 0) || tahr__bad_pose(&b->before, 0)) {
        return tahr__bad_pose(&b->pose, 0) ? "pose" : "before";
    }
    if (!vec_is_finite(b->surface_velocity)) {
        return "surface_velocity";
    }
    if (!(b->dt >= 0 && b->dt <= 10)) {
        return "dt";
    }
    if (!(b->reach >= 0 && is_finite(b->reach))) {
        return "reach";
    }
    if (!(b->mass >= 0 && is_finite(b->mass))) {
        return "mass";
    }
    return b->fluid_friction >= 0 && is_finite(b->fluid_friction) ? NULL : "fluid_friction";
}

static const char *bad_world(const tahr_world *world, const tahr_record_world *w, const tahr_record_body *bodies)
{
    const uint32_t known =
        TAHR__HAS_SENSORS | TAHR__HAS_FLUIDS | TAHR__HAS_BASES | TAHR__HAS_MOVING_SENSORS | TAHR__HAS_SQUEEZERS;
    if (w->bodies != bodies || w->body_count != world->body_count) {
        return w->bodies != bodies ? "bodies" : "body_count";
    }
    if (w->revision == 0 || w->has & ~known) {
        return w->revision == 0 ? "revision" : "has";
    }
    return w->derived > TAHR__MOST_PROBES ? "derived" : NULL;
}

/* What was restored comes from outside, perhaps from a file. */
static tahr_status check_restored(const tahr_world *world, const tahr_record_world *w, const tahr_record_body *bodies)
{
    char text[120] = "";
    const char *bad = bad_world(world, w, bodies);
    if (bad) {
        snprintf(text, sizeof text, "restored what no world can be: %s", bad);
    }
    for (uint32_t i = 0; i < world->body_count && !bad; i++) {
        bad = bad_body(&bodies[i]);
        if (bad) {
            snprintf(text, sizeof text, "restored what no world can be: bodies[%u].%s", i, bad);
        }
    }
    return bad ? tahr__complain(&world->log, TAHR_E_ARGUMENT, FUNCTION, "recorder.begin", text) : TAHR_OK;
}

static tahr_status restore(tahr_world *world, const tahr_record_world *w, const tahr_record_body *bodies)
{
    tahr_status status = check_restored(world, w, bodies);
    if (status < 0) {
        return status;
    }
    world->revision = w->revision;
    world->motion = w->motion;
    world->last_revision = w->last_revision;
    world->has = w->has;
    world->moves = w->moves;
    world->derived = w->derived;
    world->moved_count = 0;
    world_unrest(world);
    for (uint32_t i = 0; i < world->body_count; i++) {
        world->bodies[i] = note_of(&bodies[i]);
        if (bodies[i].dt > 0) {
            world->moved[world->moved_count++] = i;
        }
    }
    return TAHR_OK;
}

/* Asks the recorder in, with bodies as room to tell it of the world's. */
static tahr_status begin(tahr_world *world, const tahr_recorder *recorder, tahr_record_body *bodies)
{
    tahr_record_world w = {.backend = world->backend,
                           .self = world->self,
                           .bodies = bodies,
                           .revision = world->revision,
                           .motion = world->motion,
                           .last_revision = world->last_revision,
                           .body_count = world->body_count,
                           .has = world->has,
                           .moves = world->moves,
                           .derived = world->derived};
    for (uint32_t i = 0; i < world->body_count; i++) {
        bodies[i] = body_of(&world->bodies[i]);
    }
    tahr_status status = recorder->begin ? recorder->begin(recorder->user, &w) : TAHR_OK;
    if (status < 0) {
        return tahr__complain(&world->log, status, FUNCTION, "recorder.begin:", tahr_status_message(status));
    }
    if (recorder->flags & TAHR_RECORDER_RESTORES) {
        status = restore(world, &w, bodies);
    }
    if (status < 0) {
        if (recorder->end) {
            recorder->end(recorder->user);
        }
        return status;
    }
    world->backend = w.backend;
    world->self = w.self;
    return TAHR_OK;
}

/* A number of its own for every recording, so that movers are numbered anew. */
static uint32_t next_round(const tahr_world *world)
{
    return world->record_round + 1 + (world->record_round == 0xFFFFFFFFu);
}

tahr_status tahr_world_record(tahr_world *world, const tahr_recorder *recorder)
{
    if (!world) {
        return TAHR_E_NULL;
    }
    if (world->recording && world->recording->busy) {
        return tahr__complain(&world->log, TAHR_E_REENTRANT, FUNCTION, "world", "is inside of a recorded step");
    }
    tahr_status status = recorder ? tahr__sized_check(recorder, sizeof *recorder) : TAHR_OK;
    if (status >= 0 && recorder && recorder->flags & ~(uint32_t)TAHR_RECORDER_RESTORES) {
        status = TAHR_E_UNSUPPORTED;
    }
    if (status < 0) {
        return tahr__complain(&world->log, status, FUNCTION, "recorder:", tahr_status_message(status));
    }
    tahr__record_end(world);
    if (!recorder) {
        return TAHR_OK;
    }
    const tahr_allocator a = world->host.allocator;
    const size_t room = (world->body_count + (size_t)1) * sizeof(tahr_record_body); /* one more: never nothing */
    struct tahr__recording *r = a.alloc(a.user, sizeof *r, 8);
    tahr_record_body *bodies = r ? a.alloc(a.user, room, 8) : NULL;
    if (bodies) {
        *r = (struct tahr__recording){
            .recorder = *recorder, .backend = world->backend, .self = world->self, .derived = world->derived};
        status = begin(world, recorder, bodies);
        a.free(a.user, bodies, room, 8);
    } else {
        status = tahr__complain(&world->log, TAHR_E_MEMORY, FUNCTION, "allocator", "returned NULL");
    }
    if (status < 0) {
        if (r) {
            a.free(a.user, r, sizeof *r, 8);
        }
        return status;
    }
    world->recording = r;
    world->record_round = next_round(world);
    return TAHR_OK;
}

void tahr__record_end(tahr_world *world)
{
    struct tahr__recording *r = world->recording;
    if (!r) {
        return;
    }
    const tahr_allocator a = world->host.allocator;
    world->backend = r->backend;
    world->self = r->self;
    world->derived = r->derived;
    world->recording = NULL;
    if (r->recorder.end) {
        r->recorder.end(r->recorder.user);
    }
    a.free(a.user, r, sizeof *r, 8);
}

static void tell_begin(tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state, int events)
{
    tahr_world *world = mover->world;
    struct tahr__recording *r = world->recording;
    if (mover->record_round != world->record_round) {
        mover->record_round = world->record_round;
        mover->record_number = r->movers++;
    }
    const int custom = mover->custom.run && (state->mode == TAHR_MODE_CUSTOM || (input->flags & TAHR_INPUT_MODE));
    const tahr_record_step s = {.mover = mover->record_number,
                                .flags = (custom ? (uint32_t)TAHR_RECORD_CUSTOM : 0u) |
                                         (events ? (uint32_t)TAHR_RECORD_EVENTS : 0u),
                                .config = &mover->config,
                                .input = input,
                                .state = state,
                                .dt = dt};
    if (r->recorder.step) {
        r->recorder.step(r->recorder.user, &s);
    }
}

static void tell_end(const tahr_mover *mover, tahr_status status, const tahr_state *state)
{
    const tahr_recorder *recorder = &mover->world->recording->recorder;
    const tahr_record_done d = {mover->record_number, status, tahr_state_hash(state), state};
    if (recorder->done) {
        recorder->done(recorder->user, &d);
    }
}

tahr_status tahr__record_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                              tahr_report *report)
{
    struct tahr__recording *r = mover->world->recording;
    tahr_status status = tahr__check_arguments(mover, input, dt, state, report);
    if (status < 0) {
        return status;
    }
    if (r->busy) {
        return tahr__complain(&mover->world->log, TAHR_E_REENTRANT, "tahr_mover_step", "world",
                              "is recorded, and another step of it under way");
    }
    r->busy = 1;
    tell_begin(mover, input, dt, state, report && report->events);
    mover->sleep.noted = 0; /* what happens is to be seen */
    mover->is_recorded = 1;
    status = tahr_mover_step(mover, input, dt, state, report);
    mover->is_recorded = 0;
    tell_end(mover, status, state);
    r->busy = 0;
    return status;
}

void tahr__record_move(const tahr_world *world, uint32_t kind, const tahr_body_pose *poses, uint32_t count, double dt)
{
    const tahr_recorder *recorder = &world->recording->recorder;
    const tahr_record_move m = {kind, count, poses, dt};
    if (recorder->move) {
        recorder->move(recorder->user, &m);
    }
}

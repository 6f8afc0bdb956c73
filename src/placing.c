/* SPDX-License-Identifier: MIT
 * placing.c: putting movable bodies somewhere else: at rest, or by a motion that carries and pushes. */
#include "placing.h"

#include <stdio.h>
#include <string.h>

#include "body_motion.h"
#include "calm.h"
#include "message.h"
#include "record.h"
#include "scene.h"

/* Sine of half a turn about anything but z that is the rounding of a float. */
static const double ASKEW = 1e-6;

/* Does a body turn out of the world, if that has two dimensions? How it lies there at first is the backend's matter. */
static int turns_out(const tahr_world *world, const tahr_body_pose *p)
{
    tahr_quat d = quat_multiply(p->pose.orientation, quat_inverse(world->bodies[p->body].pose.orientation));
    return world_is_planar(world) && d.x * d.x + d.y * d.y > ASKEW * ASKEW;
}

static tahr_status check_placement(const tahr_world *world, const char *function, const tahr_body_pose *p, uint32_t i,
                                   uint32_t flags)
{
    char name[64];
    const char *field = p->body >= world->body_count ? "body" : tahr__bad_pose(&p->pose, 0);
    snprintf(name, sizeof name, "poses[%u].%s", i, field ? field : (p->flags & ~flags ? "flags" : "body"));
    if (p->body >= world->body_count) {
        return tahr__complain_value(&world->log, TAHR_E_NOT_FOUND, function, name, p->body, "no such body");
    }
    if (field) {
        return tahr__complain(&world->log, TAHR_E_ARGUMENT, function, name, "is out of range or not finite");
    }
    if (p->flags & ~flags) {
        return tahr__complain(&world->log, TAHR_E_ARGUMENT, function, name, flags ? "are unknown" : "is not 0");
    }
    if (!(world->bodies[p->body].flags & TAHR_BODY_MOVABLE)) {
        return tahr__complain_value(&world->log, TAHR_E_ARGUMENT, function, name, p->body,
                                    "a body without TAHR_BODY_MOVABLE");
    }
    if (turns_out(world, p)) {
        snprintf(name, sizeof name, "poses[%u].pose.orientation", i);
        return tahr__complain(&world->log, TAHR_E_ARGUMENT, function, name,
                              "turns out of the plane: the world has two dimensions, x and y");
    }
    return TAHR_OK;
}

/* Checks everything, then tells the backend: nothing has changed if that fails. flags: those that are allowed. */
static tahr_status place(tahr_world *world, const char *function, const tahr_body_pose *poses, uint32_t count,
                         uint32_t flags)
{
    if (!poses && count > 0) {
        return tahr__complain(&world->log, TAHR_E_NULL, function, "poses", "is NULL, but count is not 0");
    }
    if (!world->backend->place) {
        return tahr__complain(&world->log, TAHR_E_UNSUPPORTED, function, world->backend->name, "cannot place bodies");
    }
    for (uint32_t i = 0; i < count; i++) {
        tahr_status bad = check_placement(world, function, &poses[i], i, flags);
        if (bad < 0) {
            return bad;
        }
    }
    tahr__enter_backend(world, function);
    return tahr__leave_backend(world, world->backend, world->backend->place(world->self, poses, count));
}

static void take_pose(tahr_world *world, const tahr_body_pose *p)
{
    tahr__body_note *note = &world->bodies[p->body];
    uint64_t old = note->pose_hash;
    note->pose_hash = tahr__hash_pose(p->body, &p->pose);
    tahr__move_revision(world, note->pose_hash - old);
    note->pose = (tahr_pose){p->pose.position, quat_unit(p->pose.orientation)};
}

static void rest(tahr_world *world, tahr__body_note *note)
{
    note->before = note->pose;
    note->dt = 0;
    world->motion -= note->motion_hash;
    note->motion_hash = 0;
}

/* In the order of ids, so that the caller's order does not matter; once. */
static void list_moved(tahr_world *world, uint32_t body)
{
    uint32_t at = world->moved_count;
    while (at > 0 && world->moved[at - 1] > body) {
        at--;
    }
    if (at > 0 && world->moved[at - 1] == body) {
        return;
    }
    for (uint32_t i = world->moved_count++; i > at; i--) {
        world->moved[i] = world->moved[i - 1];
    }
    world->moved[at] = body;
}

static void unlist_resting(tahr_world *world)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < world->moved_count; i++) {
        world->moved[kept] = world->moved[i];
        kept += world->bodies[world->moved[i]].dt > 0;
    }
    world->moved_count = kept;
}

tahr_status tahr_world_set(tahr_world *world, const tahr_body_pose *poses, uint32_t count)
{
    if (!world) {
        return TAHR_E_NULL;
    }
    tahr_status status = place(world, "tahr_world_set", poses, count, 0);
    if (status >= 0) {
        tahr__specials_go(world, poses, count);
    }
    for (uint32_t i = 0; i < count && status >= 0; i++) {
        tahr__body_note *note = &world->bodies[poses[i].body];
        take_pose(world, &poses[i]);
        rest(world, note);
        note->jumped = world->moves;
    }
    if (status >= 0) {
        unlist_resting(world);
        world->last_revision = 0;
    }
    if (status >= 0 && world->recording) {
        tahr__record_move(world, TAHR_RECORD_SET, poses, count, 0);
    }
    return status;
}

/* A motion that changes nothing is none. */
static void move_body(tahr_world *world, const tahr_body_pose *p, double dt)
{
    tahr__body_note *note = &world->bodies[p->body];
    const tahr_pose before = note->before;
    take_pose(world, p);
    rest(world, note);
    note->jumped = p->flags & TAHR_POSE_TELEPORT ? world->moves : 0;
    if (note->jumped || pose_equal(&before, &note->pose)) {
        return;
    }
    note->before = before;
    note->dt = dt;
    const tahr_pose span = {vec(dt, 0, 0), {0, 0, 0, 0}};
    note->motion_hash = tahr__hash_pose(~p->body, &before) + tahr__hash_pose(~p->body, &span);
    world->motion += note->motion_hash;
}

tahr_status tahr_world_move(tahr_world *world, const tahr_body_pose *poses, uint32_t count, double dt)
{
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!(dt > 0 && dt <= 10)) {
        return tahr__complain_value(&world->log, TAHR_E_ARGUMENT, "tahr_world_move", "dt", dt,
                                    "must be within 0 and 10 s");
    }
    tahr_status status = place(world, "tahr_world_move", poses, count, TAHR_POSE_TELEPORT);
    if (status < 0) {
        return status;
    }
    for (uint32_t i = 0; i < world->moved_count; i++) {
        rest(world, &world->bodies[world->moved[i]]);
    }
    tahr__specials_go(world, poses, count);
    world->moved_count = 0;
    world->moves++;
    world->last_revision = world->revision;
    for (uint32_t i = 0; i < count; i++) {
        move_body(world, &poses[i], dt);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (world->bodies[poses[i].body].dt > 0) {
            list_moved(world, poses[i].body);
        }
        if (poses[i].flags & TAHR_POSE_TELEPORT) {
            world->last_revision = 0;
        }
    }
    if (world->recording) {
        tahr__record_move(world, TAHR_RECORD_MOVE, poses, count, dt);
    }
    return status;
}

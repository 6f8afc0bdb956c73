/* SPDX-License-Identifier: MIT
 * world.c: a scene behind one backend: opening, checking, placing bodies, closing. */
#include <stdio.h>
#include <string.h>

#include "backend_check.h"
#include "callbacks.h"
#include "calm.h"
#include "core.h"
#include "float_mode.h"
#include "message.h"
#include "placing.h"
#include "record.h"
#include "scene.h"
#include "sized.h"
#include "world_memory.h"

/* A description with nothing in it but its size. */
static tahr_status clear_sized(void *desc, size_t size, size_t least)
{
    const uint32_t struct_size = (uint32_t)size;
    if (!desc) {
        return TAHR_E_NULL;
    }
    if (size < least) {
        return TAHR_E_STRUCT_SIZE;
    }
    memset(desc, 0, size);
    memcpy(desc, &struct_size, sizeof struct_size);
    return TAHR_OK;
}

tahr_status tahr_world_desc_init(tahr_world_desc *desc, size_t size)
{
    return clear_sized(desc, size, sizeof *desc);
}

tahr_status tahr_body_desc_init(tahr_body_desc *desc, size_t size, uint32_t type)
{
    tahr_status status = clear_sized(desc, size, sizeof *desc);
    if (status >= 0) {
        desc->type = type;
        desc->mask = 0xFFFFFFFFu;
        desc->pose.orientation.w = 1;
    }
    return status;
}

static void silent(void *user, int32_t level, const char *message)
{
    (void)user, (void)level, (void)message;
}

/* The log of a description, if it can be trusted to be one. */
static const tahr_log *log_of(const tahr_world_desc *desc)
{
    tahr_status status = tahr__sized_check(desc, sizeof *desc);
    return status == TAHR_OK || status == TAHR_E_UNSUPPORTED ? desc->log : NULL;
}

/* A backend does not know on whose behalf it complains: outside of what has the world for itself, its own name must
 * do. */
static void write_named(void *user, int32_t level, const char *message)
{
    tahr_world *world = user;
    if (world->calling) {
        world->complaints += level == TAHR_LOG_ERROR;
    }
    tahr__say(&world->log, level, world->calling ? world->calling : world->backend->name, message);
}

void tahr__enter_backend(tahr_world *world, const char *function)
{
    world->calling = function;
    world->complaints = 0;
}

tahr_status tahr__leave_backend(tahr_world *world, const tahr_backend *backend, tahr_status status)
{
    if (status < 0 && world->complaints == 0) {
        char text[128];
        snprintf(text, sizeof text, "backend %.40s: %s", backend->name, tahr_status_message(status));
        tahr__say(&world->log, TAHR_LOG_ERROR, world->calling, text);
    }
    world->calling = NULL;
    return status;
}

/* Everything both ways of opening share: the handle, its allocator and log, the checks of the machine. */
static tahr_status new_world(const char *function, const tahr_world_desc *desc, size_t extra, tahr_world **out)
{
    tahr__memory memory = {desc && desc->allocator ? *desc->allocator : tahr__malloc, 0};
    tahr_log log = {NULL, silent};
    if (desc && desc->log && desc->log->write) {
        log = *desc->log;
    }
    if (!memory.user.alloc || !memory.user.free) {
        return tahr__complain(&log, TAHR_E_NULL, function, memory.user.alloc ? "allocator.free" : "allocator.alloc",
                              "is NULL");
    }
    const char *problem = tahr__float_mode_problem();
    if (problem) {
        return tahr__complain(&log, TAHR_E_FLOAT_MODE, function, "the floating-point mode:", problem);
    }
    tahr_world *world = memory.user.alloc(memory.user.user, sizeof *world + extra, 64);
    if (!world) {
        return tahr__complain(&log, TAHR_E_MEMORY, function, "allocator", "returned NULL");
    }
    memset(world, 0, sizeof *world + extra);
    world->memory = memory;
    world->memory.bytes = sizeof *world + extra;
    world->log = log;
    world->host.struct_size = sizeof world->host;
    world->host.abi = TAHR_ABI;
    world->host.allocator = tahr__counting_allocator(&world->memory);
    world->host.log = (tahr_log){world, write_named};
    world->revision = 1;
    world->ground = 1;
    world->moves = 1;
    *out = world;
    return TAHR_OK;
}

static void free_world(tahr_world *world, size_t extra)
{
    tahr_allocator counting = world->host.allocator;
    counting.free(counting.user, world->bodies, world->body_count * sizeof *world->bodies, 8);
    tahr__specials_free(world);
    counting.free(counting.user, world->moved, world->body_count * sizeof *world->moved, 8);
    tahr_allocator user = world->memory.user;
    user.free(user.user, world, sizeof *world + extra, 64);
}

uint64_t tahr__hash_pose(uint32_t body, const tahr_pose *pose)
{
    uint64_t words[sizeof *pose / 8], hash = 0xCBF29CE484222325u ^ body;
    memcpy(words, pose, sizeof words);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        for (int byte = 0; byte < 8; byte++) {
            hash = (hash ^ (words[i] & 0xFF)) * 0x100000001B3u;
            words[i] >>= 8;
        }
    }
    return hash;
}

void tahr__move_revision(tahr_world *world, uint64_t by)
{
    world->revision += by;
    world->revision += world->revision == 0;
}

/* Radius around the body's position that holds all of it. */
static double reach_of(const tahr_body_desc *b)
{
    double most = 0;
    switch (b->type) {
    case TAHR_BODY_BOX:
    case TAHR_BODY_ELLIPSOID: return length(b->half_extents);
    case TAHR_BODY_SPHERE: return b->radius;
    case TAHR_BODY_CAPSULE: return b->half_height;
    case TAHR_BODY_CYLINDER:
    case TAHR_BODY_CONE: return sqrt(b->radius * b->radius + b->half_height * b->half_height);
    case TAHR_BODY_HEIGHTS:
        for (size_t i = 0; i < (size_t)b->columns * b->rows; i++) {
            most = max_of(most, fabs(b->heights[i])); /* of NaN, a hole, max_of keeps what it had */
        }
        return length(vec(b->half_extents.x, b->half_extents.y, most));
    default:
        for (uint32_t i = 0; i < b->vertex_count; i++) {
            const double *v = b->vertices + 3 * (size_t)i;
            most = max_of(most, length_squared(vec(v[0], v[1], v[2])));
        }
        return sqrt(most);
    }
}

/* Half the extents of what lends its vertices to characters. */
static vec3 half_of(const tahr_body_desc *b)
{
    vec3 low = vec(0, 0, 0), high = low;
    for (uint32_t i = 0; b->flags & TAHR_BODY_TEMPLATE && i < b->vertex_count; i++) {
        const double *v = b->vertices + 3 * (size_t)i;
        low = i ? vec(min_of(low.x, v[0]), min_of(low.y, v[1]), min_of(low.z, v[2])) : vec(v[0], v[1], v[2]);
        high = i ? vec(max_of(high.x, v[0]), max_of(high.y, v[1]), max_of(high.z, v[2])) : low;
    }
    return scale(sub(high, low), 0.5);
}

/* Radius of what is round about an axis. [out] straight: half the length of that. */
static double round_of(const tahr_body_desc *b, double *straight)
{
    *straight = b->type == TAHR_BODY_CAPSULE    ? b->half_height - b->radius
                : b->type == TAHR_BODY_CYLINDER ? b->half_height
                                                : 0;
    return b->type == TAHR_BODY_SPHERE || *straight > 0 ? b->radius : 0;
}

static tahr__body_note note_of(uint32_t i, const tahr_body_desc *b)
{
    tahr_pose pose = b->pose;
    if (pose.orientation.x == 0 && pose.orientation.y == 0 && pose.orientation.z == 0 && pose.orientation.w == 0) {
        pose.orientation.w = 1;
    }
    tahr__body_note note = {.pose_hash = tahr__hash_pose(i, &pose),
                            .reach = reach_of(b),
                            .fluid_friction = b->fluid_friction,
                            .surface_velocity = b->surface_velocity,
                            .pose = {pose.position, quat_unit(pose.orientation)},
                            .before = {pose.position, quat_unit(pose.orientation)},
                            .mass = b->mass,
                            .half = half_of(b),
                            .flags = b->flags};
    note.round = round_of(b, &note.straight);
    return note;
}

static uint32_t has_of(const tahr__body_note *note)
{
    uint32_t sensor = note->flags & (TAHR_BODY_SENSOR | TAHR_BODY_FLUID);
    uint32_t base = note->flags & TAHR_BODY_MOVABLE || length_squared(note->surface_velocity) > 0 || note->mass > 0;
    uint32_t moves = note->flags & TAHR_BODY_MOVABLE;
    uint32_t placed = sensor ? (uint32_t)TAHR__HAS_MOVING_SENSORS : (uint32_t)TAHR__HAS_SQUEEZERS;
    return (sensor ? TAHR__HAS_SENSORS : 0u) | (moves ? placed : 0u) |
           (note->flags & TAHR_BODY_FLUID ? TAHR__HAS_FLUIDS : 0u) | (base ? TAHR__HAS_BASES : 0u);
}

static tahr_status note_bodies(tahr_world *world, const tahr_world_desc *desc)
{
    tahr_allocator a = world->host.allocator;
    if (desc->body_count == 0) {
        return TAHR_OK;
    }
    world->bodies = a.alloc(a.user, desc->body_count * sizeof *world->bodies, 8);
    world->moved = a.alloc(a.user, desc->body_count * sizeof *world->moved, 8);
    world->body_count = desc->body_count;
    if (!world->bodies || !world->moved) {
        return tahr__complain(&world->log, TAHR_E_MEMORY, "tahr_world_open", "allocator", "returned NULL");
    }
    for (uint32_t i = 0; i < desc->body_count; i++) {
        world->bodies[i] = note_of(i, &desc->bodies[i]);
        world->has |= has_of(&world->bodies[i]);
        tahr__move_revision(world, world->bodies[i].pose_hash);
    }
    if (tahr__specials_list(world) < 0) {
        return tahr__complain(&world->log, TAHR_E_MEMORY, "tahr_world_open", "allocator", "returned NULL");
    }
    return TAHR_OK;
}

static tahr_status open_scene(tahr_world *world, const tahr_backend *backend, const tahr_world_desc *desc)
{
    tahr_world_desc scene;
    tahr_body_desc *own = NULL;
    memcpy(&scene, desc, sizeof scene);
    scene.struct_size = sizeof scene;
    tahr_status status = tahr__bodies_read(&world->host, &world->log, &scene, &own);
    if (status >= 0) {
        status = tahr__bodies_fit(backend, &world->log, &scene);
    }
    if (status >= 0) {
        status = note_bodies(world, &scene);
    }
    if (status >= 0 && (world->has & TAHR__HAS_FLUIDS) && !backend->fluid) {
        status = tahr__complain(&world->log, TAHR_E_UNSUPPORTED, "tahr_world_open", "backend.fluid",
                                "is NULL, but a body is TAHR_BODY_FLUID");
    }
    if (status >= 0) {
        tahr__enter_backend(world, "tahr_world_open");
        status = tahr__leave_backend(world, backend, backend->open(&world->host, &scene, &world->self));
    }
    tahr__bodies_free(&world->host, own, scene.body_count);
    return status;
}

tahr_status tahr_world_open(const tahr_backend *backend, const tahr_world_desc *desc, tahr_world **out)
{
    tahr_world *world = NULL;
    const tahr_log *log = log_of(desc);
    if (!desc || !backend || !out) {
        return tahr__complain(log, TAHR_E_NULL, "tahr_world_open", backend ? "world" : "backend", "is NULL");
    }
    tahr_status status = tahr__sized_check(desc, sizeof *desc);
    if (status < 0) {
        return tahr__complain(log, status, "tahr_world_open", "desc:", tahr_status_message(status));
    }
    status = tahr__backend_check(backend, log, "tahr_world_open", NULL);
    if (status < 0) {
        return status;
    }
    status = new_world("tahr_world_open", desc, 0, &world);
    if (status < 0) {
        return status;
    }
    status = open_scene(world, backend, desc);
    if (status < 0) {
        free_world(world, 0);
        return status;
    }
    world->backend = backend;
    world->has |= backend->body_motion ? (uint32_t)TAHR__HAS_BASES : 0u;
    /* A backend that brings its own scene may have fluids and sensors in it that nobody described. */
    int brings_own = backend->body_motion && desc->body_count == 0;
    world->has |= backend->fluid && brings_own ? (uint32_t)TAHR__HAS_FLUIDS : 0u;
    if (brings_own && (backend->capabilities & TAHR_CAP_SENSORS)) {
        world->has |= TAHR__HAS_SENSORS | TAHR__HAS_MOVING_SENSORS;
    }
    world->specials_known = !backend->body_motion;
    *out = world;
    return TAHR_OK;
}

tahr_status tahr_world_open_callbacks(const tahr_callbacks *callbacks, const tahr_world_desc *desc, tahr_world **out)
{
    static const char function[] = "tahr_world_open_callbacks";
    tahr_world *world = NULL;
    const tahr_log *log = log_of(desc);
    if (!callbacks || !out) {
        return tahr__complain(log, TAHR_E_NULL, function, callbacks ? "world" : "callbacks", "is NULL");
    }
    tahr_status status = tahr__sized_check(callbacks, sizeof *callbacks);
    if (status < 0) {
        return tahr__complain(log, status, function, "callbacks:", tahr_status_message(status));
    }
    status = desc ? tahr__sized_check(desc, sizeof *desc) : TAHR_OK;
    if (status < 0) {
        return tahr__complain(log, status, function, "desc:", tahr_status_message(status));
    }
    if (!callbacks->sweep) {
        return tahr__complain(log, TAHR_E_NULL, function, "callbacks.sweep", "is NULL");
    }
    if (callbacks->flags & ~(uint32_t)(TAHR_CALLBACKS_NO_MARGIN | TAHR_CALLBACKS_PROBE)) {
        return tahr__complain(log, TAHR_E_UNSUPPORTED, function, "callbacks.flags", "has an unknown bit");
    }
    status = new_world(function, desc, sizeof *callbacks, &world);
    if (status < 0) {
        return status;
    }
    world->self = world + 1;
    memcpy(world->self, callbacks, sizeof *callbacks);
    world->backend =
        callbacks->flags & TAHR_CALLBACKS_NO_MARGIN ? &tahr__callbacks_without_margin : &tahr__callbacks_backend;
    if (!callbacks->contacts) {
        world->derived = callbacks->flags & TAHR_CALLBACKS_PROBE ? TAHR__MOST_PROBES : TAHR__MOST_OVERLAPS;
    }
    world->has |= callbacks->body ? (uint32_t)TAHR__HAS_BASES : 0u;
    world->has |= callbacks->sensors ? TAHR__HAS_SENSORS | TAHR__HAS_MOVING_SENSORS : 0u;
    world->has |= callbacks->fluid ? (uint32_t)TAHR__HAS_FLUIDS : 0u;
    *out = world;
    return TAHR_OK;
}

void tahr_world_close(tahr_world *world)
{
    if (world) {
        tahr__record_end(world);
        world->backend->close(world->self);
        free_world(world, is_callbacks(world->backend) ? sizeof(tahr_callbacks) : 0);
    }
}

tahr_status tahr_world_touch(tahr_world *world)
{
    if (!world) {
        return TAHR_E_NULL;
    }
    tahr__move_revision(world, 1);
    world->ground++;
    world->last_revision = 0;
    if (world->backend->place) { /* a backend may have caches of geometry that is not described */
        (void)world->backend->place(world->self, NULL, 0);
    }
    if (world->recording) {
        tahr__record_move(world, TAHR_RECORD_TOUCH, NULL, 0, 0);
    }
    return TAHR_OK;
}

uint64_t tahr_world_revision(const tahr_world *world)
{
    return world ? world->revision + world->motion : 0;
}

uint64_t tahr_world_memory(const tahr_world *world)
{
    return world ? world->memory.bytes : 0;
}

const char *tahr_world_backend_name(const tahr_world *world)
{
    return world ? world->backend->name : "?";
}

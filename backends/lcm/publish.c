/* SPDX-License-Identifier: MIT
 * publish.c: what a sink is told, as messages of backends/lcm/types. Numbers that are unsigned here are signed there,
 * with the same bits. */
#include "publish.h"

#include <tahr_lcm/tahr_body_t.h>
#include <tahr_lcm/tahr_event_t.h>
#include <tahr_lcm/tahr_input_t.h>
#include <tahr_lcm/tahr_report_t.h>
#include <tahr_lcm/tahr_snapshot_t.h>
#include <tahr_lcm/tahr_state_t.h>
#include <tahr_lcm/tahr_world_t.h>

#include <stdio.h>
#include <string.h>

_Static_assert(sizeof((tahr_report_t){0}.saved) == sizeof((tahr_report){0}.saved), "report_t.saved has another length");

/* What every message about a character begins with, as designated initialisers. */
#define STAMPED(stamp)                                                                                                \
    .character = (int32_t)(stamp)->character, .step = (int64_t)(stamp)->step, .sequence = (int64_t)(stamp)->sequence, \
    .time_ns = (stamp)->time_ns, .wall_ns = (stamp)->wall_ns

#define VEC3(v)             \
    {                       \
        (v).x, (v).y, (v).z \
    }
#define QUAT(q)                    \
    {                              \
        (q).x, (q).y, (q).z, (q).w \
    }

/* What was encoded to size bytes, or not at all, about one character. */
static tahr_status send_of(tahr_lcm *lcm, uint32_t kind, const tahr_stamp *stamp, const void *bytes, int size)
{
    char channel[TAHR__LCM_CHANNEL];

    if (size < 0) return TAHR_E_MEMORY;
    if (!(lcm->flags & TAHR_LCM_ID_SUFFIX))
        return tahr__lcm_send(&lcm->connection, lcm->names[kind], bytes, (uint32_t)size);
    snprintf(channel, sizeof channel, "%s_%u", lcm->names[kind], (unsigned)stamp->character);
    return tahr__lcm_send(&lcm->connection, channel, bytes, (uint32_t)size);
}

static tahr_status send_state(void *user, const tahr_stamp *stamp, const tahr_state *s)
{
    const tahr_floor *f = &s->floor;
    const tahr_state_t message = {
        STAMPED(stamp),
        .mode = (int32_t)s->mode,
        .position = VEC3(s->position),
        .velocity = VEC3(s->velocity),
        .orientation = QUAT(s->orientation),
        .up = VEC3(s->up),
        .radius = s->radius,
        .half_height = s->half_height,
        .flags = (int32_t)s->flags,
        .base_body = (int32_t)s->base.body,
        .floor_blocking = (f->flags & TAHR_FLOOR_BLOCKING) != 0,
        .floor_walkable = (f->flags & TAHR_FLOOR_WALKABLE) != 0,
        .floor_perching = (f->flags & TAHR_FLOOR_PERCHING) != 0,
        .floor_flags = (int32_t)f->flags,
        .floor_body = (int32_t)f->body,
        .floor_feature = (int32_t)f->feature,
        .floor_surface = (int32_t)f->surface,
        .floor_distance = f->distance,
        .floor_normal = VEC3(f->normal),
        .floor_surface_normal = VEC3(f->surface_normal),
        .floor_point = VEC3(f->point),
    };
    unsigned char bytes[TAHR__LCM_MESSAGE];
    return send_of(user, TAHR_MESSAGE_STATE, stamp, bytes, tahr_state_t_encode(bytes, 0, sizeof bytes, &message));
}

static tahr_status send_event(void *user, const tahr_stamp *stamp, const tahr_event *e)
{
    const tahr_event_t message = {
        STAMPED(stamp),
        .type = (int32_t)e->type,
        .body = (int32_t)e->body,
        .feature = (int32_t)e->feature,
        .surface = (int32_t)e->surface,
        .value = e->value,
        .position = VEC3(e->position),
        .normal = VEC3(e->normal),
    };
    unsigned char bytes[TAHR__LCM_MESSAGE];
    return send_of(user, TAHR_MESSAGE_EVENT, stamp, bytes, tahr_event_t_encode(bytes, 0, sizeof bytes, &message));
}

static tahr_status send_input(void *user, const tahr_stamp *stamp, const tahr_sink_input *given)
{
    const tahr_input *i = given->input;
    const tahr_input_t message = {
        STAMPED(stamp),
        .config = (int32_t)stamp->config,
        .epoch = (int64_t)stamp->epoch,
        .dt = given->dt,
        .step_flags = (int32_t)given->flags,
        .flags = (int32_t)i->flags,
        .jump = (int32_t)i->jump,
        .crouch = (int32_t)i->crouch,
        .mode = (int32_t)i->mode,
        .move = VEC3(i->move),
        .facing = VEC3(i->facing),
        .gravity = VEC3(i->gravity),
        .radius = i->radius,
        .half_height = i->half_height,
        .launch = VEC3(i->launch),
        .impulse = VEC3(i->impulse),
        .drive = VEC3(i->drive),
    };
    unsigned char bytes[TAHR__LCM_MESSAGE];
    return send_of(user, TAHR_MESSAGE_INPUT, stamp, bytes, tahr_input_t_encode(bytes, 0, sizeof bytes, &message));
}

static tahr_status send_report(void *user, const tahr_stamp *stamp, const tahr_sink_report *given)
{
    const tahr_report *r = given->report;
    tahr_report_t message = {
        STAMPED(stamp),
        .status = given->status,
        .state_hash = (int64_t)given->hash,
        .duration_ns = (int64_t)given->ns,
        .flags = (int32_t)r->flags,
        .event_count = (int32_t)r->event_count,
        .events_lost = (int32_t)r->events_lost,
        .sweeps = (int32_t)r->sweeps,
        .contact_queries = (int32_t)r->contact_queries,
        .rays = (int32_t)r->rays,
        .fluid_queries = (int32_t)r->fluid_queries,
        .slides = (int32_t)r->slides,
        .slices = (int32_t)r->slices,
        .arcs = (int32_t)r->arcs,
        .triangle_tests = (int64_t)r->triangle_tests,
        .narrow_iterations = (int64_t)r->narrow_iterations,
        .gathers = (int64_t)r->gathers,
        .escapes = (int64_t)r->escapes,
        .step_offset = r->step_offset,
        .residual = r->residual,
        .time_lost = r->time_lost,
    };
    unsigned char bytes[TAHR__LCM_MESSAGE];
    memcpy(message.saved, r->saved, sizeof message.saved);
    return send_of(user, TAHR_MESSAGE_REPORT, stamp, bytes, tahr_report_t_encode(bytes, 0, sizeof bytes, &message));
}

static tahr_status send_snapshot(void *user, const tahr_stamp *stamp, const tahr_state *state)
{
    const tahr_snapshot_t message = {
        STAMPED(stamp),
        .config = (int32_t)stamp->config,
        .epoch = (int64_t)stamp->epoch,
        .state_hash = (int64_t)tahr_state_hash(state),
        .size = sizeof *state,
        .state = (uint8_t *)state, /* only read */
    };
    unsigned char bytes[TAHR__LCM_MESSAGE];
    return send_of(user, TAHR_MESSAGE_SNAPSHOT, stamp, bytes, tahr_snapshot_t_encode(bytes, 0, sizeof bytes, &message));
}

/* Pose number index of a change; of a change without any the change alone. */
static tahr_status send_body(tahr_lcm *lcm, const tahr_sink_change *c, uint32_t index)
{
    static const tahr_body_pose nobody = {.body = TAHR_NO_BODY, .pose = {.orientation = {0, 0, 0, 1}}};
    const tahr_body_pose *now = c->count > 0 ? &c->poses[index] : &nobody;
    const tahr_body_pose *before = c->count > 0 && c->before ? &c->before[index] : now;
    const tahr_body_t message = {
        .epoch = (int64_t)c->epoch,
        .revision = (int64_t)c->revision,
        .wall_ns = c->wall_ns,
        .kind = (int32_t)c->kind,
        .count = (int32_t)c->count,
        .index = (int32_t)index,
        .body = (int32_t)now->body,
        .teleport = (now->flags & TAHR_POSE_TELEPORT) != 0,
        .dt = c->dt,
        .position = VEC3(now->pose.position),
        .orientation = QUAT(now->pose.orientation),
        .before_position = VEC3(before->pose.position),
        .before_orientation = QUAT(before->pose.orientation),
    };
    unsigned char bytes[TAHR__LCM_MESSAGE];
    const int size = tahr_body_t_encode(bytes, 0, sizeof bytes, &message);
    if (size < 0) return TAHR_E_MEMORY;
    return tahr__lcm_send(&lcm->connection, lcm->names[TAHR_MESSAGE_BODY], bytes, (uint32_t)size);
}

static tahr_status send_change(void *user, const tahr_sink_change *change)
{
    tahr_status worst = send_body(user, change, 0);
    for (uint32_t i = 1; i < change->count; i++) {
        const tahr_status status = send_body(user, change, i);
        if (status < 0) worst = status;
    }
    return worst;
}

/* Room for a world of that size: taken for the first, and again only where one is longer than any before. */
static int has_room(tahr_lcm *lcm, uint32_t size)
{
    if (size <= lcm->world_room) return 1;
    unsigned char *more = lcm->allocator.alloc(lcm->allocator.user, size, 8);
    if (!more) return 0;
    if (lcm->world) lcm->allocator.free(lcm->allocator.user, lcm->world, lcm->world_room, 8);
    lcm->world = more;
    lcm->world_room = size;
    return 1;
}

static tahr_status send_world(void *user, const tahr_sink_world *w)
{
    tahr_lcm *lcm = user;
    const uint32_t config_size = w->config_count > 0 ? w->configs->struct_size : 0;
    const uint64_t size = (uint64_t)w->config_count * config_size;
    if (size > LCM_MAX_MESSAGE_SIZE / 2) return TAHR_E_UNSUPPORTED; /* LCM's limit, with room for the rest */
    /* Texts and bytes are only read. */
    const tahr_world_t message = {
        .run = w->run,
        .wall_ns = w->wall_ns,
        .sequence = (int64_t)w->sequence,
        .level = (char *)(w->level ? w->level : ""),
        .level_hash = (int64_t)w->level_hash,
        .backend = (char *)(w->backend ? w->backend : ""),
        .version = (char *)tahr_version(),
        .abi = TAHR_ABI,
        .characters = (int32_t)w->characters,
        .epoch = (int64_t)w->epoch,
        .revision = (int64_t)w->revision,
        .dropped = (int64_t)w->dropped,
        .failed = (int64_t)w->failed,
        .state_rate = w->state_rate,
        .config_count = (int32_t)w->config_count,
        .config_size = (int32_t)config_size,
        .size = (int32_t)size,
        .configs = (uint8_t *)w->configs,
    };
    const int encoded = tahr_world_t_encoded_size(&message);
    if (encoded < 0 || !has_room(lcm, (uint32_t)encoded)) return TAHR_E_MEMORY;
    if (tahr_world_t_encode(lcm->world, 0, encoded, &message) != encoded) return TAHR_E_MEMORY;
    return tahr__lcm_send(&lcm->connection, lcm->names[TAHR_MESSAGE_WORLD], lcm->world, (uint32_t)encoded);
}

static void flush(void *user)
{
    tahr_lcm *lcm = user;
    tahr__lcm_flush(&lcm->connection);
}

void tahr__lcm_publish_with(tahr_lcm *lcm)
{
    lcm->sink = (tahr_sink){
        .struct_size = sizeof lcm->sink,
        .abi_major = TAHR_ABI_MAJOR,
        .abi_minor = TAHR_ABI_MINOR,
        .name = "lcm",
        .user = lcm,
        .state = send_state,
        .event = send_event,
        .input = send_input,
        .report = send_report,
        .snapshot = send_snapshot,
        .change = send_change,
        .world = send_world,
        .flush = flush,
    };
}

/* SPDX-License-Identifier: MIT
 * recording.c: traces in memory, and a replay of one. */
#include "recording.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOVERS = 64 };

static void keep_message(void *user, int32_t level, const char *message)
{
    recording *r = user;
    (void)level;
    snprintf(r->message, sizeof r->message, "%s", message);
    r->messages++;
}

static void keep_complaint(void *user, int32_t level, const char *message)
{
    recording *r = user;
    (void)level;
    snprintf(r->complaint, sizeof r->complaint, "%s", message);
}

static size_t take(void *user, const void *bytes, size_t size)
{
    recording *r = user;
    size = r->chunk && size > r->chunk ? r->chunk : size;
    if (r->fail_at && r->size + size > r->fail_at) {
        size = r->fail_at - r->size;
    }
    if (r->size + size > r->room) {
        r->room = 2 * (r->size + size);
        r->bytes = realloc(r->bytes, r->room);
        if (!r->bytes) {
            abort();
        }
    }
    if (size > 0) {
        memcpy(r->bytes + r->size, bytes, size);
    }
    r->size += size;
    return size;
}

static size_t give(void *user, void *bytes, size_t size)
{
    recording *r = user;
    size = r->chunk && size > r->chunk ? r->chunk : size;
    size = size < r->size - r->at ? size : r->size - r->at;
    if (size > 0) {
        memcpy(bytes, r->bytes + r->at, size);
    }
    r->at += size;
    return size;
}

void recording_free(recording *r)
{
    free(r->bytes);
    *r = (recording){0};
}

tahr_trace *recording_begin(recording *r, tahr_world *world, uint32_t flags)
{
    const tahr_log log = {r, keep_message};
    const tahr_trace_desc desc = {.struct_size = sizeof desc, .flags = flags, .write = take, .user = r, .log = &log};
    tahr_trace *trace = NULL;
    if (tahr_trace_open(&desc, &trace) < 0) {
        return NULL;
    }
    if (tahr_world_record(world, tahr_trace_recorder(trace)) < 0) {
        tahr_trace_close(trace);
        return NULL;
    }
    return trace;
}

tahr_status recording_end(tahr_trace *trace, tahr_world *world)
{
    tahr_world_record(world, NULL);
    return tahr_trace_close(trace);
}

void recording_count(recording_counts *counts, const tahr_report *r)
{
    uint64_t step[RECORDING_COUNTS] = {r->sweeps,         r->contact_queries,   r->rays,    r->fluid_queries,
                                       r->triangle_tests, r->narrow_iterations, r->gathers, r->escapes};
    for (int i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        step[8 + i] = r->saved[i];
    }
    for (int i = 0; i < RECORDING_COUNTS; i++) {
        counts->sum[i] += step[i];
        counts->hash = (counts->hash ^ step[i]) * 0x100000001B3u;
    }
}

typedef struct theatre {
    tahr_trace_reader *reader;
    tahr_world *world;
    tahr_mover *movers[MOVERS];
    tahr_state states[MOVERS];
    uint32_t count, custom;
} theatre;

static tahr_status open_world(theatre *t, recording *r)
{
    const tahr_log log = {r, keep_complaint};
    uint32_t count = tahr_trace_bodies(t->reader);
    tahr_body_desc *bodies = calloc(count + 1, sizeof *bodies);
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies, desc.body_count = count, desc.log = &log;
    for (uint32_t i = 0; i < count; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_SPHERE);
        bodies[i].radius = 1;
    }
    tahr_status status = tahr_world_open(tahr_backend_v1_trace(), &desc, &t->world);
    free(bodies);
    return status < 0 ? status : tahr_world_record(t->world, tahr_trace_answers(t->reader));
}

/* 0: the step could not be set up. */
static int play(theatre *t, replay *p, const tahr_record_step *s)
{
    if (s->config) {
        tahr_config config = *s->config;
        config.sleep = 0;
        config.max_speed *= p->speed_factor > 0 ? p->speed_factor : 1;
        if (t->count == MOVERS || tahr_mover_create(t->world, &config, &t->movers[t->count]) < 0) {
            return 0;
        }
        t->count++;
    }
    if (s->state) {
        t->states[s->mover] = *s->state;
    }
    t->custom = s->flags & TAHR_RECORD_CUSTOM;
    if (!t->custom) {
        tahr_event events[1];
        tahr_report report = {.struct_size = sizeof report, .event_capacity = 1};
        report.events = s->flags & TAHR_RECORD_EVENTS ? events : NULL;
        p->status = tahr_mover_step(t->movers[s->mover], s->input, s->dt, &t->states[s->mover], &report);
        recording_count(&p->counts, &report);
    }
    p->state = t->states[s->mover];
    return 1;
}

static tahr_status counted(tahr_status status)
{
    return status == TAHR_TRUNCATED ? TAHR_OK : status;
}

static void repeat(theatre *t, replay *p)
{
    tahr_trace_event e;
    while (!p->differs && (p->read = tahr_trace_next(t->reader, &e)) >= 0) {
        switch (e.kind) {
        case TAHR_TRACE_MOVE:
            p->moves++;
            p->differs =
                (e.move.kind == TAHR_RECORD_SET    ? tahr_world_set(t->world, e.move.poses, e.move.count)
                 : e.move.kind == TAHR_RECORD_MOVE ? tahr_world_move(t->world, e.move.poses, e.move.count, e.move.dt)
                                                   : tahr_world_touch(t->world)) < 0;
            break;
        case TAHR_TRACE_STEP: p->differs = !play(t, p, &e.step); break;
        case TAHR_TRACE_DONE:
            p->differs = !t->custom && (counted(p->status) != counted(e.done.status) || e.queries_left > 0 ||
                                        tahr_state_hash(&t->states[e.done.mover]) != e.done.hash);
            p->custom += t->custom != 0;
            p->steps += !t->custom && !p->differs;
            break;
        default: p->ended = 1; return;
        }
    }
}

void replay_run(replay *p, recording *r)
{
    const double factor = p->speed_factor;
    const tahr_log log = {r, keep_message};
    const tahr_trace_desc desc = {.struct_size = sizeof desc, .read = give, .user = r, .log = &log};
    theatre *t = calloc(1, sizeof *t);
    *p = (replay){.speed_factor = factor};
    r->at = 0;
    p->opened = tahr_trace_read(&desc, &t->reader);
    if (p->opened >= 0) {
        p->opened = open_world(t, r);
    }
    if (p->opened >= 0) {
        repeat(t, p);
    }
    const char *how = tahr_trace_difference(t->reader);
    snprintf(p->how, sizeof p->how, "%s", how ? how : "");
    for (uint32_t i = 0; i < t->count; i++) {
        tahr_mover_destroy(t->movers[i]);
    }
    tahr_world_close(t->world);
    tahr_trace_reader_close(t->reader);
    free(t);
}

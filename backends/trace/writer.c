/* SPDX-License-Identifier: MIT
 * writer.c: a trace is opened, fed by the library, written in blocks, and closed. */
#include "writer.h"

#include <stdlib.h>
#include <string.h>

void tahr__trace_give_up(tahr_trace *trace, tahr_status status, const char *why)
{
    char text[160];

    if (trace->status < 0) return;
    trace->status = status;
    if (!trace->log.write) return;
    snprintf(text, sizeof text, "tahr_trace: recording ends after %llu bytes: %s", (unsigned long long)trace->bytes,
             why);
    trace->log.write(trace->log.user, TAHR_LOG_ERROR, text);
}

/* A function may take less than it is given, as long as it takes something. */
static void write_bytes(tahr_trace *trace, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;

    while (size > 0 && trace->status >= 0) {
        size_t taken = trace->file ? fwrite(at, 1, size, trace->file) : trace->write(trace->user, at, size);
        if (taken == 0 || taken > size) {
            tahr__trace_give_up(trace, TAHR_E_FILE, "a write failed");
            return;
        }
        at += taken;
        size -= taken;
        trace->bytes += taken;
    }
}

static void write_block(tahr_trace *trace)
{
    uint32_t frame[2] = {(uint32_t)(trace->out.at - trace->buffer), trace->block++};
    uint64_t checksum = tahr__trace_hash(tahr__trace_hash(0, frame, sizeof frame), trace->buffer, frame[0]);

    if (frame[0] == 0) return;
    write_bytes(trace, frame, sizeof frame);
    write_bytes(trace, &checksum, sizeof checksum);
    write_bytes(trace, trace->buffer, frame[0]);
    trace->out.at = trace->buffer;
}

void tahr__trace_flush(tahr_trace *trace)
{
    if (trace->out.at > trace->buffer) write_block(trace);
    if (trace->file && trace->status >= 0 && fflush(trace->file) != 0)
        tahr__trace_give_up(trace, TAHR_E_FILE, "a write failed");
}

int tahr__trace_begin(tahr_trace *trace, uint32_t tag)
{
    if (trace->status < 0) return 0;
    if (trace->out.at - trace->buffer >= TAHR__TRACE_BLOCK) write_block(trace);
    tahr__trace_put(&trace->out, tag);
    return trace->status >= 0;
}

static void put_world(tahr_trace *trace, const tahr_record_world *w)
{
    tahr__trace_bytes *out = &trace->out;

    if (!tahr__trace_begin(trace, TAHR__TRACE_WORLD)) return;
    tahr__trace_put_text(out, w->backend->name, 64);
    tahr__trace_put_text(out, w->backend->version, 64);
    tahr__trace_put(out, w->backend->capabilities);
    tahr__trace_put(out, (w->backend->place ? 1u : 0u) | (w->backend->body_motion ? 2u : 0u) |
                             (w->backend->fluid ? 4u : 0u));
    tahr__trace_put(out, w->body_count);
    tahr__trace_put(out, w->has);
    tahr__trace_put(out, w->moves);
    tahr__trace_put(out, w->revision);
    tahr__trace_put(out, w->motion);
    tahr__trace_put(out, w->last_revision);
    tahr__trace_put(out, w->derived);
    for (uint32_t i = 0; i < w->body_count && tahr__trace_begin(trace, TAHR__TRACE_BODY); i++)
        tahr__trace_put_words(out, &w->bodies[i], &trace->bases.body, sizeof w->bodies[i]);
}

static tahr_status begin(void *user, tahr_record_world *world)
{
    tahr_trace *trace = user;

    if (trace->status < 0) return trace->status;
    if (trace->began) {
        if (trace->log.write)
            trace->log.write(trace->log.user, TAHR_LOG_ERROR, "tahr_trace: a trace is of one world, recorded once");
        return TAHR_E_ARGUMENT;
    }
    trace->began = 1;
    trace->inner = world->backend;
    trace->inner_self = world->self;
    trace->derived = world->derived > 0;
    put_world(trace, world);
    tahr__trace_wrap(trace);
    world->backend = &trace->table;
    world->self = trace;
    return trace->status;
}

static void move(void *user, const tahr_record_move *m)
{
    tahr_trace *trace = user;

    if (!tahr__trace_begin(trace, TAHR__TRACE_CHANGE)) return;
    tahr__trace_put(&trace->out, m->kind);
    tahr__trace_put(&trace->out, m->count);
    tahr__trace_put_words(&trace->out, &m->dt, &trace->bases.dt, sizeof m->dt);
    for (uint32_t i = 0; i < m->count && tahr__trace_begin(trace, TAHR__TRACE_POSE); i++)
        tahr__trace_put_words(&trace->out, &m->poses[i], &trace->bases.pose, sizeof m->poses[i]);
}

/* The memory of a mover, made when it is met; NULL without memory. */
static tahr__trace_mover *mover_at(tahr_trace *trace, uint32_t number)
{
    if (number == trace->mover_room) {
        uint32_t room = number < 8 ? 8 : number * 2;
        tahr__trace_mover *more = realloc(trace->movers, room * sizeof *more);
        if (!more) return NULL;
        trace->movers = more;
        trace->mover_room = room;
    }
    if (number == trace->mover_count) memset(&trace->movers[trace->mover_count++], 0, sizeof *trace->movers);
    return number < trace->mover_count ? &trace->movers[number] : NULL;
}

static void step(void *user, const tahr_record_step *s)
{
    tahr_trace *trace = user;
    int is_new = s->mover == trace->mover_count;
    tahr__trace_mover *m = trace->status >= 0 ? mover_at(trace, s->mover) : NULL;
    tahr__trace_bytes *out = &trace->out;
    tahr_input input;

    trace->in_step = s->flags & TAHR_RECORD_CUSTOM ? 2 : 1;
    if (!m) {
        tahr__trace_give_up(trace, TAHR_E_MEMORY, "no memory for another mover");
        return;
    }
    int jumped = is_new || memcmp(s->state, &m->after, sizeof m->after) != 0;
    if (!tahr__trace_begin(trace, TAHR__TRACE_BEGIN)) return;
    memcpy(&input, s->input, sizeof input);
    input.struct_size = sizeof input;
    tahr__trace_put(out, s->mover);
    tahr__trace_put(out, (is_new ? TAHR__TRACE_HAS_CONFIG : 0u) | (jumped ? TAHR__TRACE_HAS_STATE : 0u) |
                             (s->flags & TAHR_RECORD_CUSTOM ? TAHR__TRACE_IS_CUSTOM : 0u) |
                             (s->flags & TAHR_RECORD_EVENTS ? TAHR__TRACE_HAS_EVENTS : 0u));
    tahr__trace_put_words(out, &s->dt, &trace->bases.dt, sizeof s->dt);
    tahr__trace_put_words(out, &input, &m->input, sizeof input);
    if (is_new) tahr__trace_put_words(out, s->config, &trace->bases.config, sizeof *s->config);
    if (jumped) tahr__trace_put_words(out, s->state, &trace->bases.state, sizeof *s->state);
    if (trace->flags & TAHR_TRACE_FLUSH) tahr__trace_flush(trace); /* this step may be the one that crashes */
}

static void done(void *user, const tahr_record_done *d)
{
    tahr_trace *trace = user;

    trace->steps++;
    if (trace->in_step == 2 && d->mover < trace->mover_count)
        memset(&trace->movers[d->mover].after, 0xFF, sizeof(tahr_state)); /* nobody knows it who replays */
    else if (d->mover < trace->mover_count)
        trace->movers[d->mover].after = *d->state;
    trace->in_step = 0;
    if (!tahr__trace_begin(trace, TAHR__TRACE_FINISH)) return;
    tahr__trace_put(&trace->out, (uint32_t)d->status);
    memcpy(trace->out.at, &d->hash, sizeof d->hash);
    trace->out.at += sizeof d->hash;
    if (trace->flags & TAHR_TRACE_FLUSH) tahr__trace_flush(trace);
}

static tahr_status check(const tahr_trace_desc *desc)
{
    tahr_status status = tahr__trace_check(desc, TAHR_TRACE_STEPS_ONLY | TAHR_TRACE_FLUSH);

    if (status < 0) return status;
    if (desc->path || desc->write) return TAHR_OK;
    tahr__trace_complain(desc->log, "tahr_trace_open", "desc.path", "is NULL, and so is desc.write");
    return TAHR_E_NULL;
}

tahr_status tahr_trace_open(const tahr_trace_desc *desc, tahr_trace **out)
{
    tahr__trace_head head;
    tahr_status status = desc && out ? check(desc) : TAHR_E_NULL;
    tahr_trace *trace;

    if (status < 0) return status;
    trace = calloc(1, sizeof *trace);
    if (!trace) return TAHR_E_MEMORY;
    trace->write = desc->write;
    trace->user = desc->user;
    trace->flags = desc->flags;
    if (desc->log) trace->log = *desc->log;
    trace->out.at = trace->buffer;
    trace->recorder = (tahr_recorder){
        .struct_size = sizeof trace->recorder, .user = trace, .begin = begin, .move = move, .step = step, .done = done};
    if (desc->path) {
        trace->file = fopen(desc->path, "wb");
        if (!trace->file) {
            tahr__trace_complain(desc->log, "tahr_trace_open", desc->path, "cannot be opened for writing");
            trace->status = TAHR_E_FILE;
        }
    }
    tahr__trace_head_fill(&head);
    write_bytes(trace, &head, sizeof head);
    if (trace->status < 0) return tahr_trace_close(trace);
    *out = trace;
    return TAHR_OK;
}

const tahr_recorder *tahr_trace_recorder(tahr_trace *trace)
{
    return trace ? &trace->recorder : NULL;
}

void tahr_trace_size(const tahr_trace *trace, uint64_t *steps, uint64_t *queries, uint64_t *bytes)
{
    if (steps) *steps = trace ? trace->steps : 0;
    if (queries) *queries = trace ? trace->queries : 0;
    if (bytes) *bytes = trace ? trace->bytes + (uint64_t)(trace->out.at - trace->buffer) : 0;
}

tahr_status tahr_trace_close(tahr_trace *trace)
{
    tahr_status status;

    if (!trace) return TAHR_OK;
    if (trace->began && tahr__trace_begin(trace, TAHR__TRACE_LAST)) tahr__trace_put(&trace->out, trace->steps);
    tahr__trace_flush(trace);
    if (trace->file && fclose(trace->file) != 0) tahr__trace_give_up(trace, TAHR_E_FILE, "a write failed");
    status = trace->status;
    free(trace->movers);
    free(trace);
    return status;
}

/* SPDX-License-Identifier: MIT
 * reader.c: a trace is opened, its events are read one by one, and it is closed. */
#include "reader.h"

#include <stdlib.h>
#include <string.h>

static tahr_status check(const tahr_trace_desc *desc)
{
    tahr_status status = tahr__trace_check(desc, 0);

    if (status < 0) return status;
    if (desc->path || desc->read) return TAHR_OK;
    tahr__trace_complain(desc->log, "tahr_trace_read", "desc.path", "is NULL, and so is desc.read");
    return TAHR_E_NULL;
}

tahr_status tahr_trace_read(const tahr_trace_desc *desc, tahr_trace_reader **out)
{
    tahr_status status = desc && out ? check(desc) : TAHR_E_NULL;
    tahr_trace_reader *r;

    if (status < 0) return status;
    r = calloc(1, sizeof *r);
    if (!r) return TAHR_E_MEMORY;
    r->read = desc->read;
    r->user = desc->user;
    if (desc->log) r->log = *desc->log;
    if (desc->path) r->file = fopen(desc->path, "rb");
    if (desc->path && !r->file) {
        status = TAHR_E_NOT_FOUND;
        tahr__trace_complain(desc->log, "tahr_trace_read", desc->path, "cannot be opened");
    }
    if (status >= 0) status = tahr__trace_read_begin(r);
    if (status < 0) {
        tahr_trace_reader_close(r);
        return status;
    }
    tahr__trace_answer(r);
    *out = r;
    return TAHR_OK;
}

uint32_t tahr_trace_bodies(const tahr_trace_reader *reader)
{
    return reader ? reader->world.body_count : 0;
}

const char *tahr_trace_backend_name(const tahr_trace_reader *reader)
{
    return reader ? reader->name : "?";
}

const char *tahr_trace_backend_version(const tahr_trace_reader *reader)
{
    return reader ? reader->version : "?";
}

const tahr_recorder *tahr_trace_answers(tahr_trace_reader *reader)
{
    return reader ? &reader->recorder : NULL;
}

const char *tahr_trace_difference(const tahr_trace_reader *reader)
{
    return reader && reader->differs ? reader->difference : NULL;
}

static tahr_status read_move(tahr_trace_reader *r, tahr_trace_event *event)
{
    tahr__trace_bytes *in = &r->in;
    tahr_record_move *m = &event->move;

    event->kind = TAHR_TRACE_MOVE;
    m->kind = (uint32_t)tahr__trace_get(in, "a kind of change");
    uint32_t count = (uint32_t)tahr__trace_get(in, "a number of poses");
    tahr__trace_get_words(in, &m->dt, &r->bases.dt, sizeof m->dt, "a time");
    if (!in->bad && (m->kind < TAHR_RECORD_SET || m->kind > TAHR_RECORD_TOUCH)) in->bad = "a set, move or touch";
    if (in->bad) return tahr__trace_broken(r, in->bad);
    for (m->count = 0; m->count < count; m->count++) {
        void *more = tahr__trace_grow(r->poses, m->count, &r->pose_room, sizeof *r->poses);
        if (!more) return r->status = TAHR_E_MEMORY;
        r->poses = more;
        if (tahr__trace_peek(r) != TAHR__TRACE_POSE) return tahr__trace_broken(r, "a pose");
        r->tag = 0;
        tahr__trace_get_words(in, &r->poses[m->count], &r->bases.pose, sizeof *r->poses, "a pose");
        if (in->bad) return tahr__trace_broken(r, in->bad);
    }
    m->poses = r->poses;
    return TAHR_OK;
}

/* A mover is met with its config, and only then. */
static tahr_status read_mover(tahr_trace_reader *r, uint64_t number, uint64_t has)
{
    if (number > r->mover_count || (number == r->mover_count) != ((has & TAHR__TRACE_HAS_CONFIG) != 0) || has > 15)
        return tahr__trace_broken(r, "a mover that is known, or the next one with its config");
    if (number == r->mover_count) {
        void *more = tahr__trace_grow(r->inputs, r->mover_count, &r->mover_room, sizeof *r->inputs);
        if (!more) return r->status = TAHR_E_MEMORY;
        r->inputs = more;
        memset(&r->inputs[r->mover_count++], 0, sizeof *r->inputs);
    }
    r->mover = (uint32_t)number;
    return TAHR_OK;
}

static tahr_status read_step(tahr_trace_reader *r, tahr_trace_event *event)
{
    tahr__trace_bytes *in = &r->in;
    tahr_record_step *s = &event->step;
    uint64_t number = tahr__trace_get(in, "a mover"), has = tahr__trace_get(in, "what a step has");

    if (r->in_step) return tahr__trace_broken(r, "the end of the step before");
    if (in->bad) return tahr__trace_broken(r, in->bad);
    tahr_status status = read_mover(r, number, has);
    if (status < 0) return status;
    tahr__trace_get_words(in, &s->dt, &r->bases.dt, sizeof s->dt, "a time");
    tahr__trace_get_words(in, &r->input, &r->inputs[r->mover], sizeof r->input, "an input");
    if (has & TAHR__TRACE_HAS_CONFIG)
        tahr__trace_get_words(in, &r->config, &r->bases.config, sizeof r->config, "a config");
    if (has & TAHR__TRACE_HAS_STATE) tahr__trace_get_words(in, &r->state, &r->bases.state, sizeof r->state, "a state");
    /* A forged size would have the library read beyond the struct. */
    if (!in->bad && r->input.struct_size != sizeof r->input) in->bad = "the size of an input";
    if (!in->bad && has & TAHR__TRACE_HAS_CONFIG && r->config.struct_size != sizeof r->config)
        in->bad = "the size of a config";
    if (in->bad) return tahr__trace_broken(r, in->bad);
    event->kind = TAHR_TRACE_STEP;
    event->number = r->steps;
    s->mover = r->mover;
    s->flags = (has & TAHR__TRACE_IS_CUSTOM ? (uint32_t)TAHR_RECORD_CUSTOM : 0u) |
               (has & TAHR__TRACE_HAS_EVENTS ? (uint32_t)TAHR_RECORD_EVENTS : 0u);
    s->config = has & TAHR__TRACE_HAS_CONFIG ? &r->config : NULL;
    s->state = has & TAHR__TRACE_HAS_STATE ? &r->state : NULL;
    s->input = &r->input;
    r->in_step = s->flags & TAHR_RECORD_CUSTOM ? 2 : 1;
    r->asked = 0;
    return TAHR_OK;
}

static tahr_status read_done(tahr_trace_reader *r, tahr_trace_event *event)
{
    tahr__trace_bytes *in = &r->in;
    tahr_record_done *d = &event->done;

    if (!r->in_step) return tahr__trace_broken(r, "the begin of a step");
    d->status = (tahr_status)(uint32_t)tahr__trace_get(in, "a status");
    if (!in->bad && in->end - in->at < (ptrdiff_t)sizeof d->hash) in->bad = "a hash";
    if (in->bad) return tahr__trace_broken(r, in->bad);
    memcpy(&d->hash, in->at, sizeof d->hash);
    in->at += sizeof d->hash;
    event->kind = TAHR_TRACE_DONE;
    event->number = r->steps++;
    d->mover = r->mover;
    r->in_step = 0;
    return TAHR_OK;
}

static tahr_status read_last(tahr_trace_reader *r, tahr_trace_event *event)
{
    uint64_t steps = tahr__trace_get(&r->in, "a number of steps");

    if (r->in.bad || steps != r->steps || r->in_step) return tahr__trace_broken(r, "the number of steps in the file");
    if (!tahr__trace_is_over(r)) return tahr__trace_broken(r, "the end of the file");
    event->kind = TAHR_TRACE_END;
    event->number = steps;
    r->tag = TAHR__TRACE_LAST; /* for who asks again */
    r->in.at = r->in.end;
    return TAHR_OK;
}

tahr_status tahr_trace_next(tahr_trace_reader *r, tahr_trace_event *event)
{
    uint32_t tag, left = 0;

    if (!r || !event) return TAHR_E_NULL;
    memset(event, 0, sizeof *event);
    while ((tag = tahr__trace_peek(r)) >= TAHR__TRACE_SWEEP) {
        left += r->in_step == 1 && !(tag & TAHR__TRACE_DIRECT);
        if (tahr__trace_take_query(r) < 0) return r->status;
    }
    event->queries_left = left;
    event->number = r->steps;
    if (tag == 0) return r->status;
    if (tag == TAHR__TRACE_LAST && r->in.at == r->in.end) return TAHR_OK;
    r->tag = 0;
    switch (tag) {
    case TAHR__TRACE_CHANGE: return read_move(r, event);
    case TAHR__TRACE_BEGIN: return read_step(r, event);
    case TAHR__TRACE_FINISH: return read_done(r, event);
    case TAHR__TRACE_LAST: return read_last(r, event);
    default: return tahr__trace_broken(r, "a change, a step, its end, or the last record");
    }
}

void tahr_trace_reader_close(tahr_trace_reader *r)
{
    if (!r) return;
    if (r->file) fclose(r->file);
    free(r->bodies);
    free(r->inputs);
    free(r->poses);
    free(r);
}

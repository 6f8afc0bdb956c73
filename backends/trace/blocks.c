/* SPDX-License-Identifier: MIT
 * blocks.c: reading a trace block by block, and the records of queries in it. Nothing in a file is believed before it
 * was checked. */
#include "reader.h"

#include <stdlib.h>
#include <string.h>

static tahr_status broken_at(tahr_trace_reader *r, uint64_t byte, const char *what)
{
    char text[200];

    if (r->status < 0) return r->status;
    r->status = TAHR_E_FILE;
    snprintf(text, sizeof text, "tahr_trace: byte %llu: %s", (unsigned long long)byte, what);
    if (r->log.write) r->log.write(r->log.user, TAHR_LOG_ERROR, text);
    return r->status;
}

tahr_status tahr__trace_broken(tahr_trace_reader *r, const char *expected)
{
    char text[160];

    snprintf(text, sizeof text, "expected %s", expected);
    return broken_at(r, r->offset + (r->in.at ? (uint64_t)(r->in.at - r->buffer) : 0), text);
}

/* As much of size as there is; a function may give less at a time. */
static size_t read_bytes(tahr_trace_reader *r, void *bytes, size_t size)
{
    size_t got = 0;

    while (got < size) {
        size_t more = r->file ? fread((char *)bytes + got, 1, size - got, r->file)
                              : r->read(r->user, (char *)bytes + got, size - got);
        if (more == 0 || more > size - got) break;
        got += more;
    }
    return got;
}

static tahr_status read_block(tahr_trace_reader *r)
{
    struct {
        uint32_t size, number;
        uint64_t checksum;
    } frame;
    uint64_t begin = r->offset + (r->in.end ? (uint64_t)(r->in.end - r->buffer) : 0);
    size_t got = read_bytes(r, &frame, sizeof frame);
    char text[160];

    if (got < sizeof frame) return broken_at(r, begin + got, "the file is cut off, expected another block");
    if (frame.size == 0 || frame.size > sizeof r->buffer) {
        snprintf(text, sizeof text, "a block of %lu bytes, expected 1 to %lu", (unsigned long)frame.size,
                 (unsigned long)sizeof r->buffer);
        return broken_at(r, begin, text);
    }
    if (frame.number != r->block) {
        snprintf(text, sizeof text, "block %lu, expected %lu", (unsigned long)frame.number, (unsigned long)r->block);
        return broken_at(r, begin + 4, text);
    }
    got = read_bytes(r, r->buffer, frame.size);
    if (got < frame.size) {
        snprintf(text, sizeof text, "the file is cut off, expected %lu more bytes of a block",
                 (unsigned long)(frame.size - got));
        return broken_at(r, begin + sizeof frame + got, text);
    }
    if (tahr__trace_hash(tahr__trace_hash(0, &frame, 8), r->buffer, frame.size) != frame.checksum) {
        snprintf(text, sizeof text,
                 "the checksum of a block of %lu bytes does not fit, expected that of what was written",
                 (unsigned long)frame.size);
        return broken_at(r, begin + 8, text);
    }
    r->offset = begin + sizeof frame;
    r->block++;
    r->in = (tahr__trace_bytes){r->buffer, r->buffer + frame.size, NULL};
    return TAHR_OK;
}

uint32_t tahr__trace_peek(tahr_trace_reader *r)
{
    if (r->tag || r->status < 0) return r->status < 0 ? 0 : r->tag;
    if (r->in.at == r->in.end && read_block(r) < 0) return 0;
    r->tag = (uint32_t)tahr__trace_get(&r->in, "a record");
    if (r->tag == 0) tahr__trace_broken(r, "a record");
    return r->status < 0 ? 0 : r->tag;
}

static void get_cost(tahr_trace_reader *r)
{
    tahr_query_context *cost = &r->query.cost;

    cost->narrow_tests = tahr__trace_get(&r->in, "a number of tests");
    cost->narrow_iterations = tahr__trace_get(&r->in, "a number of iterations");
    cost->gathers = tahr__trace_get(&r->in, "a number of gathers");
    cost->escapes = tahr__trace_get(&r->in, "a number of escapes");
    cost->spared = tahr__trace_get(&r->in, "a number of spared sweeps");
    cost->cached = tahr__trace_get(&r->in, "a number of cached queries");
    cost->ends = tahr__trace_get(&r->in, "a number of ends");
}

/* How the answer was; how many follow is checked. */
static void get_outcome(tahr_trace_reader *r)
{
    tahr__trace_query *q = &r->query;

    q->status = (tahr_status)(uint32_t)tahr__trace_get(&r->in, "a status");
    q->count = (uint32_t)tahr__trace_get(&r->in, "a count");
    uint64_t kept = tahr__trace_get(&r->in, "a number of answers");
    if (kept > TAHR__TRACE_ANSWERS) r->in.bad = "at most 128 answers";
    q->kept = r->in.bad ? 0 : (uint32_t)kept;
}

static void get_hits(tahr_trace_reader *r)
{
    for (uint32_t i = 0; i < r->query.kept; i++)
        tahr__trace_get_words(&r->in, &r->query.hits[i], &r->bases.hit, sizeof(tahr_hit), "a hit");
}

tahr_status tahr__trace_take_query(tahr_trace_reader *r)
{
    tahr__trace_query *q = &r->query;
    tahr__trace_bytes *in = &r->in;

    q->kind = r->tag & ~(uint32_t)TAHR__TRACE_DIRECT;
    r->tag = 0;
    switch (q->kind) {
    case TAHR__TRACE_SWEEP:
        tahr__trace_get_words(in, &q->sweep, &r->bases.sweep, sizeof q->sweep, "a sweep");
        q->capacity = (uint32_t)tahr__trace_get(in, "a capacity");
        get_cost(r);
        get_outcome(r);
        get_hits(r);
        break;
    case TAHR__TRACE_CONTACTS:
        tahr__trace_get_words(in, &q->contacts, &r->bases.contacts, sizeof q->contacts, "a contact query");
        q->capacity = (uint32_t)tahr__trace_get(in, "a capacity");
        get_cost(r);
        get_outcome(r);
        for (uint32_t i = 0; i < q->kept; i++)
            tahr__trace_get_words(in, &q->found[i], &r->bases.contact, sizeof q->found[i], "a contact");
        break;
    case TAHR__TRACE_RAY:
        tahr__trace_get_words(in, &q->ray, &r->bases.ray, sizeof q->ray, "a ray");
        get_cost(r);
        get_outcome(r);
        get_hits(r);
        break;
    case TAHR__TRACE_FLUID:
        tahr__trace_get_words(in, &q->fluid, &r->bases.fluid, sizeof q->fluid, "a fluid query");
        get_cost(r);
        get_outcome(r);
        if (q->kept)
            tahr__trace_get_words(in, &q->fluid_answer, &r->bases.fluid_answer, sizeof q->fluid_answer, "a fluid");
        break;
    case TAHR__TRACE_MOTION:
        q->body = (uint32_t)tahr__trace_get(in, "a body");
        get_outcome(r);
        if (q->kept) tahr__trace_get_words(in, &q->motion, &r->bases.motion, sizeof q->motion, "a motion");
        break;
    case TAHR__TRACE_PREPARE:
        get_cost(r);
        get_outcome(r);
        break;
    default: in->bad = "a known record"; break;
    }
    return in->bad ? tahr__trace_broken(r, in->bad) : TAHR_OK;
}

void *tahr__trace_grow(void *memory, uint32_t count, uint32_t *room, size_t size)
{
    uint32_t more = *room < 8 ? 8 : *room * 2;
    void *larger = memory;

    if (count == *room) {
        larger = realloc(memory, more * size);
        if (larger) *room = more;
    }
    return larger;
}

int tahr__trace_is_over(tahr_trace_reader *r)
{
    char one;
    return r->in.at == r->in.end && read_bytes(r, &one, 1) == 0;
}

/* The head of the file and all that is known of the world before its first step. */
static tahr_status read_head(tahr_trace_reader *r)
{
    tahr__trace_head head, wanted;
    size_t got = read_bytes(r, &head, sizeof head);
    char text[160];

    tahr__trace_head_fill(&wanted);
    if (got < sizeof head) {
        if (memcmp(&head, &wanted, got < sizeof head.magic ? got : sizeof head.magic) != 0)
            return broken_at(r, 0, "no trace, expected the letters " TAHR__TRACE_MAGIC);
        return broken_at(r, got, "the file is cut off, expected its head");
    }
    if (memcmp(head.magic, wanted.magic, sizeof head.magic) != 0)
        return broken_at(r, 0, "no trace, expected the letters " TAHR__TRACE_MAGIC);
    if (head.checksum != tahr__trace_hash(0, &head, offsetof(tahr__trace_head, checksum)))
        return broken_at(r, offsetof(tahr__trace_head, checksum),
                         "the checksum of the head does not fit, expected that of what was written");
    if (memcmp(&head, &wanted, sizeof head) != 0) {
        snprintf(text, sizeof text, "recorded as version %lu of the format with ABI %lu.%lu, expected %d with %d.%d%s",
                 (unsigned long)head.version, (unsigned long)head.abi >> 16, (unsigned long)head.abi & 0xFFFF,
                 TAHR__TRACE_VERSION, TAHR_ABI_MAJOR, TAHR_ABI_MINOR,
                 head.abi == wanted.abi && head.version == wanted.version ? " and other sizes of structs" : "");
        broken_at(r, 8, text);
        return TAHR_E_ABI;
    }
    r->offset = sizeof head;
    return TAHR_OK;
}

static tahr_status read_world(tahr_trace_reader *r)
{
    tahr__trace_bytes *in = &r->in;
    tahr_record_world *w = &r->world;
    uint32_t room = 0;

    if (tahr__trace_peek(r) != TAHR__TRACE_WORLD) return tahr__trace_broken(r, "the world");
    r->tag = 0;
    tahr__trace_get_text(in, r->name, sizeof r->name, "the name of a backend");
    tahr__trace_get_text(in, r->version, sizeof r->version, "the version of a backend");
    r->capabilities = (uint32_t)tahr__trace_get(in, "capabilities");
    r->slots = (uint32_t)tahr__trace_get(in, "slots");
    uint32_t count = (uint32_t)tahr__trace_get(in, "a number of bodies");
    w->has = (uint32_t)tahr__trace_get(in, "what a world has");
    w->moves = (uint32_t)tahr__trace_get(in, "a number of moves");
    w->revision = tahr__trace_get(in, "a revision");
    w->motion = tahr__trace_get(in, "a motion");
    w->last_revision = tahr__trace_get(in, "a revision");
    w->derived = (uint32_t)tahr__trace_get(in, "the most sweeps of a contacts query");
    if (in->bad) return tahr__trace_broken(r, in->bad);
    while (w->body_count < count) {
        void *more = tahr__trace_grow(r->bodies, w->body_count, &room, sizeof *r->bodies);
        if (!more) return r->status = TAHR_E_MEMORY;
        r->bodies = more;
        if (tahr__trace_peek(r) != TAHR__TRACE_BODY) return tahr__trace_broken(r, "a body");
        r->tag = 0;
        tahr__trace_get_words(in, &r->bodies[w->body_count++], &r->bases.body, sizeof *r->bodies, "a body");
        if (in->bad) return tahr__trace_broken(r, in->bad);
    }
    return TAHR_OK;
}

tahr_status tahr__trace_read_begin(tahr_trace_reader *r)
{
    tahr_status status = read_head(r);
    return status < 0 ? status : read_world(r);
}

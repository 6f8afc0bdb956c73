/* SPDX-License-Identifier: MIT
 * answers.c: the slots of a replay: each query must be the recorded one, bit for bit, and is answered like it. */
#include "reader.h"

#include <stdarg.h>
#include <string.h>

/* Keeps and logs the first difference. Returns TAHR_E_BACKEND. */
static tahr_status differ(tahr_trace_reader *r, const char *format, ...)
{
    char what[160];
    va_list list;

    if (r->differs) return TAHR_E_BACKEND;
    r->differs = 1;
    va_start(list, format);
    vsnprintf(what, sizeof what, format, list);
    va_end(list);
    snprintf(r->difference, sizeof r->difference, "step %llu, mover %lu, query %lu: %s", (unsigned long long)r->steps,
             (unsigned long)r->mover, (unsigned long)r->asked, what);
    if (r->log.write) r->log.write(r->log.user, TAHR_LOG_ERROR, r->difference);
    return TAHR_E_BACKEND;
}

/* Takes the record of the query that must come now. */
static tahr_status expect(tahr_trace_reader *r, uint32_t kind)
{
    uint32_t tag;

    if (!r->in_step) return TAHR_E_UNSUPPORTED;
    if (r->differs) return TAHR_E_BACKEND;
    while ((tag = tahr__trace_peek(r)) > TAHR__TRACE_DIRECT) {
        if (tahr__trace_take_query(r) < 0) return TAHR_E_BACKEND;
    }
    if (tag == 0) return TAHR_E_BACKEND;
    r->asked++;
    if (tag != kind) {
        return differ(r, "asked is %s, recorded is %s", tahr__trace_kind_name(kind),
                      tag >= TAHR__TRACE_SWEEP ? tahr__trace_kind_name(tag) : "the end of the step");
    }
    return tahr__trace_take_query(r) < 0 ? TAHR_E_BACKEND : TAHR_OK;
}

static tahr_status expect_query(tahr_trace_reader *r, uint32_t kind, const void *asked, const void *recorded)
{
    double values[2] = {0, 0};
    tahr_status status = expect(r, kind);

    if (status < 0) return status;
    const char *field = tahr__trace_compare(kind, asked, recorded, values);
    if (!field) return TAHR_OK;
    return differ(r, "%s.%s is %.17g, recorded is %.17g", tahr__trace_kind_name(kind), field, values[0], values[1]);
}

/* Was there as much room for answers? */
static tahr_status expect_room(tahr_trace_reader *r, tahr_status status, uint32_t capacity)
{
    if (status < 0 || capacity == r->query.capacity) return status;
    return differ(r, "room for %lu answers, recorded is %lu", (unsigned long)capacity,
                  (unsigned long)r->query.capacity);
}

/* The query cost what it cost then. */
static void charge(const tahr_trace_reader *r, tahr_query_context *context)
{
    const tahr_query_context *cost = &r->query.cost;

    context->narrow_tests += cost->narrow_tests;
    context->narrow_iterations += cost->narrow_iterations;
    context->gathers += cost->gathers;
    context->escapes += cost->escapes;
    context->spared += cost->spared;
    context->cached += cost->cached;
    context->ends += cost->ends;
}

/* Of a file that lies no more than there is room for. */
static uint32_t kept(const tahr_trace_reader *r, uint32_t capacity)
{
    return r->query.kept < capacity ? r->query.kept : capacity;
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    tahr_trace_reader *r = self;
    tahr_status status = expect_query(r, TAHR__TRACE_SWEEP, query, &r->query.sweep);

    status = expect_room(r, status, capacity);
    if (status < 0) return status;
    charge(r, context);
    memcpy(hits, r->query.hits, kept(r, capacity) * sizeof hits[0]);
    *count = r->query.count > capacity ? r->query.count : kept(r, capacity);
    return r->query.status;
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    tahr_trace_reader *r = self;
    tahr_status status = expect_query(r, TAHR__TRACE_CONTACTS, query, &r->query.contacts);

    status = expect_room(r, status, capacity);
    if (status < 0) return status;
    charge(r, context);
    memcpy(found, r->query.found, kept(r, capacity) * sizeof found[0]);
    *count = r->query.count > capacity ? r->query.count : kept(r, capacity);
    return r->query.status;
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    tahr_trace_reader *r = self;
    tahr_status status = expect_query(r, TAHR__TRACE_RAY, query, &r->query.ray);

    if (status < 0) return status;
    charge(r, context);
    memcpy(hit, r->query.hits, kept(r, 1) * sizeof *hit);
    *count = r->query.count > 1 ? r->query.count : kept(r, 1);
    return r->query.status;
}

static tahr_status prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    tahr_trace_reader *r = self;

    (void)announcement;
    if (!r->in_step || r->differs || tahr__trace_peek(r) != TAHR__TRACE_PREPARE) return TAHR_OK;
    if (tahr__trace_take_query(r) < 0) return TAHR_E_BACKEND;
    charge(r, context);
    return r->query.status;
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    (void)self, (void)poses, (void)count;
    return TAHR_OK;
}

static tahr_status body_motion(void *self, uint32_t body, tahr_body_motion *motion)
{
    tahr_trace_reader *r = self;
    tahr_status status = expect(r, TAHR__TRACE_MOTION);

    if (status < 0) return status;
    if (body != r->query.body)
        return differ(r, "body is %lu, recorded is %lu", (unsigned long)body, (unsigned long)r->query.body);
    if (r->query.kept) *motion = r->query.motion;
    return r->query.status;
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    tahr_trace_reader *r = self;
    tahr_status status = expect_query(r, TAHR__TRACE_FLUID, query, &r->query.fluid);

    if (status < 0) return status;
    charge(r, context);
    if (r->query.kept) *answer = r->query.fluid_answer;
    return r->query.status;
}

/* The world becomes the recorded one; its own backend stays for the day when the replay is over. */
static tahr_status begin(void *user, tahr_record_world *world)
{
    tahr_trace_reader *r = user;
    const tahr_record_world *w = &r->world;
    char text[120];

    if (world->body_count != w->body_count) {
        snprintf(text, sizeof text, "tahr_trace: the world has %lu bodies, expected %lu as in the file",
                 (unsigned long)world->body_count, (unsigned long)w->body_count);
        if (r->log.write) r->log.write(r->log.user, TAHR_LOG_ERROR, text);
        return TAHR_E_ARGUMENT;
    }
    r->table = (tahr_backend){.struct_size = sizeof r->table,
                              .abi_major = TAHR_ABI_MAJOR,
                              .abi_minor = TAHR_ABI_MINOR,
                              .capabilities = r->capabilities,
                              .name = r->name,
                              .version = r->version,
                              .open = world->backend->open,
                              .close = world->backend->close,
                              .sweep = sweep,
                              .contacts = contacts,
                              .ray = ray,
                              .prepare = prepare,
                              .place = r->slots & 1 ? place : NULL,
                              .body_motion = r->slots & 2 ? body_motion : NULL,
                              .fluid = r->slots & 4 ? fluid : NULL};
    if (w->body_count > 0) memcpy(world->bodies, r->bodies, w->body_count * sizeof *r->bodies);
    world->revision = w->revision;
    world->motion = w->motion;
    world->last_revision = w->last_revision;
    world->has = w->has;
    world->moves = w->moves;
    world->derived = w->derived;
    world->backend = &r->table;
    world->self = r;
    return TAHR_OK;
}

void tahr__trace_answer(tahr_trace_reader *r)
{
    r->recorder =
        (tahr_recorder){.struct_size = sizeof r->recorder, .flags = TAHR_RECORDER_RESTORES, .user = r, .begin = begin};
}

/* SPDX-License-Identifier: MIT
 * wrap.c: the slots that stand in front of the recorded backend: each asks it, hands its answer back as it came, and
 * writes down both. */
#include "writer.h"

/* Begins the record of a query; 0 if it is not recorded. */
static int note(tahr_trace *trace, uint32_t kind)
{
    if (!trace->in_step && trace->flags & TAHR_TRACE_STEPS_ONLY) return 0;
    trace->queries++;
    return tahr__trace_begin(trace, kind | (trace->in_step ? 0u : (uint32_t)TAHR__TRACE_DIRECT));
}

/* What the query cost, so that a replay's report has the same counts. */
static void put_cost(tahr_trace *trace, const tahr_query_context *before, const tahr_query_context *after)
{
    tahr__trace_put(&trace->out, after->narrow_tests - before->narrow_tests);
    tahr__trace_put(&trace->out, after->narrow_iterations - before->narrow_iterations);
    tahr__trace_put(&trace->out, after->gathers - before->gathers);
    tahr__trace_put(&trace->out, after->escapes - before->escapes);
    tahr__trace_put(&trace->out, after->spared - before->spared);
    tahr__trace_put(&trace->out, after->cached - before->cached);
    tahr__trace_put(&trace->out, after->ends - before->ends);
}

static int is_work(const tahr_query_context *before, const tahr_query_context *after)
{
    return after->narrow_tests != before->narrow_tests || after->narrow_iterations != before->narrow_iterations ||
           after->gathers != before->gathers || after->escapes != before->escapes;
}

/* How the answer was, before the answers: of what is invalid as much as there can be. Returns how many follow. */
static uint32_t put_outcome(tahr_trace *trace, tahr_status status, uint32_t count, uint32_t capacity)
{
    uint32_t kept = status < 0 ? 0 : count < capacity ? count : capacity;

    tahr__trace_put(&trace->out, (uint32_t)status);
    tahr__trace_put(&trace->out, count);
    if (kept > TAHR__TRACE_ANSWERS) {
        tahr__trace_give_up(trace, TAHR_E_UNSUPPORTED, "more than 128 answers to one query");
        return 0;
    }
    tahr__trace_put(&trace->out, kept);
    return kept;
}

static void put_hits(tahr_trace *trace, const tahr_hit *hits, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        tahr__trace_put_words(&trace->out, &hits[i], &trace->bases.hit, sizeof hits[i]);
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    tahr_trace *trace = self;
    const tahr_query_context before = *context;
    tahr_status status = trace->inner->sweep(trace->inner_self, context, query, hits, capacity, count);

    if (note(trace, TAHR__TRACE_SWEEP)) {
        tahr__trace_put_words(&trace->out, query, &trace->bases.sweep, sizeof *query);
        tahr__trace_put(&trace->out, capacity);
        put_cost(trace, &before, context);
        put_hits(trace, hits, put_outcome(trace, status, *count, capacity));
    }
    return status;
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    tahr_trace *trace = self;
    const tahr_query_context before = *context;
    tahr_status status = trace->inner->contacts(trace->inner_self, context, query, found, capacity, count);

    uint64_t tests = context->narrow_tests - before.narrow_tests;
    if (note(trace, TAHR__TRACE_CONTACTS)) {
        trace->queries += trace->derived && tests > 1 ? tests - 1 : 0;
        tahr__trace_put_words(&trace->out, query, &trace->bases.contacts, sizeof *query);
        tahr__trace_put(&trace->out, capacity);
        put_cost(trace, &before, context);
        uint32_t kept = put_outcome(trace, status, *count, capacity);
        for (uint32_t i = 0; i < kept; i++)
            tahr__trace_put_words(&trace->out, &found[i], &trace->bases.contact, sizeof found[i]);
    }
    return status;
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    tahr_trace *trace = self;
    const tahr_query_context before = *context;
    tahr_status status = trace->inner->ray(trace->inner_self, context, query, hit, count);

    if (note(trace, TAHR__TRACE_RAY)) {
        tahr__trace_put_words(&trace->out, query, &trace->bases.ray, sizeof *query);
        put_cost(trace, &before, context);
        put_hits(trace, hit, put_outcome(trace, status, *count, 1));
    }
    return status;
}

static size_t cache_size(void *self)
{
    tahr_trace *trace = self;
    return trace->inner->cache_size(trace->inner_self);
}

/* An announcement has no answer: only a failure counts, and what it cost. */
static tahr_status prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    tahr_trace *trace = self;
    const tahr_query_context before = *context;
    tahr_status status = trace->inner->prepare(trace->inner_self, context, announcement);

    if ((status < 0 || is_work(&before, context)) && tahr__trace_begin(trace, TAHR__TRACE_PREPARE)) {
        put_cost(trace, &before, context);
        put_outcome(trace, status, 0, 0);
    }
    return status;
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    tahr_trace *trace = self;
    return trace->inner->place(trace->inner_self, poses, count);
}

static tahr_status body_motion(void *self, uint32_t body, tahr_body_motion *motion)
{
    tahr_trace *trace = self;
    tahr_status status = trace->inner->body_motion(trace->inner_self, body, motion);

    if (note(trace, TAHR__TRACE_MOTION)) {
        tahr__trace_put(&trace->out, body);
        if (put_outcome(trace, status, 1, 1))
            tahr__trace_put_words(&trace->out, motion, &trace->bases.motion, sizeof *motion);
    }
    return status;
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    tahr_trace *trace = self;
    const tahr_query_context before = *context;
    tahr_status status = trace->inner->fluid(trace->inner_self, context, query, answer);

    if (note(trace, TAHR__TRACE_FLUID)) {
        tahr__trace_put_words(&trace->out, query, &trace->bases.fluid, sizeof *query);
        put_cost(trace, &before, context);
        if (put_outcome(trace, status, 1, 1))
            tahr__trace_put_words(&trace->out, answer, &trace->bases.fluid_answer, sizeof *answer);
    }
    return status;
}

void tahr__trace_wrap(tahr_trace *trace)
{
    const tahr_backend *inner = trace->inner;

    trace->table = (tahr_backend){.struct_size = sizeof trace->table,
                                  .abi_major = TAHR_ABI_MAJOR,
                                  .abi_minor = TAHR_ABI_MINOR,
                                  .capabilities = inner->capabilities,
                                  .name = inner->name,
                                  .version = inner->version,
                                  .open = inner->open,
                                  .close = inner->close,
                                  .sweep = sweep,
                                  .contacts = contacts,
                                  .ray = ray,
                                  .cache_size = inner->cache_size ? cache_size : NULL,
                                  .prepare = inner->prepare ? prepare : NULL,
                                  .place = inner->place ? place : NULL,
                                  .body_motion = inner->body_motion ? body_motion : NULL,
                                  .fluid = inner->fluid ? fluid : NULL};
}

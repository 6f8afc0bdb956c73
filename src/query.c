/* SPDX-License-Identifier: MIT
 * query.c: the questions of a step: what is asked is counted and capped, and recorded if somebody wants to see it. */
#include "query.h"

#include <stdio.h>

#include "answer.h"
#include "backend_check.h"
#include "drop.h"
#include "message.h"
#include "neighbours.h"
#include "plane.h"
#include "query_record.h"
#include "trail.h"

/* Field by field: compilers clear more than 96 bytes at once with a slow string instruction. */
static void set_free(tahr_hit *hit)
{
    const vec3 none = {0, 0, 0};
    hit->blocking = hit->start_overlap = hit->unknown = hit->sensor = 0;
    hit->fraction = 1;
    hit->distance = hit->depth = 0;
    hit->normal = hit->surface_normal = hit->point = none;
    hit->walkable_angle = 0;
    hit->walkable_rule = hit->surface = hit->feature = 0;
    hit->body = TAHR_NO_BODY;
}

/* Counts a query; 0 when the step may not ask any more. */
static int may_ask(tahr__step *step)
{
    if (step->error < 0) {
        return 0;
    }
    if (step->queries >= TAHR_MAX_QUERIES_PER_STEP) {
        step->report.flags |= TAHR_REPORT_QUERY_CAP;
        return 0;
    }
    step->queries++;
    return 1;
}

static int has_room(tahr__step *step, uint32_t queries)
{
    int room = step->queries + queries <= TAHR_MAX_QUERIES_PER_STEP;
    step->report.flags |= room ? 0u : (uint32_t)TAHR_REPORT_QUERY_CAP;
    return room;
}

static void blocked_here(const tahr__step *step, tahr_hit *hit)
{
    *hit = (tahr_hit){.blocking = 1, .unknown = 1, .body = TAHR_NO_BODY};
    hit->normal = hit->surface_normal = step->state.up;
}

/* Deeper than this (m) is an overlap; less is the rounding of a touch: of somebody put exactly onto a floor. */
static const double TOUCHING = 1e-7;

/* An overlap that is a touch blocks what approaches, and what leaves is asked for again, which counts as another. */
static tahr_status touch(tahr__step *step, const tahr_shape *shape, tahr_sweep *q, tahr_hit *hit, uint32_t *count)
{
    if (dot(hit->normal, q->motion) < 0 || q->flags & TAHR_SWEEP_LEAVE_OVERLAP || !may_ask(step)) {
        hit->start_overlap = 0;
        hit->distance = hit->depth = 0;
        return TAHR_OK;
    }
    q->flags |= TAHR_SWEEP_LEAVE_OVERLAP;
    step->report.sweeps++;
    return step->trail && shape == &step->limits->shape ? tahr__sensing_sweep(step, q, hit, count)
                                                        : answer_sweep(step->world, &step->context, q, hit, 1, count);
}

void tahr__sweep(tahr__step *step, const tahr_shape *shape, vec3 from, vec3 motion, double margin, uint32_t flags,
                 tahr_hit *hit)
{
    uint32_t count = 0;
    if (!may_ask(step)) {
        blocked_here(step, hit);
        return;
    }
    flags |= step->passes ? (uint32_t)TAHR_SWEEP_PASS : 0u;
    if (is_dropping(step)) {
        flags |= TAHR_SWEEP_DROP;
        margin = max_of(margin, drop_margin(step->config));
    }
    tahr_sweep q = {.shape = *shape,
                    .position = from,
                    .up = step->state.up,
                    .orientation = step->state.orientation,
                    .motion = motion,
                    .margin = margin,
                    .mask = step->config->mask,
                    .ignore_body = step->ignore_body,
                    .flags = flags};
    step->report.sweeps++;
    tahr_status status = step->trail && shape == &step->limits->shape
                             ? tahr__sensing_sweep(step, &q, hit, &count)
                             : answer_sweep(step->world, &step->context, &q, hit, 1, &count);
    if (status >= 0 && count > 0 && hit->start_overlap && hit->depth <= TOUCHING) {
        status = touch(step, shape, &q, hit, &count);
    }
    if (step->neighbours && status >= 0) {
        tahr__neighbours_sweep(step->neighbours, &q, hit, &count);
    }
    if (status < 0) {
        step->error = status;
        blocked_here(step, hit);
        return;
    }
    if (count == 0 || !(hit->blocking || hit->start_overlap || hit->unknown)) {
        count = 0;
        set_free(hit);
    } else {
        hit->blocking = 1;
        if (hit->unknown) {
            step->report.flags |= TAHR_REPORT_UNKNOWN;
            tahr__make_wall(hit, from, motion, margin);
        }
    }
    if (step->report.queries) {
        tahr__record_sweep(step, &q, hit, count);
    }
}

void tahr__sweep_barred(tahr__step *step)
{
    step->report.saved[TAHR_SHORTCUT_BARRED_STEP] += (uint32_t)may_ask(step);
}

uint32_t tahr__sensors(tahr__step *step, vec3 from, vec3 motion, uint32_t ignore_body, tahr_hit *hits,
                       uint32_t capacity)
{
    uint32_t count = 0, kept = 0;
    if (step->error < 0) {
        return 0;
    }
    tahr_sweep q = {.shape = step->limits->shape,
                    .position = from,
                    .up = step->state.up,
                    .orientation = step->state.orientation,
                    .motion = motion,
                    .mask = step->config->mask,
                    .ignore_body = ignore_body,
                    .flags = TAHR_SWEEP_SENSORS | TAHR_SWEEP_LEAVE_OVERLAP};
    step->report.sweeps++;
    tahr_status status = answer_sweep(step->world, &step->context, &q, hits, capacity, &count);
    if (status < 0) {
        step->error = status;
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) { /* a backend that does not know the flag may add what blocks */
        if (hits[i].unknown) {
            tahr__make_wall(&hits[i], from, motion, 0);
        }
        if (hits[i].sensor) {
            hits[kept++] = hits[i];
        }
    }
    if (status == TAHR_TRUNCATED) {
        step->report.flags |= TAHR_REPORT_TOUCHED_LOST;
    }
    if (step->report.queries) {
        tahr__record_sweep(step, &q, hits, kept);
    }
    return kept;
}

uint32_t tahr__contacts_of(tahr__step *step, const tahr_shape *shape, vec3 position, double margin,
                           tahr_contact *contacts, uint32_t capacity)
{
    uint32_t count = 0, kept = 0;
    const uint32_t derived = step->world->derived;
    if (!may_ask(step) || (derived && !has_room(step, derived - 1))) {
        return 0;
    }
    uint64_t before = step->context.narrow_tests;
    tahr_contact_query q = {.shape = *shape,
                            .position = position,
                            .up = step->state.up,
                            .orientation = step->state.orientation,
                            .margin = margin,
                            .mask = step->config->mask,
                            .ignore_body = step->ignore_body,
                            .flags = TAHR_CONTACTS_SOLID | (is_dropping(step) ? (uint32_t)TAHR_CONTACTS_DROP : 0u)};
    step->report.contact_queries++;
    tahr_status status = tahr__answer_contacts(step->world, &step->context, &q, contacts, capacity, &count);
    if (derived && step->context.narrow_tests > before) { /* one for each sweep; the first is the query itself */
        uint64_t made = step->context.narrow_tests - before;
        uint32_t more = made < derived ? (uint32_t)made - 1 : derived - 1;
        step->queries += more;
        step->report.sweeps += more;
    }
    if (status < 0) {
        step->error = status;
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!contacts[i].sensor) {
            contacts[kept++] = contacts[i];
        }
    }
    if (step->neighbours) {
        kept = tahr__neighbours_contacts(step->neighbours, &q, contacts, capacity, kept);
    }
    if (step->report.queries) {
        tahr__record_contacts(step, &q, contacts, kept);
    }
    return kept;
}

uint32_t tahr__contacts(tahr__step *step, vec3 position, double margin, tahr_contact *contacts, uint32_t capacity)
{
    return tahr__contacts_of(step, &step->limits->shape, position, margin, contacts, capacity);
}

void tahr__ray(tahr__step *step, vec3 origin, vec3 motion, tahr_hit *hit)
{
    uint32_t count = 0;
    if (!may_ask(step)) {
        blocked_here(step, hit);
        return;
    }
    tahr_ray q = {.origin = origin, .motion = motion, .mask = step->config->mask, .ignore_body = step->ignore_body};
    step->report.rays++;
    tahr_status status = tahr__answer_ray(step->world, &step->context, &q, hit, &count);
    if (status < 0) {
        step->error = status;
        blocked_here(step, hit);
        return;
    }
    if (count == 0) {
        set_free(hit);
    } else if (hit->unknown) {
        tahr__make_wall(hit, origin, motion, 0);
    }
    if (step->report.queries) {
        tahr__record_ray(step, &q, hit, count);
    }
}

tahr_fluid tahr__fluid(tahr__step *step, vec3 position)
{
    tahr_fluid fluid = {.body = TAHR_NO_BODY};
    if (!step_has_fluids(step) || !may_ask(step)) {
        return fluid;
    }
    if (step->calm) { /* as good as asked, of those that a step may ask */
        return fluid;
    }
    tahr_fluid_query q = {.position = position,
                          .up = step->state.up,
                          .radius = step->limits->width,
                          .half_height = step->limits->shape.half_height,
                          .mask = step->config->mask};
    step->report.fluid_queries++;
    tahr_status status = tahr__answer_fluid(step->world, &step->context, &q, &fluid);
    if (status < 0) {
        step->error = status;
        return (tahr_fluid){.body = TAHR_NO_BODY};
    }
    if (step->report.queries) {
        tahr__record_fluid(step, &q, &fluid);
    }
    fluid.velocity = along_plane(step->limits, fluid.velocity);
    return fluid;
}

void tahr__announce(tahr__step *step, const tahr_prepare *announcement)
{
    tahr_status status = answer_prepare(step->world, &step->context, announcement);
    if (status < 0) {
        step->error = status;
    }
}

/* What a backend must be able to do to sweep a shape; all bits for one that nobody knows. */
static uint32_t needed_by(const tahr_shape *shape)
{
    static const uint32_t needed[] = {0,
                                      TAHR_CAP_SPHERE,
                                      TAHR_CAP_CAPSULE,
                                      TAHR_CAP_BOX,
                                      TAHR_CAP_CYLINDER,
                                      TAHR_CAP_CONE,
                                      TAHR_CAP_ELLIPSOID,
                                      TAHR_CAP_HULL | TAHR_CAP_MARGIN}; /* nothing inflates a hull */
    return shape->type > 0 && shape->type < sizeof needed / sizeof needed[0] ? needed[shape->type] : ~0u;
}

int tahr__can_sweep(const tahr_world *world, const tahr_shape *shape)
{
    return (needed_by(shape) & ~world->backend->capabilities) == 0;
}

tahr_status tahr__cannot_sweep(const tahr_world *world, const char *function, const tahr_shape *shape)
{
    char text[128];
    snprintf(text, sizeof text, "is not among the shapes that backend %.40s sweeps: it lacks %s", world->backend->name,
             tahr__capability_name(needed_by(shape) & ~world->backend->capabilities));
    return tahr__complain(&world->log, TAHR_E_UNSUPPORTED, function, "shape.type", text);
}

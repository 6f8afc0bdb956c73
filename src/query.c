/* SPDX-License-Identifier: MIT
 * query.c: the only file that calls backend slots. Checks every question and every answer: a backend may lie, and what
 * it says decides where a character goes. */
#include "query.h"

#include <string.h>

#include "message.h"
#include "plane.h"
#include "report.h"
#include "shape.h"
#include "trail.h"

/* Normals of user callbacks are often single precision: their length is accepted within this and then made exact. */
static const double UNIT_TOLERANCE = 1e-3;

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

static int is_unit(vec3 n)
{
    double l = length_squared(n);
    return l > (1 - UNIT_TOLERANCE) * (1 - UNIT_TOLERANCE) && l < (1 + UNIT_TOLERANCE) * (1 + UNIT_TOLERANCE);
}

static const char *bad_rule(uint32_t rule, double angle)
{
    if (rule > TAHR_WALKABLE_NEVER) {
        return "walkable_rule";
    }
    return is_finite(angle) ? NULL : "walkable_angle";
}

/* What hits and contacts say of the surface. */
static const char *bad_surface(vec3 normal, vec3 surface_normal, vec3 point, uint32_t rule, double angle)
{
    if (!is_unit(normal)) {
        return "normal";
    }
    if (!is_unit(surface_normal)) {
        return "surface_normal";
    }
    return vec_is_finite(point) ? bad_rule(rule, angle) : "point";
}

static const char *bad_hit(const tahr_hit *h)
{
    if (!(h->fraction >= 0 && h->fraction <= 1)) {
        return "fraction";
    }
    if (h->unknown || (!h->blocking && !h->sensor && !h->start_overlap)) {
        return NULL;
    }
    if (h->start_overlap && !(h->depth >= 0 && is_finite(h->depth))) {
        return "depth";
    }
    if (!is_finite(h->distance)) {
        return "distance";
    }
    return bad_surface(h->normal, h->surface_normal, h->point, h->walkable_rule, h->walkable_angle);
}

static const char *bad_contact(const tahr_contact *c)
{
    if (!is_finite(c->distance)) {
        return "distance";
    }
    return bad_surface(c->normal, c->surface_normal, c->point, c->walkable_rule, c->walkable_angle);
}

/* Unit to double precision: such a normal keeps its bits. */
static inline int is_exact(vec3 n)
{
    double l = length_squared(n);
    return l > 1 - 1e-15 && l < 1 + 1e-15;
}

static vec3 exact_unit(vec3 n)
{
    return is_exact(n) ? n : unit(n);
}

/* What almost every hit is: nothing to find bad, and nothing to make exact. A sum is finite only if all its terms
 * are. */
static inline int is_flawless(const tahr_hit *h)
{
    double sum = ((h->point.x + h->point.y) + (h->point.z + h->distance)) + h->walkable_angle;
    return h->fraction >= 0 && h->fraction <= 1 && !h->start_overlap && !h->unknown && is_exact(h->normal) &&
           is_exact(h->surface_normal) && is_finite(sum) && h->walkable_rule <= TAHR_WALKABLE_NEVER;
}

/* Returns the name of the first bad field, or makes the normals exact. */
static const char *refine(tahr_hit *h)
{
    if (is_flawless(h)) {
        return NULL;
    }
    const char *bad = bad_hit(h);
    if (!bad) {
        h->normal = exact_unit(h->normal);
        h->surface_normal = exact_unit(h->surface_normal);
    }
    return bad;
}

static tahr_status bad_answer(const tahr_world *world, const char *slot, const char *field)
{
    return tahr__complain(&world->log, TAHR_E_BACKEND, slot, field, "in the answer is invalid");
}

/* A backend without the margin gets round shapes inflated: then its overlap of depth d is a gap of margin - d. */
static void inflate(tahr_sweep *q)
{
    q->shape.radius += q->margin;
    q->shape.half_height += q->margin;
    q->shape.half_x += q->shape.type == TAHR_SHAPE_BOX ? q->margin : 0;
    q->shape.half_y += q->shape.type == TAHR_SHAPE_BOX ? q->margin : 0;
    if (q->shape.type == TAHR_SHAPE_BOX) {
        q->shape.radius = 0;
    }
    q->flags |= TAHR_SWEEP_LEAVE_OVERLAP;
    q->margin = 0;
}

static void deflate(const tahr_sweep *q, double margin, tahr_hit *h)
{
    if (h->start_overlap && h->depth <= margin) {
        h->start_overlap = 0;
        h->blocking = !h->sensor && dot(h->normal, q->motion) < 0;
        h->distance = margin - h->depth;
        h->depth = 0;
    } else if (h->start_overlap) {
        h->depth -= margin;
        h->distance = -h->depth;
    } else {
        h->distance = margin;
    }
}

static tahr_status check_hits(const tahr_world *world, tahr_status status, tahr_hit *hits, uint32_t capacity,
                              uint32_t count)
{
    if (status < 0 || count > capacity) {
        return bad_answer(world, "sweep", status < 0 ? "status" : "count");
    }
    for (uint32_t i = 0; i < count; i++) {
        const char *bad = refine(&hits[i]);
        if (bad) {
            return bad_answer(world, "sweep", bad);
        }
    }
    return status;
}

static inline tahr_status margin_sweep(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
                                       tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    *count = 0;
    tahr_status status = world->backend->sweep(world->self, context, query, hits, capacity, count);
    if (status == TAHR_OK && (*count == 0 || (*count == 1 && is_flawless(hits)))) {
        return status;
    }
    return check_hits(world, status, hits, capacity, *count);
}

static tahr_status inflated_sweep(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
                                  tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    tahr_sweep larger = *query;
    inflate(&larger);
    tahr_status status = margin_sweep(world, context, &larger, hits, capacity, count);
    for (uint32_t i = 0; status >= 0 && i < *count; i++) {
        deflate(query, query->margin, &hits[i]);
    }
    return status;
}

static tahr_status checked_contacts(const tahr_world *world, tahr_query_context *context, const tahr_contact_query *query,
                                    tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    *count = 0;
    tahr_status status = world->backend->contacts(world->self, context, query, contacts, capacity, count);
    if (status < 0 || *count > capacity) {
        return bad_answer(world, "contacts", status < 0 ? "status" : "count");
    }
    for (uint32_t i = 0; i < *count; i++) {
        const char *bad = bad_contact(&contacts[i]);
        if (bad) {
            return bad_answer(world, "contacts", bad);
        }
        contacts[i].normal = exact_unit(contacts[i].normal);
        contacts[i].surface_normal = exact_unit(contacts[i].surface_normal);
    }
    return status;
}

static tahr_status checked_ray(const tahr_world *world, tahr_query_context *context, const tahr_ray *query,
                               tahr_hit *hit, uint32_t *count)
{
    *count = 0;
    tahr_status status = world->backend->ray(world->self, context, query, hit, count);
    if (status < 0 || *count > 1) {
        return bad_answer(world, "ray", status < 0 ? "status" : "count");
    }
    const char *bad = *count ? bad_hit(hit) : NULL;
    return bad ? bad_answer(world, "ray", bad) : status;
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

static void blocked_here(const tahr__step *step, tahr_hit *hit)
{
    *hit = (tahr_hit){.blocking = 1, .unknown = 1, .body = TAHR_NO_BODY};
    hit->normal = hit->surface_normal = step->state.up;
}

static inline tahr_status checked_sweep(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
                                        tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    int inflates = !(world->backend->capabilities & TAHR_CAP_MARGIN) && query->margin > 0;
    return inflates ? inflated_sweep(world, context, query, hits, capacity, count)
                    : margin_sweep(world, context, query, hits, capacity, count);
}

/* Treats what is not known as a wall in the way; of an undecided answer nothing but the fraction need make sense. */
static void make_wall(tahr_hit *hit, vec3 from, vec3 motion, double margin)
{
    if (!is_unit(hit->normal) || !is_unit(hit->surface_normal)) {
        hit->normal = hit->surface_normal = unit(scale(motion, -1));
    }
    if (!vec_is_finite(hit->point)) {
        hit->point = add_scaled(from, motion, hit->fraction);
    }
    hit->distance = is_finite(hit->distance) ? hit->distance : margin; /* so far it was free */
    hit->depth = is_finite(hit->depth) && hit->depth >= 0 ? hit->depth : 0;
    if (bad_rule(hit->walkable_rule, hit->walkable_angle)) {
        hit->walkable_rule = TAHR_WALKABLE_NEVER;
        hit->walkable_angle = 0;
    }
}

static void record_sweep(tahr__step *step, const tahr_sweep *q, const tahr_hit *hit, uint32_t count)
{
    tahr_query_record r = {.type = TAHR_QUERY_SWEEP,
                           .count = count,
                           .shape = q->shape,
                           .position = q->position,
                           .motion = q->motion,
                           .margin = q->margin,
                           .fraction = 1,
                           .body = TAHR_NO_BODY};
    if (count > 0) {
        r.fraction = hit->fraction;
        r.distance = hit->distance;
        r.normal = hit->normal;
        r.point = hit->point;
        r.body = hit->body;
        r.feature = hit->feature;
    }
    tahr__record(step, &r);
}

/* Also finds out whether the motion meets a sensor: a leg that does not need not be asked about. */
static tahr_status sensing_sweep(tahr__step *step, const tahr_sweep *q, tahr_hit *hit, uint32_t *count)
{
    tahr_hit hits[2];
    uint32_t n = 0;
    tahr_status status = checked_sweep(step->world, &step->context, q, hits, 2, &n);
    *count = status >= 0 && n > 0 && !hits[n - 1].sensor;
    if (*count) {
        *hit = hits[n - 1];
    }
    tahr__trail_swept(step->trail, q, n == *count);
    return status;
}

void tahr__sweep(tahr__step *step, const tahr_shape *shape, vec3 from, vec3 motion, double margin, uint32_t flags,
                 tahr_hit *hit)
{
    uint32_t count = 0;
    if (!may_ask(step)) {
        blocked_here(step, hit);
        return;
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
                             ? sensing_sweep(step, &q, hit, &count)
                             : checked_sweep(step->world, &step->context, &q, hit, 1, &count);
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
            make_wall(hit, from, motion, margin);
        }
    }
    if (step->report.queries) {
        record_sweep(step, &q, hit, count);
    }
}

uint32_t tahr__sensors(tahr__step *step, vec3 from, vec3 motion, uint32_t ignore_body, tahr_hit *hits, uint32_t capacity)
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
    tahr_status status = checked_sweep(step->world, &step->context, &q, hits, capacity, &count);
    if (status < 0) {
        step->error = status;
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) { /* a backend that does not know the flag may add what blocks */
        if (hits[i].sensor) {
            hits[kept++] = hits[i];
        }
    }
    if (status == TAHR_TRUNCATED) {
        step->report.flags |= TAHR_REPORT_TOUCHED_LOST;
    }
    if (step->report.queries) {
        record_sweep(step, &q, hits, kept);
    }
    return kept;
}

static void record_contacts(tahr__step *step, const tahr_contact_query *q, const tahr_contact *first, uint32_t count)
{
    tahr_query_record r = {.type = TAHR_QUERY_CONTACTS,
                           .count = count,
                           .shape = q->shape,
                           .position = q->position,
                           .margin = q->margin,
                           .fraction = 1,
                           .body = TAHR_NO_BODY};
    if (count > 0) {
        r.distance = first->distance;
        r.normal = first->normal;
        r.point = first->point;
        r.body = first->body;
        r.feature = first->feature;
    }
    tahr__record(step, &r);
}

uint32_t tahr__contacts_of(tahr__step *step, const tahr_shape *shape, vec3 position, double margin,
                           tahr_contact *contacts, uint32_t capacity)
{
    uint32_t count = 0, kept = 0;
    if (!may_ask(step)) {
        return 0;
    }
    tahr_contact_query q = {.shape = *shape,
                            .position = position,
                            .up = step->state.up,
                            .orientation = step->state.orientation,
                            .margin = margin,
                            .mask = step->config->mask,
                            .ignore_body = step->ignore_body,
                            .flags = TAHR_CONTACTS_SOLID};
    step->report.contact_queries++;
    tahr_status status = checked_contacts(step->world, &step->context, &q, contacts, capacity, &count);
    if (status < 0) {
        step->error = status;
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!contacts[i].sensor) {
            contacts[kept++] = contacts[i];
        }
    }
    if (step->report.queries) {
        record_contacts(step, &q, contacts, kept);
    }
    return kept;
}

uint32_t tahr__contacts(tahr__step *step, vec3 position, double margin, tahr_contact *contacts, uint32_t capacity)
{
    return tahr__contacts_of(step, &step->limits->shape, position, margin, contacts, capacity);
}

static void record_ray(tahr__step *step, const tahr_ray *q, const tahr_hit *hit, uint32_t count)
{
    tahr_query_record r = {.type = TAHR_QUERY_RAY,
                           .count = count,
                           .position = q->origin,
                           .motion = q->motion,
                           .fraction = hit->fraction,
                           .normal = hit->normal,
                           .point = hit->point,
                           .body = hit->body,
                           .feature = hit->feature};
    tahr__record(step, &r);
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
    tahr_status status = checked_ray(step->world, &step->context, &q, hit, &count);
    if (status < 0) {
        step->error = status;
        blocked_here(step, hit);
        return;
    }
    if (count == 0) {
        set_free(hit);
    }
    if (step->report.queries) {
        record_ray(step, &q, hit, count);
    }
}

static const char *bad_fluid(const tahr_fluid *f)
{
    if (!(f->immersion >= 0 && f->immersion <= 1)) {
        return "immersion";
    }
    if (!(f->friction >= 0 && f->friction <= 1e4)) {
        return "friction";
    }
    return length_squared(f->velocity) <= 1e8 ? NULL : "velocity";
}

static tahr_status checked_fluid(const tahr_world *world, tahr_query_context *context, const tahr_fluid_query *query,
                                 tahr_fluid *fluid)
{
    *fluid = (tahr_fluid){.body = TAHR_NO_BODY};
    if (!world->backend->fluid) {
        return TAHR_OK;
    }
    tahr_status status = world->backend->fluid(world->self, context, query, fluid);
    const char *bad = status < 0 ? "status" : bad_fluid(fluid);
    return bad ? bad_answer(world, "fluid", bad) : TAHR_OK;
}

static void record_fluid(tahr__step *step, const tahr_fluid_query *q, const tahr_fluid *fluid)
{
    tahr_query_record r = {.type = TAHR_QUERY_FLUID,
                           .count = fluid->immersion > 0,
                           .shape = step->limits->shape,
                           .position = q->position,
                           .fraction = 1,
                           .distance = fluid->immersion,
                           .body = fluid->body};
    tahr__record(step, &r);
}

tahr_fluid tahr__fluid(tahr__step *step, vec3 position)
{
    tahr_fluid fluid = {.body = TAHR_NO_BODY};
    if (!step_has_fluids(step) || !may_ask(step)) {
        return fluid;
    }
    tahr_fluid_query q = {.position = position,
                          .up = step->state.up,
                          .radius = step->limits->width,
                          .half_height = step->limits->shape.half_height,
                          .mask = step->config->mask};
    step->report.fluid_queries++;
    tahr_status status = checked_fluid(step->world, &step->context, &q, &fluid);
    if (status < 0) {
        step->error = status;
        return (tahr_fluid){.body = TAHR_NO_BODY};
    }
    if (step->report.queries) {
        record_fluid(step, &q, &fluid);
    }
    fluid.velocity = along_plane(step->limits, fluid.velocity);
    return fluid;
}

void tahr__announce(tahr__step *step, const tahr_prepare *announcement)
{
    const tahr_backend *backend = step->world->backend;
    if (backend->prepare && backend->prepare(step->world->self, &step->context, announcement) < 0) {
        step->error = bad_answer(step->world, "prepare", "status");
    }
}

static const char *bad_motion(const tahr_body_motion *m)
{
    tahr_quat q = m->pose.orientation;
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    if (!(length(m->pose.position) <= 2e7)) {
        return "pose.position";
    }
    if (!(q2 > 1 - 1e-6 && q2 < 1 + 1e-6)) {
        return "pose.orientation";
    }
    if (!vec_is_finite(m->velocity) || !vec_is_finite(m->surface_velocity)) {
        return vec_is_finite(m->velocity) ? "surface_velocity" : "velocity";
    }
    if (!vec_is_finite(m->angular_velocity)) {
        return "angular_velocity";
    }
    return m->mass >= 0 && is_finite(m->mass) ? NULL : "mass";
}

tahr_status tahr__ask_motion(const tahr_world *world, uint32_t body, tahr_body_motion *motion)
{
    const tahr_backend *backend = world->backend;
    memset(motion, 0, sizeof *motion);
    motion->pose.orientation.w = 1;
    if (!backend->body_motion || body == TAHR_NO_BODY) {
        return TAHR_E_NOT_FOUND;
    }
    tahr_status status = backend->body_motion(world->self, body, motion);
    if (status < 0) {
        return status == TAHR_E_NOT_FOUND ? status : bad_answer(world, "body_motion", "status");
    }
    const char *bad = bad_motion(motion);
    if (bad) {
        return bad_answer(world, "body_motion", bad);
    }
    motion->pose.orientation = quat_unit(motion->pose.orientation);
    return TAHR_OK;
}

uint32_t tahr__shape_capability(uint32_t type)
{
    return type == TAHR_SHAPE_SPHERE ? TAHR_CAP_SPHERE : (type == TAHR_SHAPE_BOX ? TAHR_CAP_BOX : TAHR_CAP_CAPSULE);
}

/* Answers to direct queries are checked before the caller's array sees them; more than this many are cut. */
enum { DIRECT_ANSWERS = 64 };

/* What a direct query must fulfil; returns the name of the first bad field. */
static const char *bad_placement(const tahr_shape *shape, vec3 position, vec3 up, tahr_quat q, double margin)
{
    const char *bad = tahr__shape_check(shape);
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    if (bad) {
        return bad;
    }
    if (!vec_is_finite(position) || length(position) > 2e7) {
        return "position";
    }
    if (!(length_squared(up) > 1 - 1e-9 && length_squared(up) < 1 + 1e-9)) {
        return "up";
    }
    int upright = shape->type != TAHR_SHAPE_BOX || dot(rotate(q, vec(0, 0, 1)), up) > 1 - 1e-6;
    if (!(q2 > 1 - 1e-9 && q2 < 1 + 1e-9) || !upright) {
        return "orientation";
    }
    return margin >= 0 && margin <= 1e4 ? NULL : "margin";
}

static tahr_status bad_argument(const tahr_world *world, const char *function, const char *field)
{
    return tahr__complain(&world->log, TAHR_E_ARGUMENT, function, field, "is out of range or not finite");
}

/* One of query, answers and count is NULL; answers are called name. */
static tahr_status null_argument(const tahr_world *world, const char *function, const void *query, const void *answers,
                                 const char *name)
{
    return tahr__complain(&world->log, TAHR_E_NULL, function, !query ? "query" : (!answers ? name : "count"), "is NULL");
}

tahr_status tahr_world_sweep(tahr_world *world, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity,
                             uint32_t *count)
{
    tahr_hit found[DIRECT_ANSWERS];
    tahr_query_context context = {0};
    uint32_t n = 0;
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!query || !hits || !count) {
        return null_argument(world, "tahr_world_sweep", query, hits, "hits");
    }
    const char *bad = bad_placement(&query->shape, query->position, query->up, query->orientation, query->margin);
    if (!bad && !(vec_is_finite(query->motion) && length(query->motion) <= 1e6)) {
        bad = "motion";
    }
    const uint32_t flags = TAHR_SWEEP_LEAVE_OVERLAP | TAHR_SWEEP_ONLY_BODY | TAHR_SWEEP_SENSORS;
    if (!bad && (query->flags & ~flags || query->reserved)) {
        bad = query->reserved ? "reserved" : "flags";
    }
    if (bad || capacity == 0) {
        return bad_argument(world, "tahr_world_sweep", bad ? bad : "capacity");
    }
    if (!(world->backend->capabilities & tahr__shape_capability(query->shape.type))) {
        return tahr__complain(&world->log, TAHR_E_UNSUPPORTED, "tahr_world_sweep", "shape.type",
                              "is not among the backend's shapes");
    }
    tahr_status status =
        checked_sweep(world, &context, query, found, capacity < DIRECT_ANSWERS ? capacity : DIRECT_ANSWERS, &n);
    if (status < 0) {
        return status;
    }
    if (n && found[n - 1].unknown) {
        make_wall(&found[n - 1], query->position, query->motion, query->margin);
        status = TAHR_UNKNOWN;
    }
    memcpy(hits, found, n * sizeof found[0]);
    *count = n;
    return status;
}

tahr_status tahr_world_contacts(tahr_world *world, const tahr_contact_query *query, tahr_contact *contacts,
                                uint32_t capacity, uint32_t *count)
{
    tahr_contact found[DIRECT_ANSWERS];
    tahr_query_context context = {0};
    uint32_t n = 0;
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!query || !contacts || !count) {
        return null_argument(world, "tahr_world_contacts", query, contacts, "contacts");
    }
    const char *bad = bad_placement(&query->shape, query->position, query->up, query->orientation, query->margin);
    if (!bad && (query->flags & ~(uint32_t)TAHR_CONTACTS_SOLID || query->reserved)) {
        bad = query->reserved ? "reserved" : "flags";
    }
    if (bad) {
        return bad_argument(world, "tahr_world_contacts", bad);
    }
    if (!(world->backend->capabilities & tahr__shape_capability(query->shape.type))) {
        return tahr__complain(&world->log, TAHR_E_UNSUPPORTED, "tahr_world_contacts", "shape.type",
                              "is not among the backend's shapes");
    }
    tahr_status status =
        checked_contacts(world, &context, query, found, capacity < DIRECT_ANSWERS ? capacity : DIRECT_ANSWERS, &n);
    if (status < 0) {
        return status;
    }
    memcpy(contacts, found, n * sizeof found[0]);
    *count = n;
    return status;
}

tahr_status tahr_world_ray(tahr_world *world, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!query || !hit || !count) {
        return null_argument(world, "tahr_world_ray", query, hit, "hit");
    }
    if (!vec_is_finite(query->origin) || length(query->origin) > 2e7) {
        return bad_argument(world, "tahr_world_ray", "origin");
    }
    if (!vec_is_finite(query->motion)) {
        return bad_argument(world, "tahr_world_ray", "motion");
    }
    tahr_query_context context = {0};
    tahr_hit found_hit;
    uint32_t found = 0;
    memset(&found_hit, 0, sizeof found_hit);
    tahr_status status = checked_ray(world, &context, query, &found_hit, &found);
    if (status >= 0) {
        *hit = found_hit;
        *count = found;
    }
    return status;
}

tahr_status tahr_world_fluid(tahr_world *world, const tahr_fluid_query *query, tahr_fluid *fluid)
{
    static const char function[] = "tahr_world_fluid";
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!query || !fluid) {
        return null_argument(world, function, query, fluid, "fluid");
    }
    if (!vec_is_finite(query->position) || length(query->position) > 2e7) {
        return bad_argument(world, function, "position");
    }
    if (!(length_squared(query->up) > 1 - 1e-9 && length_squared(query->up) < 1 + 1e-9)) {
        return bad_argument(world, function, "up");
    }
    if (!(query->half_height >= 1e-6 && query->half_height <= 1e4)) {
        return bad_argument(world, function, "half_height");
    }
    if (!(query->radius >= 0 && query->radius <= 1e4) || query->reserved) {
        return bad_argument(world, function, query->reserved ? "reserved" : "radius");
    }
    tahr_query_context context = {0};
    tahr_fluid found;
    tahr_status status = checked_fluid(world, &context, query, &found);
    if (status >= 0) {
        *fluid = found;
    }
    return status;
}

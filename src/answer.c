/* SPDX-License-Identifier: MIT
 * answer.c: calling backend slots and checking what they answer. */
#include "answer.h"

#include <stdio.h>
#include <string.h>

#include "message.h"
#include "shape.h"

static const char *bad_rule(uint32_t rule, double angle)
{
    if (rule > TAHR_WALKABLE_NEVER) {
        return "walkable_rule";
    }
    return is_finite(angle) ? NULL : "walkable_angle";
}

/* What an answer says may come into a state, and a state farther out is refused by the next step. */
static int is_place(vec3 point)
{
    return length_squared(point) <= TAHR__FARTHEST * TAHR__FARTHEST;
}

/* Overlaps may be told as deep as they like: what leaves them is cut. */
static int is_distance(double m, int overlaps)
{
    return is_finite(m) && m <= TAHR__FARTHEST && (overlaps || m >= -TAHR__FARTHEST);
}

/* What hits and contacts say of the surface. */
static const char *bad_surface(vec3 normal, vec3 surface_normal, vec3 point, uint32_t rule, double angle)
{
    if (!normal_is_unit(normal)) {
        return "normal";
    }
    if (!normal_is_unit(surface_normal)) {
        return "surface_normal";
    }
    return is_place(point) ? bad_rule(rule, angle) : "point";
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
    if (!is_distance(h->distance, h->start_overlap != 0)) {
        return "distance";
    }
    return bad_surface(h->normal, h->surface_normal, h->point, h->walkable_rule, h->walkable_angle);
}

static const char *bad_contact(const tahr_contact *c)
{
    if (!is_distance(c->distance, 1)) {
        return "distance";
    }
    return bad_surface(c->normal, c->surface_normal, c->point, c->walkable_rule, c->walkable_angle);
}

static vec3 exact_unit(vec3 n)
{
    return normal_is_exact(n) ? n : unit(n);
}

/* In a world of two dimensions no normal has a third one. */
static const char *out_of_plane(const tahr_world *world, vec3 normal, vec3 surface_normal)
{
    if (!world_is_planar(world) || (normal.z == 0 && surface_normal.z == 0)) {
        return NULL;
    }
    return normal.z == 0 ? "surface_normal.z" : "normal.z";
}

/* Returns the name of the first bad field, or makes the normals exact. */
static const char *refine(tahr_hit *h)
{
    if (hit_is_flawless(h)) {
        return NULL;
    }
    const char *bad = bad_hit(h);
    if (!bad) {
        h->normal = exact_unit(h->normal);
        h->surface_normal = exact_unit(h->surface_normal);
    }
    return bad;
}

tahr_status tahr__bad_answer(const tahr_world *world, const char *slot, const char *field)
{
    return tahr__complain(&world->log, TAHR_E_BACKEND, slot, field, "in the answer is invalid");
}

tahr_status tahr__bad_status(const tahr_world *world, const char *slot, tahr_status status)
{
    char text[160];
    snprintf(text, sizeof text, "in the answer of %.40s is %s: %s", world->backend->name, tahr_status_name(status),
             tahr_status_message(status));
    return tahr__complain(&world->log, TAHR_E_BACKEND, slot, "status", text);
}

/* A backend without the margin gets the shape inflated: then its overlap of depth d is a gap of margin - d. Of a sphere
 * and a capsule that is exact, of the others as shape_grow says; hulls are refused. */
static void inflate(tahr_sweep *q)
{
    shape_grow(&q->shape, q->margin);
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

tahr_status tahr__refine_hits(const tahr_world *world, tahr_status status, tahr_hit *hits, uint32_t capacity,
                              uint32_t count)
{
    if (status < 0) {
        return tahr__bad_status(world, "sweep", status);
    }
    if (count > capacity) {
        return tahr__bad_answer(world, "sweep", "count");
    }
    for (uint32_t i = 0; i < count; i++) {
        const char *bad = refine(&hits[i]);
        bad = bad ? bad : out_of_plane(world, hits[i].normal, hits[i].surface_normal);
        if (bad) {
            return tahr__bad_answer(world, "sweep", bad);
        }
    }
    return status;
}

tahr_status tahr__answer_inflated(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
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

tahr_status tahr__answer_contacts(const tahr_world *world, tahr_query_context *context, const tahr_contact_query *query,
                                  tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    *count = 0;
    tahr_status status = world->backend->contacts(world->self, context, query, contacts, capacity, count);
    if (status < 0) {
        return tahr__bad_status(world, "contacts", status);
    }
    if (*count > capacity) {
        return tahr__bad_answer(world, "contacts", "count");
    }
    for (uint32_t i = 0; i < *count; i++) {
        const char *bad = bad_contact(&contacts[i]);
        bad = bad ? bad : out_of_plane(world, contacts[i].normal, contacts[i].surface_normal);
        if (bad) {
            return tahr__bad_answer(world, "contacts", bad);
        }
        contacts[i].normal = exact_unit(contacts[i].normal);
        contacts[i].surface_normal = exact_unit(contacts[i].surface_normal);
    }
    return status;
}

tahr_status tahr__answer_ray(const tahr_world *world, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                             uint32_t *count)
{
    *count = 0;
    tahr_status status = world->backend->ray(world->self, context, query, hit, count);
    if (status < 0) {
        return tahr__bad_status(world, "ray", status);
    }
    if (*count > 1) {
        return tahr__bad_answer(world, "ray", "count");
    }
    const char *bad = *count ? refine(hit) : NULL;
    bad = *count && !bad ? out_of_plane(world, hit->normal, hit->surface_normal) : bad;
    return bad ? tahr__bad_answer(world, "ray", bad) : status;
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

tahr_status tahr__answer_fluid(const tahr_world *world, tahr_query_context *context, const tahr_fluid_query *query,
                               tahr_fluid *fluid)
{
    *fluid = (tahr_fluid){.body = TAHR_NO_BODY};
    if (!world->backend->fluid) {
        return TAHR_OK;
    }
    tahr_status status = world->backend->fluid(world->self, context, query, fluid);
    if (status < 0) {
        return tahr__bad_status(world, "fluid", status);
    }
    const char *bad = bad_fluid(fluid);
    return bad ? tahr__bad_answer(world, "fluid", bad) : TAHR_OK;
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

tahr_status tahr__answer_motion(const tahr_world *world, uint32_t body, tahr_body_motion *motion)
{
    const tahr_backend *backend = world->backend;
    memset(motion, 0, sizeof *motion);
    motion->pose.orientation.w = 1;
    if (!backend->body_motion || body == TAHR_NO_BODY) {
        return TAHR_E_NOT_FOUND;
    }
    tahr_status status = backend->body_motion(world->self, body, motion);
    if (status < 0) {
        return status == TAHR_E_NOT_FOUND ? status : tahr__bad_status(world, "body_motion", status);
    }
    const char *bad = bad_motion(motion);
    if (bad) {
        return tahr__bad_answer(world, "body_motion", bad);
    }
    motion->pose.orientation = quat_unit(motion->pose.orientation);
    return TAHR_OK;
}

void tahr__make_wall(tahr_hit *hit, vec3 from, vec3 motion, double margin)
{
    if (!normal_is_unit(hit->normal) || !normal_is_unit(hit->surface_normal)) {
        hit->normal = hit->surface_normal = unit(scale(motion, -1));
    }
    if (!is_place(hit->point)) {
        hit->point = add_scaled(from, motion, hit->fraction);
    }
    hit->distance = is_distance(hit->distance, 0) ? hit->distance : margin; /* so far it was free */
    hit->depth = is_finite(hit->depth) && hit->depth >= 0 ? hit->depth : 0;
    if (bad_rule(hit->walkable_rule, hit->walkable_angle)) {
        hit->walkable_rule = TAHR_WALKABLE_NEVER;
        hit->walkable_angle = 0;
    }
}

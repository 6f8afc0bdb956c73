/* SPDX-License-Identifier: MIT
 * callbacks.c: a user's functions behind the same vtable as every backend, with contacts and rays derived from the
 * sweep where the user has none. */
#include "callbacks.h"

#include <string.h>

#include "vec.h"

static void close_callbacks(void *self)
{
    (void)self; /* the world owns it */
}

/* A level way from the axis to the rim, toward a direction; none along the axis. */
static vec3 rim_toward(const tahr_sweep *q, vec3 direction)
{
    vec3 level = add_scaled(direction, q->up, -dot(direction, q->up));
    double size = length(level);
    return size > 1e-9 ? scale(level, q->shape.radius / size) : vec(0, 0, 0);
}

/* The lowest point of the shape at the origin along a normal. Of a hull that of the box of its extents: its vertices
 * are the user's. */
static vec3 lowest_point(const tahr_sweep *q, vec3 normal)
{
    const tahr_shape *s = &q->shape;
    vec3 x = rotate(q->orientation, vec(1, 0, 0)), y = rotate(q->orientation, vec(0, 1, 0));
    double along = dot(normal, q->up), ax = dot(normal, x), ay = dot(normal, y);
    double side = along > 0 ? -1 : (along < 0 ? 1 : 0);
    vec3 end = scale(q->up, side * s->half_height), rim;
    switch (s->type) {
    case TAHR_SHAPE_BOX:
    case TAHR_SHAPE_HULL:
        end = add_scaled(end, x, ax > 1e-9 ? -s->half_x : (ax < -1e-9 ? s->half_x : 0));
        return add_scaled(end, y, ay > 1e-9 ? -s->half_y : (ay < -1e-9 ? s->half_y : 0));
    case TAHR_SHAPE_CYLINDER: return add(end, rim_toward(q, scale(normal, -1)));
    case TAHR_SHAPE_CONE:
        rim = add(scale(q->up, -s->half_height), rim_toward(q, scale(normal, -1)));
        return dot(rim, normal) <= s->half_height * along ? rim : scale(q->up, s->half_height);
    case TAHR_SHAPE_ELLIPSOID: {
        double ex = s->half_x * ax, ey = s->half_y * ay, ez = s->half_height * along;
        double size = sqrt(ex * ex + ey * ey + ez * ez);
        end = add_scaled(scale(x, -s->half_x * ex / size), y, -s->half_y * ey / size);
        return add_scaled(end, q->up, -s->half_height * ez / size);
    }
    default: return add_scaled(scale(q->up, side * (s->half_height - s->radius)), normal, -s->radius);
    }
}

/* Where the shape, stopped at the hit, is nearest to a surface with that normal. */
static vec3 nearest_point(const tahr_sweep *q, const tahr_hit *h)
{
    vec3 centre = add_scaled(q->position, q->motion, h->fraction);
    double deepest = -1e7; /* m: an absurd depth makes no absurd place */
    return add_scaled(add(centre, lowest_point(q, h->normal)), h->normal, -max_of(h->distance, deepest));
}

/* A sensor does not block, and its normal decides little: against the motion, if the user says nothing. */
static void complete_sensor(const tahr_sweep *q, double part, tahr_hit *h)
{
    double size = length(q->motion);
    h->sensor = 1;
    h->blocking = h->unknown = 0;
    h->fraction *= h->fraction <= 1 ? part : 1; /* what is wrong stays wrong */
    if (length_squared(h->normal) == 0) {
        h->normal = size > 0 ? scale(q->motion, -1 / size) : q->up;
    }
    if (length_squared(h->surface_normal) == 0) {
        h->surface_normal = h->normal;
    }
    if (length_squared(h->point) == 0) {
        h->point = add_scaled(q->position, q->motion, h->fraction);
    }
}

/* The sensors along a part of a motion. */
static tahr_status sensors(const tahr_callbacks *user, const tahr_sweep *query, double part, tahr_hit *hits,
                           uint32_t capacity, uint32_t *count)
{
    tahr_sweep q = *query;
    *count = 0;
    if (!user->sensors || capacity == 0) {
        return TAHR_OK;
    }
    q.motion = scale(query->motion, part);
    memset(hits, 0, capacity * sizeof hits[0]);
    tahr_status status = user->sensors(user->user, &q, hits, capacity, count);
    for (uint32_t i = 0; i < *count && i < capacity; i++) {
        complete_sensor(query, part, &hits[i]);
    }
    return status < 0 || status == TAHR_TRUNCATED ? status : TAHR_OK;
}

tahr_status tahr__sweep_solids(const tahr_callbacks *user, tahr_query_context *context, const tahr_sweep *query,
                               tahr_hit *hits, uint32_t *count)
{
    context->narrow_tests++;
    memset(&hits[0], 0, sizeof hits[0]);
    tahr_status status = user->sweep(user->user, query, &hits[0]);
    tahr_hit *h = &hits[0];
    *count = h->blocking || h->start_overlap || h->sensor || h->unknown;
    if (h->start_overlap) {
        h->distance = -h->depth;
    } else if (h->distance == 0) {
        h->distance = query->margin; /* most users say only where */
    }
    if (length_squared(h->surface_normal) == 0) {
        h->surface_normal = h->normal;
    }
    if (length_squared(h->point) == 0) {
        h->point = nearest_point(query, h);
    }
    return status < 0 ? status : TAHR_OK;
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    const tahr_callbacks *user = self;
    tahr_hit wall;
    uint32_t found = 0;
    if (query->flags & TAHR_SWEEP_SENSORS) {
        return sensors(user, query, 1, hits, capacity, count);
    }
    if (capacity < 2 || !user->sensors) {
        return tahr__sweep_solids(user, context, query, hits, count);
    }
    tahr_status status = tahr__sweep_solids(user, context, query, &wall, &found);
    if (status < 0) {
        return status;
    }
    double part = found && wall.fraction >= 0 && wall.fraction <= 1 ? wall.fraction : 1;
    status = sensors(user, query, part, hits, capacity - found, count);
    if (status >= 0 && found && *count < capacity) {
        hits[(*count)++] = wall;
    }
    return status;
}

static tahr_status users_contacts(const tahr_callbacks *user, tahr_query_context *context,
                                  const tahr_contact_query *query, tahr_contact *out, uint32_t capacity,
                                  uint32_t *count)
{
    context->narrow_tests++;
    memset(out, 0, capacity * sizeof out[0]);
    tahr_status status = user->contacts(user->user, query, out, capacity, count);
    for (uint32_t i = 0; i < *count && i < capacity; i++) {
        if (length_squared(out[i].surface_normal) == 0) {
            out[i].surface_normal = out[i].normal;
        }
    }
    return status < 0 || status == TAHR_TRUNCATED ? status : TAHR_OK;
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query, tahr_contact *out,
                            uint32_t capacity, uint32_t *count)
{
    const tahr_callbacks *user = self;
    return user->contacts ? users_contacts(user, context, query, out, capacity, count)
                          : tahr__derive_contacts(user, context, query, out, capacity, count);
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    const tahr_callbacks *user = self;
    memset(hit, 0, sizeof *hit);
    if (user->ray) {
        context->narrow_tests++;
        tahr_status status = user->ray(user->user, query, hit);
        *count = hit->blocking != 0;
        if (length_squared(hit->surface_normal) == 0) {
            hit->surface_normal = hit->normal;
        }
        if (length_squared(hit->point) == 0) {
            hit->point = add_scaled(query->origin, query->motion, hit->fraction);
        }
        return status < 0 ? status : TAHR_OK;
    }
    tahr_sweep q = {.shape = {TAHR_SHAPE_SPHERE, 0, 0.001, 0.001, 0, 0}, /* thin enough to stand for a ray */
                    .position = query->origin,
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = query->motion,
                    .mask = query->mask,
                    .ignore_body = query->ignore_body};
    tahr_status status = tahr__sweep_solids(user, context, &q, hit, count);
    *count = hit->blocking != 0;
    return status;
}

static tahr_status body_motion(void *self, uint32_t body, tahr_body_motion *motion)
{
    const tahr_callbacks *user = self;
    return user->body ? user->body(user->user, body, motion) : TAHR_E_NOT_FOUND;
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    const tahr_callbacks *user = self;
    (void)context;
    return user->fluid ? user->fluid(user->user, query, answer) : TAHR_OK;
}

/* Every shape: the user's sweep must honour those that its movers have. */
#define CAPABILITIES                                                                                            \
    (TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE | TAHR_CAP_BOX | TAHR_CAP_CYLINDER | \
     TAHR_CAP_CONE | TAHR_CAP_ELLIPSOID | TAHR_CAP_HULL)
#define SLOTS                                                                                               \
    .struct_size = sizeof(tahr_backend), .abi_major = TAHR_ABI_MAJOR, .abi_minor = TAHR_ABI_MINOR,          \
    .name = "callbacks", .version = "user", .close = close_callbacks, .sweep = sweep, .contacts = contacts, \
    .ray = ray, .body_motion = body_motion, .fluid = fluid

const tahr_backend tahr__callbacks_backend = {.capabilities = CAPABILITIES | TAHR_CAP_MARGIN, SLOTS};
const tahr_backend tahr__callbacks_without_margin = {.capabilities = CAPABILITIES, SLOTS};

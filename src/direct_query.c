/* SPDX-License-Identifier: MIT
 * direct_query.c: the questions of tahr_world_*, asked directly: arguments and answers checked. */
#include <string.h>

#include "answer.h"
#include "message.h"
#include "query.h"
#include "shape.h"

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
    int upright = shape_is_round(shape) || dot(rotate(q, vec(0, 0, 1)), up) > 1 - 1e-6;
    if (!(q2 > 1 - 1e-9 && q2 < 1 + 1e-9) || !upright) {
        return "orientation";
    }
    return margin >= 0 && margin <= 1e4 ? NULL : "margin";
}

static tahr_status bad_argument(const tahr_world *world, const char *function, const char *field)
{
    return tahr__complain(&world->log, TAHR_E_ARGUMENT, function, field, "is out of range or not finite");
}

/* Is this field of a query one that leaves a world of two dimensions? */
static int leaves(const tahr_world *world, vec3 v)
{
    return world_is_planar(world) && v.z != 0;
}

static tahr_status bad_z(const tahr_world *world, const char *function, const char *field)
{
    return tahr__complain(&world->log, TAHR_E_ARGUMENT, function, field, TAHR__NO_Z);
}

/* One of query, answers and count is NULL; answers are called name. */
static tahr_status null_argument(const tahr_world *world, const char *function, const void *query, const void *answers,
                                 const char *name)
{
    return tahr__complain(&world->log, TAHR_E_NULL, function, !query ? "query" : (!answers ? name : "count"),
                          "is NULL");
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
    const uint32_t flags = TAHR_SWEEP_LEAVE_OVERLAP | TAHR_SWEEP_ONLY_BODY | TAHR_SWEEP_SENSORS | TAHR_SWEEP_DROP |
                           TAHR_SWEEP_WHOLE | TAHR_SWEEP_PASS;
    if (!bad && (query->flags & ~flags || query->reserved)) {
        bad = query->reserved ? "reserved" : "flags";
    }
    if (bad || capacity == 0) {
        return bad_argument(world, "tahr_world_sweep", bad ? bad : "capacity");
    }
    if (leaves(world, query->up) || leaves(world, query->motion)) {
        return bad_z(world, "tahr_world_sweep", leaves(world, query->up) ? "up" : "motion");
    }
    if (!tahr__can_sweep(world, &query->shape)) {
        return tahr__cannot_sweep(world, "tahr_world_sweep", &query->shape);
    }
    tahr_status status =
        answer_sweep(world, &context, query, found, capacity < DIRECT_ANSWERS ? capacity : DIRECT_ANSWERS, &n);
    if (status < 0) {
        return status;
    }
    for (uint32_t i = 0; i < n; i++) { /* sensors too may be undecided */
        if (found[i].unknown) {
            tahr__make_wall(&found[i], query->position, query->motion, query->margin);
            status = TAHR_UNKNOWN;
        }
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
    if (!bad && (query->flags & ~(uint32_t)(TAHR_CONTACTS_SOLID | TAHR_CONTACTS_DROP) || query->reserved)) {
        bad = query->reserved ? "reserved" : "flags";
    }
    if (bad) {
        return bad_argument(world, "tahr_world_contacts", bad);
    }
    if (leaves(world, query->up)) {
        return bad_z(world, "tahr_world_contacts", "up");
    }
    if (!tahr__can_sweep(world, &query->shape)) {
        return tahr__cannot_sweep(world, "tahr_world_contacts", &query->shape);
    }
    tahr_status status =
        tahr__answer_contacts(world, &context, query, found, capacity < DIRECT_ANSWERS ? capacity : DIRECT_ANSWERS, &n);
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
    if (leaves(world, query->motion)) {
        return bad_z(world, "tahr_world_ray", "motion");
    }
    tahr_query_context context = {0};
    tahr_hit found_hit;
    uint32_t found = 0;
    memset(&found_hit, 0, sizeof found_hit);
    tahr_status status = tahr__answer_ray(world, &context, query, &found_hit, &found);
    if (status >= 0 && found && found_hit.unknown) {
        tahr__make_wall(&found_hit, query->origin, query->motion, 0);
    }
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
    if (leaves(world, query->up)) {
        return bad_z(world, function, "up");
    }
    tahr_query_context context = {0};
    tahr_fluid found;
    tahr_status status = tahr__answer_fluid(world, &context, query, &found);
    if (status >= 0) {
        *fluid = found;
    }
    return status;
}

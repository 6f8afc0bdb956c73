/* SPDX-License-Identifier: MIT
 * fake_backend.c: see fake_backend.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_backend.h"

const char *const lie_fields[LIES] = {
    "",       "normal",   "normal", "normal", "surface_normal", "fraction",       "fraction", "fraction", "count",
    "status", "distance", "depth",  "point",  "walkable_rule",  "walkable_angle", "point",    "distance"};

const char *const contact_lie_fields[CONTACT_LIES] = {
    "", "normal", "distance", "count", "status", "surface_normal", "point", "walkable_rule", "point", "distance"};

static void spoil(int lie, tahr_hit *h, uint32_t *count)
{
    double *bad[LIES] = {NULL,         &h->normal.y, &h->normal.x, NULL, &h->surface_normal.z,
                         &h->fraction, &h->fraction, &h->fraction, NULL, NULL,
                         &h->distance, &h->depth,    &h->point.y,  NULL, &h->walkable_angle,
                         &h->point.x,  &h->distance};
    const double value[LIES] = {0, NAN, 1.5, 0, NAN, -1, 2, NAN, 0, 0, NAN, -1, INFINITY, 0, NAN, 1.1e8, -1.1e8};
    if (bad[lie]) {
        *bad[lie] = value[lie];
    }
    if (lie == LIE_NORMAL_ZERO) {
        h->normal = fake_vec(0, 0, 0);
    } else if (lie == LIE_COUNT) {
        *count = 4000000;
    } else if (lie == LIE_DEPTH) {
        h->start_overlap = 1;
    } else if (lie == LIE_RULE) {
        h->walkable_rule = 77;
    }
}

/* Every field but what says "unknown", and how far the way was free. */
static void litter(tahr_hit *h)
{
    h->normal = h->surface_normal = h->point = fake_vec(NAN, INFINITY, -1e300);
    h->distance = h->walkable_angle = NAN;
    h->depth = -INFINITY;
    h->walkable_rule = h->surface = h->body = h->feature = 0xDEADBEEF;
}

static void random_hit(fake_backend *b, tahr_hit *h)
{
    memset(h, 0, sizeof *h);
    h->blocking = oracle_uniform(&b->seed, 0, 1) < 0.8;
    h->fraction = oracle_uniform(&b->seed, 0, 1) < 0.3 ? 0 : oracle_uniform(&b->seed, 0, 1);
    h->normal = dice_direction(&b->seed);
    h->surface_normal = oracle_uniform(&b->seed, 0, 1) < 0.5 ? h->normal : dice_direction(&b->seed);
    h->point =
        fake_vec(oracle_uniform(&b->seed, -1e3, 1e3), oracle_uniform(&b->seed, -1, 1), oracle_uniform(&b->seed, -2, 2));
    h->distance = oracle_uniform(&b->seed, -0.1, 0.1);
    h->unknown = oracle_uniform(&b->seed, 0, 1) < 0.05;
    if (oracle_uniform(&b->seed, 0, 1) < 0.2) {
        h->start_overlap = 1;
        h->depth = oracle_uniform(&b->seed, 0, 3);
    }
    h->body = (uint32_t)oracle_uniform(&b->seed, 0, 5);
    h->feature = (uint32_t)oracle_uniform(&b->seed, 0, 50);
    h->walkable_rule = (uint32_t)oracle_uniform(&b->seed, 0, 3.99);
    h->walkable_angle = oracle_uniform(&b->seed, -4, 4);
}

static tahr_status backend_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                                 uint32_t capacity, uint32_t *count)
{
    fake_backend *b = self;
    (void)context, (void)capacity;
    b->asked++;
    memset(hits, 0, sizeof hits[0]);
    if (b->random) {
        random_hit(b, &hits[0]);
        *count = 1;
        return TAHR_OK;
    }
    tahr_sweep q = *query;
    q.flags = b->keeps_overlaps ? 0 : q.flags;
    fake_sweep(&b->world, &q, &hits[0]);
    *count = hits[0].blocking;
    if (*count && b->unknown && hits[0].body == b->unknown_body) {
        tahr_hit gave_up = {.unknown = 1, .fraction = hits[0].fraction, .body = hits[0].body};
        gave_up.blocking = b->unknown != UNKNOWN_ALONE;
        hits[0] = gave_up; /* nothing is known of it but how far the way was free */
        if (b->unknown == UNKNOWN_GARBAGE) {
            litter(&hits[0]);
        }
        return TAHR_OK;
    }
    if (*count && b->lie) {
        spoil(b->lie, &hits[0], count);
        return b->lie == LIE_STATUS ? TAHR_E_GEOMETRY : TAHR_OK;
    }
    return TAHR_OK;
}

static tahr_status backend_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                                    tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    fake_backend *b = self;
    (void)context;
    b->asked++;
    if (b->random) {
        *count = (uint32_t)oracle_uniform(&b->seed, 0, capacity + 0.99);
        for (uint32_t i = 0; i < *count; i++) {
            memset(&contacts[i], 0, sizeof contacts[i]);
            contacts[i].distance = oracle_uniform(&b->seed, -1, 0.02);
            contacts[i].normal = dice_direction(&b->seed);
            contacts[i].surface_normal = dice_direction(&b->seed);
            contacts[i].feature = i;
        }
        return TAHR_OK;
    }
    tahr_status status = fake_contacts(&b->world, query, contacts, capacity, count);
    if (*count > 0) {
        contacts[0].normal.x = b->contact_lie == CONTACT_LIE_NORMAL ? NAN : contacts[0].normal.x;
        contacts[0].distance = b->contact_lie == CONTACT_LIE_DISTANCE ? INFINITY : contacts[0].distance;
        *count = b->contact_lie == CONTACT_LIE_COUNT ? capacity + 1 : *count;
        status = b->contact_lie == CONTACT_LIE_STATUS ? TAHR_E_MEMORY : status;
        contacts[0].surface_normal.z = b->contact_lie == CONTACT_LIE_SURFACE ? 9 : contacts[0].surface_normal.z;
        contacts[0].point.z = b->contact_lie == CONTACT_LIE_POINT ? NAN : contacts[0].point.z;
        contacts[0].walkable_rule = b->contact_lie == CONTACT_LIE_RULE ? 9 : contacts[0].walkable_rule;
        contacts[0].point.x = b->contact_lie == CONTACT_LIE_POINT_FAR ? 1e300 : contacts[0].point.x;
        contacts[0].distance = b->contact_lie == CONTACT_LIE_DISTANCE_FAR ? 1.1e8 : contacts[0].distance;
    }
    return status;
}

static tahr_status backend_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                               uint32_t *count)
{
    fake_backend *b = self;
    (void)context;
    b->asked++;
    memset(hit, 0, sizeof *hit);
    if (b->random) {
        random_hit(b, hit);
        *count = hit->blocking;
        return TAHR_OK;
    }
    if (query->origin.z > 0 && query->origin.z + query->motion.z <= 0) { /* the plane z = 0 */
        hit->blocking = 1;
        hit->fraction = -query->origin.z / query->motion.z;
        hit->normal = hit->surface_normal = fake_vec(0, 0, 1);
        *count = 1;
        if (b->lie) {
            spoil(b->lie, hit, count);
        }
        return b->lie == LIE_STATUS ? TAHR_E_BACKEND : TAHR_OK;
    }
    *count = 0;
    return TAHR_OK;
}

static tahr_status backend_open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    fake_backend *b = (void *)(uintptr_t)desc->options;
    assert_non_null(b);
    assert_true(host->struct_size >= sizeof *host && host->abi == TAHR_ABI && host->allocator.alloc &&
                host->allocator.free && host->log.write);
    b->opened++;
    if (b->open_answer == TAHR_OK) {
        *self = b;
    }
    return b->open_answer;
}

static void backend_close(void *self)
{
    fake_backend *b = self;
    assert_true(b && b->closed < b->opened);
    b->closed++;
}

static tahr_status backend_place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    fake_backend *b = self;
    (void)poses;
    b->placed += count;
    return TAHR_OK;
}

void fake_backend_init(fake_backend *backend, uint32_t capabilities)
{
    tahr_backend table = {.struct_size = sizeof table,
                          .abi_major = TAHR_ABI_MAJOR,
                          .abi_minor = TAHR_ABI_MINOR,
                          .capabilities = capabilities | TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_SENSORS,
                          .name = "fake",
                          .version = "1",
                          .open = backend_open,
                          .close = backend_close,
                          .sweep = backend_sweep,
                          .contacts = backend_contacts,
                          .ray = backend_ray,
                          .place = backend_place};
    memset(backend, 0, sizeof *backend);
    backend->table = table;
    fake_world_flat(&backend->world);
}

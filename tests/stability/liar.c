/* SPDX-License-Identifier: MIT
 * liar.c: see liar.h. Lies are drawn from a seed, so that a run can be repeated; two askers of one world get other
 * lies. */
#include "liar.h"

#include "oracle.h"

#include <math.h>
#include <string.h>
#include <tahr/native.h>

enum { TRUE_TO_LIES = 4 };

typedef struct liar {
    const tahr_host *host;
    void *inner;
    uint32_t lie;
    oracle_random dice;
} liar;

static const tahr_backend *native(void)
{
    return tahr_backend_v1_native();
}

static tahr_status open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    const liar_desc *options = desc->options;
    tahr_world_desc scene = *desc;
    liar *l = host->allocator.alloc(host->allocator.user, sizeof *l, 64);
    if (!l) return TAHR_E_MEMORY;
    *l = (liar){.host = host, .lie = options->lie, .dice = {options->seed}};
    scene.options = NULL; /* those were the liar's */
    tahr_status status = native()->open(host, &scene, &l->inner);
    if (status < 0)
        host->allocator.free(host->allocator.user, l, sizeof *l, 64);
    else
        *self = l;
    return status;
}

static void close_liar(void *self)
{
    liar *l = self;
    tahr_allocator a = l->host->allocator;
    native()->close(l->inner);
    a.free(a.user, l, sizeof *l, 64);
}

static double number(oracle_random *dice)
{
    const double some[] = {NAN, HUGE_VAL, -HUGE_VAL, -1, 2, 1e300, -1e-9, 0, 1, 1e-300};
    uint32_t how = oracle_below(dice, 20);
    return how < 10 ? some[how] : oracle_uniform(dice, -2, 2);
}

static tahr_vec3 direction(oracle_random *dice)
{
    for (;;) {
        double x = oracle_uniform(dice, -1, 1), y = oracle_uniform(dice, -1, 1), z = oracle_uniform(dice, -1, 1);
        double size = sqrt(x * x + y * y + z * z);
        if (size > 0.1 && size < 1) return (tahr_vec3){x / size, y / size, z / size};
    }
}

/* A direction that a motion may be stopped by; in a plane, of the plane. */
static tahr_vec3 against(oracle_random *dice, tahr_vec3 motion)
{
    tahr_vec3 n = direction(dice);
    double along = n.x * motion.x + n.y * motion.y + n.z * motion.z;
    return along > 0 ? (tahr_vec3){-n.x, -n.y, -n.z} : n;
}

static void poison(oracle_random *dice, tahr_hit *h)
{
    double *fields[] = {&h->fraction, &h->distance, &h->depth,    &h->normal.x,         &h->normal.z,
                        &h->point.y,  &h->point.x,  &h->fraction, &h->surface_normal.y, &h->walkable_angle};
    *fields[oracle_below(dice, 10)] = number(dice);
}

static void scramble_hit(oracle_random *dice, tahr_hit *h)
{
    memset(h, 0, sizeof *h);
    h->blocking = oracle_below(dice, 2);
    h->start_overlap = oracle_below(dice, 4) == 0;
    h->unknown = oracle_below(dice, 8) == 0;
    h->sensor = oracle_below(dice, 8) == 0;
    h->fraction = number(dice);
    h->distance = number(dice);
    h->depth = number(dice);
    h->normal = direction(dice);
    h->surface_normal = direction(dice);
    h->point = direction(dice);
    h->walkable_rule = oracle_below(dice, 6);
    h->body = oracle_below(dice, 4);
    h->feature = oracle_below(dice, 4);
}

static tahr_status lie_about_sweep(liar *l, const tahr_sweep *q, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    tahr_hit *h = &hits[*count > 0 ? *count - 1 : 0];
    double way = sqrt(q->motion.x * q->motion.x + q->motion.y * q->motion.y + q->motion.z * q->motion.z);
    switch (l->lie) {
    case LIE_NOT_NUMBERS:
        if (*count > 0 && oracle_below(&l->dice, 8) > 0)
            poison(&l->dice, h);
        else
            *count = oracle_below(&l->dice, 8) == 0 ? capacity + 3 : *count;
        break;
    case LIE_LATE:
        if (*count > 0 && oracle_below(&l->dice, 3) == 0)
            *count -= 1;
        else if (*count > 0 && way > 0)
            h->fraction = fmin(1, h->fraction + oracle_uniform(&l->dice, 0, 0.1) / way);
        break;
    case LIE_FALSE:
        if (*count > 0 && hits[*count - 1].blocking) break;
        memset(h, 0, sizeof *h);
        h->blocking = 1;
        h->fraction = oracle_uniform(&l->dice, 0, 1);
        h->normal = h->surface_normal = against(&l->dice, q->motion);
        h->point = q->position;
        h->distance = q->margin;
        *count = 1;
        break;
    case LIE_NORMALS:
        if (*count > 0) {
            h->normal = against(&l->dice, q->motion);
            h->surface_normal = direction(&l->dice);
        }
        break;
    default:
        scramble_hit(&l->dice, hits);
        *count = oracle_below(&l->dice, 3);
        *count = *count > capacity ? capacity : *count;
        if (*count == 2) scramble_hit(&l->dice, &hits[1]);
        break;
    }
    return l->lie == LIE_GARBAGE && oracle_below(&l->dice, 16) == 0 ? TAHR_TRUNCATED : TAHR_OK;
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *q, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    liar *l = self;
    tahr_status status = native()->sweep(l->inner, context, q, hits, capacity, count);
    return status < 0 || oracle_below(&l->dice, TRUE_TO_LIES) ? status : lie_about_sweep(l, q, hits, capacity, count);
}

static void lie_about_contact(liar *l, tahr_contact *c)
{
    oracle_random *dice = &l->dice;
    switch (l->lie) {
    case LIE_NOT_NUMBERS:
        if (oracle_below(dice, 2))
            c->distance = number(dice);
        else
            c->normal.x = number(dice);
        break;
    case LIE_LATE: c->distance += oracle_uniform(dice, 0, 0.1); break;
    case LIE_FALSE: c->distance = -oracle_uniform(dice, 0, 0.2); break;
    case LIE_NORMALS: c->normal = c->surface_normal = direction(dice); break;
    default:
        c->distance = number(dice);
        c->normal = direction(dice);
        c->surface_normal = direction(dice);
        c->point = direction(dice);
        c->body = oracle_below(dice, 4);
        c->sensor = oracle_below(dice, 8) == 0;
        break;
    }
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *q, tahr_contact *out,
                            uint32_t capacity, uint32_t *count)
{
    liar *l = self;
    tahr_status status = native()->contacts(l->inner, context, q, out, capacity, count);
    if (status < 0 || oracle_below(&l->dice, TRUE_TO_LIES)) return status;
    if (*count == 0 && capacity > 0 && (l->lie == LIE_FALSE || l->lie == LIE_GARBAGE)) {
        memset(out, 0, sizeof *out);
        out->normal = out->surface_normal = direction(&l->dice);
        out->point = q->position;
        *count = 1;
    }
    for (uint32_t i = 0; i < *count; i++)
        lie_about_contact(l, &out[i]);
    if (l->lie == LIE_NOT_NUMBERS && oracle_below(&l->dice, 16) == 0) *count = capacity + 9;
    return status;
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *q, tahr_hit *hit, uint32_t *count)
{
    liar *l = self;
    tahr_status status = native()->ray(l->inner, context, q, hit, count);
    if (status < 0 || oracle_below(&l->dice, TRUE_TO_LIES)) return status;
    if (l->lie == LIE_GARBAGE) {
        scramble_hit(&l->dice, hit);
        *count = oracle_below(&l->dice, 3);
    } else if (*count > 0) {
        if (l->lie == LIE_NOT_NUMBERS) poison(&l->dice, hit);
        if (l->lie == LIE_LATE) *count = 0;
        if (l->lie == LIE_NORMALS) hit->normal = hit->surface_normal = against(&l->dice, q->motion);
    }
    return status;
}

static size_t cache_size(void *self)
{
    return native()->cache_size(((liar *)self)->inner);
}

static tahr_status prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    return native()->prepare(((liar *)self)->inner, context, announcement);
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    return native()->place(((liar *)self)->inner, poses, count);
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *q, tahr_fluid *answer)
{
    liar *l = self;
    tahr_status status = native()->fluid(l->inner, context, q, answer);
    if (status < 0 || oracle_below(&l->dice, TRUE_TO_LIES)) return status;
    if (l->lie == LIE_NOT_NUMBERS || l->lie == LIE_GARBAGE) answer->immersion = number(&l->dice);
    if (l->lie == LIE_LATE) answer->immersion *= 0.9;
    if (l->lie == LIE_FALSE) answer->immersion = 1;
    return status;
}

const tahr_backend *liar_backend(void)
{
    static const tahr_backend backend = {
        .struct_size = sizeof backend,
        .abi_major = TAHR_ABI_MAJOR,
        .abi_minor = TAHR_ABI_MINOR,
        .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                        TAHR_CAP_BOX | TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_HEIGHTS |
                        TAHR_CAP_SENSORS | TAHR_CAP_ONE_WAY,
        .name = "liar",
        .version = "1",
        .open = open,
        .close = close_liar,
        .sweep = sweep,
        .contacts = contacts,
        .ray = ray,
        .cache_size = cache_size,
        .prepare = prepare,
        .place = place,
        .fluid = fluid,
    };
    return &backend;
}

/* SPDX-License-Identifier: MIT
 * native.c: the native backend's table of slots, opening and closing. */
#include "../common/options.h"
#include "scene.h"

#include <string.h>

enum { CAPACITY_DEFAULT = 128, CAPACITY_MAX = TAHR__CACHE_MOST };
/* m, at most: a gather lasts 16 steps of a wanderer in a dungeon; at 1.5 it lasts a tenth longer and costs as much
 * (measured). */
#define MARGIN_DEFAULT 1.0

/* Says what is wrong with the options, or NULL. */
static const char *bad_option(const tahr_native_desc *d)
{
    if (d->cache_triangles > CAPACITY_MAX) {
        return "options.cache_triangles is above 4096";
    }
    if (d->no_cache > 1) {
        return "options.no_cache is neither 0 nor 1";
    }
    if (d->no_simd > 1) {
        return "options.no_simd is neither 0 nor 1";
    }
    if (d->no_fields > 1) {
        return "options.no_fields is neither 0 nor 1";
    }
    if (d->no_vicinity > 1) {
        return "options.no_vicinity is neither 0 nor 1";
    }
    if (d->no_capsule_ends > 1) {
        return "options.no_capsule_ends is neither 0 nor 1";
    }
    if (d->reserved) {
        return "options.reserved is not 0";
    }
    return d->cache_margin >= 0 && d->cache_margin <= 1e3 ? NULL : "options.cache_margin is not within 0 and 1000 m";
}

static tahr_status read_options(const tahr_host *host, const void *options, tahr__native *world)
{
    tahr_native_desc d;
    memset(&d, 0, sizeof d);
    tahr_status status = tahr__options_read(host, options, &d, sizeof d);
    if (status < 0) return status;
    const char *bad = bad_option(&d);
    if (bad) {
        tahr__log_error(host, bad);
        return TAHR_E_ARGUMENT;
    }
    world->capacity =
        ((d.cache_triangles ? d.cache_triangles : CAPACITY_DEFAULT) + TAHR__LANES - 1) / TAHR__LANES * TAHR__LANES;
    world->no_cache = d.no_cache;
    world->no_fields = d.no_fields;
    world->no_vicinity = d.no_vicinity;
    world->no_capsule_ends = d.no_capsule_ends;
    world->lanes = tahr__lanes_best(d.no_simd);
    world->former = tahr__former_of(d.no_simd ? 1 : TAHR__FORMED);
    world->gather = d.gather;
    world->gather_user = d.gather_user;
    /* Of the user's triangles nothing is known before they are handed over. */
    world->fixed_margin = d.cache_margin > 0 || d.gather;
    world->cache_margin = d.cache_margin > 0 ? d.cache_margin : MARGIN_DEFAULT;
    return TAHR_OK;
}

static void native_close(void *self)
{
    tahr__native *world = self;
    if (!world) return;
    const tahr_host *host = world->host;
    tahr__bodies_close(world);
    host->allocator.free(host->allocator.user, world, sizeof *world, 64);
}

static tahr_status native_open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__native *world = host->allocator.alloc(host->allocator.user, sizeof *world, 64);
    if (!world) return TAHR_E_MEMORY;
    memset(world, 0, sizeof *world);
    world->host = host;
    tahr_status status = read_options(host, desc->options, world);
    if (status == TAHR_OK) status = tahr__bodies_open(world, desc);
    if (status != TAHR_OK) {
        native_close(world);
        return status;
    }
    *self = world;
    return TAHR_OK;
}

static size_t native_cache_size(void *self)
{
    return tahr__cache_bytes(self);
}

static tahr_status native_prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    return tahr__cache_prepare(self, context, announcement);
}

static tahr_status native_place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    return tahr__bodies_place(self, poses, count);
}

static tahr_status native_fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query,
                                tahr_fluid *fluid)
{
    const tahr__native *world = self;
    (void)context;
    tahr__fluids_ask(&world->fluids, query, fluid);
    return TAHR_OK;
}

const tahr_backend *tahr_backend_v1_native(void)
{
    static const tahr_backend backend = {
        .struct_size = sizeof(tahr_backend),
        .abi_major = TAHR_ABI_MAJOR,
        .abi_minor = TAHR_ABI_MINOR,
        .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                        TAHR_CAP_BOX | TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_HEIGHTS |
                        TAHR_CAP_SENSORS | TAHR_CAP_ONE_WAY | TAHR_CAP_BIT_IDENTICAL,
        .name = "native",
        .version = "0.1.0",
        .open = native_open,
        .close = native_close,
        .sweep = tahr__native_sweep,
        .contacts = tahr__native_contacts,
        .ray = tahr__native_ray,
        .cache_size = native_cache_size,
        .prepare = native_prepare,
        .place = native_place,
        .fluid = native_fluid,
        .walk = tahr__native_walk,
        .describe = tahr__native_describe,
    };
    return &backend;
}

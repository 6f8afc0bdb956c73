/* SPDX-License-Identifier: MIT
 * trace.c: the backend under a replay: takes every body and knows none. */
#include <tahr/trace.h>

static tahr_status open_scene(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    (void)host, (void)desc;
    *self = NULL;
    return TAHR_OK;
}

static void close_scene(void *self)
{
    (void)self;
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    (void)self, (void)context, (void)query, (void)hits, (void)capacity, (void)count;
    return TAHR_E_UNSUPPORTED;
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    (void)self, (void)context, (void)query, (void)found, (void)capacity, (void)count;
    return TAHR_E_UNSUPPORTED;
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    (void)self, (void)context, (void)query, (void)hit, (void)count;
    return TAHR_E_UNSUPPORTED;
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_SOLIDS, /* bodies of a replay are spheres: what they are is in the file */
    .name = "trace",
    .version = "1",
    .open = open_scene,
    .close = close_scene,
    .sweep = sweep,
    .contacts = contacts,
    .ray = ray,
};

const tahr_backend *tahr_backend_v1_trace(void)
{
    return &backend;
}

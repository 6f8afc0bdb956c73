/* SPDX-License-Identifier: MIT
 * broken.c: a backend with one thing wrong that tahr_plugin_load must find; BROKEN_* says which. */
#include <tahr/backend.h>

#ifdef BROKEN_NO_SYMBOL
TAHR_API int tahr_backend_v0(void);
int tahr_backend_v0(void)
{
    return 0;
}
#else
TAHR_API const tahr_backend *tahr_backend_v1(void);

static tahr_status open_nothing(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    (void)host, (void)desc, (void)self;
    return TAHR_E_UNSUPPORTED;
}

static void close_nothing(void *self)
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

#ifndef BROKEN_NULL_SLOT
static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    (void)self, (void)context, (void)query, (void)hit, (void)count;
    return TAHR_E_UNSUPPORTED;
}
#endif

static const tahr_backend backend = {
#if defined(BROKEN_SMALL_STRUCT)
    .struct_size = sizeof backend - 8,
#elif defined(BROKEN_TINY_STRUCT)
    .struct_size = 4,
#else
    .struct_size = sizeof backend,
#endif
#if defined(BROKEN_BAD_MAJOR)
    .abi_major = TAHR_ABI_MAJOR + 1,
#else
    .abi_major = TAHR_ABI_MAJOR,
#endif
#if defined(BROKEN_BAD_MINOR)
    .abi_minor = TAHR_ABI_MINOR + 1,
#else
    .abi_minor = TAHR_ABI_MINOR,
#endif
#ifndef BROKEN_NULL_NAME
    .name = "broken",
#endif
    .version = "0",
    .open = open_nothing,
    .close = close_nothing,
    .sweep = sweep,
    .contacts = contacts,
#ifndef BROKEN_NULL_SLOT
    .ray = ray,
#endif
};

const tahr_backend *tahr_backend_v1(void)
{
#ifdef BROKEN_NULL_TABLE
    (void)backend;
    return NULL;
#else
    return &backend;
#endif
}
#endif

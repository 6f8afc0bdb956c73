/* SPDX-License-Identifier: MIT
 * template.c: a whole backend to copy: boxes, spheres and capsules, asked one by one. README.md goes through it. Where
 * an engine of yours comes in, it finds the bodies (instead of the loops); what decides stays the core distance. */
#include "../common/solid.h"

#include <string.h>

TAHR_API const tahr_backend *tahr_backend_v1_template(void);

typedef struct scene {
    const tahr_host *host;
    uint32_t count, reserved;
    tahr_body_desc bodies[];
} scene;

static tahr_status open_scene(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    const size_t size = sizeof(scene) + desc->body_count * sizeof *desc->bodies;
    scene *s = host->allocator.alloc(host->allocator.user, size, 8);
    if (!s) return TAHR_E_MEMORY;
    s->host = host;
    s->count = desc->body_count;
    if (s->count > 0) memcpy(s->bodies, desc->bodies, s->count * sizeof *s->bodies);
    *self = s;
    return TAHR_OK;
}

static void close_scene(void *self)
{
    scene *s = self;
    const tahr_allocator a = s->host->allocator;
    a.free(a.user, s, sizeof *s + s->count * sizeof *s->bodies, 8);
}

static int is_there(const scene *s, uint32_t body, uint32_t mask, uint32_t ignored, uint32_t flags)
{
    const uint32_t own = s->bodies[body].mask ? s->bodies[body].mask : 0xFFFFFFFFu; /* 0: all bits */
    return own & mask && (flags & TAHR_SWEEP_ONLY_BODY ? body == ignored : body != ignored);
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    const scene *s = self;
    tahr_hit hit;
    *count = 0;
    if (capacity == 0 || query->flags & TAHR_SWEEP_SENSORS) return TAHR_OK; /* there are none */
    for (uint32_t i = 0; i < s->count; i++) {
        if (!is_there(s, i, query->mask, query->ignore_body, query->flags)) continue;
        context->narrow_tests++;
        if (!tahr__solid_sweep(&s->bodies[i], i, query, &hit)) continue;
        if (*count == 0 || tahr__solid_before(&hit, hits)) *hits = hit;
        *count = 1;
    }
    return TAHR_OK;
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    const scene *s = self;
    tahr_status status = TAHR_OK;
    tahr_contact contact;
    *count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (!is_there(s, i, query->mask, query->ignore_body, 0)) continue;
        context->narrow_tests++;
        if (!tahr__solid_contact(&s->bodies[i], i, query, &contact)) continue;
        if (!tahr__solid_insert(&contact, found, capacity, count)) status = TAHR_TRUNCATED;
    }
    return status;
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    const scene *s = self;
    tahr_hit one;
    *count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (!is_there(s, i, query->mask, query->ignore_body, 0)) continue;
        context->narrow_tests++;
        if (!tahr__solid_ray(&s->bodies[i], i, query, &one)) continue;
        if (*count == 0 || tahr__solid_before(&one, hit)) *hit = one;
        *count = 1;
    }
    return TAHR_OK;
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    scene *s = self;
    for (uint32_t i = 0; i < count; i++)
        s->bodies[poses[i].body].pose = poses[i].pose; /* the library has checked both */
    return TAHR_OK;
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                    TAHR_CAP_BOX | TAHR_CAP_SOLIDS,
    .name = "template",
    .version = "1",
    .open = open_scene,
    .close = close_scene,
    .sweep = sweep,
    .contacts = contacts,
    .ray = ray,
    .place = place,
};

const tahr_backend *tahr_backend_v1_template(void)
{
    return &backend;
}

/* SPDX-License-Identifier: MIT
 * template.c: a whole backend to copy: boxes, spheres and capsules, looked at one by one. README.md goes through it.
 * Where an engine of yours comes in, it finds the bodies (instead of next); what decides stays the core distance. */
#include "../common/piece_query.h"
#include "../common/room.h"

TAHR_API const tahr_backend *tahr_backend_v1_template(void);

static void close_scene(void *self)
{
    tahr__scene *scene = self;
    const tahr_host *host = scene->host;
    tahr__scene_close(scene);
    tahr__room_put(host, scene, 1, sizeof *scene);
}

static tahr_status open_scene(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__scene *scene = tahr__room_get(host, 1, sizeof *scene);
    if (!scene) return TAHR_E_MEMORY;
    tahr_status status = tahr__scene_open(scene, host, desc, 0);
    if (status < 0)
        close_scene(scene);
    else
        *self = scene;
    return status;
}

/* What is kept for one query: how far it has come. */
typedef struct search {
    tahr__piece_query query;
    uint32_t body, reserved;
} search;

static void from_the_first(tahr__piece_query *query)
{
    ((search *)query)->body = 0;
}

/* The next body whose bounds meet the box of the query. */
static int next(tahr__piece_query *query, uint64_t *name)
{
    const tahr_bounds box = tahr__piece_query_box(query);
    search *s = (search *)query;
    while (s->body < query->scene->body_count) {
        const tahr_bounds bounds = tahr__scene_bounds(&query->scene->bodies[s->body]);
        *name = s->body++;
        if (tahr__bounds_meet(&bounds, &box)) return 1;
    }
    return 0;
}

static int make(tahr__piece_query *query, tahr__piece_found *found)
{
    const tahr__scene_body *body = &query->scene->bodies[found->name];
    tahr__piece_of_body(query, body, 0, found);
    return tahr__piece_wanted(query, body);
}

static const tahr__piece_finder finder = {.rewind = from_the_first, .next = next, .make = make};

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    search s;
    return tahr__piece_sweep(tahr__piece_query_by(&s.query, &finder, self, context), query, hits, capacity, count);
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    search s;
    return tahr__piece_contacts(tahr__piece_query_by(&s.query, &finder, self, context), query, found, capacity, count);
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    search s;
    return tahr__piece_ray(tahr__piece_query_by(&s.query, &finder, self, context), query, hit, count);
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
    .place = tahr__scene_place,
};

const tahr_backend *tahr_backend_v1_template(void)
{
    return &backend;
}

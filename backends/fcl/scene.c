/* SPDX-License-Identifier: MIT
 * scene.c: the scene of the fcl backend: bodies, FCL's objects for them, settings. */
#include "scene.h"

#include "../common/options.h"
#include "../common/room.h"

/* FCL gets the cleaned triangles in their order, so that its names for them are ours. */
static tahr_status add_mesh(tahr__fcl_scene *scene, const tahr__scene_body *b)
{
    const tahr_host *host = scene->scene.host;
    uint32_t count = b->mesh->triangle_count, *indices = tahr__room_get(host, count, 3 * sizeof *indices);
    const tahr__fcl_geometry g = {.kind = TAHR_BODY_MESH,
                                  .vertices = &b->mesh->vertices[0].x,
                                  .indices = indices,
                                  .vertex_count = b->mesh->vertex_count,
                                  .triangle_count = count};

    if (!indices) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        memcpy(indices + 3 * (size_t)i, b->mesh->triangles[i].vertex, sizeof b->mesh->triangles[i].vertex);
    tahr_status status = tahr__fcl_engine_add(scene->engine, &g, &b->pose);
    tahr__room_put(host, indices, count, 3 * sizeof *indices);
    return status;
}

static tahr_status add_body(tahr__fcl_scene *scene, const tahr__scene_body *b)
{
    const tahr__fcl_geometry g = {.kind = b->kind,
                                  .half_extents = b->half_extents,
                                  .radius = b->radius,
                                  .reach = b->reach,
                                  .vertices = b->hull.count > 0 ? &b->hull.vertices[0].x : NULL,
                                  .vertex_count = b->hull.count};

    return b->mesh ? add_mesh(scene, b) : tahr__fcl_engine_add(scene->engine, &g, &b->pose);
}

/* A known overlap of every kind that is there: what FCL does not find, nobody would ever meet. */
static tahr_status probe(const tahr__fcl_scene *scene)
{
    for (uint32_t i = 0; i < scene->scene.body_count; i++) {
        const tahr__scene_body *b = &scene->scene.bodies[i];
        uint32_t last = b->kind == TAHR_BODY_MESH ? b->mesh->triangle_count - 1 : 0;
        tahr_vec3 at[2] = {b->pose.position, b->pose.position};
        if (b->kind == TAHR__FCL_HALF_SPACE || b->kind == TAHR__FCL_PLANE) continue; /* without bounds: everywhere */
        if (b->kind == TAHR_BODY_MESH) {
            at[0] = b->mesh->vertices[b->mesh->triangles[0].vertex[0]];
            at[1] = b->mesh->vertices[b->mesh->triangles[last].vertex[0]];
        }
        if (tahr__fcl_engine_finds(scene->engine, i, 0, &at[0]) &&
            tahr__fcl_engine_finds(scene->engine, i, last, &at[1]))
            continue;
        tahr__log_body(scene->scene.host, b->surface.id, "FCL does not find it where it is: it cannot be held");
        return TAHR_E_UNSUPPORTED;
    }
    return TAHR_OK;
}

static tahr_status check_options(const tahr__fcl_scene *scene, const tahr_world_desc *desc)
{
    const tahr_fcl_desc *d = &scene->desc;
    const char *bad = d->volumes > TAHR_FCL_OBBRSS                          ? "options.volumes is no TAHR_FCL_*"
                      : d->search > TAHR_FCL_COLLIDE                        ? "options.search is no TAHR_FCL_*"
                      : d->no_cache > 1                                     ? "options.no_cache is not 0 or 1"
                      : d->cache_parts > 65536                              ? "options.cache_parts is above 65536"
                      : !(d->cache_margin >= 0 && d->cache_margin <= 1000)  ? "options.cache_margin is not 0..1000"
                      : d->octree_count > 1u << 20                          ? "options.octree_count is above 2^20"
                      : d->octree_count && !d->octrees                      ? "options.octrees is NULL"
                      : d->manager && (desc->body_count || d->octree_count) ? "options.manager allows no own bodies"
                                                                            : NULL;
    if (!bad) return TAHR_OK;
    tahr__log_error(scene->scene.host, bad);
    return TAHR_E_ARGUMENT;
}

static tahr_status add_bodies(tahr__fcl_scene *scene)
{
    tahr_status status = TAHR_OK;

    for (uint32_t i = 0; i < scene->scene.described && status >= 0; i++)
        status = add_body(scene, &scene->scene.bodies[i]);
    if (status >= 0) status = tahr__fcl_scene_octrees(scene);
    return status < 0 ? status : tahr__fcl_engine_finish(scene->engine);
}

static tahr_status open_scene(tahr__fcl_scene *scene, const tahr_host *host, const tahr_world_desc *desc)
{
    uint32_t attached = 0;
    tahr_status status = tahr__options_read(host, desc->options, &scene->desc, sizeof scene->desc);

    if (status >= 0) status = check_options(scene, desc);
    if (status < 0) return status;
    if (scene->desc.cache_parts == 0) scene->desc.cache_parts = 256;
    if (!(scene->desc.cache_margin > 0)) scene->desc.cache_margin = 0.5;
    status = tahr__fcl_engine_open(host, &scene->desc, &scene->engine);
    if (status >= 0 && scene->desc.manager) status = tahr__fcl_engine_attach(scene->engine, &attached);
    if (status >= 0) status = tahr__scene_open(&scene->scene, host, desc, attached + scene->desc.octree_count);
    if (status >= 0) status = scene->desc.manager ? tahr__fcl_scene_attach(scene) : add_bodies(scene);
    return status < 0 ? status : probe(scene);
}

tahr_status tahr__fcl_open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__fcl_scene *scene = tahr__room_get(host, 1, sizeof *scene);

    if (!scene) return TAHR_E_MEMORY;
    scene->scene.host = host;
    tahr_status status = open_scene(scene, host, desc);
    if (status < 0)
        tahr__fcl_close(scene);
    else
        *self = scene;
    return status;
}

void tahr__fcl_close(void *self)
{
    tahr__fcl_scene *scene = self;

    if (!scene) return;
    tahr__room_put(scene->scene.host, (void *)scene->identities, scene->scene.capacity, sizeof *scene->identities);
    tahr__fcl_engine_close(scene->engine);
    tahr__scene_close(&scene->scene);
    tahr__room_put(scene->scene.host, scene, 1, sizeof *scene);
}

/* FCL may run out of memory while its tree is brought up to date: then the world is not fit for use any more, and says
 * so at every query. */
tahr_status tahr__fcl_place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    tahr__fcl_scene *scene = self;
    tahr_status status = tahr__scene_place(self, poses, count);

    if (status < 0) return status;
    for (uint32_t i = 0; i < count && status >= 0; i++)
        status = tahr__fcl_engine_place(scene->engine, poses[i].body, &poses[i].pose);
    if (status >= 0) status = tahr__fcl_engine_update(scene->engine);
    scene->revision++;
    return status;
}

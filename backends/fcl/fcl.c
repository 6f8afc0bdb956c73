/* SPDX-License-Identifier: MIT
 * fcl.c: the table of the fcl backend and its life cycle. */
#include "scene.h"

#include <string.h>

static tahr_status open_scene(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__fcl_scene *scene = host->allocator.alloc(host->allocator.user, sizeof *scene, 64);
    tahr_status status;

    if (!scene) return TAHR_E_MEMORY;
    status = tahr__fcl_scene_open(scene, host, desc);
    if (status < 0)
        host->allocator.free(host->allocator.user, scene, sizeof *scene, 64);
    else
        *self = scene;
    return status;
}

static void close_scene(void *self)
{
    tahr__fcl_scene *scene = self;
    tahr_allocator allocator;

    if (!scene) return;
    allocator = scene->host->allocator;
    tahr__fcl_scene_close(scene);
    allocator.free(allocator.user, scene, sizeof *scene, 64);
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    return tahr__fcl_scene_place(self, poses, count);
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    const tahr__fcl_scene *scene = self;

    (void)context;
    tahr__fluids_ask(&scene->fluids, query, answer);
    return TAHR_OK;
}

/* Octrees, which stay where they are, and attached bodies, which only the user knows the speeds of. */
static tahr_status body_motion(void *self, uint32_t id, tahr_body_motion *motion)
{
    const tahr__fcl_scene *scene = self;
    const tahr__fcl_body *b;
    tahr__mat turn;
    uint32_t i = 0;

    while (i < scene->body_count && scene->bodies[i].surface.id != id)
        i++;
    if (i == scene->body_count) return TAHR_E_NOT_FOUND;
    b = &scene->bodies[i];
    motion->pose = b->pose;
    turn = b->turn;
    if (scene->desc.manager) tahr__fcl_engine_pose(scene->engine, i, &motion->pose, &turn);
    motion->surface_velocity = m_apply(&turn, b->surface_velocity);
    motion->mass = b->mass;
    motion->flags = b->surface.flags;
    if (!scene->desc.motion || !scene->desc.manager) return TAHR_OK;
    return scene->desc.motion(scene->desc.user, tahr__fcl_engine_object_of(scene->engine, i), id, motion);
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                    TAHR_CAP_BOX | TAHR_CAP_CYLINDER | TAHR_CAP_CONE | TAHR_CAP_ELLIPSOID | TAHR_CAP_HULL |
                    TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_ROUND_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_SENSORS |
                    TAHR_CAP_ONE_WAY,
    .name = "fcl",
    .version = "0.7", /* the oldest that is known to work; nothing in FCL tells at run time */
    .open = open_scene,
    .close = close_scene,
    .sweep = tahr__fcl_sweep,
    .contacts = tahr__fcl_contacts,
    .ray = tahr__fcl_ray,
    .cache_size = tahr__fcl_cache_size,
    .prepare = tahr__fcl_prepare,
    .place = place,
    .body_motion = body_motion,
    .fluid = fluid,
};

const tahr_backend *tahr_backend_v1_fcl(void)
{
    return &backend;
}

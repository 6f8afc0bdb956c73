/* SPDX-License-Identifier: MIT
 * ccd.c: the table of the ccd backend and its life cycle. */
#include "scene.h"

static tahr_status open_scene(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__ccd_scene *scene = host->allocator.alloc(host->allocator.user, sizeof *scene, 64);
    tahr_status status;

    if (!scene) return TAHR_E_MEMORY;
    status = tahr__ccd_scene_open(scene, host, desc);
    if (status < 0)
        host->allocator.free(host->allocator.user, scene, sizeof *scene, 64);
    else
        *self = scene;
    return status;
}

static void close_scene(void *self)
{
    tahr__ccd_scene *scene = self;
    tahr_allocator allocator;

    if (!scene) return;
    allocator = scene->host->allocator;
    tahr__ccd_scene_close(scene);
    allocator.free(allocator.user, scene, sizeof *scene, 64);
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    return tahr__ccd_scene_place(self, poses, count);
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    const tahr__ccd_scene *scene = self;

    (void)context;
    tahr__fluids_ask(&scene->fluids, query, answer);
    return TAHR_OK;
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                    TAHR_CAP_BOX | TAHR_CAP_CYLINDER | TAHR_CAP_CONE | TAHR_CAP_ELLIPSOID | TAHR_CAP_HULL |
                    TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_ROUND_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_SENSORS |
                    TAHR_CAP_ONE_WAY,
    .name = "ccd",
    .version = "2.x", /* libccd says 2.0 in its CMake files and is 2.1 in Debian; nothing in it tells at run time */
    .open = open_scene,
    .close = close_scene,
    .sweep = tahr__ccd_sweep,
    .contacts = tahr__ccd_contacts,
    .ray = tahr__ccd_ray,
    .place = place,
    .fluid = fluid,
};

const tahr_backend *tahr_backend_v1_ccd(void)
{
    return &backend;
}

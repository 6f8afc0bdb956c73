/* SPDX-License-Identifier: MIT
 * fcl.c: the table of the fcl backend: its slots are those of convex pieces, found by query.c. */
#include "scene.h"

#include <stdio.h>

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    tahr__fcl_query own;
    return tahr__piece_sweep(tahr__piece_query_by(&own.query, &tahr__fcl_finder, self, context), query, hits, capacity,
                             count);
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    tahr__fcl_query own;
    return tahr__piece_contacts(tahr__piece_query_by(&own.query, &tahr__fcl_finder, self, context), query, found,
                                capacity, count);
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    tahr__fcl_query own;
    return tahr__piece_ray(tahr__piece_query_by(&own.query, &tahr__fcl_finder, self, context), query, hit, count);
}

/* Octrees, which stay where they are, and attached bodies, which only the user knows the speeds of. */
static tahr_status body_motion(void *self, uint32_t id, tahr_body_motion *motion)
{
    const tahr__fcl_scene *scene = self;
    const tahr__scene_body *b = tahr__scene_find(&scene->scene, id);

    if (!b) return TAHR_E_NOT_FOUND;
    uint32_t i = (uint32_t)(b - scene->scene.bodies);
    tahr__mat turn = b->turn;
    motion->pose = b->pose;
    if (scene->desc.manager) tahr__fcl_engine_pose(scene->engine, i, &motion->pose, &turn);
    motion->surface_velocity = m_apply(&turn, b->surface_velocity);
    motion->mass = b->mass;
    motion->flags = b->surface.flags;
    if (!scene->desc.motion || !scene->desc.manager) return TAHR_OK;
    return scene->desc.motion(scene->desc.user, tahr__fcl_engine_object_of(scene->engine, i), id, motion);
}

static tahr_status describe(void *self, const tahr_log *to)
{
    const tahr__fcl_scene *scene = self;
    char path[256];
    snprintf(path, sizeof path,
             "path: FCL's %s, in meshes its trees of %s, searched by %s; what a step announces is found once; then "
             "pair by pair "
             "by the distance",
             scene->desc.manager ? "manager of yours" : "tree of bodies",
             scene->desc.volumes == TAHR_FCL_OBBRSS ? "OBBRSS" : "AABB",
             scene->desc.search == TAHR_FCL_COLLIDE ? "collide()" : "a descent of our own");
    tahr__scene_describe(&scene->scene, "fcl", path, to);
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
    .name = "fcl",
    .version = "0.7", /* the oldest that is known to work; nothing in FCL tells at run time */
    .open = tahr__fcl_open,
    .close = tahr__fcl_close,
    .sweep = sweep,
    .contacts = contacts,
    .ray = ray,
    .cache_size = tahr__fcl_cache_size,
    .prepare = tahr__fcl_prepare,
    .place = tahr__fcl_place,
    .body_motion = body_motion,
    .fluid = tahr__scene_fluid,
    .describe = describe,
};

const tahr_backend *tahr_backend_v1_fcl(void)
{
    return &backend;
}

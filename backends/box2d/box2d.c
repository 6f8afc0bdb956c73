/* SPDX-License-Identifier: MIT
 * box2d.c: the table of the box2d backend. */
#include "scene.h"

#include <stdio.h>

static tahr_status body_motion(void *self, uint32_t body, tahr_body_motion *motion)
{
    const tahr__b2_scene *scene = self;
    return scene->attached ? scene->engine->world_motion(&scene->desc, body, motion) : TAHR_E_NOT_FOUND;
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    const tahr__b2_scene *scene = self;
    tahr_fluid_query flat = *query;

    (void)context;
    flat.position.z = 0;
    tahr__fluids_ask(&scene->fluids, &flat, answer);
    return TAHR_OK;
}

static tahr_status describe(void *self, const tahr_log *to)
{
    const tahr__b2_scene *scene = self;
    uint32_t chains = 0, movable = 0;
    char text[256];

    if (scene->attached) {
        snprintf(text, sizeof text, "box2d, 2D: a world of yours, Box2D %s; path: its tree", scene->engine->version);
        to->write(to->user, TAHR_LOG_INFO, text);
        return TAHR_OK;
    }
    for (uint32_t i = 0; i < scene->body_count; i++) {
        chains += scene->bodies[i].type == TAHR_BODY_CHAIN;
        movable += (scene->bodies[i].owner.flags & TAHR_BODY_MOVABLE) != 0;
    }
    snprintf(text, sizeof text,
             "box2d, 2D: %u movable and %u static bodies, %u of them chains; path: the tree of Box2D %s, %u pieces: "
             "bodies, and of chains their segments",
             (unsigned)movable, (unsigned)(scene->body_count - movable), (unsigned)chains, scene->engine->version,
             (unsigned)scene->item_count);
    to->write(to->user, TAHR_LOG_INFO, text);
    return TAHR_OK;
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                    TAHR_CAP_BOX | TAHR_CAP_PLANAR | TAHR_CAP_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_CHAINS |
                    TAHR_CAP_ONE_WAY | TAHR_CAP_SENSORS,
    .name = "box2d",
#if defined(TAHR_BOX2D_HAS_2) && defined(TAHR_BOX2D_HAS_3)
    .version = "3 and 2.4",
#elif defined(TAHR_BOX2D_HAS_3)
    .version = "3",
#else
    .version = "2.4",
#endif
    .open = tahr__b2_open,
    .close = tahr__b2_close,
    .sweep = tahr__b2_sweep,
    .contacts = tahr__b2_contacts,
    .ray = tahr__b2_ray,
    .place = tahr__b2_place,
    .body_motion = body_motion,
    .fluid = fluid,
    .describe = describe,
};

const tahr_backend *tahr_backend_v1_box2d(void)
{
    return &backend;
}

/* SPDX-License-Identifier: MIT
 * engine.c: see engine.h. The engine is another world, asked through the public questions. */
#include "engine.h"

#include <stdlib.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

/* The worlds that are open, so that closing one finds its engine. */
enum { MOST = 4 };
static struct {
    tahr_world *outer, *engine;
} opened[MOST];

static tahr_status sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    uint32_t count = 0;
    tahr_status status = tahr_world_sweep(user, query, hit, 1, &count);
    return status < 0 ? status : TAHR_OK;
}

static tahr_status contacts(void *user, const tahr_contact_query *query, tahr_contact *found, uint32_t capacity,
                            uint32_t *count)
{
    return tahr_world_contacts(user, query, found, capacity, count);
}

static tahr_status ray(void *user, const tahr_ray *query, tahr_hit *hit)
{
    uint32_t count = 0;
    return tahr_world_ray(user, query, hit, &count);
}

static tahr_status sensors(void *user, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    tahr_sweep only = *query;
    only.flags |= TAHR_SWEEP_SENSORS;
    return tahr_world_sweep(user, &only, hits, capacity, count);
}

static tahr_status body(void *user, uint32_t id, tahr_body_motion *motion)
{
    return tahr_world_body(user, id, motion);
}

static tahr_status fluid(void *user, const tahr_fluid_query *query, tahr_fluid *found)
{
    return tahr_world_fluid(user, query, found);
}

static tahr_status open(const tahr_callbacks *functions, const tahr_world_desc *desc, tahr_world **world)
{
    tahr_world_desc scene = *desc;
    tahr_callbacks callbacks = *functions;
    tahr_world *engine = NULL, *outer = NULL;
    int place = 0;
    while (place < MOST && opened[place].outer)
        place++;
    tahr_status status = place < MOST ? tahr_world_open(tahr_backend_v1_native(), &scene, &engine) : TAHR_E_MEMORY;
    callbacks.user = engine;
    if (status >= 0) status = tahr_world_open_callbacks(&callbacks, desc, &outer);
    if (status < 0) {
        tahr_world_close(engine);
        return status;
    }
    opened[place].engine = engine;
    opened[place].outer = *world = outer;
    return TAHR_OK;
}

tahr_status engine_open(void *user, const tahr_world_desc *desc, tahr_world **world)
{
    const tahr_callbacks all = {.struct_size = sizeof all,
                                .sweep = sweep,
                                .contacts = contacts,
                                .ray = ray,
                                .sensors = sensors,
                                .body = body,
                                .fluid = fluid};
    (void)user;
    return open(&all, desc, world);
}

tahr_status engine_open_sweep_only(void *user, const tahr_world_desc *desc, tahr_world **world)
{
    const tahr_callbacks one = {.struct_size = sizeof one, .sweep = sweep};
    (void)user;
    return open(&one, desc, world);
}

void engine_close(void *user, tahr_world *world)
{
    (void)user;
    tahr_world_close(world);
    for (int i = 0; i < MOST; i++) {
        if (opened[i].outer == world) {
            tahr_world_close(opened[i].engine);
            opened[i].outer = opened[i].engine = NULL;
        }
    }
}

tahr_world *engine_inside(const tahr_world *world)
{
    for (int i = 0; i < MOST; i++) {
        if (opened[i].outer == world) return opened[i].engine;
    }
    return NULL;
}

/* SPDX-License-Identifier: MIT
 * crowd_make.c: making and freeing crowds. */
#include <stdio.h>
#include <string.h>

#include "crowd_rest.h"
#include "message.h"
#include "sized.h"
#include "world_memory.h"

enum { MOST = 1 << 22, MOST_CONFIGS = 65536, MOST_TASKS = 4096, USUAL_TASKS = 32 };

/* Zero but its size. */
static tahr_status clear(void *object, size_t size, size_t least)
{
    const uint32_t struct_size = (uint32_t)size;
    if (!object) {
        return TAHR_E_NULL;
    }
    if (size < least) {
        return TAHR_E_STRUCT_SIZE;
    }
    memset(object, 0, size);
    memcpy(object, &struct_size, sizeof struct_size);
    return TAHR_OK;
}

tahr_status tahr_crowd_desc_init(tahr_crowd_desc *desc, size_t size)
{
    return clear(desc, size, sizeof *desc);
}

tahr_status tahr_crowd_tick_init(tahr_crowd_tick *tick, size_t size)
{
    return clear(tick, size, sizeof *tick);
}

static tahr_status refuse(const tahr_world *world, tahr_status status, const char *field, const char *what)
{
    return tahr__complain(&world->log, status, "tahr_crowd_create", field, what);
}

static tahr_status check(const tahr_world *world, const tahr_crowd_desc *d)
{
    tahr_status status = tahr__sized_check(d, sizeof *d);
    if (status < 0) {
        return refuse(world, status, "desc:", tahr_status_message(status));
    }
    if (d->capacity < 1 || d->capacity > MOST) {
        return refuse(world, TAHR_E_ARGUMENT, "desc.capacity", "is out of 1..4194304");
    }
    if (d->config_count < 1 || d->config_count > MOST_CONFIGS) {
        return refuse(world, TAHR_E_ARGUMENT, "desc.config_count", "is out of 1..65536");
    }
    if (d->tasks > MOST_TASKS || d->reserved) {
        return refuse(world, TAHR_E_ARGUMENT, d->reserved ? "desc.reserved" : "desc.tasks", "is out of range");
    }
    if (d->flags & ~(uint32_t)(TAHR_CROWD_STAND_ON_HEADS | TAHR_CROWD_LEAN)) {
        return refuse(world, TAHR_E_ARGUMENT, "desc.flags", "has unknown bits");
    }
    if (!d->configs) {
        return refuse(world, TAHR_E_NULL, "desc.configs", "is NULL");
    }
    const size_t stride = d->configs[0].struct_size;
    if (stride < sizeof(tahr_config) || stride > sizeof(tahr_config) + TAHR__MOST_UNKNOWN || stride % 8 != 0) {
        return refuse(world, TAHR_E_STRUCT_SIZE, "desc.configs[0].struct_size", "is not that of a tahr_config");
    }
    return TAHR_OK;
}

/* One block for all arrays: where the next of them begins in it. */
static size_t take(size_t *used, size_t count, size_t size)
{
    size_t at = (*used + 63) & ~(size_t)63;
    *used = at + count * size;
    return at;
}

typedef struct plan {
    size_t kinds, movers, kind_of, figures, looks, statuses, strayed, keys, parts, rests, resting, still, bucket,
        corner, start, order, size;
} plan;

static plan plan_of(const tahr_crowd *c)
{
    const size_t n = c->capacity, table = c->key_mask + (size_t)1;
    plan p = {.size = 0};
    p.kinds = take(&p.size, c->kind_count, sizeof *c->kinds);
    p.movers = take(&p.size, c->mover_count, sizeof *c->movers);
    p.kind_of = take(&p.size, c->mover_count, sizeof *c->kind_of);
    p.figures = take(&p.size, n, sizeof *c->figures);
    p.looks = take(&p.size, n, sizeof *c->looks);
    p.statuses = take(&p.size, n, sizeof *c->statuses);
    p.strayed = take(&p.size, n, sizeof *c->strayed);
    p.keys = take(&p.size, table, sizeof *c->keys);
    p.parts = take(&p.size, c->tasks, sizeof *c->parts);
    p.rests = take(&p.size, c->is_lean ? 0 : n, sizeof *c->rests);
    p.resting = take(&p.size, n, sizeof *c->resting);
    p.still = take(&p.size, n, sizeof *c->still);
    p.bucket = take(&p.size, n, sizeof *c->grid.bucket);
    p.corner = take(&p.size, n, sizeof *c->grid.corner);
    p.start = take(&p.size, table + 3, sizeof *c->grid.start);
    p.order = take(&p.size, n, sizeof *c->grid.order);
    return p;
}

static void divide(tahr_crowd *c, const plan *p)
{
    char *m = c->memory;
    c->kinds = (tahr_mover **)(void *)(m + p->kinds);
    c->movers = (tahr_mover **)(void *)(m + p->movers);
    c->kind_of = (uint32_t *)(void *)(m + p->kind_of);
    c->figures = (tahr__figure *)(void *)(m + p->figures);
    c->looks = (tahr__look *)(void *)(m + p->looks);
    c->statuses = (tahr_status *)(void *)(m + p->statuses);
    c->strayed = (double *)(void *)(m + p->strayed);
    c->keys = (uint32_t *)(void *)(m + p->keys);
    c->parts = (tahr__part *)(void *)(m + p->parts);
    c->rests = (tahr__rest *)(void *)(m + p->rests);
    c->resting = (uint8_t *)(void *)(m + p->resting);
    c->still = (uint8_t *)(void *)(m + p->still);
    c->grid = (tahr__grid){.figures = c->figures,
                           .mask = c->key_mask,
                           .bucket = (uint32_t *)(void *)(m + p->bucket),
                           .corner = (uint64_t *)(void *)(m + p->corner),
                           .start = (uint32_t *)(void *)(m + p->start),
                           .order = (uint32_t *)(void *)(m + p->order)};
}

static void release(tahr_crowd *c)
{
    const tahr_allocator a = c->allocator;
    for (uint32_t i = 0; c->memory && i < c->kind_count; i++) {
        tahr_mover_destroy(c->kinds[i]);
    }
    for (uint32_t i = 0; c->memory && i < c->mover_count; i++) {
        tahr_mover_destroy(c->movers[i]);
    }
    if (c->memory) {
        a.free(a.user, c->memory, c->size, 64);
    }
    a.free(a.user, c, sizeof *c, 64);
}

static tahr_status make_movers(tahr_crowd *c, const tahr_crowd_desc *d)
{
    const size_t stride = d->configs[0].struct_size;
    tahr_status status = TAHR_OK;
    for (uint32_t i = 0; i < c->kind_count && status >= 0; i++) {
        const char *at = (const char *)d->configs + i * stride;
        const tahr_config *config = (const tahr_config *)(const void *)at;
        if (config->struct_size != stride) {
            return refuse(c->world, TAHR_E_STRUCT_SIZE, "desc.configs.struct_size", "is not that of the first one");
        }
        status = tahr_mover_create(c->world, config, &c->kinds[i]);
        if (status < 0) {
            char text[64];
            snprintf(text, sizeof text, "desc.configs[%u]: %s", i, tahr_status_message(status));
            tahr__say(&c->world->log, TAHR_LOG_ERROR, "tahr_crowd_create", text);
        }
    }
    for (uint32_t i = 0; i < c->mover_count && status >= 0; i++) {
        status = tahr_mover_create(c->world, d->configs, &c->movers[i]);
        if (status >= 0 && c->is_lean) { /* knows the surroundings of one character, and serves many */
            c->movers[i]->calm.may = 0;
        }
    }
    return status;
}

tahr_status tahr_crowd_create(tahr_world *world, const tahr_crowd_desc *desc, tahr_crowd **out)
{
    if (!world) {
        return TAHR_E_NULL;
    }
    if (!desc || !out) {
        return refuse(world, TAHR_E_NULL, desc ? "crowd" : "desc", "is NULL");
    }
    tahr_status status = check(world, desc);
    if (status < 0) {
        return status;
    }
    const tahr_allocator a = world->memory.user;
    tahr_crowd *c = a.alloc(a.user, sizeof *c, 64);
    if (!c) {
        return refuse(world, TAHR_E_MEMORY, "allocator", "returned NULL");
    }
    memset(c, 0, sizeof *c);
    c->world = world;
    c->allocator = a;
    c->capacity = desc->capacity;
    c->kind_count = desc->config_count;
    c->tasks = desc->tasks ? desc->tasks : USUAL_TASKS;
    c->is_lean = (desc->flags & TAHR_CROWD_LEAN) != 0;
    c->mover_count = c->is_lean ? c->tasks : c->capacity;
    c->walkable_rule =
        desc->flags & TAHR_CROWD_STAND_ON_HEADS ? (uint32_t)TAHR_WALKABLE_DEFAULT : (uint32_t)TAHR_WALKABLE_NEVER;
    c->run_tasks = desc->run_tasks;
    c->run_user = desc->run_user;
    for (c->key_mask = 15; c->key_mask < 4 * c->capacity; c->key_mask = 2 * c->key_mask + 1) {
    }
    const plan p = plan_of(c);
    c->size = p.size;
    c->memory = a.alloc(a.user, c->size, 64);
    if (c->memory) {
        memset(c->memory, 0, c->size);
        divide(c, &p);
    }
    status = c->memory ? make_movers(c, desc) : refuse(world, TAHR_E_MEMORY, "allocator", "returned NULL");
    if (status < 0) {
        release(c);
        return status;
    }
    c->counts.struct_size = sizeof c->counts;
    world->crowds++;
    *out = c;
    return TAHR_OK;
}

void tahr_crowd_destroy(tahr_crowd *crowd)
{
    if (crowd) {
        crowd->world->crowds--;
        release(crowd);
    }
}

tahr_status tahr_crowd_get_counts(const tahr_crowd *crowd, tahr_crowd_counts *counts)
{
    if (!crowd || !counts) {
        return TAHR_E_NULL;
    }
    const uint32_t size = counts->struct_size;
    if (size < sizeof *counts) {
        return TAHR_E_STRUCT_SIZE;
    }
    *counts = crowd->counts;
    counts->struct_size = size;
    return TAHR_OK;
}

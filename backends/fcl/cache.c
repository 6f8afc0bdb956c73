/* SPDX-License-Identifier: MIT
 * cache.c: what was gathered before a step: names of parts, asked of FCL once for many queries. Every part is looked at
 * again by every query, so that the bits are those of a query that asked FCL itself. */
#include "scene.h"

#include <string.h>

#define TOO_MANY UINT32_MAX

typedef struct cache {
    uint64_t revision; /* of the scene, plus 1; 0: nothing is in here */
    tahr_bounds box;   /* world */
    uint32_t count;    /* or TOO_MANY: they did not fit, and need not be tried again */
    uint32_t reserved;
    tahr__fcl_part parts[];
} cache;

/* An attached world changes without saying so. */
static int is_used(const tahr__fcl_scene *scene)
{
    return !scene->desc.no_cache && !scene->desc.manager;
}

size_t tahr__fcl_cache_size(void *self)
{
    const tahr__fcl_scene *scene = self;
    return is_used(scene) ? sizeof(cache) + scene->desc.cache_parts * sizeof(tahr__fcl_part) : 0;
}

static int holds(const tahr_bounds *outer, const tahr_bounds *inner)
{
    return inner->min.x >= outer->min.x && inner->max.x <= outer->max.x && inner->min.y >= outer->min.y &&
           inner->max.y <= outer->max.y && inner->min.z >= outer->min.z && inner->max.z <= outer->max.z;
}

tahr_status tahr__fcl_prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    const tahr__fcl_scene *scene = self;
    const tahr_bounds *b = &announcement->bounds;
    double grow = scene->desc.cache_margin;
    tahr__fcl_question question = {
        {{b->min.x - grow, b->min.y - grow, b->min.z - grow}, {b->max.x + grow, b->max.y + grow, b->max.z + grow}},
        NULL,
        NULL};
    cache *c = context->cache;
    tahr__fcl_list list;

    if (!c || !is_used(scene)) return TAHR_OK;
    if (c->revision == scene->revision + 1 && holds(&c->box, b)) return TAHR_OK;
    c->revision = 0;
    if (!((b->max.x - b->min.x + b->max.y - b->min.y + b->max.z - b->min.z) * 0 == 0)) return TAHR_OK;
    context->gathers++;
    tahr__fcl_list_begin(&list, scene->scene.host, c->parts, scene->desc.cache_parts);
    tahr_status status = tahr__fcl_engine_gather(scene->engine, &question, &list);
    tahr__fcl_list_sort(&list);
    if (status >= 0) {
        c->count = list.grown ? TOO_MANY : list.count;
        c->box = question.box;
        c->revision = scene->revision + 1;
    }
    tahr__fcl_list_free(&list);
    return status < 0 ? status : TAHR_OK;
}

int tahr__fcl_cache_find(const tahr__fcl_query *query, const tahr_bounds *box, const tahr__fcl_part **parts,
                         uint32_t *count)
{
    const tahr__fcl_scene *scene = tahr__fcl_scene_of(&query->query);
    const cache *c = query->query.context->cache;

    if (!c || !is_used(scene) || c->revision != scene->revision + 1 || c->count == TOO_MANY) return 0;
    if (!holds(&c->box, box)) {
        query->query.context->escapes++;
        return 0;
    }
    query->query.context->cached++;
    *parts = c->parts;
    *count = c->count;
    return 1;
}

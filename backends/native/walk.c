/* SPDX-License-Identifier: MIT
 * walk.c: the walk slot: the way and the floor under its end, from what is known of the vicinity. It never looks around
 * itself: the sweeps do when it does not know, and they alone follow an announcement. */
#include "scene.h"

static tahr_vec3 turned(const tahr__frame *frame, tahr_vec3 v)
{
    return frame->turned ? m_apply(&frame->turn, v) : v;
}

static void aim(tahr__query *query, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 motion)
{
    query->start = turned(query->frame, v_sub(position, query->frame->origin));
    query->motion = turned(query->frame, motion);
    query->motion_length = v_length(query->motion);
    query->core.axis_count = 0;
    query->extent = v_make(0, 0, 0);
    query->half = 0;
    tahr__query_shape(query, shape, (tahr_quat){0, 0, 0, 1});
}

/* Beyond all that there is, by more than the shape and its way. A metre is more than any rounding. */
static int is_in_the_open(const tahr__native *world, const tahr_walk *walk)
{
    return world->movable.count == 0 &&
           tahr__outside_of_all(world, walk->position) >
               1 + walk->shape->half_height + walk->shape->radius + walk->margin + v_length(walk->motion);
}

tahr_status tahr__native_walk(void *self, tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit,
                              uint32_t *known)
{
    const tahr__native *world = self;
    const tahr__cache *cache = context->cache;
    tahr__query query;
    uint32_t count = 0;
    *known = 0;
    if (!walk->foot && is_in_the_open(world, walk)) {
        *known = 1;
        context->spared++;
        return TAHR_OK;
    }
    if (!cache || !cache->announced || !tahr__frame_holds(&cache->frame, walk->position, walk->up)) return TAHR_OK;
    tahr__query_begin(&query, world, context, walk->position, walk->up);
    query.margin = walk->margin;
    query.mask = walk->mask;
    query.ignore_body = TAHR_NO_BODY;
    aim(&query, walk->shape, walk->position, walk->motion);
    if (!tahr__vicinity_knows(&query, hit, &count) || count > 0) return TAHR_OK;
    if (!walk->foot) {
        *known = 1;
        context->spared++;
        return TAHR_OK;
    }
    aim(&query, walk->foot, walk->foot_position, walk->foot_motion);
    *known = tahr__vicinity_knows(&query, hit, &count) && count > 0;
    context->spared += *known ? 2 : 0;
    return TAHR_OK;
}

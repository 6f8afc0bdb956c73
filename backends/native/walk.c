/* SPDX-License-Identifier: MIT
 * walk.c: the walk slot: the way and the floor under its end, from what is known of the vicinity. It never looks around
 * itself: the sweeps do when it does not know, and they alone follow an announcement. */
#include "scene.h"

static tahr_vec3 turned(const tahr__frame *frame, tahr_vec3 v)
{
    return frame->turned ? m_apply(&frame->turn, v) : v;
}

static void aim(tahr__query *query, tahr_query_context *context, const tahr_walk *walk, int foot)
{
    tahr__query_begin(query, query->world, context, foot ? walk->foot_position : walk->position, walk->up);
    tahr__query_shape(query, foot ? walk->foot : walk->shape, (tahr_quat){0, 0, 0, 1});
    query->motion = turned(query->frame, foot ? walk->foot_motion : walk->motion);
    query->motion_length = v_length(query->motion);
    query->margin = walk->margin;
    query->mask = walk->mask;
    query->ignore_body = TAHR_NO_BODY;
}

/* Beyond all that there is: how far the shape may go (m; < 0: it is not). A metre is more than any rounding. */
static double room_in_the_open(const tahr__native *world, const tahr_walk *walk)
{
    return world->movable.count > 0 ? -1
                                    : tahr__outside_of_all(world, walk->position) -
                                          (1 + walk->shape->half_height + walk->shape->radius + walk->margin);
}

tahr_status tahr__native_walk(void *self, tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit,
                              uint32_t *known)
{
    const tahr__native *world = self;
    const tahr__cache *cache = context->cache;
    tahr__query query;
    uint32_t count = 0;
    *known = 0;
    if (!walk->foot) {
        const double room = room_in_the_open(world, walk);
        hit->distance = d_max(room, 0);
        if (room > v_length(walk->motion)) {
            *known = 1;
            context->spared++;
            return TAHR_OK;
        }
    }
    if (!cache || !cache->announced || !tahr__frame_holds(&cache->frame, walk->position, walk->up)) return TAHR_OK;
    query.world = world;
    aim(&query, context, walk, 0);
    if (!tahr__vicinity_knows(&query, hit, &count) || count > 0) return TAHR_OK;
    if (!walk->foot) {
        *known = 1;
        context->spared++;
        return TAHR_OK;
    }
    aim(&query, context, walk, 1);
    *known = tahr__vicinity_knows(&query, hit, &count) && count > 0;
    context->spared += *known ? 2 : 0;
    return TAHR_OK;
}

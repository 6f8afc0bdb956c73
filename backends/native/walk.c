/* SPDX-License-Identifier: MIT
 * walk.c: the walk slot: the way and the floor under its end, from what is known of the vicinity. It never looks around
 * itself: the sweeps do when it does not know, and they alone follow an announcement. */
#include "footing.h"

static tahr_vec3 turned(const tahr__frame *frame, tahr_vec3 v)
{
    return frame->turned ? m_apply(&frame->turn, v) : v;
}

/* A query of a cache that holds, of the body or its foot. */
static inline void aim(tahr__query *query, tahr_query_context *context, const tahr_walk *walk, int foot)
{
    const tahr__frame *frame = query->frame;
    query->context = context;
    query->start = turned(frame, v_sub(foot ? walk->foot_position : walk->position, frame->origin));
    query->motion = turned(frame, foot ? walk->foot_motion : walk->motion);
    query->motion_length = v_length(query->motion);
    query->margin = walk->margin;
    query->mask = walk->mask;
    query->ignore_body = TAHR_NO_BODY;
    query->core.axis_count = 0;
    query->extent = v_make(0, 0, 0);
    query->surplus = query->half = 0;
    query->flags = query->sinks = 0;
    query->sensors = TAHR__SENSORS_NONE;
    tahr__query_shape(query, foot ? walk->foot : walk->shape, (tahr_quat){0, 0, 0, 1});
}

/* Beyond all that there is: how far the shape may go (m; < 0: it is not). A metre is more than any rounding. */
static double room_in_the_open(const tahr__native *world, const tahr_walk *walk)
{
    const double all = tahr__outside_of_all(world, walk->position);
    return tahr__movable_gap(world, walk->position, all) -
           (1 + walk->shape->half_height + walk->shape->radius + walk->margin);
}

/* m: no part of a vector is more. */
static double sum_of(tahr_vec3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

/* Is all that may move farther than `reach` along an axis? Most often one is enough to tell. */
static int is_beyond(const tahr__group *group, tahr_vec3 position, double reach)
{
    const tahr__bvh_node *root = &group->tree.nodes[0];
    const tahr_vec3 at = v_sub(position, group->tree.centre);
    return at.x + reach < root->lo[0] || at.x - reach > root->hi[0] || at.y + reach < root->lo[1] ||
           at.y - reach > root->hi[1] || at.z + reach < root->lo[2] || at.z - reach > root->hi[2];
}

/* May a body that moves be met? What is known of the vicinity is what is at rest for good. Asked of a cube around the
 * place, which is far larger than both motions need, and soon made. */
static int meets_movable(const tahr__native *world, const tahr_walk *walk)
{
    if (world->movable.count == 0) return 0;
    double reach = walk->shape->half_height + walk->shape->radius + sum_of(walk->motion);
    if (walk->foot) {
        reach += walk->foot->radius + sum_of(v_sub(walk->foot_position, walk->position)) + sum_of(walk->foot_motion);
    }
    reach += walk->margin + 2 * TAHR__SLACK;
    if (is_beyond(&world->movable, walk->position, reach)) return 0;
    const tahr_vec3 grow = v_make(reach, reach, reach);
    const tahr_bounds box = {v_sub(walk->position, grow), v_add(walk->position, grow)};
    return tahr__movable_meets(world, &box);
}

/* May a foot that did not simply come down have met something all the same? */
static int finds_floor(tahr__query *foot, tahr_hit *hit)
{
    uint32_t count = 0;
    return tahr__sweep_rest(foot, hit, 1, &count) == TAHR_OK && count > 0;
}

static int goes_to(tahr__query *body, uint32_t way, const tahr_walk *walk, tahr_hit *hit)
{
    tahr__query foot;
    foot.world = body->world;
    foot.cache = body->cache;
    foot.frame = body->frame;
    aim(&foot, body->context, walk, 1);
    const uint32_t down = tahr__vicinity_way(&foot);
    if (down == TAHR__UNKNOWN) return 0;
    if (way == TAHR__OVER && down == TAHR__DOWN && tahr__vicinity_learn(body, &foot)) {
        const uint32_t end = tahr__footing_walk(body->world, body->context, walk, hit);
        if (end != TAHR__UNCLEAR) return end == TAHR__LANDED;
    }
    return tahr__vicinity_is_clear(body, way) && finds_floor(&foot, hit);
}

/* m that the shape may go from where it is, whichever way. */
static double room_here(const tahr__query *body, const tahr_walk *walk)
{
    const double reach = walk->shape->half_height + walk->shape->radius + walk->margin + 2 * TAHR__SLACK;
    const double room = tahr__vicinity_room(body);
    return tahr__movable_gap(body->world, walk->position, room + reach) - reach;
}

tahr_status tahr__native_walk(void *self, tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit,
                              uint32_t *known)
{
    const tahr__native *world = self;
    tahr__cache *cache = context->cache;
    tahr__query body;
    *known = TAHR_WALK_UNKNOWN;
    if (meets_movable(world, walk)) return TAHR_OK;
    if (walk->foot && cache && cache->revision == world->revision) {
        const uint32_t end = tahr__footing_walk(world, context, walk, hit);
        if (end == TAHR__LANDED) *known = TAHR_WALK_KNOWN, context->spared += 2;
        if (end != TAHR__UNCLEAR) return TAHR_OK;
    }
    if (!walk->foot) {
        const double room = room_in_the_open(world, walk);
        hit->distance = d_max(room, 0);
        if (room > v_length(walk->motion)) {
            *known = TAHR_WALK_KNOWN;
            context->spared++;
            return TAHR_OK;
        }
    }
    if (!cache || !cache->announced) return TAHR_OK;
    if (!tahr__frame_holds(&cache->frame, walk->position, walk->up)) {
        *known = cache->gathered ? TAHR_WALK_UNANNOUNCED : TAHR_WALK_UNKNOWN;
        return TAHR_OK;
    }
    body.world = world;
    body.cache = cache;
    body.frame = &cache->frame;
    aim(&body, context, walk, 0);
    const uint32_t way = tahr__vicinity_look(&body);
    if (way == TAHR__UNKNOWN) {
        if (tahr__vicinity_ends(&body)) *known = TAHR_WALK_UNANNOUNCED;
        return TAHR_OK;
    }
    *known = (uint32_t)(walk->foot ? goes_to(&body, way, walk, hit) : tahr__vicinity_is_clear(&body, way));
    context->spared += *known ? walk->foot ? 2 : 1 : 0;
    if (!walk->foot && *known) hit->distance = d_max(room_here(&body, walk), 0);
    return TAHR_OK;
}

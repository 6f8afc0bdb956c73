/* SPDX-License-Identifier: MIT
 * ground.h: the floor that the last foot was stopped by, and the one triangle of it that is under the character. */
#ifndef TAHR_NATIVE_GROUND_H
#define TAHR_NATIVE_GROUND_H

#include "scene.h"

/* Shapes of less reach (m) are left to the cache, for it has to be much more than the lengths of vicinity.c; and
 * of more, for APART (ground.c). */
#define TAHR__SMALL 1e-3
#define TAHR__LARGE 8.0

/* Of a query only where it is asked: in a cache that has been announced. */
static inline void ask_in_cache(tahr__query *query, const tahr__native *world, tahr_query_context *context)
{
    query->world = world;
    query->context = context;
    query->cache = context->cache;
    query->frame = &query->cache->frame;
}

/* m from the core at which something is met. */
static inline double reach_of(const tahr__query *query)
{
    return query->radius + query->margin;
}

/* How high the lower end of the query's segment is over the floor, times the length of its normal. */
static inline double height_over(const tahr__level *l, const tahr__query *query)
{
    return v_dot(l->normal, v_sub(query->start, l->at)) - query->half * l->normal.z;
}

/* Where a triangle is to the floor, as what is added to its distance for who stays above: nothing while it has not been
 * looked at; next to nothing for what is ABOVE, or where it cannot be told; and what is not met is far away. */
#define TAHR__UNSEEN 0.0f
#define TAHR__ABOVE 1e-30f
#define TAHR__BELOW 1e38f
#define TAHR__IN_IT 2e38f

/* Looks at one of the query's cache for the first time. */
float tahr__ground_see(const tahr__query *query, uint32_t index);

static inline float ground_side(const tahr__query *query, uint32_t index)
{
    const float side = tahr__cache_lift(query->world, query->cache)[index];
    return side != TAHR__UNSEEN ? side : tahr__ground_see(query, index);
}

/* Is a place on the floor one where nothing else of it is met than the triangle under the spot? */
static inline int ground_is_at_spot(const tahr__cache *cache, tahr_vec3 place)
{
    const tahr__footing *f = &cache->footing;
    const tahr__vicinity *v = &cache->vicinity;
    const tahr_vec3 off = v_sub(place, f->spot);
    const double off2 = v_dot(off, off);
    if (f->inside > 0 && off2 <= f->inside * f->inside) return 1;
    if (!(v->alone > 0) || off2 > v->alone * v->alone) return 0;
    int within = 1;
    for (int i = 0; i < 3; i++)
        within &= v_dot(v->across[i], place) <= v->border[i] - v->hem[i];
    return within;
}

/* Takes the plane of what stopped the last foot for the floor; as it is, if that lies in it. */
void tahr__ground_know(const tahr__query *query);

/* A foot that comes down on the floor, well inside of a triangle which nothing else of the floor reaches over: 1 and
 * when and where; 0: it is not known what is there. */
int tahr__ground_meets(const tahr__query *query, tahr__found *found);

/* Takes a triangle of the floor for the one under the spot. 0: it is met from behind. */
int tahr__ground_stand_on(const tahr__query *query, const tahr__prim *prim);

/* Finds the triangle of the floor at a place on it, which is at no spot: 1: it is there alone, and the spot is there
 * now. Of the query what it looks at: world, cache and frame. */
int tahr__ground_find(const tahr__query *query, tahr_vec3 place);

/* Is it known which triangle of the floor a foot that comes down may meet, one alone? finds: it has just been found. */
int tahr__ground_knows(const tahr__query *query, int *finds);

/* The cache holds something else now. */
void tahr__ground_forget(const tahr__native *world, tahr__cache *cache);

#endif

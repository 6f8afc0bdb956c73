/* SPDX-License-Identifier: MIT
 * gather.c: one character's cache of nearby static primitives, and the search that uses it where it holds everything. */
#include "lanes.h"
#include "scene.h"

#include <string.h>

/* A box that is far from everything, for unused lanes. */
#define NOWHERE 1e30f

/* Lanes keep a plane whose distance is within this of the reach (m): single precision over the 32 m in which triangles
 * have a plane at all is off by 1e-5 m. */
#define PLANE_SLACK 4e-5

/* The arrays behind a cache's header: six float bounds, a plane, body, item, nine coordinates (float or double). */
typedef struct arrays {
    float *bound[6], *plane[4];
    uint32_t *body, *item;
    void *corners;
} arrays;

static size_t corner_bytes(const tahr__native *world)
{
    return world->round ? sizeof(float) : sizeof(double);
}

static size_t header_bytes(void)
{
    return (sizeof(tahr__cache) + 63) / 64 * 64;
}

size_t tahr__cache_bytes(const tahr__native *world)
{
    size_t each = 10 * sizeof(float) + 2 * sizeof(uint32_t) + 9 * corner_bytes(world);
    return header_bytes() + (world->no_cache ? 0 : each * world->capacity);
}

static arrays arrays_of(const tahr__native *world, tahr__cache *cache)
{
    arrays a;
    /* The header ends on a multiple of 64, capacity is a multiple of 4: every array is aligned for its type. */
    float *f = (float *)(void *)((unsigned char *)cache + header_bytes());
    for (int i = 0; i < 6; i++) a.bound[i] = f + (size_t)i * world->capacity;
    for (int i = 0; i < 4; i++) a.plane[i] = f + (size_t)(6 + i) * world->capacity;
    a.body = (uint32_t *)(void *)(f + (size_t)10 * world->capacity);
    a.item = a.body + world->capacity;
    a.corners = a.item + world->capacity;
    return a;
}

static tahr__cache *cache_of(const tahr__query *query)
{
    return query->cache;
}

typedef struct gather {
    tahr__search search;
    arrays arrays;
    tahr__cache *cache;
} gather;

/* Its plane for the lanes, if it is a triangle near enough for single precision to tell. */
static void store_plane(const arrays *a, uint32_t n, const tahr__prim *prim, int usable)
{
    for (int i = 0; i < 4; i++) a->plane[i][n] = 0;
    if (!usable || (prim->item & (TAHR__ITEM_ROUND | TAHR__ITEM_SOLID))) return;
    tahr_vec3 normal = v_cross(v_sub(prim->v[1], prim->v[0]), v_sub(prim->v[2], prim->v[0]));
    double length = v_length(normal);
    if (!(length > 1e-6)) return; /* m2: of less area the direction may be rounding */
    normal = v_scale(normal, 1 / length);
    for (int i = 0; i < 3; i++) a->plane[i][n] = (float)v_get(normal, i);
    a->plane[3][n] = (float)v_dot(normal, prim->v[0]);
}

static void store(tahr__search *search, const tahr__prim *prim)
{
    gather *g = (gather *)search;
    const tahr__native *world = search->query->world;
    uint32_t n = g->cache->count;
    if (n == world->capacity) {
        /* Nothing more to find: what does not fit is never kept in part. */
        g->cache->overflow = 1;
        search->box.min = v_make(1e30, 1e30, 1e30);
        search->box.max = search->box.min;
        search->narrowed = 1;
        return;
    }
    tahr__map map;
    memset(&map, 0, sizeof map);
    if (prim->item & TAHR__ITEM_SOLID) map = tahr__map_make(&search->query->frame, &world->bodies[prim->body]);
    tahr_bounds b = tahr__prim_bounds(world, &map, prim);
    uint32_t wide = 0;
    int near = 1;
    for (int i = 0; i < 3; i++) {
        g->arrays.bound[i][n] = d_down(v_get(b.min, i));
        g->arrays.bound[3 + i][n] = d_up(v_get(b.max, i));
        for (int k = 0; k < 3; k++) {
            double x = v_get(prim->v[i], k);
            near = near && fabs(x) <= 32;
            if (world->round) {
                ((float *)g->arrays.corners)[9 * n + 3 * (uint32_t)i + (uint32_t)k] = (float)x;
                if (d_round_to_float(x) != x) wide = TAHR__ITEM_WIDE;
            } else {
                ((double *)g->arrays.corners)[9 * n + 3 * (uint32_t)i + (uint32_t)k] = x;
            }
        }
    }
    store_plane(&g->arrays, n, prim, near);
    g->arrays.body[n] = prim->body;
    g->arrays.item[n] = prim->item | wide;
    g->cache->count = n + 1;
}

static int same(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static int inside(const tahr_bounds *a, const tahr_bounds *b)
{
    return a->min.x >= b->min.x && a->min.y >= b->min.y && a->min.z >= b->min.z && a->max.x <= b->max.x &&
           a->max.y <= b->max.y && a->max.z <= b->max.z;
}

static void gather_now(tahr__native *world, tahr_query_context *context, const tahr_prepare *p)
{
    tahr__cache *cache = context->cache;
    tahr__query query;
    gather g;
    memset(&query, 0, sizeof query);
    query.world = world;
    query.context = context;
    query.frame = cache->frame;
    query.mask = p->mask;
    query.ignore_body = TAHR_NO_BODY;
    query.sensors = 1;
    query.start = tahr__frame_box_to_local(&cache->frame, &(tahr_bounds){p->position, p->position}).min;
    tahr_vec3 m = v_make(world->cache_margin, world->cache_margin, world->cache_margin);
    cache->bounds.min = v_sub(p->bounds.min, m);
    cache->bounds.max = v_add(p->bounds.max, m);
    cache->mask = p->mask;
    cache->gathered = 1;
    cache->overflow = cache->count = 0;
    g.search.query = &query;
    g.search.box = tahr__frame_box_to_local(&cache->frame, &cache->bounds);
    g.search.reach = 0;
    g.search.narrowed = 0;
    g.search.visit = store;
    g.arrays = arrays_of(world, cache);
    g.cache = cache;
    tahr__tree_search(&g.search, &world->fixed);
    for (uint32_t n = cache->count; n % 4 != 0; n++) {
        for (int i = 0; i < 6; i++) g.arrays.bound[i][n] = NOWHERE;
    }
    context->gathers++;
}

tahr_status tahr__cache_prepare(tahr__native *world, tahr_query_context *context, const tahr_prepare *p)
{
    tahr__cache *cache = context ? context->cache : NULL;
    if (!cache) return TAHR_OK;
    tahr__frame frame;
    memset(&frame, 0, sizeof frame);
    tahr__frame fresh = tahr__frame_make(world, p->position, p->up);
    int keep = cache->announced && same(&cache->frame.origin, &fresh.origin, sizeof fresh.origin) &&
               same(&cache->frame.up, &fresh.up, sizeof fresh.up);
    cache->frame = fresh;
    cache->announced = 1;
    if (world->no_cache) return TAHR_OK;
    if (keep && cache->gathered && (p->mask & ~cache->mask) == 0 && inside(&p->bounds, &cache->bounds)) return TAHR_OK;
    gather_now(world, context, p);
    return TAHR_OK;
}

/* One primitive out of the cache. */
static void load(const tahr__query *query, const arrays *a, uint32_t n, tahr__prim *prim)
{
    const tahr__body *body = &query->world->bodies[a->body[n]];
    prim->body = a->body[n];
    prim->item = a->item[n] & ~TAHR__ITEM_WIDE;
    prim->radius = body->radius;
    if (a->item[n] & TAHR__ITEM_WIDE) {
        tahr__map map = tahr__map_make(&query->frame, body);
        if (prim->item & TAHR__ITEM_ROUND) tahr__prim_round(&map, body, prim->body, prim);
        else if (prim->item & TAHR__ITEM_SOLID) tahr__prim_solid(&map, prim->body, prim);
        else tahr__map_triangle(&map, body, prim->item, prim->v);
        return;
    }
    for (uint32_t i = 0; i < 3; i++) {
        if (query->world->round) {
            const float *c = (const float *)a->corners + 9 * (size_t)n + 3 * i;
            prim->v[i] = v_make((double)c[0], (double)c[1], (double)c[2]);
        } else {
            const double *c = (const double *)a->corners + 9 * (size_t)n + 3 * i;
            prim->v[i] = v_make(c[0], c[1], c[2]);
        }
    }
}

static int concerns(const tahr__query *query, uint32_t id)
{
    const tahr__body *body = &query->world->bodies[id];
    if (!(body->mask & query->mask) || id == query->ignore_body) return 0;
    return query->sensors || !(body->flags & TAHR_BODY_SENSOR);
}

static void set_box(const tahr__search *s, tahr__lanes_query *q)
{
    for (int i = 0; i < 3; i++) {
        q->lo[i] = d_down(v_get(s->box.min, i));
        q->hi[i] = d_up(v_get(s->box.max, i));
    }
}

static void lanes_query(const tahr__search *s, tahr__lanes_query *q)
{
    const tahr__query *query = s->query;
    /* d_up alone covers the rounding of the lanes' differences only down to 1e-7 of the reach; the slack covers zero. */
    q->limit = d_up((s->reach + 1e-6) * (s->reach + 1e-6) * (1 + 1e-5));
    set_box(s, q);
    for (int i = 0; i < 3; i++) {
        q->start[i] = (float)v_get(query->start, i);
        q->motion[i] = (float)v_get(query->motion, i);
    }
    q->half = query->core.axis_count == 1 ? (float)query->core.axis[0].z : 0;
    /* Boxes are not upright segments: their planes are looked at in double. */
    q->reach = query->core.axis_count < 2 ? (float)(s->reach + PLANE_SLACK) : 1e30f;
}

/* Begins with the box that is nearest to the core at its start: most often it holds the hit, which then rules out what
 * lies beyond. Any order gives the same answer. */
static void first_the_nearest(const tahr__lanes *lanes, const tahr__query *query, uint16_t *index, uint32_t count)
{
    tahr_bounds box = tahr__query_box(query, 0);
    float lo[3] = {(float)box.min.x, (float)box.min.y, (float)box.min.z};
    float hi[3] = {(float)box.max.x, (float)box.max.y, (float)box.max.z};
    uint32_t nearest = 0;
    float least = 0;
    for (uint32_t i = 0; i < count; i++) {
        float distance = tahr__lanes_distance(lanes, index[i], lo, hi);
        if (i > 0 && distance >= least) continue;
        least = distance;
        nearest = i;
    }
    uint16_t first = index[nearest];
    index[nearest] = index[0];
    index[0] = first;
}

static void search_cache(tahr__search *s)
{
    const tahr__query *query = s->query;
    const tahr__native *world = query->world;
    tahr__cache *cache = cache_of(query);
    arrays a = arrays_of(world, cache);
    tahr__lanes lanes = {{a.bound[0], a.bound[1], a.bound[2]},
                         {a.bound[3], a.bound[4], a.bound[5]},
                         {a.plane[0], a.plane[1], a.plane[2]},
                         a.plane[3],
                         cache->count};
    uint16_t index[4096];
    tahr__lanes_query q;
    lanes_query(s, &q);
    uint32_t count = (world->no_simd ? tahr__lanes_cull_scalar : tahr__lanes_cull)(&lanes, &q, index);
    if (count > 1) first_the_nearest(&lanes, query, index, count);
    int narrowed = 0;
    tahr__prim prim;
    for (uint32_t i = 0; i < count; i++) {
        if (!concerns(query, a.body[index[i]])) continue;
        if (narrowed && !(tahr__lanes_distance(&lanes, index[i], q.lo, q.hi) <= q.limit)) continue;
        load(query, &a, index[i], &prim);
        s->narrowed = 0;
        s->visit(s, &prim);
        if (!s->narrowed) continue;
        narrowed = 1;
        set_box(s, &q);
    }
}

void tahr__search_run(tahr__search *s)
{
    const tahr__query *query = s->query;
    const tahr__native *world = query->world;
    const tahr__cache *cache = cache_of(query);
    int held = 0;
    if (cache && !world->no_cache && cache->gathered && !cache->overflow && (query->mask & ~cache->mask) == 0) {
        tahr_bounds box = tahr__frame_box_to_world(&query->frame, &s->box, s->reach + 10 * TAHR__SLACK);
        held = inside(&box, &cache->bounds);
        if (!held) query->context->escapes++;
    }
    if (held) search_cache(s);
    else tahr__tree_search(s, &world->fixed);
    tahr__tree_search(s, &world->movable);
}

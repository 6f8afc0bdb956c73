/* SPDX-License-Identifier: MIT
 * gather.c: one character's cache of nearby static primitives, and the search that uses it where it holds
 * everything. */
#include "form.h"

#include <string.h>

/* m, around a part of what was too much: more than the reach and the slack of a query. */
#define LEAST_MARGIN 1e-3

static uint32_t buckets_of(const tahr__native *world)
{
    uint32_t size = 16;
    while (size < 3 * world->capacity)
        size += size;
    return size;
}

static size_t corners_bytes(const tahr__native *world)
{
    size_t exact = 3 * (size_t)world->capacity * sizeof(tahr_vec3), next = 3 * (size_t)world->capacity * 4;
    return world->gather ? exact + next + (size_t)buckets_of(world) * 4 : 0;
}

size_t tahr__cache_bytes(const tahr__native *world)
{
    const size_t each = (2 + TAHR__LANE_ROWS) * sizeof(float) + sizeof(tahr__prim);
    return TAHR__HEADER + (world->no_cache ? 0 : world->capacity * each + corners_bytes(world));
}

tahr__corners tahr__cache_corners(const tahr__native *world, tahr__cache *cache)
{
    tahr__corners c;
    c.buckets = buckets_of(world);
    c.exact = (tahr_vec3 *)(void *)(tahr__cache_prims(world, cache) + world->capacity);
    c.next = (uint32_t *)(void *)(c.exact + 3 * (size_t)world->capacity);
    c.first = c.next + 3 * (size_t)world->capacity;
    return c;
}

uint32_t tahr__corner_bucket(const tahr__corners *corners, tahr_vec3 corner)
{
    uint64_t bits[3], h = 0;
    memcpy(bits, &corner, sizeof bits);
    for (int i = 0; i < 3; i++)
        h = (h ^ bits[i]) * 0x9e3779b97f4a7c15ULL;
    return (uint32_t)(h >> 32) & (corners->buckets - 1);
}

typedef struct gather {
    tahr__search search;
    float *blocks;
    tahr__prim *prims;
    tahr__cache *cache;
} gather;

/* Nothing more to find: what does not fit is never kept in part. */
static void give_up(gather *g)
{
    g->cache->overflow = 1;
    g->search.box.min = v_make(1e30, 1e30, 1e30);
    g->search.box.max = g->search.box.min;
    g->search.narrowed = 1;
}

/* Triangles of a mesh: their names, to be formed together. */
static void take(tahr__search *search, uint32_t body, const uint32_t *items, uint32_t count)
{
    gather *g = (gather *)search;
    const tahr__native *world = search->query->world;
    uint32_t n = g->cache->count;
    if (count == 0) return;
    if (count > world->capacity - n) {
        give_up(g);
        return;
    }
    tahr__form_heads(&world->bodies[body], body, items, count, &g->prims[n]);
    g->cache->plain &= !(g->prims[n].kind & TAHR__SENSOR);
    g->cache->count = n + count;
}

static void store(tahr__search *search, const tahr__prim *prim)
{
    gather *g = (gather *)search;
    uint32_t n = g->cache->count;
    if (n == search->query->world->capacity) {
        give_up(g);
        return;
    }
    const tahr_bounds box = tahr__prim_bounds(search->query, prim);
    tahr__lanes_put(g->blocks, n, &box, prim->kind & TAHR__PLANELESS ? NULL : &prim->facet);
    g->prims[n] = *prim;
    g->cache->plain &= !(prim->kind & TAHR__SENSOR);
    g->cache->count = n + 1;
}

/* Has a triangle been handed over before? */
static int is_known(const tahr__corners *c, const tahr__prim *prims, const tahr__loose *loose)
{
    const tahr_vec3 *v = loose->corner;
    uint32_t i = c->first[tahr__corner_bucket(c, v[0])];
    for (; i != TAHR__NONE; i = c->next[i]) {
        const tahr__prim *p = &prims[i / 3];
        int same = p->body == loose->prim.body && p->feature == loose->prim.feature && i % 3 == 0;
        if (same && memcmp(c->exact + i, v, 3 * sizeof *v) == 0) return 1;
    }
    return 0;
}

/* The same of a triangle of the user's, with its corners and where they are found. */
static void store_loose(tahr__search *search, const tahr__loose *loose)
{
    gather *g = (gather *)search;
    const tahr__native *world = search->query->world;
    uint32_t n = g->cache->count;
    tahr__corners c = tahr__cache_corners(world, g->cache);
    if (is_known(&c, g->prims, loose)) return;
    store(search, &loose->prim);
    if (g->cache->overflow) return;
    g->prims[n].item = TAHR__ITEM_LOOSE | n;
    g->prims[n].kind &= ~(uint32_t)TAHR__FRESH;
    for (uint32_t i = 3 * n; i < 3 * n + 3; i++) {
        c.exact[i] = loose->corner[i % 3];
        uint32_t *first = &c.first[tahr__corner_bucket(&c, c.exact[i])];
        c.next[i] = *first;
        *first = i;
    }
}

static void gather_loose(const tahr__native *world, gather *g)
{
    tahr__corners c = tahr__cache_corners(world, g->cache);
    memset(c.first, 0xff, c.buckets * sizeof c.first[0]);
    /* What goes wrong here the query that needs it says. */
    if (!g->cache->overflow && !tahr__source_fill(&g->search, store_loose)) g->cache->overflow = 1;
}

/* Without branches: which side is out is different every time. */
static int inside(const tahr_bounds *a, const tahr_bounds *b)
{
    int low = (a->min.x >= b->min.x) & (a->min.y >= b->min.y) & (a->min.z >= b->min.z);
    return low & (a->max.x <= b->max.x) & (a->max.y <= b->max.y) & (a->max.z <= b->max.z);
}

static double volume(const tahr_bounds *b)
{
    const tahr_vec3 side = v_sub(b->max, b->min);
    return side.x * side.y * side.z;
}

static void gather_now(tahr__native *world, tahr_query_context *context, const tahr_prepare *p)
{
    tahr__cache *cache = context->cache;
    tahr__query query;
    gather g;
    tahr_status failed = TAHR_OK;
    memset(&query, 0, sizeof query);
    query.failed = &failed;
    query.world = world;
    query.context = context;
    query.frame = &cache->frame;
    query.mask = p->mask;
    query.ignore_body = TAHR_NO_BODY;
    query.sensors = TAHR__SENSORS_TOO;
    query.start = tahr__frame_box_to_local(&cache->frame, &(tahr_bounds){p->position, p->position}).min;
    double margin;
    int again = cache->gathered && cache->overflow, fits;
    fits = tahr__margin_choose(&query, &p->bounds, &cache->counted, &margin);
    if (!fits && again) { /* for what is asked right here: it is looked at many times */
        margin = LEAST_MARGIN;
        fits = 1;
    }
    tahr_vec3 m = v_make(margin, margin, margin);
    cache->bounds.min = v_sub(p->bounds.min, m);
    cache->bounds.max = v_add(p->bounds.max, m);
    cache->local = tahr__frame_box_to_local(&cache->frame, &cache->bounds);
    cache->volume = volume(&p->bounds);
    cache->mask = p->mask;
    cache->gathered = 1;
    cache->overflow = cache->count = 0;
    cache->plain = 1;
    cache->recent[0] = cache->recent[1] = TAHR__CACHE_MOST;
    g.search.query = &query;
    g.search.box = cache->local;
    g.search.reach = 0;
    g.search.narrowed = 0;
    g.search.order = TAHR__IN_BULK;
    g.search.visit = store;
    g.search.take = take;
    g.blocks = tahr__cache_blocks(world, cache);
    g.prims = tahr__cache_prims(world, cache);
    g.cache = cache;
    if (fits)
        tahr__tree_search(&g.search, &world->fixed);
    else
        cache->overflow = 1;
    if (world->gather) gather_loose(world, &g);
    cache->revision = world->revision;
    if (!cache->overflow) tahr__form_lanes(world, &cache->frame, g.prims, g.blocks, cache->count);
    tahr__lanes_end(g.blocks, cache->count);
    tahr__vicinity_forget(world, cache);
    context->gathers++;
}

tahr_status tahr__cache_prepare(tahr__native *world, tahr_query_context *context, const tahr_prepare *p)
{
    tahr__cache *cache = context ? context->cache : NULL;
    if (!cache) return TAHR_OK;
    int keep = cache->announced && tahr__frame_holds(&cache->frame, p->position, p->up);
    if (!keep) {
        cache->frame = tahr__frame_make(p->position, p->up);
        cache->vicinity.floor.length = cache->vicinity.floor.normal.z = 0; /* it was of that frame */
    }
    cache->announced = 1;
    if (world->no_cache) return TAHR_OK;
    keep = keep && cache->gathered && cache->revision == world->revision;
    keep = keep && (p->mask & ~cache->mask) == 0 && inside(&p->bounds, &cache->bounds);
    /* What was too much is gathered again where a part of it is announced by itself, a quarter or less. */
    if (keep && !(cache->overflow && volume(&p->bounds) <= 0.25 * cache->volume)) return TAHR_OK;
    gather_now(world, context, p);
    return TAHR_OK;
}

static void lanes_query(const tahr__search *s, tahr__lanes_query *q)
{
    const tahr__query *query = s->query;
    /* d_up alone covers the rounding of the lanes' differences only down to 1e-7 of the reach; the slack covers
     * zero. */
    q->limit = d_up((s->reach + 1e-6) * (s->reach + 1e-6) * (1 + 1e-5));
    q->lo[0] = d_down(s->box.min.x);
    q->lo[1] = d_down(s->box.min.y);
    q->lo[2] = d_down(s->box.min.z);
    q->hi[0] = d_up(s->box.max.x);
    q->hi[1] = d_up(s->box.max.y);
    q->hi[2] = d_up(s->box.max.z);
    q->start[0] = (float)query->start.x;
    q->start[1] = (float)query->start.y;
    q->start[2] = (float)query->start.z;
    q->motion[0] = (float)query->motion.x;
    q->motion[1] = (float)query->motion.y;
    q->motion[2] = (float)query->motion.z;
    q->half = (float)query->half;
    q->lowest = d_down(s->box.min.z);
    /* Boxes are not upright segments: their planes are looked at in double. */
    q->reach = query->core.axis_count < 2 ? (float)(s->reach + TAHR__LANE_SLACK + 1e-6 * query->motion_length) : 1e30f;
}

static int concerns(const tahr__query *query, const tahr__prim *prim)
{
    if (!(prim->mask & query->mask) || prim->body == query->ignore_body) return 0;
    return query->sensors != (prim->kind & TAHR__SENSOR ? TAHR__SENSORS_NONE : TAHR__SENSORS_ONLY);
}

/* What is near enough to be asked is formed in full. */
static void form_found(const tahr__query *query, tahr__prim *all, const tahr__lanes_found *found, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tahr__prim *prim = &all[found[i].index];
        if (prim->kind & TAHR__UNFORMED) tahr__form_rest(query->world, query->frame, prim);
    }
}

uint32_t tahr__cache_cull(const tahr__search *s, const tahr__prim **prims, tahr__lanes_found *found)
{
    const tahr__query *query = s->query;
    tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    tahr__prim *all = tahr__cache_prims(query->world, query->cache);
    *prims = all;
    tahr__lanes_query q;
    lanes_query(s, &q);
    uint32_t count = query->world->lanes->cull(&lanes, &q, found), kept = 0;
    if (query->cache->plain && query->mask == query->cache->mask && query->ignore_body == TAHR_NO_BODY &&
        query->sensors != TAHR__SENSORS_ONLY) {
        form_found(query, all, found, count);
        return count;
    }
    for (uint32_t i = 0; i < count; i++) {
        found[kept] = found[i];
        kept += (uint32_t)concerns(query, &all[found[i].index]);
    }
    form_found(query, all, found, kept);
    return kept;
}

int tahr__cache_spans(const tahr__cache *cache, const tahr_bounds *box, double reach)
{
    const double more = reach + 10 * TAHR__SLACK;
    const tahr_vec3 grow = v_make(more, more, more);
    const tahr_bounds grown = {v_sub(box->min, grow), v_add(box->max, grow)};
    return inside(&grown, &cache->local);
}

int tahr__cache_holds(const tahr__search *s)
{
    const tahr__query *query = s->query;
    const tahr__cache *cache = query->cache;
    if (!cache || !cache->gathered || cache->overflow || (query->mask & ~cache->mask)) return 0;
    if (cache->revision != query->world->revision) return 0;
    if (tahr__cache_spans(cache, &s->box, s->reach)) return 1;
    query->context->escapes++;
    return 0;
}

void tahr__search_fixed(tahr__search *s)
{
    const tahr__native *world = s->query->world;
    tahr__tree_search(s, &world->fixed);
    if (world->gather) tahr__source_search(s);
}

void tahr__search_run(tahr__search *s)
{
    const tahr__native *world = s->query->world;
    if (tahr__cache_holds(s)) {
        const tahr__prim *prims;
        tahr__lanes_found found[TAHR__CACHE_MOST];
        uint32_t count = tahr__cache_cull(s, &prims, found);
        for (uint32_t i = 0; i < count; i++)
            s->visit(s, &prims[found[i].index]);
    } else {
        tahr__search_fixed(s);
    }
    if (world->movable.count) tahr__tree_search(s, &world->movable);
}

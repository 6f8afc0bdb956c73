/* SPDX-License-Identifier: MIT
 * gather.c: one character's cache of nearby static primitives, and the search that uses it where it holds
 * everything.
 *
 * What a query meets is within its reach of its box. All that overlaps the gathered box was gathered, so where that box
 * spans the other and its reach nothing is missing; each query looks whether it does, whatever was announced, and else
 * asks the trees. What is too much decides nothing, for each primitive is decided alone and ties go by names; and what
 * is kept is what would be gathered again: it holds for one revision of the world and one frame, which alone decide its
 * bits (no_cache). */
#include "form.h"
#include "level.h"

#include <string.h>

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
    tahr_bounds announced;
    tahr_vec3 heading;
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
    g->search.room = world->capacity - n - count;
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

static double volume(const tahr_bounds *b)
{
    const tahr_vec3 side = v_sub(b->max, b->min);
    return side.x * side.y * side.z;
}

/* How much farther a gather goes the way the character is going, and less far behind it, as a part of the margin: the
 * same volume lasts for a third more steps of wanderers (measured over 0, 0.5, 0.75 and 1; with 1 nothing is left for
 * who turns around). */
#define AHEAD 0.75

static void set_bounds(tahr__cache *cache, const tahr_bounds *announced, double margin, tahr_vec3 heading)
{
    const tahr_vec3 m = {margin, margin, margin}, shift = v_scale(heading, AHEAD * margin);
    cache->bounds.min = v_add(v_sub(announced->min, m), shift);
    cache->bounds.max = v_add(v_add(announced->max, m), shift);
    cache->local = tahr__frame_box_to_local(&cache->frame, &cache->bounds);
}

/* Who has come so far (m) since the last gather goes on that way; from farther off nobody walked. */
#define LEAST_WAY 0.05
#define MOST_WAY 8.0

/* The way a character is going, a unit vector; zero: it is not known, or the margin is the user's. */
static tahr_vec3 heading_of(const tahr__native *world, const tahr__cache *cache, tahr_vec3 position)
{
    tahr_vec3 way = v_sub(position, cache->place);
    double length = v_length(way);
    int known = cache->gathered && !world->fixed_margin && length > LEAST_WAY && length < MOST_WAY;
    return known ? v_scale(way, 1 / length) : v_make(0, 0, 0);
}

/* Collects all that is within a margin. */
static void collect(gather *g)
{
    tahr__cache *cache = g->cache;
    const tahr__native *world = g->search.query->world;
    set_bounds(cache, &g->announced, cache->margin, g->heading);
    cache->overflow = cache->count = 0;
    cache->plain = 1;
    g->search.box = cache->local;
    g->search.narrowed = 0;
    g->search.room = world->capacity;
    tahr__tree_search(&g->search, &world->fixed);
}

/* m, around a part of what was too much: more than the reach and the slack of a query. */
#define LEAST_MARGIN 1e-3

/* Collects within the margin that was best last time, or less; again: a part of what was too much. */
static void collect_best(gather *g, int again)
{
    tahr__cache *cache = g->cache;
    const tahr__native *world = g->search.query->world;
    const tahr_bounds *announced = &g->announced;
    double width = announced->max.x - announced->min.x;
    const double most = tahr__margin_most(world, width);
    if (cache->margin <= 0 || cache->margin > most) cache->margin = most;
    if (again && !world->fixed_margin) { /* what is asked right here is looked at many times */
        cache->margin = LEAST_MARGIN;
        collect(g);
        cache->margin = most;
        if (!cache->overflow) return;
    } else {
        do {
            collect(g);
        } while (tahr__margin_choose(world, width, cache->overflow ? TAHR__NONE : cache->count, &cache->margin));
    }
    /* A little farther on it will not fit either. */
    if (cache->overflow && !world->fixed_margin) set_bounds(cache, announced, 0.5 * most, v_make(0, 0, 0));
}

/* Which primitives stopped the last motions, by their names: they have another index afterwards. */
typedef struct stoppers {
    uint32_t body[TAHR__KINDS], item[TAHR__KINDS], kind[TAHR__KINDS], count;
} stoppers;

static stoppers stoppers_of(tahr__cache *cache, const tahr__prim *prims)
{
    stoppers s = {.count = 0};
    for (uint32_t k = 0; k < TAHR__KINDS && cache->gathered; k++) {
        const uint32_t recent = *tahr__cache_recent(cache, k);
        const tahr__prim *p = &prims[recent];
        if (recent >= cache->count || (p->item & TAHR__ITEM_LOOSE)) continue;
        s.body[s.count] = p->body;
        s.item[s.count] = p->item;
        s.kind[s.count++] = k;
    }
    return s;
}

/* Finds them again. What had stopped the last foot is where a place on the floor begins, which asks no more than that
 * it has been formed. */
static void find_stoppers(const gather *g, const stoppers *s)
{
    tahr__cache *cache = g->cache;
    for (uint32_t k = 0; k < TAHR__KINDS; k++)
        *tahr__cache_recent(cache, k) = TAHR__CACHE_MOST;
    for (uint32_t i = 0; i < cache->count && s->count > 0; i++) {
        const tahr__prim *p = &g->prims[i];
        for (uint32_t k = 0; k < s->count; k++) {
            if (p->item == s->item[k] && p->body == s->body[k]) *tahr__cache_recent(cache, s->kind[k]) = i;
        }
    }
    if (cache->recent[TAHR__OF_FOOT] >= cache->count) return;
    tahr__prim *foot = &g->prims[cache->recent[TAHR__OF_FOOT]];
    if (foot->kind & TAHR__UNFORMED) tahr__form_rest(g->search.query->world, &cache->frame, foot);
}

static void gather_now(tahr__native *world, tahr_query_context *context, const tahr_prepare *p)
{
    tahr__cache *cache = context->cache;
    tahr__query query;
    gather g = {.blocks = tahr__cache_blocks(world, cache), .prims = tahr__cache_prims(world, cache), .cache = cache};
    tahr_status failed = TAHR_OK;
    tahr__query_begin(&query, world, context, p->position, cache->frame.up);
    query.cache = NULL;
    query.failed = &failed;
    query.mask = p->mask;
    query.ignore_body = TAHR_NO_BODY;
    query.sensors = TAHR__SENSORS_TOO;
    cache->volume = volume(&p->bounds);
    g.announced = p->bounds;
    g.heading = heading_of(world, cache, p->position);
    cache->place = p->position;
    cache->mask = p->mask;
    const stoppers last = stoppers_of(cache, g.prims);
    g.search.query = &query;
    g.search.order = TAHR__IN_BULK;
    g.search.visit = store;
    g.search.take = take;
    const int again = cache->gathered && cache->overflow;
    cache->gathered = 1;
    collect_best(&g, again);
    if (world->gather) gather_loose(world, &g);
    cache->revision = world->revision;
    if (!cache->overflow) tahr__form_lanes(world, &cache->frame, g.prims, g.blocks, cache->count);
    tahr__lanes_end(g.blocks, cache->count);
    if (cache->overflow) cache->count = 0;
    find_stoppers(&g, &last);
    tahr__vicinity_forget(world, cache);
    cache->level = TAHR_NO_BODY;
    if (cache->overflow && !world->gather && !world->no_vicinity) {
        query.cache = cache;
        tahr__level_learn(&query);
    }
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
        cache->asked.count = 0;                                            /* so were they */
    }
    cache->announced = 1;
    if (world->no_cache) return TAHR_OK;
    keep = keep && cache->gathered && cache->revision == world->revision;
    keep = keep && (p->mask & ~cache->mask) == 0 && box_inside(&p->bounds, &cache->bounds);
    /* What was too much is gathered again where a part of it is announced by itself, a quarter or less. */
    if (keep && !(cache->overflow && volume(&p->bounds) <= 0.25 * cache->volume)) return TAHR_OK;
    gather_now(world, context, p);
    return TAHR_OK;
}

static void lanes_begin(const tahr__search *s, tahr_vec3 start, tahr_vec3 motion, tahr__lanes_query *q)
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
    q->start[0] = (float)start.x;
    q->start[1] = (float)start.y;
    q->start[2] = (float)start.z;
    q->motion[0] = (float)motion.x;
    q->motion[1] = (float)motion.y;
    q->motion[2] = (float)motion.z;
    q->half = (float)query->half;
    q->lowest = d_down(s->box.min.z);
    /* Boxes are not upright segments: their planes are looked at in double. */
    q->reach = query->core.axis_count < 2 ? (float)(s->reach + TAHR__LANE_SLACK + 1e-6 * query->motion_length) : 1e30f;
}

/* Do all that have been gathered concern a query? */
static int is_plain(const tahr__query *query)
{
    const tahr__cache *cache = query->cache;
    return cache->plain && query->mask == cache->mask && query->ignore_body == TAHR_NO_BODY &&
           query->sensors != TAHR__SENSORS_ONLY;
}

static int concerns(const tahr__query *query, const tahr__prim *prim)
{
    if (!(prim->mask & query->mask) || prim->body == query->ignore_body) return 0;
    return query->sensors != (prim->kind & TAHR__SENSOR ? TAHR__SENSORS_NONE : TAHR__SENSORS_ONLY);
}

int tahr__cache_concerns(const tahr__query *query, uint32_t index)
{
    return is_plain(query) || concerns(query, &tahr__cache_prims(query->world, query->cache)[index]);
}

/* What is near enough to be asked is formed in full. */
static void form_found(const tahr__query *query, const tahr__lanes_found *found, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        tahr__formed(query, found[i].index);
}

uint32_t tahr__cache_guess(const tahr__search *s)
{
    const tahr__query *query = s->query;
    const tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    tahr__lanes_found found[TAHR__CACHE_MOST];
    tahr__lanes_query q;
    lanes_begin(s, query->start, query->motion, &q);
    const uint32_t count = query->world->lanes->cull(&lanes, &q, found);
    uint32_t first = 0;
    for (uint32_t i = 1; i < count; i++)
        first = found[i].time < found[first].time ? i : first;
    return count > 0 ? found[first].index : TAHR__NONE;
}

/* Seen from where the motion ends, or is known to end: what it only just comes near is farther off from there than it
 * looked from the begin. */
uint32_t tahr__cache_cull(const tahr__search *s, double until, const tahr__prim **prims, tahr__lanes_found *found)
{
    const tahr__query *query = s->query;
    tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    tahr__prim *all = tahr__cache_prims(query->world, query->cache);
    *prims = all;
    tahr__lanes_query q;
    const tahr_vec3 back = v_scale(query->motion, -until);
    lanes_begin(s, v_sub(query->start, back), back, &q);
    uint32_t count = query->world->lanes->cull(&lanes, &q, found), kept = 0;
    if (is_plain(query)) {
        form_found(query, found, count);
        return count;
    }
    for (uint32_t i = 0; i < count; i++) {
        found[kept] = found[i];
        kept += (uint32_t)concerns(query, &all[found[i].index]);
    }
    form_found(query, found, kept);
    return kept;
}

int tahr__cache_holds(const tahr__search *s)
{
    const tahr__query *query = s->query;
    const tahr__cache *cache = query->cache;
    if (!cache || !cache->gathered || cache->overflow || (query->mask & ~cache->mask)) return 0;
    if (cache->revision != query->world->revision) return 0;
    if (tahr__cache_spans(cache, &s->box, s->reach)) {
        query->context->cached++;
        return 1;
    }
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
        uint32_t count = tahr__cache_cull(s, 1, &prims, found);
        for (uint32_t i = 0; i < count; i++)
            s->visit(s, &prims[found[i].index]);
    } else {
        tahr__search_fixed(s);
    }
    if (world->movable.count) tahr__tree_search(s, &world->movable);
}

/* SPDX-License-Identifier: MIT
 * source.c: the user's own triangles (tahr_native_desc.gather). Nothing of them is kept but in the caches of
 * characters: a search that no cache answers asks for the cells around it, and what is asked about an edge or corner is
 * answered by all triangles there, wherever they came from. So an answer does not depend on what was gathered. */
#include "../common/options.h"
#include "scene.h"

#include <stdio.h>
#include <string.h>

/* Boxes that are asked for are whole cells of this side (m). */
#define CELL 4.0
/* A corner on the border of a cell belongs to both, whatever a user's own cull makes of touching (m). */
#define BORDER 0.01
#define COORDINATE_LIMIT 1e7

/* Triangles that are decided at once: while the user hands them over nothing may be asked that needs others. */
enum { BATCH = 48 };

typedef struct stream {
    tahr_gather out;
    const tahr__query *query;
    const char *bad; /* what is wrong with triangle bad_at */
    uint32_t bad_at;
    uint32_t seen; /* triangles handed over so far */
    uint32_t enough, reserved;
    void (*take)(struct stream *stream, const tahr__loose *loose);
    int (*wants)(const struct stream *stream, const tahr_triangle *t);
    tahr_bounds box;   /* world: what is wanted now */
    tahr_bounds cells; /* what is asked for: the same while batches go on */
} stream;

static const char *bad_triangle(const tahr__native *world, const tahr_triangle *t)
{
    for (int i = 0; i < 3; i++) {
        tahr_vec3 a = v_abs(t->corners[i]);
        if (!((a.x <= COORDINATE_LIMIT) & (a.y <= COORDINATE_LIMIT) & (a.z <= COORDINATE_LIMIT)))
            return "corners: not finite within 1e7 m";
    }
    if (t->body < world->body_count || t->body == TAHR_NO_BODY) return "body: is a described one, or none";
    if (t->flags & ~(uint32_t)(TAHR_BODY_TWO_SIDED | TAHR_BODY_ONE_WAY))
        return "flags: only TAHR_BODY_TWO_SIDED and _ONE_WAY are known";
    if (t->walkable_rule > TAHR_WALKABLE_NEVER) return "walkable_rule: unknown";
    return fabs(t->walkable_angle) <= 1e9 ? NULL : "walkable_angle: not finite";
}

int tahr__loose_make(const tahr__frame *frame, const tahr_triangle *t, tahr__loose *out)
{
    tahr__prim *p = &out->prim;
    tahr_vec3 *v = out->corner;
    for (int i = 0; i < 3; i++)
        v[i] = v_add(t->corners[i], v_make(0, 0, 0)); /* no minus zero, as in a mesh */
    double slim = tahr__slimness(v[0], v[1], v[2]);
    if (!(slim > TAHR__NO_AREA)) return 0;
    tahr__map map = tahr__map_fixed(frame);
    for (int i = 0; i < 3; i++)
        p->facet.v[i] = tahr__map_point(&map, v[i]);
    tahr__facet_finish(&p->facet);
    tahr_vec3 n = tahr__heights_normal(v);
    p->face = map.turned ? m_apply(&map.turn, n) : n;
    p->item = TAHR__ITEM_LOOSE;
    p->kind = TAHR__GATHERED | TAHR__FRESH | (slim < TAHR__THIN ? TAHR__PLANELESS : 0u) |
              (t->flags & TAHR_BODY_TWO_SIDED ? TAHR__TWO_SIDED : 0u) |
              (t->flags & TAHR_BODY_ONE_WAY ? TAHR__ONE_WAY : 0u);
    p->radius = 0;
    p->body = t->body;
    p->feature = t->feature;
    p->mask = t->mask ? t->mask : 0xFFFFFFFFu;
    p->surface = t->surface;
    p->walkable_rule = t->walkable_rule;
    p->walkable_angle = t->walkable_angle;
    memset(p->reserved, 0, sizeof p->reserved);
    return 1;
}

static int32_t add(tahr_gather *out, const tahr_triangle *t)
{
    stream *s = (stream *)out;
    tahr__loose loose;
    uint32_t index = s->seen++;
    if (s->bad) return 0;
    s->bad_at = index;
    s->bad = t ? bad_triangle(s->query->world, t) : "is NULL";
    if (s->bad || !s->wants(s, t)) return !s->bad && !s->enough;
    if (tahr__loose_make(s->query->frame, t, &loose)) s->take(s, &loose);
    return !s->enough;
}

static int touches(const tahr_bounds *box, const tahr_vec3 v[3])
{
    tahr_vec3 low = v_min(v[0], v_min(v[1], v[2])), high = v_max(v[0], v_max(v[1], v[2]));
    int below = (low.x <= box->max.x) & (low.y <= box->max.y) & (low.z <= box->max.z);
    return below & (high.x >= box->min.x) & (high.y >= box->min.y) & (high.z >= box->min.z);
}

static tahr_vec3 cells_down(tahr_vec3 v)
{
    return v_make(floor(v.x / CELL) * CELL, floor(v.y / CELL) * CELL, floor(v.z / CELL) * CELL);
}

static void set_box(stream *s, const tahr_bounds *box)
{
    s->box = *box;
    s->cells.min = cells_down(box->min);
    s->cells.max = v_scale(cells_down(v_scale(box->max, -1)), -1);
}

/* Asks the user for s->cells. 0: something was wrong, and the log has been told. */
static int run(stream *s)
{
    const tahr__query *query = s->query;
    const tahr__native *world = query->world;
    char text[160];
    s->out.add = add;
    s->seen = s->enough = s->bad_at = s->reserved = 0;
    s->bad = NULL;
    if (*query->failed < 0) return 0;
    tahr_status status = world->gather(world->gather_user, &s->cells, query->mask, &s->out);
    if (status >= 0 && !s->bad) return 1;
    if (s->bad)
        snprintf(text, sizeof text, "gather: triangle %u: %s", (unsigned)s->bad_at, s->bad);
    else
        snprintf(text, sizeof text, "gather: status %d", (int)status);
    tahr__log_error(world->host, text);
    *query->failed = TAHR_E_BACKEND;
    return 0;
}

/* Searches: a batch is filled, then visited. What did not fit is handed over again: the order is the same. */
typedef struct batch {
    stream stream;
    tahr__search *search;
    uint32_t from, next; /* the first triangle that is wanted now; that did not fit */
    uint32_t count, reserved;
    tahr__loose loose[BATCH];
} batch;

static int in_reach(const stream *s, const tahr_triangle *t)
{
    uint32_t mask = t->mask ? t->mask : 0xFFFFFFFFu;
    if (!(mask & s->query->mask) || t->body == s->query->ignore_body) return 0;
    return touches(&s->box, t->corners);
}

static int wants_in_batch(const stream *s, const tahr_triangle *t)
{
    const batch *b = (const batch *)s;
    return s->seen > b->from && !s->enough && in_reach(s, t);
}

static void put_in_batch(stream *s, const tahr__loose *loose)
{
    batch *b = (batch *)s;
    if (b->count == BATCH) {
        b->next = s->seen - 1;
        s->enough = 1;
        return;
    }
    b->loose[b->count++] = *loose;
}

static tahr_bounds world_box(const tahr__search *search)
{
    return tahr__frame_box_to_world(search->query->frame, &search->box, search->reach + 10 * TAHR__SLACK);
}

void tahr__source_search(tahr__search *search)
{
    batch b;
    const tahr__query *query = search->query;
    if (query->sensors == TAHR__SENSORS_ONLY) return;
    b.search = search;
    b.stream.query = query;
    b.stream.wants = wants_in_batch;
    b.stream.take = put_in_batch;
    b.next = b.reserved = 0;
    tahr_bounds box = world_box(search);
    set_box(&b.stream, &box);
    do {
        b.from = b.next;
        b.count = 0;
        if (!run(&b.stream)) return;
        for (uint32_t i = 0; i < b.count; i++)
            search->visit(search, &b.loose[i].prim);
        b.stream.box = world_box(search);
    } while (b.stream.enough);
}

typedef struct filling {
    stream stream;
    tahr__search *search;
    void (*take)(tahr__search *search, const tahr__loose *loose);
} filling;

static void put_in_cache(stream *s, const tahr__loose *loose)
{
    filling *f = (filling *)s;
    f->take(f->search, loose);
    s->enough = f->search->narrowed; /* it is full */
}

static int wants_in_cache(const stream *s, const tahr_triangle *t)
{
    return !s->enough && in_reach(s, t);
}

int tahr__source_fill(tahr__search *search, void (*take)(tahr__search *search, const tahr__loose *loose))
{
    filling f;
    f.stream.query = search->query;
    f.stream.wants = wants_in_cache;
    f.stream.take = put_in_cache;
    tahr_bounds box = world_box(search);
    set_box(&f.stream, &box);
    f.search = search;
    f.take = take;
    return run(&f.stream);
}

/* All triangles at one corner. */
typedef struct ring {
    stream stream;
    const tahr__prim *prim;
    const tahr_vec3 *own; /* its corners */
    tahr_vec3 corner;
    tahr__near *near;
    uint32_t count, most;
} ring;

static int equal(tahr_vec3 a, tahr_vec3 b)
{
    return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}

/* The same corners in the same order round. */
static int is_twin(const tahr_vec3 a[3], const tahr_vec3 b[3])
{
    for (int i = 0; i < 3; i++) {
        if (equal(a[0], b[i])) return equal(a[1], b[(i + 1) % 3]) && equal(a[2], b[(i + 2) % 3]);
    }
    return 0;
}

static int is_at_corner(const ring *r, const tahr_vec3 v[3])
{
    return (equal(v[0], r->corner) | equal(v[1], r->corner) | equal(v[2], r->corner)) && !is_twin(r->own, v);
}

/* Of too many the one with the highest feature goes. */
static void keep_near(ring *r, const tahr__prim *prim, const tahr_vec3 corner[3])
{
    uint32_t at = r->count;
    for (uint32_t i = 0; i < r->count; i++) {
        if (r->near[i].feature == prim->feature && is_twin(r->near[i].corner, corner)) return; /* handed over twice */
    }
    if (at == r->most) {
        at = 0;
        for (uint32_t i = 1; i < r->most; i++)
            at = r->near[i].feature > r->near[at].feature ? i : at;
        if (r->near[at].feature < prim->feature) return;
    } else {
        r->count++;
    }
    tahr__near *n = &r->near[at];
    for (int i = 0; i < 3; i++) {
        n->corner[i] = corner[i];
        n->v[i] = prim->facet.v[i];
    }
    n->face = prim->face;
    n->feature = prim->feature;
    n->two_sided = prim->kind & TAHR__TWO_SIDED;
}

static int wants_in_ring(const stream *s, const tahr_triangle *t)
{
    const ring *r = (const ring *)s;
    uint32_t mask = t->mask ? t->mask : 0xFFFFFFFFu;
    return (mask & s->query->mask) && t->body == r->prim->body && is_at_corner(r, t->corners);
}

static void put_in_ring(stream *s, const tahr__loose *loose)
{
    ring *r = (ring *)s;
    keep_near(r, &loose->prim, loose->corner);
}

static void ring_from_cache(ring *r, const tahr__query *query)
{
    tahr__corners corners = tahr__cache_corners(query->world, query->cache);
    const tahr__prim *prims = tahr__cache_prims(query->world, query->cache);
    uint32_t i = corners.first[tahr__corner_bucket(&corners, r->corner)];
    for (; i != TAHR__NONE; i = corners.next[i]) {
        const tahr_vec3 *v = corners.exact + 3 * (size_t)(i / 3);
        const tahr__prim *p = &prims[i / 3];
        int there = (p->mask & query->mask) && p->body == r->prim->body;
        if (there && equal(corners.exact[i], r->corner) && is_at_corner(r, v)) keep_near(r, p, v);
    }
}

const tahr_vec3 *tahr__source_corners(const tahr__query *query, const tahr__prim *prim)
{
    if (prim->kind & TAHR__FRESH) return ((const tahr__loose *)(const void *)prim)->corner;
    return tahr__cache_corners(query->world, query->cache).exact + 3 * (size_t)(prim->item & ~TAHR__ITEM_LOOSE);
}

uint32_t tahr__source_around(const tahr__query *query, const tahr__prim *prim, tahr_vec3 corner, const tahr_vec3 *at,
                             tahr__near *near, uint32_t most)
{
    const tahr_vec3 border = {BORDER, BORDER, BORDER};
    ring r;
    r.stream.query = query;
    r.prim = prim;
    r.own = tahr__source_corners(query, prim);
    r.corner = corner;
    r.near = near;
    r.count = 0;
    r.most = most;
    /* What a cache holds a search of it has come to: all that is there is in it. */
    if (at && !(prim->kind & TAHR__FRESH)) {
        ring_from_cache(&r, query);
        return r.count;
    }
    tahr_vec3 place = at ? v_add(query->frame->origin, tahr__frame_to_world(query->frame, *at)) : corner;
    r.stream.wants = wants_in_ring;
    r.stream.take = put_in_ring;
    tahr_bounds box = {v_sub(place, border), v_add(place, border)};
    set_box(&r.stream, &box);
    return run(&r.stream) ? r.count : 0;
}

/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: the first blocking contact of a moving shape and the sensors before it. */
#include "form.h"
#include "plane.h"
#include "scene.h"

#include <string.h>

/* Sensor bodies remembered in one sweep; each reports its first contact. */
enum { SENSORS = 32 };

/* Surfaces met at the same time, and the way (m) that counts as the same: ten times what rounding does to positions 1e6
 * m out, and no more than what the narrow phase promises. */
enum { TIES = 8 };
#define HAIR 1e-9
/* Boxes are stopped at least at this distance (m), and go the rest straight: they have no radius, and where the core
 * itself touches, the direction to what it touches is rounding. Four times what is told from rounding (TAHR__BLURRED of
 * flight.h). */
#define LEAST_OF_BOXES 4e-9

/* Cached primitives that wait for their turn, the earliest first; one more is probed at once. */
enum { WAITING = 32 };
/* Primitives that are asked a second time; if there are more, all are. */
enum { PUT_OFF = 8 };

typedef struct waiter {
    double turn;     /* it does not stop the motion before this time: by its plane, later by its edges too */
    double earliest; /* by its plane alone: where its probe begins, whatever has been asked */
    const tahr__prim *prim;
    uint32_t sure; /* there is no use in asking its edges */
    uint32_t reserved;
} waiter;

/* What is undecided until all that is beside the start is known. */
typedef struct put_off {
    double earliest;
    tahr__prim prim;
} put_off;

typedef struct sweep_state {
    tahr__search search;
    tahr__found ties[TIES];    /* what blocks first, and what blocks at the same time but for rounding */
    const tahr__prim *stopper; /* whose contact is one of them */
    double first;              /* the earliest time of the ties */
    double hair;               /* what counts as the same time */
    double limit;              /* first and a hair, or 1 */
    uint32_t tied, sensor_count, lost, waiting;
    uint32_t again; /* this is the second time */
    uint32_t edged; /* the edge of a one-way body was among the ties */
    uint32_t sinks; /* and the foot has sunk into one */
    double beside;  /* the smallest gap of what is within the margin at the start and does not block */
    double later;   /* the earliest time at which something undecided may block; > 1: nothing */
    uint32_t put_off_count, reserved; /* PUT_OFF + 1: more than there is room for */
    waiter waiters[WAITING];
    tahr__found sensors[SENSORS];
    put_off put_off[PUT_OFF];
} sweep_state;

/* Leaves to the slot: motion, margin, flags. Only what is read is set: a query is 500 bytes. */
void tahr__query_begin(tahr__query *query, const tahr__native *world, tahr_query_context *context, tahr_vec3 position,
                       tahr_vec3 up)
{
    tahr__cache *cache = context->cache;
    query->world = world;
    query->context = context;
    if (cache && cache->announced && tahr__same_vec(&cache->frame.up, &up)) {
        query->cache = cache;
        query->frame = &cache->frame;
    } else {
        query->cache = NULL;
        query->own_frame = tahr__frame_make(position, up);
        query->frame = &query->own_frame;
    }
    query->start = v_sub(position, query->frame->origin);
    if (query->frame->turned) query->start = m_apply(&query->frame->turn, query->start);
    query->core.axis_count = 0;
    query->extent = query->motion = v_make(0, 0, 0);
    query->motion_length = query->radius = query->margin = query->surplus = query->half = 0;
    query->flags = 0;
    query->sensors = TAHR__SENSORS_NONE;
    query->sinks = 0;
    query->corner = NULL;
}

void tahr__query_shape(tahr__query *query, const tahr_shape *shape, tahr_quat orientation)
{
    query->radius = shape->type == TAHR_SHAPE_BOX ? 0 : shape->radius;
    if (shape->type == TAHR_SHAPE_CAPSULE && shape->half_height > shape->radius) {
        query->core.axis_count = 1;
        query->half = shape->half_height - shape->radius;
        query->core.axis[0] = query->extent = v_make(0, 0, query->half);
    } else if (shape->type == TAHR_SHAPE_BOX) {
        tahr__mat turn = m_from_quat(orientation);
        query->core.axis_count = 3;
        query->core.axis[0] = v_make(shape->half_x, 0, 0);
        query->core.axis[1] = v_make(0, shape->half_y, 0);
        query->core.axis[2] = v_make(0, 0, shape->half_height);
        for (int i = 0; i < 3; i++) {
            query->core.axis[i] = m_apply(&turn, query->core.axis[i]);
            if (query->frame->turned) query->core.axis[i] = m_apply(&query->frame->turn, query->core.axis[i]);
            query->extent = v_add(query->extent, v_abs(query->core.axis[i]));
        }
    }
}

/* Of sensors: depth is no order, for it is another one at every place. */
static int answered_before(const tahr__found *a, const tahr__found *b)
{
    return a->t != b->t ? a->t < b->t : tahr__named_before(a, b);
}

static void note_sensor(sweep_state *s, const tahr__found *f)
{
    for (uint32_t i = 0; i < s->sensor_count; i++) {
        if (s->sensors[i].body != f->body) continue;
        if (tahr__found_before(f, &s->sensors[i])) s->sensors[i] = *f;
        return;
    }
    if (s->sensor_count < SENSORS) {
        s->sensors[s->sensor_count++] = *f;
        return;
    }
    uint32_t last = 0;
    for (uint32_t i = 1; i < SENSORS; i++) {
        if (answered_before(&s->sensors[last], &s->sensors[i])) last = i;
    }
    if (answered_before(f, &s->sensors[last])) s->sensors[last] = *f;
    s->lost = 1;
}

/* The deepest overlap only: a sum of depths decides nothing. */
static int overlap_first(sweep_state *s, const tahr__found *f)
{
    if (s->tied && s->ties[0].overlap && !tahr__found_before(f, &s->ties[0])) return 0;
    s->ties[0] = *f;
    s->tied = 1;
    s->first = s->limit = 0;
    return 1;
}

/* Keeps all that blocks within a hair of the first. Which of two surfaces that a walker touches at once is met first is
 * rounding, and whole paths would hang on it: of those the one with the lowest name is reported, at the first one's
 * time. Beyond TIES the highest names are dropped. Returns whether it is one of them. */
static int tie(sweep_state *s, const tahr__found *f)
{
    if (f->overlap) return overlap_first(s, f);
    if (f->t > s->limit || (s->tied && s->ties[0].overlap)) return 0;
    uint32_t kept = 0, last = 0;
    s->first = s->tied ? d_min(s->first, f->t) : f->t;
    s->limit = d_min(s->first + s->hair, 1);
    for (uint32_t i = 0; i < s->tied; i++) {
        if (s->ties[i].t > s->limit) continue;
        s->ties[kept] = s->ties[i];
        if (tahr__named_before(&s->ties[last], &s->ties[kept])) last = kept;
        kept++;
    }
    s->tied = kept;
    if (kept < TIES) {
        s->ties[s->tied++] = *f;
    } else if (tahr__named_before(f, &s->ties[last])) {
        s->ties[last] = *f;
    } else {
        return 0;
    }
    return 1;
}

/* The user's triangles that are on their way are more than a primitive: they are looked for again. */
static void put_off_until_all_is_known(sweep_state *s, const tahr__prim *prim, double earliest)
{
    if (s->put_off_count < PUT_OFF && !(prim->kind & TAHR__FRESH)) {
        s->put_off[s->put_off_count++] = (put_off){earliest, *prim};
    } else {
        s->put_off_count = PUT_OFF + 1;
    }
}

static void probe(sweep_state *s, const tahr__prim *prim, double earliest)
{
    const tahr__query *query = s->search.query;
    tahr__found f;
    int sensor = (prim->kind & TAHR__SENSOR) != 0;
    /* A sensor is decided at once: it must not make what blocks be looked at a second time. */
    const double *beside = sensor ? &query->margin : s->again ? &s->beside : NULL;
    tahr__ask ask = {earliest, s->limit, beside};
    int answer = tahr__probe_sweep(query, prim, &ask, &f);
    if (answer == TAHR__BESIDE && !sensor) s->beside = d_min(s->beside, f.gap);
    if (answer == TAHR__LATER) {
        s->later = d_min(s->later, f.t);
        put_off_until_all_is_known(s, prim, earliest);
    }
    if (answer == TAHR__SINKS) s->sinks = 1;
    if (answer != TAHR__BLOCKED) return;
    if (sensor) {
        note_sensor(s, &f);
        return;
    }
    if (tie(s, &f)) {
        s->stopper = prim;
        s->edged |= f.edge;
    }
}

/* Nothing that lies beyond the limit is searched for any more. */
static void narrow(sweep_state *s)
{
    s->search.box = tahr__query_box(s->search.query, s->limit);
    s->search.narrowed = 1;
}

static void visit(tahr__search *search, const tahr__prim *prim)
{
    sweep_state *s = (sweep_state *)search;
    double before = s->limit, t = plane_earliest(search->query, prim, before);
    if (t > before || edges_earliest(search->query, prim, before, t) > before) return;
    probe(s, prim, t);
    if (s->limit < before) narrow(s);
}

/* Those that may block earliest go first: most often the first one does, and the others are too late. */
static void settle(sweep_state *s)
{
    waiter *w = s->waiters;
    while (s->waiting > 0) {
        waiter *next = w;
        for (uint32_t i = 1; i < s->waiting; i++)
            next = w[i].turn < next->turn ? &w[i] : next;
        double turn = next->turn;
        if (turn > s->limit) break;
        if (!next->sure) {
            next->sure = 1;
            next->turn = edges_earliest(s->search.query, next->prim, s->limit, turn);
            if (next->turn > turn) continue;
        }
        const tahr__prim *prim = next->prim;
        double earliest = next->earliest;
        *next = w[--s->waiting];
        probe(s, prim, earliest);
    }
    s->waiting = 0;
}

static void line_up(sweep_state *s, const tahr__prim *prim)
{
    double t = plane_earliest(s->search.query, prim, s->limit);
    if (t > s->limit) return;
    if (s->waiting == WAITING) {
        visit(&s->search, prim);
        return;
    }
    s->waiters[s->waiting++] = (waiter){t, t, prim, 0, 0};
}

static void begin(sweep_state *s, const tahr__query *query)
{
    s->search.query = query;
    s->search.box = tahr__query_box(query, 1.0);
    s->search.reach = query->radius + query->margin;
    s->search.narrowed = s->search.order = 0;
    s->search.visit = visit;
    s->limit = 1;
    s->stopper = NULL;
    s->hair = query->motion_length > 0 ? HAIR / query->motion_length : 0;
    s->tied = s->sensor_count = s->lost = s->again = s->waiting = s->edged = s->sinks = s->put_off_count = 0;
    s->beside = query->margin;
    s->later = 2;
}

/* Those that may be too late by now are left out. */
static void line_up_found(sweep_state *s, const tahr__prim *prims, const tahr__lanes_found *found, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        line_up(s, &prims[found[i].index]);
    }
    settle(s);
}

static uint32_t kind_of(const tahr__query *query)
{
    const tahr_vec3 m = query->motion;
    tahr__cache *cache = query->cache;
    if (query->core.axis_count == 1) return -m.z > fabs(m.x) + fabs(m.y) ? TAHR__OF_LOWERED : TAHR__OF_BODY;
    if (query->radius < cache->stopped.foot) return TAHR__OF_THINNER;
    cache->stopped.foot = query->radius;
    return TAHR__OF_FOOT;
}

/* What stopped the last such motion goes first: what it leaves of this one is most often so little that little else is
 * near it. Its corners say whether it is. Which is asked first changes no answer: each is decided alone, and of those
 * that block within a hair of the first the lowest name counts. */
static void ask_recent(sweep_state *s, uint32_t index)
{
    const tahr__query *query = s->search.query;
    tahr__cache *cache = query->cache;
    if (index >= cache->count || !tahr__cache_concerns(query, index)) return;
    const tahr__prim *prim = tahr__formed(query, index);
    const tahr_vec3 *v = prim->facet.v, low = v_min(v[0], v_min(v[1], v[2])), high = v_max(v[0], v_max(v[1], v[2]));
    const double reach = s->search.reach + TAHR__SLACK;
    const tahr_bounds *box = &s->search.box;
    const int near = (low.x - reach <= box->max.x) & (low.y - reach <= box->max.y) & (low.z - reach <= box->max.z) &
                     (high.x + reach >= box->min.x) & (high.y + reach >= box->min.y) & (high.z + reach >= box->min.z);
    if (!near && !(prim->kind & TAHR__PLANELESS)) return;
    const double t = plane_earliest(query, prim, s->limit);
    if (t > s->limit) return;
    probe(s, prim, t);
    if (s->limit < 1) s->search.box = tahr__query_box(query, s->limit);
}

/* A foot that comes down where so many are around: it is worth a look which is met first, for few are as early. */
enum { MANY = 48 };

/* So many edges are crossed on the way to the triangle under a foot; and neighbours are looked for so far before and
 * behind a triangle in the cache, where what lies together was found together. */
enum { HOPS = 3, NEXT = 40 };

/* Where a cached triangle is; TAHR__NONE: not near `index`. */
static uint32_t find_beside(const tahr__prim *prims, uint32_t count, uint32_t index, uint32_t item)
{
    for (uint32_t i = 1; i <= NEXT; i++) {
        const uint32_t before = index >= i ? index - i : index, behind = index + i < count ? index + i : index;
        if (prims[before].item == item && prims[before].body == prims[index].body) return before;
        if (prims[behind].item == item && prims[behind].body == prims[index].body) return behind;
    }
    return TAHR__NONE;
}

/* The one on the other side of an edge. */
static uint32_t across(const tahr__query *query, uint32_t index, uint32_t edge)
{
    const tahr__prim *prims = tahr__cache_prims(query->world, query->cache), *prim = &prims[index];
    const tahr__body *body = &query->world->bodies[prim->body];
    const uint32_t item = body->type == TAHR_BODY_HEIGHTS ? tahr__heights_across(&body->heights, prim->item, edge)
                                                          : body->mesh.triangles[prim->item].ring[edge];
    return item == prim->item ? TAHR__NONE : find_beside(prims, query->cache->count, index, item);
}

/* Which edge of a triangle a point is beyond where it comes to its plane; 3: none, NEVER_THERE: it does not come. */
enum { NEVER_THERE = 4 };
static uint32_t edge_to(const tahr__query *query, const tahr__prim *prim)
{
    const tahr__facet *f = &prim->facet;
    const tahr_vec3 e[3] = {v_sub(f->v[1], f->v[0]), v_sub(f->v[2], f->v[1]), v_sub(f->v[0], f->v[2])};
    if (prim->kind & (TAHR__PLANELESS | TAHR__GATHERED)) return NEVER_THERE;
    const double t = plane_earliest(query, prim, 1);
    double far;
    return t > 1 ? NEVER_THERE : edge_beyond(query, f, v_sub(v_mad(query->start, query->motion, t), f->v[0]), e, &far);
}

/* From the triangle that stopped the last foot over the edges to the one that this foot comes down on. Over another one
 * it would meet an edge, where a neighbour is nearer, and all that was measured would be in vain. TAHR__NONE: there is
 * none that is plainly under it. */
static uint32_t find_under(const tahr__query *query, uint32_t index)
{
    for (int hop = 0; hop <= HOPS && index < query->cache->count; hop++) {
        const uint32_t edge = edge_to(query, tahr__formed(query, index));
        if (edge == 3) return index;
        if (edge == NEVER_THERE) return TAHR__NONE;
        index = across(query, index, edge);
    }
    return TAHR__NONE;
}

/* What is likely to stop the motion. */
static uint32_t guess(const sweep_state *s, uint32_t recent)
{
    const tahr__query *query = s->search.query;
    if (query->core.axis_count != 0 || query->cache->count < MANY) return recent;
    const uint32_t under = find_under(query, recent);
    return under != TAHR__NONE ? under : tahr__cache_guess(&s->search);
}

static void search_cache(sweep_state *s)
{
    const tahr__query *query = s->search.query;
    const tahr__prim *prims;
    tahr__lanes_found found[TAHR__CACHE_MOST];
    uint32_t *recent = tahr__cache_recent(query->cache, kind_of(query)), kept = 0;
    const uint32_t first = guess(s, *recent);
    ask_recent(s, first);
    const uint32_t count = tahr__cache_cull(&s->search, s->limit, &prims, found);
    for (uint32_t i = 0; i < count; i++) {
        found[kept] = found[i];
        kept += found[i].index != first;
    }
    line_up_found(s, prims, found, kept);
    if (s->stopper) *recent = (uint32_t)(s->stopper - prims);
}

static void search(sweep_state *s)
{
    const tahr__query *query = s->search.query;
    if (query->flags & TAHR_SWEEP_ONLY_BODY) {
        if (query->ignore_body < query->world->body_count) tahr__tree_search_body(&s->search, query->ignore_body);
        return;
    }
    if (tahr__cache_holds(&s->search))
        search_cache(s);
    else
        tahr__search_fixed(&s->search);
    s->stopper = NULL;
    if (query->world->movable.count == 0) return;
    narrow(s);
    tahr__tree_search(&s->search, &query->world->movable);
}

/* Nearly always once. A second time, with all that is beside the start known, if a contact that seemed to belong to a
 * neighbour may come first after all; everybody else has answered for good. */
static void run(sweep_state *s)
{
    search(s);
    if (s->later >= s->limit) return;
    s->again = 1;
    if (s->put_off_count > PUT_OFF || s->search.query->world->no_vicinity) {
        search(s);
        return;
    }
    for (uint32_t i = 0; i < s->put_off_count; i++) {
        if (s->put_off[i].earliest <= s->limit) probe(s, &s->put_off[i].prim, s->put_off[i].earliest);
    }
}

void tahr__fill_hit(const tahr__query *query, const tahr__found *f, tahr_hit *hit)
{
    memset(hit, 0, sizeof *hit);
    hit->sensor = (f->kind & TAHR__SENSOR) != 0;
    hit->blocking = !hit->sensor;
    hit->start_overlap = f->overlap;
    hit->unknown = f->unknown;
    hit->fraction = f->t;
    hit->distance = f->gap;
    hit->depth = f->overlap ? -f->gap : 0;
    hit->normal = tahr__frame_to_world(query->frame, f->normal);
    hit->surface_normal = tahr__frame_to_world(query->frame, f->face);
    hit->point = v_add(query->frame->origin, tahr__frame_to_world(query->frame, f->point));
    hit->walkable_angle = f->walkable_angle;
    hit->walkable_rule = f->walkable_rule;
    hit->surface = f->surface;
    hit->body = f->body;
    hit->feature = f->feature;
}

static const tahr__found *first_of(sweep_state *s)
{
    tahr__found *first = &s->ties[0];
    for (uint32_t i = 1; i < s->tied; i++)
        first = tahr__named_before(&s->ties[i], first) ? &s->ties[i] : first;
    first->t = s->first;
    return first;
}

/* Sensors that begin no later than the blocking hit, in order, then that hit. */
static tahr_status report(sweep_state *s, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    uint32_t n = 0, room = s->tied && capacity > 0 ? capacity - 1 : capacity, kept = 0;
    for (uint32_t i = 0; i < s->sensor_count; i++) {
        if (s->tied && s->sensors[i].t > s->first) continue;
        tahr__found f = s->sensors[i];
        uint32_t k = kept++;
        for (; k > 0 && answered_before(&f, &s->sensors[k - 1]); k--)
            s->sensors[k] = s->sensors[k - 1];
        s->sensors[k] = f;
    }
    for (; n < kept && n < room; n++)
        tahr__fill_hit(s->search.query, &s->sensors[n], &hits[n]);
    int truncated = n < kept || s->lost;
    if (s->tied && capacity > 0) tahr__fill_hit(s->search.query, first_of(s), &hits[n++]);
    *count = n;
    return truncated ? TAHR_TRUNCATED : TAHR_OK;
}

tahr_status tahr__sweep_rest(tahr__query *query, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    sweep_state s;
    tahr__corner_met corner;
    tahr_status failed = TAHR_OK;
    query->failed = &failed;
    corner.count = corner.flown = 0;
    query->corner = query->world->no_vicinity ? NULL : &corner;
    begin(&s, query);
    run(&s);
    if (s.edged && s.sinks) { /* which edges hold was not known before all had been asked */
        query->sinks = 1;
        begin(&s, query);
        run(&s);
    }
    query->corner = NULL;
    return failed < 0 ? failed : report(&s, hits, capacity, count);
}

/* May a body that moves be met? Of the vicinity only what is at rest for good is known. */
static int meets_movable(const tahr__query *query)
{
    if (query->world->movable.count == 0) return 0;
    const tahr_bounds box = tahr__query_box(query, 1);
    const tahr_bounds world = tahr__frame_box_to_world(query->frame, &box, query->radius + query->margin + TAHR__SLACK);
    return tahr__movable_meets(query->world, &world);
}

/* A sweep for what blocks, which may have been asked before. */
static tahr_status sweep_once(tahr__query *query, const tahr_sweep *sweep, tahr_hit *hit, uint32_t *count)
{
    tahr_query_context *context = query->context;
    const tahr__native *world = query->world;
    tahr__asked *asked = query->cache && !world->no_vicinity ? &query->cache->asked : NULL;
    const tahr__asked_sweep *before = asked && asked->count ? tahr__asked_find(asked, world->placed, sweep) : NULL;
    const uint64_t measured = context->narrow_iterations;
    if (before) {
        context->spared++;
        *count = before->count;
        if (before->count) *hit = before->hit;
        return TAHR_OK;
    }
    tahr_status status = tahr__sweep_rest(query, hit, 1, count);
    if (asked && status == TAHR_OK && context->narrow_iterations - measured >= TAHR__DEAR) {
        tahr__asked_keep(asked, world->placed, sweep, hit, *count);
    }
    return status;
}

tahr_status tahr__native_sweep(void *self, tahr_query_context *context, const tahr_sweep *sweep, tahr_hit *hits,
                               uint32_t capacity, uint32_t *count)
{
    tahr__query query;
    tahr__query_begin(&query, self, context, sweep->position, sweep->up);
    tahr__query_shape(&query, &sweep->shape, sweep->orientation);
    query.motion = query.frame->turned ? m_apply(&query.frame->turn, sweep->motion) : sweep->motion;
    query.motion_length = v_length(query.motion);
    query.margin = query.core.axis_count == 3 ? d_max(sweep->margin, LEAST_OF_BOXES) : sweep->margin;
    query.surplus = query.margin - sweep->margin;
    query.mask = sweep->mask;
    query.ignore_body = sweep->ignore_body;
    query.flags = sweep->flags;
    query.sensors = capacity > 1 ? TAHR__SENSORS_TOO : TAHR__SENSORS_NONE;
    if (sweep->flags & TAHR_SWEEP_SENSORS) query.sensors = TAHR__SENSORS_ONLY;
    if (query.core.axis_count == 0 && capacity > 0 && tahr__vicinity_known(&query) == TAHR__DOWN &&
        !meets_movable(&query) && tahr__vicinity_lands(&query, hits)) {
        context->spared++;
        *count = 1;
        return TAHR_OK;
    }
    return capacity == 1 ? sweep_once(&query, sweep, hits, count) : tahr__sweep_rest(&query, hits, capacity, count);
}

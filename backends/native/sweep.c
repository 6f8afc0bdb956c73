/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: the first blocking contact of a moving shape and the sensors before it. */
#include "scene.h"

#include <string.h>

/* Sensor bodies remembered in one sweep; each reports its first contact. */
enum { SENSORS = 32 };

typedef struct sweep_state {
    tahr__search search;
    tahr__found best;
    uint32_t found, sensor_count, lost;
    uint32_t again; /* this is the second time */
    double beside;  /* the smallest gap of what is within the margin at the start and does not block */
    double later;   /* the earliest time at which something undecided may block; > 1: nothing */
    tahr__found sensors[SENSORS];
} sweep_state;

void tahr__query_begin(tahr__query *query, const tahr__native *world, tahr_query_context *context, tahr_vec3 position,
                       tahr_vec3 up)
{
    memset(query, 0, sizeof *query);
    query->world = world;
    query->context = context;
    tahr__cache *cache = context->cache;
    if (cache && cache->announced && memcmp(&cache->frame.up, &up, sizeof up) == 0) {
        query->cache = cache;
        query->frame = cache->frame;
    } else {
        query->frame = tahr__frame_make(world, position, up);
    }
    query->start = v_sub(position, query->frame.origin);
    if (query->frame.turned) query->start = m_apply(&query->frame.turn, query->start);
}

void tahr__query_shape(tahr__query *query, const tahr_shape *shape, tahr_quat orientation)
{
    query->radius = shape->type == TAHR_SHAPE_BOX ? 0 : shape->radius;
    if (shape->type == TAHR_SHAPE_CAPSULE && shape->half_height > shape->radius) {
        query->core.axis_count = 1;
        query->core.axis[0] = v_make(0, 0, shape->half_height - shape->radius);
    } else if (shape->type == TAHR_SHAPE_BOX) {
        tahr__mat turn = m_from_quat(orientation);
        query->core.axis_count = 3;
        query->core.axis[0] = v_make(shape->half_x, 0, 0);
        query->core.axis[1] = v_make(0, shape->half_y, 0);
        query->core.axis[2] = v_make(0, 0, shape->half_height);
        for (int i = 0; i < 3; i++) {
            query->core.axis[i] = m_apply(&turn, query->core.axis[i]);
            if (query->frame.turned) query->core.axis[i] = m_apply(&query->frame.turn, query->core.axis[i]);
        }
    }
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
        if (tahr__found_before(&s->sensors[last], &s->sensors[i])) last = i;
    }
    if (tahr__found_before(f, &s->sensors[last])) s->sensors[last] = *f;
    s->lost = 1;
}

static void visit(tahr__search *search, const tahr__prim *prim)
{
    sweep_state *s = (sweep_state *)search;
    const tahr__query *query = search->query;
    tahr__found f;
    int sensor = (query->world->bodies[prim->body].flags & TAHR_BODY_SENSOR) != 0;
    int answer = tahr__probe_sweep(query, prim, s->found ? s->best.t : 1.0, s->again ? &s->beside : NULL, &f);
    if (answer == TAHR__BESIDE && !sensor) s->beside = d_min(s->beside, f.gap);
    if (answer == TAHR__LATER) s->later = d_min(s->later, f.t);
    if (answer != TAHR__BLOCKED) return;
    if (sensor) {
        note_sensor(s, &f);
        return;
    }
    if (s->found && !tahr__found_before(&f, &s->best)) return;
    s->best = f;
    s->found = 1;
    search->box = tahr__query_box(query, f.t);
    search->narrowed = 1;
}

/* Nearly always once. A second time, with all that is beside the start known, if a contact that seemed to belong to a
 * neighbour may come first after all. */
static void run(sweep_state *s)
{
    tahr__search_run(&s->search);
    if (s->later > (s->found ? s->best.t : 1.0)) return;
    s->again = 1;
    tahr__search_run(&s->search);
}

void tahr__fill_hit(const tahr__query *query, const tahr__found *f, tahr_hit *hit)
{
    const tahr__body *body = &query->world->bodies[f->body];
    memset(hit, 0, sizeof *hit);
    hit->sensor = (body->flags & TAHR_BODY_SENSOR) != 0;
    hit->blocking = !hit->sensor;
    hit->start_overlap = f->overlap;
    hit->unknown = f->unknown;
    hit->fraction = f->t;
    hit->distance = f->gap;
    hit->depth = f->overlap ? -f->gap : 0;
    hit->normal = tahr__frame_to_world(&query->frame, f->normal);
    hit->surface_normal = tahr__frame_to_world(&query->frame, f->face);
    hit->point = v_add(query->frame.origin, tahr__frame_to_world(&query->frame, f->point));
    hit->walkable_angle = body->walkable_angle;
    hit->walkable_rule = body->walkable_rule;
    hit->surface = body->surface;
    hit->body = f->body;
    hit->feature = f->feature;
}

/* Sensors that begin no later than the blocking hit, in order, then that hit. */
static tahr_status report(sweep_state *s, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    uint32_t n = 0, room = s->found && capacity > 0 ? capacity - 1 : capacity, kept = 0;
    for (uint32_t i = 0; i < s->sensor_count; i++) {
        if (s->found && s->sensors[i].t > s->best.t) continue;
        tahr__found f = s->sensors[i];
        uint32_t k = kept++;
        for (; k > 0 && tahr__found_before(&f, &s->sensors[k - 1]); k--) s->sensors[k] = s->sensors[k - 1];
        s->sensors[k] = f;
    }
    for (; n < kept && n < room; n++) tahr__fill_hit(s->search.query, &s->sensors[n], &hits[n]);
    int truncated = n < kept || s->lost;
    if (s->found && capacity > 0) tahr__fill_hit(s->search.query, &s->best, &hits[n++]);
    *count = n;
    return truncated ? TAHR_TRUNCATED : TAHR_OK;
}

tahr_status tahr__native_sweep(void *self, tahr_query_context *context, const tahr_sweep *sweep, tahr_hit *hits,
                               uint32_t capacity, uint32_t *count)
{
    tahr__query query;
    sweep_state s;
    tahr__query_begin(&query, self, context, sweep->position, sweep->up);
    tahr__query_shape(&query, &sweep->shape, sweep->orientation);
    query.motion = query.frame.turned ? m_apply(&query.frame.turn, sweep->motion) : sweep->motion;
    query.motion_length = v_length(query.motion);
    query.margin = sweep->margin;
    query.mask = sweep->mask;
    query.ignore_body = sweep->ignore_body;
    query.flags = sweep->flags;
    query.sensors = capacity > 1;
    s.search.query = &query;
    s.search.box = tahr__query_box(&query, 1.0);
    s.search.reach = query.radius + query.margin;
    s.search.narrowed = 0;
    s.search.visit = visit;
    s.found = s.sensor_count = s.lost = s.again = 0;
    s.beside = query.margin;
    s.later = 2;
    run(&s);
    return report(&s, hits, capacity, count);
}

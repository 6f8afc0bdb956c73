/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: the start is decided by core distance, the motion by libccd, then who comes first. */
#include "scene.h"

/* Sensor bodies reported by one sweep; more are dropped, the farthest first. */
enum { MAX_SENSORS = 16 };
/* Pieces put in order before libccd is asked; of more than these the latest are asked about as they come. */
enum { MAX_WAITING = 64 };
/* The way (m) on which surfaces are met at once: ten times what answers are off by. */
#define HAIR 1e-8

/* A piece that may be hit, not before the fraction at which the tangent of its distance at the start says so. */
typedef struct candidate {
    tahr__ccd_piece piece;
    tahr__ccd_near near;
    double earliest;
} candidate;

typedef struct search {
    const tahr__ccd_probe *probe;
    uint32_t flags;
    uint32_t sensor_count, lost, waiting_count;
    uint32_t edged, sinks; /* of one-way bodies: an edge was kept; the foot sinks into one */
    int found;
    tahr_hit best; /* blocking */
    tahr_hit sensors[MAX_SENSORS];
    candidate waiting[MAX_WAITING + 1]; /* by earliest */
} search;

/* The part of the motion that counts as the same time. */
static double hair_of(const search *s)
{
    return s->probe->motion_length > 0 ? HAIR / s->probe->motion_length : 0;
}

/* Order of answers: where, then who. Overlaps at the start come first, the deepest of them first. */
static int comes_before(const tahr_hit *a, const tahr_hit *b)
{
    if (a->start_overlap != b->start_overlap) return a->start_overlap > b->start_overlap;
    if (a->start_overlap && a->depth != b->depth) return a->depth > b->depth;
    if (a->fraction != b->fraction) return a->fraction < b->fraction;
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

/* Of sensors: depth is no order, for it is another one at every place. */
static int answered_before(const tahr_hit *a, const tahr_hit *b)
{
    if (a->fraction != b->fraction) return a->fraction < b->fraction;
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

static void keep_sensor(search *s, const tahr_hit *hit)
{
    uint32_t i = 0;

    while (i < s->sensor_count && s->sensors[i].body != hit->body)
        i++;
    if (i < s->sensor_count) {
        if (comes_before(hit, &s->sensors[i])) s->sensors[i] = *hit;
    } else if (i < MAX_SENSORS) {
        s->sensors[s->sensor_count++] = *hit;
    } else {
        uint32_t last = 0;
        for (i = 1; i < MAX_SENSORS; i++) {
            if (answered_before(&s->sensors[last], &s->sensors[i])) last = i;
        }
        if (answered_before(hit, &s->sensors[last])) s->sensors[last] = *hit;
        s->lost = 1;
    }
}

/* Which of two surfaces that are met at once comes first is rounding: the lower name does, at the earlier time. */
static void keep_tie(search *s, const tahr_hit *hit)
{
    double first = d_min(hit->fraction, s->best.fraction);
    tahr_hit other = *hit;
    other.fraction = s->best.fraction = first;
    if (comes_before(&other, &s->best)) s->best = other;
}

static void keep(search *s, const tahr_hit *hit)
{
    if (hit->sensor) {
        keep_sensor(s, hit);
    } else if (s->found && !hit->start_overlap && !s->best.start_overlap &&
               fabs(hit->fraction - s->best.fraction) <= hair_of(s)) {
        keep_tie(s, hit);
    } else if (!s->found || comes_before(hit, &s->best)) {
        s->best = *hit;
        s->found = 1;
    }
}

/* Only what is approached blocks; an overlap at the start does so whatever the motion, unless it may be left. A sensor
 * does not block, so there is nothing to leave: its overlap is always news. */
static int must_report(const search *s, const tahr__ccd_body *body, const tahr__ccd_near *near)
{
    int leaves = s->flags & TAHR_SWEEP_LEAVE_OVERLAP && !(body->flags & TAHR_BODY_SENSOR);

    if (near->distance < 0 && !leaves) return 1;
    return v_dot(s->probe->motion, near->normal) < -TAHR__CCD_PARALLEL * s->probe->motion_length;
}

/* Takes a contact, unless it is from behind, an internal edge, or not approached. */
static void report(search *s, const tahr__ccd_piece *piece, tahr__ccd_near *near, double fraction, int unknown)
{
    const tahr__ccd_probe *p = s->probe;
    const tahr__ccd_body *b = piece->body;
    tahr_hit hit = {0};

    int felt =
        tahr__ccd_in_front(piece, near) && tahr__ccd_face(p, piece, v_scale(p->motion, -1), near, &hit.surface_normal);
    if (!felt && !unknown) return;
    tahr__ccd_one_way one_way;
    int there = tahr__ccd_one_way_blocks(p, piece, near, hit.surface_normal, fraction, &one_way);
    s->sinks |= (uint32_t)one_way.sinks;
    if (!there || (!must_report(s, b, near) && !unknown)) return;
    s->edged |= (uint32_t)one_way.edge;
    hit.sensor = (b->flags & TAHR_BODY_SENSOR) != 0;
    hit.blocking = !hit.sensor;
    hit.unknown = unknown != 0;
    hit.fraction = fraction;
    hit.distance = near->distance;
    hit.start_overlap = fraction == 0 && near->distance < 0;
    hit.depth = hit.start_overlap ? -near->distance : 0;
    hit.normal = near->normal;
    hit.point = v_add(p->origin, near->point);
    hit.walkable_rule = b->walkable_rule;
    hit.walkable_angle = b->walkable_angle;
    hit.surface = b->surface;
    hit.body = b->id;
    hit.feature = tahr__ccd_feature(piece, near);
    keep(s, &hit);
}

/* What is later than the nearest hit so far by more than a hair cannot matter. */
static double limit_of(const search *s)
{
    if (!s->found) return 1;
    return s->best.start_overlap ? -1 : d_min(1, s->best.fraction + hair_of(s) + 1e-12);
}

static void resolve(search *s, candidate *c)
{
    double limit = limit_of(s), fraction = c->earliest;

    if (c->earliest > limit) return;
    tahr__ccd_verdict verdict = tahr__ccd_impact(s->probe, &c->piece, limit, &fraction, &c->near);
    if (verdict != TAHR__CCD_FREE) report(s, &c->piece, &c->near, d_min(1, fraction), verdict == TAHR__CCD_UNKNOWN);
}

static void visit(search *s, const tahr__ccd_piece *piece)
{
    candidate c = {.piece = *piece};
    double gap, speed;
    uint32_t at;

    s->probe->context->narrow_tests++;
    tahr__ccd_measure(s->probe, piece, v_make(0, 0, 0), &c.near);
    gap = c.near.distance - s->probe->margin;
    speed = -v_dot(s->probe->motion, c.near.normal);
    if (gap <= 0) report(s, piece, &c.near, 0, 0); /* by core distance, never by the boolean */
    if (gap <= 0 || !(speed > 0) || gap > speed * limit_of(s)) return;
    c.earliest = gap / speed;
    for (at = s->waiting_count++; at > 0 && c.earliest < s->waiting[at - 1].earliest; at--)
        s->waiting[at] = s->waiting[at - 1];
    s->waiting[at] = c;
    if (s->waiting_count > MAX_WAITING) resolve(s, &s->waiting[--s->waiting_count]);
}

/* Sensors met no later than the blocking hit, in order, then that hit. */
static uint32_t write_hits(search *s, tahr_hit *hits, uint32_t capacity, int *lost)
{
    uint32_t count = 0, room = s->found && capacity > 0 ? capacity - 1 : capacity;

    for (uint32_t i = 0; i < s->sensor_count; i++) {
        tahr_hit hit = s->sensors[i];
        uint32_t at = count;
        if (s->found && hit.fraction > s->best.fraction) continue;
        *lost |= count == room;
        if (count == room && (room == 0 || !answered_before(&hit, &hits[room - 1]))) continue;
        if (count == room)
            at = room - 1;
        else
            count++;
        for (; at > 0 && answered_before(&hit, &hits[at - 1]); at--)
            hits[at] = hits[at - 1];
        hits[at] = hit;
    }
    if (s->found && capacity > 0) hits[count++] = s->best;
    return count;
}

static void run(search *s, const tahr__ccd_probe *probe)
{
    tahr__ccd_walk walk;
    tahr__ccd_piece piece;

    s->probe = probe;
    s->flags = probe->flags;
    s->sensor_count = s->lost = s->waiting_count = s->edged = s->sinks = 0;
    s->found = 0;
    tahr__ccd_walk_begin(&walk, probe, probe->motion, probe->radius + probe->margin);
    while (tahr__ccd_walk_next(&walk, &piece))
        visit(s, &piece);
    for (uint32_t i = 0; i < s->waiting_count; i++)
        resolve(s, &s->waiting[i]);
}

tahr_status tahr__ccd_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count)
{
    tahr__ccd_probe probe = {.scene = self,
                             .context = context,
                             .margin = query->margin,
                             .origin = query->position,
                             .motion = query->motion,
                             .mask = query->mask,
                             .ignore_body = query->ignore_body,
                             .only_body = (query->flags & TAHR_SWEEP_ONLY_BODY) != 0,
                             .leaves_out = query->flags & TAHR_SWEEP_SENSORS ? TAHR__CCD_SOLIDS
                                           : capacity == 1                   ? TAHR__CCD_SENSORS
                                                                             : 0u};
    search s;
    int lost = 0;

    *count = 0;
    probe.up = query->up;
    probe.flags = query->flags;
    probe.motion_length = v_length(query->motion);
    if (!tahr__ccd_probe_shape(&probe, &query->shape, query->up, query->orientation)) return TAHR_E_UNSUPPORTED;
    if (!tahr__ccd_probe_finite(&probe)) return TAHR_E_ARGUMENT;
    run(&s, &probe);
    if (s.edged && s.sinks) { /* which edges of one-way bodies hold was not known before all had been asked */
        probe.sinks = 1;
        run(&s, &probe);
    }
    *count = write_hits(&s, hits, capacity, &lost);
    return lost || (s.lost && capacity > 1) ? TAHR_TRUNCATED : TAHR_OK;
}

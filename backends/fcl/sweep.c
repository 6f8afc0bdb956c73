/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: every candidate is measured at the start, those that come near are walked up to in the order
 * in which they could be met. */
#include "scene.h"

#include "../common/hits.h"
#include "../common/one_way.h"

/* Pieces put in order before they are walked up to; of more than these the latest are asked about as they come. */
enum { MAX_WAITING = 64 };

/* How much nearer (m) than anything was at the start an edge must be to count though a neighbour hid it: ten times what
 * tangents leave. */
#define NEARER 1e-8

/* A piece that may be hit, not before the fraction at which the tangent of its distance at the start says so. */
typedef struct waiter {
    double earliest, start; /* fraction; distance at the start */
    uint32_t part, reserved;
} waiter;

typedef struct search {
    tahr__fcl_query *query;
    tahr__hits hits;
    tahr__one_way_sweep one_way;
    double beside; /* the smallest distance of what is within the margin at the start and does not block */
    double hidden; /* how near an edge or corner could come that a nearer neighbour hid */
    uint32_t waiting_count, again;   /* again: this is the second time */
    waiter waiting[MAX_WAITING + 1]; /* by earliest */
} search;

/* Where the shape meets a piece. */
typedef struct meeting {
    uint32_t part, unknown;
    double fraction, start;
    tahr__near near;
} meeting;

static int is_there(search *s, const tahr__piece *piece, const meeting *m, tahr_vec3 face)
{
    int inside = m->near.distance + s->query->shape.radius + piece->radius <= 0;
    const tahr__one_way_meeting met = {m->near.normal, face, m->near.point, m->fraction, m->start, inside != 0, 0};

    return !tahr__one_way_is(tahr__fcl_query_body(s->query, m->part)->surface.flags) ||
           tahr__one_way_met(&s->one_way, &met);
}

/* What a nearer neighbour hides is not there while that one is nearer; it is felt, at the latest, when it comes nearer
 * than everything was at the start. Which distance that is is known when all has been looked at. */
static void hide(search *s, const tahr__piece *piece, const tahr__near *near)
{
    const tahr__fcl_query *q = s->query;
    tahr_vec3 n = near->normal;

    if (piece->kind != TAHR__TRIANGLE || !(piece->facet.length > 0)) return;
    n = v_scale(piece->facet.cross, (v_dot(piece->facet.cross, n) < 0 ? -1 : 1) / piece->facet.length);
    double height = -v_dot(n, piece->facet.v[0]) - tahr__shape_extent(&q->shape, v_scale(n, -1)) - q->shape.radius;
    s->hidden = d_min(s->hidden, height + d_min(0, v_dot(q->motion, n)));
}

/* Takes a contact, unless it is from behind, or not approached. Returns 0 if it is an internal edge. */
static int report(search *s, const tahr__piece *piece, meeting *m)
{
    const tahr__fcl_query *q = s->query;
    const tahr__surface *surface = &tahr__fcl_query_body(q, m->part)->surface;
    tahr_hit hit;

    tahr__hit_of(surface, &hit);
    hit.surface_normal = m->near.normal;
    int felt = tahr__fcl_felt(q, m->part, piece, v_scale(q->motion, -1), &m->near, &hit.surface_normal);
    if (!felt && !m->unknown) return !tahr__piece_in_front(piece, &m->near);
    int approaches = tahr__approaches(q->motion, q->motion_length, m->near.normal);
    if (!is_there(s, piece, m, hit.surface_normal)) return 1;
    if (!m->unknown && !tahr__hit_counts(s->one_way.flags, surface, m->near.distance, approaches)) {
        if (m->fraction == 0 && !hit.sensor) s->beside = d_min(s->beside, m->near.distance);
        return 1;
    }
    hit.unknown = m->unknown;
    hit.fraction = m->fraction;
    hit.distance = m->near.distance;
    hit.start_overlap = m->fraction == 0 && m->near.distance < 0;
    hit.depth = hit.start_overlap ? -m->near.distance : 0;
    hit.normal = m->near.normal;
    hit.point = v_add(q->origin, m->near.point);
    hit.feature = tahr__fcl_feature(q, m->part, piece, m->near.normal);
    tahr__hits_keep(&s->hits, &hit);
    return 1;
}

/* A contact; if a neighbour hides it, the second time, what comes of it later. */
static void met(search *s, const tahr__piece *piece, meeting *m)
{
    tahr__fcl_query *q = s->query;
    tahr__motion motion = {&q->shape, q->motion, s->beside - NEARER, &q->context->narrow_iterations};

    if (report(s, piece, m)) return;
    if (!s->again) {
        hide(s, piece, &m->near);
        return;
    }
    double gap = m->near.distance - motion.margin, speed = -v_dot(q->motion, m->near.normal);
    double limit = tahr__hits_limit(&s->hits);
    /* Below no distance at all the cores would be in each other: nothing of this surface can be nearer. */
    if (piece->kind != TAHR__TRIANGLE || q->shape.radius + motion.margin <= 0 || gap <= 0 || !(speed > 0)) return;
    m->fraction += gap / speed;
    if (m->fraction > limit) return;
    tahr__verdict verdict = tahr__piece_advance(&motion, piece, limit, &m->fraction, &m->near);
    m->unknown = verdict == TAHR__UNKNOWN;
    m->fraction = d_min(1, m->fraction);
    if (verdict != TAHR__FREE) report(s, piece, m);
}

static void resolve(search *s, const waiter *w)
{
    tahr__fcl_query *q = s->query;
    tahr__motion motion = {&q->shape, q->motion, q->margin, &q->context->narrow_iterations};
    double limit = tahr__hits_limit(&s->hits);
    meeting m = {.part = w->part, .fraction = w->earliest, .start = w->start};
    tahr__piece piece;

    if (w->earliest > limit || !tahr__fcl_query_piece(q, w->part, &piece)) return;
    tahr__verdict verdict = tahr__piece_advance(&motion, &piece, limit, &m.fraction, &m.near);
    m.unknown = verdict == TAHR__UNKNOWN;
    m.fraction = d_min(1, m.fraction);
    if (verdict != TAHR__FREE) met(s, &piece, &m);
}

static void visit(search *s, uint32_t part)
{
    tahr__fcl_query *q = s->query;
    meeting m = {.part = part};
    tahr__piece piece;
    uint32_t at;

    if (!tahr__fcl_query_piece(q, part, &piece)) return;
    q->context->narrow_tests++;
    tahr__fcl_measure(q, part, &piece, v_make(0, 0, 0), &m.near);
    m.start = m.near.distance;
    double gap = m.start - q->margin, speed = -v_dot(q->motion, m.near.normal);
    if (gap <= 0) met(s, &piece, &m);
    if (gap <= 0 || !(speed > 0) || gap > speed * tahr__hits_limit(&s->hits)) return;
    waiter w = {gap / speed, m.start, part, 0};
    for (at = s->waiting_count++; at > 0 && w.earliest < s->waiting[at - 1].earliest; at--)
        s->waiting[at] = s->waiting[at - 1];
    s->waiting[at] = w;
    if (s->waiting_count > MAX_WAITING) resolve(s, &s->waiting[--s->waiting_count]);
}

static void look(search *s)
{
    s->waiting_count = 0;
    for (uint32_t i = 0; i < s->query->count; i++)
        visit(s, i);
    for (uint32_t i = 0; i < s->waiting_count; i++)
        resolve(s, &s->waiting[i]);
}

/* Nearly always once: a second time where something hidden may come nearer than all there was. */
static void run(search *s)
{
    tahr__hits_begin(&s->hits, s->query->motion_length);
    s->again = 0;
    s->beside = s->hidden = s->query->margin;
    look(s);
    if (s->hidden > s->beside - NEARER) return;
    s->again = 1;
    look(s);
}

tahr_status tahr__fcl_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count)
{
    const tahr__shape_source source = {&query->shape, query->up, query->orientation, NULL};
    tahr__fcl_query q;
    search s;
    tahr_status status;

    *count = 0;
    q.scene = self;
    q.margin = query->margin;
    q.origin = query->position;
    q.motion = query->motion;
    q.filter = tahr__filter_of_sweep(query, capacity);
    if (!(query->margin >= 0)) return TAHR_E_ARGUMENT;
    status = tahr__fcl_query_shape(&q, &source);
    if (status < 0) return status;
    status = tahr__fcl_query_begin(&q, context, q.shape.radius + q.margin);
    s.query = &q;
    s.one_way = (tahr__one_way_sweep){.up = query->up,
                                      .motion = q.motion,
                                      .motion_length = q.motion_length,
                                      .margin = q.margin,
                                      .low = tahr__shape_extent(&q.shape, v_scale(query->up, -1)) + q.shape.radius,
                                      .flags = query->flags};
    if (status >= 0) {
        do
            run(&s);
        while (tahr__one_way_again(&s.one_way));
    }
    tahr__fcl_query_end(&q);
    return status < 0 ? status : tahr__hits_write(&s.hits, hits, capacity, count);
}

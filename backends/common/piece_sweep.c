/* SPDX-License-Identifier: MIT
 * piece_sweep.c: the sweep slot: every piece is measured at the start, those that come near are walked up to in the
 * order in which they could be met. */
#include "hits.h"
#include "one_way.h"
#include "piece_query.h"

/* Pieces put in order before they are walked up to; of more than these the latest are asked about as they come. */
enum { MAX_WAITING = 64 };

/* How much nearer (of the query's unit) than anything was at the start an edge must be to count though a neighbour hid
 * it: ten times what tangents leave. */
#define NEARER 1e-8

/* A box is stopped at least at this distance (of the query's unit, or of the box if that is smaller), and goes the rest
 * straight: it has no radius, and where it touches, the direction to what it touches is rounding, so that neighbours of
 * a mesh could each take the other for nearer. Ten times the tolerance of arrivals (piece.c). */
#define LEAST_MARGIN 1e-8

/* A piece that may be hit, not before the fraction at which the tangent of its distance at the start says so. */
typedef struct waiter {
    double earliest;
    uint64_t name;
} waiter;

typedef struct search {
    tahr__piece_query *query;
    tahr__hits hits;
    tahr__one_way_sweep one_way;
    double surplus; /* the query's margin is so much more than was asked for */
    double beside;  /* the smallest distance of what is within the margin at the start and does not block */
    double hidden;  /* how near an edge or corner could come that a nearer neighbour hid */
    uint32_t waiting_count, again;   /* again: this is the second time */
    waiter waiting[MAX_WAITING + 1]; /* by earliest */
} search;

/* Where the shape meets a piece. */
typedef struct meeting {
    const tahr__piece_found *found;
    tahr__near near;
    double fraction;
    uint32_t unknown, reserved;
} meeting;

/* Signed distance at the start; only a drop asks how far beyond the margin it was. */
static double began(const search *s, const meeting *m)
{
    tahr__near start;

    if (m->fraction == 0) return m->near.distance;
    if (!(s->one_way.flags & TAHR_SWEEP_DROP)) return s->query->margin;
    if (s->query->finder->measure)
        s->query->finder->measure(s->query, m->found, &start);
    else
        tahr__piece_measure(&s->query->shape, v_make(0, 0, 0), &m->found->piece, &start);
    return start.distance;
}

static int is_there(search *s, const meeting *m, tahr_vec3 face)
{
    int inside = m->near.distance + s->query->shape.radius + m->found->piece.radius <= 0;
    tahr__one_way_meeting met = {m->near.normal, face, m->near.point, m->fraction, 0, inside != 0, 0};

    if (!tahr__one_way_is(m->found->surface->flags)) return 1;
    met.start = began(s, m);
    return tahr__one_way_met(&s->one_way, &met);
}

/* What a nearer neighbour hides is not there while that one is nearer; it is felt, at the latest, when it comes nearer
 * than everything was at the start. Which distance that is is known when all has been looked at. */
static void hide(search *s, const meeting *m)
{
    const tahr__piece_query *q = s->query;
    const tahr__piece *piece = &m->found->piece;

    if (piece->kind != TAHR__TRIANGLE || !(piece->facet.length > 0)) return;
    double side = v_dot(piece->facet.cross, m->near.normal) < 0 ? -1 : 1;
    tahr_vec3 n = v_scale(piece->facet.cross, side / piece->facet.length);
    double height = -v_dot(n, piece->facet.v[0]) - tahr__shape_extent(&q->shape, v_scale(n, -1)) - q->shape.radius;
    s->hidden = d_min(s->hidden, height + d_min(0, v_dot(q->motion, n)));
}

/* From where a margin was reached that is more than what was asked for: along the tangent, which is never late. */
static int goes_the_rest(const search *s, meeting *m)
{
    double rest = d_min(s->surplus, m->near.distance - s->query->margin + s->surplus);

    if (rest <= 0 || m->unknown) return 1;
    m->near.distance -= rest;
    m->fraction += rest / -v_dot(s->query->motion, m->near.normal);
    return m->fraction <= tahr__hits_limit(&s->hits);
}

/* Takes a contact, unless it is from behind, or not approached. Returns 0 if it is an internal edge. */
static int report(search *s, meeting *m)
{
    const tahr__piece_query *q = s->query;
    const tahr__surface *surface = m->found->surface;
    tahr_hit hit;

    tahr__hit_of(surface, &hit);
    hit.surface_normal = m->near.normal;
    int felt = tahr__piece_query_felt(q, m->found, v_scale(q->motion, -1), &m->near, &hit.surface_normal);
    if (!felt && !m->unknown) return !tahr__piece_in_front(&m->found->piece, &m->near);
    int approaches = tahr__approaches(q->motion, q->motion_length, m->near.normal);
    if (!is_there(s, m, hit.surface_normal)) return 1;
    if (!m->unknown && !tahr__hit_counts(q->flags, surface, m->near.distance, approaches)) {
        if (m->fraction == 0 && !hit.sensor) s->beside = d_min(s->beside, m->near.distance);
        return 1;
    }
    if (approaches && !goes_the_rest(s, m)) return 1;
    hit.unknown = m->unknown;
    hit.fraction = m->fraction;
    hit.distance = m->near.distance / q->start.scale;
    hit.start_overlap = m->fraction == 0 && m->near.distance < 0;
    hit.depth = hit.start_overlap ? -hit.distance : 0;
    hit.normal = m->near.normal;
    hit.point = tahr__piece_query_world(q, m->near.point);
    hit.feature = tahr__piece_query_feature(q, m->found, m->near.normal);
    tahr__hits_keep(&s->hits, &hit);
    return 1;
}

/* A contact; if a neighbour hides it, the second time, what comes of it later. */
static void met(search *s, meeting *m)
{
    tahr__piece_query *q = s->query;
    const tahr__piece *piece = &m->found->piece;
    tahr__motion motion = {&q->shape, q->motion, s->beside - NEARER, &q->context->narrow_iterations, 0, 0};

    if (report(s, m)) return;
    if (!s->again) {
        hide(s, m);
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
    if (verdict != TAHR__FREE) report(s, m);
}

static void resolve(search *s, const waiter *w)
{
    const tahr__piece_finder *finder = s->query->finder;
    double limit = tahr__hits_limit(&s->hits);
    tahr__piece_found found = {.name = w->name};
    meeting m = {.found = &found, .fraction = w->earliest};

    if (w->earliest > limit || !finder->make(s->query, &found)) return;
    tahr__verdict verdict = (finder->advance ? finder->advance : tahr__piece_query_advance)(
        s->query, &found.piece, limit, &m.fraction, &m.near);
    m.unknown = verdict == TAHR__UNKNOWN;
    m.fraction = d_min(1, m.fraction);
    if (verdict != TAHR__FREE) met(s, &m);
}

static void visit(search *s, const tahr__piece_found *found)
{
    tahr__piece_query *q = s->query;
    meeting m = {.found = found};
    uint32_t at;

    tahr__piece_query_measure(q, found, &m.near);
    double gap = m.near.distance - q->margin, speed = -v_dot(q->motion, m.near.normal);
    if (gap <= 0) met(s, &m);
    if (gap <= 0 || !(speed > 0) || gap > speed * tahr__hits_limit(&s->hits)) return;
    waiter w = {gap / speed, found->name};
    for (at = s->waiting_count++; at > 0 && w.earliest < s->waiting[at - 1].earliest; at--)
        s->waiting[at] = s->waiting[at - 1];
    s->waiting[at] = w;
    if (s->waiting_count > MAX_WAITING) resolve(s, &s->waiting[--s->waiting_count]);
}

static void look(search *s)
{
    tahr__piece_found found;

    s->waiting_count = 0;
    while (tahr__piece_query_next(s->query, &found))
        visit(s, &found);
    for (uint32_t i = 0; i < s->waiting_count; i++)
        resolve(s, &s->waiting[i]);
    s->query->finder->rewind(s->query);
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

static void begin(search *s, tahr__piece_query *q)
{
    double low = tahr__shape_extent(&q->shape, v_scale(q->up, -1)) + q->shape.radius;
    int bare = !q->shape.is_convex && q->shape.radius <= 0;

    s->query = q;
    s->surplus = bare ? d_max(0, LEAST_MARGIN * d_min(1, low) - q->margin) : 0;
    q->margin += s->surplus;
    s->one_way = (tahr__one_way_sweep){.up = q->up,
                                       .motion = q->motion,
                                       .motion_length = q->motion_length,
                                       .margin = q->margin,
                                       .flags = q->flags,
                                       .low = low};
}

tahr_status tahr__piece_sweep(tahr__piece_query *q, const tahr_sweep *sweep, tahr_hit *hits, uint32_t capacity,
                              uint32_t *count)
{
    const tahr__shape_source shape = {&sweep->shape, sweep->up, sweep->orientation,
                                      tahr__scene_hull(q->scene, &sweep->shape),
                                      q->finder->scale ? q->finder->scale(&sweep->shape) : 1};
    search s;

    *count = 0;
    q->up = sweep->up;
    q->motion = sweep->motion;
    q->margin = sweep->margin;
    q->filter = tahr__filter_of_sweep(sweep, capacity);
    q->flags = sweep->flags;
    tahr_status status = tahr__piece_query_begin(q, sweep->position, &shape);
    if (status >= 0) {
        begin(&s, q);
        do
            run(&s);
        while (tahr__one_way_again(&s.one_way));
    }
    tahr__piece_query_end(q);
    return status < 0 ? status : tahr__hits_write(&s.hits, hits, capacity, count);
}

/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: the start is decided by core distance, the motion by libccd, then who comes first. */
#include "../common/hits.h"
#include "scene.h"

/* Pieces put in order before libccd is asked; of more than these the latest are asked about as they come. */
enum { MAX_WAITING = 64 };

/* How much nearer (of the unit) than anything was at the start an edge must be to count though a neighbour hid it: ten
 * times what tangents leave. */
#define NEARER 1e-8

/* A piece that may be hit, not before the fraction at which the tangent of its distance at the start says so. */
typedef struct candidate {
    tahr__ccd_piece piece;
    tahr__ccd_near near;
    double earliest;
} candidate;

typedef struct search {
    const tahr__ccd_probe *probe;
    tahr__hits hits;
    tahr__one_way_sweep one_way;
    double beside;  /* the smallest distance of what is within the margin at the start and does not block */
    double hidden;  /* how near an edge or corner could come that a nearer neighbour hid */
    uint32_t again; /* this is the second time */
    uint32_t waiting_count;
    candidate waiting[MAX_WAITING + 1]; /* by earliest */
} search;

/* Signed distance at the start; only a drop asks how far beyond the margin it was. */
static double began(const search *s, const tahr__ccd_piece *piece, const tahr__ccd_near *near, double fraction)
{
    tahr__ccd_near start;

    if (fraction == 0) return near->distance;
    if (!(s->one_way.flags & TAHR_SWEEP_DROP)) return s->probe->margin;
    tahr__ccd_measure(s->probe, piece, v_make(0, 0, 0), &start);
    return start.distance;
}

static int is_there(search *s, const tahr__ccd_piece *piece, const tahr__ccd_near *near, tahr_vec3 face,
                    double fraction)
{
    tahr__one_way_meeting m = {near->normal, face, near->point, fraction, 0, 0, 0};

    if (!tahr__one_way_is(piece->body->surface.flags)) return 1;
    m.start = began(s, piece, near, fraction);
    m.inside = near->distance + s->probe->radius + piece->radius <= 0;
    return tahr__one_way_met(&s->one_way, &m);
}

/* What a nearer neighbour hides is not there while that one is nearer; it is felt, at the latest, when it comes nearer
 * than everything was at the start. Which distance that is is known when all has been looked at. */
static void hide(search *s, const tahr__ccd_piece *piece, const tahr__ccd_near *near)
{
    const tahr__ccd_probe *p = s->probe;
    tahr_vec3 n = tahr__convex_triangle_normal(piece->corner);

    if (v_dot(n, near->normal) < 0) n = v_scale(n, -1);
    double height = -v_dot(n, piece->corner[0]) - tahr__convex_extent(&p->shape, v_scale(n, -1)) - p->radius;
    s->hidden = d_min(s->hidden, height + d_min(0, v_dot(p->motion, n)));
}

/* Takes a contact, unless it is from behind, or not approached. Returns 0 if it is an internal edge. */
static int report(search *s, const tahr__ccd_piece *piece, tahr__ccd_near *near, double fraction, int unknown)
{
    const tahr__ccd_probe *p = s->probe;
    const tahr__surface *surface = &piece->body->surface;
    tahr_hit hit;

    tahr__hit_of(surface, &hit);
    int felt = tahr__ccd_in_front(piece, near);
    if (!felt && !unknown) return 1;
    if (felt && !tahr__ccd_face(p, piece, v_scale(p->motion, -1), near, &hit.surface_normal) && !unknown) return 0;
    int approaches = tahr__approaches(p->motion, p->motion_length, near->normal);
    if (!is_there(s, piece, near, hit.surface_normal, fraction)) return 1;
    if (!unknown && !tahr__hit_counts(s->one_way.flags, surface, near->distance, approaches)) {
        if (fraction == 0 && !hit.sensor) s->beside = d_min(s->beside, near->distance);
        return 1;
    }
    hit.unknown = unknown != 0;
    hit.fraction = fraction;
    hit.distance = near->distance / p->unit;
    hit.start_overlap = fraction == 0 && near->distance < 0;
    hit.depth = hit.start_overlap ? -hit.distance : 0;
    hit.normal = near->normal;
    hit.point = tahr__ccd_world(p, near->point);
    hit.feature = tahr__ccd_feature(piece, near);
    tahr__hits_keep(&s->hits, &hit);
    return 1;
}

/* A contact; if a neighbour hides it, the second time, what comes of it later. */
static void met(search *s, const tahr__ccd_piece *piece, tahr__ccd_near *near, double fraction, int unknown)
{
    double limit;
    tahr__ccd_probe nearer;

    if (report(s, piece, near, fraction, unknown)) return;
    if (!s->again) {
        hide(s, piece, near);
        return;
    }
    nearer = *s->probe;
    nearer.margin = s->beside - NEARER;
    double gap = near->distance - nearer.margin, speed = -v_dot(nearer.motion, near->normal);
    /* Below no distance at all the cores would be in each other: nothing of this surface can be nearer. */
    if (nearer.radius + nearer.margin <= 0 || gap <= 0 || !(speed > 0)) return;
    fraction += gap / speed;
    limit = tahr__hits_limit(&s->hits);
    if (fraction > limit) return;
    tahr__ccd_verdict verdict = tahr__ccd_advance(&nearer, piece, limit, &fraction, near);
    if (verdict != TAHR__CCD_FREE) report(s, piece, near, d_min(1, fraction), verdict == TAHR__CCD_UNKNOWN);
}

static void resolve(search *s, candidate *c)
{
    double limit = tahr__hits_limit(&s->hits), fraction = c->earliest;

    if (c->earliest > limit) return;
    tahr__ccd_verdict verdict = tahr__ccd_impact(s->probe, &c->piece, limit, &fraction, &c->near);
    if (verdict != TAHR__CCD_FREE) met(s, &c->piece, &c->near, d_min(1, fraction), verdict == TAHR__CCD_UNKNOWN);
}

static void visit(search *s, const tahr__ccd_piece *piece)
{
    candidate c = {.piece = *piece};
    double gap, speed;
    uint32_t at;

    s->probe->context->narrow_tests++;
    tahr__ccd_measure_far(s->probe, piece, v_make(0, 0, 0), &c.near);
    gap = c.near.distance - s->probe->margin;
    speed = -v_dot(s->probe->motion, c.near.normal);
    if (gap <= 0) met(s, piece, &c.near, 0, 0); /* by core distance, never by the boolean */
    if (gap <= 0 || !(speed > 0) || gap > speed * tahr__hits_limit(&s->hits)) return;
    c.earliest = gap / speed;
    for (at = s->waiting_count++; at > 0 && c.earliest < s->waiting[at - 1].earliest; at--)
        s->waiting[at] = s->waiting[at - 1];
    s->waiting[at] = c;
    if (s->waiting_count > MAX_WAITING) resolve(s, &s->waiting[--s->waiting_count]);
}

static void look(search *s)
{
    const tahr__ccd_probe *probe = s->probe;
    tahr__ccd_walk walk;
    tahr__ccd_piece piece;

    s->waiting_count = 0;
    tahr__ccd_walk_begin(&walk, probe, probe->motion, probe->radius + probe->margin);
    while (tahr__ccd_walk_next(&walk, &piece))
        visit(s, &piece);
    for (uint32_t i = 0; i < s->waiting_count; i++)
        resolve(s, &s->waiting[i]);
}

/* Nearly always once: a second time where something hidden may come nearer than all there was. */
static void run(search *s)
{
    tahr__hits_begin(&s->hits, s->probe->motion_length);
    s->again = 0;
    s->beside = s->probe->margin;
    s->hidden = s->probe->margin;
    look(s);
    if (s->hidden > s->beside - NEARER) return;
    s->again = 1;
    look(s);
}

tahr_status tahr__ccd_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count)
{
    tahr__ccd_probe probe = {.scene = self,
                             .context = context,
                             .margin = query->margin,
                             .origin = query->position,
                             .motion = query->motion,
                             .filter = tahr__filter_of_sweep(query, capacity)};
    search s;
    tahr_status status;

    *count = 0;
    status = tahr__ccd_probe_shape(&probe, &query->shape, query->up, query->orientation);
    if (status < 0) return status;
    s.probe = &probe;
    s.one_way = (tahr__one_way_sweep){.up = query->up,
                                      .motion = probe.motion,
                                      .motion_length = probe.motion_length,
                                      .margin = probe.margin,
                                      .flags = query->flags};
    s.one_way.low = tahr__convex_extent(&probe.shape, v_scale(query->up, -1)) + probe.radius;
    do
        run(&s);
    while (tahr__one_way_again(&s.one_way));
    return tahr__hits_write(&s.hits, hits, capacity, count);
}

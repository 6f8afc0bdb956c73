/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: for each piece that Box2D finds the first fraction by tangents of the convex distance,
 * then who comes first. */
#include "../common/graze.h"
#include "../common/hits.h"
#include "../common/one_way.h"
#include "scene.h"

enum { MAX_TANGENTS = 64 };
/* Arrived (m). */
#define ARRIVED 1e-9

typedef struct search {
    const tahr__b2_probe *probe;
    tahr__hits hits;
    tahr__one_way_sweep one_way;
} search;

/* One piece on its way: where the shape is met, and how far it was at the start. */
typedef struct meeting {
    const tahr__b2_piece *piece;
    double start; /* m, signed distance */
    double fraction;
    int unknown;
    tahr__flat_near near;
} meeting;

/* Is a one-way body there, where it is met? Others always are. */
static int is_there(search *s, const meeting *m, tahr__vec2 face)
{
    const tahr__one_way_meeting met = {tahr__b2_lift(m->near.normal, 0),
                                       tahr__b2_lift(face, 0),
                                       tahr__b2_lift(m->near.point, 0),
                                       m->fraction,
                                       m->start,
                                       m->near.crosses != 0,
                                       0};

    return !tahr__one_way_is(m->piece->owner.flags) || tahr__one_way_met(&s->one_way, &met);
}

static int counts(const search *s, const meeting *m)
{
    const tahr__one_way_sweep *q = &s->one_way;
    int approaches = tahr__approaches(q->motion, q->motion_length, tahr__b2_lift(m->near.normal, 0));
    return tahr__hit_counts(q->flags, &m->piece->owner, m->near.distance, approaches);
}

static void write_hit(search *s, const meeting *m, tahr__vec2 face)
{
    const tahr__b2_probe *p = s->probe;
    tahr_hit hit;

    tahr__hit_of(&m->piece->owner, &hit);
    hit.unknown = m->unknown != 0;
    hit.fraction = d_min(1, m->fraction);
    hit.distance = m->near.distance;
    hit.start_overlap = m->fraction == 0 && m->near.distance < 0;
    hit.depth = hit.start_overlap ? -m->near.distance : 0;
    hit.normal = tahr__b2_lift(m->near.normal, 0);
    hit.surface_normal = tahr__b2_lift(face, 0);
    hit.point = v_make(p->origin.x + m->near.point.x, p->origin.y + m->near.point.y, p->origin.z);
    hit.feature = tahr__b2_feature(m->piece, &m->near);
    tahr__hits_keep(&s->hits, &hit);
}

/* Takes a meeting, unless it is from behind, not approached, or a seam. Returns 1 if it was a seam: then what lies
 * behind it may still be met. */
static int report(search *s, meeting *m)
{
    tahr__vec2 direction = f_make(-s->probe->motion.x, -s->probe->motion.y), face;

    if (!tahr__b2_in_front(m->piece, &m->near)) return 0;
    tahr__b2_leave(s->probe, m->piece, &m->near);
    face = tahr__b2_face(m->piece, &m->near, direction);
    if (!is_there(s, m, face) || !counts(s, m)) return 0;
    if (!(m->piece->owner.flags & TAHR_BODY_SENSOR) && !m->near.crosses &&
        tahr__b2_is_seam(s->probe, m->piece, &m->near, direction, &face)) {
        return 1;
    }
    write_hit(s, m, face);
    return 0;
}

static tahr__vec2 place_at(const search *s, double fraction)
{
    return f_make(s->probe->motion.x * fraction, s->probe->motion.y * fraction);
}

/* When are the nearest corners of the shape over this face? Negative: never. range: along the face at the start. */
static double comes_over(const double range[2], double speed, double length)
{
    if (range[1] >= 0 && range[0] <= length) return 0;
    if (range[1] < 0) return speed > 0 ? -range[1] / speed : -1;
    return speed < 0 ? (length - range[0]) / speed : -1;
}

/* Past a seam: a slope that begins at it is met where its face is, not its corner. Its distance is linear. */
static void pass_seam(search *s, meeting *m)
{
    const tahr__b2_probe *p = s->probe;
    const tahr__flat *f = &m->piece->flat;
    double begin = m->fraction;

    for (int i = 0; i < (f->one_sided ? 1 : tahr__flat_face_count(f)); i++) {
        tahr__vec2 n = tahr__flat_normal(f, i);
        double range[2], approach = -f_dot(p->motion, n), t, over;
        double gap = tahr__flat_height(&p->shape, f_make(0, 0), f, i, range) - p->shape.radius - f->radius - p->margin;
        if (!(approach > 0)) continue;
        over = comes_over(range, f_dot(p->motion, f_make(-n.y, n.x)), tahr__flat_length(f, i));
        t = d_max(d_max(gap / approach, over), begin);
        if (over < 0 || t > tahr__hits_limit(&s->hits)) continue;
        tahr__flat_measure(&p->shape, place_at(s, t), f, 0, &m->near);
        if (m->near.part != i || m->near.distance > p->margin + ARRIVED) continue;
        m->fraction = t;
        report(s, m);
    }
}

/* Does the shape only pass what it has come within the margin of? */
static int passes(const search *s, const meeting *m, double gap, double speed)
{
    const tahr__b2_probe *p = s->probe;
    const tahr__descent here = {gap, speed, m->fraction};
    tahr__descent there = here;
    tahr__flat_near near;

    if (speed > TAHR__GRAZING * p->motion_length) return 0;
    there.fraction = tahr__beyond(&here, p->shape.radius + m->piece->flat.radius + p->margin, p->motion_length);
    p->context->narrow_iterations++;
    tahr__flat_measure(&p->shape, place_at(s, there.fraction), &m->piece->flat, 0, &near);
    there.gap = near.distance - p->margin;
    there.speed = -f_dot(p->motion, near.normal);
    return tahr__grazes(&here, &there, p->motion_length, ARRIVED);
}

/* A tangent of a convex function lies below it: a step to its root never overshoots. Returns 1 if they meet. */
static int advance(search *s, meeting *m)
{
    const tahr__b2_probe *p = s->probe;
    double t = m->fraction, limit = tahr__hits_limit(&s->hits);

    for (int i = 0; i < MAX_TANGENTS; i++) {
        double gap = m->near.distance - p->margin, speed = -f_dot(p->motion, m->near.normal);
        m->fraction = t;
        if (gap <= ARRIVED && i > 0) return !passes(s, m, gap, speed);
        if (!(speed > 0)) return 0;
        t += gap / speed;
        if (t > limit) return 0;
        if (t == m->fraction) return 1;
        p->context->narrow_iterations++;
        tahr__flat_measure(&p->shape, place_at(s, t), &m->piece->flat, 0, &m->near);
    }
    m->unknown = 1;
    return 1;
}

static void visit(void *user, tahr__b2_piece *piece)
{
    search *s = user;
    meeting m = {.piece = piece};

    s->probe->context->narrow_tests++;
    tahr__flat_measure(&s->probe->shape, f_make(0, 0), &piece->flat, 0, &m.near);
    m.start = m.near.distance;
    if (m.start > s->probe->margin && !advance(s, &m)) return;
    if (report(s, &m)) pass_seam(s, &m);
}

/* How far the shape reaches down along up. */
static double low_of(const tahr__b2_probe *p)
{
    double reach = 0;

    for (int i = 0; i < p->shape.count; i++)
        reach = d_max(reach, -f_dot(p->up, p->shape.corner[i]));
    return reach + p->shape.radius;
}

tahr_status tahr__b2_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                           uint32_t capacity, uint32_t *count)
{
    tahr__b2_probe probe = {.scene = self,
                            .context = context,
                            .margin = query->margin,
                            .origin = query->position,
                            .motion = {query->motion.x, query->motion.y},
                            .filter = tahr__filter_of_sweep(query, capacity)};
    search s;
    tahr_status status;

    *count = 0;
    probe.motion_length = f_length(probe.motion);
    status = tahr__b2_probe_shape(&probe, &query->shape, query->up);
    if (status >= 0) status = tahr__b2_probe_check(&probe, query->motion);
    if (status < 0) return status;
    s.probe = &probe;
    s.one_way = (tahr__one_way_sweep){.up = tahr__b2_lift(probe.up, 0),
                                      .motion = tahr__b2_lift(probe.motion, 0),
                                      .motion_length = probe.motion_length,
                                      .margin = probe.margin,
                                      .low = low_of(&probe),
                                      .flags = query->flags};
    do {
        tahr__hits_begin(&s.hits, probe.motion_length);
        tahr__b2_each(&probe, visit, &s);
    } while (tahr__one_way_again(&s.one_way));
    return tahr__hits_write(&s.hits, hits, capacity, count);
}

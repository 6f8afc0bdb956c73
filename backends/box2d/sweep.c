/* SPDX-License-Identifier: MIT
 * sweep.c: the sweep slot: for each piece that Box2D finds the first fraction by tangents of the convex distance,
 * then who comes first. */
#include "../common/one_way.h"
#include "scene.h"

/* Sensor bodies reported by one sweep; more are dropped, the farthest first. */
enum { MAX_SENSORS = 16, MAX_TANGENTS = 64 };
/* The way (m) on which surfaces are met at once: ten times what answers are off by. */
#define HAIR 1e-8
/* Arrived (m). */
#define ARRIVED 1e-9

typedef struct search {
    const tahr__b2_probe *probe;
    uint32_t flags;
    uint32_t sensor_count, lost;
    int edged, sinks; /* of one-way bodies: an edge was kept; the foot sinks into one */
    int sinks_first;  /* what was found out before */
    int found;
    tahr_hit best; /* blocking */
    tahr_hit sensors[MAX_SENSORS];
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

/* What is later than the nearest hit so far by more than a hair cannot matter. */
static double limit_of(const search *s)
{
    if (!s->found) return 1;
    return s->best.start_overlap ? -1 : d_min(1, s->best.fraction + hair_of(s) + 1e-12);
}

/* Only what is approached blocks; an overlap at the start does so whatever the motion, unless it may be left. A sensor
 * does not block, so there is nothing to leave: its overlap is always news. */
static int must_report(const search *s, const tahr__b2_piece *piece, const tahr__flat_near *near)
{
    int leaves = s->flags & TAHR_SWEEP_LEAVE_OVERLAP && !(piece->owner.flags & TAHR_BODY_SENSOR);

    if (near->distance < 0 && !leaves) return 1;
    return f_dot(s->probe->motion, near->normal) < -TAHR__B2_PARALLEL * s->probe->motion_length;
}

/* One piece on its way: where the shape is met, and how far it was at the start. */
typedef struct meeting {
    const tahr__b2_piece *piece;
    double start; /* m, signed distance */
    double fraction;
    int unknown;
    tahr__flat_near near;
} meeting;

/* Does the edge of a one-way body hold what comes down on it? */
static int edge_holds(const search *s, const meeting *m)
{
    const tahr__b2_probe *p = s->probe;
    double reach = 0;

    for (int i = 0; i < p->shape.count; i++)
        reach = d_max(reach, f_dot(p->up, p->shape.corner[i]));
    return tahr__one_way_edge_holds(tahr__b2_lift(p->up, 0), tahr__b2_lift(p->motion, 0),
                                    -(reach + p->shape.radius) - f_dot(m->near.point, p->up), p->margin,
                                    s->sinks_first);
}

/* Is a one-way body there, where it is met? Others always are. */
static int is_there(search *s, const meeting *m, tahr__vec2 face)
{
    const tahr__b2_probe *p = s->probe;
    tahr_vec3 up = tahr__b2_lift(p->up, 0), normal = tahr__b2_lift(m->near.normal, 0);
    int edge, asks = (s->flags & TAHR_SWEEP_DROP) || (m->fraction == 0 && m->start < 0);

    if ((m->piece->owner.flags & (TAHR_BODY_ONE_WAY | TAHR_BODY_SENSOR)) != TAHR_BODY_ONE_WAY) return 1;
    if (s->flags & TAHR_SWEEP_WHOLE) return 1;
    edge = tahr__one_way_edge(normal, tahr__b2_lift(face, 0));
    if (tahr__one_way_blocks(up, normal, m->start, p->margin, s->flags) && (!edge || edge_holds(s, m))) {
        s->edged |= edge;
        return f_dot(p->motion, m->near.normal) < -TAHR__B2_PARALLEL * p->motion_length;
    }
    s->sinks |= asks && tahr__one_way_sinks(up, normal, m->start, p->margin, m->near.crosses);
    return 0;
}

static void write_hit(search *s, const meeting *m, tahr__vec2 face)
{
    const tahr__b2_probe *p = s->probe;
    const tahr__b2_owner *o = &m->piece->owner;
    tahr_hit hit = {0};

    hit.sensor = (o->flags & TAHR_BODY_SENSOR) != 0;
    hit.blocking = !hit.sensor;
    hit.unknown = m->unknown != 0;
    hit.fraction = d_min(1, m->fraction);
    hit.distance = m->near.distance;
    hit.start_overlap = m->fraction == 0 && m->near.distance < 0;
    hit.depth = hit.start_overlap ? -m->near.distance : 0;
    hit.normal = tahr__b2_lift(m->near.normal, 0);
    hit.surface_normal = tahr__b2_lift(face, 0);
    hit.point = v_make(p->origin.x + m->near.point.x, p->origin.y + m->near.point.y, p->origin.z);
    hit.walkable_rule = o->walkable_rule;
    hit.walkable_angle = o->walkable_angle;
    hit.surface = o->surface;
    hit.body = o->body;
    hit.feature = tahr__b2_feature(m->piece, &m->near);
    keep(s, &hit);
}

/* Takes a meeting, unless it is from behind, not approached, or a seam. Returns 1 if it was a seam: then what lies
 * behind it may still be met. */
static int report(search *s, meeting *m)
{
    tahr__vec2 direction = f_make(-s->probe->motion.x, -s->probe->motion.y), face;

    if (!tahr__b2_in_front(m->piece, &m->near)) return 0;
    tahr__b2_leave(s->probe, m->piece, &m->near);
    face = tahr__b2_face(m->piece, &m->near, direction);
    if (!is_there(s, m, face) || !must_report(s, m->piece, &m->near)) return 0;
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
        if (over < 0 || t > limit_of(s)) continue;
        tahr__flat_measure(&p->shape, place_at(s, t), f, 0, &m->near);
        if (m->near.part != i || m->near.distance > p->margin + ARRIVED) continue;
        m->fraction = t;
        report(s, m);
    }
}

/* A tangent of a convex function lies below it: a step to its root never overshoots. Returns 1 if they meet. */
static int advance(search *s, meeting *m)
{
    const tahr__b2_probe *p = s->probe;
    double t = m->fraction, limit = limit_of(s);

    for (int i = 0; i < MAX_TANGENTS; i++) {
        double gap = m->near.distance - p->margin, speed = -f_dot(p->motion, m->near.normal);
        m->fraction = t;
        if (gap <= ARRIVED && i > 0) return 1;
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

static void run(search *s, int sinks)
{
    s->sensor_count = s->lost = 0;
    s->edged = s->sinks = s->found = 0;
    s->sinks_first = sinks;
    tahr__b2_each(s->probe, visit, s);
}

tahr_status tahr__b2_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                           uint32_t capacity, uint32_t *count)
{
    tahr__b2_probe probe = {.scene = self,
                            .context = context,
                            .margin = query->margin,
                            .origin = query->position,
                            .motion = {query->motion.x, query->motion.y},
                            .mask = query->mask,
                            .ignore_body = query->ignore_body,
                            .only_body = (query->flags & TAHR_SWEEP_ONLY_BODY) != 0,
                            .leaves_out = query->flags & TAHR_SWEEP_SENSORS ? TAHR__B2_SOLIDS
                                          : capacity == 1                   ? TAHR__B2_SENSORS
                                                                            : 0u};
    search s;
    tahr_status status;
    int lost = 0;

    *count = 0;
    s.probe = &probe;
    s.flags = query->flags;
    probe.motion_length = f_length(probe.motion);
    status = tahr__b2_probe_shape(&probe, &query->shape, query->up);
    if (status >= 0) status = tahr__b2_probe_check(&probe, query->motion);
    if (status < 0) return status;
    run(&s, 0);
    if (s.edged && s.sinks) run(&s, 1); /* which edges hold was not known before all had been asked */
    *count = write_hits(&s, hits, capacity, &lost);
    return lost || (s.lost && capacity > 1) ? TAHR_TRUNCATED : TAHR_OK;
}

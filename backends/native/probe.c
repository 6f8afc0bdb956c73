/* SPDX-License-Identifier: MIT
 * probe.c: one shape against one primitive: when they meet (flight.c) and what that amounts to. */
#include "../common/graze.h"
#include "../common/one_way.h"
#include "flight.h"
#include "leave.h"
#include "plane.h"

enum { TARGETS = 5 };

int tahr__named_before(const tahr__found *a, const tahr__found *b)
{
    if (a->body != b->body) return a->body < b->body;
    return a->feature != b->feature ? a->feature < b->feature : a->item < b->item;
}

int tahr__found_before(const tahr__found *a, const tahr__found *b)
{
    if (a->overlap != b->overlap) return a->overlap > b->overlap;
    if (a->overlap && a->gap != b->gap) return a->gap < b->gap;
    return a->t != b->t ? a->t < b->t : tahr__named_before(a, b);
}

double tahr__box_extent(const tahr__query *query, tahr_vec3 n)
{
    return tahr__core_extent(&query->core, n);
}

/* Signed distance at the start. 0 if the primitive cannot matter (the inside of a box that is not entered). */
static int probe_start(const tahr__query *query, const tahr__prim *prim, tahr__probe *out)
{
    const tahr__core *core = &query->core;
    tahr_vec3 centre = query->start;
    if (prim->item & TAHR__ITEM_SOLID) return tahr__leave_solid(query, prim, out);
    out->witness.normal = v_make(0, 0, 0);
    out->witness.beside = 0;
    tahr__flight_measure(query, prim, centre, &out->witness);
    double touch = query->radius + prim->radius, distance = out->witness.distance;
    out->gap = distance - touch;
    int crosses_box = distance <= 0 && (prim->kind & TAHR__OF_BOX); /* its inside answers */
    if (core->axis_count == 3 && distance < TAHR__BLURRED && !(prim->item & TAHR__ITEM_ROUND) && !crosses_box &&
        tahr__box_touches(core, centre, &prim->facet, &out->witness)) {
        out->witness.distance = distance;
        return 1;
    }
    if (out->witness.distance > 0 || (core->axis_count == 0 && out->witness.feature == TAHR__FACE)) return 1;
    return tahr__leave_surface(query, prim, out);
}

static void found_fill(const tahr__query *query, const tahr__prim *prim, const tahr__probe *probe,
                       const tahr__contact_normals *normals, tahr__found *out)
{
    uint32_t solid = prim->item & TAHR__ITEM_SOLID;
    out->gap = probe->gap;
    out->normal = normals->normal;
    out->face = normals->face;
    out->point = probe->witness.point;
    if (query->core.axis_count == 1) {
        out->point = tahr__touch_middle(prim, &probe->witness, v_mad(query->start, query->motion, out->t));
    }
    if (prim->radius > 0) out->point = v_mad(out->point, normals->normal, prim->radius);
    out->overlap = out->unknown = out->edge = 0;
    out->body = prim->body;
    out->item = prim->item;
    out->kind = prim->kind;
    out->surface = prim->surface;
    out->walkable_rule = prim->walkable_rule;
    out->walkable_angle = prim->walkable_angle;
    out->feature = solid ? tahr__leave_face(query, prim, normals->normal) : prim->feature;
}

/* Is the surface being approached? Along the true normals, not those of rounded corners. */
static int approaching(const tahr__query *query, tahr_vec3 normal)
{
    return v_dot(query->motion, normal) < -TAHR__PARALLEL * query->motion_length;
}

/* So little that it may only pass an edge? */
static int hardly_approaching(const tahr__query *query, tahr_vec3 normal)
{
    return v_dot(query->motion, normal) >= -TAHR__GRAZING * query->motion_length;
}

/* Does the shape only pass what it is within the margin of? */
static int passes(const tahr__flight *f)
{
    const tahr__query *query = f->query;
    const tahr__witness *w = &f->probe.witness;
    double touch = query->radius + f->prim->radius;
    tahr__descent here = {f->probe.gap - query->margin, -v_dot(query->motion, w->normal), f->t}, there = here;
    if (f->probe.gap < 0 || here.gap < -TAHR__GRAZE) return 0;
    tahr__witness next = *w;
    there.fraction = tahr__beyond(&here, touch + query->margin, query->motion_length);
    tahr__flight_measure(query, f->prim, v_mad(query->start, query->motion, there.fraction), &next);
    query->context->narrow_iterations++;
    there.gap = next.distance - touch - query->margin;
    there.speed = -v_dot(query->motion, next.normal);
    return tahr__grazes(&here, &there, query->motion_length, TAHR__GRAZE);
}

/* A contact at the start that is the surface's: does it block? */
static int blocks_at_start(const tahr__flight *f, const tahr__contact_normals *normals, tahr__found *out)
{
    const tahr__query *query = f->query;
    int overlap = f->probe.gap < 0, sensor = (f->prim->kind & TAHR__SENSOR) != 0;
    int leaving_counts = overlap && (sensor || !(query->flags & TAHR_SWEEP_LEAVE_OVERLAP));
    if (!leaving_counts && !approaching(query, normals->normal)) return 0;
    if (!leaving_counts && hardly_approaching(query, normals->normal) && passes(f)) return 0;
    out->t = 0;
    found_fill(query, f->prim, &f->probe, normals, out);
    out->overlap = (uint32_t)overlap;
    return 1;
}

/* Local frames have up along +z. */
static const tahr_vec3 UP = {0, 0, 1};

/* Is a one-way body there at this contact? What was met only because a nearer neighbour is not there is not there
 * either. */
static int is_one_way_there(const tahr__flight *f, const tahr__contact_normals *normals, int at_start, tahr__found *out)
{
    const tahr__query *query = f->query;
    double nearest = query->flags & TAHR_SWEEP_DROP ? query->margin : 0;
    tahr_vec3 n = normals->normal;
    if (!tahr__one_way_blocks(UP, n, f->began, query->margin, query->flags) ||
        (!at_start && f->probe.gap < nearest - tahr__one_way_rounding(query->margin))) {
        return 0;
    }
    out->edge = (uint32_t)tahr__one_way_edge(n, normals->face);
    if (!out->edge) return f->began >= 0 || approaching(query, n);
    double below = query->start.z - tahr__core_extent(&query->core, UP) - query->radius - f->probe.witness.point.z;
    return tahr__one_way_edge_holds(UP, query->motion, below, query->margin, (int)query->sinks);
}

static int judge_one_way(const tahr__flight *f, const tahr__contact_normals *normals, int at_start, tahr__found *out)
{
    int inside = (f->prim->item & TAHR__ITEM_SOLID) || f->probe.witness.distance <= 0;
    if (!is_one_way_there(f, normals, at_start, out)) {
        int drops = (f->query->flags & TAHR_SWEEP_DROP) != 0, gone = drops || (at_start && f->began < 0);
        int sinks = tahr__one_way_sinks(UP, normals->normal, f->began, f->query->margin, inside);
        return gone && sinks ? TAHR__SINKS : TAHR__FREE;
    }
    uint32_t edge = out->edge;
    if (!approaching(f->query, normals->normal)) return TAHR__FREE;
    out->t = at_start ? 0 : f->t;
    found_fill(f->query, f->prim, &f->probe, normals, out);
    out->overlap = at_start && f->probe.gap < 0;
    out->edge = edge;
    return TAHR__BLOCKED;
}

/* What a contact of this surface amounts to. at_start: found without moving. */
static int judge(const tahr__flight *f, const tahr__contact_normals *normals, int at_start, tahr__found *out)
{
    int one_way = (f->prim->kind & TAHR__ONE_WAY) && !(f->query->flags & TAHR_SWEEP_WHOLE);
    if (one_way) return judge_one_way(f, normals, at_start, out);
    if (at_start) {
        if (blocks_at_start(f, normals, out)) return TAHR__BLOCKED;
        out->gap = f->probe.gap;
        return TAHR__BESIDE;
    }
    if (!approaching(f->query, normals->normal)) return TAHR__FREE;
    if (hardly_approaching(f->query, normals->normal) && passes(f)) return TAHR__FREE;
    out->t = f->t;
    found_fill(f->query, f->prim, &f->probe, normals, out);
    return TAHR__BLOCKED;
}

/* From where a margin was reached that is more than what was asked for: along the tangent, which is never late. */
static int go_the_rest(const tahr__flight *f, double limit, tahr__found *out)
{
    double rest = d_min(f->query->surplus, out->gap - f->query->margin + f->query->surplus);
    if (rest <= 0) return TAHR__BLOCKED;
    out->gap -= rest;
    out->t += rest / -v_dot(f->query->motion, f->probe.witness.normal);
    return out->t <= limit ? TAHR__BLOCKED : TAHR__FREE;
}

/* Goes on until something is decided. A contact that belongs to a nearer neighbour is not this triangle's: its turn
 * comes when it is as near as that neighbour was, at the latest when it is as near as anything beside the start
 * (beside, a gap). The first time it steps back instead: most often the neighbour blocks before. */
static int fly(tahr__flight *f, double limit, const double *beside, tahr__found *out)
{
    const tahr__query *query = f->query;
    double touch = query->radius + f->prim->radius;
    int at_start = f->probe.gap <= query->margin && f->targets == 0 && f->steps == 0;
    for (int i = f->targets; i < TARGETS; i++, at_start = 0) {
        f->targets = i;
        int arrived = at_start ? 1 : tahr__flight_arrive(f, limit, i == 0 && f->steps == 0);
        if (arrived == 0) return TAHR__FREE;
        if (!at_start) f->probe.gap = f->probe.witness.distance - touch;
        tahr__contact_normals normals;
        const double lowest = touch + (beside ? d_min(*beside, query->margin) : 0);
        normals.measure = beside != NULL;
        /* One that is nearer and how near need not be known where it changes nothing below. */
        normals.enough = arrived < 0 ? -1 : i < TARGETS - 2 ? lowest : INFINITY;
        tahr_vec3 centre = v_mad(query->start, query->motion, f->t);
        int verdict = tahr__resolve(query, f->prim, centre, &f->probe.witness, query->motion, &normals);
        if (verdict == TAHR__REJECTED) return TAHR__FREE;
        if (verdict == TAHR__ACCEPTED || arrived < 0) {
            int answer = judge(f, &normals, at_start, out);
            out->unknown = arrived < 0;
            return answer == TAHR__BLOCKED && !at_start && query->surplus > 0 ? go_the_rest(f, limit, out) : answer;
        }
        out->t = f->t;
        if (!beside) return TAHR__LATER;
        f->target = (i < TARGETS - 2 ? d_max(normals.closer, lowest) : lowest) - 10 * TAHR__ARRIVED;
        /* The core itself is in something that it may leave: nothing of this surface can be nearer. */
        if (f->target <= 0) return TAHR__FREE;
    }
    return TAHR__FREE;
}

/* Does a face (its exact unit normal) that is met straight over its inside stop the motion there, front first? Asked at
 * a time before which nothing happens. */
static inline int stops_at_face(const tahr__query *query, const tahr__prim *prim, tahr_vec3 face, double t,
                                const tahr__witness *w, tahr__found *out)
{
    double rest = w->distance - (query->radius + query->margin), rate = v_dot(query->motion, w->normal);
    if (rest > TAHR__ARRIVED || w->distance < query->radius || w->distance < TAHR__BLURRED) return 0;
    if (!(v_dot(face, w->normal) > 0.999) || rate >= -TAHR__PARALLEL * query->motion_length) return 0;
    if (hardly_approaching(query, face)) return 0;
    tahr__probe probe = {*w, w->distance - query->radius};
    tahr__contact_normals normals = {.normal = face, .face = face};
    out->t = t;
    found_fill(query, prim, &probe, &normals, out);
    return 1;
}

int tahr__probe_face(const tahr__query *query, const tahr__prim *prim, tahr_vec3 face, double t, tahr__found *out)
{
    tahr__witness w;
    if (query->core.axis_count != 0 || (prim->kind & (TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR))) return 0;
    w.beside = 0;
    tahr__point_face(v_mad(query->start, query->motion, t), &prim->facet, &w);
    if (!stops_at_face(query, prim, face, t, &w, out)) return 0;
    query->context->narrow_tests++;
    query->context->narrow_iterations++;
    return 1;
}

/* What most motions are stopped by: the inside of a face, at the time before which nothing happens, by the same
 * operations as in flight, without what can find nothing there. 0: it is not so plain. */
static inline int lands_on_face(const tahr__flight *f, tahr__found *out)
{
    const uint32_t other = TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR;
    const tahr__prim *prim = f->prim;
    const tahr__witness *w = &f->probe.witness;
    if (w->feature != TAHR__FACE || (prim->kind & other) || f->query->core.axis_count > 1) return 0;
    tahr_vec3 face = prim->kind & TAHR__FACELESS ? tahr__heights_face(f->query, prim) : prim->face;
    if (v_dot(face, w->normal) < 0 && (prim->kind & TAHR__TWO_SIDED)) face = v_scale(face, -1);
    return stops_at_face(f->query, prim, face, f->t, w, out);
}

static int take_off(tahr__flight *f, const tahr__ask *ask, tahr__found *out)
{
    const tahr__query *query = f->query;
    const tahr__prim *prim = f->prim;
    f->t = ask->earliest;
    f->target = query->radius + prim->radius + query->margin;
    query->context->narrow_iterations++;
    if (f->t > 0 && (prim->kind & TAHR__ONE_WAY) && (query->flags & TAHR_SWEEP_DROP)) f->t = 0;
    if (f->t > 0) {
        f->probe.witness.beside = 0;
        tahr__flight_measure(query, prim, v_mad(query->start, query->motion, f->t), &f->probe.witness);
        f->probe.gap = query->margin + 1; /* it is beyond the margin, by how much does not matter */
    } else if (!probe_start(query, prim, &f->probe)) {
        return TAHR__FREE;
    }
    f->began = f->probe.gap;
    if (lands_on_face(f, out)) return TAHR__BLOCKED;
    return fly(f, ask->limit, ask->beside, out);
}

/* Leaps find out whether anything is met, which is seldom; what is met, and when, Newton alone says, from where the
 * first leap began: along a graze any of many places is near enough, and which one it is should not depend on how the
 * others were left out. */
int tahr__probe_sweep(const tahr__query *query, const tahr__prim *prim, const tahr__ask *ask, tahr__found *out)
{
    tahr__flight f;
    f.query = query;
    f.prim = prim;
    f.leaps = 1;
    f.steps = f.targets = 0;
    query->context->narrow_tests++;
    int answer = take_off(&f, ask, out);
    if (answer == TAHR__BLOCKED && f.leaps > 1) {
        f.leaps = 0;
        f.target = f.before.target;
        f.t = f.before.t;
        f.probe.witness = f.before.witness;
        f.steps = f.before.steps;
        f.targets = f.before.targets;
        answer = fly(&f, ask->limit, ask->beside, out);
    }
    return answer;
}

int tahr__probe_touch(const tahr__query *query, const tahr__prim *prim, double margin, tahr__found *out)
{
    if (plane_earliest(query, prim, 1.0) > 1 || edges_earliest(query, prim, 1.0, 0) > 1) return 0;
    query->context->narrow_tests++;
    query->context->narrow_iterations++;
    tahr__probe probe;
    tahr__contact_normals normals;
    normals.measure = 0;
    if (!probe_start(query, prim, &probe) || probe.gap > margin) return 0;
    tahr_vec3 toward = v_scale(probe.witness.normal, -1);
    if (tahr__resolve(query, prim, query->start, &probe.witness, toward, &normals) != TAHR__ACCEPTED) return 0;
    if ((prim->kind & TAHR__ONE_WAY) && (!tahr__one_way_blocks(UP, normals.normal, probe.gap, margin, 0) ||
                                         tahr__one_way_edge(normals.normal, normals.face))) {
        return 0;
    }
    out->t = 0;
    found_fill(query, prim, &probe, &normals, out);
    out->overlap = probe.gap < 0;
    return 1;
}

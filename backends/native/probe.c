/* SPDX-License-Identifier: MIT
 * probe.c: one shape against one primitive: distance, and the time at which it falls to the target.
 *
 * The distance between convex sets under translation is a convex function of time. Newton's method from the left on a
 * convex function never passes the root: every iterate is proven free. A plane is reached in one step, a curved contact
 * quadratically. */
#include "../common/graze.h"
#include "../common/one_way.h"
#include "plane.h"
#include "scene.h"

enum { ITERATIONS = 64, TARGETS = 5 };

/* Below this distance (m) the direction between two points is rounding; the last one that was clear is used instead. */
#define BLURRED 1e-9
/* Of the sizes of two boxes: nearer than this they touch. Their faces leave what they touch to the inside, so the
 * inside must not call it outside by rounding. */
#define TOUCHING 1e-12
/* Every so many steps a leap is tried. */
#define LEAPS 4
/* The square of the sine between a surface and a motion that meets it, from which on Newton arrives soon. */
#define STEEP 1e-4
/* The square of the sine up to which an edge of the core is across a normal. */
#define ACROSS 1e-12
/* How much nearer than the margin (m) a motion may pass an edge: what the narrow phase promises. */
#define GRAZE 1e-9

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

/* Does a face of the box keep the core out? Most often one does, and then its edges need not be asked. */
static int outside_a_face(const tahr__core *core, const tahr__core *solid, tahr_vec3 off)
{
    for (int i = 0; i < solid->axis_count; i++) {
        tahr_vec3 n = solid->axis[i];
        if (fabs(v_dot(n, off)) > (v_dot(n, n) + tahr__core_extent(core, n)) * (1 + TOUCHING)) return 1;
    }
    return 0;
}

/* How far and which way out of a hull or box; negative: not inside. */
static double leave_hull(const tahr__query *query, const tahr__body *body, tahr_vec3 centre, tahr_vec3 *normal)
{
    tahr__map map = tahr__map_make(query->frame, body);
    return tahr__hull_leave(&query->core, centre, &body->mesh, &map, normal);
}

/* Is the core certainly outside of a box that is not turned? Most often it is. */
static int beside_box(const tahr__query *query, const tahr__body *body, tahr_vec3 centre)
{
    const tahr_vec3 half = body->half_extents, e = query->extent, o = query->frame->origin;
    const double more = 1 + 2 * TOUCHING;
    if (query->frame->turned || body->turned) return 0;
    tahr_vec3 off = v_abs(v_sub(centre, v_sub(body->position, o)));
    return (off.x > (half.x + e.x) * more) | (off.y > (half.y + e.y) * more) | (off.z > (half.z + e.z) * more);
}

static double leave_box(const tahr__query *query, const tahr__body *body, tahr_vec3 centre, tahr_vec3 *normal)
{
    if (beside_box(query, body, centre)) return -1;
    tahr__map map = tahr__map_make(query->frame, body);
    tahr__core solid;
    solid.axis_count = 3;
    solid.axis[0] = v_make(body->half_extents.x, 0, 0);
    solid.axis[1] = v_make(0, body->half_extents.y, 0);
    solid.axis[2] = v_make(0, 0, body->half_extents.z);
    for (int i = 0; i < 3 && map.turned; i++)
        solid.axis[i] = m_apply(&map.turn, solid.axis[i]);
    if (outside_a_face(&query->core, &solid, v_sub(centre, map.offset))) return -1;
    double depth = tahr__core_leave_solid(&query->core, centre, &solid, map.offset, normal);
    double extent = tahr__core_extent(&solid, *normal) + tahr__core_extent(&query->core, *normal);
    return depth < -TOUCHING * extent ? -1 : d_max(depth, 0);
}

/* The way out of a box or hull that the core has entered, along one of its faces or across a pair of edges. */
static int probe_solid(const tahr__query *query, const tahr__prim *prim, tahr__probe *out)
{
    const tahr__body *body = &query->world->bodies[prim->body];
    tahr_vec3 centre = query->start;
    double depth = body->type == TAHR_BODY_HULL ? leave_hull(query, body, centre, &out->witness.normal)
                                                : leave_box(query, body, centre, &out->witness.normal);
    /* In the plane of a face too: the faces leave what touches them to the inside. */
    if (depth < 0) return 0;
    tahr_vec3 n = out->witness.normal;
    out->witness.distance = 0;
    out->witness.feature = TAHR__FACE;
    out->witness.beside = 0;
    out->witness.point = v_mad(centre, n, depth - tahr__core_extent(&query->core, n));
    out->gap = -depth - query->radius;
    return 1;
}

/* Out of a round body whose axis the core crosses: across both axes, or sideways. */
static double leave_round(const tahr__core *core, const tahr__prim *prim, tahr_vec3 centre, tahr_vec3 *normal)
{
    tahr__core axis;
    axis.axis_count = 1;
    axis.axis[0] = v_scale(v_sub(prim->facet.v[1], prim->facet.v[0]), 0.5);
    double depth = tahr__core_leave_solid(core, centre, &axis, v_add(prim->facet.v[0], axis.axis[0]), normal);
    if (depth >= 0) return depth;
    /* Nothing has a volume here: any way across the axis will do, up if there is none. */
    tahr_vec3 along = core->axis_count ? core->axis[0] : axis.axis[0];
    *normal = v_make(0, 0, 1);
    if (v_dot(along, along) > 0) {
        *normal = v_unit(v_cross(fabs(along.x) < fabs(along.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), along));
    }
    return 0;
}

static unsigned sides_of(const tahr__query *query, const tahr__prim *prim)
{
    if (!(prim->kind & TAHR__TWO_SIDED)) return 1;
    /* Past its edges only from a triangle that stands alone: beyond an edge with a neighbour lies the neighbour. */
    return tahr__stands_alone(query, prim) ? 7 : 3;
}

/* The distance of the core. To a triangle wholly below the lower end of an upright segment that end is the nearest, to
 * one wholly above it the upper one, and a third of the work: of two points over each other that are both above a point
 * of the triangle the lower one is nearer, and tahr__facet_distance comes to that end by the same operations
 * (no_capsule_ends). Of what touches it rounding decides which part is nearest: there the whole is measured. */
static void measure(const tahr__query *query, const tahr__prim *prim, tahr_vec3 centre, tahr__witness *out)
{
    const tahr_vec3 *v = prim->facet.v;
    if (query->core.axis_count == 1) {
        if (out->beside && tahr__segment_again(&query->core, centre, &prim->facet, out)) return;
        out->beside = 0;
        double half = query->core.axis[0].z;
        tahr_vec3 low = v_make(centre.x, centre.y, centre.z - half), high = v_make(centre.x, centre.y, centre.z + half);
        int below = v[0].z <= low.z && v[1].z <= low.z && v[2].z <= low.z;
        int above = v[0].z >= high.z && v[1].z >= high.z && v[2].z >= high.z;
        if ((below | above) && !query->world->no_capsule_ends) {
            tahr__point_facet(below ? low : high, &prim->facet, out);
            if (out->distance > BLURRED) {
                query->context->ends++;
                return;
            }
        }
    }
    tahr__facet_distance(&query->core, centre, &prim->facet, out);
}

/* Signed distance at the start. 0 if the primitive cannot matter (the inside of a box that is not entered). */
static int probe_start(const tahr__query *query, const tahr__prim *prim, tahr__probe *out)
{
    const tahr__core *core = &query->core;
    tahr_vec3 centre = query->start;
    if (prim->item & TAHR__ITEM_SOLID) return probe_solid(query, prim, out);
    out->witness.normal = v_make(0, 0, 0);
    out->witness.beside = 0;
    measure(query, prim, centre, &out->witness);
    double touch = query->radius + prim->radius, distance = out->witness.distance;
    out->gap = distance - touch;
    int crosses_box = distance <= 0 && (prim->kind & TAHR__OF_BOX); /* its inside answers */
    if (core->axis_count == 3 && distance < BLURRED && !(prim->item & TAHR__ITEM_ROUND) && !crosses_box &&
        tahr__box_touches(core, centre, &prim->facet, &out->witness)) {
        out->witness.distance = distance;
        return 1;
    }
    if (out->witness.distance > 0 || (core->axis_count == 0 && out->witness.feature == TAHR__FACE)) return 1;
    double depth;
    if (prim->item & TAHR__ITEM_ROUND) {
        depth = leave_round(core, prim, centre, &out->witness.normal);
    } else {
        if ((prim->kind & TAHR__OF_BOX) && core->axis_count > 0) return 0; /* its inside answers */
        depth = tahr__core_leave_triangle(core, centre, prim->facet.v, sides_of(query, prim), &out->witness.normal);
        out->witness.feature = TAHR__FACE;
    }
    out->gap = -depth - touch;
    return 1;
}

/* Of a box or hull that is left from inside: the face that the way out points through most. */
static uint32_t solid_face(const tahr__query *query, const tahr__prim *prim, tahr_vec3 normal)
{
    const tahr__body *body = &query->world->bodies[prim->body];
    tahr__map map = tahr__map_make(query->frame, body);
    tahr_vec3 n = m_unapply(&map.turn, normal), a = v_abs(n);
    if (body->type == TAHR_BODY_HULL) return tahr__hull_face(&body->mesh, n);
    int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return 2 * (uint32_t)axis + (v_get(n, axis) > 0);
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
    out->feature = solid ? solid_face(query, prim, normals->normal) : prim->feature;
}

/* One primitive under way: where, and the distance it must come down to. */
typedef struct flight {
    const tahr__query *query;
    const tahr__prim *prim;
    double target, t;
    double began; /* the gap at the start, or more than the margin */
    int leaps;    /* 1: allowed, 2: there was one, 0: not */
    tahr__probe probe;
    struct { /* as it was before the first leap */
        double target, t;
        tahr__witness witness;
        int steps, targets;
    } before;
    int steps, targets; /* where it goes on */
    int wanders;        /* 1: it did not come straight to a corner */
} flight;

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
static int passes(const flight *f)
{
    const tahr__query *query = f->query;
    const tahr__witness *w = &f->probe.witness;
    double touch = query->radius + f->prim->radius;
    tahr__descent here = {f->probe.gap - query->margin, -v_dot(query->motion, w->normal), f->t}, there = here;
    if (f->probe.gap < 0 || here.gap < -GRAZE) return 0;
    tahr__witness next = *w;
    there.fraction = tahr__beyond(&here, touch + query->margin, query->motion_length);
    measure(query, f->prim, v_mad(query->start, query->motion, there.fraction), &next);
    query->context->narrow_iterations++;
    there.gap = next.distance - touch - query->margin;
    there.speed = -v_dot(query->motion, next.normal);
    return tahr__grazes(&here, &there, query->motion_length, GRAZE);
}

/* A contact at the start that is the surface's: does it block? */
static int blocks_at_start(const flight *f, const tahr__contact_normals *normals, tahr__found *out)
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

/* When the two nearest points that were found last are at the target, or nearest, if they stay the nearest; along an
 * edge of either the point goes with the other. */
static double foresee(const flight *f)
{
    const tahr__query *query = f->query;
    const tahr__witness *w = &f->probe.witness;
    const double target = f->target + 0.9 * TAHR__ARRIVED;
    tahr_vec3 m = query->motion;
    if (w->feature > TAHR__FACE && w->feature < TAHR__CORNER) {
        const uint32_t i = w->feature - TAHR__EDGE;
        tahr_vec3 e = v_sub(f->prim->facet.v[(i + 1) % 3], f->prim->facet.v[i]);
        m = v_mad(m, e, -v_dot(m, e) / v_dot(e, e));
    }
    for (int i = 0; i < query->core.axis_count; i++) {
        const tahr_vec3 a = query->core.axis[i];
        const double along = v_dot(a, w->normal), a2 = v_dot(a, a);
        if (along * along <= ACROSS * a2) m = v_mad(m, a, -v_dot(m, a) / a2);
    }
    const double m2 = v_dot(m, m), b = -w->distance * v_dot(w->normal, m),
                 c = w->distance * w->distance - target * target;
    const double rest = b * b - m2 * c;
    if (!(m2 > 0 && b > 0) || rest > STEEP * m2 * target * target) return f->t;
    return f->t + (rest > 0 ? c / (b + sqrt(rest)) : b / m2);
}

/* Newton halves what is left where the way only grazes: instead to where those points tell, if that is farther than
 * next, Newton's step. The distance is convex, so tangents prove what is between: 1: the flight is farther on; 0: it is
 * not; -1: it never arrives. */
static int leap(flight *f, double next, double limit)
{
    const tahr__query *query = f->query;
    const tahr__witness before = f->probe.witness;
    const double rest = before.distance - f->target, rate = v_dot(query->motion, before.normal);
    const double to = d_min(foresee(f), limit);
    if (!(to > next)) return 0;
    tahr__witness w = before;
    f->wanders = 1;
    measure(query, f->prim, v_mad(query->start, query->motion, to), &w);
    query->context->narrow_iterations++;
    const double rest_there = w.distance - f->target, rate_there = v_dot(query->motion, w.normal);
    if (w.distance < BLURRED) return 0;
    if (rest_there > 0 && rate_there < 0) {
        if (f->leaps == 1) {
            f->before.target = f->target;
            f->before.t = f->t;
            f->before.witness = before;
            f->before.targets = f->targets;
        }
        f->t = to;
        f->probe.witness = w;
        return 1;
    }
    if (rest_there <= 0) return 0;
    const double meet = (rest_there - rate_there * (to - f->t) - rest) / (rate - rate_there);
    return rest + rate * meet > TAHR__ARRIVED ? -1 : 0;
}

/* Newton from the left until the distance is target. 1: arrived; 0: never; -1: not decided within the cap. */
static int advance(flight *f, double limit)
{
    const tahr__query *query = f->query;
    const int from = f->steps;
    f->steps = 0;
    for (int i = from; i < ITERATIONS; i++) {
        tahr__witness *w = &f->probe.witness;
        double rest = w->distance - f->target, rate = v_dot(query->motion, w->normal);
        if (rate >= -TAHR__PARALLEL * query->motion_length) return 0;
        if (rest <= TAHR__ARRIVED) return 1;
        double next = f->t + rest / -rate;
        if (next > limit) return 0;
        if (i % LEAPS == 1 && f->leaps) {
            const int leaped = leap(f, next, limit);
            if (leaped > 0 && f->leaps == 1) f->before.steps = i;
            if (leaped != 0) f->leaps = 2;
            if (leaped < 0) return 0;
            if (leaped > 0) continue;
        }
        f->t = next;
        tahr__witness before = *w;
        measure(query, f->prim, v_mad(query->start, query->motion, f->t), w);
        if (w->distance < BLURRED) {
            w->normal = before.normal;
            /* A box that touches may find no point to name, nor a feature of the triangle. */
            if (query->core.axis_count == 3) {
                w->point = before.point;
                w->feature = before.feature;
            }
        }
        f->wanders |= w->feature < TAHR__CORNER || !tahr__same_vec(&w->point, &before.point);
        query->context->narrow_iterations++;
    }
    return -1;
}

/* Is the corner that is touched the nearest of the triangle to q, clear of its edges? */
static int is_off_edges(const flight *f, tahr_vec3 q)
{
    const uint32_t k = f->probe.witness.feature - TAHR__CORNER;
    const tahr_vec3 *v = f->prim->facet.v, off = v_sub(q, v[k]);
    for (uint32_t i = 1; i < 3; i++) {
        const tahr_vec3 e = v_sub(v[(k + i) % 3], v[k]);
        const double along = v_dot(off, e);
        if (!(along < 0 && along * along > 1e-18 * v_dot(off, off) * v_dot(e, e))) return 0;
    }
    return 1;
}

/* A point that comes to a corner does so alike over each of the triangles there to which the corner is nearest all the
 * way; it is that where it is at both ends of a straight way. Only for ways that nothing leaps over (foresee): those
 * hang on the limit too. */
static int comes_again(flight *f, const tahr__corner_met *c)
{
    const tahr__query *query = f->query;
    tahr__witness *w = &f->probe.witness;
    if (!c->flown || f->t != c->from || f->target != c->target || w->distance != c->first.distance ||
        !tahr__same_vec(&w->point, &c->first.point) || !tahr__same_vec(&w->normal, &c->first.normal) ||
        !is_off_edges(f, v_mad(query->start, query->motion, f->t)) ||
        !is_off_edges(f, v_mad(query->start, query->motion, c->t))) {
        return 0;
    }
    f->t = c->t;
    w->distance = c->last.distance;
    w->normal = c->last.normal;
    return 1;
}

/* On the first flight of a primitive, what came to the same corner before is told again. */
static int arrive(flight *f, double limit, int first)
{
    tahr__corner_met *c = f->query->corner;
    const int to_corner = first && c && f->query->core.axis_count == 0 && f->probe.witness.feature >= TAHR__CORNER;
    const double from = f->t;
    if (to_corner) {
        if (comes_again(f, c)) return f->t <= limit;
        c->flown = 0;
        c->first = f->probe.witness;
        f->wanders = 0;
    }
    const int arrived = advance(f, limit);
    if (to_corner && arrived == 1 && !f->wanders) {
        c->flown = 1;
        c->from = from;
        c->target = f->target;
        c->t = f->t;
        c->last = f->probe.witness;
    }
    return arrived;
}

/* Local frames have up along +z. */
static const tahr_vec3 UP = {0, 0, 1};

/* Is a one-way body there at this contact? What was met only because a nearer neighbour is not there is not there
 * either. */
static int is_one_way_there(const flight *f, const tahr__contact_normals *normals, int at_start, tahr__found *out)
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

static int judge_one_way(const flight *f, const tahr__contact_normals *normals, int at_start, tahr__found *out)
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
static int judge(const flight *f, const tahr__contact_normals *normals, int at_start, tahr__found *out)
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
static int go_the_rest(const flight *f, double limit, tahr__found *out)
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
static int fly(flight *f, double limit, const double *beside, tahr__found *out)
{
    const tahr__query *query = f->query;
    double touch = query->radius + f->prim->radius;
    int at_start = f->probe.gap <= query->margin && f->targets == 0 && f->steps == 0;
    for (int i = f->targets; i < TARGETS; i++, at_start = 0) {
        f->targets = i;
        int arrived = at_start ? 1 : arrive(f, limit, i == 0 && f->steps == 0);
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
    if (rest > TAHR__ARRIVED || w->distance < query->radius || w->distance < BLURRED) return 0;
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
static inline int lands_on_face(const flight *f, tahr__found *out)
{
    const uint32_t other = TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR;
    const tahr__prim *prim = f->prim;
    const tahr__witness *w = &f->probe.witness;
    if (w->feature != TAHR__FACE || (prim->kind & other) || f->query->core.axis_count > 1) return 0;
    tahr_vec3 face = prim->kind & TAHR__FACELESS ? tahr__heights_face(f->query, prim) : prim->face;
    if (v_dot(face, w->normal) < 0 && (prim->kind & TAHR__TWO_SIDED)) face = v_scale(face, -1);
    return stops_at_face(f->query, prim, face, f->t, w, out);
}

static int take_off(flight *f, const tahr__ask *ask, tahr__found *out)
{
    const tahr__query *query = f->query;
    const tahr__prim *prim = f->prim;
    f->t = ask->earliest;
    f->target = query->radius + prim->radius + query->margin;
    query->context->narrow_iterations++;
    if (f->t > 0 && (prim->kind & TAHR__ONE_WAY) && (query->flags & TAHR_SWEEP_DROP)) f->t = 0;
    if (f->t > 0) {
        f->probe.witness.beside = 0;
        measure(query, prim, v_mad(query->start, query->motion, f->t), &f->probe.witness);
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
    flight f;
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

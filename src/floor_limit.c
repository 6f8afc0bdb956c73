/* SPDX-License-Identifier: MIT
 * floor_limit.c: where what is straight and flat passes a limit of the rules: the level distance of an edge from the
 * axis, the place on an edge where a face begins, the depth at which a foot meets one thing before another. */
#include <math.h>

#include "floor_look.h"
#include "perch.h"
#include "shape.h"

/* The cosine to ON_FACE. */
static const double ON_FACE_COSINE = 1 - 1e-6;

/* An edge as it is seen from the axis of a foot that touches it. It lies across the normals of its contact and of its
 * face. */
typedef struct edge_seen {
    vec3 along;   /* level; zero if it is upright */
    vec3 away;    /* unit, level: from the axis to where it is nearest, seen from above */
    double off;   /* m, how far that is */
    double level; /* squared cosine of its slope */
} edge_seen;

static edge_seen edge_of(const tahr__step *step, const look *l, const contact *c)
{
    edge_seen e;
    vec3 along = cross(c->face, c->normal), away = step_level(step, sub(c->point, l->position));
    e.along = step_level(step, along);
    e.level = length_squared(e.along) / length_squared(along);
    if (e.level <= SMALL * SMALL) {
        e.along = vec(0, 0, 0);
    } else if (!c->stays) {
        away = add_scaled(away, e.along, -dot(away, e.along) / length_squared(e.along));
    }
    e.level = c->stays ? 1 : e.level;
    e.off = length(away);
    e.away = unit(away);
    return e;
}

/* What becomes of a contact with an edge: a thinner foot passes by it, it begins to need a perch, it is too near the
 * rim of the foot, a foot without its rim passes by it (of an edge that slopes, after that). */
typedef enum limit { PASSES_INNER, NEEDS_PERCH, LEAVES_RIM, PASSES_RIM } limit;

/* m, level, how far away the edge is then. The rules measure how far the contact is: of an edge that slopes it is
 * before or behind where the edge is nearest, and its normal, across the edge, says how far. */
static double distance_at(const tahr__step *step, const edge_seen *e, limit what)
{
    const tahr_config *c = step->config;
    double x = dot(e->away, rotate(step->state.orientation, vec(1, 0, 0)));
    double y = dot(e->away, rotate(step->state.orientation, vec(0, 1, 0)));
    double reach = shape_reach(&step->limits->shape, x, y), perch = max_of(c->perch_threshold, c->edge_tolerance);
    if (c->floor_probe == TAHR_FLOOR_PROBE_SHRUNK) {
        int perches = c->perch_threshold > c->edge_tolerance && what < LEAVES_RIM;
        return reach - c->edge_tolerance - (perches ? step->limits->width - tahr__valid_perch_radius(step) : 0);
    }
    double whole = reach + c->skin, holds = what == NEEDS_PERCH ? reach - perch : whole - c->edge_tolerance;
    if (what == PASSES_INNER || what == PASSES_RIM) {
        return whole - (what == PASSES_RIM ? 2 * c->edge_tolerance : perch);
    }
    double part2 = holds * holds / (whole * whole), level = max_of(e->level, SMALL);
    return whole * sqrt(max_of(1 - (1 - part2) / level, 0));
}

/* The part of the way after which a place, `from` seen from a point, is farther than this from it; NOWHERE if it never
 * is as near. */
static double goes_off(vec3 way, vec3 from, double far)
{
    double a = length_squared(way), b = dot(from, way), c = length_squared(from) - far * far, root2 = b * b - a * c;
    return root2 < 0 || !(a > 0) ? NOWHERE : (sqrt(root2) - b) / a;
}

static double passes_edge(const tahr__step *step, const looks *s, const look *l, const contact *c, limit what)
{
    edge_seen e = edge_of(step, l, c);
    double far = distance_at(step, &e, what);
    if (c->stays) {
        return l->at + goes_off(step_level(step, s->way), scale(e.away, -e.off), far);
    }
    double speed = -dot(e.away, s->way);
    if (!(speed > SMALL * length(s->way))) {
        return NOWHERE;
    }
    return l->at + (far - e.off) / speed;
}

/* m, by where its axis is: the radius, skin and all, of a round foot that touches an edge; 0 if it is right below. */
static double radius_at(const tahr__step *step, const look *l, const contact *edge)
{
    vec3 level = step_level(step, edge->normal);
    double size2 = length_squared(level);
    return size2 < SMALL * SMALL ? 0 : -dot(sub(edge->point, l->position), level) / size2;
}

/* What a round foot touches on either side of the place where it passes from an edge to a face. */
typedef struct passing {
    const look *look; /* at the edge, */
    const contact *edge, *face;
    double thinner; /* m, by which the foot is thinner than the one that touched it */
    int tilts;      /* 1: where it is no longer ON_FACE, farther round the edge */
} passing;

/* It does so on the edge, with the normal of the face (or that, tilted). */
static double passes_face(const tahr__step *step, const looks *s, const passing *p)
{
    vec3 up = step->state.up, normal = p->face->face;
    vec3 across = cross(up, edge_of(step, p->look, p->edge).along);
    double speed = dot(across, s->way), radius = radius_at(step, p->look, p->edge) - p->thinner;
    int along = speed * speed <= SMALL * SMALL * length_squared(across) * length_squared(s->way);
    if (along || radius <= 0) {
        return NOWHERE;
    }
    if (p->tilts) {
        normal = add_scaled(scale(normal, ON_FACE_COSINE), unit(reject(p->edge->normal, normal)), ON_FACE);
    }
    vec3 centre = add_scaled(p->edge->point, step_level(step, normal), radius);
    return dot(across, sub(centre, s->from)) / speed;
}

/* m down for all of the way, at which a contact is met; as far as was looked if nothing is. */
static double depth_rate(const tahr__step *step, const looks *s, const contact *c)
{
    return c->kind == FREE ? 0 : dot(c->normal, s->way) / dot(c->normal, step->state.up);
}

/* Where what was met on one side lies as deep as what was met on the other. */
static double same_depth(const tahr__step *step, const looks *s, const contact *a, const contact *b)
{
    vec3 up = step->state.up;
    double up_a = dot(a->normal, up), up_b = dot(b->normal, up);
    if ((a->kind != FREE && up_a < SMALL) || (b->kind != FREE && up_b < SMALL)) {
        return NOWHERE;
    }
    double rate_a = depth_rate(step, s, a), rate_b = depth_rate(step, s, b);
    double at_a = a->depth - s->inside.at * rate_a, at_b = b->depth - s->outside.at * rate_b, rates = rate_a - rate_b;
    if (rates * rates <= 1e-12 * length_squared(s->way)) {
        return NOWHERE;
    }
    return (at_b - at_a) / rates;
}

/* Where a round foot that is lowered onto a face on one side, or onto nothing within reach, and onto an edge that is
 * not the face's on the other, meets both at once: as deep as the face is, its middle is a radius away from the line of
 * the edge. */
static double meets_edge(const tahr__step *step, const looks *s, const passing *p, const look *at_face)
{
    vec3 up = step->state.up, along = unit(cross(p->edge->face, p->edge->normal));
    double radius = radius_at(step, p->look, p->edge);
    if (radius <= 0 || (p->face->kind != FREE && dot(p->face->normal, up) < SMALL)) {
        return NOWHERE;
    }
    double rate = depth_rate(step, s, p->face), depth = p->face->depth + (p->look->at - at_face->at) * rate;
    vec3 from = add_scaled(scale(p->edge->normal, radius), up, p->edge->depth - depth);
    vec3 way = add_scaled(s->way, up, -rate);
    if (!p->edge->stays) {
        from = reject(from, along);
        way = reject(way, along);
    }
    double a = length_squared(way), b = dot(from, way), c = length_squared(from) - radius * radius;
    double root2 = b * b - a * c;
    if (root2 < 0 || a <= SMALL * SMALL * length_squared(s->way)) {
        return NOWHERE;
    }
    double root = sqrt(root2), first = (-b - root) / a, second = (-b + root) / a;
    return p->look->at + (first * first < second * second ? first : second);
}

static int same_direction(vec3 a, vec3 b)
{
    return length_squared(cross(a, b)) <= ON_FACE * ON_FACE;
}

static int is_on(const contact *face, const contact *edge)
{
    double off = dot(face->face, sub(edge->point, face->point));
    return off < 1e-6 && off > -1e-6; /* m: what every backend knows of a place */
}

/* Where the face that an edge belongs to turns its back: the edge is touched from beside, in the plane of the face. */
static double turns_round(const tahr__step *step, const looks *s, const contact *a, const contact *b)
{
    contact side = {.kind = FACE, .face = unit(reject(b->normal, a->face)), .point = b->point};
    passing p = {.look = &s->outside, .edge = b, .face = &side};
    return is_on(a, b) ? passes_face(step, s, &p) : NOWHERE;
}

/* Where the same foot meets at once what it met on either side. */
static double meets_both(const tahr__step *step, const looks *s, const contact *a, const contact *b, int whole)
{
    if (a->kind != FREE && b->kind != FREE && !shape_is_round(&step->limits->shape)) {
        /* Flat sides and straight edges alike go down evenly; how far an edge sticks out of its face does not. */
        return same_direction(a->face, b->face) ? NOWHERE : same_depth(step, s, a, b);
    }
    if (a->kind == EDGE && b->kind == FREE) { /* out of reach */
        passing p = {.look = &s->inside, .edge = a, .face = b};
        return meets_edge(step, s, &p, &s->outside);
    }
    if (a->kind == EDGE && b->kind == EDGE && dot(a->normal, a->face) * dot(b->normal, a->face) <= 0) {
        return turns_round(step, s, a, b);
    }
    if (a->kind == EDGE && b->kind == EDGE && same_direction(a->face, b->face)) {
        return NOWHERE;
    }
    if (a->kind != b->kind && a->kind != FREE && b->kind != FREE) {
        passing p = {.look = &s->inside, .edge = a, .face = b};
        if (a->kind == FACE) {
            p = (passing){.look = &s->outside, .edge = b, .face = a};
        }
        if (is_on(p.face, p.edge)) {
            p.tilts = whole && same_direction(p.face->face, p.edge->face);
            return passes_face(step, s, &p);
        }
        return meets_edge(step, s, &p, a->kind == FACE ? &s->inside : &s->outside);
    }
    return same_depth(step, s, a, b);
}

/* By what the same foot met on either side: where it meets both at once, or has passed the edge before. */
static double between(const tahr__step *step, const looks *s, const contact *a, const contact *b, int whole)
{
    const double inside = s->inside.at, both = meets_both(step, s, a, b, whole);
    if (a->kind != EDGE || (b->kind != FREE && !shape_is_round(&step->limits->shape))) {
        return both;
    }
    double passes = passes_edge(step, s, &s->inside, a, whole ? LEAVES_RIM : PASSES_INNER);
    passes = whole && passes < inside ? passes_edge(step, s, &s->inside, a, PASSES_RIM) : passes;
    if (b->kind != FREE && !is_between(s, passes)) {
        return both;
    }
    return both > inside && both < passes ? both : passes;
}

/* Where an edge comes so far out that it needs a perch. Or later, where the thinner foot passes from the edge to the
 * face below it, which is too steep. */
static double begins_to_perch(const tahr__step *step, const looks *s)
{
    const look *out = &s->outside;
    double begins = passes_edge(step, s, out, &out->outer, NEEDS_PERCH);
    passing p = {.look = out, .edge = &out->outer, .face = &out->inner, .thinner = step->config->perch_threshold};
    return out->inner.kind == FACE && is_on(p.face, p.edge) ? max_of(begins, passes_face(step, s, &p)) : begins;
}

/* By the thinner foot that did not hold. */
static double ends_perch(const tahr__step *step, const looks *s)
{
    const look *in = &s->inside, *out = &s->outside;
    if (in->known && in->has_inner) {
        return between(step, s, &in->inner, &out->inner, 0);
    }
    if (out->outer.kind != EDGE) {
        return NOWHERE;
    }
    if (out->inner.kind == FREE) {
        return passes_edge(step, s, out, &out->outer, PASSES_INNER);
    }
    return begins_to_perch(step, s);
}

/* The likeliest place, NOWHERE if nothing tells of one. What lies off the way that is left was told by something else
 * than what ends the floor; before its begin, which is a floor, it may well end right there. */
double tahr__looks_predict(const tahr__step *step, const looks *s)
{
    const look *in = &s->inside, *out = &s->outside;
    double part = out->has_inner ? ends_perch(step, s) : NOWHERE, off = part;
    int holds_itself = in->known && !in->perching && in->outer.kind == FACE;
    if (in->known && (holds_itself || !is_between(s, part))) { /* then by its face first, and by a perch after it */
        double leaves = between(step, s, &in->outer, &out->outer, 1);
        part = !holds_itself || is_between(s, leaves) ? leaves : part;
    }
    if (!is_between(s, part) && out->outer.kind == EDGE) {
        part = passes_edge(step, s, out, &out->outer, PASSES_INNER);
        off = off == NOWHERE ? part : off;
    }
    if (!is_between(s, part) && in->known && in->outer.kind == EDGE) {
        part =
            passes_edge(step, s, in, in->has_inner && in->inner.kind == EDGE ? &in->inner : &in->outer, PASSES_INNER);
    }
    if (is_between(s, part)) {
        return part;
    }
    return !in->known && off > NOWHERE && off < in->at ? in->at : NOWHERE;
}

/* SPDX-License-Identifier: MIT
 * floor_end.c: where on a way a floor ends.
 *
 * Mostly that is where something that a look measures passes a limit of the rules: the level distance of an edge from
 * the axis, the place on an edge where a face begins, the depth at which a foot meets one thing before another. What is
 * straight and flat then says the very place, and a look on either side of it proves it; where it bends every look
 * brings a better one, as in Newton's method. What ends for another reason (a level foot, a backend that lies) is found
 * by halving. Predictions are held near the middle as the ITP method does (Oliveira and Takahashi 2020), so that all
 * the wrong ones together cost no more than a few looks. */
#include "floor_end.h"

#include <math.h>

#include "floor.h"
#include "nearby.h"
#include "perch.h"
#include "rim.h"
#include "shape.h"

/* Half widths of the character (1e-9 m of one 0.7 m wide) beside a predicted place that is looked at, above the
 * rounding of an exact sweep past an edge; times FARTHER where that came out on the wrong side (what is exact to 1e-6 m
 * is found at once then), and by NEARER less where it did not. */
static const double BESIDE = 3e-9, FARTHER = 1024, NEARER = 32;

/* Radians, and parts of a length: what is less is level, upright or along, and would make a quotient of rounding. */
static const double SMALL = 1e-3;

/* Sine: a face that a contact leans no more than this behind may be met from either side. */
static const double BEHIND = 2e-6;

/* m: what every backend knows of a point. */
static const double SAME_POINT = 1e-9;

/* find_whole takes a contact for one on a face whose normal is within this of the face's: cosine, and sine. */
static const double ON_FACE_COSINE = 1 - 1e-6, ON_FACE = 1.4142132088085646e-3;

/* The place is known to 2^-ROUNDS of the way: that many looks by halving, and no more than LOST and PROOFS besides. */
enum { ROUNDS = 20, LOST = 2, PROOFS = 2 };

/* As many looks seldom are all. A backend that could not keep what is near the whole step may keep what is near this
 * way: from here on it is worth asking. */
enum { MANY = 6 };

/* Predictions that change by no more than this part of the way that is left agree. */
static const double STEADILY = 0.03;

/* What looks tell changes by less than this of how far they are apart, where it leads to anything: half at a place that
 * is touched and not passed. */
static const double STEEPEST = 0.8, EVENLY = 0.1;

/* No part of a way. */
static const double NOWHERE = -1e300;

/* What a foot met. */
typedef struct contact {
    enum { FREE, FACE, EDGE } kind;
    int stays; /* 1: at the same point as from elsewhere: of a corner, or of an edge that is gone straight across */
    vec3 point, normal, face;
    double depth; /* m down */
} contact;

typedef struct look {
    double at; /* part of the way */
    vec3 position;
    contact outer, inner; /* of the foot, and of a thinner one */
    int known, perching, has_inner;
} look;

typedef struct search {
    vec3 from, way;
    double beside, least; /* parts of the way beside a prediction: now, and the smallest */
    double predicted;     /* by what was known before the last look */
    double told, told_at; /* what the last look but one told, and where it was */
    double rate;          /* at which that changed with the place */
    double latest;        /* part of the way of the last look */
    int surprised;        /* 1: it came out on the other side of that */
    int proves;           /* 1: it is beside that */
    int tried;            /* 1: right behind the begin was looked at */
    int doubts;           /* 1: what straight edges tell was wrong */
    uint32_t steady;      /* looks that changed nothing about the prediction */
    uint32_t lost;        /* looks that may still be lost */
    look inside, outside; /* the nearest on either side, */
    look further[2];      /* and the last before it: outside, inside */
} search;

static contact contact_of(vec3 point, vec3 normal, vec3 face, double depth)
{
    int is_face = length_squared(cross(face, normal)) <= ON_FACE * ON_FACE;
    contact c = {
        .kind = is_face ? FACE : EDGE, .stays = 0, .point = point, .normal = normal, .face = face, .depth = depth};
    return c;
}

static void note(const tahr__step *step, const tahr_floor *floor, double at, look *l)
{
    const tahr__inner *inner = step->inner;
    l->at = at;
    l->position = step->state.position;
    l->known = 1;
    l->perching = (floor->flags & TAHR_FLOOR_PERCHING) != 0;
    l->has_inner = inner && inner->asked && !inner->hit.start_overlap;
    l->outer = contact_of(floor->point, floor->normal, floor->surface_normal, floor->distance);
    l->outer.kind = floor->flags & TAHR_FLOOR_BLOCKING ? l->outer.kind : FREE;
    if (l->has_inner) {
        l->inner = contact_of(inner->hit.point, inner->hit.normal, inner->hit.surface_normal, inner->clearance);
        l->inner.kind = inner->hit.blocking ? l->inner.kind : FREE;
    }
}

/* Do two looks see the same point of an edge? */
static void compare(contact *now, contact *before, double moved)
{
    double off2 = length_squared(sub(now->point, before->point));
    if (now->kind != EDGE || before->kind != EDGE) {
        return;
    }
    if (off2 <= SMALL * SMALL * moved * moved || (before->stays && off2 <= SAME_POINT * SAME_POINT)) {
        now->stays = before->stays = 1;
    }
}

static void compare_looks(look *now, look *before)
{
    double moved = length(sub(now->position, before->position));
    if (before->known) {
        compare(&now->outer, &before->outer, moved);
        if (now->has_inner && before->has_inner) {
            compare(&now->inner, &before->inner, moved);
        }
    }
}

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
 * rim of the foot. */
typedef enum limit { PASSES_INNER, NEEDS_PERCH, LEAVES_RIM } limit;

/* m, level, how far away the edge is then. The rules measure how far the contact is: of an edge that slopes it is
 * before or behind where the edge is nearest, and its normal, across the edge, says how far. */
static double distance_at(const tahr__step *step, const edge_seen *e, limit what)
{
    const tahr_config *c = step->config;
    double x = dot(e->away, rotate(step->state.orientation, vec(1, 0, 0)));
    double y = dot(e->away, rotate(step->state.orientation, vec(0, 1, 0)));
    double reach = shape_reach(&step->limits->shape, x, y), perch = max_of(c->perch_threshold, c->edge_tolerance);
    if (c->floor_probe == TAHR_FLOOR_PROBE_SHRUNK) {
        int perches = c->perch_threshold > c->edge_tolerance && what != LEAVES_RIM;
        return reach - c->edge_tolerance - (perches ? step->limits->width - tahr__valid_perch_radius(step) : 0);
    }
    double whole = reach + c->skin, holds = what == NEEDS_PERCH ? reach - perch : whole - c->edge_tolerance;
    if (what == PASSES_INNER) {
        return whole - perch;
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

static double passes_edge(const tahr__step *step, const search *s, const look *l, const contact *c, limit what)
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
static double passes_face(const tahr__step *step, const search *s, const passing *p)
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
static double depth_rate(const tahr__step *step, const search *s, const contact *c)
{
    return c->kind == FREE ? 0 : dot(c->normal, s->way) / dot(c->normal, step->state.up);
}

/* Where what was met on one side lies as deep as what was met on the other. */
static double same_depth(const tahr__step *step, const search *s, const contact *a, const contact *b)
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
static double meets_edge(const tahr__step *step, const search *s, const passing *p, const look *at_face)
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
    double next = first * first < second * second ? first : second;
    return dot(add_scaled(from, way, next), up) > 0 ? p->look->at + next : NOWHERE; /* else it is past the edge by then */
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
static double turns_round(const tahr__step *step, const search *s, const contact *a, const contact *b)
{
    contact side = {.kind = FACE, .face = unit(reject(b->normal, a->face)), .point = b->point};
    passing p = {.look = &s->outside, .edge = b, .face = &side};
    return is_on(a, b) ? passes_face(step, s, &p) : NOWHERE;
}

/* Is it on the way that is left, or so near its ends that it may be? */
static int is_between(const search *s, double part)
{
    return part > s->inside.at - 2 * s->beside && part < s->outside.at + 2 * s->beside;
}

/* By what the same foot met on either side. */
static double between(const tahr__step *step, const search *s, const contact *a, const contact *b, int whole)
{
    if (a->kind != FREE && b->kind != FREE && !shape_is_round(&step->limits->shape)) {
        /* Flat sides and straight edges alike go down evenly; how far an edge sticks out of its face does not. */
        return same_direction(a->face, b->face) ? NOWHERE : same_depth(step, s, a, b);
    }
    if (a->kind == EDGE && (b->kind == FREE || (b->kind == FACE && !is_on(b, a)))) { /* by the rim, or out of reach */
        passing p = {.look = &s->inside, .edge = a, .face = b};
        double sinks = meets_edge(step, s, &p, &s->outside);
        double passes = passes_edge(step, s, &s->inside, a, whole ? LEAVES_RIM : PASSES_INNER);
        return sinks > s->inside.at && sinks < passes ? sinks : passes;
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
        return meets_edge(step, s, &p, &s->inside);
    }
    return same_depth(step, s, a, b);
}

/* Where an edge comes so far out that it needs a perch. Or later, where the thinner foot passes from the edge to the
 * face below it, which is too steep. */
static double begins_to_perch(const tahr__step *step, const search *s)
{
    const look *out = &s->outside;
    double begins = passes_edge(step, s, out, &out->outer, NEEDS_PERCH);
    passing p = {.look = out, .edge = &out->outer, .face = &out->inner, .thinner = step->config->perch_threshold};
    return out->inner.kind == FACE && is_on(p.face, p.edge) ? max_of(begins, passes_face(step, s, &p)) : begins;
}

/* By the thinner foot that did not hold. */
static double ends_perch(const tahr__step *step, const search *s)
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

/* What changes evenly with the place, and passes 0 where a rule says something else. */
typedef enum measured { TURNS_TO, TURNS_FROM, TILTS, NEARS_RIM, SINKS } measured;

static const contact *contact_in(const look *l, int thin)
{
    return thin ? &l->inner : &l->outer;
}

static double measure(const tahr__step *step, const search *s, const look *l, int thin, measured what)
{
    const contact *c = contact_in(l, thin), *in = contact_in(&s->inside, thin), *out = contact_in(&s->outside, thin);
    int touches = l->known && (!thin || l->has_inner) && c->kind != FREE;
    if (!touches || (what == TILTS && (c->kind != EDGE || in->kind == out->kind || out->kind == FREE)) ||
        (what == SINKS && out->kind != FREE) || (what <= TURNS_FROM && in->kind == FACE && out->kind == FACE)) {
        return NAN;
    }
    switch (what) {
    case TURNS_TO: return dot(c->normal, in->face) - BEHIND;
    case TURNS_FROM: return dot(c->normal, out->face) - BEHIND;
    case TILTS: return length(cross(c->normal, c->face)) - ON_FACE;
    case NEARS_RIM: return inside_rim(step, l->position, c->point) - step->config->perch_threshold - step->config->skin;
    default: return c->depth - out->depth;
    }
}

/* By two looks; NOWHERE if one of them does not tell. */
static double by_two(const search *s, const look *a, double at_a, const look *b, double at_b)
{
    double part = a->at + (b->at - a->at) * (at_a / (at_a - at_b));
    return part > s->inside.at && part < s->outside.at ? part : NOWHERE;
}

/* By two looks on the same side, or else by one on either. */
static double by_measure(const tahr__step *step, const search *s, int thin, measured what)
{
    const look *in = &s->inside, *out = &s->outside;
    double at_in = measure(step, s, in, thin, what), at_out = measure(step, s, out, thin, what);
    if (at_in * at_out > 0) {
        return NOWHERE;
    }
    double part = by_two(s, in, at_in, &s->further[1], measure(step, s, &s->further[1], thin, what));
    if (part == NOWHERE) {
        part = by_two(s, out, at_out, &s->further[0], measure(step, s, &s->further[0], thin, what));
    }
    return part == NOWHERE ? by_two(s, in, at_in, out, at_out) : part;
}

static double by_measures(const tahr__step *step, const search *s)
{
    double part = NOWHERE;
    for (int thin = 0; s->inside.known && thin < 2; thin++) {
        for (int what = TURNS_TO; what <= SINKS && part == NOWHERE; what++) {
            part = by_measure(step, s, thin, (measured)what);
        }
    }
    return part;
}

/* The likeliest place, NOWHERE if nothing tells of one. What lies off the way that is left was told by something else
 * than what ends the floor; before its begin, which is a floor, it may well end right there. */
static double predict(const tahr__step *step, const search *s)
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

/* Beside the predicted place, on the side that less is known of; else in the middle. But who has gone down where a
 * floor ended, and goes on from there, is at the end of the next one already: if the floor held nowhere so far, right
 * behind the begin. */
static double next_look(search *s, uint32_t looks)
{
    enum { STEADY = 2 };
    double a = s->inside.at, b = s->outside.at, middle = 0.5 * (a + b), at = middle, asked;
    s->proves = 0;
    int at_begin = !s->inside.known && !s->tried;
    if (s->predicted == NOWHERE ? at_begin && looks >= LOST : at_begin && s->predicted - s->beside <= a) {
        s->tried = 1;
        return 0.5 / (1 << ROUNDS);
    }
    if (s->predicted != NOWHERE) {
        double part = clamp(s->predicted, a, b);
        at = part - a > b - part || !s->inside.known ? part - s->beside : part + s->beside;
    }
    asked = at;
    if (s->steady >= STEADY && s->lost < LOST + PROOFS) { /* what so many looks agree on is proven anyway */
        s->lost++;
    } else { /* after n looks no more than 2^(lost - n) may be left */
        double most = (double)(1u << s->lost) / (2.0 * (double)(1u << looks)) - 0.5 * (b - a);
        at = clamp(at, middle - most, middle + most);
    }
    s->proves = s->predicted != NOWHERE && at == asked;
    return at > a && at < b ? at : middle;
}

/* Returns 1 if the floor holds there. */
static int look_at(tahr__step *step, search *s, double at, tahr_floor *floor)
{
    tahr__inner inner = {.asked = 0};
    step->inner = &inner;
    step->state.position = add_scaled(s->from, s->way, at);
    tahr__find_floor(step, step->config->snap_distance, NULL, floor);
    int inside = floor_is_walkable(floor);
    look *side = inside ? &s->inside : &s->outside;
    s->further[inside] = *side;
    note(step, floor, at, side);
    compare_looks(side, &s->further[inside]);
    compare_looks(side, inside ? &s->outside : &s->inside);
    step->inner = NULL;
    s->latest = at;
    s->surprised = s->predicted != NOWHERE && inside != (at < s->predicted);
    return inside;
}

/* What looks tell may change evenly with where they are, as the last three show: then the place is where a look would tell of itself, as
 * Steffensen's method has it. told: by the last one. */
static double refine(search *s, double told)
{
    double moved = s->latest - s->told_at, change = told - s->told, at = s->latest, least = 100 * s->least;
    int both = told != NOWHERE && s->told != NOWHERE && (moved > least || moved < -least);
    s->told = told;
    s->told_at = at;
    double rate = change / moved, before = s->rate;
    s->rate = both ? rate : s->rate;
    if (!both || rate * rate > STEEPEST * STEEPEST || (rate - before) * (rate - before) > EVENLY * EVENLY) {
        return told;
    }
    double part = (told - rate * at) / (1 - rate), off = FARTHER * s->least;
    if (!is_between(s, part) && is_between(s, told) && s->outside.at - s->inside.at > 4 * off) {
        return clamp(part, s->inside.at + off, s->outside.at - off); /* it bends: near that end */
    }
    return is_between(s, part) ? part : told;
}

/* Goes farther beside where the same place is predicted that was proven wrong. */
static void predict_again(const tahr__step *step, search *s)
{
    double part = refine(s, predict(step, s));
    double seen = part == NOWHERE || s->doubts ? by_measures(step, s) : NOWHERE;
    part = seen != NOWHERE ? seen : part;
    double change = part - s->predicted, gap = s->outside.at - s->inside.at, little = STEADILY * gap;
    s->steady = change <= little && change >= -little && part != NOWHERE ? s->steady + 1 : 0;
    if (!s->surprised) {
        s->beside = s->proves ? max_of(s->beside / NEARER, s->least) : s->beside;
    } else if (change <= 4 * s->beside && change >= -4 * s->beside) { /* it may move with the look */
        s->beside = s->beside > NEARER * s->least ? gap : min_of(s->beside * FARTHER, sqrt(s->beside * gap));
        s->doubts = 1;
    }
    if (s->beside > 0.25 * gap) { /* it is somewhere else */
        s->beside = s->least;
        part = NOWHERE;
    }
    s->predicted = part;
}

void tahr__floor_end(tahr__step *step, const tahr__path *w, const tahr_floor *beyond, tahr__floor_border *border)
{
    enum { LOOKS = ROUNDS + LOST + PROOFS, MOST = TAHR_MAX_QUERIES_PER_STEP * 5 / 8 };
    search s = {.from = w->from,
                .way = sub(step->state.position, w->from),
                .predicted = NOWHERE,
                .told = NOWHERE,
                .rate = INFINITY,
                .lost = LOST};
    tahr_floor floor;
    double size = length(s.way);
    s.beside = s.least = BESIDE * step->limits->width / max_of(size, 1e-300);
    const double least = max_of(1.0 / (1 << ROUNDS), 2.1 * s.least); /* of the way, to be known */
    s.latest = 1;
    note(step, beyond, 1, &s.outside);
    for (uint32_t i = 0; i < LOOKS && s.outside.at - s.inside.at > least && step->queries < MOST; i++) {
        if (i == (step_goes_far(step) ? 0 : MANY)) {
            tahr__announce_near(step, s.from, s.way);
        }
        predict_again(step, &s);
        if (look_at(step, &s, next_look(&s, i), &floor)) {
            border->floor = floor;
        }
        if (step->error < 0) {
            break;
        }
    }
    border->outside = s.outside.at;
    if (!s.inside.known) {
        look_at(step, &s, 0, &border->floor);
    }
    border->inside = s.inside.at;
    step->state.position = add_scaled(w->from, s.way, s.inside.at);
}

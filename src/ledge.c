/* SPDX-License-Identifier: MIT
 * ledge.c: where a floor ends, and staying on it.
 *
 * A floor mostly ends where the level distance of the axis from an edge passes a limit of the rules. A look that
 * touches that edge knows where it is, and so where on the way the limit lies: a look on either side of that place
 * proves it. Along a straight edge the place is exact; where the edge bends every look brings a better one, as in
 * Newton's method. What ends for another reason (a slope, a floor too deep, a level foot, a backend that lies) is found
 * by halving. Predictions are held near the middle as the ITP method does (Oliveira and Takahashi 2020), so that all
 * the wrong ones together cost no more than two looks. */
#include "ledge.h"

#include "floor.h"
#include "move.h"
#include "perch.h"
#include "plane.h"
#include "report.h"
#include "shape.h"
#include "slide.h"

/* m beside a predicted place that is looked at, above the rounding of an exact sweep past an edge; times this, again
 * and again, for a backend that is less exact. */
static const double BESIDE = 1e-9, FARTHER = 32;

/* Radians between a contact's normal and its face's below which it lies on the face and tells of no edge; cosine
 * between a way and the direction away from an edge below which it goes along it. */
static const double SMALL = 1e-3;

typedef struct search {
    vec3 from, way;
    double inside, outside; /* parts of the way */
    double predicted;       /* by the last look that told something; < 0: none did */
    double beside;          /* of a prediction is looked at */
} search;

/* m, level: how far from the axis, in this direction, a straight edge may run and still hold the foot. */
static double farthest_edge(const tahr__step *step, vec3 direction)
{
    const tahr_config *c = step->config;
    double x = dot(direction, rotate(step->state.orientation, vec(1, 0, 0)));
    double y = dot(direction, rotate(step->state.orientation, vec(0, 1, 0)));
    double reach = shape_reach(&step->limits->shape, x, y);
    if (c->floor_probe == TAHR_FLOOR_PROBE_WHOLE) { /* a thinner foot holds, or what touches inside the rim */
        return reach + c->skin - max_of(c->perch_threshold, c->edge_tolerance);
    }
    double perch = c->perch_threshold > c->edge_tolerance ? step->limits->width - tahr__valid_perch_radius(step) : 0;
    return reach - perch - c->edge_tolerance;
}

/* The part of the way at which the edge is too far away that the floor found at the part `at` touches; < 0 if it tells
 * of none. The edge lies across the normals of its contact and of its face. */
static double predict(const tahr__step *step, const tahr_floor *floor, vec3 way, double at)
{
    vec3 edge = cross(floor->surface_normal, floor->normal), along = step_level(step, edge);
    vec3 away = step_level(step, sub(floor->point, step->state.position));
    if (!(floor->flags & TAHR_FLOOR_BLOCKING) || length_squared(edge) < SMALL * SMALL) {
        return -1;
    }
    if (length_squared(along) > SMALL * SMALL * length_squared(edge)) { /* not an upright one */
        away = add_scaled(away, along, -dot(away, along) / length_squared(along));
    }
    double distance = length(away);
    vec3 direction = unit(away);
    double speed = -dot(direction, way);
    if (!(speed > SMALL * length(way))) {
        return -1;
    }
    return at + (farthest_edge(step, direction) - distance) / speed;
}

/* Where to look next: beside the predicted place, on the side that less is known of; else in the middle. */
static double next_look(const search *s, uint32_t looks)
{
    double middle = 0.5 * (s->inside + s->outside), at = middle;
    if (s->predicted >= 0) {
        double place = clamp(s->predicted, s->inside, s->outside);
        at = place - s->inside > s->outside - place ? place - s->beside : place + s->beside;
    }
    /* After n looks no more than 2^(2 - n) may be left. */
    double most = 2.0 / (double)(1u << looks) - 0.5 * (s->outside - s->inside);
    at = clamp(at, middle - most, middle + most);
    return at > s->inside && at < s->outside ? at : middle;
}

/* Looks at the floor at a part of the way. Returns 1 if it holds. */
static int look(tahr__step *step, search *s, double at, tahr_floor *floor)
{
    step->state.position = add_scaled(s->from, s->way, at);
    tahr__find_floor(step, step->config->snap_distance, NULL, floor);
    int inside = floor_is_walkable(floor);
    double before = s->predicted, part = predict(step, floor, s->way, at);
    *(inside ? &s->inside : &s->outside) = at;
    if (before >= 0 && inside != (at < before)) { /* not where it was thought to be: farther, unless a better place is
                                                     known now */
        double change = part >= 0 ? part - before : 0;
        s->beside *= change <= s->beside && change >= -s->beside ? FARTHER : 1;
    }
    s->predicted = part >= 0 ? part : before;
    return inside;
}

void tahr__floor_end(tahr__step *step, const tahr__path *w, const tahr_floor *beyond, tahr__ledge *end)
{
    enum { ROUNDS = 20, LOOKS = ROUNDS + 2, MOST = TAHR_MAX_QUERIES_PER_STEP * 5 / 8 };
    const double least = 1.0 / (1 << ROUNDS);
    search s = {.from = w->from, .way = sub(step->state.position, w->from), .outside = 1};
    tahr_floor floor;
    int found = 0;
    double size = length(s.way);
    s.beside = size > 0 ? min_of(BESIDE / size, 0.5 * least) : least;
    s.predicted = predict(step, beyond, s.way, 1);
    for (uint32_t i = 0; i < LOOKS && s.outside - s.inside > least && step->queries < MOST && step->error >= 0; i++) {
        if (look(step, &s, next_look(&s, i), &floor)) {
            end->floor = floor;
            found = 1;
        }
    }
    if (!found) {
        look(step, &s, 0, &end->floor);
    }
    end->inside = s.inside;
    end->outside = s.outside;
    step->state.position = add_scaled(w->from, s.way, s.inside);
}

/* Stops at the last place with a floor and goes on along the edge. Returns 1 if there is such a place. */
static int hold_at_ledge(tahr__step *step, tahr__path *w, const tahr_floor *beyond)
{
    tahr__ledge end;
    tahr__floor_end(step, w, beyond, &end);
    tahr_floor floor = end.floor;
    double part = end.inside;
    if (!floor_is_walkable(&floor)) {
        return tahr__decide(step, TAHR_RULE_LEDGE, 0, NULL, part, 0, "no floor on the way here");
    }
    tahr__path_cut(step, w, part);
    /* The contact with the edge leans outward: its level part is the wall that keeps the character in. */
    tahr__plane edge = {.normal = unit(scale(step_level(step, floor.normal), -1)),
                        .anchor = step->state.position,
                        .body = floor.body,
                        .feature = floor.feature};
    int faces_out = is_in_plane(step) && !tahr__plane_surface(step, &edge.normal, &edge.offset);
    if (length_squared(edge.normal) == 0 || faces_out) {
        edge.normal = unit(scale(step_level(step, w->wish), -1));
    }
    /* A thousandth of a skin inward, so that going on along the edge does not lose the floor to rounding. */
    tahr_hit hit;
    tahr__move(step, scale(edge.normal, 1e-3 * step->config->skin), &hit);
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    tahr__keep_floor(step, &floor);
    tahr__planes_add(w->walls, &w->wall_count, &edge);
    tahr__path_bend(step, w);
    return tahr__decide(step, TAHR_RULE_LEDGE, 1, NULL, part, 1, "held at the ledge");
}

void tahr__stay_on_ledge(tahr__step *step, tahr__path *w, const tahr_floor *beyond)
{
    tahr_floor floor = *beyond;
    for (int corner = 0; corner < 2; corner++) {
        if (!hold_at_ledge(step, w, &floor)) {
            step->state.position = w->from;
            break;
        }
        vec3 held = step->state.position;
        tahr_floor held_floor = step->state.floor;
        tahr__path_carry_floor(w, step);
        tahr__path_walk(step, w);
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        if (floor_is_walkable(&floor)) {
            tahr__keep_floor(step, &floor);
            return;
        }
        if (corner == 1) {
            step->state.position = held;
            tahr__keep_floor(step, &held_floor);
        }
    }
    step->state.velocity = vec(0, 0, 0);
}

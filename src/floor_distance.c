/* SPDX-License-Identifier: MIT
 * floor_distance.c: see floor_distance.h. */
#include "floor_distance.h"

#include "drop.h"
#include "foot.h"
#include "report.h"
#include "shape.h"

/* How much of its straight part a probe keeps. */
static const double FIRST = 0.9, THIN = 0.1;

/* Half sides of the box of a flat base: its corners lie just inside the circle. */
static const double FLAT = 0.707;

/* A hit whose normal is up to a millionth of that is met flat by a flat probe. */
static const double LEVEL = 1 - 1e-6;

static int has_flat_base(const tahr__step *step)
{
    int box = (step->world->backend->capabilities & TAHR_CAP_BOX) != 0;
    return shape_is_flat(&step->limits->shape) || (step->config->flat_base && box);
}

int tahr__is_within_edge_tolerance(const tahr__step *step, vec3 centre, vec3 point, double radius)
{
    const tahr_shape *s = &step->limits->shape;
    double tolerance = step->config->edge_tolerance, least = tolerance + tiny_length(step->config);
    vec3 offset = step_level(step, sub(point, centre));
    if (!shape_is_round(s)) {
        double off = step->limits->width - radius + tolerance;
        double x = dot(offset, rotate(step->state.orientation, vec(1, 0, 0)));
        double y = dot(offset, rotate(step->state.orientation, vec(0, 1, 0)));
        if (!shape_is_square(s)) {
            return length_squared(offset) < least * least || shape_inside(s, x, y) > off;
        }
        return max_of(x, -x) < max_of(least, s->half_x - off) && max_of(y, -y) < max_of(least, s->half_y - off);
    }
    double rim = max_of(least, radius - tolerance);
    return length_squared(offset) < rim * rim;
}

/* A flat probe that stands on a face touches it with all of its own: whichever point is named, it is not the rim. */
static int touches_rim(const tahr__step *step, const tahr_hit *hit, vec3 centre, double radius)
{
    int flat = has_flat_base(step) && dot(hit->normal, step->state.up) > LEVEL;
    return !flat && !hit->unknown && !tahr__is_within_edge_tolerance(step, centre, hit->point, radius);
}

/* The character's shape with a part `kept` of its straight part, `inset` thinner. [out] shrink: m by which both ends
 * are shorter, 0 where all is kept: of an ellipsoid, which has no straight part, always the first part of it all, for
 * its sides rise by less than its end; of a cone and a hull 0. */
static tahr__foot probe_of(const tahr__step *step, double kept, double inset, double *shrink)
{
    tahr_shape s = step->limits->shape;
    /* A line, for what it finds, and a shape for a backend. */
    const double least = max_of(0.01 * step->config->edge_tolerance, TAHR__THINNEST);
    if (s.type > TAHR_SHAPE_BOX) {
        *shrink = s.type == TAHR_SHAPE_CYLINDER    ? (1 - kept) * s.half_height
                  : s.type == TAHR_SHAPE_ELLIPSOID ? (kept < 1 ? 1 - FIRST : 0) * s.half_height
                                                   : 0;
        s.half_height -= *shrink;
        if (inset > 0) {
            tahr__thin_shape(&s, inset, 0, step->world->backend->capabilities);
        }
        tahr__foot whole = {s, 0};
        return whole;
    }
    *shrink = (1 - kept) * (s.half_height - s.radius);
    if (s.type == TAHR_SHAPE_BOX) {
        s.half_height -= *shrink;
        s.half_x = max_of(s.half_x - inset, least);
        s.half_y = max_of(s.half_y - inset, least);
    } else if (inset > 0 || s.type == TAHR_SHAPE_CAPSULE) {
        s.radius = max_of(s.radius - inset, least);
        s.half_height = max_of(s.half_height - *shrink, s.radius);
        s.type = TAHR_SHAPE_CAPSULE;
    }
    /* Without capsules the lower cap alone, which a way down meets first. */
    if (s.type == TAHR_SHAPE_CAPSULE && !(step->world->backend->capabilities & TAHR_CAP_CAPSULE)) {
        return tahr__foot_of(&s, step->world->backend->capabilities);
    }
    tahr__foot probe = {s, 0};
    return probe;
}

/* The frame of the box of a flat base depends on up alone: turning on the spot changes no floor. */
static int sweep_box(tahr__step *step, const tahr__foot *probe, vec3 from, double range, tahr_hit *hit)
{
    const tahr_quat eighth = {0, 0, 0.3826834323650898, 0.9238795325112867}; /* of a turn about z: sin, cos of pi / 8 */
    const tahr_quat kept = step->state.orientation;
    double radius =
        shape_is_round(&probe->shape) ? probe->shape.radius : min_of(probe->shape.half_x, probe->shape.half_y);
    tahr_shape box = {.type = TAHR_SHAPE_BOX,
                      .half_height = probe->shape.half_height,
                      .half_x = max_of(FLAT * radius, TAHR__THINNEST)};
    box.half_y = box.half_x;
    tahr_quat aligned = quat_between(vec(0, 0, 1), step->state.up);
    vec3 motion = scale(step->state.up, -range);
    step->state.orientation = quat_multiply(aligned, eighth);
    tahr__sweep(step, &box, from, motion, 0, 0, hit);
    if (!hit->blocking) {
        step->state.orientation = aligned;
        tahr__sweep(step, &box, from, motion, 0, 0, hit);
    }
    step->state.orientation = kept;
    return hit->blocking != 0;
}

int tahr__floor_sweep_test(tahr__step *step, const tahr__foot *probe, vec3 from, double range, tahr_hit *hit)
{
    vec3 centre = add_scaled(from, step->state.up, probe->offset);
    if (!shape_is_flat(&probe->shape) && has_flat_base(step)) {
        return sweep_box(step, probe, centre, range, hit);
    }
    tahr__sweep(step, &probe->shape, centre, scale(step->state.up, -range), 0, 0, hit);
    return hit->blocking != 0;
}

/* Never deeper than the shape is wide (34 cm) or the band is high (2.4 cm). */
static double deepest(const tahr__step *step)
{
    return -max_of(step->config->floor_max * step->config->skin, step->limits->width);
}

static void set_none(tahr_floor *floor, double distance)
{
    *floor = (tahr_floor){.distance = distance, .body = TAHR_NO_BODY};
}

static void set_hit(tahr_floor *floor, const tahr_hit *hit)
{
    floor->normal = hit->normal;
    floor->surface_normal = hit->surface_normal;
    floor->point = hit->point;
    floor->body = hit->body;
    floor->feature = hit->feature;
    floor->surface = hit->surface;
}

/* Makes a sweep's hit the floor. Returns 1 if that settles it. */
static int take_sweep(tahr__step *step, const tahr_hit *hit, uint32_t flags, tahr_floor *floor)
{
    set_hit(floor, hit);
    int walkable = tahr__is_walkable(step, hit, tahr__was_walkable(step, hit));
    floor->flags = flags | floor_still_slope(&step->state.floor, hit) |
                   (hit->start_overlap ? 0u : TAHR_FLOOR_BLOCKING) | (walkable ? TAHR_FLOOR_FACE : 0u);
    floor->flags |= walkable ? TAHR_FLOOR_WALKABLE : 0u;
    return walkable;
}

/* Vertical: no more than 1e-4 cm^2 (a centimetre is 10 pull_back) off the axis. */
static int went_straight_down(const tahr__step *step, const tahr__supplied *s)
{
    double centimetre = 10 * step->config->pull_back;
    return dot(s->motion, step->state.up) < 0 &&
           length_squared(step_level(step, s->motion)) <= 1e-4 * centimetre * centimetre;
}

/* What a sweep that was made anyway says. Returns 1 if it may take the place of the first one. */
static int use_supplied(tahr__step *step, const tahr__floor_look *look, tahr_floor *floor, int *settled)
{
    const tahr__supplied *s = look->supplied;
    if (!s || !s->hit->blocking || s->hit->start_overlap || !went_straight_down(step, s) ||
        touches_rim(step, s->hit, s->location, look->radius)) {
        return 0;
    }
    floor->distance = dot(sub(look->from, s->location), step->state.up);
    *settled = take_sweep(step, s->hit, 0, floor);
    return 1;
}

/* Returns the distance down from the foot, below 0 of what is above it: the ends of a probe are shorter. */
static double sweep_probe(tahr__step *step, const tahr__floor_look *look, double kept, double inset, tahr_hit *hit)
{
    double shrink;
    tahr__foot probe = probe_of(step, kept, inset, &shrink);
    double range = look->sweep_distance + shrink;
    tahr__floor_sweep_test(step, &probe, look->from, range, hit);
    return hit->fraction * range - shrink;
}

/* A one-way body whose top is above the foot, by more than rounding, is there for a probe and not for the character. */
static int is_passed(const tahr__step *step, const tahr_hit *hit, double distance)
{
    return distance < -10 * tiny_length(step->config) && hit->blocking && tahr__is_one_way(step, hit->body);
}

static double sweep_foot(tahr__step *step, const tahr__floor_look *look, double kept, double inset, tahr_hit *hit)
{
    double distance = sweep_probe(step, look, kept, inset, hit);
    return is_passed(step, hit, distance) ? sweep_probe(step, look, 1, inset, hit) : distance;
}

/* One sweep from `from`, or two; hit is that of the last. Returns the distance down to it. One more for each that meets
 * a one-way body above the foot. */
static double sweep_twice(tahr__step *step, const tahr__floor_look *look, tahr_hit *hit, uint32_t *flags)
{
    const tahr_config *c = step->config;
    double inset = step->limits->width - look->radius;
    double distance = sweep_foot(step, look, FIRST, inset, hit);
    if (hit->blocking && (hit->start_overlap || touches_rim(step, hit, look->from, look->radius))) {
        tahr__decide(step, TAHR_RULE_EDGE_TOLERANCE, 0, hit, look->radius, c->edge_tolerance, "touches the rim");
        distance = sweep_foot(step, look, THIN, inset + c->edge_tolerance + tiny_length(c), hit);
        *flags |= TAHR_FLOOR_RIM;
    }
    distance = max_of(deepest(step), distance);
    /* What nobody knows holds the character where it is, and never lifts it. */
    return hit->unknown ? max_of(distance, c->floor_target * c->skin) : distance;
}

static void use_ray(tahr__step *step, const tahr__floor_look *look, tahr_floor *floor)
{
    double half = step->limits->shape.half_height, range = look->line_distance + half;
    tahr_hit hit;
    tahr__ray(step, look->from, scale(step->state.up, -range), &hit);
    double distance = hit.fraction * range - half;
    if (is_passed(step, &hit, distance)) {
        range = look->line_distance;
        tahr__ray(step, add_scaled(look->from, step->state.up, -half), scale(step->state.up, -range), &hit);
        distance = hit.fraction * range;
    }
    distance = max_of(deepest(step), distance);
    if (!hit.blocking || hit.unknown || !(hit.fraction > 0) ||
        !tahr__is_walkable(step, &hit, tahr__was_walkable(step, &hit))) {
        return;
    }
    set_hit(floor, &hit);
    floor->perch_distance = distance;
    floor->flags = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_LINE | (floor->flags & TAHR_FLOOR_RIM);
}

void tahr__compute_floor_distance(tahr__step *step, const tahr__floor_look *look, tahr_floor *floor)
{
    uint32_t flags = 0;
    int settled = 0;
    tahr_hit hit;
    set_none(floor, look->sweep_distance);
    if (!use_supplied(step, look, floor, &settled)) {
        double distance = sweep_twice(step, look, &hit, &flags);
        if (!hit.blocking || step->error < 0) {
            floor->flags = flags;
            return;
        }
        floor->distance = distance;
        settled = take_sweep(step, &hit, flags, floor);
    }
    if (!settled && look->line_distance > 0) {
        use_ray(step, look, floor);
    }
}

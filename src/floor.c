/* SPDX-License-Identifier: MIT
 * floor.c: walkable test, edge tolerance, perch, floor distance, find floor, height adjustment. */
#include "floor.h"

#include "elementary.h"
#include "lip.h"
#include "move.h"
#include "plane.h"
#include "query.h"
#include "report.h"

/* Faces this close to vertical are never a floor, whatever an override says. */
static const double VERTICAL = 1e-4;

static double cosine(double angle)
{
    double s, c;
    tahr__sincos(clamp(angle, 0, 1.5707963267948966), &s, &c);
    return c;
}

double tahr__walkable_limit(const tahr__step *step, const tahr_hit *hit, int was_walkable)
{
    double limit = was_walkable ? step->limits->walkable_hysteresis : step->limits->walkable;
    if (hit->walkable_rule == TAHR_WALKABLE_INCREASE) {
        limit = min_of(limit, cosine(hit->walkable_angle));
    } else if (hit->walkable_rule == TAHR_WALKABLE_DECREASE) {
        limit = max_of(limit, cosine(hit->walkable_angle));
    }
    return max_of(limit, VERTICAL);
}

int tahr__is_walkable(tahr__step *step, const tahr_hit *hit, int was_walkable)
{
    double limit = tahr__walkable_limit(step, hit, was_walkable);
    double up = dot(hit->surface_normal, step->state.up);
    int walkable = hit->blocking && !hit->start_overlap && hit->walkable_rule != TAHR_WALKABLE_NEVER;
    return tahr__decide(step, TAHR_RULE_WALKABLE, walkable && up >= limit, hit, up, limit, "cosine of the face's slope");
}

static double inside_box(const tahr__step *step, vec3 offset)
{
    const tahr_shape *s = &step->limits->shape;
    vec3 x = rotate(step->state.orientation, vec(1, 0, 0));
    vec3 y = rotate(step->state.orientation, vec(0, 1, 0));
    double dx = dot(offset, x), dy = dot(offset, y);
    return min_of(s->half_x - max_of(dx, -dx), s->half_y - max_of(dy, -dy));
}

/* How far inside the rim of the shape and its skin, seen from above, the point of a hit lies. */
static inline double inside_rim(const tahr__step *step, const tahr_hit *hit)
{
    vec3 offset = step_level(step, sub(hit->point, step->state.position));
    const tahr_shape *s = &step->limits->shape;
    double skin = step->config->skin;
    return s->type == TAHR_SHAPE_BOX ? skin + inside_box(step, offset) : s->radius + skin - length(offset);
}

/* An upright capsule that moves along its own axis enters new space with its lower cap alone: a sphere there is the same
 * sweep and a fraction of the geometry. What overlaps higher up is found by the sweep of the move. */
tahr__foot tahr__foot_of(const tahr_shape *shape, uint32_t capabilities)
{
    tahr__foot foot = {*shape, 0};
    if (shape->type == TAHR_SHAPE_CAPSULE && (capabilities & TAHR_CAP_SPHERE)) {
        foot.shape.type = TAHR_SHAPE_SPHERE;
        foot.shape.half_height = shape->radius;
        foot.offset = shape->radius - shape->half_height;
    }
    return foot;
}

static void sweep_down(tahr__step *step, const tahr__foot *foot, double range, tahr_hit *hit)
{
    vec3 up = step->state.up;
    vec3 from = add_scaled(step->state.position, up, foot->offset);
    tahr__sweep(step, &foot->shape, from, scale(up, -range), step->config->skin, 0, hit);
}

/* The foot of the shape, thinner all round, with its end where it was. */
static tahr__foot thinner(const tahr__step *step, double by)
{
    tahr_shape s = step->limits->shape;
    if (s.type == TAHR_SHAPE_BOX) {
        s.half_x = max_of(s.half_x - by, 1e-3 * s.half_x);
        s.half_y = max_of(s.half_y - by, 1e-3 * s.half_y);
    } else {
        s.type = TAHR_SHAPE_CAPSULE;
        s.radius = max_of(s.radius - by, 1e-3 * s.radius);
    }
    return tahr__foot_of(&s, step->world->backend->capabilities);
}

/* Clearance below in the direction of up, from a downward sweep over `range`. */
static double clearance(const tahr__step *step, const tahr_hit *hit, double range)
{
    double skin = step->config->skin;
    if (hit->fraction > 0 || hit->distance >= skin) {
        return hit->fraction * range + skin;
    }
    /* Closer than skin already: the way up that restores it, for slopes not steeper than 78 degrees. */
    double rate = max_of(dot(hit->normal, step->state.up), 0.2);
    return skin - (skin - max_of(hit->distance, 0)) / rate;
}

/* Nearly the same face as a moment ago: within 0.8 degrees, less than the hysteresis. */
static int is_same_face(const tahr_floor *old, const tahr_hit *hit)
{
    return old->body == hit->body && dot(old->surface_normal, hit->surface_normal) > 0.9999;
}

static uint32_t still_slope(const tahr__step *step, const tahr_hit *hit)
{
    const tahr_floor *old = &step->state.floor;
    return old->flags & TAHR_FLOOR_SLOPE && is_same_face(old, hit) ? TAHR_FLOOR_SLOPE : 0;
}

/* The same face, if it was walkable by itself, keeps the benefit of the hysteresis. */
static int was_walkable(const tahr__step *step, const tahr_hit *hit)
{
    const tahr_floor *old = &step->state.floor;
    return step->state.mode == TAHR_MODE_WALKING && floor_is_walkable(old) && (old->flags & TAHR_FLOOR_FACE) &&
           is_same_face(old, hit);
}

static void fill(tahr_floor *floor, const tahr_hit *hit, double distance, uint32_t flags)
{
    floor->normal = hit->normal;
    floor->surface_normal = hit->surface_normal;
    floor->point = hit->point;
    floor->distance = distance;
    floor->perch_distance = 0;
    floor->flags = flags;
    floor->body = hit->body;
    floor->feature = hit->feature;
    floor->surface = hit->surface;
}

/* The front of a step holds who walks, between the floor before it and the one behind it; who falls slides off it. */
static int holds_on_lip(tahr__step *step, const tahr_hit *hit)
{
    int lip = step->state.mode == TAHR_MODE_WALKING && tahr__is_lip(step, hit);
    return tahr__decide(step, TAHR_RULE_PERCH, lip, hit, dot(hit->surface_normal, step->state.up), 0, "front of a step");
}

/* A contact at the rim, or on a face too steep, holds the character only if there is a floor for a thinner foot. Under a
 * face that is itself no floor it may lie no deeper than a step: that is a bevelled step, not a rock to lean on. */
static int perches(tahr__step *step, double reach, const tahr_hit *outer, tahr_floor *floor)
{
    tahr__foot inner = thinner(step, step->config->perch_threshold);
    int surface_walkable = (floor->flags & TAHR_FLOOR_FACE) != 0;
    double deepest = surface_walkable ? reach + step->config->perch_extra : step->config->step_height;
    double range = deepest + step->config->skin;
    tahr_hit hit;
    sweep_down(step, &inner, range, &hit);
    int ok = tahr__is_walkable(step, &hit, was_walkable(step, &hit));
    double distance = hit.blocking ? clearance(step, &hit, range) : range;
    if (ok) {
        floor->flags |= TAHR_FLOOR_PERCHING;
        floor->perch_distance = distance;
    }
    tahr__decide(step, TAHR_RULE_PERCH, ok, &hit, distance, deepest, "floor for the inner foot");
    return ok || holds_on_lip(step, surface_walkable ? &hit : outer);
}

static int wedge(tahr__step *step, tahr_floor *floor)
{
    double band = step->config->floor_max * step->config->skin;
    if (floor->distance > band || !tahr__is_wedged(step)) {
        return 0;
    }
    floor->flags |= TAHR_FLOOR_WEDGED;
    return 1;
}

void tahr__find_floor(tahr__step *step, double reach, const tahr_hit *supplied, tahr_floor *floor)
{
    const tahr_config *c = step->config;
    double range = reach + (c->floor_max - 1) * c->skin;
    tahr_hit hit;
    uint32_t flags = TAHR_FLOOR_BLOCKING;
    if (supplied) {
        hit = *supplied;
        hit.fraction = 0; /* it ended here */
    } else {
        sweep_down(step, &step->limits->foot, range, &hit);
    }
    double inside = hit.blocking ? inside_rim(step, &hit) : 0;
    if (hit.blocking && !hit.start_overlap && inside < c->edge_tolerance) {
        tahr__decide(step, TAHR_RULE_EDGE_TOLERANCE, 0, &hit, inside, c->edge_tolerance, "touches the rim");
        tahr__foot inner = thinner(step, 2 * c->edge_tolerance);
        sweep_down(step, &inner, range, &hit);
        inside = hit.blocking ? inside_rim(step, &hit) : 0;
        flags |= TAHR_FLOOR_RIM;
    }
    if (!hit.blocking || step->error < 0) {
        *floor = (tahr_floor){.distance = range + c->skin, .body = TAHR_NO_BODY};
        tahr__decide(step, TAHR_RULE_FLOOR, 0, NULL, floor->distance, range, "nothing below");
        return;
    }
    fill(floor, &hit, hit.start_overlap ? -hit.depth : clearance(step, &hit, range), flags | still_slope(step, &hit));
    int surface = tahr__is_walkable(step, &hit, was_walkable(step, &hit));
    floor->flags |= surface ? TAHR_FLOOR_FACE : 0u;
    /* On the inside of a face the contact is the foot's own, however far out a slope puts it: no perching there. */
    int on_face = dot(hit.normal, hit.surface_normal) > 1 - 1e-6;
    int rim = inside < c->perch_threshold + c->skin;
    int ok = surface && (on_face || !rim);
    if (!ok && rim && !hit.start_overlap) {
        ok = perches(step, reach, &hit, floor);
    }
    if (!ok && !surface && !rim) {
        ok = holds_on_lip(step, &hit);
    }
    if (!ok && !surface) {
        ok = wedge(step, floor);
    }
    floor->flags |= ok ? TAHR_FLOOR_WALKABLE : 0u;
    tahr__decide(step, TAHR_RULE_FLOOR, ok, &hit, floor->distance, range, "floor distance");
}

/* The floor goes with the character, so that the next move starts from it; a character that stands looks again. */
static void shift_floor(tahr__step *step, double height)
{
    step->state.floor.distance += height;
    step->state.floor.perch_distance += step->state.floor.flags & TAHR_FLOOR_PERCHING ? height : 0;
    step->state.floor_position = step->state.position;
    step->state.flags |= TAHR_STATE_FLOOR_MOVED;
}

double tahr__adjust_height(tahr__step *step)
{
    const tahr_config *c = step->config;
    const tahr_floor *floor = &step->state.floor;
    double target = c->floor_target * c->skin;
    double gap = floor->distance;
    if (!floor_is_walkable(floor) || floor_is_in_band(step) || !may_rise(step)) {
        return 0;
    }
    vec3 before = step->state.position;
    tahr_hit hit;
    vec3 motion = scale(step->state.up, target - gap);
    int proven = !(step->state.flags & TAHR_STATE_FLOOR_MOVED) && !(floor->flags & TAHR_FLOOR_RIM);
    if (gap > target && proven) {
        step->state.position = add(step->state.position, motion); /* the floor sweep went farther */
    } else {
        tahr__move(step, motion, &hit);
    }
    double height = dot(sub(step->state.position, before), step->state.up);
    tahr__decide(step, TAHR_RULE_FLOOR_HEIGHT, 1, NULL, gap, c->floor_max * c->skin, "clearance outside the band");
    shift_floor(step, height);
    return height;
}

int tahr__is_wedged(tahr__step *step)
{
    enum { CONTACTS = TAHR__MAX_PLANES };
    tahr_contact contacts[CONTACTS];
    tahr__plane planes[TAHR__MAX_PLANES];
    uint32_t used = 0;
    vec3 way;
    /* Touched: at the skin, with a hundredth of it for what backends round. */
    uint32_t count = tahr__contacts(step, step->state.position, 1.01 * step->config->skin, contacts, CONTACTS);
    for (uint32_t i = 0; i < count; i++) {
        tahr__plane plane = {.normal = contacts[i].normal, .body = contacts[i].body, .feature = contacts[i].feature};
        if (!is_in_plane(step) || tahr__plane_surface(step, &plane.normal, &plane.offset)) {
            tahr__planes_add(planes, &used, &plane);
        }
    }
    tahr__project(planes, used, scale(step->state.up, -1), &way);
    double left = length(way);
    /* sin of 0.6 degrees: a gutter less inclined holds a character as a floor does. */
    return tahr__decide(step, TAHR_RULE_WEDGE, used > 1 && left < 0.01, NULL, left, 0.01,
                        "downward motion that the contacts leave");
}

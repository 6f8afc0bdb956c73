/* SPDX-License-Identifier: MIT
 * stance.c: crouching and other changes of the shape.
 *
 * A shape that shrinks about its foot or its centre stays inside of what it was, and needs no question. One that grows
 * is tested where it would be; what is in the way of it above or below may shift it along up, never further than it
 * grows, so that the two shapes always share a place: nothing thin can come to lie between them. */
#include "stance.h"

#include <string.h>

#include "floor.h"
#include "limits.h"
#include "query.h"
#include "report.h"

/* Of the skin: what a shape keeps to everything fits, but for what backends round away. With a margin that is the skin,
 * which it will keep from then on; taken back from a contact it may be next to nothing. */
static double room_of(const tahr_config *c)
{
    return (c->separation == TAHR_SEPARATION_MARGIN ? 0.999 : 1e-3) * c->skin;
}

/* Surfaces steeper than this (cosine to up) cannot be given way to by going up or down. */
static const double SIDEWAYS = 0.1;

enum { CONTACTS = TAHR__MAX_PLANES };

void tahr__use_shape(tahr__step *step, double radius, double half_height)
{
    tahr_shape shape = step->config->shape;
    shape.radius = radius;
    shape.half_height = half_height;
    step->own_limits = tahr__limits_of(step->config, &shape, step->world->backend->capabilities);
    step->limits = &step->own_limits;
}

/* Spheres cannot crouch, nor can hulls. */
static tahr_shape wanted(const tahr__step *step)
{
    const tahr_config *c = step->config;
    tahr_shape shape = c->shape;
    if (step->input->flags & TAHR_INPUT_SHAPE) {
        shape.radius = step->input->radius + 0.0; /* never -0.0: it goes into the state */
        shape.half_height = step->input->half_height;
    } else if (step->input->crouch && shape.type != TAHR_SHAPE_SPHERE && shape.type != TAHR_SHAPE_HULL) {
        double low = max_of(c->crouched_half_height, shape.type == TAHR_SHAPE_CAPSULE ? shape.radius : 0);
        shape.half_height = min_of(low, shape.half_height);
    }
    return shape;
}

/* How far the shape may go along up beside its foot or centre, and what it becomes. */
typedef struct change {
    tahr_shape shape;
    vec3 at;          /* with the foot or the centre kept */
    double low, high; /* m */
    int on_ground, grows;
} change;

/* A cone and an ellipsoid that shrink stick out of what they were: a flatter end is wider at the same height. */
static int sticks_out(uint32_t type, double taller, double wider)
{
    return (type == TAHR_SHAPE_CONE || type == TAHR_SHAPE_ELLIPSOID) && (taller != 0 || wider != 0);
}

/* On ground only what a wider foot needs on a slope, and down what is left of the clearance that everything keeps. */
static change plan(const tahr__step *step, const tahr_shape *shape)
{
    const tahr_shape *now = &step->limits->shape;
    const tahr_config *c = step->config;
    double taller = shape->half_height - now->half_height, wider = shape->radius - now->radius;
    change to = {.shape = *shape, .at = step->state.position, .grows = taller > 0 || wider > 0};
    if (sticks_out(shape->type, taller, wider)) {
        to.grows = 1;
        wider = max_of(wider, max_of(taller, -taller));
    }
    to.on_ground = step->state.mode == TAHR_MODE_WALKING;
    if (to.on_ground) {
        double least = c->separation == TAHR_SEPARATION_MARGIN ? c->skin : room_of(c);
        double gap = floor_is_current(step) && floor_is_walkable(&step->state.floor) ? step->state.floor.distance : 0;
        to.at = add_scaled(to.at, step->state.up, taller);
        to.low = -max_of(gap - least, 0);
        to.high = max_of(wider, 0);
    } else {
        to.high = max_of(taller, 0) + min_of(max_of(wider, 0), now->half_height);
        to.low = -to.high;
    }
    return to;
}

/* The ways along up, from the place to->at, that leave a skin to all that was found in the way. */
typedef struct span {
    double low, high;
} span;

static void narrow(const tahr__step *step, const tahr_contact *contacts, uint32_t count, double shift, span *free)
{
    for (uint32_t i = 0; i < count; i++) {
        double rate = dot(contacts[i].normal, step->state.up);
        double lack = step->config->skin - contacts[i].distance;
        if (rate > SIDEWAYS) {
            free->low = max_of(free->low, shift + lack / rate);
        } else if (rate < -SIDEWAYS) {
            free->high = min_of(free->high, shift + lack / rate);
        }
    }
}

/* The least of them; half-way where floor and ceiling leave less than a skin each. */
static double least_way(const span *free, const change *to)
{
    double way = free->low > free->high ? 0.5 * (free->low + free->high) : clamp(0, free->low, free->high);
    return clamp(way, to->low, to->high);
}

static int fits(tahr__step *step, vec3 at, tahr_contact *contacts, uint32_t *count)
{
    double room = room_of(step->config);
    *count = tahr__contacts(step, at, room, contacts, CONTACTS);
    return *count == 0 || contacts[0].distance >= room;
}

/* Looks for room with the new shape in use. [out] at. */
static int find_room(tahr__step *step, const change *to, vec3 *at)
{
    tahr_contact contacts[CONTACTS];
    uint32_t count;
    span free = {-INFINITY, INFINITY};
    double shift = 0, next = 0;
    *at = to->at;
    int ok = fits(step, *at, contacts, &count);
    for (int tries = 0; tries < 2 && !ok; tries++) { /* away from what is in the way, and then from what is behind */
        narrow(step, contacts, count, shift, &free);
        next = least_way(&free, to);
        if (next == shift) {
            break;
        }
        shift = next;
        *at = add_scaled(to->at, step->state.up, shift);
        ok = fits(step, *at, contacts, &count);
    }
    tahr_hit hit;
    memset(&hit, 0, sizeof hit);
    hit.body = TAHR_NO_BODY;
    if (!ok) {
        hit.body = contacts[0].body;
        hit.feature = contacts[0].feature;
        hit.normal = contacts[0].normal;
        hit.point = contacts[0].point;
    }
    return tahr__decide(step, TAHR_RULE_SHAPE, ok, &hit, ok ? 0 : contacts[0].distance, room_of(step->config),
                        "room for a larger shape");
}

/* The floor stays known where neither the foot nor its width changed. */
static void take(tahr__step *step, const change *to, vec3 at)
{
    tahr_state *s = &step->state;
    int known = to->on_ground && floor_is_current(step) && to->shape.radius == s->radius && vec_equal(at, to->at);
    s->radius = to->shape.radius;
    s->half_height = to->shape.half_height;
    s->position = at;
    s->floor_position = known ? at : s->floor_position;
    s->floor_revision = known ? s->floor_revision : 0;
    tahr__event(step, TAHR_EVENT_SHAPE, NULL, s->half_height);
}

static void change_shape(tahr__step *step, const tahr_shape *shape)
{
    change to = plan(step, shape);
    vec3 at = to.at;
    tahr__limits own;
    const tahr__limits *before = step->limits;
    int owned = before == &step->own_limits;
    if (owned) {
        own = step->own_limits;
    }
    tahr__use_shape(step, shape->radius, shape->half_height);
    if (!to.grows || find_room(step, &to, &at)) {
        take(step, &to, at);
        return;
    }
    if (owned) {
        step->own_limits = own;
    }
    step->limits = before;
    step->report.flags |= TAHR_REPORT_SHAPE_REFUSED;
}

void tahr__take_stance(tahr__step *step)
{
    tahr_state *s = &step->state;
    if (s->mode != TAHR_MODE_NONE && s->mode != TAHR_MODE_HANGING) {
        tahr_shape shape = wanted(step);
        if (shape.radius != s->radius || shape.half_height != s->half_height) {
            change_shape(step, &shape);
        }
    }
    int crouched = s->half_height < step->config->shape.half_height;
    s->flags = (s->flags & ~(uint32_t)TAHR_STATE_CROUCHED) | (crouched ? (uint32_t)TAHR_STATE_CROUCHED : 0u);
}

/* It may be shifted as far as it grows, and reach as far again. */
void tahr__announce_stance(const tahr__step *step, tahr_bounds *bounds)
{
    const tahr_shape *now = &step->limits->shape;
    tahr_shape shape = wanted(step);
    double taller = shape.half_height - now->half_height, wider = shape.radius - now->radius;
    double reach = 2 * max_of(taller, -taller) + 2 * max_of(wider, 0);
    bounds->min = sub(bounds->min, vec(reach, reach, reach));
    bounds->max = add(bounds->max, vec(reach, reach, reach));
}

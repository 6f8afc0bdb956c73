/* SPDX-License-Identifier: MIT
 * step_contact.c: config.step_rule CONTACT: up, along, down, and judged by where the shape came down. For the face
 * behind the edge as the judge see step_up.c. */
#include "drop.h"
#include "floor.h"
#include "floor_distance.h"
#include "plane.h"
#include "report.h"
#include "scope.h"
#include "slide.h"
#include "step_up.h"

/* MAX_STEP_SIDE_Z: a face that rises or leans less is the front of a step. */
static const double STEP_SIDE = 0.08;

typedef struct attempt {
    vec3 up;
    double rise, drop; /* m of the ways up and down */
    double base;       /* m along up: under the foot; what is met no higher is no step */
    double floor;      /* m along up: what the height of the step is measured from */
    tahr_floor found;
    int found_floor;
} attempt;

static int refuse(tahr__step *step, const tahr_hit *hit, double value, double limit, const char *reason)
{
    return tahr__decide(step, TAHR_RULE_STEP_UP, 0, hit, value, limit, reason);
}

/* CanStepUp */
static int can_step_up(const tahr__step *step, const tahr_hit *hit)
{
    return is_blocked(hit) && step->state.mode != TAHR_MODE_FALLING &&
           !(world_body_flags(step->world, hit->body) & TAHR_BODY_NO_STEP) && !tahr__is_one_way(step, hit->body);
}

/* How far up and down, and from where. On a floor the hover gap is part of the step; the way down is longer by two
 * bands, to come as close to the floor as before. */
static void plan(const tahr__step *step, const tahr__swept *obstacle, attempt *a)
{
    const tahr_config *c = step->config;
    const tahr_floor *floor = &step->state.floor;
    a->rise = a->drop = c->step_height;
    a->base = a->floor = dot(step_foot(step), a->up);
    if (step->state.mode == TAHR_MODE_WALKING && floor_is_walkable(floor)) {
        int line = (floor->flags & TAHR_FLOOR_LINE) != 0;
        double gap = max_of(line ? floor->perch_distance : floor->distance, 0);
        int level = tahr__is_within_edge_tolerance(step, obstacle->location, obstacle->hit.point, step->limits->width);
        a->base -= gap;
        a->floor = !line && level ? dot(floor->point, a->up) : a->floor - floor->distance;
        a->rise = max_of(c->step_height - gap, 0);
        a->drop = c->step_height + 2 * c->floor_max * c->skin;
    }
}

/* At the height of the step, along what is in the way there too. Returns 1 to go on down. */
static int forward(tahr__step *step, vec3 motion, const tahr_hit *above)
{
    tahr__swept ahead;
    tahr__move_updated(step, motion, 0, &ahead);
    if (ahead.hit.start_overlap) {
        return refuse(step, &ahead.hit, ahead.hit.depth, 0, "overlaps something when raised");
    }
    if (!is_blocked(&ahead.hit)) {
        return 1;
    }
    if (is_blocked(above)) {
        tahr__handle_impact(step, above);
    }
    tahr__handle_impact(step, &ahead.hit);
    double part = ahead.hit.fraction;
    double slid = tahr__slide_along_surface(step, motion, 1 - part, ahead.hit.normal, &ahead);
    return part > 0 || slid > 0 || refuse(step, &ahead.hit, part, 0, "blocked at step height too");
}

/* May it come down on this? side: how much the face that was in the way rises. */
static int judge(tahr__step *step, vec3 motion, double side, vec3 before, const tahr__swept *down, attempt *a)
{
    const tahr_hit *hit = &down->hit;
    double height = dot(hit->point, a->up) - a->floor;
    double gain = dot(sub(down->location, before), a->up);
    if (height > step->config->step_height) {
        return refuse(step, hit, height, step->config->step_height, "higher than a step");
    }
    if (!tahr__is_walkable(step, hit, 0) && (dot(motion, hit->surface_normal) < 0 || gain > 0)) {
        return refuse(step, hit, dot(hit->surface_normal, a->up), step->limits->walkable, "landing face too steep");
    }
    if (!tahr__is_within_edge_tolerance(step, down->location, hit->point, step->limits->width)) {
        return refuse(step, hit, 0, 0, "came down on its rim");
    }
    if (height > 0 && !can_step_up(step, hit)) {
        return refuse(step, hit, height, 0, "not to be stepped up on");
    }
    tahr__supplied supplied = supplied_by(down);
    tahr__find_floor(step, step->config->snap_distance, &supplied, &a->found);
    if (gain > 0 && !(a->found.flags & TAHR_FLOOR_BLOCKING) && side < STEP_SIDE) {
        return refuse(step, hit, a->found.distance, 0, "no floor to stand on there");
    }
    a->found_floor = 1;
    return 1;
}

static int go_over(tahr__step *step, vec3 motion, double side, vec3 before, attempt *a)
{
    tahr__swept swept;
    tahr__move_updated(step, scale(a->up, a->rise), 0, &swept);
    if (swept.hit.start_overlap) {
        return refuse(step, &swept.hit, swept.hit.depth, 0, "no room to rise");
    }
    const tahr_hit above = swept.hit;
    if (!forward(step, motion, &above)) {
        return 0;
    }
    tahr__move_updated(step, scale(a->up, -a->drop), 0, &swept);
    if (swept.hit.start_overlap) {
        return refuse(step, &swept.hit, swept.hit.depth, 0, "overlaps something when down");
    }
    return !is_blocked(&swept.hit) || judge(step, motion, side, before, &swept, a);
}

static void tell(tahr__step *step, vec3 before, const attempt *a, const tahr_hit *obstacle)
{
    double gain = dot(sub(step->state.position, before), a->up);
    double height = a->found_floor ? dot(a->found.point, a->up) - a->floor : gain;
    step->report.step_offset += gain;
    tahr__decide(step, TAHR_RULE_STEP_UP, 1, obstacle, gain, step->config->step_height, "came down");
    if (height > step->config->skin) { /* not again while the foot rolls over the same edge */
        tahr__event(step, TAHR_EVENT_STEPPED_UP, obstacle, height);
    }
}

int tahr__step_up_by_contact(tahr__step *step, vec3 motion, const tahr__swept *obstacle, int *found_floor)
{
    tahr__scope scope;
    attempt a = {.up = step->state.up};
    const tahr_hit hit = obstacle->hit;
    const tahr_shape *s = &step->limits->shape;
    *found_floor = 0;
    if (!can_step_up(step, &hit) || step->config->step_height <= 0 || step->pull->size == 0 || !may_rise(step)) {
        return 0;
    }
    plan(step, obstacle, &a);
    double at = dot(hit.point, a.up), cap = dot(step->state.position, a.up) + (s->half_height - s->radius);
    /* A skin away from its floor a shape may be stopped by the rounding of that: then up and down again goes on. */
    int floor_stops = step->config->separation == TAHR_SEPARATION_MARGIN;
    if (at > cap || (at <= a.base && !floor_stops)) {
        return refuse(step, &hit, at, at > cap ? cap : a.base, "met too high, or no higher than the floor");
    }
    const vec3 before = step->state.position;
    tahr__scope_open(step, &scope);
    if (!go_over(step, motion, dot(hit.surface_normal, a.up), before, &a) || step->error < 0) {
        tahr__scope_revert(step, &scope);
        return 0;
    }
    if (a.found_floor) {
        tahr__keep_floor(step, &a.found);
    }
    *found_floor = a.found_floor;
    tell(step, before, &a, &hit);
    return 1;
}

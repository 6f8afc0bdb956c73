/* SPDX-License-Identifier: MIT
 * step_up.c: getting onto low obstacles: forward at step height, then down, judged by the face that is landed on.
 *
 * A round foot that has come 33 mm over a step (2 m/s at 60 Hz) touches its edge with a normal far from upright;
 * judging that normal refuses the step in every frame. The face behind the edge does not depend on how far the foot has
 * come, so the decision is the same at every frame rate, and needs no memory of former frames. */
#include "step_up.h"

#include "drop.h"
#include "floor.h"
#include "lip.h"
#include "plane.h"
#include "query.h"
#include "report.h"
#include "scope.h"
#include "shape.h"

/* Less progress than this part of the radius at step height is a wall, not a step. */
static const double PROGRESS = 1e-4;

typedef struct attempt {
    vec3 up;
    double lift;    /* m, raised by */
    int whole;      /* 1: a part of the motion is not worth it */
    double covered; /* part of the motion */
    int rises;      /* 1: the way up has been asked for */
    int lands;      /* 1: so has the way down from there, */
    int judged;     /* and it is a step */
    vec3 position;  /* landed at */
    double rise;    /* m, landing above what held the foot */
    tahr_hit landing;
} attempt;

static int refuse(tahr__step *step, const tahr_hit *hit, double value, double limit, const char *reason)
{
    return tahr__decide(step, TAHR_RULE_STEP_UP, 0, hit, value, limit, reason);
}

/* Sweeps forward from the raised place. Returns the part of the motion that is free there. */
static double free_ahead(tahr__step *step, vec3 motion, const attempt *a, tahr_hit *hit)
{
    vec3 raised = add_scaled(step->state.position, step->state.up, a->lift);
    tahr__sweep(step, &step->limits->shape, raised, motion, step->config->skin, 0, hit);
    double part = hit->start_overlap ? 0 : hit->fraction;
    return part == 1 || (part * length(motion) > PROGRESS * step->limits->width && !a->whole) ? part : 0;
}

/* Would the raised shape, by whatever part of the lift, touch the same point of a wall, with its side? Then it gets no
 * farther up there, and no sweep need say so: whatever else it meets, the point stays in the way. Of a wall that leans
 * the shape is up there as near to a higher place, or nearer, and would leave that place and the point both if it
 * nearly passed the wall: a way that turns by half of into^2 from the wall's does not, as long as that is more of its
 * distance from the axis than the wall leans over it. Half of what is allowed is left for rounding and the bend of the
 * circle. */
static int blocks_raised(const tahr__step *step, vec3 motion, const tahr_hit *obstacle, double lift)
{
    const double upright = 1e-9, against = 1e-3; /* less is the rounding of a face, and of a motion along it */
    const double nearly = 1e-3;
    /* m: of less the hair of a backend's sweeps (1e-9) and the rounding of places 1e7 m out (2e-9) decide. */
    const double told = 1e-7;
    const tahr__limits *l = step->limits;
    const vec3 up = step->state.up, off = sub(obstacle->point, step->state.position);
    double lean = dot(obstacle->normal, up), at = dot(off, up), size = length(motion);
    double into = -dot(motion, obstacle->normal) / size, over = max_of(at - l->axis, 0);
    int straight = l->shape.type == TAHR_SHAPE_SPHERE || l->shape.type == TAHR_SHAPE_CAPSULE;
    int side = lean < nearly && lean > -nearly && at - lift >= -l->axis && into > against;
    if (!side || !straight || PROGRESS * l->width < told || !step->config->barred_steps ||
        step->config->separation != TAHR_SEPARATION_MARGIN) {
        return 0;
    }
    if (lean < upright && lean > -upright) {
        return over == 0 && obstacle->distance - step->config->skin <= into * PROGRESS * l->width;
    }
    const vec3 level = reject(off, up);
    double away = sqrt(length_squared(level) + over * over), gap = away - l->shape.radius - step->config->skin;
    double toward = dot(motion, level) / (away * size);
    return over < l->shape.radius * nearly && toward > against &&
           gap <= 0.5 * toward * min_of(PROGRESS * l->width, size) &&
           2 * lift * (lean < 0 ? -lean : lean) < away * toward * toward;
}

/* Raises it only as far as a ceiling lets. Returns 0 if that is not enough. */
static int rise(tahr__step *step, vec3 motion, attempt *a)
{
    const tahr_config *c = step->config;
    tahr_hit ahead, above;
    tahr__sweep(step, &step->limits->shape, step->state.position, scale(a->up, a->lift), c->skin, 0, &above);
    a->rises = 1;
    if (is_blocked(&above)) {
        a->lift *= above.fraction;
        a->covered = free_ahead(step, motion, a, &ahead);
        a->lands = a->judged = 0;
    }
    if (above.start_overlap || a->covered == 0) {
        return refuse(step, &above, a->lift, c->step_height, "no room to rise");
    }
    return 1;
}

/* How far the shape could go forward if it were raised. Forward comes first: a tall wall is then refused by one sweep.
 * What is over a shape whose straight part is longer than the lift, and stops it on the way up, overlaps it up there:
 * where it does not, the way up is asked for last, if the step is one at all. */
static int forward(tahr__step *step, vec3 motion, const tahr_hit *obstacle, attempt *a)
{
    tahr_hit ahead;
    if (blocks_raised(step, motion, obstacle, a->lift)) {
        tahr__sweep_barred(step);
        return refuse(step, obstacle, 0, 0, "blocked at step height too");
    }
    a->covered = free_ahead(step, motion, a, &ahead);
    if (a->covered < 1) {
        a->lands = a->judged = 0;
    }
    if (a->covered == 0 && !ahead.start_overlap) {
        return refuse(step, &ahead, ahead.fraction, 0, "blocked at step height too");
    }
    return (a->covered > 0 && 2 * step->limits->axis >= a->lift) || rise(step, motion, a);
}

/* Height of the floor that a step to the height `to` is measured from. Who leans on a face too steep to stand on stands
 * on the floor before it, and no step is higher for how far the foot has come up there. On the front of a step the foot
 * is on that step already, as it is on a sharp edge; asked only where it makes a difference. */
static double floor_height(tahr__step *step, double to)
{
    const tahr_floor *floor = &step->state.floor;
    double at = dot(floor->point, step->state.up);
    if ((floor->flags & TAHR_FLOOR_FACE) || !(floor->flags & TAHR_FLOOR_PERCHING)) {
        return at;
    }
    double foot = dot(step->state.floor_position, step->state.up) - step->limits->shape.half_height;
    double before = foot - floor->perch_distance;
    tahr_hit face = {.blocking = 1, .surface_normal = floor->surface_normal, .point = floor->point};
    return to - before > step->config->step_height + TAHR__HEIGHT_ROUNDING && tahr__is_lip(step, &face) ? at : before;
}

/* Does a face too steep to stand on lead to a tread? */
static int leads_up(tahr__step *step, const tahr_hit *hit, double base)
{
    int on_lip = !(step->state.floor.flags & (TAHR_FLOOR_FACE | TAHR_FLOOR_PERCHING));
    return on_lip ? tahr__is_lip(step, hit) : tahr__tread_behind(step, hit, base);
}

/* Down from the raised place, `part` of the motion ahead. */
static void lower(tahr__step *step, vec3 motion, double part, attempt *a)
{
    const tahr_config *c = step->config;
    vec3 raised = add_scaled(add_scaled(step->state.position, a->up, a->lift), motion, part);
    vec3 down = scale(a->up, -(a->lift + c->snap_distance));
    tahr__sweep(step, &step->limits->shape, raised, down, c->skin, 0, &a->landing);
    a->position = add_scaled(raised, down, a->landing.fraction);
}

static int judge(tahr__step *step, attempt *a)
{
    const tahr_config *c = step->config;
    const tahr_hit *hit = &a->landing;
    if (!hit->blocking || hit->start_overlap) {
        return refuse(step, hit, a->lift + c->snap_distance, 0, "nothing to land on");
    }
    if (tahr__is_one_way(step, hit->body)) {
        return refuse(step, hit, 0, 0, "passed from below");
    }
    double top = dot(hit->point, a->up), base = floor_height(step, top);
    a->rise = top - dot(step->state.floor.point, a->up);
    if (top - base > c->step_height + TAHR__HEIGHT_ROUNDING) {
        return refuse(step, hit, top - base, c->step_height, "higher than a step");
    }
    if (!tahr__is_walkable(step, hit, 0) && !leads_up(step, hit, base)) {
        return refuse(step, hit, dot(hit->surface_normal, a->up), step->limits->walkable, "landing face too steep");
    }
    return 1;
}

static int land(tahr__step *step, vec3 motion, attempt *a)
{
    if (!a->lands) {
        lower(step, motion, a->covered, a);
        a->lands = 1;
    }
    a->judged = a->judged || judge(step, a);
    return a->judged;
}

/* A steep face that leans back gives way to the raised shape, and is mostly what it comes down on again: a slope. So
 * there it is lowered first, at the end of the motion. Returns 1 if that is the same face, and no step. */
static int stays_on_slope(tahr__step *step, vec3 motion, const tahr_hit *obstacle, attempt *a)
{
    const double leaning = 0.1, same = 1 - 1e-12; /* 6 degrees; rounding */
    const tahr_hit *hit = &a->landing;
    int walkable = dot(obstacle->surface_normal, a->up) >= tahr__walkable_limit(step, obstacle, 0);
    if (dot(obstacle->normal, a->up) < leaning || walkable) {
        return 0;
    }
    lower(step, motion, 1, a);
    a->lands = hit->blocking && !hit->start_overlap && !hit->unknown;
    int is_slope = a->lands && hit->body == obstacle->body && dot(hit->surface_normal, obstacle->surface_normal) > same;
    return is_slope && !land(step, motion, a);
}

static int by_contact(tahr__step *step, vec3 motion, const tahr_hit *obstacle)
{
    tahr__swept here = {.hit = *obstacle, .location = step->state.position};
    int found_floor;
    return tahr__step_up_by_contact(step, motion, &here, &found_floor);
}

double tahr__step_up_at(tahr__step *step, vec3 motion, const tahr__swept *obstacle, int *found_floor)
{
    if (step->config->step_rule == TAHR_STEP_BY_CONTACT) {
        return tahr__step_up_by_contact(step, motion, obstacle, found_floor);
    }
    double covered = tahr__step_up(step, motion, &obstacle->hit, NULL);
    *found_floor = covered > 0;
    return covered;
}

double tahr__step_up(tahr__step *step, vec3 motion, const tahr_hit *obstacle, uint32_t *lowered)
{
    const tahr_config *c = step->config;
    tahr__scope scope;
    tahr_floor floor;
    attempt a = {.up = step->state.up, .lift = c->step_height, .whole = lowered && *lowered};
    if (c->step_rule == TAHR_STEP_BY_CONTACT) {
        return by_contact(step, motion, obstacle);
    }
    if (c->step_height <= 0 || !may_rise(step) || !floor_is_walkable(&step->state.floor) ||
        dot(obstacle->normal, a.up) < -0.1) { /* struck by the upper half: a ceiling or an overhang */
        return 0;
    }
    if (stays_on_slope(step, motion, obstacle, &a) || !forward(step, motion, obstacle, &a) || !land(step, motion, &a)) {
        return 0;
    }
    if (!a.rises && (!rise(step, motion, &a) || !land(step, motion, &a))) {
        return 0;
    }
    tahr__scope_open(step, &scope);
    step->state.position = a.position;
    tahr__supplied landing = {.hit = &a.landing};
    tahr__find_floor(step, c->snap_distance, &landing, &floor);
    if (!floor_is_walkable(&floor) || step->error < 0) {
        tahr__scope_revert(step, &scope);
        refuse(step, &a.landing, floor.distance, 0, "no floor to stand on there");
        return 0;
    }
    double gain = dot(sub(a.position, scope.position), a.up);
    tahr__keep_floor(step, &floor);
    /* The hit that told the floor ended a hair from where a look from here would: standing looks again. */
    step->state.flags |= TAHR_STATE_FLOOR_MOVED;
    step->report.step_offset += gain;
    tahr__decide(step, TAHR_RULE_STEP_UP, 1, &a.landing, gain, c->step_height, "landed");
    if (a.rise > c->skin) { /* not again while the foot rolls over the same edge */
        tahr__event(step, TAHR_EVENT_STEPPED_UP, &a.landing, a.rise);
    }
    if (lowered) {
        *lowered = a.covered < 1 && a.lift < c->step_height;
    }
    return a.covered;
}

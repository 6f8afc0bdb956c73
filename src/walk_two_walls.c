/* SPDX-License-Identifier: MIT
 * walk_two_walls.c: walking in slices: a velocity, one motion along the floor, a look at the floor under its end. For
 * config.slide_solver JOINT see walking.c. */
#include "walk_two_walls.h"

#include <string.h>

#include "floor.h"
#include "floor_distance.h"
#include "launch.h"
#include "move_along_floor.h"
#include "nearby.h"
#include "overlap.h"
#include "plane.h"
#include "query.h"
#include "report.h"
#include "scope.h"
#include "stance.h"
#include "stepped.h"
#include "walking.h"

typedef struct walk {
    double left, h;    /* s after this slice, and of it */
    vec3 from;         /* where the slice began */
    tahr__scope scope; /* of the slice, where it may have to be taken back */
    vec3 delta;        /* level motion of the slice */
    double settled;    /* m up at its end, to keep the clearance: no motion of its own */
    int zero;          /* there is none */
    int tried_ledge;   /* once a step */
    int checked_fall;  /* whether the floor may be left was asked already, and denied */
} walk;

enum { GOES_ON, ENDS, FALLS };

/* LedgeCheckThreshold, 4 cm where pull_back is 0.1 cm: how much deeper than a step the floor beside a ledge may lie. */
static double ledge_drop(const tahr_config *c)
{
    return c->step_height + 40 * c->pull_back;
}

static void look_for_floor(tahr__step *step)
{
    tahr_floor floor;
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    tahr__keep_floor(step, &floor);
}

/* A floor that is not known because the shape overlaps something below. */
static int is_overlapped(const tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    int stuck = !(floor->flags & TAHR_FLOOR_BLOCKING) && floor->body != TAHR_NO_BODY;
    return stuck || (step->config->floor_probe == TAHR_FLOOR_PROBE_WHOLE && floor->distance < 0);
}

/* The velocity of the slice, and its motion. */
static void begin_slice(tahr__step *step, walk *w)
{
    tahr_state *s = &step->state;
    const double tiny = tiny_length(step->config);
    tahr__law law = tahr__walking_law(step);
    vec3 before = tahr__level_velocity(step, s->velocity);
    if (is_driven(step)) {
        before = step_level(step, step->input->drive);
        law = drive_law(before);
    }
    step->just_teleported = 0;
    w->settled = 0;
    w->from = s->position;
    if (!may_walk_off(step)) {
        tahr__scope_open(step, &w->scope);
    }
    if (step->config->integrator == TAHR_INTEGRATOR_STEPPED) {
        s->velocity = tahr__calc_velocity(step->config, &law, 0, before, w->h);
        w->delta = scale(s->velocity, w->h);
    } else {
        tahr__motion m = tahr__law_advance(&law, before, w->h);
        step->ahead = max_of(m.stop_time, 0);
        s->velocity = m.velocity;
        w->delta = m.displacement;
    }
    if (length_squared(before) > 0 && length_squared(s->velocity) == 0) {
        tahr__event(step, TAHR_EVENT_STOPPED, NULL, 0);
    }
    if (is_drifting(step)) {
        w->delta = add_scaled(w->delta, step_level(step, step->input->drive), w->h);
    }
    vec3 d = w->delta;
    w->zero = max_of(max_of(d.x, -d.x), max_of(max_of(d.y, -d.y), max_of(d.z, -d.z))) <= tiny;
}

/* The part of the slice that was not used: seen from above, what is missing of its motion. */
static double unused_time(const tahr__step *step, const walk *w)
{
    double asked = length(w->delta);
    double made = length(step_level(step, sub(step->state.position, w->from)));
    return w->h * (1 - min_of(1, made / asked));
}

/* StartFalling: the rest of the time is for the fall. Who only stood falls in the next step. */
static int start_falling(tahr__step *step, walk *w)
{
    double left = w->left;
    w->left = w->zero ? 0 : left + unused_time(step, w);
    step->ahead = w->h + left - w->left;
    tahr__leave_floor(step);
    memset(&step->state.floor, 0, sizeof step->state.floor);
    step->state.floor.body = TAHR_NO_BODY;
    step->state.floor_position = step->state.position;
    step->state.floor_revision = 0;
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_LEDGE);
    return FALLS;
}

/* CheckFall, once a step: who has nowhere to be must leave the floor. */
static int check_fall(tahr__step *step, walk *w, int must)
{
    int falls = (must || !w->checked_fall) && (must || may_walk_off(step));
    w->checked_fall = 1;
    return falls ? start_falling(step, w) : GOES_ON;
}

/* CheckLedgeDirection */
static int has_floor_beside(tahr__step *step, vec3 from, vec3 side)
{
    const tahr_config *c = step->config;
    const tahr_shape *shape = &step->limits->shape;
    double margin = c->separation == TAHR_SEPARATION_MARGIN ? c->skin : 0;
    tahr_hit hit;
    tahr__sweep(step, shape, from, side, margin, 0, &hit);
    if (!hit.blocking) {
        tahr__sweep(step, shape, add(from, side), scale(step->state.up, -ledge_drop(c)), margin, 0, &hit);
    }
    return hit.blocking && hit.fraction < 1 && tahr__is_walkable(step, &hit, 0);
}

vec3 tahr__ledge_move(tahr__step *step, vec3 from, vec3 delta)
{
    vec3 right = along_plane(step->limits, cross(delta, step->state.up)), left = scale(right, -1);
    if (length_squared(right) == 0 || has_floor_beside(step, from, right)) {
        return right;
    }
    return has_floor_beside(step, from, left) ? left : vec(0, 0, 0);
}

/* The floor ends, and may not be left: beside, once a step, else not at all. */
static int hold_at_ledge(tahr__step *step, walk *w)
{
    vec3 beside = w->tried_ledge || w->zero ? vec(0, 0, 0) : tahr__ledge_move(step, w->from, w->delta);
    if (length_squared(beside) > 0) {
        double speed = length(step->state.velocity);
        tahr__scope_revert(step, &w->scope);
        w->tried_ledge = 1;
        w->left += w->h;
        w->h = 0;
        step->iterations--;
        step->state.velocity = scale(beside, speed / length(w->delta));
        tahr__decide(step, TAHR_RULE_LEDGE, 1, NULL, length(beside), 0, "floor beside the ledge");
        return GOES_ON;
    }
    /* Who stood on nothing before, lifted or squeezed there, is at no ledge. */
    if (check_fall(step, w, w->zero || !floor_is_walkable(&w->scope.floor)) == FALLS) {
        return FALLS;
    }
    tahr__decide(step, TAHR_RULE_LEDGE, 0, NULL, length(w->delta), 0, "no floor beside the ledge");
    tahr__scope_revert(step, &w->scope);
    step->state.velocity = vec(0, 0, 0);
    return ENDS;
}

/* Out of what the look for the floor started in: how deep that is the floor does not tell, so a bit in every step. */
static void leave_overlap(tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    tahr__swept swept = {.hit = {.blocking = 1,
                                 .start_overlap = 1,
                                 .normal = floor->normal,
                                 .surface_normal = floor->surface_normal,
                                 .point = floor->point,
                                 .body = floor->body,
                                 .feature = floor->feature},
                         .start = step->state.position,
                         .location = step->state.position};
    swept.motion = scale(step->state.up, step->config->floor_max * step->config->skin);
    tahr__resolve_penetration(step, tahr__penetration_adjustment(step, &swept.hit), &swept);
    step->state.flags |= TAHR_STATE_FLOOR_MOVED;
}

/* Follows the floor that is there, or leaves the one that is not. */
static int follow_floor(tahr__step *step, walk *w)
{
    if (floor_is_walkable(&step->state.floor)) {
        w->settled = tahr__settle(step);
        return GOES_ON;
    }
    if (is_overlapped(step)) {
        if (w->left <= 0) {
            leave_overlap(step);
        }
        return GOES_ON;
    }
    return check_fall(step, w, step->just_teleported || w->zero);
}

/* What was moved is what was fast: bumps brake, and a way that got longer up a face gives no speed. A closed form that
 * was not bumped knows its velocity at the end better. */
static void take_velocity(tahr__step *step, const walk *w)
{
    vec3 moved = add_scaled(sub(step->state.position, w->from), step->state.up, -w->settled);
    double way = length(step->config->keep_level_speed ? step_level(step, moved) : moved);
    double asked = length(w->delta), missing = way - asked, tiny = tiny_length(step->config);
    double part = asked < way ? asked / way : 1;
    int exact = step->config->integrator == TAHR_INTEGRATOR_EXACT;
    if (is_drifting(step)) { /* only a part of that was the velocity's doing */
        step->state.velocity = scale(step->state.velocity, asked > way ? way / asked : 1);
    } else if (!step->just_teleported && !(exact && missing * missing <= tiny * tiny)) {
        step->state.velocity = scale(moved, part / w->h);
    }
    step->state.velocity = tahr__level_velocity(step, step->state.velocity);
}

static int walk_slice(tahr__step *step, walk *w)
{
    int found_floor = 0;
    begin_slice(step, w);
    if (w->zero) {
        w->left = 0;
    } else {
        if (step_goes_far(step)) {
            tahr__announce_near(step, step->state.position, w->delta);
        }
        found_floor = tahr__move_along_floor(step, w->delta, w->h);
    }
    step->ahead = w->h;
    if (!found_floor) {
        look_for_floor(step);
    }
    int ends = !floor_is_walkable(&step->state.floor) && !may_walk_off(step);
    int answer = ends ? hold_at_ledge(step, w) : follow_floor(step, w);
    if (answer == GOES_ON && w->h > 0) {
        take_velocity(step, w);
        answer = vec_equal(step->state.position, w->from) ? ENDS : GOES_ON;
    }
    return answer;
}

tahr__next tahr__walk_two_walls(tahr__step *step, double time)
{
    walk w = {.left = time};
    int answer = GOES_ON;
    /* A world that changed does not: the slice looks at its end. */
    if (step->state.floor_revision == 0 || !vec_equal(step->state.floor_position, step->state.position)) {
        look_for_floor(step);
    }
    while (answer == GOES_ON && w.left >= TAHR__LEAST_TIME && step->error >= 0) {
        double begun = w.left;
        w.h = tahr__begin_iteration(step, w.left);
        if (w.h == 0) {
            w.left = 0;
            break;
        }
        w.left = begun - w.h;
        answer = walk_slice(step, &w);
        step->time += answer == ENDS ? begun : begun - w.left;
        step->ahead = 0;
        tahr__time_slice(step);
    }
    tahr__next next = {answer == FALLS ? TAHR_MODE_FALLING : TAHR_MODE_WALKING, answer == FALLS ? w.left : 0};
    return next;
}

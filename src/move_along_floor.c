/* SPDX-License-Identifier: MIT
 * move_along_floor.c: a level motion, taken along the floor, onto ramps and steps. For config.slide_solver JOINT see
 * path.c. */
#include "move_along_floor.h"

#include "drop.h"
#include "floor.h"
#include "move.h"
#include "report.h"
#include "slide.h"
#include "step_up.h"
#include "stepped.h"

/* A normal that rises less is a wall's. */
static const double UPRIGHT = 1e-4;

tahr__ramp tahr__floor_ramp(const tahr_floor *floor)
{
    tahr__ramp ramp = {floor->normal, floor->surface_normal,
                       floor_is_walkable(floor) && !(floor->flags & TAHR_FLOOR_LINE)};
    return ramp;
}

vec3 tahr__ground_movement_delta(const tahr__step *step, vec3 delta, const tahr__ramp *ramp)
{
    vec3 up = step->state.up;
    double steep = dot(ramp->surface_normal, up);
    if (!ramp->walkable || steep <= UPRIGHT || steep >= 1 - UPRIGHT || dot(ramp->normal, up) <= UPRIGHT) {
        return delta;
    }
    double rise = -dot(ramp->surface_normal, delta) / steep, size = length(delta);
    vec3 lifted = add_scaled(delta, up, rise);
    return step->config->keep_level_speed ? tahr__cap_rise(step, lifted, rise, size) : scale(unit(lifted), size);
}

/* The edge of a one-way body stops nothing that does not come down on it: a foot that leans on one rolls over it by
 * itself, else it would sink into what is behind it. */
static void roll_over_edge(const tahr__step *step, vec3 delta, tahr__ramp *ramp)
{
    vec3 up = step->state.up, n = ramp->normal, face = ramp->surface_normal;
    double lean = dot(n, up), steep = dot(face, up);
    if (lean > UPRIGHT && steep > UPRIGHT && dot(n, face) < 1 - 1e-6 &&
        dot(n, delta) / lean < dot(face, delta) / steep && tahr__is_one_way(step, step->state.floor.body)) {
        ramp->surface_normal = n;
    }
}

/* Held by an overlap that did not resolve: a slide along it may still come free, else the motion would hitch. */
static void leave_overlap(tahr__step *step, vec3 delta, tahr__swept *swept)
{
    tahr__handle_impact(step, &swept->hit);
    tahr__slide_along_surface(step, delta, 1, swept->hit.normal, swept);
}

/* Up the step that blocks the rest of the motion. Without level speeds the velocity becomes that of the way made, which
 * an overlap that is left may have made longer. */
static int step_up(tahr__step *step, vec3 rest, double time, const tahr__swept *obstacle, int *found_floor)
{
    vec3 before = step->state.position;
    if (tahr__step_up_at(step, rest, obstacle, found_floor) <= 0) {
        return 0;
    }
    if (!step->config->keep_level_speed) {
        step->just_teleported = 1; /* the rise is no velocity */
        if (time >= TAHR__LEAST_TIME) {
            vec3 made = step_level(step, sub(step->state.position, before));
            double way = length(made), most = length(rest);
            step->state.velocity = scale(made, (way > most ? most / way : 1) / time);
        }
    }
    return 1;
}

/* A second ramp behind the first. Returns the part of the whole motion covered so far. */
static double take_second_ramp(tahr__step *step, vec3 delta, tahr__swept *swept)
{
    tahr_hit *hit = &swept->hit;
    double applied = hit->fraction, left = 1 - applied;
    if (applied > 0 && dot(hit->normal, step->state.up) > UPRIGHT && tahr__is_walkable(step, hit, 0)) {
        tahr__ramp ramp = {hit->normal, hit->surface_normal, 1};
        tahr__decide(step, TAHR_RULE_RAMP, 1, hit, dot(hit->normal, step->state.up), UPRIGHT, "another ramp");
        tahr__safe_move(step, tahr__ground_movement_delta(step, scale(delta, left), &ramp), swept);
        applied = clamp(applied + hit->fraction * left, 0, 1);
    }
    return applied;
}

int tahr__move_along_floor(tahr__step *step, vec3 delta, double h)
{
    tahr__swept swept;
    tahr__ramp ramp = tahr__floor_ramp(&step->state.floor);
    int found_floor = 0;
    if (!floor_is_walkable(&step->state.floor)) {
        return 0;
    }
    roll_over_edge(step, delta, &ramp);
    tahr__safe_move(step, tahr__ground_movement_delta(step, delta, &ramp), &swept);
    if (swept.hit.start_overlap) {
        leave_overlap(step, delta, &swept);
        return 0;
    }
    double applied = is_blocked(&swept.hit) ? take_second_ramp(step, delta, &swept) : 1;
    if (!is_blocked(&swept.hit)) {
        return 0;
    }
    step->ahead = applied * h;
    if (!step_up(step, scale(delta, 1 - applied), (1 - applied) * h, &swept, &found_floor)) {
        tahr__handle_impact(step, &swept.hit);
        tahr__slide_along_surface(step, delta, 1 - applied, swept.hit.normal, &swept);
    }
    return found_floor;
}

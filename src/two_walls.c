/* SPDX-License-Identifier: MIT
 * two_walls.c: bending a motion along one surface and then along a second one, what is left is dropped:
 * config.slide_solver TWO_WALLS. For the joint projection see slide.c and cone.c. */
#include "floor.h"
#include "plane.h"
#include "report.h"
#include "slide.h"

/* Lengths of the field, as parts of config.pull_back, which is 0.1 cm there. */
static const double RISE_TOLERANCE = 0.001; /* 1e-4 cm: a slide that rises more than asked by less is left alone */
static const double SAME_WALL_NUDGE = 0.1;  /* 0.01 cm: off a wall that was met again */
static const double NO_MOTION = 0.01;       /* 1e-3 cm along every axis: not worth a second sweep */

/* Two normals whose cosine is within this of 1 are one wall. */
static const double SAME_WALL = 1e-4;
/* Slopes less than this (cosine or sine) are level, or upright. */
static const double LEVEL = 1e-5;
static const double UPRIGHT = 1e-4;

static int is_on_ground(const tahr__step *step)
{
    return step->state.mode == TAHR_MODE_WALKING;
}

/* A margin away from a surface, rounding must not point into it: of a motion, lifted off by a ten-billionth as in
 * slide.c. */
static double lift_of(const tahr__step *step, vec3 delta)
{
    return step->config->separation == TAHR_SEPARATION_MARGIN ? 1e-10 * length(delta) : 0;
}

static vec3 base_slide(const tahr__step *step, vec3 delta, double time, vec3 normal)
{
    vec3 n = normal;
    if (length_squared(step->config->plane) > 0) {
        n = unit(along_plane(step->limits, normal));
    }
    return scale(add_scaled(reject(delta, n), n, lift_of(step, delta)), time);
}

vec3 tahr__handle_slope_boosting(const tahr__step *step, vec3 slide, vec3 delta, double time, vec3 normal)
{
    vec3 up = step->state.up;
    double rise = dot(slide, up), asked = dot(delta, up) * time;
    if (rise <= 0 || rise - asked <= RISE_TOLERANCE * step->config->pull_back) {
        return slide;
    }
    vec3 kept = asked > 0 ? scale(slide, asked / rise) : vec(0, 0, 0);
    vec3 taken = step_level(step, sub(slide, kept));
    return add(kept, base_slide(step, taken, 1, unit(step_level(step, normal))));
}

vec3 tahr__slide_vector(const tahr__step *step, vec3 delta, double time, vec3 normal)
{
    vec3 slide = base_slide(step, delta, time, normal);
    return step->state.mode == TAHR_MODE_FALLING ? tahr__handle_slope_boosting(step, slide, delta, time, normal)
                                                 : slide;
}

static vec3 base_adjust(const tahr__step *step, vec3 delta, const tahr_hit *hit, vec3 old_normal)
{
    double left = 1 - hit->fraction, cosine = dot(old_normal, hit->normal);
    if (cosine <= 0) { /* a corner of 90 degrees or less: only the crease is left */
        vec3 along = unit(cross(hit->normal, old_normal));
        return scale(along, dot(delta, along) * left);
    }
    vec3 bent = tahr__slide_vector(step, delta, left, hit->normal);
    if (dot(bent, delta) <= 0) {
        return vec(0, 0, 0);
    }
    if (cosine > 1 - SAME_WALL) {
        bent = add_scaled(bent, hit->normal, SAME_WALL_NUDGE * step->config->pull_back);
    }
    return bent;
}

/* A walkable face is gone up along with the level part of the motion, but no higher than a step at once. Slantwise the
 * field's rise is a bit less than the face's; its hover gap makes up for that. A margin would stop at it for good. */
static vec3 up_along(const tahr__step *step, vec3 delta, vec3 bent, const tahr_hit *hit)
{
    vec3 up = step->state.up;
    double steep = dot(hit->normal, up);
    double rise = dot(unit(bent), up) * length(delta) / steep;
    if (step->config->separation == TAHR_SEPARATION_MARGIN) {
        rise = max_of(rise, -dot(hit->normal, step_level(step, delta)) / steep) + lift_of(step, delta);
    }
    vec3 ramp = scale(add_scaled(step_level(step, delta), up, rise), 1 - hit->fraction);
    double height = dot(ramp, up), most = step->config->step_height;
    return height > most ? scale(ramp, most / height) : ramp;
}

static int hangs_low(const tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    return floor->flags & TAHR_FLOOR_BLOCKING && floor->distance < step->config->skin;
}

vec3 tahr__two_wall_adjust(tahr__step *step, vec3 delta, const tahr_hit *hit, vec3 old_normal)
{
    vec3 bent = base_adjust(step, delta, hit, old_normal);
    double rise = dot(bent, step->state.up), steep = dot(hit->normal, step->state.up);
    if (!is_on_ground(step) || rise == 0) {
        return bent;
    }
    if (rise < 0) {
        return hangs_low(step) ? step_level(step, bent) : bent;
    }
    int walkable = steep >= step->limits->walkable || tahr__is_walkable(step, hit, 0);
    return walkable && steep > UPRIGHT ? up_along(step, delta, bent, hit) : step_level(step, bent);
}

vec3 tahr__slide_normal(tahr__step *step, vec3 delta, vec3 normal, const tahr_hit *hit)
{
    double steep = dot(normal, step->state.up);
    if (!is_on_ground(step)) {
        return normal;
    }
    if (steep > 0) {
        return tahr__is_walkable(step, hit, 0) ? normal : unit(step_level(step, normal));
    }
    if (steep < -UPRIGHT && hangs_low(step)) {
        vec3 floor = step->state.floor.normal;
        int opposed = dot(delta, floor) < 0 && dot(floor, step->state.up) < 1 - LEVEL;
        return unit(step_level(step, opposed ? floor : normal));
    }
    return normal;
}

void tahr__handle_impact(tahr__step *step, const tahr_hit *hit)
{
    tahr__event(step, TAHR_EVENT_HIT, hit, max_of(-dot(step->state.velocity, hit->normal), 0));
}

static int is_worth_a_sweep(const tahr__step *step, vec3 v)
{
    double least = NO_MOTION * step->config->pull_back;
    return max_of(max_of(v.x, -v.x), max_of(max_of(v.y, -v.y), max_of(v.z, -v.z))) >= least;
}

double tahr__slide_along_surface(tahr__step *step, vec3 delta, double time, vec3 normal, tahr__swept *swept)
{
    if (!swept->hit.blocking) {
        return 0;
    }
    vec3 along = tahr__slide_normal(step, delta, normal, &swept->hit);
    vec3 slide = tahr__slide_vector(step, delta, time, along);
    if (!tahr__decide(step, TAHR_RULE_SLIDE, dot(slide, delta) > 0, &swept->hit, length(slide), 0, "along a surface")) {
        return 0;
    }
    step->report.slides++;
    tahr__safe_move(step, slide, swept);
    double part = swept->hit.fraction;
    if (is_blocked(&swept->hit)) {
        tahr__handle_impact(step, &swept->hit);
        vec3 second = tahr__two_wall_adjust(step, slide, &swept->hit, along);
        if (is_worth_a_sweep(step, second) && dot(second, delta) > 0) {
            step->report.slides++;
            tahr__safe_move(step, second, swept);
            part += swept->hit.fraction * (1 - part);
            if (is_blocked(&swept->hit)) {
                tahr__handle_impact(step, &swept->hit);
            }
        }
    }
    return clamp(part, 0, 1);
}

/* SPDX-License-Identifier: MIT
 * perch.c: see perch.h. */
#include "perch.h"

#include "floor_distance.h"
#include "foot.h"
#include "lip.h"
#include "report.h"

double tahr__valid_perch_radius(const tahr__step *step)
{
    const tahr_config *c = step->config;
    double radius = step->limits->width, least = min_of(1.1 * c->pull_back, radius); /* 0.11 cm */
    return clamp(radius - max_of(c->perch_threshold, 0), least, radius);
}

int tahr__should_compute_perch(const tahr__step *step, const tahr_floor *floor, vec3 location, int check_radius)
{
    const tahr_config *c = step->config;
    if (!(floor->flags & TAHR_FLOOR_BLOCKING) || c->perch_threshold <= c->edge_tolerance) {
        return 0;
    }
    double inner = tahr__valid_perch_radius(step);
    return !check_radius || length_squared(step_level(step, sub(floor->point, location))) > inner * inner;
}

int tahr__compute_perch(tahr__step *step, const tahr__perch_look *look, tahr_floor *floor)
{
    vec3 up = step->state.up;
    if (look->deepest <= 0) {
        return 0;
    }
    double foot = dot(look->location, up) - step->limits->shape.half_height;
    double above = max_of(dot(look->point, up) - foot, 0);
    tahr__floor_look inner = {.from = look->location,
                              .line_distance = max_of(look->deepest - above, 0),
                              .sweep_distance = look->deepest + step->limits->width,
                              .radius = look->radius};
    tahr__compute_floor_distance(step, &inner, floor);
    int ok = floor_is_walkable(floor) && above + floor->distance <= look->deepest;
    return tahr__decide(step, TAHR_RULE_PERCH, ok, NULL, above + floor->distance, look->deepest,
                        "floor for the inner foot");
}

int tahr__holds_on_lip(tahr__step *step, const tahr_hit *hit)
{
    int lip = step->state.mode == TAHR_MODE_WALKING && tahr__is_lip(step, hit);
    return tahr__decide(step, TAHR_RULE_PERCH, lip, hit, dot(hit->surface_normal, step->state.up), 0,
                        "front of a step");
}

/* Under a face that is itself no floor it may lie no deeper than a step: that is a bevelled step, not a rock to lean
 * on. */
int tahr__perches(tahr__step *step, double reach, const tahr_hit *outer, tahr_floor *floor)
{
    tahr__foot inner = tahr__thinner_foot(step, step->config->perch_threshold);
    int surface_walkable = (floor->flags & TAHR_FLOOR_FACE) != 0;
    double deepest = surface_walkable ? reach + step->config->perch_extra : step->config->step_height;
    double range = deepest + step->config->skin;
    tahr_hit hit;
    foot_sweep(step, &inner, range, &hit);
    int ok = tahr__is_walkable(step, &hit, tahr__was_walkable(step, &hit));
    double distance = hit.blocking ? foot_clearance(step, &hit, range) : range;
    if (step->inner) {
        *step->inner = (tahr__inner){1, hit, hit.blocking ? distance : range + step->config->skin};
    }
    if (ok) {
        floor->flags |= TAHR_FLOOR_PERCHING;
        floor->perch_distance = distance;
    }
    tahr__decide(step, TAHR_RULE_PERCH, ok, &hit, distance, deepest, "floor for the inner foot");
    return ok || tahr__holds_on_lip(step, surface_walkable ? &hit : outer);
}

/* SPDX-License-Identifier: MIT
 * move_along_floor.h: a level motion, taken along the floor, onto ramps and steps, with config.slide_solver
 * TWO_WALLS. */
#ifndef TAHR_MOVE_ALONG_FLOOR_H
#define TAHR_MOVE_ALONG_FLOOR_H

#include "core.h"

/* What a motion may be lifted onto: a face that was swept onto, with its contact normal, and whether it is walkable. */
typedef struct tahr__ramp {
    vec3 normal, surface_normal;
    int walkable;
} tahr__ramp;

/* The state's floor as a ramp: not one that only a ray found. */
tahr__ramp tahr__floor_ramp(const tahr_floor *floor);

/* ComputeGroundMovementDelta: a level motion lifted onto a ramp: with config.keep_level_speed the same motion seen from
 * above (tahr__cap_rise), else of the same length. No query. */
vec3 tahr__ground_movement_delta(const tahr__step *step, vec3 delta, const tahr__ramp *ramp);

/* A motion of `size` metres seen from above, lifted by `rise`: whole, unless that is higher than a step and steeper
 * than 45 degrees; then as far as a step is high, as TwoWallAdjust does it. Faces so steep are walkable by an override
 * only, and near the upright their rise for a level motion has no bound. */
static inline vec3 tahr__cap_rise(const tahr__step *step, vec3 lifted, double rise, double size)
{
    double high = max_of(rise, -rise), most = max_of(step->config->step_height, size);
    return high > most ? scale(lifted, most / high) : lifted;
}

/* MoveAlongFloor: the level motion `delta` of a slice of h seconds, from a walkable floor: along it and a second ramp,
 * up a step, or along walls. Returns 1 if a step up has found the floor under the end. At most two moves, a step up and
 * a slide. */
int tahr__move_along_floor(tahr__step *step, vec3 delta, double h);

#endif

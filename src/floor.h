/* SPDX-License-Identifier: MIT
 * floor.h: what can be stood on, how far below it is, and keeping the right height above it. */
#ifndef TAHR_FLOOR_H
#define TAHR_FLOOR_H

#include "core.h"

/* Walkable test. was_walkable widens the limit by the hysteresis. No query. */
int tahr__is_walkable(tahr__step *step, const tahr_hit *hit, int was_walkable);

/* Cosine of the steepest slope that this face may have to be walkable. No query. */
double tahr__walkable_limit(const tahr__step *step, const tahr_hit *hit, int was_walkable);

/* Floor under the character's position, looked for down to `reach` metres (plus the clearance band). A hit of a vertical
 * sweep that ended here may be supplied instead of the first sweep. 1 sweep; at most TAHR__FLOOR_QUERIES. */
void tahr__find_floor(tahr__step *step, double reach, const tahr_hit *supplied, tahr_floor *floor);

/* 1 sweep, 1 retry with a thinner shape, 1 perch sweep, 4 rays for the front of a step, 1 contact query for a wedge. */
enum { TAHR__FLOOR_QUERIES = 8 };

/* Makes `floor` the state's floor as found at this position. */
static inline void tahr__keep_floor(tahr__step *step, const tahr_floor *floor)
{
    step->state.floor = *floor;
    step->state.floor_position = step->state.position;
    step->state.floor_revision = step->world->revision;
    step->state.flags &= ~(uint32_t)TAHR_STATE_FLOOR_MOVED;
}

/* Is the state's floor that of this position and this world? */
static inline int floor_is_current(const tahr__step *step)
{
    return step->state.floor_revision == step->world->revision &&
           vec_equal(step->state.floor_position, step->state.position);
}

/* What sweeps the way down for a shape on a backend with these TAHR_CAP_*. */
tahr__foot tahr__foot_of(const tahr_shape *shape, uint32_t capabilities);

/* Is the clearance in the band [skin, floor_max * skin]? Below it by no more than a backend's rounding is inside. */
static inline int floor_is_in_band(const tahr__step *step)
{
    double gap = step->state.floor.distance, skin = step->config->skin;
    return gap >= skin - 1e-6 && gap <= step->config->floor_max * skin;
}

/* Brings the clearance into the band, following the floor down or rising off it. Returns the
 * change of height. No query going down what the floor sweep has proven free, else one sweep. */
double tahr__adjust_height(tahr__step *step);

/* Held by faces that are each too steep, so that no motion downward is left? One contact query. */
int tahr__is_wedged(tahr__step *step);

static inline int floor_is_walkable(const tahr_floor *floor)
{
    return (floor->flags & TAHR_FLOOR_WALKABLE) != 0;
}

#endif

/* SPDX-License-Identifier: MIT
 * floor.h: what can be stood on, how far below it is, and keeping the right height above it. */
#ifndef TAHR_FLOOR_H
#define TAHR_FLOOR_H

#include "move.h"

/* A sweep of the character's shape that was made anyway, and ended where a floor is looked for. SHRUNK takes its hit in
 * place of a first sweep if it went straight down: it needs its motion, and the centre at the contact (without a
 * pull-back). */
typedef struct tahr__supplied {
    const tahr_hit *hit;
    vec3 motion, location;
} tahr__supplied;

static inline tahr__supplied supplied_by(const tahr__swept *swept)
{
    tahr__supplied supplied = {&swept->hit, swept->motion, swept->location};
    return supplied;
}

/* IsWalkable: was_walkable widens the limit by the hysteresis. No query. */
int tahr__is_walkable(tahr__step *step, const tahr_hit *hit, int was_walkable);

/* Cosine of the steepest slope that this face may have to be walkable. No query. */
double tahr__walkable_limit(const tahr__step *step, const tahr_hit *hit, int was_walkable);

/* Nearly the same face as a moment ago: within 0.8 degrees, less than the hysteresis. */
static inline int floor_is_same_face(const tahr_floor *old, const tahr_hit *hit)
{
    return old->body == hit->body && dot(old->surface_normal, hit->surface_normal) > 0.9999;
}

/* TAHR_FLOOR_SLOPE if it is, and has been found to be one. */
static inline uint32_t floor_still_slope(const tahr_floor *old, const tahr_hit *hit)
{
    return old->flags & TAHR_FLOOR_SLOPE && floor_is_same_face(old, hit) ? TAHR_FLOOR_SLOPE : 0;
}

/* Is it nearly the same face as the state's floor? Then, if that was walkable by itself, it keeps the benefit of the
 * hysteresis. No query. */
int tahr__was_walkable(const tahr__step *step, const tahr_hit *hit);

/* Cosine: contact normals that lean less from that of the face lie on it. */
#define TAHR__ON_FACE (1 - 1e-6)

/* FindFloor: under the character's position, looked for down to `reach` metres (plus the clearance band; with SHRUNK
 * less it, unless walking). A hit of a sweep that ended here may be supplied instead of the first sweep. With WHOLE 1
 * sweep, at most TAHR__FLOOR_QUERIES. With SHRUNK 0 where config.cached_floor lets it take the state's floor, else 1;
 * at most 6, with flat_base 10. */
void tahr__find_floor(tahr__step *step, double reach, const tahr__supplied *supplied, tahr_floor *floor);

/* The same with WHOLE, where the sweep of the whole foot has been answered already: one sweep less. */
void tahr__find_floor_met(tahr__step *step, double reach, const tahr_hit *met, tahr_floor *floor);

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

/* Is the clearance in the band [skin, floor_max * skin]? Below it by no more than a backend's rounding is inside. Of a
 * floor that a ray found tahr__adjust_height knows more. */
static inline int floor_is_in_band(const tahr__step *step)
{
    double gap = step->state.floor.distance, skin = step->config->skin;
    return gap >= skin - 1e-6 && gap <= step->config->floor_max * skin && !(step->state.floor.flags & TAHR_FLOOR_LINE);
}

/* AdjustFloorHeight: brings the clearance into the band, following the floor down or rising off it. Returns the change
 * of height. With WHOLE no query going down what the floor sweep has proven free, else one sweep. With SHRUNK no query
 * in the band, else one safe move; sets just_teleported where the height is no motion of the character's own. */
double tahr__adjust_height(tahr__step *step);

/* Held by faces that are each too steep, so that no motion downward is left? One contact query. See wedge.c. */
int tahr__is_wedged(tahr__step *step);

static inline int floor_is_walkable(const tahr_floor *floor)
{
    return (floor->flags & TAHR_FLOOR_WALKABLE) != 0;
}

#endif

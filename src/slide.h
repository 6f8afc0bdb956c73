/* SPDX-License-Identifier: MIT
 * slide.h: bending a motion along everything that was touched. */
#ifndef TAHR_SLIDE_H
#define TAHR_SLIDE_H

#include "core.h"
#include "move.h"

/* The part of `motion` that all planes leave: projected at once, then lifted off them by a ten-billionth, so that
 * rounding never points into a wall. count > 0. No query. */
vec3 tahr__bend(const tahr__plane *planes, uint32_t count, vec3 motion);

/* The same, and all of the motion where nothing was touched. */
static inline vec3 tahr__slide(const tahr__plane *planes, uint32_t count, vec3 motion)
{
    return count ? tahr__bend(planes, count, motion) : motion;
}

/* The plane of a hit, met at the character's present position. */
tahr__plane tahr__plane_of(const tahr__step *step, const tahr_hit *hit);

/* Forgets planes that the character has left by more than a skin. */
void tahr__planes_forget(const tahr__step *step, tahr__plane *planes, uint32_t *count);

/* Turns a wall into the plane across up that it is to something that stays on the given floor: where the wall leans
 * over a ramp, going up the ramp runs into it. Returns 0 if nothing is left of it (a ceiling parallel to the floor). */
int tahr__level_wall(const tahr__step *step, vec3 floor_normal, tahr__plane *wall);

/* ComputeSlideVector: what a surface leaves of a part `time` of delta; in the air no faster up than that
 * (tahr__handle_slope_boosting). No query. */
vec3 tahr__slide_vector(const tahr__step *step, vec3 delta, double time, vec3 normal);

/* HandleSlopeBoosting: takes from the slide of a fall what rises faster than a part `time` of delta; the level part of
 * what was taken goes along the surface. No query. */
vec3 tahr__handle_slope_boosting(const tahr__step *step, vec3 slide, vec3 delta, double time, vec3 normal);

/* TwoWallAdjust: what is left of delta, blocked by `hit` after it had been bent along `old_normal`; on the ground kept
 * on ramps, no higher than a step and out of the floor. No query. */
vec3 tahr__two_wall_adjust(tahr__step *step, vec3 delta, const tahr_hit *hit, vec3 old_normal);

/* What a character on the ground slides along: walls instead of slopes too steep, and instead of what hangs over a
 * floor that it stands on. `normal`: of the hit. No query. */
vec3 tahr__slide_normal(tahr__step *step, vec3 delta, vec3 normal, const tahr_hit *hit);

/* SlideAlongSurface: goes on along the surface that blocked swept->hit by a part `time` of delta, and along a second
 * one. Tells of what it runs into. [in,out] swept: of the last sweep. Returns the part of the slide that was made,
 * 0..1. At most 2 safe moves. */
double tahr__slide_along_surface(tahr__step *step, vec3 delta, double time, vec3 normal, tahr__swept *swept);

/* HandleImpact: says that the character ran into something. */
void tahr__handle_impact(tahr__step *step, const tahr_hit *hit);

#endif

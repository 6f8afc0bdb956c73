/* SPDX-License-Identifier: MIT
 * slide.h: bending a motion along everything that was touched. */
#ifndef TAHR_SLIDE_H
#define TAHR_SLIDE_H

#include "core.h"

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

#endif

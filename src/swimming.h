/* SPDX-License-Identifier: MIT
 * swimming.h: swimming, and how fluids are entered and left. */
#ifndef TAHR_SWIMMING_H
#define TAHR_SWIMMING_H

#include "core.h"
#include "query.h"

/* Immersion from which on it swims: config.swim_immersion, or less if buoyancy lifts it off its feet before that. */
double tahr__swim_line(const tahr_config *config);

/* PhysSwimming: one slice of at most `time` seconds. */
tahr__next tahr__swim(tahr__step *step, double time);

/* One slice of walking in a world with fluids: ends where the fluid takes over. 1 fluid query more than walking; where
 * it ends in deep water the walk is gone up to 6 times more to find that place. */
tahr__next tahr__wade(tahr__step *step, double time);

/* Immersion of one that stands: where its foot is, or on the ledge whose edge it is on. One fluid query. */
double tahr__standing_immersion(tahr__step *step);

/* Is a falling character carried here? Not while it rises, unless wholly immersed. One fluid query. */
int tahr__is_carried(tahr__step *step, vec3 position, vec3 velocity);

/* Places as a function of time, relative to the state's position. */
typedef struct tahr__way {
    const void *self;
    vec3 (*at)(const void *self, double t);
} tahr__way;

/* s within duration at which the immersion passes `line`, in the direction that it does: the end, where it is `end`,
 * lies beyond. The place is beyond the line by about a nanometre. Exact where the surface is level (1 fluid query, if
 * the end is partly immersed); elsewhere halved. At most 12 fluid queries. */
double tahr__passing_time(tahr__step *step, const tahr__way *way, double duration, double end, double line, int deeper);

/* The jump button went down while swimming: leaves the water at its surface. One fluid query. */
void tahr__jump_from_water(tahr__step *step);

/* It swims from here on. */
void tahr__begin_swimming(tahr__step *step);

#endif

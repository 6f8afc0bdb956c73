/* SPDX-License-Identifier: MIT
 * footing.h: a walk over the inside of one triangle, and what it takes to know that nothing else is met. */
#ifndef TAHR_NATIVE_FOOTING_H
#define TAHR_NATIVE_FOOTING_H

#include "scene.h"

/* A walk over the floor, and a foot that comes down on it: LANDED and the hit; BARRED: something may be in the way;
 * UNCLEAR: there is more to find out. The cache has to be of the revision of the world. */
enum { TAHR__UNCLEAR, TAHR__BARRED, TAHR__LANDED };
uint32_t tahr__footing_walk(const tahr__native *world, tahr_query_context *context, const tahr_walk *walk,
                            tahr_hit *hit);

/* vicinity.c: a walk of which it is not known what it may meet of what is above the floor: what is not farther than
 * `most` from the place; or of that only what is behind some fences. */
typedef struct tahr__doubt {
    tahr_vec3 body_start, body_motion, foot_start, foot_motion; /* local */
    double half;                                                /* of the body */
    double most;                                                /* m */
    double until;                                               /* of the motion of the foot */
    uint32_t fences, reserved;                                  /* a bit each; 0: all */
} tahr__doubt;
/* Is nothing of it met? */
int tahr__doubt_settle(const tahr__native *world, tahr_query_context *context, const tahr_walk *walk,
                       const tahr__doubt *doubt);
/* Of a body that stays OVER the floor, and then its foot that goes DOWN: finds out what a footing needs to know. 1:
 * something of it is new. */
int tahr__vicinity_learn(const tahr__query *body, const tahr__query *foot);

#endif

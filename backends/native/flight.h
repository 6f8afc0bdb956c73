/* SPDX-License-Identifier: MIT
 * flight.h: one primitive on its way to the target. */
#ifndef TAHR_NATIVE_FLIGHT_H
#define TAHR_NATIVE_FLIGHT_H

#include "scene.h"

/* Below this distance (m) the direction between two points is rounding; the last one that was clear is used instead. */
#define TAHR__BLURRED 1e-9

/* How much nearer than the margin (m) a motion may pass an edge: what the narrow phase promises. */
#define TAHR__GRAZE 1e-9

/* One primitive under way: where, and the distance it must come down to. */
typedef struct tahr__flight {
    const tahr__query *query;
    const tahr__prim *prim;
    double target, t;
    double began; /* the gap at the start, or more than the margin */
    int leaps;    /* 1: allowed, 2: there was one, 0: not */
    tahr__probe probe;
    struct { /* as it was before the first leap */
        double target, t;
        tahr__witness witness;
        int steps, targets;
    } before;
    int steps, targets; /* where it goes on */
    int wanders;        /* 1: it did not come straight to a corner */
} tahr__flight;

/* The distance of the core at centre. out: with `beside`, what was measured from there last. */
void tahr__flight_measure(const tahr__query *query, const tahr__prim *prim, tahr_vec3 centre, tahr__witness *out);
/* Goes on until the distance is the target. 1: arrived; 0: never, or after limit; -1: not decided within the cap. On
 * the first flight of a primitive, what came to the same corner before is told again. */
int tahr__flight_arrive(tahr__flight *f, double limit, int first);

#endif

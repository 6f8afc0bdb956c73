/* SPDX-License-Identifier: MIT
 * perch.h: standing with the rim of the shape on an edge, if there is a floor further in. */
#ifndef TAHR_PERCH_H
#define TAHR_PERCH_H

#include "floor.h"

/* GetValidPerchRadius: m, of the foot that must have a floor: at least 0.11 cm. No query. */
double tahr__valid_perch_radius(const tahr__step *step);

/* ShouldComputePerchResult: does what holds the character where its shape touches it, at `location`, need a floor
 * further in? check_radius: not if it is that far in itself. No query. */
int tahr__should_compute_perch(const tahr__step *step, const tahr_floor *floor, vec3 location, int check_radius);

/* ComputePerchResult: looks for the floor of a foot of this radius, no deeper than `deepest` below what is touched at
 * `point` by the shape at `location`. [out] floor: its distance from there. Returns 1 if there is one. 0 queries if
 * deepest <= 0, else as tahr__compute_floor_distance. */
typedef struct tahr__perch_look {
    double radius;
    vec3 point, location;
    double deepest;
} tahr__perch_look;
int tahr__compute_perch(tahr__step *step, const tahr__perch_look *look, tahr_floor *floor);

/* What the thinner foot of a perch met, for who looks for the end of a floor. */
typedef struct tahr__inner {
    int asked;
    tahr_hit hit;
    double clearance; /* m; as deep as was looked if nothing was met */
} tahr__inner;

/* The same for TAHR_FLOOR_PROBE_WHOLE: a contact at the rim, or on a face too steep, holds the character only if there
 * is a floor for a thinner foot; writes it into `floor`. 1 sweep, and what a lip asks. What the thinner foot met is
 * written into step->inner, if that is there. */
int tahr__perches(tahr__step *step, double reach, const tahr_hit *outer, tahr_floor *floor);

/* The front of a step holds who walks, between the floor before it and the one behind it; who falls slides off it. */
int tahr__holds_on_lip(tahr__step *step, const tahr_hit *hit);

#endif

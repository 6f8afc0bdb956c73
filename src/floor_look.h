/* SPDX-License-Identifier: MIT
 * floor_look.h: looks at the floor on both sides of the place where it ends, and what they tell of that place. */
#ifndef TAHR_FLOOR_LOOK_H
#define TAHR_FLOOR_LOOK_H

#include "floor.h"

/* Radians, and parts of a length: what is less is level, upright or along, and would make a quotient of rounding. */
static const double SMALL = 1e-3;

/* A contact is one on a face whose normal is within this of the face's: sine. */
static const double ON_FACE = 1.4142132088085646e-3;

/* No part of a way. */
static const double NOWHERE = -1e300;

/* What a foot met. */
typedef struct contact {
    enum { FREE, FACE, EDGE } kind;
    int stays; /* 1: at the same point as from elsewhere: of a corner, or of an edge that is gone straight across */
    vec3 point, normal, face;
    double depth; /* m down */
} contact;

typedef struct look {
    double at; /* part of the way */
    vec3 position;
    contact outer, inner; /* of the foot, and of a thinner one */
    int known, perching, has_inner;
} look;

/* Of a level way on which a floor ends. */
typedef struct looks {
    vec3 from, way;
    double beside;        /* parts of the way beside a prediction that are looked at */
    look inside, outside; /* the nearest on either side, */
    look further[2];      /* and the last before it: outside, inside */
} looks;

/* Is a part of the way on what is left of it, or so near its ends that it may be? */
static inline int is_between(const looks *s, double part)
{
    return part > s->inside.at - 2 * s->beside && part < s->outside.at + 2 * s->beside;
}

/* What is seen from the state's position, after `at` of the way; floor: as it was found there (step->inner: asked). */
void tahr__look_note(const tahr__step *step, const tahr_floor *floor, double at, look *l);

/* Marks what two looks see at the same point. */
void tahr__looks_compare(look *now, look *before);

/* The part of the way after which the floor ends, in closed form, of what is straight and flat: the likeliest; NOWHERE
 * if nothing tells of one (floor_limit.c). */
double tahr__looks_predict(const tahr__step *step, const looks *s);

/* The same by what changes evenly from look to look, whatever its form (floor_measure.c). */
double tahr__looks_measure(const tahr__step *step, const looks *s);

#endif

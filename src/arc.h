/* SPDX-License-Identifier: MIT
 * arc.h: the way of a fall between contacts, in closed form. */
#ifndef TAHR_ARC_H
#define TAHR_ARC_H

#include "core.h"

/* A contact-free arc from the character's position. */
typedef struct tahr__arc {
    tahr__law law; /* across the axis */
    vec3 axis;     /* against gravity */
    vec3 level;    /* velocity across the axis: */
    vec3 across;   /* of that what does not go along the wish, */
    double along;  /* and what does, */
    int wishes;    /* law_wishes of the law */
    int turns;     /* 1: it is bent by its wish and nothing else */
    double rise;   /* velocity along the axis */
    double gravity, terminal, hold;
    int drifts; /* 1: a drive comes on top of the velocity */
    vec3 drift; /* m/s, with drifts */
} tahr__arc;

/* Where an arc is at a time. */
typedef struct tahr__arc_point {
    double t; /* s */
    vec3 way, velocity;
} tahr__arc_point;

/* From the state's position and velocity, with what planes that are touched leave of the air control. No query. */
tahr__arc tahr__arc_of(const tahr__step *step, const tahr__plane *planes, uint32_t count);

/* Its way after t seconds; [out] the velocity then. No query. */
vec3 tahr__arc_at(const tahr__arc *a, double t, vec3 *velocity);

/* The same of a tahr__way (self: the arc). */
vec3 tahr__arc_place(const void *self, double t);

/* Where it meets the plane through `touch` (relative to its start): safeguarded Newton between 0 and t. No query. */
tahr__arc_point tahr__arc_meet(const tahr__arc *a, vec3 normal, vec3 touch, double t);

#endif

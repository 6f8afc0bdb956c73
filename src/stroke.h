/* SPDX-License-Identifier: MIT
 * stroke.h: how a swimmer's velocity answers to wish, drag, current and buoyancy, in closed form. Asks nothing,
 * allocates nothing. */
#ifndef TAHR_STROKE_H
#define TAHR_STROKE_H

#include "vec.h"

/* One linear equation: the level velocity tends to target, and along up v' = push - drag * v - spring * rise, the rise
 * counted from where the piece begins: near a level surface what is carried changes in proportion to it. Linear pieces
 * compose: two halves give the whole, to rounding. */
typedef struct tahr__stroke {
    vec3 up;
    vec3 target;   /* m/s, across up */
    double rate;   /* 1/s, across up; >= 0 */
    double drag;   /* 1/s, along up; >= 0 */
    double push;   /* m/s2 along up, of one at rest at the start */
    double spring; /* 1/s2; >= 0 */
} tahr__stroke;

/* Displacement from the velocity v after t seconds, [out] velocity then. t is at most tahr__stroke_longest. */
vec3 tahr__stroke_at(const tahr__stroke *stroke, vec3 v, double t, vec3 *velocity);

/* s for which the closed form holds its precision, and the rise turns round at most once. */
double tahr__stroke_longest(const tahr__stroke *stroke);

/* s, at most t, at which the rise first leaves [low, high] (low <= 0 <= high); t if it does not. */
double tahr__stroke_leaves(const tahr__stroke *stroke, vec3 v, double t, double low, double high);

/* s of t at which a part (0..1) of the displacement `whole` after t is covered, measured along it. */
double tahr__stroke_time(const tahr__stroke *stroke, vec3 v, double t, vec3 whole, double part);

#endif

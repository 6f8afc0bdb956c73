/* SPDX-License-Identifier: MIT
 * support.h: how far a shape reaches in a direction, and where. */
#ifndef TAHR_SUPPORT_H
#define TAHR_SUPPORT_H

#include "vec.h"

/* A shape at a place. A hull is the box around it. */
typedef struct tahr__solid {
    const tahr_shape *shape;
    vec3 up;
    tahr_quat orientation; /* counts for shapes that are not round */
} tahr__solid;

/* The largest d . x over its points x, from its centre; d unit. Closed forms. */
double tahr__support(const tahr__solid *solid, vec3 d);

/* A point x for which it is largest, from its centre: the middle of those there are. */
vec3 tahr__support_point(const tahr__solid *solid, vec3 d);

/* The same of what is left of a sphere or a capsule without its radius; of other shapes of the whole. */
vec3 tahr__support_core(const tahr__solid *solid, vec3 d);

/* m, what is taken off then. */
double tahr__core_radius(const tahr_shape *shape);

#endif

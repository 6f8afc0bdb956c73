/* SPDX-License-Identifier: MIT
 * apart.h: a direction along which two convex shapes are apart, and how far. */
#ifndef TAHR_APART_H
#define TAHR_APART_H

#include "support.h"

typedef struct tahr__apart {
    vec3 normal;   /* unit, from b to a */
    double gap;    /* m along it, negative where they overlap: never more than the true distance */
    double extent; /* m, how far b reaches along it from its centre */
} tahr__apart;

/* Along a direction. a, whose centre lies at c seen from that of b. */
tahr__apart tahr__apart_along(const tahr__solid *a, const tahr__solid *b, vec3 c, vec3 normal);

/* Of spheres and capsules that do not overlap by more than their radii the normal is that of the closest points, of
 * other shapes it is so to about 1e-9 of their size; where they overlap deeper, one of a few directions, the one with
 * the shortest way out. With the same centre it is level, and always the same one: of many in one place the first and
 * the last can leave. flat: z does not count, and the normal has none. */
tahr__apart tahr__apart_of(const tahr__solid *a, const tahr__solid *b, vec3 c, int flat);

#endif

/* SPDX-License-Identifier: MIT
 * cone.h: the point of an intersection of half-spaces that is nearest to a given point. */
#ifndef TAHR_CONE_H
#define TAHR_CONE_H

#include "vec.h"

/* The half-space normal . x >= offset. */
typedef struct tahr__plane {
    vec3 normal;
    double offset;
    vec3 anchor; /* where the character was when it met the plane */
    uint32_t body;
    uint32_t feature;
} tahr__plane;

#define TAHR__MAX_PLANES 16

/* Finds the x nearest to u that lies in all half-spaces, by enumerating active sets of one, two and three planes (more
 * than three are never needed in three dimensions). [out] x. Returns 1, or 0 if the intersection is empty: then x is
 * the least-squares point, with the smallest sum of squared violations. Allocates nothing, asks nothing. */
int tahr__project(const tahr__plane *planes, uint32_t count, vec3 u, vec3 *x);

/* Adds a plane unless its like is there: the same feature is replaced, near-parallel planes (n . n' > 1 - 1e-6) are
 * merged to the tighter one. Keeps the set sorted by (body, feature), so that the order of discovery does not
 * matter. */
void tahr__planes_add(tahr__plane *planes, uint32_t *count, const tahr__plane *plane);

#endif

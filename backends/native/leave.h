/* SPDX-License-Identifier: MIT
 * leave.h: the way out of a primitive that the core has entered. */
#ifndef TAHR_NATIVE_LEAVE_H
#define TAHR_NATIVE_LEAVE_H

#include "scene.h"

/* Out of a box or hull (SOLID), along one of its faces or across a pair of edges. 0: the core is not inside. */
int tahr__leave_solid(const tahr__query *query, const tahr__prim *prim, tahr__probe *out);
/* Out of a triangle or the axis of a round body that the core crosses. 0: of a box or hull, whose inside answers. */
int tahr__leave_surface(const tahr__query *query, const tahr__prim *prim, tahr__probe *out);
/* The face of a box or hull that the way out, `normal`, points through most. */
uint32_t tahr__leave_face(const tahr__query *query, const tahr__prim *prim, tahr_vec3 normal);

#endif

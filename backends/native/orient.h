/* SPDX-License-Identifier: MIT
 * orient.h: on which side of a plane a point lies, exactly. */
#ifndef TAHR_NATIVE_ORIENT_H
#define TAHR_NATIVE_ORIENT_H

#include "../common/vec.h"

/* The sign (-1, 0, 1) of (b - a) x (c - a) . (d - a), without any rounding, for coordinates that are zero or within
 * 1e-60..1e60. */
int tahr__orient(tahr_vec3 a, tahr_vec3 b, tahr_vec3 c, tahr_vec3 d);

#endif

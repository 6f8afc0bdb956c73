/* SPDX-License-Identifier: MIT
 * shape.h: what is a valid shape, and how far it reaches. */
#ifndef TAHR_SHAPE_H
#define TAHR_SHAPE_H

#include "vec.h"

/* m: the thinnest that a shape may be. What is made from one is never thinner: backends count on it. */
#define TAHR__THINNEST 1e-6

/* Name of the first bad field ("shape.radius"), or NULL. Dimensions lie within 1e-6 .. 1e4 m. */
const char *tahr__shape_check(const tahr_shape *shape);

/* Half the widest extent across the axis: the radius, or the longer half side of a box. */
static inline double shape_width(const tahr_shape *shape)
{
    return shape->radius > 0 ? shape->radius : max_of(shape->half_x, shape->half_y);
}

#endif

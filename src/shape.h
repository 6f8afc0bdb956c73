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

/* Is it the same all round its axis? The others need the orientation. */
static inline int shape_is_round(const tahr_shape *shape)
{
    return shape->radius > 0;
}

/* Does it stand on a level face? Of a hull it is taken for granted: nothing is known of it but its extents. */
static inline int shape_is_flat(const tahr_shape *shape)
{
    return shape->type >= TAHR_SHAPE_BOX && shape->type != TAHR_SHAPE_ELLIPSOID;
}

/* Are its corners those of its extents? So a hull is taken where a rule asks how wide it is. */
static inline int shape_is_square(const tahr_shape *shape)
{
    return shape->type == TAHR_SHAPE_BOX || shape->type == TAHR_SHAPE_HULL;
}

/* How far above its lowest point the shape is as wide as it gets, and as far below its highest; 0 of a level end. */
static inline double shape_cap(const tahr_shape *shape)
{
    return shape_is_flat(shape) ? 0 : (shape->radius > 0 ? shape->radius : shape->half_height);
}

/* Makes a shape larger by a distance all round: exactly a sphere and a capsule, a box and a cylinder with sharp edges
 * instead of round ones; an ellipsoid comes out up to the difference of its semi-axes' share too small between them,
 * and a cone as much at its apex as it is pointed. Hulls stay as they are. */
static inline void shape_grow(tahr_shape *s, double by)
{
    if (s->type == TAHR_SHAPE_HULL) {
        return;
    }
    if (s->type == TAHR_SHAPE_CONE) { /* the side moves out by that, where the base is */
        double slant = sqrt(s->radius * s->radius + 4 * s->half_height * s->half_height);
        s->radius += by * (slant + s->radius) / (2 * s->half_height);
    } else if (shape_is_round(s)) {
        s->radius += by;
    } else {
        s->half_x += by;
        s->half_y += by;
    }
    s->half_height += by;
}

/* How far it reaches along a level direction, given in the frame of its orientation (x, y; of unit length). */
static inline double shape_reach(const tahr_shape *shape, double x, double y)
{
    if (shape_is_round(shape)) {
        return shape->radius;
    }
    if (shape_is_square(shape)) {
        return shape->half_x * max_of(x, -x) + shape->half_y * max_of(y, -y);
    }
    return sqrt(shape->half_x * shape->half_x * x * x + shape->half_y * shape->half_y * y * y);
}

/* How far inside its outline, seen from above, a place lies: x and y in the frame of its orientation. Of an ellipse
 * along the line from its middle. Negative outside. */
static inline double shape_inside(const tahr_shape *shape, double x, double y)
{
    if (shape_is_round(shape)) {
        return shape->radius - sqrt(x * x + y * y);
    }
    if (shape_is_square(shape)) {
        return min_of(shape->half_x - max_of(x, -x), shape->half_y - max_of(y, -y));
    }
    double part = sqrt(x * x / (shape->half_x * shape->half_x) + y * y / (shape->half_y * shape->half_y));
    return part > 0 ? sqrt(x * x + y * y) * (1 / part - 1) : min_of(shape->half_x, shape->half_y);
}

#endif

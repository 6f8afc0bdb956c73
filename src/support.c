/* SPDX-License-Identifier: MIT
 * support.c: support functions of the shapes. */
#include "support.h"

/* |sine| of the angle between a direction and an edge or a face below which all of it counts as touched, so that the
 * point lies in the middle of it: rounding of unit vectors, a thousand times. */
static const double ALIGNED = 1e-12;

/* Sign, or 0 where there is none to speak of. */
static double side(double x)
{
    return x > ALIGNED ? 1 : (x < -ALIGNED ? -1 : 0);
}

/* A box, its axes. */
static vec3 axis_x(const tahr__solid *s)
{
    return rotate(s->orientation, vec(1, 0, 0));
}

static vec3 axis_y(const tahr__solid *s)
{
    return rotate(s->orientation, vec(0, 1, 0));
}

double tahr__core_radius(const tahr_shape *shape)
{
    return shape->type == TAHR_SHAPE_SPHERE || shape->type == TAHR_SHAPE_CAPSULE ? shape->radius : 0;
}

double tahr__support(const tahr__solid *s, vec3 d)
{
    const tahr_shape *shape = s->shape;
    const double u = dot(d, s->up), along = u < 0 ? -u : u, h = shape->half_height, r = shape->radius;
    if (shape->type == TAHR_SHAPE_SPHERE) {
        return r;
    }
    if (shape->type == TAHR_SHAPE_CAPSULE) {
        return r + (h - r) * along;
    }
    if (shape->type == TAHR_SHAPE_CYLINDER) {
        return r * length(reject(d, s->up)) + h * along;
    }
    if (shape->type == TAHR_SHAPE_CONE) {
        return max_of(h * u, r * length(reject(d, s->up)) - h * u);
    }
    double x = dot(d, axis_x(s)), y = dot(d, axis_y(s));
    if (shape->type == TAHR_SHAPE_ELLIPSOID) {
        return sqrt((shape->half_x * x) * (shape->half_x * x) + (shape->half_y * y) * (shape->half_y * y) +
                    (h * u) * (h * u));
    }
    return shape->half_x * fabs(x) + shape->half_y * fabs(y) + h * along;
}

static vec3 ellipsoid_point(const tahr__solid *s, vec3 d)
{
    const tahr_shape *shape = s->shape;
    const double a = shape->half_x, b = shape->half_y, c = shape->half_height;
    vec3 ax = axis_x(s), ay = axis_y(s);
    double x = dot(d, ax), y = dot(d, ay), u = dot(d, s->up), reach = tahr__support(s, d);
    if (reach <= 0) {
        return vec(0, 0, 0);
    }
    return scale(add_scaled(add_scaled(scale(ax, a * a * x), ay, b * b * y), s->up, c * c * u), 1 / reach);
}

vec3 tahr__support_core(const tahr__solid *s, vec3 d)
{
    const tahr_shape *shape = s->shape;
    const double u = dot(d, s->up), h = shape->half_height;
    if (shape->type == TAHR_SHAPE_SPHERE) {
        return vec(0, 0, 0);
    }
    if (shape->type == TAHR_SHAPE_CAPSULE) {
        return scale(s->up, (h - shape->radius) * side(u));
    }
    if (shape->type == TAHR_SHAPE_ELLIPSOID) {
        return ellipsoid_point(s, d);
    }
    if (shape->type == TAHR_SHAPE_CYLINDER || shape->type == TAHR_SHAPE_CONE) {
        vec3 level = reject(d, s->up);
        double wide = length(level);
        vec3 rim = wide > ALIGNED ? scale(level, shape->radius / wide) : vec(0, 0, 0);
        if (shape->type == TAHR_SHAPE_CYLINDER) {
            return add_scaled(rim, s->up, h * side(u));
        }
        return h * u > shape->radius * wide - h * u ? scale(s->up, h) : add_scaled(rim, s->up, -h);
    }
    vec3 ax = axis_x(s), ay = axis_y(s);
    vec3 p = scale(ax, shape->half_x * side(dot(d, ax)));
    return add_scaled(add_scaled(p, ay, shape->half_y * side(dot(d, ay))), s->up, h * side(u));
}

vec3 tahr__support_point(const tahr__solid *s, vec3 d)
{
    return add_scaled(tahr__support_core(s, d), d, tahr__core_radius(s->shape));
}

/* SPDX-License-Identifier: MIT
 * rim.h: how near to the rim of the shape something touches it. */
#ifndef TAHR_RIM_H
#define TAHR_RIM_H

#include "plane.h"
#include "shape.h"

static inline double inside_outline(const tahr__step *step, vec3 offset)
{
    vec3 x = rotate(step->state.orientation, vec(1, 0, 0));
    vec3 y = rotate(step->state.orientation, vec(0, 1, 0));
    return shape_inside(&step->limits->shape, dot(offset, x), dot(offset, y));
}

/* How far inside the rim of the shape at `position` and its skin, seen from above, a point lies. */
static inline double inside_rim(const tahr__step *step, vec3 position, vec3 point)
{
    vec3 offset = step_level(step, sub(point, position));
    const tahr_shape *s = &step->limits->shape;
    double skin = step->config->skin;
    return shape_is_round(s) ? s->radius + skin - length(offset) : skin + inside_outline(step, offset);
}

#endif

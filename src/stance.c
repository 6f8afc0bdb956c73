/* SPDX-License-Identifier: MIT
 * stance.c: crouching and other changes of the shape. */
#include "stance.h"

#include "limits.h"

void tahr__use_shape(tahr__step *step, double radius, double half_height)
{
    tahr_shape shape = step->config->shape;
    shape.radius = radius;
    shape.half_height = half_height;
    step->own_limits = tahr__limits_of(step->config, &shape, step->world->backend->capabilities);
    step->limits = &step->own_limits;
}

void tahr__take_stance(tahr__step *step)
{
    (void)step;
}

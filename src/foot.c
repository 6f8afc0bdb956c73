/* SPDX-License-Identifier: MIT
 * foot.c: see foot.h. */
#include "foot.h"

#include "shape.h"

/* An upright capsule that moves along its own axis enters new space with its lower cap alone: a sphere there is the
 * same sweep and a fraction of the geometry. What overlaps higher up is found by the sweep of the move. */
tahr__foot tahr__foot_of(const tahr_shape *shape, uint32_t capabilities)
{
    tahr__foot foot = {*shape, 0};
    if (shape->type == TAHR_SHAPE_CAPSULE && (capabilities & TAHR_CAP_SPHERE)) {
        foot.shape.type = TAHR_SHAPE_SPHERE;
        foot.shape.half_height = shape->radius;
        foot.offset = shape->radius - shape->half_height;
    }
    return foot;
}

tahr__foot tahr__thinner_foot(const tahr__step *step, double by)
{
    tahr_shape s = step->limits->shape;
    tahr__thin_shape(&s, by, 1e-3, step->world->backend->capabilities);
    return tahr__foot_of(&s, step->world->backend->capabilities);
}

void tahr__thin_shape(tahr_shape *s, double by, double part, uint32_t capabilities)
{
    if (s->type == TAHR_SHAPE_HULL) {
        if (!(capabilities & TAHR_CAP_BOX)) {
            return;
        }
        s->type = TAHR_SHAPE_BOX;
        s->hull = 0;
    }
    if (shape_is_round(s)) {
        s->type = s->type == TAHR_SHAPE_SPHERE ? TAHR_SHAPE_CAPSULE : s->type;
        s->radius = max_of(s->radius - by, max_of(part * s->radius, TAHR__THINNEST));
    } else {
        s->half_x = max_of(s->half_x - by, max_of(part * s->half_x, TAHR__THINNEST));
        s->half_y = max_of(s->half_y - by, max_of(part * s->half_y, TAHR__THINNEST));
    }
}

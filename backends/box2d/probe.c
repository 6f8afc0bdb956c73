/* SPDX-License-Identifier: MIT
 * probe.c: a query's shape in the plane, checked before any of it reaches Box2D. */
#include "scene.h"

/* What is this far out of the plane (sine, or m) is meant to be out of it. */
#define OUT_OF_PLANE 1e-9

static int is_finite_vec(tahr_vec3 v)
{
    return v.x * 0 == 0 && v.y * 0 == 0 && v.z * 0 == 0;
}

static void make_box(tahr__b2_probe *probe, double half_width, double half_height)
{
    tahr__vec2 up = probe->up, side = f_right(up);

    probe->shape.count = 4;
    probe->shape.radius = 0;
    for (int i = 0; i < 4; i++) {
        tahr__vec2 v = f_mad(f_make(0, 0), side, i == 1 || i == 2 ? half_width : -half_width);
        probe->shape.corner[i] = f_mad(v, up, i < 2 ? -half_height : half_height);
    }
}

tahr_status tahr__b2_probe_shape(tahr__b2_probe *probe, const tahr_shape *shape, tahr_vec3 up)
{
    if (!is_finite_vec(up) || shape->radius * 0 + shape->half_height * 0 + shape->half_x * 0 != 0) {
        return TAHR_E_ARGUMENT;
    }
    if (!(fabs(up.z) <= OUT_OF_PLANE)) return TAHR_E_UNSUPPORTED;
    probe->up = f_make(up.x, up.y);
    probe->shape.count = 1;
    probe->shape.radius = shape->radius;
    probe->shape.corner[0] = f_make(0, 0);
    switch (shape->type) {
    case TAHR_SHAPE_SPHERE: return TAHR_OK;
    case TAHR_SHAPE_CAPSULE:
        if (shape->half_height > shape->radius) {
            probe->shape.count = 2;
            probe->shape.corner[0] = f_mad(f_make(0, 0), probe->up, shape->radius - shape->half_height);
            probe->shape.corner[1] = f_mad(f_make(0, 0), probe->up, shape->half_height - shape->radius);
        }
        return TAHR_OK;
    case TAHR_SHAPE_BOX: make_box(probe, shape->half_x, shape->half_height); return TAHR_OK;
    default: return TAHR_E_UNSUPPORTED;
    }
}

tahr_status tahr__b2_probe_check(const tahr__b2_probe *probe, tahr_vec3 motion)
{
    if (!is_finite_vec(probe->origin) || !is_finite_vec(motion) || probe->motion_length * 0 != 0 ||
        !(probe->margin >= 0) || probe->margin * 0 != 0) {
        return TAHR_E_ARGUMENT;
    }
    return fabs(motion.z) <= OUT_OF_PLANE ? TAHR_OK : TAHR_E_UNSUPPORTED;
}

/* SPDX-License-Identifier: MIT
 * probe.c: a query's shape as core and radius, checked before any of it reaches libccd. */
#include "scene.h"

static int is_finite_vec(tahr_vec3 v)
{
    return v.x * 0 == 0 && v.y * 0 == 0 && v.z * 0 == 0;
}

int tahr__ccd_probe_shape(tahr__ccd_probe *probe, const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation)
{
    tahr__mat turn;

    probe->core.axis_count = 0;
    probe->radius = shape->type == TAHR_SHAPE_BOX ? 0 : shape->radius;
    if (shape->type == TAHR_SHAPE_CAPSULE && shape->half_height > shape->radius) {
        probe->core.axis_count = 1;
        probe->core.axis[0] = v_scale(up, shape->half_height - shape->radius);
    } else if (shape->type == TAHR_SHAPE_BOX) {
        turn = m_from_quat(orientation);
        probe->core.axis_count = 3;
        probe->core.axis[0] = m_apply(&turn, v_make(shape->half_x, 0, 0));
        probe->core.axis[1] = m_apply(&turn, v_make(0, shape->half_y, 0));
        probe->core.axis[2] = m_apply(&turn, v_make(0, 0, shape->half_height));
    }
    return shape->type >= TAHR_SHAPE_SPHERE && shape->type <= TAHR_SHAPE_BOX;
}

int tahr__ccd_probe_finite(const tahr__ccd_probe *probe)
{
    int fine = is_finite_vec(probe->origin) && is_finite_vec(probe->motion) && probe->motion_length * 0 == 0;

    for (int i = 0; i < probe->core.axis_count; i++)
        fine = fine && is_finite_vec(probe->core.axis[i]);
    return fine && probe->radius >= 0 && probe->radius * 0 == 0 && probe->margin >= 0 && probe->margin * 0 == 0;
}

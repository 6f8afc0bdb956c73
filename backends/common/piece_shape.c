/* SPDX-License-Identifier: MIT
 * piece_shape.c: the shape of a query. */
#include "piece.h"

#include <string.h>

static int is_finite_vec(tahr_vec3 v)
{
    return v.x * 0 == 0 && v.y * 0 == 0 && v.z * 0 == 0;
}

/* The half axes of a box or an ellipsoid. */
static void set_axes(const tahr_shape *shape, const tahr__mat *turn, tahr_vec3 axis[3])
{
    axis[0] = m_apply(turn, v_make(shape->half_x, 0, 0));
    axis[1] = m_apply(turn, v_make(0, shape->half_y, 0));
    axis[2] = m_apply(turn, v_make(0, 0, shape->half_height));
}

/* As core and radius. */
static void set_core(const tahr_shape *shape, tahr_vec3 up, tahr__shape *out)
{
    out->radius = shape->type == TAHR_SHAPE_BOX ? 0 : shape->radius;
    if (shape->type == TAHR_SHAPE_CAPSULE && shape->half_height > shape->radius) {
        out->core.axis_count = 1;
        out->core.axis[0] = v_scale(up, shape->half_height - shape->radius);
    } else if (shape->type == TAHR_SHAPE_BOX) {
        out->core.axis_count = 3;
        set_axes(shape, &out->turn, out->core.axis);
    }
}

/* The vertices of a body, around the middle of their extents. */
static void set_hull(const tahr__hull *hull, double scale, tahr__shape *out)
{
    out->convex.convex = (tahr__convex){.kind = TAHR__CONVEX_POINTS,
                                        .count = hull->count,
                                        .centre = v_scale(m_apply(&out->turn, hull->middle), -scale),
                                        .points = hull->vertices,
                                        .turn = &out->turn,
                                        .scale = scale};
    out->convex.planes = &hull->planes;
}

static void set_convex(const tahr_shape *shape, tahr_vec3 up, tahr__shape *out)
{
    tahr__convex *c = &out->convex.convex;

    if (shape->type == TAHR_SHAPE_ELLIPSOID) {
        c->kind = TAHR__CONVEX_ELLIPSOID;
        set_axes(shape, &out->turn, c->axis);
        return;
    }
    c->kind = shape->type == TAHR_SHAPE_CONE ? TAHR__CONVEX_CONE : TAHR__CONVEX_CYLINDER;
    c->axis[0] = v_scale(up, shape->half_height);
    c->radius = shape->radius;
}

void tahr__shape_point(tahr__shape *out)
{
    memset(out, 0, sizeof *out);
}

tahr_status tahr__shape_make(const tahr__shape_source *source, tahr__shape *out)
{
    tahr_shape scaled = *source->shape, *s = &scaled;
    tahr_quat q = source->orientation;
    double *sizes[] = {&s->radius, &s->half_height, &s->half_x, &s->half_y};

    if (s->type < TAHR_SHAPE_SPHERE || s->type > TAHR_SHAPE_HULL) return TAHR_E_UNSUPPORTED;
    for (int i = 0; i < 4; i++) {
        if (!(*sizes[i] >= 0 && *sizes[i] * 0 == 0)) return TAHR_E_ARGUMENT;
        *sizes[i] *= source->scale;
    }
    if (!is_finite_vec(source->up) || (q.x + q.y + q.z + q.w) * 0 != 0) return TAHR_E_ARGUMENT;
    if (s->type == TAHR_SHAPE_HULL && !source->hull) return TAHR_E_ARGUMENT;
    tahr__shape_point(out);
    out->is_convex = s->type > TAHR_SHAPE_BOX;
    out->turn = m_from_quat(q);
    if (!out->is_convex)
        set_core(s, source->up, out);
    else if (s->type == TAHR_SHAPE_HULL)
        set_hull(source->hull, source->scale, out);
    else
        set_convex(s, source->up, out);
    return TAHR_OK;
}

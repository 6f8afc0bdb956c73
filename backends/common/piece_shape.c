/* SPDX-License-Identifier: MIT
 * piece_shape.c: the shape of a query. */
#include "piece.h"

#include <string.h>

static int is_finite_vec(tahr_vec3 v)
{
    return v.x * 0 == 0 && v.y * 0 == 0 && v.z * 0 == 0;
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
        out->core.axis[0] = m_apply(&out->turn, v_make(shape->half_x, 0, 0));
        out->core.axis[1] = m_apply(&out->turn, v_make(0, shape->half_y, 0));
        out->core.axis[2] = m_apply(&out->turn, v_make(0, 0, shape->half_height));
    }
}

/* The vertices of a body, around the middle of their extents. */
static void set_hull(const tahr__hull *hull, tahr__shape *out)
{
    out->convex.convex = (tahr__convex){.kind = TAHR__CONVEX_POINTS,
                                        .count = hull->count,
                                        .centre = v_scale(m_apply(&out->turn, hull->middle), -1),
                                        .points = hull->vertices,
                                        .turn = &out->turn,
                                        .scale = 1};
    out->convex.planes = &hull->planes;
}

static void set_convex(const tahr_shape *shape, tahr_vec3 up, tahr__shape *out)
{
    tahr__convex *c = &out->convex.convex;

    if (shape->type == TAHR_SHAPE_ELLIPSOID) {
        c->kind = TAHR__CONVEX_ELLIPSOID;
        c->axis[0] = m_apply(&out->turn, v_make(shape->half_x, 0, 0));
        c->axis[1] = m_apply(&out->turn, v_make(0, shape->half_y, 0));
        c->axis[2] = m_apply(&out->turn, v_make(0, 0, shape->half_height));
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
    const tahr_shape *s = source->shape;
    tahr_quat q = source->orientation;
    double sizes[] = {s->radius, s->half_height, s->half_x, s->half_y};

    if (s->type < TAHR_SHAPE_SPHERE || s->type > TAHR_SHAPE_HULL) return TAHR_E_UNSUPPORTED;
    for (int i = 0; i < 4; i++) {
        if (!(sizes[i] >= 0 && sizes[i] * 0 == 0)) return TAHR_E_ARGUMENT;
    }
    if (!is_finite_vec(source->up) || (q.x + q.y + q.z + q.w) * 0 != 0) return TAHR_E_ARGUMENT;
    if (s->type == TAHR_SHAPE_HULL && !source->hull) return TAHR_E_ARGUMENT;
    tahr__shape_point(out);
    out->is_convex = s->type > TAHR_SHAPE_BOX;
    out->turn = m_from_quat(q);
    if (!out->is_convex)
        set_core(s, source->up, out);
    else if (s->type == TAHR_SHAPE_HULL)
        set_hull(source->hull, out);
    else
        set_convex(s, source->up, out);
    return TAHR_OK;
}

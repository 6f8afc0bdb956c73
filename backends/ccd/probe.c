/* SPDX-License-Identifier: MIT
 * probe.c: a query's shape as core and as support function, checked before any of it reaches libccd, and brought to
 * about 1 m in size: libccd's tolerances are absolute. */
#include "scene.h"

/* m: what is farther or larger is an error of the caller, and would overflow in libccd's products of products. */
#define LARGEST 1e8
/* Shapes between these half sizes (m) keep their unit. */
#define SMALL 0.0625
#define LARGE 16.0

static int is_usual(double x)
{
    return x >= -LARGEST && x <= LARGEST;
}

static int is_usual_vec(tahr_vec3 v)
{
    return is_usual(v.x) && is_usual(v.y) && is_usual(v.z);
}

/* A power of two: scaling by it rounds nothing. */
static double unit_of(double size)
{
    double unit = 1;
    if (size >= SMALL && size <= LARGE) return 1;
    while (size * unit < 0.5)
        unit *= 2;
    while (size * unit > 1)
        unit *= 0.5;
    return unit;
}

static double size_of(const tahr_shape *shape)
{
    return d_max(d_max(shape->radius, shape->half_height), d_max(shape->half_x, shape->half_y));
}

/* The unit axes of the shape's frame: the third is up. */
static void set_axes(tahr__ccd_probe *probe, const tahr_shape *shape, double scale)
{
    probe->shape.axis[0] = m_apply(&probe->turn, v_make(shape->half_x * scale, 0, 0));
    probe->shape.axis[1] = m_apply(&probe->turn, v_make(0, shape->half_y * scale, 0));
    probe->shape.axis[2] = m_apply(&probe->turn, v_make(0, 0, shape->half_height * scale));
}

static void set_core(tahr__ccd_probe *probe, const tahr_shape *shape, tahr_vec3 up)
{
    probe->is_core = 1;
    probe->radius = shape->type == TAHR_SHAPE_BOX ? 0 : shape->radius * probe->unit;
    if (shape->type == TAHR_SHAPE_CAPSULE && shape->half_height > shape->radius) {
        probe->core.axis_count = 1;
        probe->core.axis[0] = v_scale(up, (shape->half_height - shape->radius) * probe->unit);
    } else if (shape->type == TAHR_SHAPE_BOX) {
        set_axes(probe, shape, probe->unit);
        probe->core.axis_count = 3;
        for (int i = 0; i < 3; i++)
            probe->core.axis[i] = probe->shape.axis[i];
    }
    probe->shape.count = (uint32_t)probe->core.axis_count;
    for (int i = 0; i < probe->core.axis_count; i++)
        probe->shape.axis[i] = probe->core.axis[i];
}

/* The vertices of a body of the scene, around the middle of their extents. */
static tahr_status set_hull(tahr__ccd_probe *probe, uint32_t id)
{
    const tahr__ccd_scene *scene = probe->scene;
    if (id >= scene->body_count || scene->bodies[id].type != TAHR_BODY_HULL) return TAHR_E_ARGUMENT;
    const tahr__ccd_body *body = &scene->bodies[id];
    probe->hull = body;
    probe->shape.kind = TAHR__CONVEX_POINTS;
    probe->shape.points = body->hull.vertices;
    probe->shape.count = body->hull.count;
    probe->shape.turn = &probe->turn;
    probe->shape.scale = probe->unit;
    probe->shape.centre = v_scale(m_apply(&probe->turn, body->hull.middle), -probe->unit);
    return TAHR_OK;
}

static tahr_status set_convex(tahr__ccd_probe *probe, const tahr_shape *shape, tahr_vec3 up)
{
    probe->radius = 0;
    if (shape->type == TAHR_SHAPE_HULL) return set_hull(probe, shape->hull);
    if (shape->type == TAHR_SHAPE_ELLIPSOID) {
        probe->shape.kind = TAHR__CONVEX_ELLIPSOID;
        set_axes(probe, shape, probe->unit);
        return TAHR_OK;
    }
    probe->shape.kind = shape->type == TAHR_SHAPE_CONE ? TAHR__CONVEX_CONE : TAHR__CONVEX_CYLINDER;
    probe->shape.axis[0] = v_scale(up, shape->half_height * probe->unit);
    probe->shape.radius = shape->radius * probe->unit;
    return TAHR_OK;
}

static int is_usual_shape(const tahr_shape *s, tahr_vec3 up, tahr_quat q)
{
    int usual = is_usual(s->radius) && is_usual(s->half_height) && is_usual(s->half_x) && is_usual(s->half_y);
    usual = usual && s->radius >= 0 && s->half_height >= 0 && s->half_x >= 0 && s->half_y >= 0;
    return usual && is_usual_vec(up) && is_usual_vec(v_make(q.x, q.y, q.z)) && is_usual(q.w);
}

tahr_status tahr__ccd_probe_shape(tahr__ccd_probe *probe, const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation)
{
    probe->unit = 1;
    probe->radius = probe->size = 0;
    probe->core.axis_count = 0;
    probe->is_core = 1;
    probe->hull = NULL;
    probe->shape = (tahr__convex){.scale = 1};
    if (shape && (shape->type < TAHR_SHAPE_SPHERE || shape->type > TAHR_SHAPE_HULL)) return TAHR_E_UNSUPPORTED;
    if (!is_usual_vec(probe->origin) || !is_usual_vec(probe->motion)) return TAHR_E_ARGUMENT;
    if (!(probe->margin >= 0 && probe->margin <= LARGEST)) return TAHR_E_ARGUMENT;
    probe->motion_length = v_length(probe->motion);
    if (!shape) return TAHR_OK;
    if (!is_usual_shape(shape, up, orientation) || !(size_of(shape) > 0)) return TAHR_E_ARGUMENT;
    probe->unit = unit_of(size_of(shape));
    probe->size = size_of(shape) * probe->unit;
    probe->margin *= probe->unit;
    probe->motion = v_scale(probe->motion, probe->unit);
    probe->motion_length *= probe->unit;
    probe->turn = m_from_quat(orientation);
    if (shape->type <= TAHR_SHAPE_BOX) {
        set_core(probe, shape, up);
        return TAHR_OK;
    }
    probe->is_core = 0;
    return set_convex(probe, shape, up);
}

/* SPDX-License-Identifier: MIT
 * solid.c: a box, sphere or capsule that moves along another one, by core distance. */
#include "solid.h"

/* m: cores so near to each other touch, and the direction between them is rounding. */
#define TOUCHING 1e-9
/* m: a sweep has arrived. */
#define ARRIVED 1e-10
/* Of the motion: flatter than this to a surface is along it. */
#define PARALLEL 1e-12
enum { MAX_TANGENTS = 64 };

static void box_axes(tahr__core *core, tahr_quat orientation, tahr_vec3 half)
{
    const tahr__mat turn = m_from_quat(orientation);

    core->axis_count = 3;
    core->axis[0] = m_apply(&turn, v_make(half.x, 0, 0));
    core->axis[1] = m_apply(&turn, v_make(0, half.y, 0));
    core->axis[2] = m_apply(&turn, v_make(0, 0, half.z));
}

int tahr__solid_of_body(const tahr_body_desc *b, tahr__solid *solid)
{
    tahr_quat q = b->pose.orientation;

    if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0) q.w = 1;
    *solid = (tahr__solid){.radius = b->type == TAHR_BODY_BOX ? 0 : b->radius};
    if (b->type == TAHR_BODY_BOX) box_axes(&solid->core, q, b->half_extents);
    if (b->type == TAHR_BODY_CAPSULE && b->half_height > b->radius) {
        const tahr__mat turn = m_from_quat(q);
        solid->core.axis_count = 1;
        solid->core.axis[0] = m_apply(&turn, v_make(0, 0, b->half_height - b->radius));
    }
    return b->type == TAHR_BODY_BOX || b->type == TAHR_BODY_SPHERE || b->type == TAHR_BODY_CAPSULE;
}

int tahr__solid_of_shape(const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation, tahr__solid *solid)
{
    *solid = (tahr__solid){.radius = shape->type == TAHR_SHAPE_BOX ? 0 : shape->radius};
    if (shape->type == TAHR_SHAPE_BOX)
        box_axes(&solid->core, orientation, v_make(shape->half_x, shape->half_y, shape->half_height));
    if (shape->type == TAHR_SHAPE_CAPSULE && shape->half_height > shape->radius) {
        solid->core.axis_count = 1;
        solid->core.axis[0] = v_scale(up, shape->half_height - shape->radius);
    }
    return shape->type >= TAHR_SHAPE_SPHERE && shape->type <= TAHR_SHAPE_BOX;
}

double tahr__solid_reach(const tahr__solid *solid)
{
    tahr_vec3 diagonal = v_make(0, 0, 0);

    for (int i = 0; i < solid->core.axis_count; i++) { /* the axes are perpendicular */
        diagonal = v_add(diagonal, solid->core.axis[i]);
    }
    return v_length(diagonal) + solid->radius;
}

/* Half of a face of a box, or the segment or point of a round body as a triangle without area. */
static void piece_of(const tahr__core *body, int number, tahr_vec3 v[3])
{
    const int i = number / 4;
    const tahr_vec3 *a = body->axis;

    v[0] = v[1] = v[2] = v_make(0, 0, 0);
    if (body->axis_count == 1) {
        v[1] = a[0];
        v[0] = v[2] = v_scale(a[0], -1);
    } else if (body->axis_count == 3) {
        const tahr_vec3 middle = v_scale(a[i], number & 1 ? 1 : -1), j = a[(i + 1) % 3], k = a[(i + 2) % 3];
        v[0] = v_sub(v_sub(middle, j), k);
        v[1] = v_add(v_add(middle, j), k);
        v[2] = v_mad(middle, v_sub(j, k), number & 2 ? 1 : -1);
    }
}

/* A direction out of cores that cross in a line or a point. */
static tahr_vec3 across(const tahr__core *shape, const tahr__core *body)
{
    const tahr_vec3 along = shape->axis_count > 0 ? shape->axis[0] : body->axis[0];

    if (shape->axis_count + body->axis_count == 0) return v_make(0, 0, 1);
    return v_unit(v_cross(fabs(along.x) <= fabs(along.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), along));
}

void tahr__solid_measure(const tahr__solid *shape, const tahr__solid *body, tahr_vec3 centre, tahr__solid_near *near)
{
    const double radii = shape->radius + body->radius;
    tahr__witness best = {0}, w;
    tahr_vec3 v[3], out;

    for (int number = 0; number < (body->core.axis_count == 3 ? 12 : 1); number++) {
        piece_of(&body->core, number, v);
        tahr__core_distance(&shape->core, centre, v, &w);
        if (number == 0 || w.distance < best.distance) best = w;
    }
    double depth = -1;
    if (body->core.axis_count == 3 || best.distance <= TOUCHING)
        depth = tahr__core_leave_solid(&shape->core, centre, &body->core, v_make(0, 0, 0), &out);
    if (depth < 0 && best.distance <= TOUCHING) { /* the axis that almost parts them is the way, if there is one */
        out = depth < -2 * TOUCHING ? across(&shape->core, &body->core) : out;
        depth = 0;
    }
    near->distance = (depth >= 0 ? -depth : best.distance) - radii;
    near->normal = depth >= 0 ? out : best.normal;
    near->point = best.point;
    if (depth >= 0 && body->core.axis_count == 3)
        near->point = v_mad(centre, out, depth - tahr__core_extent(&shape->core, out));
    near->point = v_mad(near->point, near->normal, body->radius);
}

tahr_vec3 tahr__solid_face(const tahr__solid *body, const tahr__solid_near *near, tahr_vec3 direction,
                           uint32_t *feature)
{
    tahr_vec3 face = near->normal;
    double most_normal = -2, most = -1e300;

    *feature = 0;
    for (uint32_t i = 0; i < 6 && body->core.axis_count == 3; i++) {
        const double half = v_length(body->core.axis[i / 2]);
        const tahr_vec3 n = v_scale(body->core.axis[i / 2], (i & 1 ? 1 : -1) / half);
        if (v_dot(n, near->normal) > most_normal) {
            most_normal = v_dot(n, near->normal);
            *feature = i;
            if (most == -1e300) face = n; /* of a point inside: the face that is the way out */
        }
        if (v_dot(n, near->normal) <= 1e-9 || v_dot(n, near->point) < half - 1e-9) continue;
        if (v_dot(n, direction) <= most) continue;
        most = v_dot(n, direction);
        face = n;
    }
    return face;
}

tahr__solid_verdict tahr__solid_advance(const tahr__solid *shape, const tahr__solid *body, tahr_vec3 start,
                                        tahr_vec3 motion, double margin, double *fraction, tahr__solid_near *near)
{
    const double length = v_length(motion);
    double t = 0;

    for (int i = 0; i < MAX_TANGENTS; i++) {
        tahr__solid_measure(shape, body, v_mad(start, motion, t), near);
        const double gap = near->distance - margin, speed = -v_dot(motion, near->normal);
        *fraction = t;
        if (!(speed > PARALLEL * length)) return TAHR__SOLID_FREE;
        if (gap <= (i == 0 ? 0 : ARRIVED)) return TAHR__SOLID_HIT;
        t += gap / speed;
        if (t > 1) return TAHR__SOLID_FREE;
        if (t == *fraction) return TAHR__SOLID_HIT;
    }
    return TAHR__SOLID_UNKNOWN;
}

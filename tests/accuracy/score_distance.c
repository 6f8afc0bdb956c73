/* SPDX-License-Identifier: MIT
 * score_distance.c: the judge's distance, and the cone of normals that are right at a place. */
#include "score_distance.h"

/* More directions than this are never closest at once to a sensible slack; what is beyond is not looked at. */
enum { MAX_DIRECTIONS = 64 };

static const long double DEGREES = 57.295779513082320876798L;

static vec from(const double v[3], tahr_vec3 origin)
{
    return (vec){(real)v[0] - origin.x, (real)v[1] - origin.y, (real)v[2] - origin.z};
}

static vec turned(tahr_quat q, vec v)
{
    vec u = {q.x, q.y, q.z};
    return vadd(v, vmul(vadd(vmul(vcross(u, v), q.w), vcross(u, vcross(u, v))), 2));
}

core score__core(const tahr_sweep *query, long double fraction)
{
    const tahr_shape *s = &query->shape;
    core k = {vmul((vec){query->motion.x, query->motion.y, query->motion.z}, fraction), {{0, 0, 0}}, 0};

    if (s->type == TAHR_SHAPE_CAPSULE && s->half_height > s->radius) {
        k.axes = 1;
        k.axis[0] = vmul((vec){query->up.x, query->up.y, query->up.z}, (real)s->half_height - s->radius);
    } else if (s->type == TAHR_SHAPE_BOX) {
        k.axes = 3;
        k.axis[0] = turned(query->orientation, (vec){s->half_x, 0, 0});
        k.axis[1] = turned(query->orientation, (vec){0, s->half_y, 0});
        k.axis[2] = turned(query->orientation, (vec){0, 0, s->half_height});
    }
    return k;
}

triangle score__triangle(const score_body *body, const tahr_sweep *query, uint32_t index)
{
    triangle t;

    for (uint32_t i = 0; i < 3; i++) {
        t.v[i] = from(&body->vertices[3 * body->indices[3 * index + i]], query->position);
    }
    return t;
}

int score__beyond(const tahr_sweep *query, const triangle *t, double way, double reach)
{
    const tahr_shape *s = &query->shape;
    double size = 0, span = 0, away = 0, middle[3];
    for (int i = 0; i < 3; i++) {
        const real *a = &t->v[0].x + i, *b = &t->v[1].x + i, *c = &t->v[2].x + i;
        middle[i] = (double)(*a + *b + *c) / 3;
        away += middle[i] * middle[i];
    }
    for (int i = 0; i < 3; i++) {
        double x = (double)t->v[i].x - middle[0], y = (double)t->v[i].y - middle[1], z = (double)t->v[i].z - middle[2];
        double squared = x * x + y * y + z * z;
        span = squared > span ? squared : span;
    }
    size = s->half_height + s->half_x + s->half_y + s->radius;
    double far = (sqrt(span) + size + way + reach) * (1 + 1e-9);
    return away > far * far;
}

int score__inside(const score_body *body, const tahr_sweep *query, long double fraction)
{
    vec p = score__core(query, fraction).centre;

    for (uint32_t i = 0; i < body->triangle_count; i++) {
        triangle t = score__triangle(body, query, i);
        vec n = vcross(vsub(t.v[1], t.v[0]), vsub(t.v[2], t.v[0]));
        if (vdot(n, vsub(p, t.v[0])) > 0) {
            return 0;
        }
    }
    return body->triangle_count > 0;
}

nearest score__nearest(const score_scene *scene, const tahr_sweep *query, long double fraction, double reach)
{
    core k = score__core(query, fraction);
    double way = sqrt((double)vdot(k.centre, k.centre));
    nearest best = {-1, {0, 0, 0}, {0, 0, 0}};

    for (uint32_t b = 0; b < scene->body_count; b++) {
        const score_body *body = &scene->bodies[b];
        for (uint32_t i = 0; i < body->triangle_count; i++) {
            triangle t = score__triangle(body, query, i);
            if (score__beyond(query, &t, way, reach)) {
                continue;
            }
            nearest found = core_triangle(&k, &t);
            if (best.squared < 0 || found.squared < best.squared) {
                best = found;
            }
        }
        if ((body->flags & SCORE_SOLID) && score__inside(body, query, fraction)) {
            return (nearest){0, {0, 0, 0}, {0, 0, 0}};
        }
    }
    return best;
}

double score_distance(const score_scene *scene, const tahr_sweep *query, double fraction, double reach)
{
    nearest found = score__nearest(scene, query, fraction, reach);
    return found.squared < 0 ? INFINITY : (double)(sqrtl(found.squared) - query->shape.radius);
}

static vec unit(vec v)
{
    return vmul(v, 1 / sqrtl(vdot(v, v)));
}

static long double between(vec a, vec b)
{
    vec side = vcross(a, b);
    return atan2l(sqrtl(vdot(side, side)), vdot(a, b)) * DEGREES;
}

/* From n to the arc from a to b; two that are opposite span no cone that says anything. */
static long double to_arc(vec a, vec b, vec n)
{
    vec axis = vcross(a, b), foot;

    if (vdot(axis, axis) < 1e-24L) {
        return 180;
    }
    axis = unit(axis);
    foot = vsub(n, vmul(axis, vdot(n, axis)));
    if (vdot(vcross(a, foot), axis) < 0 || vdot(vcross(foot, b), axis) < 0 || vdot(foot, foot) == 0) {
        return 180;
    }
    return between(n, foot);
}

static int in_cone(vec a, vec b, vec c, vec n)
{
    real det = vdot(vcross(a, b), c), x, y, z;

    if (det * det < 1e-24L) {
        return 0;
    }
    x = vdot(vcross(b, c), n) / det, y = vdot(vcross(c, a), n) / det, z = vdot(vcross(a, b), n) / det;
    return x >= 0 && y >= 0 && z >= 0;
}

/* The nearest point of a cone lies on a ray, in a face of two, or the direction lies in a cone of three. */
static long double to_cone(const vec *d, int count, vec n)
{
    long double best = 180;

    for (int i = 0; i < count; i++) {
        best = fminl(best, between(d[i], n));
        for (int j = 0; j < i; j++) {
            best = fminl(best, to_arc(d[j], d[i], n));
            for (int k = 0; k < j; k++) {
                if (in_cone(d[k], d[j], d[i], n)) {
                    return 0;
                }
            }
        }
    }
    return best;
}

static void keep_direction(vec *directions, int *count, vec gap)
{
    vec d = unit(gap);

    for (int i = 0; i < *count; i++) {
        vec apart = vsub(d, directions[i]);
        if (vdot(apart, apart) < 1e-24L) {
            return;
        }
    }
    if (*count < MAX_DIRECTIONS) {
        directions[(*count)++] = d;
    }
}

double score_normal_error(const score_scene *scene, const tahr_sweep *query, double fraction, double slack,
                          tahr_vec3 normal)
{
    core k = score__core(query, fraction);
    nearest least = score__nearest(scene, query, fraction, INFINITY);
    double way = sqrt((double)vdot(k.centre, k.centre));
    vec directions[MAX_DIRECTIONS];
    int count = 0;

    if (least.squared < 0) {
        return 180;
    }
    long double reach = sqrtl(least.squared) + slack;
    for (uint32_t b = 0; b < scene->body_count; b++) {
        for (uint32_t i = 0; i < scene->bodies[b].triangle_count; i++) {
            triangle t = score__triangle(&scene->bodies[b], query, i);
            if (score__beyond(query, &t, way, (double)reach)) {
                continue;
            }
            nearest found = core_triangle(&k, &t);
            if (found.squared > 0 && found.squared <= reach * reach) {
                keep_direction(directions, &count, found.gap);
            }
        }
    }
    return (double)to_cone(directions, count, (vec){normal.x, normal.y, normal.z});
}

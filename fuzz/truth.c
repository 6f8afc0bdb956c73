/* SPDX-License-Identifier: MIT
 * truth.c: see truth.h. The distance from a point to a convex body is convex along a segment: its smallest value on the
 * axis of a shape is found by ternary search, whatever the body is. */
#include "truth.h"

#include <math.h>

/* After so many thirds the rest of the axis is 1e-9 of it. */
enum { THIRDS = 52 };

/* A triangle whose height is less than this part of its longest edge is not there (tahr/world.h): two corners in one
 * place, or three in a line. */
#define NO_AREA 1e-10

typedef tahr_vec3 vec;

/* One convex thing, relative to the middle of the axis. */
typedef struct thing {
    const tahr_body_desc *body; /* NULL: the triangle */
    vec at;                     /* of the body */
    vec corner[3];
} thing;

static vec minus(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static vec plus(vec a, vec b, double t)
{
    return (vec){a.x + b.x * t, a.y + b.y * t, a.z + b.z * t};
}

static double dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec cross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double length(vec a)
{
    return sqrt(dot(a, a));
}

static int has_area(const vec c[3])
{
    vec ab = minus(c[1], c[0]), bc = minus(c[2], c[1]), ca = minus(c[0], c[2]);
    double longest = fmax(length(ab), fmax(length(bc), length(ca)));
    return length(cross(ab, ca)) > NO_AREA * longest * longest;
}

static double to_segment(vec p, vec a, vec b)
{
    vec way = minus(b, a);
    double square = dot(way, way), t = square > 0 ? dot(minus(p, a), way) / square : 0;
    return length(minus(p, plus(a, way, fmin(fmax(t, 0), 1))));
}

/* Over the inside of the triangle the distance to its plane, else to the nearest edge. */
static double to_triangle(vec p, const vec c[3])
{
    vec normal = cross(minus(c[1], c[0]), minus(c[2], c[0]));
    double nearest = INFINITY, size = length(normal);
    int inside = size > 0;
    for (int i = 0; i < 3; i++) {
        vec a = c[i], b = c[(i + 1) % 3];
        inside &= dot(cross(normal, minus(b, a)), minus(p, a)) >= 0;
        nearest = fmin(nearest, to_segment(p, a, b));
    }
    return inside ? fmin(nearest, fabs(dot(normal, minus(p, c[0]))) / size) : nearest;
}

/* v as the body sees it: turned back by its orientation. */
static vec turned_back(tahr_quat q, vec v)
{
    vec axis = {-q.x, -q.y, -q.z};
    vec twice = cross(axis, v);
    return plus(plus(v, twice, 2 * q.w), cross(axis, twice), 2);
}

static double to_solid(vec p, const tahr_body_desc *body)
{
    vec local = turned_back(body->pose.orientation, p), h = body->half_extents;
    double core = body->half_height - body->radius;
    if (body->type == TAHR_BODY_BOX) {
        vec out = {fmax(fabs(local.x) - h.x, 0), fmax(fabs(local.y) - h.y, 0), fmax(fabs(local.z) - h.z, 0)};
        return length(out);
    }
    core = body->type == TAHR_BODY_CAPSULE ? core : 0;
    return to_segment(local, (vec){0, 0, -core}, (vec){0, 0, core}) - body->radius;
}

static double to_thing(vec p, const thing *t)
{
    return t->body ? to_solid(minus(p, t->at), t->body) : to_triangle(p, t->corner);
}

/* From the axis, which reaches `half` up and down. */
static double from_axis(const thing *t, vec up, double half)
{
    double low = -half, high = half;
    for (int i = 0; i < THIRDS && half > 0; i++) {
        double third = (high - low) / 3;
        double a = to_thing(plus((vec){0, 0, 0}, up, low + third), t);
        double b = to_thing(plus((vec){0, 0, 0}, up, high - third), t);
        if (a < b)
            high -= third;
        else
            low += third;
    }
    return to_thing(plus((vec){0, 0, 0}, up, (low + high) / 2), t);
}

static double from_mesh(const tahr_body_desc *mesh, vec position, vec up, double half, double reach)
{
    double nearest = reach;
    thing t = {.body = NULL};
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            const double *v = mesh->vertices + (size_t)3 * mesh->indices[3 * i + (uint32_t)k];
            t.corner[k] = (vec){v[0], v[1], v[2]};
        }
        if (!has_area(t.corner)) continue;
        for (int k = 0; k < 3; k++)
            t.corner[k] = plus(minus(mesh->pose.position, position), t.corner[k], 1);
        if (to_triangle((vec){0, 0, 0}, t.corner) - half > nearest) continue;
        nearest = fmin(nearest, from_axis(&t, up, half));
    }
    return nearest;
}

int truth_knows(const scene *s, const tahr_shape *shape)
{
    return s->movers == 0 && (shape->type == TAHR_SHAPE_SPHERE || shape->type == TAHR_SHAPE_CAPSULE);
}

double truth_gap(const scene *s, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up, double reach)
{
    double half = shape->type == TAHR_SHAPE_CAPSULE ? shape->half_height - shape->radius : 0;
    double nearest = reach + shape->radius;
    for (uint32_t i = 0; i < s->body_count; i++) {
        const tahr_body_desc *body = &s->bodies[i];
        if (body->flags & (TAHR_BODY_SENSOR | TAHR_BODY_FLUID)) continue;
        if (body->type == TAHR_BODY_MESH) {
            if (body->flags & TAHR_BODY_TWO_SIDED) nearest = from_mesh(body, position, up, half, nearest);
            continue;
        }
        thing t = {.body = body, .at = minus(body->pose.position, position)};
        if (to_thing((vec){0, 0, 0}, &t) - half > nearest) continue;
        nearest = fmin(nearest, from_axis(&t, up, half));
    }
    return nearest - shape->radius;
}

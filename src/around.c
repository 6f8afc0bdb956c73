/* SPDX-License-Identifier: MIT
 * around.c: going on around an edge or a round body within a slice.
 *
 * A round character that slides over an edge stays at R = radius + skin from it: its centre goes along a circle, and the
 * way that is left to it turns with the normal. Kept straight for a slice the way is off by the order of its length: on
 * the circle the angle to the wish grows as phi' = |u| / R sin phi, a chord of length l sees sin of its begin instead of
 * its mean, and ends l^2 / 2R off the edge.
 *
 * So the way is a chain of tangents. From the point where one touches the circle the character goes l/2 along it, the
 * plane is turned until it touches the circle again, and l/2 on it is at the touching point. Of a tangent of length l:
 * - it leaves the circle by R (sqrt(1 + (l / 2R)^2) - 1) <= l^2 / 8R at its ends, and touches it in its middle. Pieces
 *   are as long as config.path_tolerance lets them be by that: l = sqrt(8 R tolerance).
 * - its velocity is that of its middle: the midpoint rule, whose error is l^3 / 24 R^2 at most for a constant wish
 *   (phi''' <= (|u| / R)^3), so the end falls in proportion to the tolerance, not to its root.
 * Turned is by reflection: the two tangents from a point to a circle mirror each other in the line to its centre. */
#include "around.h"

#include "plane.h"
#include "shape.h"

/* Sine of the angle between contact and face below which the contact is that face's: 1e-4 of a radius is less than a
 * hundredth of a skin. */
static const double ON_FACE = 1e-4;

/* Of two directions: parallel or across, but for rounding. */
static const double ALIGNED = 1e-6;

/* Of the radius: a way of less is off by half a thousandth of itself at most if it stays straight. */
static const double SHORT = 1e-3;

static int is_along(vec3 a, vec3 b)
{
    return length_squared(cross(a, b)) < ALIGNED * ALIGNED;
}

/* The axis of a body that is round about one, where its side is met. Returns 0 at the cap of a capsule and of a ball:
 * round about a point. */
static int axis_of_body(const tahr__body_note *note, vec3 normal, vec3 *axis)
{
    *axis = rotate(note->pose.orientation, vec(0, 0, 1));
    double lean = dot(normal, *axis);
    return note->straight > 0 && lean < ALIGNED && lean > -ALIGNED;
}

/* m that the thing met adds to the radius; < 0: it is not round. An edge lies across its own contact and face. */
static double roundness(const tahr__step *step, const tahr_hit *hit, vec3 *axis)
{
    vec3 along = cross(hit->normal, hit->surface_normal);
    double sine = length(along);
    if (sine > ON_FACE) {
        *axis = scale(along, 1 / sine);
        return 0;
    }
    const tahr_world *world = step->world;
    if (hit->body >= world->body_count || world->bodies[hit->body].round == 0) {
        return -1;
    }
    const tahr__body_note *note = &world->bodies[hit->body];
    if (!axis_of_body(note, hit->normal, axis)) {
        *axis = vec(0, 0, 0);
    }
    return note->round;
}

/* Where the side of a capsule is met, the place and what it met are round together only about up: about an axis beside
 * it, or a flat patch that two crossing segments span. */
static int side_is_round(const tahr__step *step, vec3 normal, vec3 *axis)
{
    const tahr_shape *shape = &step->limits->shape;
    double lean = dot(normal, step->state.up);
    if (shape->half_height <= shape->radius || lean > ALIGNED || lean < -ALIGNED) {
        return 1;
    }
    if (length_squared(*axis) == 0) {
        *axis = step->state.up;
    }
    return is_along(*axis, step->state.up);
}

void tahr__around_meet(const tahr__step *step, const tahr_hit *hit, int level, tahr__around *a)
{
    const tahr_shape *shape = &step->limits->shape;
    int is_ball = shape->type == TAHR_SHAPE_SPHERE || shape->type == TAHR_SHAPE_CAPSULE;
    vec3 axis, normal = hit->normal;
    int again = a->done > 0 && a->body == hit->body && a->feature == hit->feature;
    a->is_round = a->turns = 0;
    if (step->config->path_tolerance == 0 || !is_ball || a->is_flat || a->done >= TAHR__MOST_TURNS) {
        return;
    }
    if (again && dot(hit->normal, a->normal) < 1 - 0.5 * ALIGNED) { /* it was turned, the thing was not */
        a->is_flat = 1;
        return;
    }
    double more = roundness(step, hit, &axis);
    if (more < 0 || !side_is_round(step, normal, &axis)) {
        return;
    }
    double radius = shape->radius + more + max_of(hit->distance, 0);
    if (level || is_in_plane(step)) { /* the circle in which its plane cuts the ball or the cylinder */
        vec3 held = level ? step->state.up : step->limits->plane;
        if ((level && is_in_plane(step)) || (length_squared(axis) > 0 && !is_along(axis, held))) {
            return;
        }
        axis = held;
        normal = reject(normal, held);
        radius *= length(normal);
        normal = unit(normal);
    }
    a->pivot = add_scaled(step->state.position, normal, -radius);
    a->axis = axis;
    a->radius = radius;
    a->normal = normal;
    a->body = hit->body;
    a->feature = hit->feature;
    a->is_round = radius > 0;
}

static vec3 across(const tahr__around *a, vec3 v)
{
    return length_squared(a->axis) > 0 ? reject(v, a->axis) : v;
}

/* A free path that falls below the plane less than the circle does leaves it. */
static int is_pressed(const tahr__around *a, vec3 along, vec3 freely)
{
    const double part = TAHR__GLIMPSE;
    return -dot(a->normal, freely) * 2 * a->radius >= length_squared(across(a, along)) * (part * part);
}

void tahr__around_start(const tahr__step *step, tahr__around *a, vec3 along, vec3 freely, double time)
{
    double way = length(across(a, along));
    a->turns = is_pressed(a, along, freely) && way > SHORT * a->radius;
    if (a->turns && a->is_round) {
        double pieces = way / sqrt(8 * a->radius * step->config->path_tolerance);
        a->piece = time / (double)(1 + (int)min_of(pieces, TAHR__MOST_TURNS - 1));
        a->next = 0.5 * a->piece;
    }
    a->is_round = 0;
}

int tahr__around_use(tahr__around *a, double time)
{
    const double rounding = 1e-12; /* s */
    a->next -= time;
    return a->turns && a->next <= rounding;
}

int tahr__around_turn(tahr__step *step, tahr__around *a, tahr__plane *plane, vec3 *velocity)
{
    vec3 out = unit(across(a, sub(step->state.position, a->pivot)));
    vec3 normal = unit(add_scaled(scale(a->normal, -1), out, 2 * dot(a->normal, out)));
    double turned = dot(normal, a->normal);
    a->next = a->piece;
    a->turns = ++a->done < TAHR__MOST_TURNS && turned > 0;
    if (turned <= 0 || turned >= 1) {
        return 0;
    }
    *velocity = rotate(quat_between(a->normal, normal), *velocity);
    a->normal = normal;
    *plane = (tahr__plane){
        .normal = normal, .anchor = step->state.position, .body = a->body, .feature = a->feature};
    step->report.arcs++;
    return 1;
}

/* SPDX-License-Identifier: MIT
 * around.c: going on around an edge or a round body within a slice.
 *
 * A round character that slides over an edge stays at R = radius + skin from it: its centre goes along a circle, and
 * the way that is left to it turns with the normal. Kept straight for a slice the way is off by the order of its
 * length: on the circle the angle to the wish grows as phi' = |u| / R sin phi, a chord of length l sees sin of its
 * begin instead of its mean, and ends l^2 / 2R off the edge.
 *
 * So the way is a chain of tangents. From the point where one touches the circle the character goes l/2 along it, the
 * plane is turned until it touches the circle again, and l/2 on it is at the touching point. Of a tangent of length l:
 * - it leaves the circle by R (sqrt(1 + (l / 2R)^2) - 1) <= l^2 / 8R at its ends, and touches it in its middle. Pieces
 *   are as long as config.path_tolerance lets them be by that: l = sqrt(8 R tolerance).
 * - its velocity is that of its middle: the midpoint rule, whose error is l^3 / 24 R^2 at most for a constant wish
 *   (phi''' <= (|u| / R)^3), so the end falls in proportion to the tolerance, not to its root.
 * At a constant wish tan(phi / 2) grows as exp(|u| t / R), which says by how much the plane turns in a piece, and each
 * half of its way is R times the tangent of half of that: then the end is exact, and only the way between lies off.
 * Turned is by reflection: the two tangents from a point to a circle mirror each other in the line to its centre. */
#include "around.h"

#include "elementary.h"
#include "plane.h"

/* Sine of the angle between contact and face below which the contact is that face's: 1e-4 of a radius is less than a
 * hundredth of a skin. */
static const double ON_FACE = 1e-4;

/* Of two directions: parallel or across, but for rounding. */
static const double ALIGNED = 1e-6;

/* Of a round body's side: what the normals of backends lean by. */
static const double UPRIGHT = 1e-3;

/* Cosine between where a plane was turned to and where it is: a thousandth of a radian. */
static const double TURNED = 1 - 0.5e-6;

/* Of the radius: a way of less is off by half a ten-thousandth of itself at most if it stays straight. */
static const double SHORT = 1e-4;

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
    return note->straight > 0 && lean < UPRIGHT && lean > -UPRIGHT;
}

/* m that the thing met adds to the radius; < 0: it is not round. An edge lies across its own contact and face. */
static double roundness(const tahr__step *step, const tahr_hit *hit, vec3 *axis)
{
    const tahr_world *world = step->world;
    vec3 along = cross(hit->normal, hit->surface_normal);
    double sine2 = length_squared(along);
    if (sine2 > ON_FACE * ON_FACE) {
        *axis = scale(along, 1 / sqrt(sine2));
        return 0;
    }
    if (!world->bodies || hit->body >= world->body_count || world->bodies[hit->body].round == 0) {
        return -1;
    }
    const tahr__body_note *note = &world->bodies[hit->body];
    if (!axis_of_body(note, hit->normal, axis)) {
        *axis = vec(0, 0, 0);
    }
    return note->round;
}

/* The side of a capsule goes around what it meets about up: an edge along it, a ball, or a corner, which looks like one
 * of its edges. A true edge across it spans a flat patch with it: that shows when it was turned. */
static int is_side(const tahr__step *step, vec3 normal)
{
    const tahr_shape *shape = &step->limits->shape;
    double lean = dot(normal, step->state.up);
    return shape->half_height > shape->radius && lean < ALIGNED && lean > -ALIGNED;
}

/* A plane that was turned is where the thing should be. Beside what is really there it would hold the character by a
 * hair of an angle. */
void tahr__around_hit(const tahr__around *a, tahr__plane *planes, uint32_t *count)
{
    uint32_t kept = 0;
    if (a->done == 0) {
        return;
    }
    for (uint32_t i = 0; i < *count; i++) {
        if (planes[i].body != a->body || planes[i].feature != a->feature) {
            planes[kept++] = planes[i];
        }
    }
    *count = kept;
}

/* A cylinder about `axis` or a ball, cut by the plane that the character stays in. Returns 0 if that leaves no
 * circle. */
static int cut_by_plane(const tahr__step *step, int level, tahr__around *a)
{
    vec3 held = level ? step->state.up : step->limits->plane;
    if (level && is_in_plane(step)) { /* a line */
        return 0;
    }
    if (length_squared(a->axis) > 0) { /* aslant of level an ellipse: the plane is turned as the cylinder's */
        return level || is_along(a->axis, held);
    }
    vec3 flat = reject(a->normal, held);
    a->axis = held;
    a->radius *= length(flat);
    a->normal = unit(flat);
    return a->radius > 0;
}

static int make_round(const tahr__step *step, const tahr_hit *hit, int level, tahr__around *a)
{
    double more = roundness(step, hit, &a->axis);
    if (more < 0) {
        return 0;
    }
    if (is_side(step, hit->normal)) {
        if (level && length_squared(a->axis) > 0 && !is_along(a->axis, step->state.up)) {
            return 0;
        }
        a->axis = step->state.up;
    }
    a->radius = step->limits->shape.radius + more + max_of(hit->distance, 0);
    a->normal = length_squared(a->axis) > 0 ? unit(reject(hit->normal, a->axis)) : hit->normal;
    return !(level || is_in_plane(step)) || cut_by_plane(step, level, a);
}

void tahr__around_meet(const tahr__step *step, const tahr_hit *hit, int level, tahr__around *a)
{
    uint32_t shape = step->limits->shape.type;
    int before = a->done > 0 || a->turns;
    const vec3 was = a->normal;
    tahr__around_leave(a);
    if (step->config->path_tolerance == 0 || a->is_over || a->done >= TAHR__MOST_TURNS ||
        (shape != TAHR_SHAPE_SPHERE && shape != TAHR_SHAPE_CAPSULE) || !make_round(step, hit, level, a)) {
        return;
    }
    /* The plane was turned or left, and the thing was not; or another one is in the way: between two edges going around
     * one would lead into the other, and back. */
    if (before && (a->body != hit->body || a->feature != hit->feature || dot(a->normal, was) < TURNED)) {
        a->is_over = 1;
        return;
    }
    a->pivot = add_scaled(step->state.position, a->normal, -a->radius);
    a->body = hit->body;
    a->feature = hit->feature;
    a->is_round = 1;
}

static vec3 across(const tahr__around *a, vec3 v)
{
    return length_squared(a->axis) > 0 ? reject(v, a->axis) : v;
}

/* A free path that bends less than the circle leaves it. What rises off the plane by the rounding of the chords before,
 * and is back within the time, does not. */
static int is_pressed(const tahr__around *a, const tahr__ahead *ahead)
{
    const double part = TAHR__GLIMPSE;
    double lift = dot(a->normal, ahead->velocity) * (part * ahead->time);
    double fall = lift - dot(a->normal, ahead->freely);
    double way2 = length_squared(across(a, ahead->along)) * (part * part);
    return fall * 2 * a->radius >= way2 && lift * part <= fall;
}

/* Cuts `time` into pieces, of a way of so many metres. */
static void cut(const tahr__step *step, tahr__around *a, double way, double time)
{
    double pieces = way / sqrt(8 * a->radius * step->config->path_tolerance);
    a->piece = time / (double)(1 + (int)min_of(pieces, TAHR__MOST_TURNS - 1));
    a->rest = a->over = 0;
}

double tahr__around_longest(const tahr__law *law, double speed, double time)
{
    return min_of(max_of(speed, law->speed), speed + law->acceleration * time) * time;
}

int tahr__around_start(const tahr__step *step, tahr__around *a, const tahr__ahead *ahead)
{
    double way = length(across(a, ahead->along));
    int goes_on = a->turns || a->is_round, pressed = is_pressed(a, ahead);
    a->turns = goes_on && pressed && way > SHORT * a->radius;
    a->reach = 0;
    if (a->turns && a->is_round) {
        cut(step, a, ahead->longest, ahead->time);
    }
    a->next = a->rest + 0.5 * a->piece;
    a->rest = 0.5 * a->piece;
    a->is_round = 0;
    return pressed;
}

/* Tangent of half the angle by which a constant wish that comes at half_tangent of the normal goes around in a time,
 * until it leads off. [in,out] time: until then. exponent: |wish| time / R. */
static double tangent_of_turn(double half_tangent, double exponent, double *time)
{
    double gain = half_tangent * tahr__expm1(min_of(exponent, 64));
    double most = 1 - half_tangent;
    if (gain >= most) {
        *time *= half_tangent > 0 ? tahr__log1p(most / half_tangent) / exponent : 1;
        gain = most;
    }
    return gain / (1 + half_tangent * (half_tangent + gain));
}

void tahr__around_drive(const tahr__step *step, tahr__around *a, vec3 wish, vec3 along, double time)
{
    vec3 u = across(a, wish);
    double speed = length(u), into = -dot(a->normal, u), tangent = length(across(a, along));
    double exact = sqrt(max_of(speed * speed - into * into, 0));
    if (tangent < exact * (1 - ALIGNED) || tangent > exact * (1 + ALIGNED)) { /* something else bends it too */
        tahr__around_start(
            step, a, &(tahr__ahead){along, scale(along, time), scale(wish, TAHR__GLIMPSE * time), speed * time, time});
        return;
    }
    int goes_on = a->turns || a->is_round;
    double half = tangent / (speed + into), whole = time;
    double way = 2 * a->radius * tangent_of_turn(half, speed * time / a->radius, &whole);
    a->turns = goes_on && into > 0 && way > SHORT * a->radius;
    if (a->turns && a->is_round) {
        cut(step, a, way, time);
    }
    a->is_round = 0;
    if (!a->turns) {
        a->reach = 0;
        return;
    }
    double piece = a->piece;
    double over = a->radius * tangent_of_turn(half, speed * piece / a->radius, &piece);
    int last = time <= a->rest * (1 + ALIGNED);
    a->rested = a->rest;
    a->passed = a->over;
    a->next = a->rest + (last ? 0 : 0.5 * piece);
    a->reach = a->over + (last ? 0 : over);
    a->rest = 0.5 * piece;
    a->over = over;
}

vec3 tahr__around_way(const tahr__around *a, vec3 along, double time)
{
    vec3 straight = scale(along, time);
    if (!a->turns || a->reach == 0) {
        return straight;
    }
    vec3 level = across(a, along);
    double size = length(level);
    return size > 0 ? add_scaled(straight, level, (a->reach / (a->next * size) - 1) * time) : straight;
}

/* Slower before the circle is touched than after it. */
double tahr__around_time(const tahr__around *a, double time, double part)
{
    double way = part * a->reach;
    if (!a->turns || a->reach == 0) {
        return part * time;
    }
    if (way <= a->passed) {
        return a->passed > 0 ? a->rested * way / a->passed : 0;
    }
    return a->rested + (time - a->rested) * (way - a->passed) / (a->reach - a->passed);
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
    a->turns = ++a->done < TAHR__MOST_TURNS && turned > 0;
    if (turned <= 0 || turned >= 1) {
        return 0;
    }
    *velocity = rotate(quat_between(a->normal, normal), *velocity);
    a->normal = normal;
    *plane = (tahr__plane){.normal = normal, .anchor = step->state.position, .body = a->body, .feature = a->feature};
    step->report.arcs++;
    return 1;
}

/* SPDX-License-Identifier: MIT
 * body_motion.c: how bodies move: of those that the world described from their poses, of others as the backend says. */
#include "body_motion.h"

#include <string.h>

#include "elementary.h"
#include "answer.h"
#include "query.h"

/* The angle with this sine and cosine, both >= 0: Newton with the cubic term, from a guess within 0.08 rad; after two
 * rounds the error is below 1e-30. */
static double angle_of(double sine, double cosine)
{
    double a = sine < cosine ? sine : 1.5707963267948966 - cosine;
    for (int i = 0; i < 2; i++) {
        double s, c;
        tahr__sincos(a, &s, &c);
        double d = sine * c - cosine * s;
        a += d + d * d * d / 6;
    }
    return a;
}

double tahr__half_turn(tahr_quat from, tahr_quat to, vec3 *axis)
{
    tahr_quat d = quat_multiply(to, quat_inverse(from));
    vec3 v = d.w < 0 ? vec(-d.x, -d.y, -d.z) : vec(d.x, d.y, d.z);
    double sine = length(v);
    *axis = unit(v);
    return sine > 0 ? angle_of(sine, d.w < 0 ? -d.w : d.w) : 0;
}

static vec3 carried(const tahr_pose *from, const tahr_pose *to, vec3 at)
{
    if (quat_equal(from->orientation, to->orientation)) {
        return add(at, sub(to->position, from->position));
    }
    vec3 local = rotate(quat_inverse(from->orientation), sub(at, from->position));
    return add(to->position, rotate(to->orientation, local));
}

vec3 tahr__carried(const tahr_world *world, const tahr_pose *from, const tahr_pose *to, vec3 at)
{
    vec3 to_where = carried(from, to, at);
    return world_is_planar(world) ? vec(to_where.x, to_where.y, at.z) : to_where;
}

tahr_pose tahr__pose_between(const tahr_pose *from, const tahr_pose *to, double t)
{
    tahr_quat a = from->orientation, b = to->orientation;
    double side = (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w) < 0 ? -t : t;
    tahr_quat q = {a.x * (1 - t) + b.x * side, a.y * (1 - t) + b.y * side, a.z * (1 - t) + b.z * side,
                   a.w * (1 - t) + b.w * side};
    tahr_pose pose = {add_scaled(from->position, sub(to->position, from->position), t), quat_unit(q)};
    return pose;
}

vec3 tahr__point_velocity(const tahr_body_motion *motion, vec3 at, int turns)
{
    vec3 v = add(motion->velocity, motion->surface_velocity);
    if (turns) {
        v = add(v, cross(motion->angular_velocity, sub(at, motion->pose.position)));
    }
    double size = length(v);
    return size > TAHR__FASTEST_BODY ? scale(v, TAHR__FASTEST_BODY / size) : v;
}

static void motion_of_note(const tahr_world *world, const tahr__body_note *note, tahr_body_motion *motion)
{
    const vec3 still = {0, 0, 0};
    motion->pose = note->pose;
    motion->velocity = motion->angular_velocity = still;
    motion->surface_velocity = rotate(note->pose.orientation, note->surface_velocity);
    motion->mass = note->mass;
    motion->flags = note->flags;
    motion->teleported = note->jumped == world->moves;
    if (note->dt > 0) {
        vec3 axis;
        double half = tahr__half_turn(note->before.orientation, note->pose.orientation, &axis);
        motion->velocity = scale(sub(note->pose.position, note->before.position), 1 / note->dt);
        motion->angular_velocity = scale(axis, 2 * half / note->dt);
    }
}

tahr_status tahr__body_motion(const tahr_world *world, uint32_t body, tahr_body_motion *motion)
{
    if (body < world->body_count) {
        motion_of_note(world, &world->bodies[body], motion);
        return TAHR_OK;
    }
    if (world_is_character(world, body)) { /* neither carries nor is pushed: at rest, as far as it concerns others */
        memset(motion, 0, sizeof *motion);
        motion->pose.orientation.w = 1;
        motion->flags = TAHR__CHARACTER_FLAGS;
        return TAHR_OK;
    }
    return tahr__answer_motion(world, body, motion);
}

tahr_status tahr_world_body(tahr_world *world, uint32_t body, tahr_body_motion *motion)
{
    tahr_body_motion found;
    if (!world || !motion) {
        return TAHR_E_NULL;
    }
    tahr_status status = tahr__body_motion(world, body, &found);
    if (status >= 0) {
        *motion = found;
    }
    return status;
}

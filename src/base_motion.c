/* SPDX-License-Identifier: MIT
 * base_motion.c: riding and leaving bodies that move. A base is followed whatever its speed: also a lift that sinks
 * faster than anything falls. */
#include "base_motion.h"

#include <string.h>

#include "body_motion.h"
#include "elementary.h"
#include "move.h"
#include "plane.h"
#include "push.h"
#include "report.h"
#include "slide.h"

/* m; what falls short by less is the rounding of a slide along something. */
static const double FOLLOWED = 1e-6;

double tahr__go_along(tahr__step *step, vec3 motion)
{
    tahr__plane planes[4];
    uint32_t count = 0;
    motion = along_plane(step->limits, motion);
    const vec3 goal = add(step->state.position, motion);
    tahr_hit hit;
    for (int i = 0; i < 4 && step->error >= 0; i++) {
        vec3 left = count ? tahr__slide(planes, count, sub(goal, step->state.position)) : motion;
        if (length_squared(left) == 0) {
            break;
        }
        tahr__move(step, left, &hit);
        if (!hit.blocking && count == 0) {
            step->state.position = goal; /* PULL_BACK skips what is too short to sweep: a slow base would slip away */
        }
        if (!hit.blocking || hit.unknown || hit.start_overlap) {
            break;
        }
        tahr__plane plane = tahr__plane_of(step, &hit);
        plane.feature = (uint32_t)i; /* a key of its own: the same round body may be met twice */
        tahr__planes_add(planes, &count, &plane);
    }
    return length(sub(goal, step->state.position));
}

/* Does a body carry? Of those that the world described the ones in motion and conveyors; and what has carried once does
 * so until it is left. */
static int is_base(const tahr__step *step, uint32_t body)
{
    const tahr_world *world = step->world;
    if (body >= world->body_count) {
        return body != TAHR_NO_BODY;
    }
    const tahr__body_note *note = &world->bodies[body];
    return !(note->flags & TAHR_BODY_NO_BASE) &&
           (note->dt > 0 || length_squared(note->surface_velocity) > 0 || body == step->state.base.body);
}

/* Reads how a body moves. Returns 0 if it is gone, does not carry, or the answer was bad (then the step has failed). */
static int read_base(tahr__step *step, uint32_t body, tahr_body_motion *motion)
{
    if (!is_base(step, body)) {
        return 0;
    }
    tahr_status status = tahr__body_motion(step->world, body, motion);
    if (status < 0 && status != TAHR_E_NOT_FOUND) {
        step->error = status;
    }
    return status >= 0 && !(motion->flags & TAHR_BODY_NO_BASE);
}

/* As much of its velocity as counts for the character: in a plane nothing is carried out of it. */
static vec3 velocity_under(const tahr__step *step, const tahr_body_motion *motion, int turns)
{
    return along_plane(step->limits, tahr__point_velocity(motion, step_foot(step), turns));
}

static vec3 imparted(const tahr__step *step, vec3 v)
{
    vec3 up = step->state.up;
    double rise = dot(v, up);
    vec3 level = step->config->impart & TAHR_IMPART_LEVEL ? add_scaled(v, up, -rise) : vec(0, 0, 0);
    return step->config->impart & TAHR_IMPART_UP ? add_scaled(level, up, rise) : level;
}

/* No faster than a state may be. */
static vec3 bounded(vec3 v)
{
    double size = length(v);
    return size > 9e4 ? scale(v, 9e4 / size) : v;
}

static void forget_base(tahr_base *base)
{
    uint32_t seen = base->seen;
    *base = (tahr_base){.body = TAHR_NO_BODY, .seen = seen};
    base->pose.orientation.w = 1;
}

/* ImpartBaseVelocity: what a base hands to who leaves it: its present velocity, or the one remembered since it
 * stopped. */
static vec3 handed_over(tahr__step *step)
{
    tahr_state *s = &step->state;
    tahr_body_motion motion;
    vec3 v = s->base.velocity;
    if (read_base(step, s->base.body, &motion)) {
        vec3 now = velocity_under(step, &motion, (step->config->impart & TAHR_IMPART_TURN) != 0);
        v = length_squared(now) > 0 || s->lift_left == 0 ? now : v;
    }
    return imparted(step, v);
}

static void leave_base(tahr__step *step)
{
    tahr_state *s = &step->state;
    vec3 v = handed_over(step);
    s->velocity = bounded(add(s->velocity, v));
    forget_base(&s->base);
    s->base.velocity = add(v, vec(0, 0, 0));
    s->lift_left = 0;
}

/* Makes the velocity one relative to the world. */
static void leave_frame(tahr__step *step)
{
    if (step->frame_body == TAHR_NO_BODY) {
        return;
    }
    if (step->frame_is_base) {
        leave_base(step);
    } else {
        step->state.velocity = bounded(add(step->state.velocity, step->frame_velocity));
    }
    step->frame_body = TAHR_NO_BODY;
}

/* And relative to a body. */
static void enter_frame(tahr__step *step, uint32_t body, const tahr_body_motion *motion)
{
    step->frame_body = body;
    step->frame_is_base = 1;
    step->frame_velocity = velocity_under(step, motion, 1);
    step->state.velocity = bounded(sub(step->state.velocity, step->frame_velocity));
}

static void set_base(tahr__step *step, uint32_t body, const tahr_body_motion *motion)
{
    tahr_base *base = &step->state.base;
    const vec3 zero = {0, 0, 0};
    const tahr_quat q = motion->pose.orientation;
    base->body = body;
    base->pose.position = add(motion->pose.position, zero); /* -0.0 + 0.0 is 0.0 */
    base->pose.orientation = (tahr_quat){q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};
}

void tahr__board(tahr__step *step, uint32_t body)
{
    tahr_body_motion motion;
    if (step->frame_body == body && body != TAHR_NO_BODY) {
        int known = !step->frame_is_base && tahr__body_motion(step->world, body, &motion) >= 0;
        if (known && motion_tilts(step, &motion)) { /* until now it was that of what met it */
            vec3 now = velocity_under(step, &motion, 1);
            step->state.velocity = bounded(add(step->state.velocity, sub(step->frame_velocity, now)));
            step->frame_velocity = now;
        }
        step->frame_is_base = 1;
        return;
    }
    leave_frame(step);
    if (read_base(step, body, &motion)) {
        enter_frame(step, body, &motion);
    }
}

/* The yaw of a turn: its part about up. */
static void turn_along(tahr__step *step, tahr_quat from, tahr_quat to)
{
    tahr_quat d = quat_multiply(to, quat_inverse(from));
    vec3 up = step->state.up;
    double side = dot(vec(d.x, d.y, d.z), up);
    if (side != 0 && !quat_equal(from, to)) {
        tahr_quat yaw = quat_unit((tahr_quat){up.x * side, up.y * side, up.z * side, d.w});
        step->state.orientation = quat_unit(quat_multiply(yaw, step->state.orientation));
    }
}

/* The floor under a character that was carried without being tilted is the same one. */
static void carry_floor(tahr__step *step, const tahr_pose *last, const tahr_pose *now)
{
    tahr_state *s = &step->state;
    tahr_floor *floor = &s->floor;
    vec3 up = s->up, axis;
    double half = tahr__half_turn(last->orientation, now->orientation, &axis);
    if (half > 0 && (world_is_planar(step->world) || length_squared(cross(axis, up)) > 1e-24)) {
        return;
    }
    if (half > 0) {
        tahr_quat turn = quat_multiply(now->orientation, quat_inverse(last->orientation));
        floor->normal = unit(rotate(turn, floor->normal));
        floor->surface_normal = unit(rotate(turn, floor->surface_normal));
    }
    floor->point = tahr__carried(step->world, last, now, floor->point);
    s->floor_position = s->position;
}

/* The foot goes where that point of the base went; the shape stays upright over it. */
static void carry(tahr__step *step, const tahr_pose *now)
{
    const tahr_pose last = step->state.base.pose;
    vec3 foot = step_foot(step);
    vec3 motion = sub(tahr__carried(step->world, &last, now, foot), foot);
    step->ignore_body = step->state.base.body;
    int known = vec_equal(step->state.floor_position, step->state.position);
    double lost = tahr__go_along(step, motion);
    step->ignore_body = TAHR_NO_BODY;
    if (known && lost == 0) {
        carry_floor(step, &last, now);
    }
    if (step->config->turn_with_base && !is_flat(step)) {
        turn_along(step, last.orientation, now->orientation);
    }
    int followed = tahr__decide(step, TAHR_RULE_BASE, lost <= FOLLOWED, NULL, lost, FOLLOWED, "carried with the base");
    step->report.flags |= followed ? 0u : (uint32_t)TAHR_REPORT_BASE_LOST;
}

/* Along the belt, not into it. */
static void convey(tahr__step *step, vec3 belt, double dt)
{
    const tahr_floor *floor = &step->state.floor;
    if (floor->flags & TAHR_FLOOR_BLOCKING) {
        belt = reject(belt, floor->normal);
    }
    tahr__go_along(step, scale(belt, dt));
}

static void base_changed(tahr__step *step, uint32_t body)
{
    tahr_hit hit;
    memset(&hit, 0, sizeof hit);
    hit.body = body;
    tahr__event(step, TAHR_EVENT_BASE, &hit, 0);
}

static void follow(tahr__step *step, double dt)
{
    tahr_state *s = &step->state;
    tahr_body_motion motion;
    if (!read_base(step, s->base.body, &motion)) { /* it is gone */
        leave_base(step);
        s->floor_revision = 0;
        base_changed(step, TAHR_NO_BODY);
        return;
    }
    step->frame_body = s->base.body;
    step->frame_is_base = 1;
    if (!motion.teleported && !pose_equal(&s->base.pose, &motion.pose)) {
        carry(step, &motion.pose);
    }
    if (length_squared(motion.surface_velocity) > 0) {
        convey(step, motion.surface_velocity, dt);
    }
    step->frame_velocity = velocity_under(step, &motion, 1);
}

/* An imparted velocity v decays for so long: until then it moves by its mean, which finish_decay takes off to what is
 * left in the end. Returns the mean's part of it. */
static double begin_decay(tahr__step *step, vec3 v, double time)
{
    double half_life = step->config->imparted_half_life, size = length(v);
    if (size == 0 || half_life == 0 || time <= 0) {
        return 1;
    }
    double x = 0.6931471805599453 * time / half_life, lost = -tahr__expm1(-x);
    double left = size * (1 - lost);
    step->decay_mean = size * min_of(lost / x, 1);
    step->decay_left = left < 1e-9 ? 0 : left;
    return step->decay_mean / size;
}

/* What something else has stopped already is not taken away again. */
static void take_off(tahr__step *step, vec3 v, double much)
{
    vec3 way = unit(v);
    step->state.velocity = add_scaled(step->state.velocity, way, -clamp(dot(step->state.velocity, way), 0, much));
}

static void finish_decay(tahr__step *step)
{
    tahr_state *s = &step->state;
    if (step->decay_mean > 0) {
        take_off(step, s->base.velocity, step->decay_mean - step->decay_left);
        s->base.velocity = add(scale(unit(s->base.velocity), step->decay_left), vec(0, 0, 0));
        step->decay_mean = 0;
    }
}

static void decay(tahr__step *step, double time)
{
    vec3 v = step->state.base.velocity;
    double part = begin_decay(step, v, time);
    if (part < 1) {
        take_off(step, v, length(v) * (1 - part));
    }
}

void tahr__step_off(tahr__step *step)
{
    double left = step->dt - step->time - step->ahead;
    if (!step->frame_is_base || step->frame_body == TAHR_NO_BODY || step->state.base.body == TAHR_NO_BODY) {
        return;
    }
    if (length_squared(step->frame_velocity) == 0) { /* it has stopped: what it hands over nothing else carries */
        leave_frame(step);
        decay(step, left);
        base_changed(step, TAHR_NO_BODY);
        return;
    }
    vec3 v = handed_over(step);
    step->state.velocity = add_scaled(step->state.velocity, v, begin_decay(step, v, left) - 1);
}

/* What it stands on has begun to move. */
static void adopt_base(tahr__step *step)
{
    tahr_state *s = &step->state;
    uint32_t body = s->floor.body;
    int stands = s->mode == TAHR_MODE_WALKING && s->floor.flags & TAHR_FLOOR_WALKABLE;
    if (stands && body < step->world->body_count && step->world->bodies[body].dt > 0 && is_base(step, body) &&
        vec_equal(s->floor_position, s->position)) {
        tahr_body_motion motion = {.pose = step->world->bodies[body].before};
        set_base(step, body, &motion);
        base_changed(step, body);
    }
}

void tahr__ride(tahr__step *step, double dt)
{
    tahr_state *s = &step->state;
    const tahr_world *world = step->world;
    const vec3 from = s->position;
    uint32_t seen = world->moved_count > 0 ? (uint32_t)(world->revision + world->motion) : 0;
    int moved = world->moved_count > 0 && s->base.seen != seen;
    if (s->mode != TAHR_MODE_NONE) {
        if (moved && s->base.body == TAHR_NO_BODY) {
            adopt_base(step);
        }
        if (s->base.body != TAHR_NO_BODY) {
            follow(step, dt);
        } else {
            decay(step, dt);
        }
        if (moved) {
            tahr__meet_bodies(step, from, dt);
        }
        /* What moved is elsewhere, or the base: the floor need not be looked for again. */
        if (moved && s->floor_revision == world->last_revision && world->last_revision != 0 &&
            !tahr__moves_near(step, step->frame_body)) {
            s->floor_revision = world->revision;
        }
    }
    s->base.seen = seen;
}

static uint32_t support(const tahr_state *s)
{
    if (s->mode == TAHR_MODE_WALKING && s->floor.flags & TAHR_FLOOR_WALKABLE) {
        return s->floor.body;
    }
    return s->mode == TAHR_MODE_HANGING ? s->wall_body : TAHR_NO_BODY;
}

/* The velocity of the base, and for a while the last one that it had. */
static void remember_velocity(tahr__step *step, const tahr_body_motion *motion)
{
    tahr_state *s = &step->state;
    vec3 v = velocity_under(step, motion, (step->config->impart & TAHR_IMPART_TURN) != 0);
    if (length_squared(v) > 0) {
        s->base.velocity = add(v, vec(0, 0, 0));
        s->lift_left = step->config->lift_momentum;
        return;
    }
    s->lift_left = max_of(s->lift_left - step->dt, 0);
    if (s->lift_left == 0) {
        s->base.velocity = v;
    }
}

void tahr__note_base(tahr__step *step)
{
    tahr_state *s = &step->state;
    tahr_body_motion motion;
    uint32_t old = s->base.body, on = support(s);
    if (s->mode == TAHR_MODE_WALKING) {
        tahr__press_down(step);
    }
    int stands = read_base(step, on, &motion);
    on = stands ? on : TAHR_NO_BODY;
    if (on != step->frame_body) {
        leave_frame(step);
    }
    if (!stands) {
        if (old != TAHR_NO_BODY && s->base.body != TAHR_NO_BODY) { /* frozen, or put into another mode */
            forget_base(&s->base);
        }
        finish_decay(step);
        if (s->mode == TAHR_MODE_WALKING) {
            s->base.velocity = vec(0, 0, 0);
            s->lift_left = 0;
            s->velocity = step_level(step, s->velocity);
        }
    } else {
        if (on != step->frame_body) {
            enter_frame(step, on, &motion);
            s->velocity = step_level(step, s->velocity);
        }
        set_base(step, on, &motion);
        remember_velocity(step, &motion);
    }
    if (old != s->base.body) {
        base_changed(step, s->base.body);
    }
}

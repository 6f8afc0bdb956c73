/* SPDX-License-Identifier: MIT
 * hanging.c: hanging on the edge of a wall, climbing it and letting go. The state's floor tells of the edge: the
 * point on its top, the normal of the wall, and the top's as that of the surface; without flags, for nothing stands
 * on it. */
#include "hanging.h"

#include <string.h>

#include "drop.h"
#include "floor.h"
#include "modes.h"
#include "move.h"
#include "query.h"
#include "report.h"
#include "shape.h"
#include "wall.h"

/* Of the width: how far behind the face of the wall its top is looked at. A wall needs to be thicker. */
static const double INSET = 0.1;

/* Of the width: how far behind that place a climb ends, if nothing is in the way. */
static const double ONTO = 0.5;

/* Of skin: off the wall before rising along it, so that the rounding of an engine in single precision (2e-6 m)
 * meets no edge on the way. */
static const double CLEAR = 1e-3;

/* m, of a height on an arc that was solved for it. */
static const double LEVEL = 1e-9;

static vec3 head_of(const tahr__step *step)
{
    return add_scaled(step->state.position, step->state.up, step->limits->shape.half_height);
}

/* How far the shape reaches along a level direction. */
static double extent_along(const tahr__step *step, vec3 direction)
{
    const tahr_shape *s = &step->limits->shape;
    if (shape_is_round(s)) {
        return s->radius;
    }
    return shape_reach(s, dot(direction, rotate(step->state.orientation, vec(1, 0, 0))),
                       dot(direction, rotate(step->state.orientation, vec(0, 1, 0))));
}

double tahr__edge_depth(const tahr__step *step, const tahr_hit *edge)
{
    return dot(sub(head_of(step), edge->point), step->state.up);
}

int tahr__find_edge(tahr__step *step, vec3 facing, double below, tahr_hit *edge)
{
    vec3 up = step->state.up;
    double over = step->config->ledge_grab + step->config->skin;
    double inward = extent_along(step, facing) + step->config->skin + INSET * step->limits->width;
    vec3 from = add_scaled(head_of(step), up, over);
    tahr__ray(step, from, scale(facing, -inward), edge);
    if (edge->blocking) {
        return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 0, edge, over, 0, "the wall is higher");
    }
    tahr__ray(step, add_scaled(from, facing, -inward), scale(up, -(over + below)), edge);
    if (!edge->blocking || !tahr__is_walkable(step, edge, 0) || tahr__is_one_way(step, edge->body)) {
        return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 0, edge, below, 0, "no top to stand on");
    }
    tahr_hit ceiling; /* a ray that began inside of it would have seen nothing */
    tahr__ray(step, step->state.position, sub(from, step->state.position), &ceiling);
    return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, !ceiling.blocking, edge, below, 0, "an edge");
}

/* Whichever way it faces: between two walls close to each other nobody would come down any more. */
static int is_spent(const tahr__step *step, const tahr_hit *edge)
{
    const tahr_floor *old = &step->state.floor;
    double apart = dot(sub(edge->point, old->point), step->state.up), reach = step->config->ledge_grab;
    return step->state.flags & TAHR_STATE_EDGE_SPENT && apart < reach && apart > -reach;
}

static void keep_edge(tahr__step *step, vec3 facing, const tahr_hit *edge)
{
    tahr_floor floor = {.normal = facing,
                        .surface_normal = edge->surface_normal,
                        .point = edge->point,
                        .body = edge->body,
                        .feature = edge->feature,
                        .surface = edge->surface};
    tahr__keep_floor(step, &floor);
    tahr__hold_wall(step, facing, edge->body, edge->feature);
}

/* Moves the head level with the edge. Returns 0, at the old place, if something is in the way. */
static int level_with(tahr__step *step, const tahr_hit *edge)
{
    double rise = -tahr__edge_depth(step, edge);
    vec3 motion = scale(step->state.up, rise);
    tahr_hit hit;
    if (rise <= LEVEL && rise >= -LEVEL) {
        return 1;
    }
    tahr__sweep(step, &step->limits->shape, step->state.position, motion, step->config->skin, 0, &hit);
    if (hit.blocking) {
        return 0;
    }
    step->state.position = add(step->state.position, motion);
    return 1;
}

/* What is touched may be half a skin farther away than what was met. */
static void come_flush(tahr__step *step, vec3 facing)
{
    double skin = step->config->skin;
    tahr_hit hit;
    tahr__sweep(step, &step->limits->shape, step->state.position, scale(facing, -skin), skin, 0, &hit);
    if (is_met(&hit)) {
        step->state.position = add_scaled(step->state.position, facing, -skin * hit.fraction);
    }
}

int tahr__grab_edge(tahr__step *step, vec3 facing, const tahr_hit *edge)
{
    tahr_state *s = &step->state;
    if (s->flags & TAHR_STATE_CRUSHED) { /* who is not any more may hang */
        tahr__depenetrate(step);
    }
    double height = -tahr__edge_depth(step, edge);
    if (step->input->crouch || s->flags & TAHR_STATE_CRUSHED || is_spent(step, edge)) {
        return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 0, edge, height, step->config->ledge_grab, "let go");
    }
    if (!level_with(step, edge)) {
        return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 0, edge, height, step->config->ledge_grab, "no room");
    }
    come_flush(step, facing);
    s->velocity = vec(0, 0, 0);
    s->flags &= ~(uint32_t)(TAHR_STATE_JUMPING | TAHR_STATE_EDGE_SPENT);
    s->jump_hold = 0;
    keep_edge(step, facing, edge);
    tahr__event(step, TAHR_EVENT_GRABBED, edge, 0);
    return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 1, edge, height, step->config->ledge_grab, "hangs");
}

void tahr__forget_edge(tahr__step *step)
{
    double above = dot(sub(step->state.floor.point, head_of(step)), step->state.up);
    if (above > step->config->ledge_grab + LEVEL) {
        step->state.flags &= ~(uint32_t)TAHR_STATE_EDGE_SPENT;
    }
}

void tahr__let_go(tahr__step *step)
{
    step->state.flags |= TAHR_STATE_EDGE_SPENT;
}

/* The wall may have moved under the hand: its edge is looked for again, and followed. */
static int still_hangs(tahr__step *step)
{
    vec3 facing = step->state.floor.normal;
    double reach = step->config->ledge_grab;
    tahr_hit edge, wall;
    tahr__depenetrate(step);
    if (step->state.flags & TAHR_STATE_CRUSHED || length_squared(facing) < 0.5 || reach <= 0) {
        return 0;
    }
    vec3 before = step->state.position;
    tahr__sweep(step, &step->limits->shape, before, scale(facing, -reach), step->config->skin, 0, &wall);
    if (!wall.blocking || wall.start_overlap || !tahr__is_wall(step, wall.normal)) {
        return 0;
    }
    step->state.position = add_scaled(before, facing, -reach * wall.fraction);
    facing = tahr__facing_of(step, wall.normal);
    if (!tahr__find_edge(step, facing, reach, &edge) || !level_with(step, &edge)) {
        step->state.position = before;
        return 0;
    }
    keep_edge(step, facing, &edge);
    return 1;
}

/* Who is crushed looks again in every step, so that it is told until it is freed. */
static int hangs_on(tahr__step *step)
{
    return (floor_is_current(step) && !(step->state.flags & TAHR_STATE_CRUSHED)) || still_hangs(step);
}

tahr__next tahr__hang(tahr__step *step, double time)
{
    tahr__next next = {TAHR_MODE_HANGING, 0};
    step->state.velocity = vec(0, 0, 0);
    int away = dot(step->input->move, step->state.floor.normal) > TAHR__PUSHING;
    if (away || step->input->crouch) {
        tahr__let_go(step);
        return (tahr__next){TAHR_MODE_FALLING, time};
    }
    if (!hangs_on(step)) {
        tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 0, NULL, 0, 0, "the edge is gone");
        return (tahr__next){TAHR_MODE_FALLING, time};
    }
    step->time += time;
    return next;
}

static int refuse(tahr__step *step, const tahr_hit *hit, double value, const char *reason)
{
    return tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 0, hit, value, 0, reason);
}

/* Where the climb ends, before the floor there is judged. [out] landing. */
static int way_onto(tahr__step *step, vec3 *position, tahr_hit *landing)
{
    const tahr_config *c = step->config;
    const tahr_shape *shape = &step->limits->shape;
    const tahr_floor *edge = &step->state.floor;
    vec3 up = step->state.up, at = add_scaled(step->state.position, edge->normal, CLEAR * c->skin);
    tahr_hit hit;
    double lift = 2 * shape->half_height + c->floor_max * c->skin;
    tahr__sweep(step, shape, at, scale(up, lift), c->skin, 0, &hit);
    if (hit.blocking) {
        return refuse(step, &hit, hit.fraction * lift, "no room to rise");
    }
    at = add_scaled(at, up, lift);
    double over = dot(sub(at, edge->point), edge->normal); /* m, level, to the place over the edge */
    double onto = over + ONTO * step->limits->width;
    tahr__sweep(step, shape, at, scale(edge->normal, -onto), c->skin, 0, &hit);
    double ahead = hit.start_overlap ? 0 : hit.fraction * onto;
    if (ahead < over) {
        return refuse(step, &hit, ahead, "no room on the edge");
    }
    at = add_scaled(at, edge->normal, -ahead);
    double drop = c->snap_distance + c->floor_max * c->skin;
    tahr__sweep(step, shape, at, scale(up, -drop), c->skin, 0, landing);
    if (!landing->blocking || landing->start_overlap) {
        return refuse(step, landing, drop, "nothing to stand on");
    }
    *position = add_scaled(at, up, -drop * landing->fraction);
    return 1;
}

int tahr__climb_edge(tahr__step *step)
{
    tahr_state before = step->state;
    vec3 position;
    tahr_hit landing;
    tahr_floor floor;
    if (!hangs_on(step) || !way_onto(step, &position, &landing)) {
        return 0;
    }
    step->state.position = position;
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!floor_is_walkable(&floor) || step->error < 0) {
        step->state = before;
        return refuse(step, &landing, floor.distance, "no floor to stand on there");
    }
    double gain = dot(sub(position, before.position), step->state.up);
    tahr__keep_floor(step, &floor);
    tahr__forget_walls(step);
    step->report.step_offset += gain;
    tahr__event(step, TAHR_EVENT_STEPPED_UP, &landing, gain);
    tahr__decide(step, TAHR_RULE_LEDGE_GRAB, 1, &landing, gain, 0, "climbed");
    tahr__change_mode(step, TAHR_MODE_WALKING);
    return 1;
}

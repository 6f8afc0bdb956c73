/* SPDX-License-Identifier: MIT
 * drop.c: falling through the one-way bodies that one stands on.
 *
 * While it drops, its queries carry the DROP flags, which make a one-way body within two margins vanish. Of what it
 * meets besides, the floor that it stood on tells whether it is the same layer: state.floor stays as it was until the
 * next floor, its plane moves with the body. Two faces that meet, in a valley or at a crest, or side by side, are one
 * surface: at least one of the two does not have the other wholly behind it. The next layer lies under the floor, and
 * the floor over it. So a layer needs no name, no thickness and no time, and may be any number of bodies. */
#include "drop.h"

#include "body_motion.h"
#include "floor.h"
#include "modes.h"
#include "query.h"
#include "report.h"
#include "shape.h"
#include "walking.h"

int tahr__is_one_way(const tahr__step *step, uint32_t body)
{
    tahr_body_motion motion;
    if (body < step->world->body_count && step->world->bodies) {
        return (step->world->bodies[body].flags & TAHR_BODY_ONE_WAY) != 0;
    }
    return body != TAHR_NO_BODY && tahr__body_motion(step->world, body, &motion) >= 0 &&
           (motion.flags & TAHR_BODY_ONE_WAY);
}

/* What is below within reach of a floor, with the drop on or off. The shape is a copy: what it passes is no way of the
 * character's, and no sensor hears of it. */
static void look_below(tahr__step *step, uint32_t dropping, tahr_hit *hit)
{
    const tahr_shape shape = step->limits->shape;
    const uint32_t before = step->state.flags;
    double margin = drop_margin(step->config);
    step->state.flags = (before & ~(uint32_t)TAHR_STATE_DROPPING) | dropping;
    tahr__sweep(step, &shape, step->state.position, scale(step->state.up, -margin), margin, 0, hit);
    step->state.flags = before;
}

static int refuse(tahr__step *step, const tahr_hit *hit, const char *reason)
{
    return tahr__decide(step, TAHR_RULE_DROP, 0, hit, 0, 0, reason);
}

/* Of a body that nobody described the sweeps tell: it is there, and no longer when they drop. */
static int may_be_one_way(tahr__step *step, uint32_t body)
{
    tahr_hit hit;
    if (body < step->world->body_count || tahr__is_one_way(step, body)) {
        return tahr__is_one_way(step, body);
    }
    look_below(step, 0, &hit);
    return hit.blocking && hit.body == body;
}

static int stands_on_one_way(tahr__step *step)
{
    tahr_floor floor;
    tahr_hit hit;
    if (step->state.mode != TAHR_MODE_WALKING) {
        return refuse(step, NULL, "not on ground");
    }
    if (!floor_is_current(step)) {
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        tahr__keep_floor(step, &floor);
    }
    if (!floor_is_walkable(&step->state.floor) || !may_be_one_way(step, step->state.floor.body)) {
        return refuse(step, NULL, "no one-way floor");
    }
    look_below(step, TAHR_STATE_DROPPING, &hit);
    return hit.blocking ? refuse(step, &hit, "something else holds it too") : 1;
}

/* Not on an edge or a corner, where the contact leans as no face does. */
static int is_face(vec3 normal, vec3 face)
{
    return dot(normal, face) > 1 - 1e-6;
}

void tahr__begin_drop(tahr__step *step)
{
    tahr_state *s = &step->state;
    int held = (s->flags & TAHR_STATE_DROP_HELD) != 0;
    if (!(step->input->flags & TAHR_INPUT_DROP)) {
        s->flags &= ~(uint32_t)TAHR_STATE_DROP_HELD;
        return;
    }
    s->flags |= TAHR_STATE_DROP_HELD;
    if (held || !stands_on_one_way(step) || step->error < 0) {
        return;
    }
    tahr_hit from = {.body = s->floor.body, .feature = s->floor.feature, .normal = s->floor.normal};
    double away = dot(s->velocity, s->floor.normal);
    tahr__leave_floor(step);
    /* Down a slope: along it, else it would fly over it for a while instead of dropping. A slope that no one-way body
     * holds at is only what a backend says, and may even be upright. */
    int holds = tahr_one_way_blocks(&s->up, &s->floor.normal, 0, 0, 0);
    if (away > 0 && holds && is_face(s->floor.normal, s->floor.surface_normal)) {
        s->velocity = add_scaled(s->velocity, s->up, -away / dot(s->floor.normal, s->up));
    }
    s->floor_revision = 0;
    s->flags |= TAHR_STATE_DROPPING;
    s->drop_body = s->floor.body;
    s->drop_feature = s->floor.feature;
    if (step->input->jump) { /* down and jump together drop: the press of the button has done its work */
        s->flags |= TAHR_STATE_JUMP_HELD;
    }
    s->buffer_left = 0;
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, &from, TAHR_LEFT_DROP);
    tahr__decide(step, TAHR_RULE_DROP, 1, &from, 0, 0, "drops through");
    tahr__change_mode(step, TAHR_MODE_FALLING);
}

void tahr__end_drop(tahr__step *step)
{
    step->state.flags &= ~(uint32_t)TAHR_STATE_DROPPING;
    step->state.drop_body = TAHR_NO_BODY;
    step->state.drop_feature = 0;
}

/* Does what was met lie under the floor that it stood on, and that over it? Where a level foot covers a whole valley
 * the place that was met may be any under it: then it is asked what is straight below the floor. */
static int is_next_layer(tahr__step *step, const tahr_hit *met)
{
    const tahr_floor *floor = &step->state.floor;
    double least = 2 * drop_margin(step->config);
    vec3 up = step->state.up, apart = sub(met->point, floor->point);
    double below = -dot(met->normal, apart), level = dot(met->normal, up);
    tahr_hit hit;
    if (below <= least || level <= 0) {
        return 0;
    }
    if (dot(floor->normal, apart) < -least) {
        return 1;
    }
    tahr__ray(step, add_scaled(floor->point, up, -least), scale(up, -below / level), &hit);
    int same_face = dot(met->normal, hit.normal) > 1 - 1e-6 && dot(met->normal, sub(hit.point, met->point)) < least;
    return hit.blocking && same_face;
}

/* m below the plane that it stood on at which no part of its underside (what leans by less than 60 degrees, as the tops
 * of one-way bodies do) is above it any more. On a slope a level underside has its highest point at the rim; of a round
 * one half the cap leans by less than that. */
static double depth_of_underside(const tahr__step *step)
{
    vec3 across = step_level(step, step->state.floor.normal);
    return step->limits->width * length(across) + 0.5 * shape_cap(&step->limits->shape) + 2 * drop_margin(step->config);
}

/* From here on it is this face that it drops from: a layer goes on from face to face. */
static void drop_from(tahr__step *step, const tahr_hit *hit)
{
    tahr_state *s = &step->state;
    if (is_face(hit->normal, hit->surface_normal)) {
        s->floor.point = hit->point;
        s->floor.normal = hit->normal;
        s->drop_body = hit->body;
        s->drop_feature = hit->feature;
    }
}

void tahr__watch_drop(tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    tahr_hit hit;
    if (!is_dropping(step)) {
        return;
    }
    double over = dot(floor->normal, sub(step_foot(step), floor->point)), most = depth_of_underside(step);
    if (over < -most || over > most) {
        tahr__end_drop(step);
        tahr__decide(step, TAHR_RULE_DROP, 0, NULL, over, most, "it is through");
        return;
    }
    look_below(step, 0, &hit);
    if (hit.blocking && is_next_layer(step, &hit)) {
        tahr__end_drop(step);
        tahr__decide(step, TAHR_RULE_DROP, 0, &hit, over, most, "the next layer");
    } else if (hit.blocking) {
        drop_from(step, &hit);
    }
}

int tahr__drops_on(tahr__step *step, const tahr_hit *met)
{
    tahr_hit hit;
    if (!is_dropping(step) || dot(met->normal, step->state.up) <= 0) {
        return 0;
    }
    if (!met->start_overlap && !met->unknown && !is_next_layer(step, met)) {
        look_below(step, TAHR_STATE_DROPPING, &hit);
        if (!hit.blocking) {
            drop_from(step, met);
            return tahr__decide(step, TAHR_RULE_DROP, 1, met, 0, 0, "the same layer");
        }
    }
    tahr__end_drop(step);
    return 0;
}

/* The floor that it stood on, where its body is now. */
void tahr__carry_drop(tahr__step *step, const tahr_pose *from, const tahr_pose *to)
{
    tahr_floor *floor = &step->state.floor;
    vec3 tip = tahr__carried(step->world, from, to, add(floor->point, floor->normal));
    floor->point = tahr__carried(step->world, from, to, floor->point);
    floor->normal = unit(sub(tip, floor->point));
}

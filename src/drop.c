/* SPDX-License-Identifier: MIT
 * drop.c: falling through the one-way body that one stands on.
 *
 * Nothing is remembered but that it drops: while it does, its queries carry the DROP flags, which make a one-way body
 * within two margins vanish. That is the layer stood on, all bodies of it, wherever it moves; the layer below is
 * farther. It ends before the next layer comes as near, because it is looked at before every piece of the fall. */
#include "drop.h"

#include "body_motion.h"
#include "floor.h"
#include "modes.h"
#include "query.h"
#include "report.h"
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
    if (!floor_is_walkable(&step->state.floor) || !tahr__is_one_way(step, step->state.floor.body)) {
        return refuse(step, NULL, "no one-way floor");
    }
    look_below(step, TAHR_STATE_DROPPING, &hit);
    return hit.blocking ? refuse(step, &hit, "something else holds it too") : 1;
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
    tahr__leave_floor(step);
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

void tahr__watch_drop(tahr__step *step)
{
    tahr_hit hit;
    if (!is_dropping(step)) {
        return;
    }
    look_below(step, 0, &hit);
    if (!hit.blocking || !tahr__is_one_way(step, hit.body)) {
        tahr__end_drop(step);
        tahr__decide(step, TAHR_RULE_DROP, 0, &hit, 0, 0, "it is through");
    }
}

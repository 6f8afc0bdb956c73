/* SPDX-License-Identifier: MIT
 * walking.c: one slice of walking: along its path, with the floor kept underfoot or lost at a ledge.
 *
 * While walking the velocity lies across up; its length is the speed along the surface. A step up or down changes the
 * height and no velocity. */
#include "walking.h"

#include <string.h>

#include "base_motion.h"
#include "floor.h"
#include "floor_end.h"
#include "ledge.h"
#include "move.h"
#include "path.h"
#include "report.h"
#include "scope.h"
#include "stance.h"
#include "stepped.h"
#include "walk_two_walls.h"

void tahr__leave_floor(tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    vec3 v = step_level(step, step->state.velocity);
    double size2 = length_squared(v), level = dot(floor->surface_normal, step->state.up);
    int slopes =
        floor_is_walkable(floor) && (floor->flags & TAHR_FLOOR_FACE) && level > 0; /* up may have turned since */
    step->state.velocity = v;
    if (slopes && size2 > 0 && !step->config->keep_level_speed) {
        double rise = dot(floor->surface_normal, v) / level;
        step->state.velocity = scale(v, sqrt(size2 / (size2 + rise * rise)));
    }
    tahr__part_from_base(step);
}

/* Leaves the floor at the place, and the time, where it ended. */
static tahr__next fall_off(tahr__step *step, tahr__path *w, vec3 to, double part)
{
    tahr_floor none;
    memset(&none, 0, sizeof none);
    none.body = TAHR_NO_BODY;
    step->state.position = add_scaled(w->from, sub(to, w->from), part);
    tahr__path_cut(step, w, part);
    double used = tahr__path_used(w);
    step->state.velocity = tahr__law_advance(&w->law, w->velocity, used).velocity;
    step->time += w->began + used;
    step->ahead = 0;
    tahr__leave_floor(step);
    tahr__keep_floor(step, &none);
    step->state.floor_revision = 0;
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_LEDGE);
    tahr__next next = {TAHR_MODE_FALLING, w->duration + w->rest - used};
    return next;
}

double tahr__settle(tahr__step *step)
{
    double height = tahr__adjust_height(step);
    step->report.step_offset += height;
    if (height < -2 * step->config->skin) {
        tahr__event(step, TAHR_EVENT_STEPPED_DOWN, NULL, -height);
        tahr__decide(step, TAHR_RULE_STEP_DOWN, 1, NULL, -height, step->config->snap_distance, "floor followed down");
    }
    return height;
}

static void settle(tahr__step *step)
{
    if (!floor_is_in_band(step)) {
        tahr__settle(step);
    }
}

/* Nothing moves: look at the floor only if something may have changed (takes_cached_floor of floor.c). looked: this
 * slice did so already. */
static tahr__next stand(tahr__step *step, double time, int looked)
{
    tahr__next next = {TAHR_MODE_WALKING, 0};
    tahr_floor floor;
    if (looked) {
        settle(step);
        step->time += time;
        return next;
    }
    int moved = (step->state.flags & TAHR_STATE_FLOOR_MOVED) != 0;
    if (step->config->cached_floor && !moved && floor_is_current(step)) {
        step->report.flags |= TAHR_REPORT_CACHED_FLOOR;
        step->report.saved[TAHR_SHORTCUT_CACHED_FLOOR]++;
        tahr__decide(step, TAHR_RULE_CACHED_FLOOR, 1, NULL, 0, 0, "neither the character nor the world moved");
        step->time += time;
        return next;
    }
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!floor_is_walkable(&floor)) {
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_LEDGE);
        tahr__keep_floor(step, &floor);
        tahr__next fall = {TAHR_MODE_FALLING, time};
        return fall;
    }
    tahr__keep_floor(step, &floor);
    settle(step);
    step->time += time;
    return next;
}

/* Walks on until the floor under the end of the walk is known. Where it seems to end it may only lie lower than one
 * snap reaches from the straight path of a long slice (stairs down at 10 Hz): goes down where it still was, and on from
 * there. Returns FLOOR; NO_FLOOR with the place where it ended as a part of the last piece; or WALK_AGAIN if it may
 * have ended on an earlier piece. */
enum { NO_FLOOR, FLOOR, WALK_AGAIN };

static int walk_over_floor(tahr__step *step, tahr__path *w, double *part)
{
    enum { DROPS = 6 };
    tahr_floor floor;
    for (int drop = 0; drop < DROPS; drop++) {
        tahr__path_walk(step, w);
        if (floor_is_current(step)) {
            return FLOOR;
        }
        tahr__path_look_below(step, w, &floor);
        if (floor_is_walkable(&floor)) {
            tahr__keep_floor(step, &floor);
            return FLOOR;
        }
        if (w->turns > 0 && !w->careful && !vec_equal(w->from, w->start)) { /* else nothing was gone before it */
            return WALK_AGAIN;
        }
        if (!may_walk_off(step)) {
            tahr__stay_on_ledge(step, w, &floor);
            return FLOOR;
        }
        vec3 to = step->state.position;
        tahr__floor_border end;
        tahr__floor_end(step, w, &floor, &end);
        floor = end.floor;
        *part = end.outside;
        if (!floor_is_walkable(&floor) || floor.distance < 0.25 * step->config->snap_distance) {
            step->state.position = to;
            return NO_FLOOR;
        }
        const double left = w->left;
        const vec3 above = step->state.position;
        tahr__keep_floor(step, &floor);
        tahr__path_cut(step, w, end.inside);
        tahr__path_look_ahead(step, w);
        settle(step);
        /* Something beside the way down holds it up: what was found below the rim of the foot is no floor to go on. */
        if (dot(sub(above, step->state.position), step->state.up) < step->config->skin) {
            w->left = left;
            step->state.position = to;
            return NO_FLOOR;
        }
        tahr__path_carry_floor(w, step);
    }
    w->lost = w->duration + w->rest - tahr__path_used(w);
    return FLOOR;
}

tahr__next tahr__walk_slice(tahr__step *step, double time)
{
    tahr__path w;
    tahr_floor floor;
    int looked = !floor_is_current(step);
    int crushed = (step->state.flags & TAHR_STATE_CRUSHED) != 0;
    if (looked || crushed) {
        int changed = step->state.floor_revision != 0 && step->state.floor_revision != step->world->revision;
        if ((changed || crushed) && length_squared(step_level(step, step->input->move)) == 0) {
            tahr__depenetrate(step); /* who moves finds out by moving */
        }
    }
    if (looked) {
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        tahr__keep_floor(step, &floor);
    }
    if (!floor_is_walkable(&step->state.floor)) {
        tahr__next fall = {TAHR_MODE_FALLING, time};
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_LEDGE);
        return fall;
    }
    double part = 1;
    tahr__scope scope;
    w.scope = &scope; /* opened where something is first met: nothing is written before but a velocity and a place */
    w.given = step->state.velocity;
    if (step->trail) {
        tahr__scope_open(step, &scope);
        w.scope = NULL;
    }
    int answer = WALK_AGAIN;
    for (uint32_t careful = 0; answer == WALK_AGAIN; careful = 1) {
        tahr__path_begin(step, &w, time);
        if (length_squared(w.wish) == 0) {
            return stand(step, time, looked);
        }
        tahr__path_find_slope(&w, step);
        w.careful = careful;
        answer = walk_over_floor(step, &w, &part);
        if (answer == WALK_AGAIN) { /* the path was bent on the way: once more, with a look at the floor at every
                                     * bend */
            tahr__scope_revert(step, &scope);
        }
    }
    if (answer == NO_FLOOR) {
        return fall_off(step, &w, step->state.position, part);
    }
    step->report.time_lost += w.lost;
    if (w.stop_time >= 0) {
        step->ahead = w.stop_time;
        tahr__event(step, TAHR_EVENT_STOPPED, NULL, 0);
    }
    step->ahead = time;
    settle(step);
    step->time += time;
    step->ahead = 0;
    tahr__next next = {TAHR_MODE_WALKING, 0};
    return next;
}

tahr__next tahr__walk(tahr__step *step, double time)
{
    if (step->limits->usual) {
        return tahr__walk_slice(step, time);
    }
    if (step->config->slide_solver == TAHR_SLIDE_TWO_WALLS) {
        return tahr__walk_two_walls(step, time);
    }
    return step->config->integrator == TAHR_INTEGRATOR_EXACT ? tahr__walk_slice(step, time)
                                                             : tahr__walk_in_steps(step, time);
}

/* SPDX-License-Identifier: MIT
 * walking.c: one slice of walking: velocity in closed form, then along the floor, up and down steps, along walls.
 *
 * While walking the velocity lies across up; its length is the speed along the surface. A step up or down changes the
 * height and no velocity. */
#include "walking.h"

#include <string.h>

#include "floor.h"
#include "move.h"
#include "query.h"
#include "report.h"
#include "slide.h"
#include "step_up.h"

/* Where a slice is: the piece of it that is under way, and what has been met. A piece is one closed-form motion; a wall
 * ends it and begins the next. */
typedef struct walk {
    tahr__law law;
    vec3 velocity;   /* at the begin of the piece */
    double began;    /* s from the begin of the slice */
    double duration; /* s of the piece, if nothing ends it */
    vec3 wish;       /* level displacement of the whole piece */
    double left;     /* part of it not yet covered */
    double stop_time; /* s from the begin of the slice at which the character stops; < 0: it does not */
    tahr__plane walls[TAHR__MAX_PLANES];
    uint32_t wall_count;
    vec3 ramps[TAHR__MAX_PLANES]; /* normals of the walkable faces that carry */
    uint32_t ramp_count;
    vec3 slope;  /* normal of the ground that sets the speed */
    double ease; /* rise per metre that keeps rounding from pointing into a ramp */
    vec3 from;   /* the last straight piece of the way, to find the place where a floor ended */
    double left_before;
} walk;

/* The velocity asked for, and how it is approached. Along walls what they leave of it is asked for: pushing slantwise into
 * a wall is walking along it at the wish's part along it, at every rate. */
static tahr__law law_of(const tahr__step *step, const tahr__plane *walls, uint32_t wall_count)
{
    const tahr_config *c = step->config;
    vec3 wish = step_level(step, step->input.move);
    double size = length(wish);
    double asked = c->max_speed * min_of(size, 1);
    wish = tahr__slide(walls, wall_count, wish);
    double kept = size > 0 ? length(wish) / size : 0; /* cosine to the wall: of the speed and of the acceleration */
    size *= kept;
    tahr__law law = {.speed = asked * kept,
                     .acceleration = c->acceleration * kept,
                     .turn_friction = c->turn_friction,
                     .braking = c->braking_deceleration,
                     .drag = c->braking_drag};
    if (size > 0) {
        law.wish = scale(wish, 1.0 / size);
    }
    return law;
}

/* Ramps are not merged as walls are: two faces that differ by a hair both carry, and the steeper one decides. */
static void carry(walk *w, vec3 normal)
{
    w->ramps[w->ramp_count++] = normal;
}

static void carry_floor(walk *w, const tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    w->ramp_count = 0;
    if (floor_is_walkable(floor) && (floor->flags & TAHR_FLOOR_FACE)) {
        carry(w, floor->surface_normal);
    }
}

/* Begins a piece with the velocity that the walls leave. */
static void begin_piece(tahr__step *step, walk *w, vec3 velocity, double duration)
{
    w->law = law_of(step, w->walls, w->wall_count);
    w->velocity = tahr__slide(w->walls, w->wall_count, velocity);
    w->duration = duration;
    tahr__motion m = tahr__law_advance(&w->law, w->velocity, duration);
    w->wish = m.displacement;
    w->left = w->left_before = 1;
    w->stop_time = m.stop_time >= 0 ? w->began + m.stop_time : -1;
    w->from = step->state.position;
    step->state.velocity = m.velocity;
}

/* The plane arrays are left as they are: only what is counted is read. */
static void begin_walk(tahr__step *step, walk *w, double duration)
{
    w->began = 0;
    w->wall_count = 0;
    w->ease = 0;
    carry_floor(w, step);
    w->slope = w->ramp_count ? w->ramps[0] : step->state.up;
    begin_piece(step, w, step_level(step, step->state.velocity), duration);
}

/* s of the piece at which a part of its displacement is covered, measured along the whole of it. The speed changes on the
 * way, so the part of the time is not the part of the way: Newton, held within the piece, from the root for a constant
 * acceleration (from rest the rate at a small part is nearly 0, and any other guess halves its way down): 6 rounds reach
 * rounding. */
static double time_of_part(const walk *w, double part)
{
    const double touched = 1e-5; /* m: a thousandth of the skin, above the sweep error of every exact backend */
    double low = 0, high = w->duration, size2 = length_squared(w->wish);
    if (part <= 0 || part >= 1 || size2 == 0) {
        return part <= 0 ? 0 : high;
    }
    double rate0 = dot(w->velocity, w->wish) / size2;
    if (rate0 < 0 && part * part * size2 <= touched * touched) {
        return 0; /* turns round first, and passes here again later: what is met at once was touched at the begin */
    }
    double gain = (1 - rate0 * high) / (high * high);
    double root = sqrt(max_of(rate0 * rate0 + 4 * gain * part, 0));
    double t = rate0 >= 0 ? 2 * part / (rate0 + root) : (root - rate0) / (2 * gain);
    t = t >= 0 && t <= high ? t : part * high;
    for (int i = 0; i < 6; i++) {
        tahr__motion m = tahr__law_advance(&w->law, w->velocity, t);
        double excess = dot(m.displacement, w->wish) / size2 - part;
        double rate = dot(m.velocity, w->wish) / size2;
        *(excess > 0 ? &high : &low) = t;
        double next = rate > 0 ? t - excess / rate : 0.5 * (low + high);
        next = next >= low && next <= high ? next : 0.5 * (low + high);
        if (next == t) {
            break;
        }
        t = next;
    }
    return t;
}

/* s of the piece that are used up where the walk is now. */
static double used_time(const walk *w)
{
    return time_of_part(w, 1 - w->left);
}

/* A wall was added to the set: the rest of the slice is a piece of its own. */
static void bend(tahr__step *step, walk *w)
{
    double used = used_time(w);
    tahr__motion m = tahr__law_advance(&w->law, w->velocity, used);
    w->began += used;
    begin_piece(step, w, m.velocity, w->duration - used);
}

/* The bevelled edge of a step is no slope to slow down on. On a slope the contact lies up to 0.25 m off the axis: if the
 * ground half-way between them is not in the plane of the contact, the face is smaller than that. Below 15 degrees a bevel
 * costs 3 % of its own width and is not looked at. One ray. */
static void find_slope(walk *w, tahr__step *step)
{
    const double steep = 0.966;
    const tahr_floor *floor = &step->state.floor;
    vec3 up = step->state.up;
    tahr_hit hit;
    if (dot(w->slope, up) > steep) {
        return;
    }
    vec3 half_way = add_scaled(step->state.position, step_level(step, sub(floor->point, step->state.position)), 0.5);
    tahr__ray(step, half_way, scale(up, -(step->config->shape.half_height + step->config->snap_distance)), &hit);
    double off = dot(w->slope, sub(hit.point, floor->point));
    int same = hit.blocking && dot(w->slope, hit.surface_normal) > 0.99 && off < step->config->skin && off > -step->config->skin;
    if (!same) {
        w->slope = up;
    }
}

/* Lifts a level displacement onto all faces that carry, with its length along the slope that sets the speed. */
static vec3 along_floor(const walk *w, const tahr__step *step, vec3 level)
{
    double rise = -INFINITY;
    if (w->ramp_count == 0) {
        return level;
    }
    for (uint32_t i = 0; i < w->ramp_count; i++) {
        double r = -dot(w->ramps[i], level) / dot(w->ramps[i], step->state.up);
        rise = max_of(rise, r);
    }
    double climb = dot(w->slope, level) / dot(w->slope, step->state.up);
    if (rise == 0 && w->ease == 0 && climb == 0) {
        return level;
    }
    double size = length(level);
    vec3 lifted = add_scaled(level, step->state.up, rise + w->ease * size);
    if (rise * rise > 1.5 * size * size) { /* steeper than 51 degrees is only walkable by an override, and never a bevel */
        climb = rise;
    }
    return scale(lifted, size / sqrt(size * size + climb * climb));
}

/* A walkable face in the way: go on along it. Its contact normal must be walkable too; the lip of a step is not a ramp. */
static int take_ramp(tahr__step *step, walk *w, const tahr_hit *hit)
{
    double up = dot(hit->normal, step->state.up), limit = tahr__walkable_limit(step, hit, 0);
    if (up < limit || !tahr__is_walkable(step, hit, 0)) {
        return tahr__decide(step, TAHR_RULE_RAMP, 0, hit, up, limit, "too steep to go on along");
    }
    for (uint32_t i = 0; i < w->ramp_count; i++) {
        if (dot(w->ramps[i], hit->normal) > 1 - 1e-14) { /* rounding touched it again: keep off a little more each time */
            w->ease = w->ease > 0 ? 10 * w->ease : 1e-9;
            return tahr__decide(step, TAHR_RULE_RAMP, 1, hit, up, w->ease, "going along it already");
        }
    }
    if (w->ramp_count < TAHR__MAX_PLANES) {
        carry(w, hit->normal);
    }
    return tahr__decide(step, TAHR_RULE_RAMP, 1, hit, up, limit, "a walkable face");
}

/* A step is taken half a foot at a time, so that a long slice climbs one tread after the other. */
static int take_step(tahr__step *step, walk *w, vec3 level, const tahr_hit *hit)
{
    double stride = min_of(1, 0.5 * step->limits->width / length(level));
    double covered = tahr__step_up(step, scale(level, stride), hit);
    if (covered <= 0) {
        return 0;
    }
    w->left *= 1 - covered * stride;
    w->wall_count = 0; /* what stood beside the foot below need not stand here */
    carry_floor(w, step);
    w->from = step->state.position;
    w->left_before = w->left;
    return 1;
}

static int take_wall(tahr__step *step, walk *w, const tahr_hit *hit)
{
    tahr__plane wall = tahr__plane_of(step, hit);
    vec3 floor_normal = w->ramp_count ? w->ramps[0] : step->state.up;
    double used = used_time(w);
    vec3 velocity = tahr__law_advance(&w->law, w->velocity, used).velocity;
    tahr__event(step, TAHR_EVENT_HIT, w->began + used, hit, max_of(-dot(velocity, hit->normal), 0));
    step->report.slides++;
    if (!tahr__level_wall(step, floor_normal, &wall)) {
        return tahr__decide(step, TAHR_RULE_SLIDE, 0, hit, 0, 0, "squeezed between floor and ceiling");
    }
    tahr__planes_add(w->walls, &w->wall_count, &wall);
    bend(step, w);
    return tahr__decide(step, TAHR_RULE_SLIDE, 1, hit, dot(wall.normal, step->state.up), 0, "slides along");
}

/* Walks the wish, bending it as things are met. */
static void walk_along(tahr__step *step, walk *w)
{
    tahr_hit hit;
    for (uint32_t i = 0; i < step->config->max_slides && w->left > 0 && step->error >= 0; i++) {
        vec3 level = tahr__slide(w->walls, w->wall_count, scale(w->wish, w->left));
        if (length_squared(level) == 0) {
            return;
        }
        vec3 motion = along_floor(w, step, level);
        w->from = step->state.position;
        w->left_before = w->left;
        tahr__move(step, motion, &hit);
        w->left *= hit.blocking ? 1 - hit.fraction : 0;
        if (!hit.blocking || hit.unknown || hit.start_overlap) {
            return;
        }
        tahr__planes_forget(step, w->walls, &w->wall_count);
        if (take_ramp(step, w, &hit)) {
            continue;
        }
        level = tahr__slide(w->walls, w->wall_count, scale(w->wish, w->left));
        if (length_squared(level) > 0 && take_step(step, w, level, &hit)) {
            continue;
        }
        if (!take_wall(step, w, &hit)) {
            step->state.velocity = vec(0, 0, 0);
            return;
        }
    }
}

/* The floor ended somewhere on the last straight piece: halves it until the place is known to a millionth of it.
 * [out] the parts of the piece at which the character still stands and already falls. */
static void where_floor_ended(tahr__step *step, const walk *w, vec3 to, double *inside, double *outside)
{
    enum { ROUNDS = 20 };
    tahr_floor floor;
    *inside = 0;
    *outside = 1;
    for (int i = 0; i < ROUNDS && step->error >= 0; i++) {
        double middle = 0.5 * (*inside + *outside);
        step->state.position = add_scaled(w->from, sub(to, w->from), middle);
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        *(floor_is_walkable(&floor) ? inside : outside) = middle;
    }
}

/* Stops at the last place with a floor and goes on along the edge. Returns 1 if there is such a place. */
static int hold_at_ledge(tahr__step *step, walk *w)
{
    vec3 to = step->state.position;
    tahr_floor floor;
    double part, outside;
    where_floor_ended(step, w, to, &part, &outside);
    step->state.position = add_scaled(w->from, sub(to, w->from), part);
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!floor_is_walkable(&floor)) {
        return tahr__decide(step, TAHR_RULE_LEDGE, 0, NULL, part, 0, "no floor on the way here");
    }
    w->left = w->left_before - (w->left_before - w->left) * part;
    /* The contact with the edge leans outward: its level part is the wall that keeps the character in. */
    tahr__plane edge = {.normal = unit(scale(step_level(step, floor.normal), -1)),
                        .anchor = step->state.position,
                        .body = floor.body,
                        .feature = floor.feature};
    if (length_squared(edge.normal) == 0) {
        edge.normal = unit(scale(step_level(step, w->wish), -1));
    }
    /* A thousandth of a skin inward, so that going on along the edge does not lose the floor to rounding. */
    tahr_hit hit;
    tahr__move(step, scale(edge.normal, 1e-3 * step->config->skin), &hit);
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    tahr__keep_floor(step, &floor);
    tahr__planes_add(w->walls, &w->wall_count, &edge);
    bend(step, w);
    return tahr__decide(step, TAHR_RULE_LEDGE, 1, NULL, part, 1, "held at the ledge");
}

/* Not allowed off ledges: at most two edges in a slice (a corner of a plateau), then stands. */
static void stay_on_ledge(tahr__step *step, walk *w)
{
    tahr_floor floor;
    for (int corner = 0; corner < 2; corner++) {
        if (!hold_at_ledge(step, w)) {
            step->state.position = w->from;
            break;
        }
        vec3 held = step->state.position;
        tahr_floor held_floor = step->state.floor;
        carry_floor(w, step);
        walk_along(step, w);
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        if (floor_is_walkable(&floor)) {
            tahr__keep_floor(step, &floor);
            return;
        }
        if (corner == 1) {
            step->state.position = held;
            tahr__keep_floor(step, &held_floor);
        }
    }
    step->state.velocity = vec(0, 0, 0);
}

void tahr__leave_floor(tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    vec3 v = step_level(step, step->state.velocity);
    double size2 = length_squared(v);
    step->state.velocity = v;
    if (floor_is_walkable(floor) && (floor->flags & TAHR_FLOOR_FACE) && size2 > 0) {
        double rise = dot(floor->surface_normal, v) / dot(floor->surface_normal, step->state.up);
        step->state.velocity = scale(v, sqrt(size2 / (size2 + rise * rise)));
    }
}

/* Leaves the floor at the place, and the time, where it ended. */
static tahr__next fall_off(tahr__step *step, walk *w, vec3 to, double part)
{
    tahr_floor none;
    memset(&none, 0, sizeof none);
    none.body = TAHR_NO_BODY;
    step->state.position = add_scaled(w->from, sub(to, w->from), part);
    w->left = w->left_before - (w->left_before - w->left) * part;
    double used = used_time(w);
    step->state.velocity = tahr__law_advance(&w->law, w->velocity, used).velocity;
    tahr__leave_floor(step);
    tahr__keep_floor(step, &none);
    step->state.floor_revision = 0;
    step->time += w->began + used;
    tahr__event(step, TAHR_EVENT_LEFT_GROUND, 0, NULL, 0);
    tahr__next next = {TAHR_MODE_FALLING, w->duration - used};
    return next;
}

/* Follows the floor down, or rises off it, and says so when it was a step. */
static void settle(tahr__step *step)
{
    double height = tahr__adjust_height(step);
    step->report.step_offset += height;
    if (height < -2 * step->config->skin) {
        tahr__event(step, TAHR_EVENT_STEPPED_DOWN, 0, NULL, -height);
        tahr__decide(step, TAHR_RULE_STEP_DOWN, 1, NULL, -height, step->config->snap_distance, "floor followed down");
    }
}

/* Nothing moves: look at the floor only if something may have changed. looked: this slice did so already. */
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
    if (step->config->cached_floor && !moved && tahr__floor_is_current(step)) {
        step->report.flags |= TAHR_REPORT_CACHED_FLOOR;
        tahr__decide(step, TAHR_RULE_CACHED_FLOOR, 1, NULL, 0, 0, "neither the character nor the world moved");
        step->time += time;
        return next;
    }
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!floor_is_walkable(&floor)) {
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, 0, NULL, 0);
        tahr__keep_floor(step, &floor);
        tahr__next fall = {TAHR_MODE_FALLING, time};
        return fall;
    }
    tahr__keep_floor(step, &floor);
    settle(step);
    step->time += time;
    return next;
}

/* Walks on until the floor under the end of the walk is known. Where it seems to end it may only lie lower than one snap
 * reaches from the straight path of a long slice (stairs down at 10 Hz): goes down where it still was, and on from there.
 * Returns 1 with a floor, or 0 with the place where it ended as a part of the last piece. */
static int walk_over_floor(tahr__step *step, walk *w, double *part)
{
    enum { DROPS = 6 };
    tahr_floor floor;
    for (int drop = 0; drop < DROPS; drop++) {
        walk_along(step, w);
        if (tahr__floor_is_current(step)) {
            return 1;
        }
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        if (floor_is_walkable(&floor)) {
            tahr__keep_floor(step, &floor);
            return 1;
        }
        if (!step->config->walk_off_ledges) {
            stay_on_ledge(step, w);
            return 1;
        }
        vec3 to = step->state.position;
        double inside;
        where_floor_ended(step, w, to, &inside, part);
        step->state.position = add_scaled(w->from, sub(to, w->from), inside);
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        if (!floor_is_walkable(&floor) || floor.distance < 0.25 * step->config->snap_distance) {
            step->state.position = to;
            return 0;
        }
        tahr__keep_floor(step, &floor);
        settle(step);
        w->left = w->left_before - (w->left_before - w->left) * inside;
        carry_floor(w, step);
    }
    return 1;
}

tahr__next tahr__walk(tahr__step *step, double time)
{
    walk w;
    tahr_floor floor;
    int looked = !tahr__floor_is_current(step);
    if (looked) {
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        tahr__keep_floor(step, &floor);
    }
    if (!floor_is_walkable(&step->state.floor)) {
        tahr__next fall = {TAHR_MODE_FALLING, time};
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, 0, NULL, 0);
        return fall;
    }
    double part = 1;
    begin_walk(step, &w, time);
    if (length_squared(w.wish) == 0) {
        return stand(step, time, looked);
    }
    find_slope(&w, step);
    if (!walk_over_floor(step, &w, &part)) {
        return fall_off(step, &w, step->state.position, part);
    }
    settle(step);
    if (w.stop_time >= 0) {
        tahr__event(step, TAHR_EVENT_STOPPED, w.stop_time, NULL, 0);
    }
    step->time += time;
    tahr__next next = {TAHR_MODE_WALKING, 0};
    return next;
}

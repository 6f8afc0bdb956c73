/* SPDX-License-Identifier: MIT
 * falling.c: one slice of falling: arcs in closed form, swept as chords, with the time of every contact solved on the
 * arc. */
#include "falling.h"

#include "arc.h"
#include "base_motion.h"
#include "corner.h"
#include "drop.h"
#include "fall_two_walls.h"
#include "floor.h"
#include "hanging.h"
#include "jump.h"
#include "launch.h"
#include "move.h"
#include "overlap.h"
#include "query.h"
#include "report.h"
#include "slide.h"
#include "stepped.h"
#include "swimming.h"
#include "wall.h"

typedef struct fall {
    double left; /* s */
    tahr__plane planes[TAHR__MAX_PLANES];
    uint32_t plane_count;
    uint32_t look; /* 1: the edge of the wall that is touched has not been looked for */
    uint32_t has_edge;
    uint32_t apexes; /* met while it slid along something */
    tahr_hit edge;   /* the top of a wall that is pushed against */
} fall;

/* s until the arc is highest; 0 if it is past that. A rise of less than a nanosecond is the rounding of an apex that
 * was met already. */
static double apex_time(const tahr__arc *a)
{
    return a->rise > 1e-9 * a->gravity && a->gravity > 0 ? a->hold + a->rise / a->gravity : 0;
}

/* A chord off the arc by at most arc_tolerance: |a| t^2 / 8. */
static double chord_time(const tahr__step *step, const tahr__arc *a)
{
    return a->gravity > 0 ? sqrt(8 * step->config->arc_tolerance / a->gravity) : step->config->max_dt;
}

/* Puts the character where its arc, not the chord, meets the plane of the hit. Returns the time of it; [out] the
 * velocity then. */
static double meet_on_arc(tahr__step *step, const tahr__arc *a, vec3 chord, double duration, tahr_hit *hit,
                          vec3 *velocity)
{
    vec3 start = step->state.position;
    if (hit->fraction * length(chord) < 1e-9) { /* touched from the start */
        step->state.position = add_scaled(start, chord, hit->fraction);
        tahr__arc_at(a, duration * hit->fraction, velocity);
        return duration * hit->fraction;
    }
    const tahr__arc_point met = tahr__arc_meet(a, hit->normal, scale(chord, hit->fraction), duration);
    const double t = met.t;
    const vec3 to = met.way;
    tahr_hit check;
    *velocity = met.velocity;
    tahr__sweep(step, &step->limits->shape, start, to, step->config->skin, 0, &check);
    if (check.start_overlap || check.unknown) {
        tahr__arc_at(a, 0, velocity);
        return 0;
    }
    if (check.blocking && (1 - check.fraction) * length(to) > 1e-9) { /* something else comes first */
        *hit = check;
        step->state.position = add_scaled(start, to, check.fraction);
        tahr__arc_at(a, t * check.fraction, velocity);
        return t * check.fraction;
    }
    step->state.position = add(start, to);
    return t;
}

/* A floor that can be landed on: met from above, walkable, with the whole support that standing needs. */
static int lands(tahr__step *step, const tahr_hit *hit, tahr_floor *floor)
{
    double up = dot(hit->normal, step->state.up);
    vec3 v = whole_velocity(step);
    /* A slide along the face leaves a speed of rounding against it, of either sign. */
    int leaves = dot(v, hit->normal) > 1e-9 * length(v);
    if (up < 1e-3 || leaves || step->error < 0) { /* 1e-3: a wall */
        return tahr__decide(step, TAHR_RULE_LANDING, 0, hit, up, 1e-3, "not met from above");
    }
    if (step->report.slices + 1 >= TAHR__MAX_SLICES) {
        return tahr__decide(step, TAHR_RULE_LANDING, 0, hit, step->report.slices, TAHR__MAX_SLICES,
                            "lost the floor too often in this step: slides");
    }
    tahr__supplied met = {.hit = hit};
    tahr__find_floor(step, step->config->snap_distance, &met, floor);
    /* Which of the faces of an edge a motion meets is the motion's affair, what stands on it is not: a wish along the
     * top would hold it up in the air for good. */
    if (!floor_is_walkable(floor) && !(floor->flags & TAHR_FLOOR_FACE) &&
        dot(hit->normal, hit->surface_normal) < 1 - 1e-6) {
        tahr__find_floor(step, step->config->snap_distance, NULL, floor);
    }
    int near = floor->distance <= step->config->floor_max * step->config->skin;
    return tahr__decide(step, TAHR_RULE_LANDING, floor_is_walkable(floor) && near, hit, floor->distance,
                        step->config->floor_max * step->config->skin, "floor where it fell");
}

static tahr__next land(tahr__step *step, const tahr_hit *hit, const tahr_floor *floor, double left)
{
    tahr__land_on(step, floor->body);
    double speed = -dot(whole_velocity(step), step->state.up);
    tahr__event(step, TAHR_EVENT_LANDED, hit, max_of(speed, 0));
    step->state.velocity = step_level(step, step->state.velocity);
    step->state.flags &= ~(uint32_t)TAHR_STATE_JUMPING;
    step->state.jump_hold = 0;
    tahr__keep_floor(step, floor);
    /* The hit that told the floor ended a hair from where a look from here would: standing looks again. */
    step->state.flags |= TAHR_STATE_FLOOR_MOVED;
    tahr__next next = {TAHR_MODE_WALKING, left};
    return next;
}

/* Projected onto a steep face a level motion would rise by itself: no faster up than asked. */
static vec3 slide_in_air(const tahr__step *step, const fall *f, vec3 motion)
{
    vec3 up = step->state.up;
    vec3 bent = tahr__slide(f->planes, f->plane_count, motion);
    if (f->plane_count == 0 || dot(bent, up) <= max_of(dot(motion, up), 0)) {
        return bent;
    }
    tahr__plane walls[TAHR__MAX_PLANES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->plane_count && count + 1 < TAHR__MAX_PLANES; i++) {
        vec3 level = reject(f->planes[i].normal, up);
        walls[count++] = f->planes[i];
        if (dot(f->planes[i].normal, up) > 0 && length_squared(level) > 1e-12) {
            walls[count] = f->planes[i];
            walls[count++].normal = unit(level);
        }
    }
    return tahr__slide(walls, count, motion);
}

/* s of the chord until the head is level with the edge that is fallen past; the whole chord if it does not come to
 * that. Bisection: the arc is bent along walls, and 50 halvings of a chord are below rounding. */
static double time_to_edge(const tahr__step *step, const fall *f, const tahr__arc *a, double duration, vec3 *chord)
{
    vec3 up = step->state.up, v;
    double depth = tahr__edge_depth(step, &f->edge), low = 0, high = duration;
    if (-dot(*chord, up) < depth) {
        return duration;
    }
    for (int i = 0; i < 50; i++) {
        double middle = 0.5 * (low + high);
        *chord = slide_in_air(step, f, tahr__arc_at(a, middle, &v));
        *(-dot(*chord, up) < depth ? &low : &high) = middle;
    }
    *chord = slide_in_air(step, f, tahr__arc_at(a, high, &v));
    return high;
}

/* The wall that was touched at the begin of a chord is left where its end is no longer at one: to a tenth of a
 * microsecond. */
static void watch_wall(tahr__step *step, const fall *f, const tahr__arc *a, vec3 start, double used)
{
    double low = 0, high = used;
    if (tahr__is_at_wall(step, step->state.position)) {
        return;
    }
    while (step->config->wall_coyote_time > 0 && high - low > 1e-7) {
        double middle = 0.5 * (low + high);
        vec3 v, at = add(start, slide_in_air(step, f, tahr__arc_at(a, middle, &v)));
        *(tahr__is_at_wall(step, at) ? &low : &high) = middle;
    }
    tahr__leave_wall(step, step->time + high);
}

static void use_time(tahr__step *step, fall *f, double t)
{
    step->time += t;
    f->left -= t;
    step->state.jump_hold = max_of(step->state.jump_hold - t, 0);
    if (f->left < 1e-12) {
        f->left = 0;
    }
}

/* s of the chord until a fluid carries. */
static double until_fluid(tahr__step *step, const tahr__arc *a, double duration)
{
    const tahr__way way = {a, tahr__arc_place};
    vec3 v, to = tahr__arc_at(a, duration, &v);
    if (a->rise > 0) { /* not before its apex, where a chord ends */
        return duration;
    }
    double line = tahr__swim_line(step->config), m = tahr__fluid(step, add(step->state.position, to)).immersion;
    return m < line ? duration : tahr__passing_time(step, &way, duration, m, line, 1);
}

/* A slide may turn what falls upward again, and the next apex be a nanosecond away: so many are met, then a slice goes
 * on over them. */
enum { MOST_APEXES = 16 };

/* One chord. Returns 1 if something was hit. */
static int fall_chord(tahr__step *step, fall *f, tahr_hit *hit)
{
    tahr__arc a = tahr__arc_of(step, f->planes, f->plane_count);
    if (step->limits->feel) {
        a.gravity *= tahr__gravity_factor(step, a.rise);
        a.terminal = fastest_fall(step);
    }
    double apex = apex_time(&a);
    double duration = min_of(f->left, chord_time(step, &a));
    int reaches_apex = apex > 0 && apex <= duration && f->apexes < MOST_APEXES;
    vec3 v;
    if (reaches_apex) {
        duration = apex;
    } else if (f->left > duration) { /* equal chords rather than a short last one */
        duration = f->left / (double)(int)(f->left / duration + 1);
    }
    if (step_has_fluids(step)) {
        double dry = until_fluid(step, &a, duration);
        reaches_apex = reaches_apex && dry == duration;
        duration = dry;
    }
    vec3 chord = slide_in_air(step, f, tahr__arc_at(&a, duration, &v));
    if (f->has_edge && a.rise <= 0) {
        duration = time_to_edge(step, f, &a, duration, &chord);
        tahr__arc_at(&a, duration, &v);
    }
    vec3 start = step->state.position, began = step->state.velocity;
    double used = duration;
    int pushed = tahr__move(step, chord, hit);
    int met = is_met(hit);
    if (met && f->plane_count == 0 && !pushed) {
        step->state.position = start;
        used = meet_on_arc(step, &a, chord, duration, hit, &v);
    } else if (hit->blocking && !hit->start_overlap) {
        used = duration * hit->fraction;
        tahr__arc_at(&a, used, &v);
    }
    if (met && tahr__drops_on(step, hit)) {
        met = 0;
        hit->blocking = 0;
    }
    step->state.velocity = slide_in_air(step, f, v);
    tahr__time_fall(step, began, used, f->plane_count > 0 || pushed);
    if (step->state.flags & TAHR_STATE_WALL_TOUCHED && !(met && tahr__is_wall(step, hit->normal))) {
        watch_wall(step, f, &a, start, used);
    }
    use_time(step, f, used);
    if (reaches_apex && used == duration) {
        if (f->plane_count == 0) { /* exactly zero, so that the apex is met once */
            step->state.velocity = add_scaled(step->state.velocity, a.axis, -dot(step->state.velocity, a.axis));
        }
        f->apexes += f->plane_count > 0;
        tahr__event(step, TAHR_EVENT_APEX, NULL, 0);
        step->state.flags &= ~(uint32_t)TAHR_STATE_JUMPING;
    }
    return met;
}

/* Looks for the edge of a wall that is pushed against, once it falls, and hangs on it where the head is level with
 * it or it is within reach above. Returns 1 if it hangs. */
static int hangs(tahr__step *step, fall *f)
{
    const tahr_config *c = step->config;
    double fall_speed = -dot(step->state.velocity, step->state.up);
    vec3 facing = step->state.wall_normal;
    tahr__forget_edge(step);
    if (fall_speed < -1e-9 * step->pull->size || !pushes_wall(step)) {
        f->look = 1;
        f->has_edge = 0;
        return 0;
    }
    if (f->look) {
        double most = min_of(fall_speed + step->pull->size * max_of(c->fall_gravity, 1) * f->left, c->terminal_speed);
        f->look = 0;
        f->has_edge = (uint32_t)tahr__find_edge(step, facing, most * f->left + c->skin, &f->edge);
    }
    double depth = f->has_edge ? tahr__edge_depth(step, &f->edge) : 1;
    if (depth > 1e-9) {
        return 0;
    }
    f->has_edge = 0;
    return depth >= -c->ledge_grab && tahr__grab_edge(step, facing, &f->edge);
}

/* The head is past the corner but for its rounding, which would meet it again and again without rising: what is beside
 * it is a wall already. */
static void keep_beside(tahr__step *step, fall *f, const tahr_hit *hit, vec3 aside)
{
    if (tahr__returns_to_corner(step, aside)) {
        tahr__plane wall = tahr__plane_of(step, hit);
        wall.normal = aside;
        wall.offset = 0;
        tahr__planes_add(f->planes, &f->plane_count, &wall);
        step->state.velocity = slide_in_air(step, f, step->state.velocity);
    }
}

/* Held by steep faces on all sides: that is a floor too. */
static int lands_in_wedge(tahr__step *step, tahr_floor *floor)
{
    tahr__find_floor(step, 0, NULL, floor);
    return floor_is_walkable(floor);
}

static tahr__next fall_slice(tahr__step *step, double time)
{
    fall f; /* of its planes only what is counted is read */
    tahr_floor floor;
    tahr_hit hit;
    vec3 start = step->state.position, aside;
    uint32_t hits = 0;
    f.left = time;
    f.plane_count = 0;
    f.look = 1;
    f.has_edge = 0;
    f.apexes = 0;
    while (f.left > 0 && hits < step->config->max_slides && step->error >= 0 &&
           !(step->report.flags & TAHR_REPORT_QUERY_CAP)) {
        tahr__planes_forget(step, f.planes, &f.plane_count);
        tahr__watch_drop(step);
        if (step_has_fluids(step) && tahr__is_carried(step, step->state.position, step->state.velocity)) {
            tahr__next swim = {TAHR_MODE_SWIMMING, f.left};
            tahr__begin_swimming(step);
            return swim;
        }
        if (step->limits->feel & TAHR__FEEL_EDGES && hangs(step, &f)) {
            return (tahr__next){TAHR_MODE_HANGING, f.left};
        }
        if (!fall_chord(step, &f, &hit)) {
            if (hit.blocking) {
                break; /* unknown or crushed: the rest of the time is lost */
            }
            continue;
        }
        if (lands(step, &hit, &floor)) {
            return land(step, &hit, &floor, f.left);
        }
        if (step->limits->feel & TAHR__FEEL_CORNERS && tahr__clear_corner(step, &hit, &aside)) {
            keep_beside(step, &f, &hit, aside);
            hits++;
            continue;
        }
        tahr__plane plane = tahr__plane_of(step, &hit);
        double speed = max_of(-dot(whole_velocity(step), hit.normal), 0);
        tahr__event(step, TAHR_EVENT_HIT, &hit, speed);
        tahr__planes_add(f.planes, &f.plane_count, &plane);
        step->state.velocity = slide_in_air(step, &f, step->state.velocity);
        step->report.slides++;
        hits++;
        if (step->limits->feel & TAHR__FEEL_WALLS && tahr__meet_wall(step, &hit)) {
            f.look = 1;
        }
    }
    step->time += f.left;
    step->report.time_lost += f.left;
    if (f.plane_count > 1 && length_squared(sub(step->state.position, start)) < 1e-12 && lands_in_wedge(step, &floor)) {
        return land(step, &hit, &floor, 0);
    }
    tahr__next next = {TAHR_MODE_FALLING, 0};
    return next;
}

/* Slices that each keep one velocity across up; the rise and the fall are closed forms all the same. */
static tahr__next fall_in_steps(tahr__step *step, double time)
{
    tahr__next next = {TAHR_MODE_FALLING, time};
    while (next.mode == TAHR_MODE_FALLING && next.time_left >= TAHR__LEAST_TIME && step->error >= 0) {
        double h = tahr__begin_iteration(step, next.time_left);
        if (h == 0) {
            return (tahr__next){TAHR_MODE_FALLING, 0};
        }
        double left = next.time_left - h;
        vec3 level = step_level(step, step->state.velocity);
        tahr__law law = tahr__falling_law(step);
        vec3 gained = sub(tahr__calc_velocity(step->config, &law, 0, level, h), level);
        step->state.velocity = add(step->state.velocity, gained);
        next = fall_slice(step, h);
        next.time_left += left;
    }
    next.time_left = next.time_left < TAHR__LEAST_TIME ? 0 : next.time_left;
    return next;
}

tahr__next tahr__fall(tahr__step *step, double time)
{
    if (step->config->slide_solver == TAHR_SLIDE_TWO_WALLS) {
        return tahr__fall_two_walls(step, time);
    }
    return step->config->integrator == TAHR_INTEGRATOR_EXACT ? fall_slice(step, time) : fall_in_steps(step, time);
}

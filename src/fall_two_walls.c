/* SPDX-License-Identifier: MIT
 * fall_two_walls.c: falling in slices: a velocity, one motion, at a wall one slide and at a second wall one more. For
 * config.slide_solver JOINT see falling.c. */
#include "fall_two_walls.h"

#include "corner.h"
#include "drop.h"
#include "hanging.h"
#include "jump.h"
#include "landing.h"
#include "launch.h"
#include "overlap.h"
#include "report.h"
#include "slide.h"
#include "stepped.h"
#include "swimming.h"
#include "wall.h"

/* Slices shorter than this have no velocity of their own, and no apex. */
static const double SHORT_SLICE = 1e-4;

/* Air control is not limited by what rises less: along a wall it may push (VERTICAL_SLOPE_NORMAL_Z). */
static const double UPRIGHT = 0.001;

/* MaxJumpApexAttemptsPerSimulation */
enum { MOST_APEXES = 2 };

typedef struct fall {
    double left, h; /* s after this slice, and of it */
    double rest;    /* s of it after what was met last */
    vec3 from;      /* where it began, and with which velocity */
    vec3 before;
    vec3 motion;
    vec3 free;       /* velocity at its end without air control */
    vec3 control;    /* m/s2: the rest of it */
    int controls;    /* somebody steers */
    int floats;      /* a drive says how fast it falls */
    double apex;     /* s into the slice at which the rise ends; < 0: not in it */
    tahr__pull pull; /* that acts in it, and the fastest fall */
    double terminal;
    tahr__swept swept;
} fall;

enum { GOES_ON, ENDS, LANDS, HANGS };

static double rise_of(const tahr__step *step, vec3 v)
{
    return dot(v, step->state.up);
}

static double held_time(const tahr__step *step)
{
    const tahr_state *s = &step->state;
    int holds = (s->flags & TAHR_STATE_JUMPING) && step->input->jump && !step->config->jump_hold_gravity;
    return holds ? s->jump_hold : 0;
}

/* The velocity after h seconds of the slice; [out] motion. */
static vec3 advance(const tahr__step *step, const fall *f, const tahr__law *law, double h, vec3 *motion)
{
    const tahr_config *c = step->config;
    double rise = rise_of(step, f->before), hold = held_time(step), v = rise;
    vec3 level = add_scaled(f->before, step->state.up, -rise);
    if (c->integrator == TAHR_INTEGRATOR_EXACT) {
        tahr__motion m = tahr__law_advance(law, level, h);
        double height = f->floats ? rise * h : tahr__fall_advance(rise, f->pull.size, f->terminal, hold, h, &v);
        *motion = add_scaled(m.displacement, step->state.up, height);
        return add_scaled(m.velocity, step->state.up, v);
    }
    vec3 after = add_scaled(tahr__calc_velocity(c, law, 0, level, h), step->state.up, rise);
    if (!f->floats) {
        after = tahr__new_fall_velocity(&f->pull, f->terminal, after, h - min_of(hold, h));
    }
    *motion = scale(add(f->before, after), 0.5 * h);
    return after;
}

/* s into the slice at which the rise ends; < 0: not in it. */
static double apex_time(const tahr__step *step, const fall *f, vec3 after)
{
    double before = rise_of(step, f->before), end = rise_of(step, after);
    if (before <= 0 || end > 0) {
        return -1;
    }
    if (step->config->integrator == TAHR_INTEGRATOR_EXACT) {
        return held_time(step) + before / f->pull.size;
    }
    return f->h * before / (before - end);
}

/* Ends the slice at the apex, which otherwise a low frame rate cuts off. The rest of its time comes after; this slice
 * does not count. */
static void end_at_apex(tahr__step *step, fall *f, const tahr__law *law, double apex, vec3 *after)
{
    if (step->config->integrator == TAHR_INTEGRATOR_EXACT) {
        *after = advance(step, f, law, apex, &f->motion);
    } else {
        *after = add_scaled(f->before, sub(*after, f->before), apex / f->h);
        f->motion = scale(add(f->before, step_level(step, *after)), 0.5 * apex);
    }
    *after = step_level(step, *after);
    f->left += f->h - apex;
    f->h = apex;
    step->iterations--;
    step->apexes++;
}

/* What a drive makes of a slice: its velocity, and without gravity where it says how fast to rise. */
static void drive_slice(tahr__step *step, fall *f, tahr__law *law)
{
    vec3 drive = drive_of(step), level = step_level(step, drive), up = step->state.up;
    f->floats = !(step->input->flags & TAHR_INPUT_DRIVE_LEVEL);
    f->before = add_scaled(level, up, rise_of(step, f->floats ? drive : f->before));
    *law = drive_law(level);
}

/* What acts on a slice; the settings under "Feel" change it. */
static void feel_pull(const tahr__step *step, fall *f)
{
    f->pull = *step->pull;
    f->terminal = step->config->terminal_speed;
    if (step->limits->feel) {
        double factor = tahr__gravity_factor(step, rise_of(step, step->state.velocity));
        f->pull.gravity = scale(f->pull.gravity, factor);
        f->pull.size *= factor;
        f->terminal = fastest_fall(step);
    }
}

/* Hangs on an edge that the head will pass in this slice, or that is within reach above it. */
static int hangs(tahr__step *step, fall *f)
{
    double speed = -rise_of(step, step->state.velocity), reach = step->config->ledge_grab;
    double way = (speed + 0.5 * f->pull.size * f->h) * f->h;
    tahr_hit edge;
    tahr__forget_edge(step);
    if (speed < 0 || !pushes_wall(step) || !tahr__find_edge(step, step->state.wall_normal, way, &edge)) {
        return 0;
    }
    double depth = tahr__edge_depth(step, &edge);
    if (depth > way || depth < -reach) {
        return 0;
    }
    step->ahead = depth > 0 ? f->h * depth / way : 0;
    f->rest = f->h - step->ahead;
    if (!tahr__grab_edge(step, step->state.wall_normal, &edge)) {
        step->ahead = 0;
        return 0;
    }
    return 1;
}

/* What was met and is no floor: a corner is gone past, a wall noted and perhaps jumped off. Returns 1 if the slice is
 * over for it. What is beside a corner that it would come back to is slid along as a wall. */
static int feels(tahr__step *step, fall *f, tahr_hit *hit)
{
    vec3 aside;
    int asked = press_is_remembered(step), feel = (int)step->limits->feel;
    const vec3 end = step->state.velocity; /* of the slice; here it is as far as its time is */
    step->state.velocity = add_scaled(f->before, sub(end, f->before), 1 - f->rest / f->h);
    int over = feel & TAHR__FEEL_CORNERS && tahr__clear_corner(step, hit, &aside);
    if (over && tahr__returns_to_corner(step, aside)) {
        hit->normal = hit->surface_normal = aside;
        over = 0;
    } else if (!over && feel & TAHR__FEEL_WALLS && tahr__meet_wall(step, hit)) {
        over = asked && !press_is_remembered(step);
    }
    if (over) {
        f->left += f->rest;
        f->h -= f->rest;
    } else {
        step->state.velocity = end;
    }
    return over;
}

static void begin_slice(tahr__step *step, fall *f)
{
    tahr_state *s = &step->state;
    vec3 unused;
    tahr__law law = tahr__falling_law(step);
    step->just_teleported = 0;
    f->from = s->position;
    f->before = s->velocity;
    f->floats = 0;
    if (is_driven(step)) {
        drive_slice(step, f, &law);
    }
    tahr__law idle = law;
    idle.wish = vec(0, 0, 0);
    idle.speed = idle.acceleration = 0;
    f->controls = law.acceleration > 0 && length_squared(law.wish) > 0;
    vec3 after = advance(step, f, &law, f->h, &f->motion);
    f->free = f->controls ? advance(step, f, &idle, f->h, &unused) : after;
    f->control = scale(sub(after, f->free), 1.0 / f->h);
    f->apex = apex_time(step, f, after);
    int cuts = step->config->apex_substep && step->apexes < MOST_APEXES && f->apex >= SHORT_SLICE && f->apex < f->h;
    if (cuts) {
        end_at_apex(step, f, &law, f->apex, &after);
        f->free = add_scaled(after, f->control, -f->h);
    }
    s->velocity = after;
    if (is_drifting(step)) {
        f->motion = add_scaled(f->motion, drive_of(step), f->h);
    }
}

/* The rise has ended by itself, not at a ceiling. */
static void tell_apex(tahr__step *step, const fall *f)
{
    if (f->apex >= 0 && f->apex <= f->h - f->rest) {
        step->ahead = f->apex;
        tahr__event(step, TAHR_EVENT_APEX, NULL, 0);
        step->state.flags &= ~(uint32_t)TAHR_STATE_JUMPING;
    }
}

/* LimitAirControl: what of the steering may act against a surface: nothing that pushes up a slope. */
static vec3 limit_control(const tahr__step *step, vec3 control, const tahr_hit *hit)
{
    int into = dot(control, hit->normal) < 0;
    if (hit->start_overlap) {
        return into ? vec(0, 0, 0) : control;
    }
    int limits = into && hit->blocking && rise_of(step, hit->normal) > UPRIGHT;
    return limits ? reject(control, unit(step_level(step, hit->normal))) : control;
}

static void take_velocity(tahr__step *step, const fall *f, vec3 motion, vec3 normal)
{
    if (is_drifting(step)) { /* the motion is not the velocity's alone */
        step->state.velocity = tahr__slide_vector(step, step->state.velocity, 1, normal);
    } else if (f->rest > SHORT_SLICE && !step->just_teleported) {
        step->state.velocity = scale(motion, 1.0 / f->rest);
    }
}

/* Moves on; the rest of the slice is what is left after what was met. Returns 1 if something was. */
static int move_on(tahr__step *step, fall *f, vec3 motion)
{
    step->ahead = f->h - f->rest;
    tahr__safe_move(step, motion, &f->swept);
    f->rest *= 1 - f->swept.hit.fraction;
    step->ahead = f->h - f->rest;
    return f->swept.hit.blocking != 0;
}

/* Nothing moved any more: a bit aside (1 cm where pull_back is 0.1 cm), away from both walls, or along the first. */
static void step_aside(tahr__step *step, vec3 first, vec3 second)
{
    tahr__swept swept;
    vec3 side = unit(step_level(step, add(first, second)));
    if (length_squared(side) == 0) {
        side = unit(cross(first, step->state.up));
    }
    tahr__safe_move(step, scale(side, 10 * step->config->pull_back), &swept);
}

/* Held between a floor and a wall that the perch rule takes for air: hardly moved (0.2 cm/s, 4 cm2/s) with a walkable
 * face under it. Unreal kicks such a character in a random direction; here it is always the one away from both
 * faces. */
static void leave_ditch(tahr__step *step, const fall *f, const tahr_hit *first, vec3 second)
{
    const tahr_config *c = step->config;
    vec3 moved = sub(step->state.position, f->from), up = step->state.up;
    double rise = dot(moved, up), slow = 2 * c->pull_back, wide = 20 * c->pull_back;
    int stands = c->perch_threshold > 0 && f->swept.hit.fraction == 1 &&
                 rise_of(step, first->surface_normal) >= step->limits->walkable;
    if (!stands || max_of(rise, -rise) > slow * f->h || length_squared(step_level(step, moved)) > wide * wide * f->h) {
        return;
    }
    tahr__swept swept;
    vec3 away = unit(step_level(step, add(first->normal, second)));
    if (length_squared(away) == 0) {
        away = unit(cross(first->normal, up));
    }
    vec3 kick = add_scaled(step_level(step, step->state.velocity), away, 0.125 * c->max_speed);
    step->state.velocity = add_scaled(kick, up, max_of(0.25 * c->jump_speed, 10 * c->pull_back));
    tahr__decide(step, TAHR_RULE_LANDING, 0, first, rise, slow * f->h, "kicked out of a ditch");
    tahr__safe_move(step, scale(step->state.velocity, f->h), &swept);
}

/* Blocked again, by a second surface. */
static int meet_second(tahr__step *step, fall *f, const tahr_hit *first, vec3 motion, double time)
{
    const tahr_hit second = f->swept.hit;
    vec3 up = step->state.up, delta = motion;
    if (tahr__is_valid_landing_spot(step, &f->swept)) {
        return LANDS;
    }
    tahr__handle_impact(step, &second);
    if (f->controls && rise_of(step, second.normal) > UPRIGHT) { /* as if nobody had steered */
        delta = tahr__slide_vector(step, scale(f->free, time), 1, first->normal);
    }
    delta = tahr__two_wall_adjust(step, delta, &second, first->normal);
    if (f->controls) {
        vec3 gained = scale(limit_control(step, f->control, &second), f->rest);
        if (dot(gained, first->normal) > 0) {
            delta = add_scaled(delta, gained, f->rest);
        }
    }
    take_velocity(step, f, delta, second.normal);
    double fallen = dot(delta, up), level = 1e-3 * step->config->pull_back; /* 1e-4 cm */
    int ditch = dot(first->surface_normal, up) > 0 && dot(second.surface_normal, up) > 0 && fallen <= level &&
                fallen >= -level && dot(second.surface_normal, first->surface_normal) < 0;
    move_on(step, f, delta);
    const tahr_hit *third = &f->swept.hit;
    int held = third->fraction == 0;
    if (held) {
        step_aside(step, first->normal, third->surface_normal);
    }
    if (ditch || tahr__is_valid_landing_spot(step, &f->swept) || held) {
        f->left = f->rest = 0;
        return LANDS;
    }
    leave_ditch(step, f, first, second.normal);
    return GOES_ON;
}

/* Blocked: lands, or slides. */
static int meet(tahr__step *step, fall *f)
{
    tahr_hit first = f->swept.hit;
    if (tahr__is_valid_landing_spot(step, &f->swept) ||
        (tahr__should_check_landing_spot(step, &first) && tahr__finds_landing_spot(step))) {
        return LANDS;
    }
    if (step->limits->feel && feels(step, f, &first)) {
        return GOES_ON;
    }
    tahr__handle_impact(step, &first);
    vec3 motion = scale(step->state.velocity, f->h);
    if (f->controls) {
        motion = scale(add_scaled(f->free, limit_control(step, f->control, &first), f->h), f->h);
    }
    if (is_drifting(step)) {
        motion = add_scaled(motion, drive_of(step), f->h);
    }
    vec3 slide = tahr__slide_vector(step, motion, 1 - first.fraction, first.normal);
    step->report.slides++;
    take_velocity(step, f, slide, first.normal);
    double time = f->rest;
    if (time <= SHORT_SLICE || dot(slide, motion) <= 0 || !move_on(step, f, slide)) {
        return GOES_ON;
    }
    return meet_second(step, f, &first, slide, time);
}

/* A drift of less than 0.032 cm/s is rounding of slides. */
static void stop_drift(tahr__step *step)
{
    double still = step->config->pull_back;
    vec3 level = step_level(step, step->state.velocity);
    if (length_squared(level) <= 0.1 * still * still) {
        step->state.velocity = sub(step->state.velocity, level);
    }
}

/* The slice ends where it is: with the velocity of that time, and the rest of its time comes after. */
static void cut_short(tahr__step *step, fall *f)
{
    step->state.velocity = add_scaled(f->before, sub(step->state.velocity, f->before), 1 - f->rest / f->h);
    f->left += f->rest;
    f->h -= f->rest;
}

static int fall_slice(tahr__step *step, fall *f)
{
    int answer = GOES_ON;
    tahr__watch_drop(step);
    feel_pull(step, f);
    if (step->limits->feel & TAHR__FEEL_EDGES && hangs(step, f)) {
        f->left += f->rest;
        return HANGS;
    }
    begin_slice(step, f);
    f->rest = f->h;
    int met = move_on(step, f, f->motion);
    tell_apex(step, f);
    step->ahead = f->h - f->rest;
    if (met && tahr__drops_on(step, &f->swept.hit)) {
        cut_short(step, f);
    } else if (met) {
        answer = f->swept.hit.unknown ? ENDS : meet(step, f);
    }
    if (step->state.flags & TAHR_STATE_WALL_TOUCHED && !met && !tahr__is_at_wall(step, step->state.position)) {
        tahr__leave_wall(step, step->time + f->h);
    }
    step->state.jump_hold = max_of(step->state.jump_hold - f->h, 0);
    if (answer == LANDS) {
        f->left += f->rest;
        tahr__process_landed(step, &f->swept.hit);
    } else {
        stop_drift(step);
    }
    return answer;
}

tahr__next tahr__fall_two_walls(tahr__step *step, double time)
{
    fall f = {.left = time};
    int answer = GOES_ON;
    while (answer == GOES_ON && f.left >= TAHR__LEAST_TIME && step->error >= 0) {
        if (step_has_fluids(step) && tahr__is_carried(step, step->state.position, step->state.velocity)) {
            tahr__begin_swimming(step);
            return (tahr__next){TAHR_MODE_SWIMMING, f.left};
        }
        double begun = f.left;
        f.h = tahr__begin_iteration(step, f.left);
        if (f.h == 0) {
            f.left = 0;
            break;
        }
        f.left = begun - f.h;
        answer = fall_slice(step, &f);
        step->time += begun - f.left;
        step->ahead = 0;
        tahr__time_slice(step);
    }
    if (answer == ENDS) {
        step->report.time_lost += f.left;
    }
    static const uint32_t modes[] = {[GOES_ON] = TAHR_MODE_FALLING,
                                     [ENDS] = TAHR_MODE_FALLING,
                                     [LANDS] = TAHR_MODE_WALKING,
                                     [HANGS] = TAHR_MODE_HANGING};
    tahr__next next = {modes[answer], answer == LANDS || answer == HANGS ? f.left : 0};
    return next;
}

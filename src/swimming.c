/* SPDX-License-Identifier: MIT
 * swimming.c: one slice of swimming.
 *
 * Thrust and drag are in proportion to velocities, weight and buoyancy to the immersion: all of it is one linear
 * equation (stroke.h), so that the same second of swimming is the same at every frame rate, and so is a bob at the
 * surface. An upward wish carries less the higher it comes out: full thrust wholly immersed, none at the line from
 * which on it swims. That, and not a cut, keeps a swimmer in the water. */
#include "swimming.h"

#include "elementary.h"
#include "floor.h"
#include "glide.h"
#include "modes.h"
#include "move.h"
#include "report.h"
#include "stepped.h"
#include "stroke.h"
#include "walking.h"

/* Of the swim line: it falls when it is out farther than this, and finds its feet below that, so that it does not swap
 * between two modes at one depth. */
static const double LEAVES = 0.8, STANDS = 0.9;

/* m/s: slower than this, with no force left that would make it faster again, is at rest. */
static const double RESTS = 1e-3;

/* m beyond a line that a piece ends at, so that the next one begins on its other side. */
static const double BEYOND = 1e-9;

/* Width of the band of immersion over which an upward wish loses its thrust, at least. */
static const double FADES = 0.05;

double tahr__swim_line(const tahr_config *c)
{
    return c->buoyancy * c->swim_immersion > 1 ? 1 / c->buoyancy : c->swim_immersion;
}

static double height_of(const tahr__step *step)
{
    return 2 * step->limits->shape.half_height;
}

static double weight_of(const tahr__step *step)
{
    return max_of(-dot(step->pull->gravity, step->state.up), 0);
}

/* The velocity asked for, relative to the water. */
static vec3 wish_of(const tahr__step *step)
{
    vec3 wish = step->input->move;
    double size = length(wish);
    return scale(wish, step->config->swim_speed * (size > 1 ? 1 / size : 1));
}

static double friction_of(const tahr__step *step, const tahr_fluid *water)
{
    return water->friction > 0 ? water->friction : step->config->fluid_friction;
}

/* From rest the thrust accelerates by config.acceleration (of a full wish), and holds its own against the drag at the
 * speed asked for. */
static tahr__stroke stroke_of(const tahr__step *step, const tahr_fluid *water, vec3 wish)
{
    const tahr_config *c = step->config;
    vec3 up = step->state.up;
    double rate = friction_of(step, water), m = water->immersion;
    double g = weight_of(step), flow = dot(water->velocity, up), rise = dot(wish, up);
    if (length_squared(wish) > 0) {
        rate = max_of(rate, c->acceleration / c->swim_speed);
    }
    tahr__stroke s = {.up = up, .rate = rate, .drag = rate};
    s.target = reject(add(water->velocity, wish), up);
    double thrust = rate * rise;
    if (m < 1) {
        double line = tahr__swim_line(c), band = max_of(1 - line, FADES), height = height_of(step);
        s.spring = g * c->buoyancy / height;
        /* Half of the damping that would keep it from bobbing at all: waves carry the rest away. */
        s.drag = max_of(rate, sqrt(s.spring));
        if (rise > 0) {
            s.spring += thrust / (height * band);
            thrust *= (m - line) / band;
        }
    }
    s.push = s.drag * flow + thrust + g * (c->buoyancy * m - 1);
    return s;
}

/* Nothing moves it, and nothing will. */
static int rests(const tahr__step *step, const tahr__stroke *s)
{
    double still = RESTS * RESTS * (1 + 1e-9);
    double swing = s->spring > 0 ? s->push * s->push / s->spring : (s->push == 0 ? 0 : INFINITY);
    return length_squared(s->target) == 0 && length_squared(step->state.velocity) + swing <= still;
}

/* s until a drift that only drag acts on is at rest: e^(-rate t) of its speed is left. */
static double drift_time(const tahr__stroke *s, vec3 v)
{
    double speed = length(v);
    if (s->spring > 0 || s->push != 0 || s->rate <= 0 || length_squared(s->target) > 0 || speed <= RESTS) {
        return INFINITY;
    }
    return tahr__log1p(speed / RESTS - 1) / s->rate;
}

/* One piece of the slice: a stroke, or with STEPPED a constant velocity. */
typedef struct piece {
    const tahr__stroke *stroke; /* NULL: stepped */
    vec3 velocity;
    double time; /* s */
} piece;

/* [out] velocity there. */
static vec3 along_piece(const piece *p, double t, vec3 *velocity)
{
    if (p->stroke) {
        return tahr__stroke_at(p->stroke, p->velocity, t, velocity);
    }
    *velocity = p->velocity;
    return scale(p->velocity, t);
}

static vec3 piece_at(const void *self, double t)
{
    vec3 v;
    return along_piece(self, t, &v);
}

double tahr__passing_time(tahr__step *step, const tahr__way *way, double duration, double end, double line, int deeper)
{
    double low = 0, high = duration, at_high = end, height = height_of(step);
    vec3 up = step->state.up, start = step->state.position;
    for (int i = 0; i < 12 && step->error >= 0; i++) {
        double t = 0.5 * (low + high);
        if (at_high > 0 && at_high < 1) { /* a level surface tells its height */
            double goal = dot(way->at(way->self, high), up) + (at_high - line) * height + (deeper ? -BEYOND : BEYOND);
            double a = low, b = high;
            for (int k = 0; k < 60; k++) {
                double middle = 0.5 * (a + b), rise = dot(way->at(way->self, middle), up);
                *((deeper ? rise < goal : rise > goal) ? &b : &a) = middle;
            }
            t = b;
        }
        double m = tahr__fluid(step, add(start, way->at(way->self, t))).immersion;
        int beyond = deeper ? m >= line : m < line;
        double off = m > line ? m - line : line - m;
        if (beyond && off * height <= 2 * BEYOND) {
            return t;
        }
        if (!beyond && t >= high) {
            break; /* the answers contradict each other */
        }
        if (beyond) {
            high = t;
            at_high = m;
        } else {
            low = t;
        }
    }
    return high;
}

/* m/s2 that bend the path at the begin of a piece: what is not along it. */
static double bending(const tahr__stroke *s, vec3 v)
{
    double along = dot(v, s->up);
    vec3 level = scale(sub(s->target, add_scaled(v, s->up, -along)), s->rate);
    vec3 a = add_scaled(level, s->up, s->push - s->drag * along);
    return length_squared(v) > 0 ? length(reject(a, unit(v))) : 0;
}

/* How far a stroke goes before the water begins or ends to carry it all, or its closed form ends. */
static double stroke_time(const tahr__step *step, const tahr__glide *g, const tahr__stroke *s, double immersion)
{
    const vec3 v = step->state.velocity;
    double leave = LEAVES * tahr__swim_line(step->config), height = height_of(step);
    double t = min_of(tahr__glide_piece(step, g, bending(s, v)), tahr__stroke_longest(s));
    t = min_of(t, drift_time(s, v));
    if (immersion < 1) {
        t = tahr__stroke_leaves(s, v, t, -(1 - immersion) * height - BEYOND, (immersion - leave) * height + BEYOND);
    }
    return t;
}

/* Cuts a piece at the line where the water begins not to carry all of it, or no longer carries. [out] ahead: the water
 * at its end. Returns 1 if that is still so after it, 0 if the piece was cut. */
static int cut_piece(tahr__step *step, piece *p, double immersion, tahr_fluid *ahead)
{
    const tahr__way way = {p, piece_at};
    double line = immersion < 1 || !p->stroke ? LEAVES * tahr__swim_line(step->config) : 1;
    *ahead = tahr__fluid(step, add(step->state.position, piece_at(p, p->time)));
    if (ahead->immersion >= line - 2 * BEYOND / height_of(step)) {
        return 1;
    }
    p->time = tahr__passing_time(step, &way, p->time, ahead->immersion, line, 0);
    return 0;
}

/* config.integrator STEPPED. Out of the water no faster up than a third of the speed, except by what is still immersed;
 * in the shallows hardly any thrust upward (0.1 cm/s2); half of the friction turns, all of it brakes, and the fluid
 * itself takes its half too. */
static vec3 stepped_velocity(const tahr__step *step, const tahr_fluid *water, double t)
{
    const tahr_config *c = step->config;
    const double third = 0.33, shallow = 0.65, thrust = 1e-3;
    vec3 up = step->state.up, v = sub(step->state.velocity, water->velocity);
    double m = water->immersion, carried = c->buoyancy * m, rise = dot(v, up);
    if (rise > third * c->swim_speed && carried > 0) {
        v = add_scaled(v, up, max_of(third * c->swim_speed, rise * m * m) - rise);
    }
    vec3 push = scale(wish_of(step), c->swim_speed > 0 ? c->acceleration / c->swim_speed : 0);
    if (m < shallow && dot(push, up) > thrust) {
        push = add_scaled(push, up, thrust - dot(push, up));
    }
    double friction = 0.5 * friction_of(step, water) * m;
    tahr__law law = {.wish = unit(push),
                     .speed = length(wish_of(step)),
                     .acceleration = length(push),
                     .turn_friction = friction,
                     .drag = 2 * friction};
    v = tahr__calc_velocity(c, &law, friction, v, t);
    return add(add_scaled(v, step->pull->gravity, (1 - carried) * t), water->velocity);
}

static int stands_here(tahr__step *step)
{
    double m = tahr__standing_immersion(step), line = STANDS * tahr__swim_line(step->config);
    return tahr__decide(step, TAHR_RULE_FLUID, m < line, NULL, m, line, "finds its feet in the shallows");
}

/* On what it met, if that is a floor and the water no longer carries. */
static int finds_feet(tahr__step *step, const tahr_hit *hit)
{
    tahr_floor floor;
    if (dot(hit->normal, step->state.up) < 1e-3 || !stands_here(step)) { /* 1e-3: a wall */
        return 0;
    }
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!floor_is_walkable(&floor) || floor.distance > step->config->floor_max * step->config->skin) {
        return 0;
    }
    tahr__keep_floor(step, &floor);
    return 1;
}

static int wade_out(tahr__step *step, const tahr_hit *hit, double left, tahr__next *next)
{
    tahr__event(step, TAHR_EVENT_LANDED, hit, max_of(-dot(step->state.velocity, step->state.up), 0));
    step->state.velocity = step_level(step, step->state.velocity);
    step->state.flags |= TAHR_STATE_FLOOR_MOVED; /* standing looks again, from where it is then */
    *next = (tahr__next){TAHR_MODE_WALKING, left};
    return 0;
}

/* s of a piece until that part of its way is made. [out] then: the velocity there. */
static double reach(const piece *p, vec3 way, double part, vec3 *then)
{
    const double used = p->stroke ? tahr__stroke_time(p->stroke, p->velocity, p->time, way, part) : p->time * part;
    along_piece(p, used, then);
    return used;
}

/* Moves along the piece. Returns 1 if it stepped up on something. [out] hit */
static int move_piece(tahr__step *step, tahr__glide *g, const piece *p, tahr_hit *hit)
{
    vec3 then;
    vec3 way = tahr__glide_bend(g, along_piece(p, p->time, &then));
    if (step->config->slide_solver == TAHR_SLIDE_TWO_WALLS) {
        const tahr__glide_motion whole = {way, p->time, stands_here};
        step->state.velocity = then;
        return tahr__glide_two_walls(step, g, &whole, hit);
    }
    step->just_teleported |= (uint32_t)tahr__move(step, way, hit);
    const double used = hit->blocking ? reach(p, way, hit->fraction, &then) : p->time, rest = 1 - hit->fraction;
    step->state.velocity = then;
    tahr__glide_use(step, g, used);
    const double covered = is_met(hit) ? tahr__glide_step_up(step, g, hit, scale(way, rest), stands_here) : 0;
    if (covered > 0) {
        const double until = reach(p, way, hit->fraction + covered * rest, &step->state.velocity);
        tahr__glide_use(step, g, max_of(until - used, 0));
    }
    return covered > 0;
}

/* One piece of the slice, from where the water is known. Returns 0 where the slice ends early: *next says how. */
static int swim_piece(tahr__step *step, tahr__glide *g, tahr_fluid *water, int *known, tahr__next *next)
{
    tahr_hit hit;
    step->state.velocity = tahr__glide_bend(g, step->state.velocity);
    const tahr__stroke s = stroke_of(step, water, tahr__glide_bend(g, wish_of(step)));
    if (rests(step, &s)) {
        step->state.velocity = vec(0, 0, 0);
        tahr__glide_use(step, g, g->left);
        return 0;
    }
    piece p = {&s, step->state.velocity, g->left};
    if (step->config->integrator == TAHR_INTEGRATOR_STEPPED) {
        p.stroke = NULL;
        p.velocity = stepped_velocity(step, water, g->left);
    } else {
        p.time = stroke_time(step, g, &s, water->immersion);
    }
    *known = cut_piece(step, &p, water->immersion, water);
    int up = move_piece(step, g, &p, &hit);
    *known = *known && !hit.blocking && g->plane_count == 0;
    if (!hit.blocking || hit.unknown || hit.start_overlap) {
        return !hit.blocking;
    }
    if (up || finds_feet(step, &hit)) {
        return wade_out(step, &hit, g->left, next);
    }
    return step->config->slide_solver == TAHR_SLIDE_TWO_WALLS || tahr__glide_meet(step, g, &hit);
}

tahr__next tahr__swim(tahr__step *step, double time)
{
    tahr__next next = {TAHR_MODE_SWIMMING, 0};
    tahr__glide g;
    tahr_fluid water;
    int known = 0;
    double leave = LEAVES * tahr__swim_line(step->config);
    tahr__glide_begin(step, &g, time);
    while (tahr__glide_goes_on(step, &g)) {
        if (!known) {
            water = tahr__fluid(step, step->state.position);
        }
        if (step->error < 0 || (step->report.flags & TAHR_REPORT_QUERY_CAP)) {
            break;
        }
        if (water.immersion < leave) {
            tahr__decide(step, TAHR_RULE_FLUID, 0, NULL, water.immersion, leave, "too shallow to swim on");
            tahr__next fall = {TAHR_MODE_FALLING, g.left};
            return fall;
        }
        if (!swim_piece(step, &g, &water, &known, &next)) {
            break;
        }
    }
    if (next.mode == TAHR_MODE_SWIMMING) {
        tahr__glide_end(step, &g);
    }
    return next;
}

int tahr__is_carried(tahr__step *step, vec3 position, vec3 velocity)
{
    double line = tahr__swim_line(step->config), m = tahr__fluid(step, position).immersion;
    return m >= line && (m >= 1 || dot(velocity, step->state.up) <= 0);
}

void tahr__begin_swimming(tahr__step *step)
{
    if (step->state.mode == TAHR_MODE_WALKING) {
        tahr__leave_floor(step);
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_MODE);
    }
    step->state.flags &= ~(uint32_t)TAHR_STATE_JUMPING;
    step->state.jump_hold = 0;
    tahr__glide_forget_floor(step);
}

void tahr__jump_from_water(tahr__step *step)
{
    tahr_state *s = &step->state;
    double speed = step->config->water_exit_speed, rise = dot(s->velocity, s->up);
    double m = tahr__fluid(step, s->position).immersion;
    if (!tahr__decide(step, TAHR_RULE_JUMP, m > 0 && m < 1 && speed > 0, NULL, m, 1, "at the surface of the water")) {
        return;
    }
    s->velocity = add_scaled(s->velocity, s->up, max_of(rise, speed) - rise);
    s->flags |= TAHR_STATE_JUMPING;
    tahr__event(step, TAHR_EVENT_JUMPED, NULL, speed);
    tahr__change_mode(step, TAHR_MODE_FALLING);
}

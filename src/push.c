/* SPDX-License-Identifier: MIT
 * push.c: bodies that move into a character, and characters that push bodies.
 *
 * Seen from a body the character moves: from where it was relative to the body's last pose to where it is relative to
 * this one. That motion is swept against the body alone, so that nothing passes through a character at any speed. */
#include "push.h"

#include <string.h>

#include "base_motion.h"
#include "body_motion.h"
#include "drop.h"
#include "move.h"
#include "plane.h"
#include "query.h"
#include "report.h"
#include "scope.h"
#include "step_up.h"

/* rad that a body may turn in one straight piece of a relative motion: 5 m off the axis the arc bulges by 6 mm, less
 * than a skin. */
static const double PIECE = 0.1;
enum { PIECES = 16 };

/* Where a character meets a body, in the world as it is now. */
typedef struct meeting {
    vec3 at;     /* the character then */
    double time; /* 0..1 of the motion */
    tahr_hit hit;
} meeting;

static void sweep_only(tahr__step *step, uint32_t body, vec3 from, vec3 motion, tahr_hit *hit)
{
    step->ignore_body = body;
    tahr__sweep(step, &step->limits->shape, from, motion, step->config->skin,
                TAHR_SWEEP_ONLY_BODY | TAHR_SWEEP_LEAVE_OVERLAP, hit);
    step->ignore_body = TAHR_NO_BODY;
}

/* The character goes from `from` to `to` while the body makes its motion. Returns 1 if they meet. */
static int meets(tahr__step *step, uint32_t body, vec3 from, vec3 to, meeting *m)
{
    const tahr__body_note *note = &step->world->bodies[body];
    vec3 axis, at = tahr__carried(step->world, &note->before, &note->pose, from);
    double turn = 2 * tahr__half_turn(note->before.orientation, note->pose.orientation, &axis);
    int pieces = turn < PIECE ? 1 : (turn / PIECE < PIECES ? 1 + (int)(turn / PIECE) : PIECES);
    for (int i = 1; i <= pieces; i++) {
        vec3 next = to;
        if (i < pieces) {
            double t = (double)i / pieces;
            tahr_pose pose = tahr__pose_between(&note->before, &note->pose, t);
            next = tahr__carried(step->world, &pose, &note->pose, add_scaled(from, sub(to, from), t));
        }
        vec3 motion = sub(next, at);
        if (length_squared(motion) > 0) {
            sweep_only(step, body, at, motion, &m->hit);
            if (m->hit.unknown) {
                return 0;
            }
            if (m->hit.blocking) {
                m->at = add_scaled(at, motion, m->hit.fraction);
                m->time = (i - 1 + m->hit.fraction) / pieces;
                return 1;
            }
        }
        at = next;
    }
    return 0;
}

/* May the body come near a character that is within `around` of p? */
static int is_near(const tahr__step *step, const tahr__body_note *note, vec3 p, double around)
{
    const tahr__limits *l = step->limits;
    double reach = around + l->around + l->shape.half_height + 2 * step->config->skin;
    return !(note->flags & TAHR_BODY_SENSOR) && note_gap(step->world, note, p) <= reach;
}

int tahr__moves_near(const tahr__step *step, uint32_t except)
{
    const tahr_world *world = step->world;
    double reach = step->config->snap_distance + step->config->perch_extra + step->config->step_height;
    for (uint32_t i = 0; i < world->moved_count; i++) {
        uint32_t body = world->moved[i];
        if (body != except && is_near(step, &world->bodies[body], step->state.position, reach)) {
            return 1;
        }
    }
    return 0;
}

static void add_plane(tahr__plane *planes, uint32_t *count, uint32_t body, vec3 normal, double offset)
{
    tahr__plane plane = {.normal = normal, .offset = offset, .body = body, .feature = *count};
    tahr__planes_add(planes, count, &plane);
}

/* Does the world, but for the body, let the character go by x? If not, adds what stops it. */
static int world_lets(tahr__step *step, uint32_t body, vec3 x, tahr__plane *planes, uint32_t *count)
{
    tahr_hit hit;
    step->ignore_body = body;
    tahr__sweep(step, &step->limits->shape, step->state.position, x, step->config->skin, TAHR_SWEEP_LEAVE_OVERLAP,
                &hit);
    step->ignore_body = TAHR_NO_BODY;
    /* A millionth of a metre short is a plane that is in the set already. */
    if (!hit.blocking || (1 - hit.fraction) * length(x) < 1e-6) {
        return 1;
    }
    add_plane(planes, count, hit.body, hit.normal, dot(hit.normal, x) * hit.fraction);
    return 0;
}

/* The least way out of the body's way that everything else leaves. Returns 0 if there is none: crushed, or nearly so.
 * Between faces that all but oppose each other the least way is many times as long as the push: nobody is flung farther
 * than the body itself comes, and as an overlap may be left by. */
static int push_out(tahr__step *step, uint32_t body, const meeting *m)
{
    enum { ROUNDS = 6 };
    tahr__plane planes[ROUNDS + 1];
    uint32_t count = 0;
    const vec3 start = step->state.position;
    vec3 x;
    tahr_hit hit;
    const double most = length(sub(m->at, start)) + step->config->max_depenetration;
    add_plane(planes, &count, body, m->hit.normal, dot(m->hit.normal, sub(m->at, start)));
    for (int i = 0; i < ROUNDS && step->error >= 0; i++) {
        if (!tahr__project(planes, count, vec(0, 0, 0), &x) || length_squared(x) > most * most) {
            return 0;
        }
        if (!world_lets(step, body, x, planes, &count)) {
            continue;
        }
        vec3 rest = sub(add(start, x), m->at);
        sweep_only(step, body, m->at, rest, &hit);
        if (!hit.blocking || (1 - hit.fraction) * length(rest) < 1e-6) {
            step->state.position = add(start, x);
            return 1;
        }
        vec3 stop = add_scaled(m->at, rest, hit.fraction);
        add_plane(planes, &count, body, hit.normal, dot(hit.normal, sub(stop, start)));
    }
    return 0;
}

/* What walks is pushed up a step in its way. */
static int push_up_step(tahr__step *step, uint32_t body, const meeting *m)
{
    const vec3 from = step->state.position, normal = m->hit.normal;
    vec3 way = step_level(step, scale(normal, dot(normal, sub(m->at, from))));
    double covered = 0;
    tahr__scope scope;
    tahr_hit hit;
    tahr__scope_open(step, &scope);
    step->ignore_body = body;
    tahr__sweep(step, &step->limits->shape, from, way, step->config->skin, TAHR_SWEEP_LEAVE_OVERLAP, &hit);
    if (is_met(&hit)) {
        step->state.position = add_scaled(from, way, hit.fraction);
        covered = tahr__step_up(step, scale(way, 1 - hit.fraction), &hit, NULL);
    }
    step->ignore_body = TAHR_NO_BODY;
    vec3 rest = sub(step->state.position, m->at);
    if (covered > 0) {
        sweep_only(step, body, m->at, rest, &hit);
        if (!hit.blocking || dot(hit.normal, rest) > -1e-6) {
            return 1;
        }
    }
    tahr__scope_revert(step, &scope);
    return 0;
}

static void push(tahr__step *step, uint32_t body, vec3 from, double dt)
{
    meeting m;
    vec3 start = step->state.position;
    const tahr__body_note *note = &step->world->bodies[body];
    if (body == step->frame_body) { /* carried all the way: where it was, seen from the body */
        vec3 rest = sub(tahr__carried(step->world, &note->before, &note->pose, from), start);
        if (length_squared(rest) < 1e-12) {
            return;
        }
    }
    if (!is_near(step, note, from, length(sub(start, from))) || !meets(step, body, from, start, &m)) {
        return;
    }
    int freed = push_out(step, body, &m);
    if (!freed && step->state.mode == TAHR_MODE_WALKING) {
        freed = push_up_step(step, body, &m);
    }
    double speed = length(sub(step->state.position, start)) / dt;
    tahr__decide(step, TAHR_RULE_BASE, freed, &m.hit, speed * dt, 0, "pushed by a body that moves");
    if (!freed || m.hit.start_overlap) {
        tahr__depenetrate(step);
    }
    tahr__event(step, TAHR_EVENT_HIT, &m.hit, speed);
}

/* Is it inside of a one-way body before both move? Asked with the body solid for once. */
static int is_inside(tahr__step *step, uint32_t body, vec3 from)
{
    const tahr__body_note *note = &step->world->bodies[body];
    tahr_hit hit;
    if (!(note->flags & TAHR_BODY_ONE_WAY)) {
        return 0;
    }
    step->ignore_body = body;
    tahr__sweep(step, &step->limits->shape, tahr__carried(step->world, &note->before, &note->pose, from),
                scale(step->state.up, -step->config->skin), 0, TAHR_SWEEP_ONLY_BODY | TAHR_SWEEP_WHOLE, &hit);
    step->ignore_body = TAHR_NO_BODY;
    return hit.blocking && hit.start_overlap;
}

/* In the air: the body that the character meets in this step, or that would push it. Their relative motion is then the
 * same at every frame rate: a landing on a train, a jump off a lift that rises. Or the one-way body that it is passing:
 * seen from the world a lift that sinks would be below the foot already before the foot has moved. [out] high: so many
 * m above his centre is what of his axis meets it; of who is inside, the foot. */
static uint32_t first_met(tahr__step *step, vec3 own, double *high, uint32_t *inside)
{
    const tahr__limits *l = step->limits;
    const tahr_world *world = step->world;
    const vec3 from = step->state.position;
    uint32_t first = TAHR_NO_BODY;
    double soonest = 3, around = length(own);
    for (uint32_t i = 0; i < world->moved_count; i++) {
        meeting m;
        uint32_t body = world->moved[i];
        if (!is_near(step, &world->bodies[body], from, around)) {
            continue;
        }
        double time = meets(step, body, from, add(from, own), &m) ? m.time : 3;
        if (time > 2 && meets(step, body, from, from, &m)) {
            time = 1 + m.time;
        }
        int within = time > 2 && is_inside(step, body, from);
        time = within ? 2 : time;
        if (time < soonest) {
            soonest = time;
            first = body;
            *inside = (uint32_t)within;
            *high =
                within ? -l->shape.half_height : clamp(dot(sub(m.hit.point, m.at), step->state.up), -l->axis, l->axis);
        }
    }
    return first;
}

/* Who drops falls away from the platform, not from the world: seen from the world a lift that rises would pass him
 * before he has left it. */
static uint32_t dropped_from(const tahr__step *step)
{
    uint32_t body = step->state.drop_body;
    int moves = is_dropping(step) && body < step->world->body_count && step->world->bodies[body].dt > 0;
    return moves ? body : TAHR_NO_BODY;
}

static void take_frame(tahr__step *step, double dt)
{
    tahr_state *s = &step->state;
    tahr_body_motion motion;
    vec3 own = add_scaled(scale(s->velocity, dt), step->pull->gravity, 0.5 * dt * dt);
    uint32_t body = dropped_from(step), inside = body != TAHR_NO_BODY;
    double high = -step->limits->shape.half_height;
    body = inside ? body : first_met(step, own, &high, &inside);
    if (body == TAHR_NO_BODY || tahr__body_motion(step->world, body, &motion) < 0) {
        return;
    }
    const tahr__body_note *note = &step->world->bodies[body];
    step->ignore_body = body;
    step->passes = inside; /* what it is inside of may be a row of bodies: all of them are elsewhere already */
    /* Upright beside a body that tilts he stays as near as he was only where he meets it. */
    high = motion_tilts(step, &motion) ? high : 0;
    const vec3 held = add_scaled(s->position, s->up, high);
    tahr__go_along(step, sub(tahr__carried(step->world, &note->before, &note->pose, held), held));
    step->passes = 0;
    step->ignore_body = TAHR_NO_BODY;
    if (body == dropped_from(step)) {
        tahr__carry_drop(step, &note->before, &note->pose);
    }
    step->frame_body = body;
    step->frame_velocity =
        along_plane(step->limits, tahr__point_velocity(&motion, add_scaled(s->position, s->up, high), 1));
    s->velocity = sub(s->velocity, step->frame_velocity);
}

void tahr__meet_bodies(tahr__step *step, vec3 from, double dt)
{
    const tahr_world *world = step->world;
    uint32_t mode = step->state.mode;
    if (step->frame_body == TAHR_NO_BODY && mode != TAHR_MODE_WALKING && mode != TAHR_MODE_HANGING) {
        take_frame(step, dt);
    }
    for (uint32_t i = 0; i < world->moved_count && step->error >= 0; i++) {
        push(step, world->moved[i], from, dt);
    }
}

static int is_fixed(const tahr__step *step, uint32_t body)
{
    return !(world_body_flags(step->world, body) & TAHR_BODY_MOVABLE);
}

double tahr__fixed_depth(const tahr__step *step, const tahr_contact *contacts, uint32_t count)
{
    double depth = 0;
    for (uint32_t i = 0; i < count; i++) {
        depth = is_fixed(step, contacts[i].body) ? max_of(depth, -contacts[i].distance) : depth;
    }
    return depth;
}

vec3 tahr__spare_the_fixed(const tahr__step *step, const tahr_contact *contacts, uint32_t count, vec3 push)
{
    tahr__plane planes[TAHR__MAX_PLANES];
    uint32_t used = 0;
    vec3 spared;
    for (uint32_t i = 0; i < count; i++) {
        if (!is_fixed(step, contacts[i].body)) {
            continue;
        }
        tahr__plane plane = {.normal = contacts[i].normal,
                             .offset = step->config->skin - contacts[i].distance,
                             .body = contacts[i].body,
                             .feature = contacts[i].feature};
        tahr__planes_add(planes, &used, &plane);
    }
    return used > 0 && tahr__project(planes, used, push, &spared) ? spared : push;
}

/* The mass and the motion of a body; 0 without a mass. */
static double mass_of(const tahr__step *step, uint32_t body, tahr_body_motion *motion)
{
    return body != TAHR_NO_BODY && tahr__body_motion(step->world, body, motion) >= 0 ? motion->mass : 0;
}

/* Who leans against a body would reach this speed into it within the step. */
static double leaning(const tahr__step *step, vec3 normal)
{
    const tahr_config *c = step->config;
    vec3 wish = step_level(step, step->input->move);
    double size = length(wish), into = -dot(wish, normal);
    return into > 0 ? into / max_of(size, 1) * min_of(c->max_speed, c->acceleration * step->dt) : 0;
}

/* The momentum of a perfectly plastic hit, as far as the character's strength goes. */
void tahr__report_push(tahr__step *step, const tahr_hit *hit, double speed)
{
    const tahr_config *c = step->config;
    tahr_body_motion motion;
    double mass = mass_of(step, hit->body, &motion);
    if (mass <= 0) {
        return;
    }
    vec3 v = tahr__point_velocity(&motion, hit->point, 1);
    if (step->frame_body != TAHR_NO_BODY) {
        v = sub(v, step->frame_velocity);
    }
    double closing = max_of(speed, leaning(step, hit->normal)) + dot(v, hit->normal);
    double impulse = min_of(closing * (c->mass * mass / (c->mass + mass)), c->push_force * step->dt);
    if (impulse > 0) {
        tahr__event(step, TAHR_EVENT_PUSHED, hit, impulse);
    }
}

void tahr__press_down(tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    tahr_body_motion motion;
    if (!step->report.events || !(floor->flags & TAHR_FLOOR_WALKABLE) || mass_of(step, floor->body, &motion) <= 0) {
        return;
    }
    tahr_hit hit;
    memset(&hit, 0, sizeof hit);
    hit.body = floor->body;
    hit.feature = floor->feature;
    hit.surface = floor->surface;
    hit.normal = step->state.up;
    hit.point = floor->point;
    tahr__event(step, TAHR_EVENT_PUSHED, &hit, step->config->mass * step->pull->size * step->dt);
}

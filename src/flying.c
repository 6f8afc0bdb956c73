/* SPDX-License-Identifier: MIT
 * flying.c: one slice of flying: the law of walking in three dimensions, without gravity. */
#include "flying.h"

#include "glide.h"
#include "launch.h"
#include "move.h"
#include "report.h"
#include "stepped.h"

/* m/s: a drag alone never ends. A deceleration of the drag at this speed does, at the same time at every frame rate. */
static const double HOVERS = 1e-3;

/* Is the drive the velocity all the time? Every wall then takes its part of the drive itself, as in walking: of what
 * the wall before left, a gutter whose walls lean to each other would leave less and less. path_tolerance 0 is a flight
 * whose bends are the coarse ones. */
static int holds_drive(const tahr__step *step)
{
    return step->config->path_tolerance > 0 && is_driven(step) && !(step->input->flags & TAHR_INPUT_DRIVE_LEVEL) &&
           step->config->integrator == TAHR_INTEGRATOR_EXACT;
}

/* Along walls what they leave of the wish is asked for, as in walking. g: NULL: there are none. */
static tahr__law law_of(const tahr__step *step, const tahr__glide *g)
{
    const tahr_config *c = step->config;
    vec3 wish = step->input->move;
    double size = length(wish), stick = min_of(size, 1), kept = 1;
    if (size > 0 && g && g->plane_count > 0) {
        wish = tahr__glide_bend(g, wish);
        kept = length(wish) / size;
    }
    tahr__law law = {.wish = unit(wish),
                     .speed = c->fly_speed * stick * kept,
                     .acceleration = c->acceleration * kept,
                     .turn_friction = c->turn_friction,
                     .braking = c->fly_drag * HOVERS,
                     .drag = c->fly_drag};
    return law;
}

/* Of a piece, when a part of it was covered. */
static double time_of_part(const tahr__law *law, vec3 v, double piece, vec3 whole, double part)
{
    if (part <= 0 || part >= 1 || length_squared(whole) == 0) {
        return part <= 0 ? 0 : piece;
    }
    return dot(v, whole) < 0 && part * part * length_squared(whole) < 1e-10
               ? 0 /* touched before it turned round */
               : tahr__law_time(law, v, piece, whole, part);
}

/* STEPPED: one velocity for all of it. */
static tahr__motion stepped(const tahr__step *step, const tahr__law *law, vec3 v, double t)
{
    tahr__law push = *law;
    push.acceleration *= min_of(length(step->input->move), 1); /* half a stick is half the acceleration too */
    push.braking = 0;
    push.turn_friction = 0.5 * law->drag; /* half of the friction turns, all of it brakes, the air takes its half too */
    vec3 then = tahr__calc_velocity(step->config, &push, 0.5 * law->drag, v, t);
    tahr__motion m = {scale(then, t), then, -1};
    return m;
}

/* An edge or something round that was met: whether it is gone around. Returns the velocity that is left. */
static vec3 look_around(const tahr__step *step, tahr__glide *g, const tahr__law *law, vec3 v)
{
    double glimpse = TAHR__GLIMPSE * g->left;
    if (holds_drive(step)) {
        tahr__around_drive(step, &g->around, step->input->drive, v, g->left);
        return v;
    }
    const tahr__law open = law_of(step, NULL);
    vec3 freely = tahr__law_advance(&open, v, glimpse).displacement;
    vec3 along = tahr__glide_bend(g, tahr__law_advance(law, v, g->left).displacement);
    double longest = tahr__around_longest(&open, length(v), g->left);
    tahr__around_start(step, &g->around, &(tahr__ahead){v, along, freely, longest, g->left});
    return tahr__around_hold(&g->around, g->around.normal, v);
}

/* A piece: straight, by its law. */
typedef struct piece {
    tahr__law law;
    vec3 velocity, way; /* at its begin; m */
    double time;
    vec3 end; /* STEPPED: the velocity of all of it */
    int driven;
} piece;

/* s of a piece until that part of its way is made. Sets the velocity of then. */
static double reach(tahr__step *step, const tahr__glide *g, const piece *p, double part)
{
    if (step->config->integrator == TAHR_INTEGRATOR_STEPPED) {
        step->state.velocity = p->end;
        return p->time * part;
    }
    double used = p->driven ? tahr__around_time(&g->around, p->time, part)
                            : time_of_part(&p->law, p->velocity, p->time, p->way, part);
    step->state.velocity = tahr__law_advance(&p->law, p->velocity, used).velocity;
    return used;
}

/* On from what stopped the piece after `used` seconds. Returns 0 if nothing can. */
static int go_on(tahr__step *step, tahr__glide *g, const piece *p, const tahr_hit *hit, double used)
{
    if (hit->start_overlap || hit->unknown) {
        return 0;
    }
    const double rest = 1 - hit->fraction, covered = tahr__glide_step_up(step, g, hit, scale(p->way, rest), NULL);
    if (covered > 0) {
        tahr__glide_use(step, g, max_of(reach(step, g, p, hit->fraction + covered * rest) - used, 0));
        tahr__glide_forget_floor(step);
        return 1;
    }
    return tahr__glide_meet(step, g, hit);
}

/* One piece of the slice. Returns 0 if nothing can go on from where it ended. */
static int fly_piece(tahr__step *step, tahr__glide *g)
{
    tahr_hit hit;
    piece p;
    p.driven = holds_drive(step);
    p.velocity = tahr__glide_bend(g, p.driven ? step->input->drive : step->state.velocity);
    p.law = p.driven ? drive_law(p.velocity) : law_of(step, g);
    if (g->around.is_round || g->around.turns) {
        p.velocity = look_around(step, g, &p.law, p.velocity);
    }
    p.time = tahr__glide_piece(step, g, tahr__law_bending(&p.law, p.velocity));
    tahr__motion m = step->config->integrator == TAHR_INTEGRATOR_STEPPED
                         ? stepped(step, &p.law, p.velocity, p.time)
                         : tahr__law_advance(&p.law, p.velocity, p.time);
    p.way = tahr__glide_bend(g, p.driven ? tahr__around_way(&g->around, p.velocity, p.time) : m.displacement);
    p.end = step->state.velocity = m.velocity;
    if (length_squared(p.way) == 0) {
        tahr__glide_use(step, g, p.time);
        return 1;
    }
    if (step->config->slide_solver == TAHR_SLIDE_TWO_WALLS) {
        const tahr__glide_motion whole = {p.way, p.time, NULL};
        if (tahr__glide_two_walls(step, g, &whole, &hit)) {
            tahr__glide_forget_floor(step);
        }
        return !hit.unknown && !hit.start_overlap;
    }
    step->just_teleported |= (uint32_t)tahr__move(step, p.way, &hit);
    if (hit.blocking) {
        const double used = reach(step, g, &p, hit.fraction);
        tahr__glide_use(step, g, used);
        return go_on(step, g, &p, &hit, used);
    }
    if (m.stop_time >= 0) {
        step->ahead = m.stop_time;
        tahr__event(step, TAHR_EVENT_STOPPED, NULL, 0);
        step->ahead = 0;
    }
    tahr__glide_pass(step, g, p.time);
    return 1;
}

tahr__next tahr__fly(tahr__step *step, double time)
{
    tahr__glide g;
    tahr__next next = {TAHR_MODE_FLYING, 0};
    tahr__glide_begin(step, &g, time);
    while (tahr__glide_goes_on(step, &g) && fly_piece(step, &g)) {
    }
    tahr__glide_end(step, &g);
    return next;
}

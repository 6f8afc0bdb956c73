/* SPDX-License-Identifier: MIT
 * flying.c: one slice of flying: the law of walking in three dimensions, without gravity. */
#include "flying.h"

#include "glide.h"
#include "move.h"
#include "report.h"

/* m/s: a drag alone never ends. A deceleration of the drag at this speed does, at the same time at every frame rate. */
static const double HOVERS = 1e-3;

/* Along walls what they leave of the wish is asked for, as in walking. */
static tahr__law law_of(const tahr__step *step, const tahr__glide *g)
{
    const tahr_config *c = step->config;
    vec3 wish = step->input->move;
    double size = length(wish), stick = min_of(size, 1), kept = 1;
    if (size > 0 && g->plane_count > 0) {
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

/* The most that the velocity changes by, in a second: bounds how far a chord lies off the path. */
static double bending(const tahr__law *law, vec3 v)
{
    vec3 across = reject(v, law->wish);
    return law->speed > 0 ? law->acceleration + law->turn_friction * length(across) : 0;
}

/* Of a piece, when a part of it was covered. */
static double time_of_part(const tahr__law *law, vec3 v, double piece, vec3 whole, double part)
{
    if (part <= 0 || part >= 1 || length_squared(whole) == 0) {
        return part <= 0 ? 0 : piece;
    }
    return dot(v, whole) < 0 && part * part * length_squared(whole) < 1e-10 ? 0 /* touched before it turned round */
                                                                            : tahr__law_time(law, v, piece, whole, part);
}

tahr__next tahr__fly(tahr__step *step, double time)
{
    tahr__glide g;
    tahr_hit hit;
    tahr__next next = {TAHR_MODE_FLYING, 0};
    tahr__glide_begin(step, &g, time);
    while (tahr__glide_goes_on(step, &g)) {
        vec3 v = tahr__glide_bend(&g, step->state.velocity);
        tahr__law law = law_of(step, &g);
        double piece = tahr__glide_piece(step, &g, bending(&law, v));
        tahr__motion m = tahr__law_advance(&law, v, piece);
        vec3 way = tahr__glide_bend(&g, m.displacement);
        if (length_squared(way) == 0) {
            step->state.velocity = m.velocity;
            tahr__glide_use(step, &g, piece);
            continue;
        }
        tahr__move(step, way, &hit);
        double used = hit.blocking ? time_of_part(&law, v, piece, way, hit.fraction) : piece;
        step->state.velocity = used < piece ? tahr__law_advance(&law, v, used).velocity : m.velocity;
        tahr__glide_use(step, &g, used);
        if (hit.blocking && !tahr__glide_meet(step, &g, &hit, scale(way, 1 - hit.fraction))) {
            break;
        }
    }
    tahr__glide_end(step, &g);
    return next;
}

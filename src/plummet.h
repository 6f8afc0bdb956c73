/* SPDX-License-Identifier: MIT
 * plummet.h: a rise or a fall in free air. See short_way.h. */
#ifndef TAHR_PLUMMET_H
#define TAHR_PLUMMET_H

#include "falling.h"
#include "ready.h"
#include "short_way.h"

/* m/s, squared: faster than this a fall is capped (mover.c). */
static const double FASTEST2 = 1e10;

/* Of a button that is down. */
enum { PRESSED = TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMP_SPENT };

/* A flight so far. */
typedef struct flight {
    vec3 position, velocity;
    uint32_t flags, chords, apexes;
} flight;

/* What gravity makes of it now, as tahr__gravity_factor (jump.c) says. */
static inline const tahr__weight *weight_of(const tahr__dive *dive, double rise, uint32_t flags, uint32_t jump)
{
    if (rise <= dive->hover) {
        return &dive->falling;
    }
    return flags & TAHR_STATE_JUMPING && !(jump && flags & TAHR_STATE_JUMP_SPENT) ? &dive->released : &dive->rising;
}

/* Does all of a motion lie where nothing is, as far as a backend has told? A ball holds the way between two places that
 * it holds. */
static inline int is_in_clear(const tahr_mover *mover, vec3 from, vec3 to)
{
    const tahr__clear *clear = &mover->dive.clear;
    return clear->ground == mover->world->ground && length_squared(sub(from, clear->at)) <= clear->far2 &&
           length_squared(sub(to, clear->at)) <= clear->far2;
}

/* Field by field: compilers clear what is left out with a slow string instruction. */
static inline int is_known_free(tahr_mover *mover, vec3 from, vec3 motion, vec3 up, tahr_query_context *context)
{
    tahr_walk walk;
    tahr_hit none;
    uint32_t known = TAHR_WALK_UNKNOWN;
    walk.shape = &mover->limits.shape;
    walk.foot = NULL;
    walk.position = walk.foot_position = from;
    walk.motion = walk.foot_motion = motion;
    walk.up = up;
    walk.margin = mover->pace.skin;
    walk.mask = mover->pace.mask;
    walk.reserved = 0;
    none.distance = 0;
    if (mover->world->backend->walk(mover->world->self, context, &walk, &none, &known) != TAHR_OK ||
        known != TAHR_WALK_KNOWN) {
        return 0;
    }
    if (none.distance > 0) {
        mover->dive.clear = (tahr__clear){from, none.distance * none.distance, mover->world->ground};
    }
    return 1;
}

static inline int is_free(tahr_mover *mover, vec3 from, vec3 motion, vec3 to, vec3 up, tahr_query_context *context)
{
    if (is_in_clear(mover, from, to)) {
        context->spared++;
        return 1;
    }
    return is_known_free(mover, from, motion, up, context);
}

/* Across up, as falling.c's arc_at. Without a wish, and with nothing to brake, there is nothing to work out. */
static inline tahr__motion drift(tahr__dive *dive, vec3 level, double t)
{
    tahr__law *law = &dive->law;
    if (!dive->wishes && level.x == 0 && level.y == 0 && level.z == 0) {
        return (tahr__motion){level, level, -1};
    }
    decay_learn(&law->decay, law->turn_friction, t);
    return law_advance(law, dive->wishes != 0, level, t);
}

/* Almost every step: one chord, no apex on it, and an up whose x and y are 0 and need not be multiplied with. */
static inline int drop(tahr_mover *mover, double dt, const tahr_state *s, double gravity, flight *f,
                       tahr_query_context *context)
{
    tahr__dive *dive = &mover->dive;
    double fall;
    const tahr__motion m = drift(dive, vec(s->velocity.x, s->velocity.y, 0), dt);
    const double way = fall_for(s->velocity.z, gravity, dive->terminal, dt, &fall);
    const vec3 motion = vec(m.displacement.x, m.displacement.y, way), to = add(s->position, motion);
    *f = (flight){to, vec(m.velocity.x, m.velocity.y, fall), s->flags, 1, 0};
    return is_free(mover, s->position, motion, to, s->up, context);
}

/* One chord, as falling.c's fall_chord cuts it. Returns the s of it; 0: it is not known to be free. */
static inline double fly(tahr_mover *mover, flight *f, uint32_t jump, double left, vec3 up, tahr_query_context *context)
{
    tahr__dive *dive = &mover->dive;
    const double rise = dot(f->velocity, up);
    const tahr__weight *weight = weight_of(dive, rise, f->flags, jump);
    const double apex = rise > 1e-9 * weight->gravity ? rise / weight->gravity : 0;
    double t = min_of(left, weight->chord), fall;
    const int meets_apex = apex > 0 && apex <= t;
    if (meets_apex) {
        t = apex;
    } else if (left > t) {
        t = left / (double)(int)(left / t + 1);
    }
    const double way = fall_for(rise, weight->gravity, dive->terminal, t, &fall);
    const tahr__motion m = drift(dive, add_scaled(f->velocity, up, -rise), t);
    const vec3 motion = add_scaled(m.displacement, up, way), to = add(f->position, motion);
    if (!is_free(mover, f->position, motion, to, up, context)) {
        return 0;
    }
    f->position = to;
    f->velocity = add_scaled(m.velocity, up, fall);
    if (meets_apex) {
        f->velocity = reject(f->velocity, up);
        f->flags &= ~(uint32_t)TAHR_STATE_JUMPING;
        f->apexes++;
    }
    f->chords++;
    return t;
}

static inline int fly_all(tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *s, flight *f,
                          tahr_query_context *context)
{
    double used = 1;
    *f = (flight){s->position, s->velocity, s->flags, 0, 0};
    for (double left = dt; left >= 1e-12 && used > 0; left -= used) { /* less is rounding */
        used = fly(mover, f, input->jump, left, s->up, context);
    }
    return used > 0;
}

/* How the input's wish is approached. */
static inline void learn_wish(tahr_mover *mover, const tahr_input *input)
{
    tahr__dive *dive = &mover->dive;
    if (other_bits(&dive->asked.move, &input->move)) {
        const tahr__decay known = dive->law.decay;
        dive->law = tahr__arc_law(&mover->config, reject(input->move, mover->pace.held.up));
        dive->law.decay = known;
        dive->wishes = (uint32_t)law_wishes(&dive->law);
        dive->asked.move = input->move;
    }
}

/* What is as it was where it was ready; and remembers it. */
static inline void write_flight(tahr_mover *mover, tahr_state *s, uint32_t jump, double dt)
{
    tahr__clean_state(s, s);
    mover->pace.held.orientation = s->orientation;
    mover->dive.asked.dt = dt;
    mover->dive.asked.jump = jump;
    mover->dive.odd_flags = odd_flags(&mover->dive, jump);
    mover->dive.held_flags = held_flags(&mover->dive, jump);
}

/* Is all of the step one chord, and no apex on it? upright: up is +z. */
static inline int is_simple(const tahr__weight *weight, int upright, double rise, double dt)
{
    return dt <= weight->chord && upright && (rise <= 0 || rise > dt * weight->gravity * (1 + 1e-9));
}

/* May it be a flight at all? */
static inline int is_flight(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *s)
{
    const tahr__dive *dive = &mover->dive;
    return dt > TAHR__SHORTEST && dt <= dive->longest && !other_bits(&s->up, &mover->pace.held.up) &&
           (s->flags & odd_flags(dive, input->jump)) == held_flags(dive, input->jump);
}

/* tahr__plummet. ready: as ready_to_fall says. */
static inline int plummet(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report,
                          int ready)
{
    tahr_query_context context = {.cache = mover->cache};
    flight f;
    if (!ready) {
        if (!is_flight(mover, input, dt, state)) {
            return 0;
        }
        learn_wish(mover, input);
    }
    const double rise = state->velocity.z;
    const tahr__weight *weight = weight_of(&mover->dive, rise, state->flags, input->jump);
    const int done = is_simple(weight, ready || mover->pace.upright, rise, dt)
                         ? drop(mover, dt, state, weight->gravity, &f, &context)
                         : fly_all(mover, input, dt, state, &f, &context);
    const int rests = f.position.z == state->position.z && vec_equal(f.position, state->position);
    if (!done || rests || length_squared(f.velocity) > FASTEST2 || (f.apexes > 0 && report && report->events) ||
        goes_astray(mover, f.position)) {
        return 0;
    }
    state->position = clean(f.position);
    state->velocity = clean(f.velocity);
    state->flags = input->jump ? f.flags | TAHR_STATE_JUMP_HELD : f.flags & ~(uint32_t)PRESSED;
    state->floor_position = clean(state->floor_position);
    if (!ready) {
        write_flight(mover, state, input->jump, dt);
    }
    tahr__report_short_way(report, f.chords, TAHR_SHORTCUT_CLEAR_AIR, &context);
    return 1;
}

#endif

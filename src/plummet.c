/* SPDX-License-Identifier: MIT
 * plummet.c: a rise or a fall in free air. See short_way.h. */
#include "falling.h"
#include "short_way.h"
#include "turning.h"

/* m/s, squared: faster than this a fall is capped (mover.c). */
static const double FASTEST2 = 1e10;

/* Of an arc that falling.c cuts into more chords than this the long way is no detour: 10 Hz are 5 at most. */
enum { MOST_CHORDS = 6 };

/* What a flight remembers: of buttons that do nothing in the air without the settings under "Feel". */
enum { REMEMBERED = TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMPING | TAHR_STATE_FLOOR_MOVED };

/* A flight so far. */
typedef struct flight {
    vec3 position, velocity;
    vec3 up;
    int upright; /* up is exactly +z: what is 0 of it need not be multiplied with */
    int met_apex;
    uint32_t chords;
} flight;

static double along_up(const flight *f, vec3 v)
{
    return f->upright ? v.z : dot(v, f->up);
}

static vec3 across_up(const flight *f, vec3 v, double along)
{
    return f->upright ? vec(v.x, v.y, 0) : add_scaled(v, f->up, -along);
}

static vec3 lifted(const flight *f, vec3 v, double along)
{
    return f->upright ? vec(v.x, v.y, v.z + along) : add_scaled(v, f->up, along);
}

/* s of the next chord, as falling.c's fall_chord cuts it. */
static double next_chord(const tahr__limits *limits, double rise, double left, int *reaches_apex)
{
    const double gravity = limits->pull.size, most = limits->arc.chord;
    const double apex = rise > 1e-9 * gravity ? rise / gravity : 0;
    const double duration = min_of(left, most);
    *reaches_apex = apex > 0 && apex <= duration;
    if (*reaches_apex) {
        return apex;
    }
    return left > duration ? left / (double)(int)(left / duration + 1) : duration;
}

/* Without a wish nothing changes a velocity across up, and often there is none. */
static inline tahr__motion drift(const tahr__law *law, vec3 level, double t)
{
    tahr__motion rest = {{0, 0, 0}, level, -1};
    return law->speed > 0 || length_squared(level) > 0 ? tahr__law_advance(law, level, t) : rest;
}

/* Does all of a motion lie where nothing is, as far as a backend has told? */
static int is_in_clear(const tahr_mover *mover, vec3 from, vec3 to)
{
    const tahr__clear *clear = &mover->clear;
    return clear->revision == mover->world->revision && length_squared(sub(from, clear->at)) <= clear->far2 &&
           length_squared(sub(to, clear->at)) <= clear->far2;
}

/* Is it known that nothing is in the way? */
static int is_free(tahr_mover *mover, const flight *f, vec3 motion, vec3 to, tahr_query_context *context)
{
    const tahr_walk walk = {.shape = &mover->limits.shape,
                            .position = f->position,
                            .motion = motion,
                            .up = f->up,
                            .margin = mover->config.skin,
                            .mask = mover->config.mask};
    tahr_hit none;
    uint32_t known = 0;
    if (is_in_clear(mover, f->position, to)) {
        context->spared++;
        return 1;
    }
    none.distance = 0;
    if (mover->world->backend->walk(mover->world->self, context, &walk, &none, &known) != TAHR_OK || !known) {
        return 0;
    }
    if (none.distance > 0) {
        mover->clear = (tahr__clear){f->position, none.distance * none.distance, mover->world->revision};
    }
    return 1;
}

/* One chord. Returns the s of it; 0: it is not known to be free. */
static double fly(tahr_mover *mover, const tahr__law *law, flight *f, double left, tahr_query_context *context)
{
    int reaches_apex;
    double fall;
    const double gravity = mover->limits.pull.size, rise = along_up(f, f->velocity);
    const double t = next_chord(&mover->limits, rise, left, &reaches_apex);
    const double way = tahr__fall_advance(rise, gravity, mover->config.terminal_speed, 0, t, &fall);
    const tahr__motion m = drift(law, across_up(f, f->velocity, rise), t);
    const vec3 motion = lifted(f, m.displacement, way), to = add(f->position, motion);
    if (!is_free(mover, f, motion, to, context)) {
        return 0;
    }
    f->position = to;
    f->velocity = lifted(f, m.velocity, fall);
    if (reaches_apex) {
        f->velocity = across_up(f, f->velocity, along_up(f, f->velocity));
        f->met_apex = 1;
    }
    return t;
}

static int is_such(const tahr_mover *mover, double dt, const tahr_state *s)
{
    return dt > TAHR__SHORTEST && mover->limits.pull.size > 1e-6 && dt <= MOST_CHORDS * mover->limits.arc.chord &&
           !(s->flags & ~(uint32_t)REMEMBERED) && is_against_gravity(&mover->limits.pull, s->up);
}

int tahr__plummet(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    const vec3 up = state->up;
    flight f = {state->position, state->velocity, up, up.z == 1 && up.x == 0 && up.y == 0, 0, 0};
    if (!is_such(mover, dt, state)) {
        return 0;
    }
    const tahr__law law = tahr__arc_law(&mover->config, across_up(&f, input->move, along_up(&f, input->move)));
    tahr_query_context context = {.cache = mover->cache};
    for (double left = dt; left >= 1e-12; f.chords++) { /* less is rounding */
        const double used = fly(mover, &law, &f, left, &context);
        if (used == 0) {
            return 0;
        }
        left -= used;
    }
    if ((f.met_apex && report && report->events) || length_squared(f.velocity) > FASTEST2 ||
        vec_equal(f.position, state->position) || goes_astray(mover, f.position)) {
        return 0;
    }
    state->position = f.position;
    state->velocity = f.velocity;
    state->flags &= ~(uint32_t)(TAHR_STATE_JUMP_HELD | (f.met_apex ? TAHR_STATE_JUMPING : 0));
    state->flags |= input->jump ? TAHR_STATE_JUMP_HELD : 0u;
    tahr__clean_state(state, state);
    tahr__report_short_way(report, f.chords, &context);
    return 1;
}

/* SPDX-License-Identifier: MIT
 * plummet.c: a fall in free air. See short_way.h. */
#include "falling.h"
#include "short_way.h"
#include "turning.h"

/* m/s, squared: faster than this a fall is capped (mover.c). */
static const double FASTEST2 = 1e10;

/* Over the whole step one chord, past the apex: falling.c's fall_chord cuts what is longer. */
static int is_one_chord(const tahr_config *c, double gravity, double rise, double dt)
{
    return gravity > 1e-6 && rise <= 1e-9 * gravity && dt <= sqrt(8 * c->arc_tolerance / gravity);
}

int tahr__plummet(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    const tahr_config *c = &mover->config;
    const vec3 axis = state->up;
    const double gravity = mover->limits.pull.size, rise = dot(state->velocity, axis);
    if (dt <= TAHR__SHORTEST || !is_one_chord(c, gravity, rise, dt) || !is_against_gravity(&mover->limits.pull, axis)) {
        return 0;
    }
    const tahr__law law = tahr__arc_law(c, reject(input->move, axis));
    double fall;
    const double drop = tahr__fall_advance(rise, gravity, c->terminal_speed, 0, dt, &fall);
    const tahr__motion m = tahr__law_advance(&law, add_scaled(state->velocity, axis, -rise), dt);
    const vec3 velocity = add_scaled(m.velocity, axis, fall);
    const tahr_walk walk = {.shape = &mover->limits.shape,
                            .position = state->position,
                            .motion = add_scaled(m.displacement, axis, drop),
                            .up = axis,
                            .margin = c->skin,
                            .mask = c->mask};
    const vec3 position = add_scaled(state->position, walk.motion, 1);
    tahr_query_context context = {.cache = mover->cache};
    tahr_hit none;
    uint32_t known = 0;
    if (mover->world->backend->walk(mover->world->self, &context, &walk, &none, &known) != TAHR_OK || !known ||
        length_squared(velocity) > FASTEST2 || vec_equal(position, state->position) || goes_astray(mover, position)) {
        return 0;
    }
    state->position = position;
    state->velocity = velocity;
    tahr__clean_state(state, state);
    tahr__report_short_way(report, 1, &context);
    return 1;
}

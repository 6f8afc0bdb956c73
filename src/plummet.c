/* SPDX-License-Identifier: MIT
 * plummet.c: a rise or a fall in free air. See short_way.h. */
#include "plummet.h"

static tahr__weight weight(const tahr_config *c, double gravity)
{
    return (tahr__weight){gravity, gravity > 0 ? sqrt(8 * c->arc_tolerance / gravity) : 0};
}

tahr__dive tahr__dive_of(const tahr_config *c, const tahr__limits *limits)
{
    const double gravity = limits->pull.size;
    tahr__dive dive = {.asked = {.struct_size = sizeof(tahr_input), .dt = c->max_dt},
                       .presses = (limits->feel & TAHR__FEEL_JUMPS) != 0,
                       .rising = weight(c, gravity),
                       .released = weight(c, gravity * c->jump_release_gravity),
                       .falling = weight(c, gravity * c->fall_gravity),
                       .hover = 1e-9 * gravity,
                       .terminal = c->terminal_speed,
                       .law = tahr__arc_law(c, vec(0, 0, 0))};
    const double chord = min_of(min_of(dive.rising.chord, dive.released.chord), dive.falling.chord);
    dive.longest = gravity > 1e-6 ? TAHR__MOST_CHORDS * chord : 0;
    dive.held_flags = 1; /* and none that is odd: nothing is ready yet */
    return dive;
}

int tahr__plummet(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    return plummet(mover, input, dt, state, report, 0);
}

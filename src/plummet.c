/* SPDX-License-Identifier: MIT
 * plummet.c: a rise or a fall in free air. See short_way.h. */
#include "plummet.h"

tahr__dive tahr__dive_of(const tahr_config *c, const tahr__limits *limits)
{
    const double gravity = limits->pull.size;
    tahr__dive dive = {.asked = {.struct_size = sizeof(tahr_input), .dt = c->max_dt},
                       .gravity = gravity,
                       .terminal = c->terminal_speed,
                       .law = tahr__arc_law(c, vec(0, 0, 0))};
    dive.chord = gravity > 0 ? sqrt(8 * c->arc_tolerance / gravity) : 0;
    dive.longest = gravity > 1e-6 ? TAHR__MOST_CHORDS * dive.chord : 0;
    return dive;
}

int tahr__plummet(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    return plummet(mover, input, dt, state, report, 0);
}

/* SPDX-License-Identifier: MIT
 * crowd_rest.c: who of a crowd sleeps, on any processor; and how that is noted. */
#include "crowd_rest.h"

uint32_t tahr__rests(const tahr__tick *t, uint32_t begin, uint32_t end)
{
    return rests_among(t, begin, end);
}

uint8_t tahr__rest_note(tahr__rest *rest, const tahr_mover *mover, const tahr_member *member)
{
    const tahr__sleep *s = &mover->sleep;
    const tahr_state *state = &s->state;
    if (s->noted != 1 || !s->blank || s->input.struct_size != sizeof s->input || s->input.flags != 0 ||
        memcmp(&state->radius, &mover->pace.bare, sizeof mover->pace.bare) != 0 ||
        (other_floor(state, mover->world) | other_bits(&state->floor_position, &state->position))) {
        return 0;
    }
    memcpy(rest->head, &s->input, sizeof rest->head);
    memcpy(rest->state, state, sizeof rest->state);
    return member ? TAHR__RESTS : TAHR__RESTS | TAHR__RESTS_PLAIN;
}

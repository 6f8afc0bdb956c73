/* SPDX-License-Identifier: MIT
 * same.h: is a state still the one that was noted, byte for byte? What a sleeping character costs is mostly this. */
#ifndef TAHR_SAME_H
#define TAHR_SAME_H

#include <string.h>

#include "core.h"

/* 1: this processor has 32-byte vectors, and this library functions that use them. */
uint8_t tahr__is_wide(void);

/* With them; only where it has. */
int tahr__same_wide(const tahr__sleep *s, const tahr_state *state);

/* What state remembered, and more. */
static inline const tahr_state *noted_memory(const tahr__sleep *s)
{
    return s->blank ? &tahr__blank : &s->state;
}

static inline int same_state(const tahr__sleep *s, const tahr_state *state)
{
    const size_t memory = offsetof(tahr_state, base);
    return s->wide ? tahr__same_wide(s, state)
                   : memcmp(state, &s->state, memory) == 0 &&
                         memcmp((const char *)state + memory, (const char *)noted_memory(s) + memory,
                                sizeof *state - memory) == 0;
}

/* tahr__step_noted on such a processor, after a step of who remembers nothing, with an input of this version
 * and without flags. */
tahr_status tahr__step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report);

#endif

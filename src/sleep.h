/* SPDX-License-Identifier: MIT
 * sleep.h: a step that left everything as it was is not computed again. */
#ifndef TAHR_SLEEP_H
#define TAHR_SLEEP_H

#include <string.h>

#include "core.h"
#include "same.h"

/* tahr_mover_step for who does not sleep; input and state are not NULL. */
tahr_status tahr__step_awake(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report);

/* tahr_world_revision. */
static inline uint64_t world_revision(const tahr_world *world)
{
    return world->revision + world->motion;
}

/* 0 if two inputs wish the same. Without a flag none of the optional fields counts. b: of a step that was taken. */
static inline uint64_t other_wishes(const tahr_input *a, const tahr_input *b)
{
    const size_t head = offsetof(tahr_input, facing);
    const uint64_t other = (a->struct_size ^ b->struct_size) | (a->flags ^ b->flags) | (a->jump ^ b->jump) |
                           (a->crouch ^ b->crouch) | other_bits(&a->move, &b->move);
    return other | (a->flags == 0 ? a->reserved
                                  : memcmp((const char *)a + head, (const char *)b + head, sizeof *a - head) != 0);
}

/* Would a step with these arguments, none of them NULL, repeat the one that was noted? Nothing is noted while a step is
 * under way. Of an input only what this version knows is looked at. */
static inline int sleeps_on(const tahr__sleep *s, uint64_t revision, const tahr_input *input, double dt,
                            const tahr_state *state)
{
    const uint64_t other = (bits_of(dt) ^ bits_of(s->dt)) | (revision ^ s->revision) | other_wishes(input, &s->input);
    return other == 0 && s->noted && same_state(s, state);
}

/* tahr_mover_step for who may sleep: input and state are not NULL, and a step is noted. */
tahr_status tahr__step_noted(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report);

/* The same where all else than the report is known to be so. */
tahr_status tahr__step_same(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report);

/* That repetition, of who is known to sleep on: writes report, which may be NULL and is otherwise in order, and status.
 * Returns 0, and writes nothing, if the report asks for what was not noted. */
int tahr__sleep_again(const tahr__sleep *sleep, tahr_report *report, tahr_status *status);

/* What a step with a report of these flags returns. */
tahr_status tahr__step_status(uint32_t flags);

/* Notes a step that changed no bit of the state; the last one has been forgotten when this one began. state: as it is
 * now; changed: is it another one than before the step? */
void tahr__sleep_note(tahr_mover *mover, const tahr__step *step, double dt, const tahr_state *state, int changed);

#endif

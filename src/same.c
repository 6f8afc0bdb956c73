/* SPDX-License-Identifier: MIT
 * same.c: is a state still the one that was noted? All bytes at once, in one branch: nearly always it is. */
#include "same.h"

#include "sleep.h"

#if defined(__GNUC__) && defined(__x86_64__)

uint8_t tahr__is_wide(void)
{
    return __builtin_cpu_supports("avx2") != 0;
}

#include "avx2_begin.h"

#define TAHR__WIDE_WORDS
#include "words.h"

/* All bits that differ; memory: what the state remembered. */
static inline tahr__words other_state(const tahr__sleep *s, const tahr_state *memory, const tahr_state *state)
{
    /* From where on the state is compared with what nobody remembers; a little of that lies before. */
    enum { STEP = sizeof(tahr__words), CUT = (offsetof(tahr_state, base) + STEP - 1) / STEP * STEP };
    return words_or(other_words(state, &s->state, CUT),
                    other_words((const char *)state + CUT, (const char *)memory + CUT, sizeof *state - CUT));
}

int tahr__same_wide(const tahr__sleep *s, const tahr_state *state)
{
    return words_are_zero(other_state(s, noted_memory(s), state));
}

/* What is rarer goes the general way. */
tahr_status tahr__step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report)
{
    const tahr__sleep *s = &mover->sleep;
    const tahr_world *world = mover->world;
    _Static_assert(offsetof(tahr_input, move.z) == sizeof(tahr__words), "the rest of a wish");
    const uint64_t odd = (bits_of(dt) ^ bits_of(s->dt)) | (world_revision(world) ^ s->revision) |
                         (bits_of(input->move.z) ^ bits_of(s->input.move.z)) | input->reserved |
                         (uint64_t)(uintptr_t)world->recording | (uint64_t)(uintptr_t)mover->company;
    if (odd != 0) {
        return tahr__step_noted(mover, input, dt, state, report);
    }
    static const tahr_state blank = TAHR__BLANK; /* known here: most of it is zero, and need not be read */
    const tahr__words wish = words_xor(words_at(input, 0), words_at(&s->input, 0));
    if (!words_are_zero(words_or(other_state(s, &blank, state), wish))) {
        return tahr__step_noted(mover, input, dt, state, report);
    }
    return !report && s->noted == 1 ? s->status : tahr__step_same(mover, input, dt, state, report);
}

#include "avx2_end.h"

#else

uint8_t tahr__is_wide(void)
{
    return 0;
}

int tahr__same_wide(const tahr__sleep *s, const tahr_state *state)
{
    (void)s, (void)state;
    return 0;
}

tahr_status tahr__step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report)
{
    return tahr__step_noted(mover, input, dt, state, report);
}

#endif

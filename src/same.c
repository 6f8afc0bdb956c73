/* SPDX-License-Identifier: MIT
 * same.c: is a state still the one that was noted? All bytes at once, in one branch: nearly always it is. */
#include "same.h"

#include "sleep.h"

#ifdef TAHR__HAS_WIDE

#define WIDE __attribute__((target("avx2")))

typedef long long words __attribute__((vector_size(32)));

/* CUT: from where on the state is compared with what nobody remembers; a little of that lies before. */
enum { STEP = sizeof(words), CUT = (offsetof(tahr_state, base) + STEP - 1) / STEP * STEP };

uint8_t tahr__is_wide(void)
{
    return __builtin_cpu_supports("avx2") != 0;
}

WIDE static inline words load(const void *from, size_t at)
{
    words w;
    memcpy(&w, (const char *)from + at, sizeof w);
    return w;
}

/* All bits that differ; memory: what the state remembered. */
WIDE static inline words other_state(const tahr__sleep *s, const tahr_state *memory, const tahr_state *state)
{
    words other = {0, 0, 0, 0};
#if !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (size_t at = 0; at < CUT; at += STEP) {
        other |= load(state, at) ^ load(&s->state, at);
    }
#if !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (size_t at = CUT; at < sizeof *state; at += STEP) {
        other |= load(state, at) ^ load(memory, at);
    }
    return other;
}

WIDE static inline int is_zero(words w)
{
    return __builtin_ia32_ptestz256(w, w);
}

WIDE int tahr__same_wide(const tahr__sleep *s, const tahr_state *state)
{
    return is_zero(other_state(s, noted_memory(s), state));
}

/* What is rarer goes the general way. */
WIDE tahr_status tahr__step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                 tahr_report *report)
{
    const tahr__sleep *s = &mover->sleep;
    const tahr_world *world = mover->world;
    _Static_assert(offsetof(tahr_input, move.z) == STEP, "the rest of a wish");
    const uint64_t odd = (bits_of(dt) ^ bits_of(s->dt)) | (world_revision(world) ^ s->revision) |
                         (bits_of(input->move.z) ^ bits_of(s->input.move.z)) | input->reserved |
                         (uint64_t)(uintptr_t)world->recording | (uint64_t)(uintptr_t)mover->company;
    if (odd != 0) {
        return tahr__step_noted(mover, input, dt, state, report);
    }
    static const tahr_state blank = TAHR__BLANK; /* known here: most of it is zero, and need not be read */
    const words other = other_state(s, &blank, state) | (load(input, 0) ^ load(&s->input, 0));
    if (!is_zero(other)) {
        return tahr__step_noted(mover, input, dt, state, report);
    }
    return !report && s->noted == 1 ? s->status : tahr__step_same(mover, input, dt, state, report);
}

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

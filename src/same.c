/* SPDX-License-Identifier: MIT
 * same.c: is a state still the one that was noted? All bytes at once, in one branch: nearly always it is. */
#include "same.h"

#include "sleep.h"

#ifdef TAHR__HAS_WIDE

#include <immintrin.h>

#define WIDE __attribute__((target("avx2")))

enum { MEMORY = offsetof(tahr_state, base), STEP = sizeof(__m256i) };

_Static_assert(MEMORY % STEP == STEP / 2 && sizeof(tahr_state) % STEP == 0, "cut in the middle of a vector");

uint8_t tahr__is_wide(void)
{
    return __builtin_cpu_supports("avx2") != 0;
}

WIDE static inline __m256i load(const void *from, size_t at)
{
    return _mm256_loadu_si256((const __m256i *)(const void *)((const char *)from + at));
}

WIDE static inline __m256i half(const void *from, size_t at)
{
    return _mm256_zextsi128_si256(_mm_loadu_si128((const __m128i *)(const void *)((const char *)from + at)));
}

/* All bits that differ. */
WIDE static inline __m256i other_state(const tahr__sleep *s, const tahr_state *state)
{
    const tahr_state *memory = noted_memory(s);
    __m256i other = _mm256_xor_si256(half(state, MEMORY - STEP / 2), half(&s->state, MEMORY - STEP / 2));
    other = _mm256_or_si256(other, _mm256_xor_si256(half(state, MEMORY), half(memory, MEMORY)));
#if !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (size_t at = 0; at + STEP <= MEMORY; at += STEP) {
        other = _mm256_or_si256(other, _mm256_xor_si256(load(state, at), load(&s->state, at)));
    }
#if !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (size_t at = MEMORY + STEP / 2; at < sizeof *state; at += STEP) {
        other = _mm256_or_si256(other, _mm256_xor_si256(load(state, at), load(memory, at)));
    }
    return other;
}

WIDE int tahr__same_wide(const tahr__sleep *s, const tahr_state *state)
{
    const __m256i other = other_state(s, state);
    return _mm256_testz_si256(other, other);
}

/* What is rarer goes the general way. */
WIDE tahr_status tahr__step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                 tahr_report *report)
{
    const tahr__sleep *s = &mover->sleep;
    const tahr_world *world = mover->world;
    _Static_assert(offsetof(tahr_input, move.z) == STEP, "the rest of a wish");
    const uint64_t odd = (bits_of(dt) ^ bits_of(s->dt)) | (world_revision(world) ^ s->revision) |
                         (bits_of(input->move.z) ^ bits_of(s->input.move.z)) | input->flags | input->reserved |
                         (input->struct_size ^ (uint32_t)sizeof *input) | (uint64_t)(uintptr_t)world->recording |
                         (uint64_t)(uintptr_t)mover->company;
    if (odd != 0) {
        return tahr__step_noted(mover, input, dt, state, report);
    }
    const __m256i other = _mm256_or_si256(other_state(s, state), _mm256_xor_si256(load(input, 0), load(&s->input, 0)));
    if (!_mm256_testz_si256(other, other)) {
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

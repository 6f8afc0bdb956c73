/* SPDX-License-Identifier: MIT
 * slot.c: the sequence lock around the latest state. */
#include "slot.h"

#include <string.h>

#include "words.h"

enum { LOOKS = 1000 }; /* of tahr_telemetry_latest; a write takes far less than a look */

_Static_assert(sizeof(_Atomic uint64_t) == 8, "atomic words are copied as plain ones by their only writer");

/* The words begin on a line. */
static const void *on_line(const void *words)
{
#ifdef __GNUC__
    return __builtin_assume_aligned(words, 64);
#else
    return words;
#endif
}

/* Of words from begin to end: whether any differs. */
static uint64_t differ(const void *one, const void *other, int begin, int end)
{
    uint64_t any = 0;
    for (int i = begin; i < end; i++)
        any |= tahr__word_of(one, i) ^ tahr__word_of(other, i);
    return any;
}

/* The writer may read what it alone writes as plain memory, whole lines at once. */
uint64_t tahr__slot_compare(const tahr__slot *slot, const tahr_state *state, int wide)
{
    const void *words = on_line((const void *)slot->words);
    if (wide) return tahr__words_differ_wide(words, state) & ~TAHR__MOTION_MASK;
    const uint64_t any = differ(words, state, TAHR__BEHIND_VELOCITY, TAHR__FLOOR_POINT) |
                         differ(words, state, TAHR__BEHIND_DISTANCE, TAHR__FLOOR_POSITION) |
                         differ(words, state, TAHR__BEHIND_FLOOR_POSITION, TAHR__STATE_WORDS);
    return any ? tahr__words_differ(words, state) & ~TAHR__MOTION_MASK : 0;
}

int tahr__slot_holds(const tahr__slot *slot, const tahr_state *state, int wide)
{
    const void *words = (const void *)slot->words;
    if (atomic_load_explicit(&slot->turn, memory_order_relaxed) == 0) return 0;
    return wide ? tahr__words_differ_wide(words, state) == 0 : memcmp(words, state, sizeof *state) == 0;
}

static uint64_t get(const _Atomic uint64_t *word)
{
    return atomic_load_explicit(word, memory_order_relaxed);
}

static int look(const tahr__slot *slot, uint64_t words[TAHR__STATE_WORDS], tahr_stamp *stamp)
{
    const uint64_t turn = atomic_load_explicit(&slot->turn, memory_order_acquire);
    if (turn & 1) return 0;
    *stamp = (tahr_stamp){.config = (uint32_t)get(&slot->config),
                          .step = get(&slot->step),
                          .sequence = get(&slot->sequence),
                          .epoch = get(&slot->epoch),
                          .time_ns = (int64_t)get(&slot->time)};
    for (int i = 0; i < TAHR__STATE_WORDS; i++)
        words[i] = get(&slot->words[i]);
    atomic_thread_fence(memory_order_acquire); /* the turn after the words */
    return get(&slot->turn) == turn;
}

tahr_status tahr__slot_read(const tahr__slot *slot, tahr_state *state, tahr_stamp *stamp)
{
    uint64_t words[TAHR__STATE_WORDS];
    if (get(&slot->turn) == 0) return TAHR_E_NOT_FOUND;
    for (int i = 0; i < LOOKS; i++) {
        if (look(slot, words, stamp)) {
            memcpy(state, words, sizeof *state);
            return TAHR_OK;
        }
    }
    return TAHR_UNKNOWN;
}

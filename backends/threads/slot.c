/* SPDX-License-Identifier: MIT
 * slot.c: the sequence lock around the latest state. */
#include "slot.h"

#include <string.h>

#include "words.h"

enum { LOOKS = 1000 }; /* of tahr_telemetry_latest; a write takes far less than a look */

_Static_assert(sizeof(_Atomic uint64_t) == 8, "atomic words are copied as plain ones by their only writer");

/* The writer may read what it alone writes as plain memory, whole lines at once. */
uint64_t tahr__slot_compare(const tahr__slot *slot, const tahr_state *state)
{
    return tahr__words_differ((const void *)slot->words, state);
}

int tahr__slot_holds(const tahr__slot *slot, const tahr_state *state)
{
    return memcmp((const void *)slot->words, state, sizeof *state) == 0;
}

static void put(_Atomic uint64_t *word, uint64_t value)
{
    atomic_store_explicit(word, value, memory_order_relaxed);
}

void tahr__slot_write(tahr__slot *slot, const tahr_state *state, uint64_t changed, const tahr_stamp *stamp)
{
    const uint64_t turn = atomic_load_explicit(&slot->turn, memory_order_relaxed);
    put(&slot->turn, turn + 1);
    atomic_thread_fence(memory_order_release); /* no word before the turn */
    put(&slot->config, stamp->config);
    put(&slot->step, stamp->step);
    put(&slot->sequence, stamp->sequence);
    put(&slot->epoch, stamp->epoch);
    put(&slot->time, (uint64_t)stamp->time_ns);
    for (; changed; changed &= changed - 1) {
        const int i = tahr__lowest_bit(changed);
        put(&slot->words[i], tahr__word_of(state, i));
    }
    atomic_store_explicit(&slot->turn, turn + 2, memory_order_release);
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

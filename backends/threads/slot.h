/* SPDX-License-Identifier: MIT
 * slot.h: the latest state of one character: written by one thread, read whole by any, without a lock. */
#ifndef TAHR_THREADS_SLOT_H
#define TAHR_THREADS_SLOT_H

#include <stdatomic.h>
#include <tahr/sink.h>

#include "motion.h"
#include "words.h"

/* A sequence lock (H. Boehm, "Can seqlocks get along with programming language memory models?", 2012): turn is odd
 * while words are being written, and who sees it change looks again. Every word is an atomic, so that a look which
 * comes to nothing is no data race either. */
typedef struct tahr__slot {
    _Alignas(64) _Atomic uint64_t turn; /* 0: never written */
    _Atomic uint64_t config, step, sequence, epoch, time;
    uint64_t reserved[2]; /* the words begin on a line */
    _Atomic uint64_t words[TAHR__STATE_WORDS];
} tahr__slot;

/* By the writer: which words of the slot are not those of state, one bit each; but for those of the motion. */
uint64_t tahr__slot_compare(const tahr__slot *slot, const tahr_state *state, int wide);

/* By the writer: whether it was written, and all words are the same. wide: tahr__has_avx2. */
int tahr__slot_holds(const tahr__slot *slot, const tahr_state *state, int wide);

static inline void tahr__slot_put(_Atomic uint64_t *word, uint64_t value)
{
    atomic_store_explicit(word, value, memory_order_relaxed);
}

static inline void tahr__slot_put_vec3(_Atomic uint64_t *words, const tahr_vec3 *v)
{
    for (int i = 0; i < 3; i++)
        tahr__slot_put(&words[i], tahr__word_of(v, i));
}

/* By the writer: the motion, the words of changed, and the stamp (but for its character and wall_ns). */
static inline void tahr__slot_write(tahr__slot *slot, const tahr_state *state, uint64_t changed, tahr_stamp stamp)
{
    _Atomic uint64_t *words = slot->words;
    const uint64_t turn = atomic_load_explicit(&slot->turn, memory_order_relaxed);
    tahr__slot_put(&slot->turn, turn + 1);
    atomic_thread_fence(memory_order_release); /* no word before the turn */
    tahr__slot_put(&slot->config, stamp.config);
    tahr__slot_put(&slot->step, stamp.step);
    tahr__slot_put(&slot->sequence, stamp.sequence);
    tahr__slot_put(&slot->epoch, stamp.epoch);
    tahr__slot_put(&slot->time, (uint64_t)stamp.time_ns);
    tahr__slot_put_vec3(words, &state->position);
    tahr__slot_put_vec3(words + 3, &state->velocity);
    tahr__slot_put_vec3(words + TAHR__FLOOR_POINT, &state->floor.point);
    tahr__slot_put(words + TAHR__FLOOR_POINT + 3, tahr__word_of(&state->floor.distance, 0));
    tahr__slot_put_vec3(words + TAHR__FLOOR_POSITION, &state->floor_position);
    for (; changed; changed &= changed - 1) {
        const int i = tahr__lowest_bit(changed);
        tahr__slot_put(&words[i], tahr__word_of(state, i));
    }
    atomic_store_explicit(&slot->turn, turn + 2, memory_order_release);
}

/* By anybody. Returns TAHR_OK, TAHR_E_NOT_FOUND (never written), TAHR_UNKNOWN (was written at each of so many looks).
 */
tahr_status tahr__slot_read(const tahr__slot *slot, tahr_state *state, tahr_stamp *stamp);

#endif

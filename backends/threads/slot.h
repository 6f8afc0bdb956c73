/* SPDX-License-Identifier: MIT
 * slot.h: the latest state of one character: written by one thread, read whole by any, without a lock. */
#ifndef TAHR_THREADS_SLOT_H
#define TAHR_THREADS_SLOT_H

#include <stdatomic.h>
#include <tahr/sink.h>

enum { TAHR__STATE_WORDS = sizeof(tahr_state) / 8 };

/* A sequence lock (H. Boehm, "Can seqlocks get along with programming language memory models?", 2012): turn is odd
 * while words are being written, and who sees it change looks again. Every word is an atomic, so that a look which
 * comes to nothing is no data race either. */
typedef struct tahr__slot {
    _Alignas(64) _Atomic uint64_t turn; /* 0: never written */
    _Atomic uint64_t config, step, sequence, epoch, time;
    uint64_t reserved[2]; /* the words begin on a line */
    _Atomic uint64_t words[TAHR__STATE_WORDS];
} tahr__slot;

/* By the writer: which words of the slot are not those of state, one bit each. */
uint64_t tahr__slot_compare(const tahr__slot *slot, const tahr_state *state);

/* By the writer: whether they are the same, all of them. */
int tahr__slot_holds(const tahr__slot *slot, const tahr_state *state);

/* By the writer: the words of changed, and the stamp (but for its character and wall_ns). */
void tahr__slot_write(tahr__slot *slot, const tahr_state *state, uint64_t changed, const tahr_stamp *stamp);

/* By anybody. Returns TAHR_OK, TAHR_E_NOT_FOUND (never written), TAHR_UNKNOWN (was written at each of so many looks).
 */
tahr_status tahr__slot_read(const tahr__slot *slot, tahr_state *state, tahr_stamp *stamp);

#endif

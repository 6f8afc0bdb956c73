/* SPDX-License-Identifier: MIT
 * ring.h: a ring of fixed size between one thread that writes and one that reads. It is made of words of 8 bytes; a
 * record is a number of them in a row, whose first one begins with that number. */
#ifndef TAHR_THREADS_RING_H
#define TAHR_THREADS_RING_H

#include <stdatomic.h>
#include <stdint.h>

/* What one side writes lies on a line of its own, with what it last saw of the other: it looks at the other's line only
 * where that is not enough. Positions count words since the start and never wrap. */
typedef struct tahr__ring {
    _Alignas(64) _Atomic uint64_t head; /* the writer's: all before it is written */
    uint64_t seen_tail;
    uint64_t *words;
    uint64_t size;                      /* of words, a power of two */
    _Alignas(64) _Atomic uint64_t tail; /* the reader's: all before it has been read */
    uint64_t seen_head;
    const uint64_t *read_words;
    uint64_t read_size;
} tahr__ring;

/* words: memory for size of them, a power of two. */
void tahr__ring_init(tahr__ring *ring, uint64_t *words, uint64_t size);

/* By the writer: room in words, exact where it is less than a quarter. */
uint64_t tahr__ring_room(tahr__ring *ring);

/* By the writer: where a record of up to count words can be written, in a row; NULL: no room. */
uint64_t *tahr__ring_reserve(tahr__ring *ring, uint64_t count);

/* By the writer: what was reserved is now a record of count words, no more than reserved. */
void tahr__ring_commit(tahr__ring *ring, uint64_t count);

/* By the reader: what was written until now is what tahr__ring_peek answers from. Returns how many words that are. */
uint64_t tahr__ring_look(tahr__ring *ring);

/* By the reader: the next record, or NULL: none. */
const uint64_t *tahr__ring_peek(tahr__ring *ring);

/* By the reader: the record of tahr__ring_peek is done with, its memory may be written again. */
void tahr__ring_pop(tahr__ring *ring);

#endif

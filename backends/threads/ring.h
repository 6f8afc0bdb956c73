/* SPDX-License-Identifier: MIT
 * ring.h: a ring of fixed size between one thread that writes and one that reads. It is made of words of 8 bytes; a
 * record is a number of them in a row, whose first one begins with that number. */
#ifndef TAHR_THREADS_RING_H
#define TAHR_THREADS_RING_H

#include <stdatomic.h>
#include <stddef.h>
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

/* By the writer: a gap up to the end of the memory, and room behind it; NULL: no room for both. */
uint64_t *tahr__ring_reserve_at_start(tahr__ring *ring, uint64_t count);

/* By the writer: whether there is room for count words, looking at the reader's line only where it must. */
static inline int tahr__ring_has_room(tahr__ring *r, uint64_t count)
{
    const uint64_t head = atomic_load_explicit(&r->head, memory_order_relaxed);
    if (r->size - (head - r->seen_tail) >= count) return 1;
    r->seen_tail = atomic_load_explicit(&r->tail, memory_order_acquire);
    return r->size - (head - r->seen_tail) >= count;
}

/* By the writer: where a record of up to count words can be written, in a row; NULL: no room. */
static inline uint64_t *tahr__ring_reserve(tahr__ring *r, uint64_t count)
{
    const uint64_t at = atomic_load_explicit(&r->head, memory_order_relaxed) & (r->size - 1);
    if (at + count > r->size) return tahr__ring_reserve_at_start(r, count);
    return tahr__ring_has_room(r, count) ? r->words + at : NULL;
}

/* By the writer: what was reserved is now a record of count words, no more than reserved. The lines of the next one lie
 * with the reader, who read them a round ago: they are on their way while the caller does something else. As many as a
 * step of a walking character takes; beyond the end of the memory, now and then, they are called for in vain. */
static inline void tahr__ring_commit(tahr__ring *r, uint64_t count)
{
    const uint64_t head = atomic_load_explicit(&r->head, memory_order_relaxed) + count;
    atomic_store_explicit(&r->head, head, memory_order_release);
#ifdef __GNUC__
    const char *next = (const char *)(r->words + (head & (r->size - 1)));
    for (size_t line = 1; line <= 8; line++)
        __builtin_prefetch(next + 64 * line, 1);
#endif
}

/* By the reader: what was written until now is what tahr__ring_peek answers from. Returns how many words that are. */
uint64_t tahr__ring_look(tahr__ring *ring);

/* By the reader: the next record, or NULL: none. */
const uint64_t *tahr__ring_peek(tahr__ring *ring);

/* By the reader: the record of tahr__ring_peek is done with, its memory may be written again. */
void tahr__ring_pop(tahr__ring *ring);

#endif

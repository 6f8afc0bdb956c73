/* SPDX-License-Identifier: MIT
 * ring.c: one release store for each record written and read; nobody ever waits. A record that does not fit before the
 * end of the memory begins at its start, after a gap: a record that nobody sees. */
#include "ring.h"

#include <stddef.h>

/* The first word of a record: its length, and above it whether it is a gap. */
static const uint64_t LENGTH = 0xFFFFFFFFu, GAP = (uint64_t)1 << 63;

void tahr__ring_init(tahr__ring *r, uint64_t *words, uint64_t size)
{
    r->words = words;
    r->read_words = words;
    r->size = r->read_size = size;
    r->seen_tail = r->seen_head = 0;
    atomic_init(&r->head, 0);
    atomic_init(&r->tail, 0);
}

static uint64_t room_after(tahr__ring *r, uint64_t head, uint64_t enough)
{
    uint64_t room = r->size - (head - r->seen_tail);
    if (room < enough) {
        r->seen_tail = atomic_load_explicit(&r->tail, memory_order_acquire);
        room = r->size - (head - r->seen_tail);
    }
    return room;
}

uint64_t tahr__ring_room(tahr__ring *r)
{
    return room_after(r, atomic_load_explicit(&r->head, memory_order_relaxed), r->size / 4);
}

uint64_t *tahr__ring_reserve(tahr__ring *r, uint64_t count)
{
    const uint64_t head = atomic_load_explicit(&r->head, memory_order_relaxed);
    const uint64_t at = head & (r->size - 1);
    const uint64_t gap = at + count > r->size ? r->size - at : 0;
    if (room_after(r, head, gap + count) < gap + count) return NULL;
    if (gap == 0) return r->words + at;
    r->words[at] = GAP | gap;
    atomic_store_explicit(&r->head, head + gap, memory_order_release);
    return r->words;
}

/* The lines of the next record lie with the reader, who read them a round ago: they are on their way while the caller
 * does something else. As many as a step of a walking character takes. */
static void call_for_next(const tahr__ring *r, uint64_t head)
{
#ifdef __GNUC__
    for (uint64_t line = 1; line <= 6; line++)
        __builtin_prefetch(r->words + ((head + 8 * line) & (r->size - 1)), 1);
#else
    (void)r, (void)head;
#endif
}

void tahr__ring_commit(tahr__ring *r, uint64_t count)
{
    const uint64_t head = atomic_load_explicit(&r->head, memory_order_relaxed) + count;
    atomic_store_explicit(&r->head, head, memory_order_release);
    call_for_next(r, head);
}

uint64_t tahr__ring_look(tahr__ring *r)
{
    r->seen_head = atomic_load_explicit(&r->head, memory_order_acquire);
    return r->seen_head - atomic_load_explicit(&r->tail, memory_order_relaxed);
}

static const uint64_t *at_tail(const tahr__ring *r)
{
    const uint64_t tail = atomic_load_explicit(&r->tail, memory_order_relaxed);
    return tail == r->seen_head ? NULL : r->read_words + (tail & (r->read_size - 1));
}

const uint64_t *tahr__ring_peek(tahr__ring *r)
{
    const uint64_t *record = at_tail(r);
    if (record && (*record & GAP)) {
        tahr__ring_pop(r);
        record = at_tail(r);
    }
    return record;
}

void tahr__ring_pop(tahr__ring *r)
{
    const uint64_t tail = atomic_load_explicit(&r->tail, memory_order_relaxed);
    const uint64_t length = r->read_words[tail & (r->read_size - 1)] & LENGTH;
    atomic_store_explicit(&r->tail, tail + length, memory_order_release);
}

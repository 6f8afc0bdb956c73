/* SPDX-License-Identifier: MIT
 * ring.c: one release store for each record written and read; nobody ever waits. A record that does not fit before the
 * end of the memory begins at its start, after a gap: a record that nobody sees. */
#include "ring.h"

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

uint64_t *tahr__ring_reserve_at_start(tahr__ring *r, uint64_t count)
{
    const uint64_t head = atomic_load_explicit(&r->head, memory_order_relaxed);
    const uint64_t at = head & (r->size - 1), gap = r->size - at;
    if (!tahr__ring_has_room(r, gap + count)) return NULL;
    r->words[at] = GAP | gap;
    atomic_store_explicit(&r->head, head + gap, memory_order_release);
    return r->words;
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

/* SPDX-License-Identifier: MIT
 * lay_out.c: all the memory of a telemetry: one block, in which everything begins on a line of its own. */
#include <string.h>

#include "../common/malloc.h"
#include "../common/processor.h"
#include "pages.h"
#include "telemetry.h"
#include "telemetry_check.h"

enum { LINE = 64 };

/* Takes the next size bytes of a block, or only counts them while there is none. */
typedef struct block {
    char *memory;
    size_t used;
} block;

static void *take(block *b, uint64_t count, size_t size)
{
    void *at = b->memory ? b->memory + b->used : NULL;
    b->used += (size_t)((count * size + LINE - 1) / LINE * LINE);
    return at;
}

static void take_places(block *b, tahr__places *places, uint32_t count)
{
    places->capacity = count;
    places->bucket_count = 2;
    while (places->bucket_count < 2 * count)
        places->bucket_count *= 2;
    places->before = take(b, count, sizeof *places->before);
    places->now = take(b, count, sizeof *places->now);
    places->moved = take(b, count, sizeof *places->moved);
    places->last = take(b, count, sizeof *places->last);
    places->buckets = take(b, places->bucket_count, sizeof *places->buckets);
}

static char *take_text(block *b, const char *text)
{
    const size_t size = strlen(text ? text : "") + 1;
    char *copy = take(b, size, 1);
    if (copy && text) memcpy(copy, text, size);
    return copy;
}

/* Gives t, which begins the block, its parts; t may be on the stack while the block is only counted. */
static void take_all(block *b, tahr_telemetry *t, const tahr_telemetry_desc *d)
{
    const uint64_t ring = tahr__telemetry_ring_bytes(d);
    t->lane_count = d->lanes ? d->lanes : 1;
    t->lanes = take(b, t->lane_count, sizeof *t->lanes);
    t->characters = take(b, d->characters, sizeof *t->characters);
    t->drain.last = take(b, d->characters, sizeof *t->drain.last);
    t->configs = take(b, d->config_count, d->configs->struct_size);
    take_places(b, &t->places, d->bodies);
    t->level = take_text(b, d->level);
    t->backend = take_text(b, d->backend);
    for (uint32_t i = 0; i < t->lane_count; i++) {
        uint64_t *words = take(b, ring, 1);
        if (words) tahr__ring_init(&t->lanes[i].ring, words, ring / 8);
    }
}

static uint32_t wanted_by(const tahr_sink *s)
{
    return (uint32_t)(s->state != NULL) << TAHR_MESSAGE_STATE | (uint32_t)(s->event != NULL) << TAHR_MESSAGE_EVENT |
           (uint32_t)(s->input != NULL) << TAHR_MESSAGE_INPUT | (uint32_t)(s->report != NULL) << TAHR_MESSAGE_REPORT |
           (uint32_t)(s->snapshot != NULL) << TAHR_MESSAGE_SNAPSHOT |
           (uint32_t)(s->change != NULL) << TAHR_MESSAGE_BODY | (uint32_t)(s->world != NULL) << TAHR_MESSAGE_WORLD;
}

static int64_t period(double seconds, double usual)
{
    return (int64_t)((seconds > 0 ? seconds : usual) * 1e9 + 0.5);
}

static void copy_desc(tahr_telemetry *t, const tahr_telemetry_desc *d)
{
    t->sink = *d->sink;
    t->wants = wanted_by(d->sink);
    t->flags = d->flags;
    t->character_count = d->characters;
    t->config_count = d->config_count;
    t->every = d->every ? d->every : 1;
    t->state_rate = d->state_rate;
    t->state_period = d->state_rate > 0 ? 1e9 / d->state_rate : 0;
    t->wide = tahr__has_avx2() && !(d->flags & TAHR_TELEMETRY_NARROW);
    t->snapshot_ns = period(d->snapshot_period, 10);
    t->world_ns = period(d->world_period, 1);
    t->drain_ns = period(d->drain_period, 0.001);
    t->level_hash = d->level_hash;
    if (d->log) t->log = *d->log;
    atomic_init(&t->epoch, 0);
    atomic_init(&t->revision, d->revision);
    memcpy(t->configs, d->configs, (size_t)d->config_count * d->configs->struct_size);
}

/* An allocator of the user's is asked for lines, and knows best what pages they are on. */
static void *allocate(const tahr_telemetry_desc *d, const tahr_allocator *a, size_t bytes)
{
    const int large = !d->allocator && bytes >= TAHR__LARGE_PAGE;
    void *memory = a->alloc(a->user, bytes, large ? TAHR__LARGE_PAGE : LINE);
    if (memory && large) tahr__pages_prefer_large(memory, bytes);
    return memory;
}

tahr_telemetry *tahr__telemetry_lay_out(const tahr_telemetry_desc *d)
{
    const tahr_allocator a = tahr__allocator_or_malloc(d->allocator);
    tahr_telemetry counted = {0};
    block b = {NULL, 0};
    take(&b, 1, sizeof counted);
    take_all(&b, &counted, d);
    const size_t bytes = b.used;
    b.memory = allocate(d, &a, bytes);
    if (!b.memory) return NULL;
    memset(b.memory, 0, bytes); /* the rings too: the system gives a page when it is first touched, now and not later */
    b.used = 0;
    tahr_telemetry *t = take(&b, 1, sizeof *t);
    take_all(&b, t, d);
    copy_desc(t, d);
    t->allocator = a;
    t->bytes = bytes;
    return t;
}

void tahr__telemetry_free_memory(tahr_telemetry *t)
{
    const tahr_allocator a = t->allocator;
    a.free(a.user, t, t->bytes, LINE);
}

void tahr__telemetry_free(tahr_telemetry *t)
{
    pthread_cond_destroy(&t->changed);
    pthread_mutex_destroy(&t->lock);
    tahr__telemetry_free_memory(t);
}

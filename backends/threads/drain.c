/* SPDX-License-Identifier: MIT
 * drain.c: the thread between the rings and the sink. */
#include "record.h"
#include "telemetry.h"

static uint64_t dropped_for_want_of_room(const tahr_telemetry *t)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < t->lane_count; i++)
        for (uint32_t k = 0; k < TAHR_MESSAGE_COUNT; k++)
            sum += tahr__tally_of(&t->lanes[i].dropped, k);
    return sum;
}

static void tell_world(tahr_telemetry *t)
{
    tahr__drain *d = &t->drain;
    if (!t->sink.world || tahr__is_abandoned(t)) return;
    tahr_sink_world world = {.level = t->level,
                             .backend = t->backend,
                             .level_hash = t->level_hash,
                             .configs = t->configs,
                             .config_count = t->config_count,
                             .characters = t->character_count,
                             .run = d->run,
                             .wall_ns = tahr__clock_ns(CLOCK_REALTIME),
                             .sequence = d->world_sequence++,
                             .epoch = atomic_load_explicit(&t->epoch, memory_order_acquire),
                             .revision = atomic_load_explicit(&t->revision, memory_order_relaxed),
                             .dropped = dropped_for_want_of_room(t),
                             .state_rate = t->state_rate};
    for (uint32_t k = 0; k < TAHR_MESSAGE_COUNT; k++)
        world.failed += tahr__tally_of(&d->failed, k);
    tahr__tally_add(&d->offered, TAHR_MESSAGE_WORLD, 1);
    tahr__deliver_count(t, TAHR_MESSAGE_WORLD, t->sink.world(t->sink.user, &world));
}

static const tahr__record *next_of(tahr__lane *lane)
{
    return (const tahr__record *)(const void *)tahr__ring_peek(&lane->ring);
}

/* The lowest epoch of what comes next in any lane. */
static uint64_t first_epoch(tahr_telemetry *t)
{
    uint64_t first = UINT64_MAX;
    for (uint32_t i = 0; i < t->lane_count; i++) {
        const tahr__record *record = next_of(&t->lanes[i]);
        if (record && record->epoch < first) first = record->epoch;
    }
    return first;
}

/* Epoch by epoch. All records of an epoch were written before the next one began, and the epoch is read before the
 * rings are looked at: of those before it nothing is still to come. What belongs to a later one waits, for its change
 * may lie in a ring that was looked at too early. */
uint64_t tahr__drain_pass(tahr_telemetry *t)
{
    const uint64_t epoch = atomic_load_explicit(&t->epoch, memory_order_acquire);
    uint64_t most = 0;
    for (uint32_t i = 0; i < t->lane_count; i++) {
        const uint64_t filled = tahr__ring_look(&t->lanes[i].ring);
        if (filled > most) most = filled;
    }
    if (most > atomic_load_explicit(&t->drain.most_filled, memory_order_relaxed))
        atomic_store_explicit(&t->drain.most_filled, most, memory_order_relaxed);
    for (uint64_t e = first_epoch(t); e <= epoch; e = first_epoch(t)) {
        for (uint32_t i = 0; i < t->lane_count; i++) {
            const tahr__record *record;
            while ((record = next_of(&t->lanes[i])) != NULL && record->epoch == e) {
                tahr__deliver(t, record);
                tahr__ring_pop(&t->lanes[i].ring);
            }
        }
    }
    return 8 * most / t->lanes[0].ring.read_size;
}

/* Sleeps for the period, or until it is to end. */
static void rest(tahr_telemetry *t)
{
    const int64_t until = tahr__clock_ns(CLOCK_MONOTONIC) + t->drain_ns;
    const struct timespec at = {.tv_sec = (time_t)(until / 1000000000), .tv_nsec = (long)(until % 1000000000)};
    pthread_mutex_lock(&t->lock);
    int woken = 0;
    while (woken == 0 && atomic_load_explicit(&t->ending, memory_order_relaxed) == 0)
        woken = pthread_cond_timedwait(&t->changed, &t->lock, &at);
    pthread_mutex_unlock(&t->lock);
}

static void tell_world_in_time(tahr_telemetry *t)
{
    const int64_t now = tahr__clock_ns(CLOCK_MONOTONIC);
    if (now < t->drain.world_ns) return;
    tell_world(t);
    t->drain.world_ns = now + t->world_ns;
}

static void flush(tahr_telemetry *t)
{
    if (t->drain.told > 0 && t->sink.flush && !tahr__is_abandoned(t)) t->sink.flush(t->sink.user);
    t->drain.told = 0;
}

/* Last of all the totals; of what is abandoned nothing more than the counts. */
static void finish(tahr_telemetry *t)
{
    tell_world(t);
    flush(t);
    pthread_mutex_lock(&t->lock);
    t->finished = 1;
    pthread_cond_broadcast(&t->changed);
    const uint32_t orphaned = t->orphaned;
    pthread_mutex_unlock(&t->lock);
    if (orphaned) tahr__telemetry_free(t);
}

void *tahr__drain_live(void *user)
{
    tahr_telemetry *t = user;
    t->drain.run = tahr__clock_ns(CLOCK_REALTIME);
    for (;;) {
        const uint32_t ending = atomic_load_explicit(&t->ending, memory_order_acquire);
        tell_world_in_time(t);
        const uint64_t filled = tahr__drain_pass(t);
        flush(t);
        if (ending) break; /* nobody writes any more: that was all */
        if (filled == 0) rest(t);
    }
    finish(t);
    return NULL;
}

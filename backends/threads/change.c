/* SPDX-License-Identifier: MIT
 * change.c: a change of the world on its way into the ring of lane 0, by whoever has exclusive access to the world. It
 * makes an epoch: every record says to which one it belongs, and those of an epoch are told after the change that made
 * it, whichever lanes they are in. */
#include <string.h>

#include "record.h"
#include "telemetry.h"

/* More than tahr_world_move takes in one call would take a ring of its own. */
enum { MOST_POSES = 65536 };

static const double LONGEST_DT = 10; /* of tahr_world_move */

static tahr_status push_change(tahr_telemetry *t, const tahr__record_change *change, const tahr_body_pose *poses,
                               const tahr_body_pose *before)
{
    tahr__lane *l = &t->lanes[0];
    const uint64_t some = change->count * TAHR__POSE_WORDS, all = sizeof *change / 8 + (before ? 2 * some : some);
    uint64_t *words = tahr__ring_reserve(&l->ring, all);
    tahr__tally_add(&l->offered, TAHR_MESSAGE_BODY, 1);
    if (!words) {
        tahr__tally_add(&l->dropped, TAHR_MESSAGE_BODY, 1);
        return TAHR_TRUNCATED;
    }
    tahr__record_change *record = (tahr__record_change *)(void *)words;
    *record = *change;
    record->head.words = all;
    words += sizeof *change / 8;
    if (some > 0) memcpy(words, poses, some * 8);
    if (some > 0 && before) memcpy(words + some, before, some * 8);
    tahr__ring_commit(&l->ring, all);
    return TAHR_OK;
}

/* Where all bodies are, when it is time for that, and nobody was named for the first time by the motion under way. */
static tahr_status push_places(tahr_telemetry *t, tahr__record_change change)
{
    const tahr__places *b = &t->places;
    if (b->count == 0 || b->unknown || t->places_time < t->places_due) return TAHR_OK;
    change.head.parts = TAHR_CHANGE_SNAPSHOT;
    change.count = b->count;
    change.dt = b->dt;
    const tahr_status status = push_change(t, &change, b->now, b->before);
    if (status == TAHR_OK) t->places_due = t->places_time + 1e-9 * (double)t->snapshot_ns;
    return status;
}

static tahr_status check_change(uint32_t kind, const tahr_body_pose *poses, uint32_t count, double dt)
{
    if (kind < TAHR_CHANGE_SET || kind > TAHR_CHANGE_TOUCH || count > MOST_POSES) return TAHR_E_ARGUMENT;
    if (count > 0 && !poses) return TAHR_E_NULL;
    if (kind == TAHR_CHANGE_TOUCH && count > 0) return TAHR_E_ARGUMENT;
    if (kind == TAHR_CHANGE_MOVE ? !(dt > 0 && dt <= LONGEST_DT) : !(dt == 0)) return TAHR_E_ARGUMENT;
    return TAHR_OK;
}

tahr_status tahr_telemetry_change(tahr_telemetry *t, uint32_t kind, const tahr_body_pose *poses, uint32_t count,
                                  double dt, uint64_t revision)
{
    if (!t) return TAHR_E_NULL;
    const tahr_status wrong = check_change(kind, poses, count, dt);
    if (wrong < 0) return wrong;
    const uint64_t epoch = atomic_load_explicit(&t->epoch, memory_order_relaxed) + 1;
    tahr_status status = TAHR_OK;
    if (t->wants & 1u << TAHR_MESSAGE_BODY) {
        const tahr__record_change change = {{0, epoch, TAHR__RECORD_CHANGE, kind}, count, revision, dt};
        status = push_change(t, &change, poses, NULL);
        if (status != TAHR_OK) t->places_due = t->places_time; /* who missed it gets all of it soon */
        int all = 1;
        if (kind == TAHR_CHANGE_SET) all = tahr__places_set(&t->places, poses, count);
        if (kind == TAHR_CHANGE_MOVE) all = tahr__places_move(&t->places, poses, count, dt, epoch);
        if (!all) status = TAHR_TRUNCATED;
        t->places_time += dt;
        const tahr_status also = push_places(t, change);
        if (status == TAHR_OK) status = also;
    }
    atomic_store_explicit(&t->revision, revision, memory_order_relaxed);
    atomic_store_explicit(&t->epoch, epoch, memory_order_release);
    return status;
}

/* SPDX-License-Identifier: MIT
 * lane.h: what a thread that steps writes: a ring, the counts of what went into it, and its characters. */
#ifndef TAHR_THREADS_LANE_H
#define TAHR_THREADS_LANE_H

#include <tahr/telemetry.h>

#include "ring.h"
#include "slot.h"

/* One thread adds, any may read. */
typedef struct tahr__tally {
    _Atomic uint64_t of[TAHR_MESSAGE_COUNT];
} tahr__tally;

/* By the only thread that adds to it. */
static inline void tahr__tally_add(tahr__tally *tally, uint32_t message, uint64_t count)
{
    const uint64_t before = atomic_load_explicit(&tally->of[message], memory_order_relaxed);
    atomic_store_explicit(&tally->of[message], before + count, memory_order_relaxed);
}

static inline uint64_t tahr__tally_of(const tahr__tally *tally, uint32_t message)
{
    return atomic_load_explicit(&tally->of[message], memory_order_relaxed);
}

typedef struct tahr__lane {
    tahr__ring ring;
    _Alignas(64) tahr__tally offered, thinned, dropped;
} tahr__lane;

typedef struct tahr__character {
    tahr__slot slot;
    /* Of the thread that steps. */
    uint64_t standing; /* words of the state that changed since the last record that has any */
    uint64_t step;     /* the next one */
    uint64_t sequence[TAHR_MESSAGE_COUNT];
    int64_t time_ns;
    int64_t snapshot_ns; /* when one is due */
    double state_ns;     /* when a state is due, by state_rate */
    uint32_t state_step; /* steps until one may be due, by every */
    uint32_t config;
    _Atomic uint32_t lane; /* and 1; 0: not seen yet */
    uint32_t snapshot;     /* 1: one is owed */
    uint32_t gap;          /* 1: an input was dropped since the last snapshot */
} tahr__character;

#endif

/* SPDX-License-Identifier: MIT
 * telemetry.h: all of a telemetry, and who uses what of it. */
#ifndef TAHR_THREADS_TELEMETRY_H
#define TAHR_THREADS_TELEMETRY_H

#include <pthread.h>
#include <time.h>

#include "places.h"
#include "lane.h"

/* Of the thread that drains: what it told the sink, and what it was told. Others read the tallies. */
typedef struct tahr__drain {
    tahr__tally offered, dropped, delivered, failed; /* offered: of WORLD; dropped: abandoned */
    _Atomic int32_t last_failure;
    _Atomic uint64_t most_filled; /* words */
    uint64_t told;                /* how often the sink was called since the last flush */
    uint64_t world_sequence;
    int64_t world_ns; /* when the next one is due, by the monotonic clock */
    int64_t run;
    tahr_state *last; /* of each character: as of the last record that has any of it; no line of it is near who steps */
} tahr__drain;

struct tahr_telemetry {
    /* As described; nobody writes these. */
    tahr_sink sink;
    uint32_t wants; /* 1 << TAHR_MESSAGE_*: what the sink has a function for */
    uint32_t flags, lane_count, character_count, config_count, every;
    int wide;                                /* 1: tahr__has_avx2, and not NARROW */
    double state_period;                     /* ns; 0: all */
    int64_t snapshot_ns, world_ns, drain_ns; /* periods */
    uint64_t level_hash;
    double state_rate;
    tahr_config *configs;
    const char *level, *backend;
    tahr__lane *lanes;
    tahr__character *characters;
    tahr_allocator allocator;
    tahr_log log;
    size_t bytes; /* of the one block that all of this is */

    /* By who has exclusive access to the world. */
    _Alignas(64) _Atomic uint64_t epoch;
    _Atomic uint64_t revision; /* stored before the epoch that it belongs to */
    tahr__places places;
    double places_time, places_due; /* s, sum of dt */

    _Alignas(64) tahr__drain drain;

    /* The life of the thread. */
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;  /* ending or finished */
    _Atomic uint32_t ending; /* TAHR_STOP_*, or 0: not yet */
    uint32_t finished;       /* by the thread: it will touch nothing here any more, unless it is abandoned */
    uint32_t joined;
    uint32_t orphaned; /* nobody waits for it: it frees all this itself */
};

/* Of a desc that is valid; NULL: no memory. What is not described is zero. */
tahr_telemetry *tahr__telemetry_lay_out(const tahr_telemetry_desc *desc);
void tahr__telemetry_free_memory(tahr_telemetry *telemetry); /* before it has a lock */
void tahr__telemetry_free(tahr_telemetry *telemetry);

/* drain.c: what the thread does; and of that, once: tells the sink what was written until now. Returns how many eighths
 * of a ring were filled. */
void *tahr__drain_live(void *telemetry);
uint64_t tahr__drain_pass(tahr_telemetry *telemetry);

/* deliver.c: tells the sink what a record tells, or counts it as dropped once all is abandoned. */
void tahr__deliver(tahr_telemetry *telemetry, const void *record);

/* What the sink returned for a message. */
void tahr__deliver_count(tahr_telemetry *telemetry, uint32_t message, tahr_status status);

/* Only the thread that drains reads clocks. */
static inline int64_t tahr__clock_ns(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static inline int tahr__is_abandoned(tahr_telemetry *telemetry)
{
    return atomic_load_explicit(&telemetry->ending, memory_order_relaxed) == TAHR_STOP_ABANDON;
}

#endif

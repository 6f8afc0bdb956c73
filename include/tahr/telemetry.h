/* SPDX-License-Identifier: MIT
 * telemetry.h: what characters do, handed from the threads that step them to a sink (sink.h), without ever holding up a
 * step. Part of libtahr_threads, not of libtahr, which has no threads. */
#ifndef TAHR_TELEMETRY_H
#define TAHR_TELEMETRY_H

#include <tahr/sink.h>

#ifdef __cplusplus
extern "C" {
#endif

/* In every step, on the thread that takes it:
 *     tahr_telemetry_begin(telemetry, lane, id, config, &state);
 *     status = tahr_mover_step(mover, &input, dt, &state, &report);
 *     tahr_telemetry_push(telemetry, lane, &(tahr_telemetry_step){.character = id, .input = &input, ...});
 * and after every tahr_world_set, _move or _touch
 *     tahr_telemetry_change(telemetry, TAHR_CHANGE_MOVE, poses, count, dt, tahr_world_revision(world));
 *
 * Each thread that steps has a lane: a ring of fixed size with itself as the only writer and the telemetry's own thread
 * as the only reader. What finds no room is dropped and counted; an old message is never overwritten. While less than a
 * quarter of a ring is left, states are left out (and counted as dropped), so that events, inputs and changes outlive
 * them. */
typedef struct tahr_telemetry tahr_telemetry;

/* THIN_ALL: inputs and reports go with the states that are due; else only states are thinned out. Without every input
 * a recording cannot be repeated. */
enum { TAHR_TELEMETRY_THIN_ALL = 1 << 0 };

/* [in] everything is copied, but the sink's user. Zero what you do not use. */
typedef struct tahr_telemetry_desc {
    uint32_t struct_size;
    uint32_t flags;         /* TAHR_TELEMETRY_* */
    const tahr_sink *sink;  /* must stay valid until the telemetry is destroyed */
    uint32_t characters;    /* ids are below this; 1..2^20 */
    uint32_t lanes;         /* [0: 1] 1..64 */
    uint32_t ring_bytes;    /* [0: 4 MiB] of each lane, 4 KiB..1 GiB, rounded up to a power of two */
    uint32_t bodies;        /* most bodies with a place of their own that a snapshot of the world tells of, 0..2^20 */
    uint32_t every;         /* [0: 1] the state of every n-th step of a character */
    uint32_t config_count;  /* 1..65536 */
    double state_rate;      /* Hz: and no more states of a character than these in a simulated second; 0: all */
    double snapshot_period; /* [0: 10] s, simulated, 0.01..1e6 */
    double world_period;    /* [0: 1] s, 0.01..1e6 */
    double drain_period;    /* [0: 0.001] s for which the thread sleeps when the rings are empty, 1e-5..1 */
    const tahr_config *configs; /* what the characters' movers were created with; all of one struct_size */
    const char *level;          /* NULL: "" */
    const char *backend;        /* tahr_world_backend_name; NULL: "" */
    uint64_t level_hash;
    uint64_t revision;               /* tahr_world_revision */
    const tahr_allocator *allocator; /* NULL: malloc */
    const tahr_log *log;             /* NULL: silent */
} tahr_telemetry_desc;

/* Sets every field to its default: zero, but struct_size. [out] desc of size bytes. Untouched on error. Allocates
 * nothing; may run on several threads. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_desc_init(tahr_telemetry_desc *desc, size_t size);

/* Takes memory (the rings; some 1.3 kB for each character, and 128 B for each body) and starts the thread, which tells
 * the sink of the world at once. [out] telemetry, untouched on error; end it with tahr_telemetry_destroy.
 * Returns TAHR_OK, TAHR_E_NULL (desc, telemetry, sink, configs), TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (unknown flags
 * or tail), TAHR_E_ABI (sink of another ABI), TAHR_E_ARGUMENT (the log names the field), TAHR_E_MEMORY (also: the
 * system gives no thread). Since 0.1. */
TAHR_API tahr_status tahr_telemetry_create(const tahr_telemetry_desc *desc, tahr_telemetry **telemetry);

/* Before a step. Sends a snapshot where the state is not what the last step of this character left (its first step; you
 * wrote to it), where its config is another one, and every snapshot_period. Who never calls it has telemetry, but no
 * recording that can be repeated.
 * [in] lane below desc.lanes, always the same for one character, and used by one thread at a time; character, config;
 * state. Returns TAHR_OK, TAHR_TRUNCATED (there was no room: counted, and the snapshot is sent before the next step),
 * TAHR_E_NULL, TAHR_E_ARGUMENT (lane, character, config; a character of another lane). Allocates nothing, never waits,
 * calls nobody. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_begin(tahr_telemetry *telemetry, uint32_t lane, uint32_t character, uint32_t config,
                                          const tahr_state *state);

/* A step that was taken. Frozen; zero what you do not use. */
typedef struct tahr_telemetry_step {
    uint32_t character;
    tahr_status status; /* of the step; of one that failed nothing is sent */
    const tahr_input *input;
    const tahr_state *state;   /* after the step */
    const tahr_report *report; /* or NULL: neither report nor events */
    double dt;                 /* s */
    uint64_t ns;               /* how long the step took; 0: not measured */
    int64_t wall_ns;           /* ns since 1970; 0: the telemetry's thread reads the clock when it comes to it */
    uint32_t flags;            /* TAHR_STEP_* */
    uint32_t reserved;
} tahr_telemetry_step;

/* After a step: its input, its events, the state if it is due, its report. All of one step find room, or (but for the
 * state) none. Arguments as for tahr_telemetry_begin.
 * Returns TAHR_OK, TAHR_TRUNCATED (something was dropped and counted), TAHR_E_NULL, TAHR_E_ARGUMENT (also dt).
 * Allocates nothing, never waits, calls nobody. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_push(tahr_telemetry *telemetry, uint32_t lane, const tahr_telemetry_step *step);

/* After a change of the world, on the thread that has exclusive access to it (nobody may begin or push meanwhile). SET
 * at the start tells where bodies are that are not where they were described. Whatever is named is part of the
 * snapshots of the world from then on, which are sent every snapshot_period of dt.
 * [in] kind TAHR_CHANGE_SET, _MOVE or _TOUCH; poses, count of them (0..65536); dt (s, MOVE); revision after it.
 * Returns TAHR_OK, TAHR_TRUNCATED (dropped and counted; or more bodies than desc.bodies: no snapshot tells of the
 * others), TAHR_E_NULL, TAHR_E_ARGUMENT. Allocates nothing, never waits, calls nobody. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_change(tahr_telemetry *telemetry, uint32_t kind, const tahr_body_pose *poses,
                                           uint32_t count, double dt, uint64_t revision);

/* The present of a character, whatever the rings and the sink do: its state after the last step that was pushed, or as
 * tahr_telemetry_begin last saw it. [out] state; stamp (its sequence is that of the state, sent or not; wall_ns 0) or
 * NULL; untouched on error. May run on any thread, also while the character steps: then it looks again, which a thread
 * that steps without a pause could keep up for as long as it likes; after 1000 looks it is TAHR_UNKNOWN. Returns
 * TAHR_OK, TAHR_UNKNOWN, TAHR_E_NULL, TAHR_E_ARGUMENT (character), TAHR_E_NOT_FOUND (it has not been seen yet).
 * Allocates nothing, never waits. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_latest(const tahr_telemetry *telemetry, uint32_t character, tahr_state *state,
                                           tahr_stamp *stamp);

/* Sums since the start, by TAHR_MESSAGE_*. offered = thinned + dropped + delivered + failed + what is in the rings. */
typedef struct tahr_telemetry_counts {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t offered[TAHR_MESSAGE_COUNT];
    uint64_t thinned[TAHR_MESSAGE_COUNT];   /* not due: every, state_rate, THIN_ALL */
    uint64_t dropped[TAHR_MESSAGE_COUNT];   /* no room in the ring, or abandoned */
    uint64_t delivered[TAHR_MESSAGE_COUNT]; /* the sink took it */
    uint64_t failed[TAHR_MESSAGE_COUNT];    /* the sink returned an error */
    tahr_status last_failure;               /* which one, the last time */
    uint32_t most_filled;                   /* bytes that a ring held at most */
} tahr_telemetry_counts;

/* [out] counts, struct_size set by the caller; untouched on error. May run on any thread at any time; exact once the
 * telemetry has stopped (before, a step under way may be counted in part). Returns TAHR_OK, TAHR_E_NULL,
 * TAHR_E_STRUCT_SIZE. Allocates nothing, never waits. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_get_counts(const tahr_telemetry *telemetry, tahr_telemetry_counts *counts);

/* DRAIN: what is in the rings is still delivered. ABANDON: it is dropped, and counted. */
enum { TAHR_STOP_DRAIN = 1, TAHR_STOP_ABANDON = 2 };

/* Ends the thread, after at most timeout seconds (0..1e6): DRAIN becomes ABANDON when half of them are over. Nobody may
 * begin, push or change any more; counts and latest go on to answer. Again on one that has stopped: TAHR_OK.
 * Returns TAHR_OK, TAHR_TRUNCATED (not all was delivered: the counts say what), TAHR_E_TIMEOUT (the sink does not
 * return: its thread is left alone, and ends, without another call of the sink, when it does; the sink's user must stay
 * valid until then), TAHR_E_NULL, TAHR_E_ARGUMENT. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_stop(tahr_telemetry *telemetry, uint32_t how, double timeout);

/* Stops it, if that was not done (DRAIN, 2 s), and frees it; after TAHR_E_TIMEOUT the memory is freed by the thread
 * that was left alone, when the sink returns. NULL is allowed. Since 0.1. */
TAHR_API void tahr_telemetry_destroy(tahr_telemetry *telemetry);

/* "state", "event"; "?" for a number that is none. Static memory. May run on several threads. Since 0.1. */
TAHR_API const char *tahr_message_name(uint32_t message);

#ifdef __cplusplus
}
#endif
#endif

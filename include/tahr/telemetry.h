/* SPDX-License-Identifier: MIT
 * telemetry.h: what characters do, handed from the threads that step them to a sink (sink.h), without ever holding up a
 * step. Part of libtahr_threads, not of libtahr, which has no threads; who links it links libtahr behind it. */
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
 * quarter of a ring is left, states and reports are left out (and counted as dropped), so that inputs, events, changes
 * and snapshots outlive them. */
typedef struct tahr_telemetry tahr_telemetry;

/* THIN_ALL: inputs and reports go with the states that are due; else only states are thinned out. Without every input
 * a recording cannot be repeated. NARROW: states are compared without AVX2, as on processors that have none: slower, and
 * not another message. */
enum { TAHR_TELEMETRY_THIN_ALL = 1 << 0, TAHR_TELEMETRY_NARROW = 1 << 1 };

/* [in] everything is copied, but the sink's user, which must stay valid until the telemetry is destroyed (and see
 * tahr_telemetry_stop), and so must what allocator and log need. Zero what you do not use. */
typedef struct tahr_telemetry_desc {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_TELEMETRY_* */
    const tahr_sink *sink;
    uint32_t characters;   /* ids are below this; 1..2^20 */
    uint32_t lanes;        /* [0: 1] 1..64 */
    uint32_t ring_bytes;   /* [0: 4 MiB, or 512 B for each of bodies] of each lane, 4 KiB..1 GiB, and no less than 256 B
                          * for each of bodies; rounded up to a power of two. A step of a character that walks takes
                          * some 470 B, one with nothing but its input and events some 160 B */
    uint32_t bodies;       /* most bodies that snapshots of the world tell of, 0..2^20; 0: there are none */
    uint32_t every;        /* [0: 1] the state of every n-th step of a character */
    uint32_t config_count; /* 1..65536 */
    double state_rate; /* Hz, 1e-6..1e6: and no more states of a character than these in a simulated second; 0: all */
    double snapshot_period; /* [0: 10] s, simulated, 0.01..1e6 */
    double world_period;    /* [0: 1] s, 0.01..1e6 */
    double drain_period;    /* [0: 0.001] s for which the thread sleeps between two looks at the rings, 1e-5..1; it does
                             * not while one of them is filled by more than an eighth */
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

/* Takes memory, in one block (the rings; 1216 B for each character, some 150 B for each body; from 2 MiB on, and without
 * an allocator of yours, Linux is asked for large pages) and starts the thread, which takes no signals, and tells the
 * sink of the world at once. [out] telemetry, untouched on error; end it with tahr_telemetry_destroy.
 * Returns TAHR_OK, TAHR_E_NULL (desc, telemetry, sink or its name, configs, half an allocator), TAHR_E_STRUCT_SIZE
 * (desc, sink, configs), TAHR_E_UNSUPPORTED (unknown flags or tail), TAHR_E_ABI (sink of another ABI), TAHR_E_ARGUMENT
 * (a field out of its range, a config that is not valid), TAHR_E_MEMORY (also: the system gives no thread); the log
 * names what is wrong. May run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_create(const tahr_telemetry_desc *desc, tahr_telemetry **telemetry);

/* Before a step. If the sink has a function for it, sends a snapshot where the state is not what the last step of this
 * character left (its first step; you wrote to it), where its config is another one, every snapshot_period, and where
 * an input was dropped, as soon as there is room again. Who never calls it has telemetry, but no recording that can be
 * repeated.
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
    double dt;                 /* s, 0..10 */
    uint64_t ns;               /* how long the step took; 0: not measured */
    int64_t wall_ns;           /* ns since 1970; 0: the telemetry's thread reads the clock when it comes to it */
    uint32_t flags;            /* TAHR_STEP_* */
    uint32_t reserved;
} tahr_telemetry_step;

/* After a step: its input, its events, the state if it is due, its report. All of one step find room, or (but for state
 * and report) none. Lane and threads as for tahr_telemetry_begin; what the step wrote may be used again at once.
 * Returns TAHR_OK, TAHR_TRUNCATED (something was dropped and counted), TAHR_E_NULL (also: events are counted, but not
 * there), TAHR_E_STRUCT_SIZE (input, report), TAHR_E_UNSUPPORTED (flags), TAHR_E_ARGUMENT (lane, character, a character
 * of another lane, dt, reserved); on error nothing is sent or counted, and the step was not taken as far as the
 * telemetry knows. Allocates nothing, never waits, calls nobody: some 60 ns (backends/threads/README.md). Since 0.1. */
TAHR_API tahr_status tahr_telemetry_push(tahr_telemetry *telemetry, uint32_t lane, const tahr_telemetry_step *step);

/* After a change of the world, on the thread that has exclusive access to it (nobody may begin or push meanwhile). SET
 * at the start tells where bodies are that are not where they were described. Whatever is named is part of the
 * snapshots of the world from then on, which are sent with the first change and every snapshot_period of dt; but not
 * with a motion that is the first to name a body, for nobody said where that came from: then with the next change.
 * [in] kind TAHR_CHANGE_SET, _MOVE or _TOUCH; poses, count of them (0..65536, TOUCH: 0), not checked: the world has
 * taken them; dt (s, MOVE: up to 10; else 0); revision after it.
 * Returns TAHR_OK, TAHR_TRUNCATED (dropped and counted, for the whole change is one message; or more bodies than
 * desc.bodies, if that is not 0: no snapshot tells of the others), TAHR_E_NULL, TAHR_E_ARGUMENT. Allocates nothing,
 * never waits, calls nobody. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_change(tahr_telemetry *telemetry, uint32_t kind, const tahr_body_pose *poses,
                                           uint32_t count, double dt, uint64_t revision);

/* The present of a character, whatever the rings and the sink do: its state after the last step that was pushed, or as
 * tahr_telemetry_begin saw it since then, if it was written to (the stamp is then of the step that begins with it).
 * [out] state; stamp (its sequence is that of the state, sent or not; wall_ns 0) or NULL; untouched on error. May run
 * on any thread, also while the character steps: then it looks again, which a thread that steps without a pause could
 * keep up for as long as it likes; after 1000 looks it is TAHR_UNKNOWN. Returns TAHR_OK, TAHR_UNKNOWN, TAHR_E_NULL,
 * TAHR_E_ARGUMENT (character), TAHR_E_NOT_FOUND (it has not been seen yet). Allocates nothing, never waits.
 * Since 0.1. */
TAHR_API tahr_status tahr_telemetry_latest(const tahr_telemetry *telemetry, uint32_t character, tahr_state *state,
                                           tahr_stamp *stamp);

/* Sums since the start, by TAHR_MESSAGE_*, of what the sink has functions for (BODY: calls of change).
 * offered = thinned + dropped + delivered + failed + what is in the rings. */
typedef struct tahr_telemetry_counts {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t offered[TAHR_MESSAGE_COUNT];
    uint64_t thinned[TAHR_MESSAGE_COUNT];   /* not due: every, state_rate, THIN_ALL */
    uint64_t dropped[TAHR_MESSAGE_COUNT];   /* no room in the ring, or abandoned */
    uint64_t delivered[TAHR_MESSAGE_COUNT]; /* the sink took it */
    uint64_t failed[TAHR_MESSAGE_COUNT];    /* the sink returned an error */
    tahr_status last_failure;               /* which one, the last time */
    uint32_t most_filled;                   /* bytes that a ring held at most when the thread looked */
} tahr_telemetry_counts;

/* [out] counts, struct_size set by the caller; untouched on error. May run on any thread at any time; exact once the
 * telemetry has stopped (before, what is under way may be counted in part). Returns TAHR_OK, TAHR_E_NULL,
 * TAHR_E_STRUCT_SIZE. Allocates nothing, never waits. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_get_counts(const tahr_telemetry *telemetry, tahr_telemetry_counts *counts);

/* DRAIN: what is in the rings is still delivered. ABANDON: it is dropped, and counted. */
enum { TAHR_STOP_DRAIN = 1, TAHR_STOP_ABANDON = 2 };

/* Ends the thread, after at most timeout seconds (0..1e6): DRAIN becomes ABANDON when half of them are over. Nobody may
 * begin, push or change any more; counts and latest go on to answer. One thread at a time. Again on one that has
 * stopped: TAHR_OK; again after TAHR_E_TIMEOUT: waits again.
 * Returns TAHR_OK, TAHR_TRUNCATED (something was abandoned: the counts say what), TAHR_E_TIMEOUT (the sink does not
 * return: its thread is left alone, and ends, without another call of the sink, when it does; the sink's user must stay
 * valid until then), TAHR_E_NULL, TAHR_E_ARGUMENT. Since 0.1. */
TAHR_API tahr_status tahr_telemetry_stop(tahr_telemetry *telemetry, uint32_t how, double timeout);

/* Stops it, if that was not done (DRAIN, 2 s), and frees it; after TAHR_E_TIMEOUT the memory is freed by the thread
 * that was left alone, when the sink returns: the allocator must still do it then. NULL is allowed. Since 0.1. */
TAHR_API void tahr_telemetry_destroy(tahr_telemetry *telemetry);

/* "state", "event"; "?" for a number that is none. Static memory. May run on several threads. Since 0.1. */
TAHR_API const char *tahr_message_name(uint32_t message);

#ifdef __cplusplus
}
#endif
#endif

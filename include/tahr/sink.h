/* SPDX-License-Identifier: MIT
 * sink.h: for authors of telemetry sinks: who receives what characters do. tahr_telemetry (telemetry.h) stands between
 * the threads that step and a sink, and calls it from a thread of its own; <tahr/lcm.h> brings one that publishes over
 * LCM. */
#ifndef TAHR_SINK_H
#define TAHR_SINK_H

#include <tahr/mover.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a sink is told, and an index into counts. */
enum {
    TAHR_MESSAGE_STATE = 0,
    TAHR_MESSAGE_EVENT = 1,
    TAHR_MESSAGE_INPUT = 2,
    TAHR_MESSAGE_REPORT = 3,
    TAHR_MESSAGE_SNAPSHOT = 4,
    TAHR_MESSAGE_BODY = 5,
    TAHR_MESSAGE_WORLD = 6,
    TAHR_MESSAGE_COUNT = 7
};

/* Which step of whom a message tells of. Frozen. */
typedef struct tahr_stamp {
    uint32_t character; /* id, below tahr_telemetry_desc.characters */
    uint32_t config;    /* index of its settings: tahr_sink_world.configs */
    uint64_t step;      /* of this character, from 0; SNAPSHOT: the step that begins with it */
    uint64_t sequence;  /* of this kind of message of this character, from 0, without those that were thinned out: who
                         * misses a number has lost a message */
    uint64_t epoch;     /* changes of the world before the step */
    int64_t time_ns; /* simulated, since the character's first step: at its end; of an event exactly; SNAPSHOT: at its
                         * begin */
    int64_t wall_ns; /* since 1970, as the caller said, or else when the message was taken from the ring */
} tahr_stamp;

/* CUSTOM: the step may have run the caller's own mode. CROWD: taken by tahr_crowd_step among others that it meets.
 * Neither can be repeated from its input alone. */
enum { TAHR_STEP_CUSTOM = 1 << 0, TAHR_STEP_CROWD = 1 << 1 };

/* What a step was given. Frozen. */
typedef struct tahr_sink_input {
    const tahr_input *input; /* with flags 0 the fields from facing on, which do not count then, are 0 */
    double dt;               /* s */
    uint32_t flags;          /* TAHR_STEP_* */
    uint32_t reserved;
} tahr_sink_input;

/* What a step came to. Frozen. */
typedef struct tahr_sink_report {
    const tahr_report *report; /* its arrays are NULL, event_count tells how many events there were */
    uint64_t hash;             /* tahr_state_hash of the state after the step */
    uint64_t ns;               /* how long it took, if the caller measured it; else 0 */
    tahr_status status;        /* of the step */
    uint32_t reserved;
} tahr_sink_report;

/* SNAPSHOT: nothing changed; this is where all bodies are, for who comes late or missed a change. */
enum { TAHR_CHANGE_SET = 1, TAHR_CHANGE_MOVE = 2, TAHR_CHANGE_TOUCH = 3, TAHR_CHANGE_SNAPSHOT = 4 };

/* A change of the world: tahr_world_set, _move or _touch. To have the world of a SNAPSHOT: tahr_world_set to `before`,
 * and if dt > 0 tahr_world_move to `poses` within dt; a body that it does not name was never named (or
 * found no place: tahr_telemetry_desc.bodies). A SNAPSHOT follows
 * the change whose epoch it has. Frozen. */
typedef struct tahr_sink_change {
    uint32_t kind;                /* TAHR_CHANGE_* */
    uint32_t count;               /* of poses */
    const tahr_body_pose *poses;  /* where they are now; TAHR_POSE_TELEPORT: jumped there */
    const tahr_body_pose *before; /* SNAPSHOT: where the last motion began, in the same order; else NULL */
    double dt;                    /* s, MOVE; SNAPSHOT: of the last motion, 0: at rest */
    uint64_t epoch;               /* how many changes there have been, this one among them */
    uint64_t revision;            /* tahr_world_revision after it */
    int64_t wall_ns;
} tahr_sink_change;

/* What the steps are taken in, and how the telemetry fares. Frozen. */
typedef struct tahr_sink_world {
    const char *level;          /* name of the scene */
    const char *backend;        /* name of the collision engine */
    uint64_t level_hash;        /* of the caller's making; equal scenes have equal ones */
    const tahr_config *configs; /* config_count of them */
    uint32_t config_count;
    uint32_t characters;      /* ids are below this */
    int64_t run;              /* wall clock at the start, ns since 1970: tells one run from the next */
    int64_t wall_ns;          /* now */
    uint64_t sequence;        /* of this kind of message */
    uint64_t epoch, revision; /* of the world, at the moment */
    uint64_t dropped, failed; /* messages so far: for which a ring had no room; which the sink could not deliver */
    double state_rate;        /* Hz to which the states of a character are thinned out; 0: not */
} tahr_sink_world;

/* Called by one thread at a time, never by one that steps. What is pointed to is valid during the call. A negative
 * status is counted as a failed message, and nothing else. Functions may be NULL: nobody wants that, and it is neither
 * sent nor counted. A function that does not return holds up the others, but no step: what comes meanwhile is dropped
 * when the rings are full.
 * In order: of a step its input, its events, its state, its report; the steps of a character as they were taken; a
 * change of the world before all steps that see it and after all that do not. Steps of different characters come in any
 * order between two changes.
 * world: first of all, then once in a world_period, and last of all, with the totals. flush: nothing more is there at
 * the moment. */
typedef struct tahr_sink {
    uint32_t struct_size;
    uint16_t abi_major; /* TAHR_ABI_MAJOR and _MINOR of the header it was compiled with */
    uint16_t abi_minor;
    const char *name; /* short, lower case; static memory */
    void *user;
    tahr_status (*state)(void *user, const tahr_stamp *stamp, const tahr_state *state);
    tahr_status (*event)(void *user, const tahr_stamp *stamp, const tahr_event *event);
    tahr_status (*input)(void *user, const tahr_stamp *stamp, const tahr_sink_input *input);
    tahr_status (*report)(void *user, const tahr_stamp *stamp, const tahr_sink_report *report);
    tahr_status (*snapshot)(void *user, const tahr_stamp *stamp, const tahr_state *state);
    tahr_status (*change)(void *user, const tahr_sink_change *change);
    tahr_status (*world)(void *user, const tahr_sink_world *world);
    void (*flush)(void *user);
} tahr_sink;

#ifdef __cplusplus
}
#endif
#endif

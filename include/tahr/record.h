/* SPDX-License-Identifier: MIT
 * record.h: watching a world: somebody who is told all that decides its steps, and stands between it and its backend.
 * trace.h writes with it what it hears to a file, and answers from one; most users want that, and need none of this. */
#ifndef TAHR_RECORD_H
#define TAHR_RECORD_H

#include <tahr/backend.h>
#include <tahr/mover.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the library remembers of a body. Frozen. */
typedef struct tahr_record_body {
    tahr_pose pose;             /* now */
    tahr_pose before;           /* where the motion of the last tahr_world_move began */
    tahr_vec3 surface_velocity; /* m/s, local */
    double dt;                  /* s of that motion; 0: at rest */
    double reach;               /* m, radius around its position that holds all of it */
    double mass;                /* kg */
    double fluid_friction;      /* 1/s */
    uint64_t pose_hash;         /* its share of the world's revision, */
    uint64_t motion_hash;       /* and of its motion */
    uint32_t flags;             /* TAHR_BODY_* */
    uint32_t jumped;            /* number of the tahr_world_move when it was put there without a motion; 0: never */
} tahr_record_body;

/* The world as a recording begins. Frozen. */
typedef struct tahr_record_world {
    const tahr_backend *backend; /* behind it, and */
    void *self;                  /* its scene */
    tahr_record_body *bodies;    /* body_count of them, valid during the call */
    uint64_t revision;           /* tahr_world_revision is the sum of this and */
    uint64_t motion;
    uint64_t last_revision;
    uint32_t body_count;
    uint32_t has;     /* what the steps look for: bits of the library's own */
    uint32_t moves;   /* calls of tahr_world_move, from 1 */
    uint32_t derived; /* the most sweeps that a contacts query is made of, for callbacks without contacts; else 0 */
} tahr_record_world;

enum { TAHR_RECORD_SET = 1, TAHR_RECORD_MOVE = 2, TAHR_RECORD_TOUCH = 3 };

/* A successful tahr_world_set, _move or _touch. Frozen. */
typedef struct tahr_record_move {
    uint32_t kind; /* TAHR_RECORD_* */
    uint32_t count;
    const tahr_body_pose *poses; /* valid during the call */
    double dt;                   /* s, MOVE */
} tahr_record_move;

/* CUSTOM: the step may run the caller's own mode, which nobody can run again without the caller. EVENTS: its report has
 * room for events, for which some questions more are asked. */
enum { TAHR_RECORD_CUSTOM = 1, TAHR_RECORD_EVENTS = 2 };

/* A step that begins: all that it depends on but the world. The pointers are valid until it ends. Frozen. */
typedef struct tahr_record_step {
    uint32_t mover; /* from 0, in the order of their first steps */
    uint32_t flags; /* TAHR_RECORD_CUSTOM, _EVENTS */
    const tahr_config *config;
    const tahr_input *input;
    const tahr_state *state;
    double dt;
} tahr_record_step;

/* And how it ended. Frozen. */
typedef struct tahr_record_done {
    uint32_t mover;
    tahr_status status;
    uint64_t hash; /* tahr_state_hash of state */
    const tahr_state *state;
} tahr_record_done;

/* RESTORES: begin changes what it is told of the world (but neither the number of bodies nor the pointer to them), and
 * the world becomes that. */
enum { TAHR_RECORDER_RESTORES = 1 };

/* Functions may be NULL. They are called on the thread that calls the library, and must not call back into the world.
 * begin: [in,out] world; it may put a backend and a scene of its own in the place of the world's, which are asked from
 * then on and have to hand on what they are asked; both must stay as they are until `end`. A negative status refuses.
 * end: the recording is over: the world was closed, or it is told to be. */
typedef struct tahr_recorder {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_RECORDER_* */
    void *user;
    tahr_status (*begin)(void *user, tahr_record_world *world);
    void (*move)(void *user, const tahr_record_move *move);
    void (*step)(void *user, const tahr_record_step *step);
    void (*done)(void *user, const tahr_record_done *done);
    void (*end)(void *user);
} tahr_recorder;

/* Lets a recorder watch a world from now on, at any time between steps; NULL ends it, another one takes its place. Its
 * movers need not know; who sleeps is computed all the same while it lasts. Needs exclusive access, and until it ends
 * only one thread may step, ask or change the world. recorder is copied. Without one a world is as fast as ever.
 * Returns TAHR_OK, TAHR_E_NULL (world), TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (unknown flags or tail), TAHR_E_MEMORY,
 * TAHR_E_REENTRANT (inside a recorded step), TAHR_E_ARGUMENT (what begin restored is out of range), and what begin
 * returned; then no recorder watches. Allocates from the world's allocator. Since 0.1. */
TAHR_API tahr_status tahr_world_record(tahr_world *world, const tahr_recorder *recorder);

#ifdef __cplusplus
}
#endif
#endif

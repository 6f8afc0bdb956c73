/* SPDX-License-Identifier: MIT
 * mover.h: the state of a character, its input, the report of a step, and the step itself. */
#ifndef TAHR_MOVER_H
#define TAHR_MOVER_H

#include <tahr/config.h>
#include <tahr/world.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_mover tahr_mover;

enum { TAHR_MODE_NONE = 0, TAHR_MODE_WALKING = 1, TAHR_MODE_FALLING = 2 };

enum {
    TAHR_FLOOR_BLOCKING = 1 << 0, /* something is below, within reach */
    TAHR_FLOOR_WALKABLE = 1 << 1, /* and can be stood on */
    TAHR_FLOOR_PERCHING = 1 << 2, /* held up at the rim of the shape; a floor further in allows it */
    TAHR_FLOOR_WEDGED = 1 << 3,   /* held by several faces, each too steep to stand on */
    TAHR_FLOOR_RIM = 1 << 4,      /* something touches the rim of the shape; the floor was found by a thinner one */
    TAHR_FLOOR_FACE = 1 << 5,     /* the face that holds is walkable by itself, without a perch */
    TAHR_FLOOR_SLOPE = 1 << 6     /* and large enough for its slope to set the speed; found out once for each face */
};

/* What is below the shape. distance is the way down until the shape would be skin above it, plus skin. */
typedef struct tahr_floor {
    tahr_vec3 normal;         /* contact normal */
    tahr_vec3 surface_normal; /* of the face */
    tahr_vec3 point;
    double distance;       /* m */
    double perch_distance; /* m, with PERCHING: down to the floor further in */
    uint32_t flags;        /* TAHR_FLOOR_* */
    uint32_t body;
    uint32_t feature;
    uint32_t surface;
} tahr_floor;

enum {
    TAHR_STATE_JUMP_HELD = 1 << 0,  /* the jump button was down in the last step */
    TAHR_STATE_JUMPING = 1 << 1,    /* rising by a jump */
    TAHR_STATE_FLOOR_MOVED = 1 << 2 /* the height was corrected after floor was looked for */
};

/* Everything that decides a character's future. Frozen, 512 bytes, no pointers: copy it to remember, compare it with
 * memcmp to check a rollback, hash it to detect a desync. The reserved tail is zero. You may write position, velocity,
 * orientation and mode between steps; the floor is looked for again wherever position is not floor_position. */
typedef struct tahr_state {
    tahr_vec3 position;    /* m, world, centre of the shape */
    tahr_vec3 velocity;    /* m/s, world */
    tahr_quat orientation; /* its z axis is up (keep it so when you write it); yaw follows input.facing */
    tahr_vec3 up;
    uint32_t mode;  /* TAHR_MODE_* */
    uint32_t flags; /* TAHR_STATE_* */
    tahr_floor floor;
    tahr_vec3 floor_position; /* where floor was looked for */
    uint64_t floor_revision;  /* world revision at which floor was looked for; 0: look again */
    double jump_hold;         /* s, time for which gravity is still suspended */
    uint8_t reserved[256];
} tahr_state;

enum { TAHR_INPUT_GRAVITY = 1 << 0, TAHR_INPUT_FACING = 1 << 1 };

/* What the player or an AI wants during one step. */
typedef struct tahr_input {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_INPUT_*: which of the optional fields below count */
    uint32_t jump;  /* 1 while the button is held; a jump starts when it goes down */
    uint32_t reserved;
    tahr_vec3 move;    /* world; length 0..1 of max_speed, longer is shortened to 1; the part along up is ignored */
    tahr_vec3 facing;  /* with FACING: turn toward this direction */
    tahr_vec3 gravity; /* m/s2, with GRAVITY: instead of config.gravity */
} tahr_input;

enum {
    TAHR_EVENT_LANDED = 1, /* value: speed against up, m/s, whatever the slope of the floor; 0 if it was rising */
    TAHR_EVENT_LEFT_GROUND = 2,
    TAHR_EVENT_JUMPED = 3,
    TAHR_EVENT_APEX = 4,
    TAHR_EVENT_STOPPED = 5,
    TAHR_EVENT_STEPPED_UP = 6,   /* value: height of the step, m */
    TAHR_EVENT_STEPPED_DOWN = 7, /* value: height lost, m */
    TAHR_EVENT_HIT = 8,          /* blocked by something that is no floor; value: speed into it, m/s */
    TAHR_EVENT_DEPENETRATED = 9, /* value: length of the push, m */
    TAHR_EVENT_CRUSHED = 10,     /* value: depth that is left, m */
    TAHR_EVENT_STUCK = 11,
    TAHR_EVENT_MODE = 12 /* value: the new mode */
};

/* Something that happened inside a step. time counts from the start of the step, in order. Frozen. */
typedef struct tahr_event {
    uint32_t type; /* TAHR_EVENT_* */
    uint32_t body; /* or TAHR_NO_BODY */
    uint32_t feature;
    uint32_t surface;
    double time;        /* s */
    double value;       /* see the type */
    tahr_vec3 position; /* of the character */
    tahr_vec3 normal;   /* contact normal, or zero */
} tahr_event;

/* The rules whose decisions can be traced: X(constant, value, name). */
#define TAHR_RULE_TABLE(X)                           \
    X(TAHR_RULE_WALKABLE, 1, "walkable")             \
    X(TAHR_RULE_EDGE_TOLERANCE, 2, "edge_tolerance") \
    X(TAHR_RULE_PERCH, 3, "perch")                   \
    X(TAHR_RULE_FLOOR, 4, "floor")                   \
    X(TAHR_RULE_CACHED_FLOOR, 5, "cached_floor")     \
    X(TAHR_RULE_FLOOR_HEIGHT, 6, "floor_height")     \
    X(TAHR_RULE_RAMP, 7, "ramp")                     \
    X(TAHR_RULE_SLIDE, 8, "slide")                   \
    X(TAHR_RULE_STEP_UP, 9, "step_up")               \
    X(TAHR_RULE_STEP_DOWN, 10, "step_down")          \
    X(TAHR_RULE_LANDING, 11, "landing")              \
    X(TAHR_RULE_WEDGE, 12, "wedge")                  \
    X(TAHR_RULE_LEDGE, 13, "ledge")                  \
    X(TAHR_RULE_DEPENETRATION, 14, "depenetration")  \
    X(TAHR_RULE_JUMP, 15, "jump")                    \
    X(TAHR_RULE_SWEEP, 16, "sweep")                  \
    X(TAHR_RULE_SLOPE, 17, "slope")

enum {
#define TAHR_RULE_ENUM(constant, value, name) constant = (value),
    TAHR_RULE_TABLE(TAHR_RULE_ENUM)
#undef TAHR_RULE_ENUM
};

/* One decision: rule accepted (1) or rejected (0) something because value stood so to limit. reason: static text.
 * Frozen. */
typedef struct tahr_decision {
    uint32_t rule;
    uint32_t accepted;
    uint32_t body;
    uint32_t feature;
    double value;
    double limit;
    tahr_vec3 normal;
    tahr_vec3 point;
    const char *reason;
} tahr_decision;

/* Facts about a step that are no errors; the step's status is the worst of them. */
enum {
    TAHR_REPORT_UNKNOWN = 1 << 0, /* a query could not be decided */
    TAHR_REPORT_STUCK = 1 << 1,
    TAHR_REPORT_CRUSHED = 1 << 2,
    TAHR_REPORT_QUERY_CAP = 1 << 3,
    TAHR_REPORT_TRUNCATED = 1 << 4,  /* events or decisions were lost: see the counts */
    TAHR_REPORT_UP_REFUSED = 1 << 5, /* the new up direction would have overlapped something; the old one stays */
    TAHR_REPORT_CACHED_FLOOR = 1 << 6,
    TAHR_REPORT_ASLEEP = 1 << 7 /* a step like the last one, which changed nothing: not computed, no queries counted */
};

/* The most queries one step may ask, whatever the world answers; then it stops where it is and says so. */
#define TAHR_MAX_QUERIES_PER_STEP 256u

/* What a step did. Set struct_size and the two arrays (NULL allowed); everything else is written by the step. */
typedef struct tahr_report {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_REPORT_* */
    tahr_event *events;
    tahr_decision *decisions;
    uint32_t event_capacity, event_count, events_lost;
    uint32_t decision_capacity, decision_count, decisions_lost;
    uint32_t sweeps;
    uint32_t contact_queries;
    uint32_t rays;
    uint32_t slides; /* times a motion was bent */
    uint32_t slices; /* pieces of time */
    uint32_t reserved;
    uint64_t triangle_tests; /* shape against feature, in the narrow phase */
    uint64_t narrow_iterations;
    uint64_t gathers;
    uint64_t escapes;
    double step_offset; /* m along up: sudden rise or drop by steps and snaps, for smoothing what is shown */
    double residual;    /* m, deepest overlap that is left */
    double time_lost;   /* s, not simulated because a cap was reached */
} tahr_report;

/* A character at rest at a place, in free air or on the ground: mode FALLING until a step finds the floor; up opposite
 * to config.gravity.
 * [out] state; [in] config (valid), position (finite, |x| <= 1e7 m).
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED, TAHR_E_ARGUMENT (config or position); untouched
 * on error. Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_state_init(tahr_state *state, const tahr_config *config, const tahr_vec3 *position);

/* 64-bit FNV-1a hash of the 512 bytes with -0.0 read as 0.0; equal states have equal hashes on every machine (bytes of
 * each word from the lowest). 0 for NULL. Since 0.1. */
TAHR_API uint64_t tahr_state_hash(const tahr_state *state);

/* Scratch memory and gather cache of one character at a time; holds nothing that matters to gameplay, so one mover may
 * step many characters and any state may be stepped by any mover of the same world and config, with the same bits.
 * [in] world, which must outlive the mover; config, copied. [out] mover, untouched on error; destroy it with
 * tahr_mover_destroy. Allocates from the world's allocator. May run on several threads, also while movers of the world
 * step, if that allocator and the log may be called so; not while the world is opened, changed or closed.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (shape not among the backend's, unknown tail of
 * config not zero), TAHR_E_ARGUMENT (the log names the field), TAHR_E_MEMORY. Since 0.1. */
TAHR_API tahr_status tahr_mover_create(tahr_world *world, const tahr_config *config, tahr_mover **mover);

/* Frees a mover; its world must still be open and no step of it under way. NULL is allowed. Threads as for
 * tahr_mover_create. Since 0.1. */
TAHR_API void tahr_mover_destroy(tahr_mover *mover);

/* Moves one character through dt seconds. World frame, SI units.
 * [in] input: |move| and |facing| up to 1e6, |gravity| up to 1e4 m/s2; dt in [0, config.max_dt] (0: nothing changes,
 * the report is zeroed; below 1e-9 s nothing moves); [in,out] state: |position| up to 2e7 m, |velocity| up to 1e5 m/s,
 * unit up and orientation; [out] report or NULL.
 * Returns TAHR_OK; TAHR_QUERY_CAP, TAHR_CRUSHED, TAHR_STUCK, TAHR_UNKNOWN, TAHR_TRUNCATED (the worst flag of the
 * report, in this order); on error state and report are untouched (not what events and decisions point to):
 * TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (unknown tail of input not zero), TAHR_E_ARGUMENT (dt, input or
 * state not finite or out of range; the log names the field), TAHR_E_BACKEND, TAHR_E_REENTRANT.
 * Allocates nothing. Pure: the result depends on world, config, input, dt and state only. Different movers may step on
 * different threads at once. Queries: at most TAHR_MAX_QUERIES_PER_STEP; on flat ground 2 sweeps moving, 1 standing, 0
 * standing on a cached floor or asleep. Since 0.1. */
TAHR_API tahr_status tahr_mover_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                     tahr_report *report);

/* "walking", "landed", "step_up"; "?" for a number that is none. Static memory. Since 0.1. */
TAHR_API const char *tahr_mode_name(uint32_t mode);
TAHR_API const char *tahr_event_name(uint32_t type);
TAHR_API const char *tahr_rule_name(uint32_t rule);

#ifdef __cplusplus
}
#endif
#endif

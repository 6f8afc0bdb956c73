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

/* NONE: frozen. HANGING: on an edge (config.ledge_grab); floor tells of it: point on top, normal of the wall.
 * CUSTOM: the caller's own function (tahr_mover_set_custom_mode). */
enum {
    TAHR_MODE_NONE = 0,
    TAHR_MODE_WALKING = 1,
    TAHR_MODE_FALLING = 2,
    TAHR_MODE_SWIMMING = 3,
    TAHR_MODE_FLYING = 4,
    TAHR_MODE_HANGING = 5,
    TAHR_MODE_CUSTOM = 6
};

enum {
    TAHR_FLOOR_BLOCKING = 1 << 0, /* something is below, within reach */
    TAHR_FLOOR_WALKABLE = 1 << 1, /* and can be stood on */
    TAHR_FLOOR_PERCHING = 1 << 2, /* held up at the rim of the shape; a floor further in allows it */
    TAHR_FLOOR_WEDGED = 1 << 3,   /* held by several faces, each too steep to stand on */
    TAHR_FLOOR_RIM = 1 << 4,      /* something touches the rim of the shape; the floor was found by a thinner one */
    TAHR_FLOOR_FACE = 1 << 5,     /* the face that holds is walkable by itself, without a perch */
    TAHR_FLOOR_SLOPE = 1 << 6,    /* and large enough for its slope to set the speed; found out once for each face */
    TAHR_FLOOR_LINE = 1 << 7      /* SHRUNK: a ray found it under the axis; perch_distance is how deep */
};

/* What is below the shape. distance is the way down until the shape would be skin above it, plus skin; with SHRUNK until
 * it touches, negative where it overlaps. */
typedef struct tahr_floor {
    tahr_vec3 normal;         /* contact normal */
    tahr_vec3 surface_normal; /* of the face */
    tahr_vec3 point;
    double distance;       /* m */
    double perch_distance; /* m, with PERCHING or LINE: down to the floor further in */
    uint32_t flags;        /* TAHR_FLOOR_* */
    uint32_t body;
    uint32_t feature;
    uint32_t surface;
} tahr_floor;

enum {
    TAHR_STATE_JUMP_HELD = 1 << 0,    /* the jump button was down in the last step */
    TAHR_STATE_JUMPING = 1 << 1,      /* rising by a jump */
    TAHR_STATE_FLOOR_MOVED = 1 << 2,  /* the height was corrected after floor was looked for */
    TAHR_STATE_CROUCHED = 1 << 3,     /* smaller than config.shape */
    TAHR_STATE_JUMP_SPENT = 1 << 4,   /* this press of the jump button has started its jump (if a setting needs it) */
    TAHR_STATE_WALL_TOUCHED = 1 << 5, /* in the air, within 1.5 skin of the wall that wall_normal tells of */
    TAHR_STATE_WALL_SPENT = 1 << 6,   /* that wall was jumped off: not again before ground or another wall */
    TAHR_STATE_EDGE_SPENT =
        1 << 7, /* an edge at the height of floor.point was let go: none there again before falling below it */
    TAHR_STATE_CRUSHED = 1 << 8 /* overlaps something that it could not be pushed out of */
};

/* The body that carries the character. */
typedef struct tahr_base {
    uint32_t body;      /* or TAHR_NO_BODY */
    uint32_t seen;      /* low half of the world's revision in the last step while bodies move, else 0 */
    tahr_pose pose;     /* of the body, as the last step saw it */
    tahr_vec3 velocity; /* m/s, world: of the body at the foot, or what it was until it stopped (config.lift_momentum);
                         * after it was left, what of it the character still has */
} tahr_base;

enum { TAHR_MAX_TOUCHED = 8 };

/* Everything that decides a character's future. Frozen, 512 bytes, no pointers: copy it to remember, compare it with
 * memcmp to check a rollback, hash it to detect a desync. The reserved tail is zero. You may write position, velocity,
 * orientation and mode between steps; the floor is looked for again wherever position is not floor_position. */
typedef struct tahr_state {
    tahr_vec3 position;    /* m, world, centre of the shape */
    tahr_vec3 velocity;    /* m/s, along the world's axes; on a base (base.body) relative to it */
    tahr_quat orientation; /* its z axis is up (keep it so when you write it); yaw follows input.facing */
    tahr_vec3 up;
    uint32_t mode;  /* TAHR_MODE_* */
    uint32_t flags; /* TAHR_STATE_* */
    tahr_floor floor;
    tahr_vec3 floor_position; /* where floor was looked for */
    uint64_t floor_revision;  /* world revision at which floor was looked for; 0: look again */
    double jump_hold;         /* s, time for which gravity is still suspended */
    double radius;            /* m, of the shape now: config.shape unless crouched or changed */
    double half_height;       /* m */
    tahr_base base;
    uint32_t touched[TAHR_MAX_TOUCHED]; /* sensors that it overlaps, the lowest ids, ascending, then TAHR_NO_BODY */
    uint32_t touched_count;
    uint32_t jump_count;   /* air jumps since it last stood, swam or hung */
    double coyote_left;    /* s for which a jump may still start after the floor ended */
    double buffer_left;    /* s for which a jump asked for in the air still counts */
    double lift_left;      /* s for which base.velocity is still imparted */
    double wall_left;      /* s for which a wall jump may still start after the wall was left */
    tahr_vec3 wall_normal; /* of the last wall touched in the air, jumped off or hung on, level; zero: none */
    uint32_t wall_body;    /* or TAHR_NO_BODY */
    uint32_t wall_feature;
    uint32_t drop_body; /* one-way platform being dropped through, or TAHR_NO_BODY */
    uint32_t drop_feature;
    uint8_t reserved[40];
} tahr_state;

enum {
    TAHR_INPUT_GRAVITY = 1 << 0,
    TAHR_INPUT_FACING = 1 << 1,
    TAHR_INPUT_MODE = 1 << 2,   /* change to input.mode at the start of this step: WALKING needs a floor within
                                 * config.snap_distance, SWIMMING a fluid deep enough, CUSTOM a function */
    TAHR_INPUT_SHAPE = 1 << 3,  /* have radius and half_height in this step; growing waits until there is room */
    TAHR_INPUT_LAUNCH = 1 << 4, /* add launch to the velocity, and leave the ground or an edge; ends a held jump */
    TAHR_INPUT_LAUNCH_LEVEL = 1 << 5, /* with LAUNCH: the part across up replaces that of the velocity */
    TAHR_INPUT_LAUNCH_UP = 1 << 6,    /* with LAUNCH: the part along up replaces it */
    TAHR_INPUT_IMPULSE = 1 << 7,      /* add impulse / config.mass; leaves the ground if that points upward */
    TAHR_INPUT_DRIVE = 1 << 8,       /* drive is the velocity of this step (root motion); walking, its part across up */
    TAHR_INPUT_DRIVE_ADD = 1 << 9,   /* with DRIVE: it comes on top of state.velocity, and is not kept in it */
    TAHR_INPUT_DRIVE_LEVEL = 1 << 10 /* with DRIVE: only across up; falling goes on */
};

/* What the player or an AI wants during one step. */
typedef struct tahr_input {
    uint32_t struct_size;
    uint32_t flags;  /* TAHR_INPUT_*: which of the optional fields below count */
    uint32_t jump;   /* 1 while the button is held; a jump starts when it goes down */
    uint32_t crouch; /* 1 while crouched: half height config.crouched_half_height, about the foot on ground, else about
                      * the centre; not of spheres, not while hanging */
    tahr_vec3 move; /* world; length 0..1 of the mode's speed, longer is shortened to 1; the part along up counts only in
                        * swimming and flying */
    tahr_vec3 facing;   /* with FACING: turn toward this direction */
    tahr_vec3 gravity;  /* m/s2, with GRAVITY: instead of config.gravity */
    double radius;      /* m, with SHAPE; not of boxes */
    double half_height; /* m, with SHAPE */
    tahr_vec3 launch;   /* m/s, with LAUNCH */
    tahr_vec3 impulse;  /* N s, with IMPULSE */
    tahr_vec3 drive;    /* m/s, with DRIVE */
    uint32_t mode;      /* with MODE */
    uint32_t reserved;
} tahr_input;

enum {
    TAHR_EVENT_LANDED = 1,      /* value: speed against up, m/s, whatever the slope of the floor; 0 if it was rising */
    TAHR_EVENT_LEFT_GROUND = 2, /* value: why, TAHR_LEFT_* */
    TAHR_EVENT_JUMPED = 3,
    TAHR_EVENT_APEX = 4,
    TAHR_EVENT_STOPPED = 5,
    TAHR_EVENT_STEPPED_UP = 6,   /* value: height of the step or of the edge climbed, m */
    TAHR_EVENT_STEPPED_DOWN = 7, /* value: height lost, m */
    TAHR_EVENT_HIT = 8,          /* blocked by something that is no floor; value: speed into it, m/s */
    TAHR_EVENT_DEPENETRATED = 9, /* value: length of the push, m */
    TAHR_EVENT_CRUSHED = 10,     /* value: depth that is left, m */
    TAHR_EVENT_STUCK = 11,
    TAHR_EVENT_MODE = 12, /* value: the new mode */
    /* Of a sensor, a fluid too; both in one step: passed through. At the time and the place at which the shape met or left
     * it; what came, went or is not met any more without a motion of the character's: at the start of the step. What does
     * not fit into state.touched begins when there is room for it. */
    TAHR_EVENT_OVERLAP_BEGIN = 13,
    TAHR_EVENT_OVERLAP_END = 14,
    TAHR_EVENT_BASE = 15,        /* stands on another body (or TAHR_NO_BODY) */
    TAHR_EVENT_SHAPE = 16,       /* value: the new half height, m */
    TAHR_EVENT_LAUNCHED = 17,    /* by LAUNCH, or off the ground by IMPULSE; value: speed then, m/s */
    TAHR_EVENT_PUSHED = 18,      /* pushes a body that has a mass: at position, against normal; value: impulse, N s */
    TAHR_EVENT_WALL_JUMPED = 19, /* instead of JUMPED; value: speed away from the wall, m/s */
    TAHR_EVENT_GRABBED = 20,     /* hangs on an edge */
    TAHR_EVENT_CUSTOM = 21       /* of tahr_step_event; value: the caller's own */
};

/* Why the ground was left: value of LEFT_GROUND. */
enum {
    TAHR_LEFT_LEDGE = 0, /* the floor ended */
    TAHR_LEFT_JUMP = 1,
    TAHR_LEFT_LAUNCH = 2,
    TAHR_LEFT_MODE = 3 /* another mode was asked for, or a fluid was entered */
};

/* Something that happened inside a step. time counts from the start of the step, in order. Frozen. */
typedef struct tahr_event {
    uint32_t type; /* TAHR_EVENT_* */
    uint32_t body; /* or TAHR_NO_BODY */
    uint32_t feature;
    uint32_t surface;
    double time;        /* s */
    double value;       /* see the type */
    tahr_vec3 position; /* of the character; PUSHED: where it pushes */
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
    X(TAHR_RULE_SLOPE, 17, "slope")                  \
    X(TAHR_RULE_BASE, 18, "base")                    \
    X(TAHR_RULE_SHAPE, 19, "shape")                  \
    X(TAHR_RULE_FLUID, 20, "fluid")                  \
    X(TAHR_RULE_WALL_JUMP, 21, "wall_jump")          \
    X(TAHR_RULE_LEDGE_GRAB, 22, "ledge_grab")        \
    X(TAHR_RULE_CORNER, 23, "corner")                \
    X(TAHR_RULE_PULL_BACK, 24, "pull_back")

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

enum { TAHR_QUERY_SWEEP = 1, TAHR_QUERY_CONTACTS = 2, TAHR_QUERY_RAY = 3, TAHR_QUERY_FLUID = 4 };

/* One query as it was asked and answered, for debugging; also those of motions that were taken back. Sweeps for sensors
 * have a margin of 0 and count sensors, all others count what blocks. Frozen. */
typedef struct tahr_query_record {
    uint32_t type;  /* TAHR_QUERY_* */
    uint32_t count; /* of answers; the first one below */
    tahr_shape shape;
    tahr_vec3 position;
    tahr_vec3 motion;
    double margin;   /* m */
    double fraction; /* SWEEP, RAY; 1 if free */
    double distance; /* m, CONTACTS: signed; FLUID: immersion */
    tahr_vec3 normal;
    tahr_vec3 point;
    uint32_t body;
    uint32_t feature;
} tahr_query_record;

/* Facts about a step that are no errors; the step's status is the worst of them. */
enum {
    TAHR_REPORT_UNKNOWN = 1 << 0, /* a query could not be decided */
    TAHR_REPORT_STUCK = 1 << 1,
    TAHR_REPORT_CRUSHED = 1 << 2,
    TAHR_REPORT_QUERY_CAP = 1 << 3,
    TAHR_REPORT_TRUNCATED = 1 << 4,  /* events, decisions or queries were lost: see the counts */
    TAHR_REPORT_UP_REFUSED = 1 << 5, /* the new up direction would have overlapped something; the old one stays */
    TAHR_REPORT_CACHED_FLOOR = 1 << 6,
    TAHR_REPORT_ASLEEP = 1 << 7, /* a step like the last one, which changed nothing: not computed, no queries counted */
    TAHR_REPORT_SHAPE_REFUSED = 1 << 8, /* no room for the shape asked for; tried again in the next step */
    TAHR_REPORT_BASE_LOST = 1 << 9,     /* could not follow its base the whole way */
    TAHR_REPORT_TOUCHED_LOST = 1 << 10, /* inside of more sensors than a state remembers */
    TAHR_REPORT_MODE_REFUSED = 1 << 11  /* the mode asked for has no function, no floor below or no fluid around it */
};

/* The most queries one step may ask, whatever the world answers; then it stops where it is and says so. */
#define TAHR_MAX_QUERIES_PER_STEP 256u

/* And the most sweeps for sensors on top of them: none while no sensor is near, one for every straight piece of the way
 * inside of a sensor, two where one is entered. */
#define TAHR_MAX_SENSOR_QUERIES_PER_STEP 64u

/* What a step did. Set struct_size and the three arrays (NULL allowed); everything else is written by the step. */
typedef struct tahr_report {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_REPORT_* */
    tahr_event *events;
    tahr_decision *decisions;
    uint32_t event_capacity, event_count, events_lost;
    uint32_t decision_capacity, decision_count, decisions_lost;
    tahr_query_record *queries;
    uint32_t query_capacity, query_count, queries_lost;
    uint32_t sweeps;
    uint32_t contact_queries;
    uint32_t rays;
    uint32_t fluid_queries;
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

/* Puts a character somewhere else: floor, base, touched sensors and the memory of walls are forgotten, no event tells of
 * them; velocity, mode and shape stay.
 * [in,out] state; [in] position (finite, |x| <= 1e7 m). Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT; untouched on error.
 * Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_state_teleport(tahr_state *state, const tahr_vec3 *position);

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
 * standing on a cached floor or asleep; on a base that moves 1 more (3 where it tilts); for every body that moves near the
 * character 1 or 2, and 12 more while it pushes; near sensors those of TAHR_MAX_SENSOR_QUERIES_PER_STEP besides. A report
 * with decisions or queries keeps the step awake. Since 0.1. */
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

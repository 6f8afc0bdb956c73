/* SPDX-License-Identifier: MIT
 * report.h: what a step says it did: events, traced decisions, recorded queries, counts. */
#ifndef TAHR_REPORT_H
#define TAHR_REPORT_H

#include <tahr/types.h>

#ifdef __cplusplus
extern "C" {
#endif

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
    /* Of a sensor, a fluid too; both in one step: passed through. At the time and the place at which the shape met or
     * left it; what came, went or is not met any more without a motion of the character's: at the start of the step.
     * What does not fit into state.touched begins when there is room for it. */
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
    TAHR_LEFT_MODE = 3, /* another mode was asked for, or a fluid was entered */
    TAHR_LEFT_DROP = 4  /* through the one-way body that the event names */
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
    X(TAHR_RULE_PULL_BACK, 24, "pull_back")          \
    X(TAHR_RULE_DROP, 25, "drop")

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
    TAHR_REPORT_MODE_REFUSED = 1 << 11, /* the mode asked for has no function, no floor below or no fluid around it */
    TAHR_REPORT_DEFERRED = 1 << 12,     /* in a crowd: shown on its way, not computed in this tick */
    TAHR_REPORT_TIME_LOST = 1 << 13     /* a part of the step was not simulated: time_lost is not 0 */
};

/* The shortcuts whose savings a report counts: X(constant, value, name). All are on unless they are switched off, and
 * none changes a bit of a state, but DEFERRED, which a budget of error buys. What each of them counts in a step:
 * SLEEP         1: not computed at all, like the last one, which changed nothing (off: config.sleep)
 * DEFERRED      1: not computed but shown, on the way of one that was, in a crowd (tahr_member.budget)
 * CALM          1: taken as in a world without bodies that move, carry or are only felt, for none is near: it asks for
 *               no fluid, looks at no body that moves, and sweeps for no sensor (config.short_ways)
 * CACHED_FLOOR  looks for the floor that were not taken, each of them one sweep or more (config.cached_floor)
 * BARRED_STEP   sweeps at step height that were not asked, at least (config.barred_steps)
 * CLEAR_AIR     sweeps of rises and falls that were answered by how far all is (config.short_ways)
 * KNOWN_FLOOR   sweeps of walks and feet that were answered by the plane of the floor and what is known around it,
 *               without a look at anything else (native: no_vicinity; of whole walks config.short_ways)
 * CACHE         queries that were answered from what was gathered, without a search of the scene (native and fcl:
 *               no_cache)
 * CAPSULE_END   distances of a capsule that were measured from one of its ends alone (native: no_capsule_ends) */
#define TAHR_SHORTCUT_TABLE(X)                       \
    X(TAHR_SHORTCUT_SLEEP, 0, "sleep")               \
    X(TAHR_SHORTCUT_DEFERRED, 1, "deferred")         \
    X(TAHR_SHORTCUT_CALM, 2, "calm")                 \
    X(TAHR_SHORTCUT_CACHED_FLOOR, 3, "cached_floor") \
    X(TAHR_SHORTCUT_BARRED_STEP, 4, "barred_step")   \
    X(TAHR_SHORTCUT_CLEAR_AIR, 5, "clear_air")       \
    X(TAHR_SHORTCUT_KNOWN_FLOOR, 6, "known_floor")   \
    X(TAHR_SHORTCUT_CACHE, 7, "cache")               \
    X(TAHR_SHORTCUT_CAPSULE_END, 8, "capsule_end")

enum {
#define TAHR_SHORTCUT_ENUM(constant, value, name) constant = (value),
    TAHR_SHORTCUT_TABLE(TAHR_SHORTCUT_ENUM)
#undef TAHR_SHORTCUT_ENUM
        TAHR_SHORTCUT_COUNT = 9
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
    /* Queries of the movement, whoever answers them: those of CLEAR_AIR, KNOWN_FLOOR and CACHE are among them, those
     * that were not asked are not. */
    uint32_t sweeps;
    uint32_t contact_queries;
    uint32_t rays;
    uint32_t fluid_queries;
    uint32_t slides;         /* times a motion was bent */
    uint32_t slices;         /* pieces of time */
    uint32_t arcs;           /* times one was bent on within a slice: config.path_tolerance */
    uint64_t triangle_tests; /* shape against feature, in the narrow phase */
    uint64_t narrow_iterations;
    uint64_t gathers;
    uint64_t escapes;
    uint32_t saved[TAHR_SHORTCUT_COUNT]; /* by each of TAHR_SHORTCUT_* */
    uint32_t reserved;                   /* 0 */
    double step_offset; /* m along up: sudden rise or drop by steps and snaps, for smoothing what is shown */
    double residual;    /* m, deepest overlap that is left */
    double time_lost; /* s, not simulated because a cap was reached or nothing could be moved; then TIME_LOST is set */
} tahr_report;

/* "landed", "step_up"; "?" for a number that is none. Static memory. May run on several threads. Since 0.1. */
TAHR_API const char *tahr_event_name(uint32_t type);
TAHR_API const char *tahr_rule_name(uint32_t rule);
TAHR_API const char *tahr_shortcut_name(uint32_t shortcut);

#ifdef __cplusplus
}
#endif
#endif

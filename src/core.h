/* SPDX-License-Identifier: MIT
 * core.h: the core's own objects: the world behind its handle, a mover, and the step in progress that every rule
 * gets. */
#ifndef TAHR_CORE_H
#define TAHR_CORE_H

#include <tahr/backend.h>
#include <tahr/crowd.h>
#include <tahr/tahr.h>

#include "backoff.h"
#include "cone.h"
#include "velocity.h"

/* Counts the bytes that pass through the user's allocator; an allocator itself. */
typedef struct tahr__memory {
    tahr_allocator user;
    uint64_t bytes;
} tahr__memory;

/* What the core remembers of a body. */
typedef struct tahr__body_note {
    uint64_t pose_hash;   /* its share of the revision */
    uint64_t motion_hash; /* and of world->motion; 0: at rest */
    double reach;         /* m, radius around its position that holds all of it */
    double fluid_friction;
    tahr_vec3 surface_velocity; /* local */
    tahr_pose pose, before;     /* before: where the motion of the last placement began */
    double dt;                  /* s of that motion; 0: at rest */
    double mass;
    double round;    /* m, radius of a sphere, a capsule or a cylinder; 0 of other bodies */
    double straight; /* m, half of its axis; 0 of a sphere */
    tahr_vec3 half;  /* of a TAHR_BODY_TEMPLATE: half its extents, local; 0: not known */
    uint32_t flags;  /* TAHR_BODY_* */
    uint32_t jumped; /* world->moves at the time it was put where it is without a motion; 0: never */
} tahr__body_note;

/* What a world may hold, so that a step does not look for what is not there. */
enum {
    TAHR__HAS_SENSORS = 1 << 0,
    TAHR__HAS_FLUIDS = 1 << 1,
    TAHR__HAS_BASES = 1 << 2,          /* bodies that move, drive a conveyor, or can be pushed */
    TAHR__HAS_MOVING_SENSORS = 1 << 3, /* or some that may: nothing is known of a user's own */
    TAHR__HAS_SQUEEZERS = 1 << 4       /* described bodies that block and may be placed again */
};

struct tahr_world {
    const tahr_backend *backend;
    void *self;                        /* the backend's */
    struct tahr__recording *recording; /* who watches it (record.h), or NULL */
    tahr_host host;                    /* its log names the function that a backend complains in */
    tahr_log log;
    const char *calling; /* that function, while it has the world for itself; else NULL */
    uint32_t complaints; /* of the backend in it */
    uint32_t body_count;
    uint32_t has;         /* TAHR__HAS_* */
    uint32_t moved_count; /* bodies in motion: the first of moved, by id */
    uint32_t moves;       /* calls of tahr_world_move, from 1 */
    uint32_t *moved;
    tahr__memory memory;
    uint64_t revision;      /* never 0; a pure function of the poses of all bodies and of the touches */
    uint64_t motion;        /* the same of their motions; 0: all at rest */
    uint64_t last_revision; /* before the last tahr_world_move; 0: since then, or in it, something changed without a
                             * motion */
    uint64_t ground;        /* from 1: changes with what cannot be placed, by tahr_world_touch */
    double drift;           /* m: no body has come farther since another value of it than the difference */
    tahr__body_note *bodies;
    uint32_t *specials; /* bodies that are more than a floor and a wall (calm.h) */
    uint32_t special_count;
    uint32_t specials_known; /* 1: there are no others, and all of them are described */
    uint32_t record_round;   /* number of the last recording */
    uint32_t crowds;         /* open on it: then numbers from TAHR_CHARACTER_BODY on are characters */
    uint32_t derived;        /* the most sweeps that a contacts query is made of (derived.c); 0: it is none */
};

/* Gravity and what follows from it. */
typedef struct tahr__pull {
    vec3 gravity; /* m/s2 */
    double size;  /* its length */
    vec3 up;      /* unit, opposite; zero without gravity */
} tahr__pull;

/* What is swept downward to find the floor, and how far the centre of it lies from the character's along up. */
typedef struct tahr__foot {
    tahr_shape shape;
    double offset; /* m */
} tahr__foot;

/* Which of the settings under "Feel" are on, so that a step does not work for those that are off. */
enum {
    TAHR__FEEL_JUMPS = 1 << 0,   /* presses and jumps are counted: coyote, buffer, air jumps, walls, edges, release */
    TAHR__FEEL_GRAVITY = 1 << 1, /* gravity depends on the button or the direction */
    TAHR__FEEL_WALLS = 1 << 2,   /* walls touched in the air are remembered */
    TAHR__FEEL_EDGES = 1 << 3,
    TAHR__FEEL_CORNERS = 1 << 4
};

/* Numbers derived from config and shape: of the config's own shape once, when the mover is created. */
typedef struct tahr__limits {
    tahr_shape shape;           /* the character's now */
    tahr__foot foot;            /* of the whole shape */
    tahr__decay decay;          /* of walking, of the last length of step; or zero */
    double walkable;            /* cosine of the steepest walkable floor */
    double walkable_hysteresis; /* the same for a floor that was walkable */
    double width;               /* m, half width of the shape: what perch and edge rules measure against */
    double around;              /* m, radius of the circle around the shape seen along its axis */
    double speed;               /* m/s that a whole stick asks for on ground */
    double beside, below;       /* m beyond its motion that a step asks about */
    double axis;                /* m, half of the segment that rounding makes a capsule, or half the height of a box */
    tahr__pull pull;            /* of config.gravity, in the plane */
    vec3 plane;                 /* config.plane, exactly unit; zero: none */
    uint32_t in_plane;          /* 1: there is one */
    uint32_t feel;              /* TAHR__FEEL_* */
    uint32_t usual;             /* 1: EXACT, JOINT slides and depenetration, MARGIN */
} tahr__limits;

/* What a short step was asked for: an input's begin, in its order and without a hole, and how long it was. Has been
 * checked. */
typedef struct tahr__asked {
    uint32_t struct_size, flags, jump, crouch;
    vec3 move;
    double dt; /* s */
} tahr__asked;

/* A part of a state as a short walk left it, in its order and without a hole: bits that are known to be in order. The
 * orientation is unit and has no -0.0, up is that of the mover, and the face is one that a short walk may begin on and
 * end on, with normals that are unit to double precision. */
enum { TAHR__NOTHING_HELD = 0xFF }; /* a mode that is none */
typedef struct tahr__held {
    tahr_quat orientation;
    vec3 up; /* pull.up without -0.0, +z without gravity: only who stands so goes the short way */
    uint32_t mode;
    uint32_t flags;
    vec3 normal;
    vec3 surface_normal;
} tahr__held;

/* A state from radius on, as of who remembers nothing: the begin, which differs from one shape to the next. */
typedef struct tahr__bare {
    double radius, half_height;
    uint32_t body, seen;
    double x;
} tahr__bare;

/* What most steps ask of config and limits, side by side in memory, and what a walk the short way (stroll.h) remembers:
 * a step is mostly like the last one. */
typedef struct tahr__pace {
    tahr__asked asked; /* of the last short walk */
    tahr__held held;
    tahr__bare bare;
    vec3 reach;       /* m, the sweep of the foot: downward */
    double range;     /* m, the length of it */
    double skin;      /* m */
    double foot;      /* m, its offset */
    double most;      /* m, clearance of the band in which a floor is left as it is */
    double rim;       /* m, radius and skin */
    double tolerance; /* m, from the rim */
    double level;     /* cosine of the steepest face that may be stood on without a look at what was */
    uint32_t mask;
    uint16_t upright; /* 1: up is exactly +z */
    uint16_t wishes;  /* law_wishes of */
    tahr__law law;    /* how that move is approached */
    double max_dt;    /* s */
    uint32_t special; /* 1: held in a plane, or not round */
} tahr__pace;

/* Events of a step that can be repeated; a step with more is computed again. */
enum { TAHR__SLEEP_EVENTS = 8 };

/* The last step, if it left the state as it was (sleep.h). In the order in which a sleeper compares it, from the begin
 * of a line of memory: a crowd asleep costs the lines that it reads. */
typedef struct tahr__sleep {
    _Alignas(64) uint32_t noted; /* 1 + the report's event_capacity; 0: nothing is */
    int16_t status;
    uint8_t wide;  /* tahr__is_wide */
    uint8_t blank; /* 1: what the state remembers is that of tahr__blank, which is nearer than this one's own copy */
    double dt;
    uint64_t revision;
    tahr_input input;
    _Alignas(64) tahr_state state;
    tahr_report report;
    tahr_event events[TAHR__SLEEP_EVENTS];
} tahr__sleep;

/* The function of TAHR_MODE_CUSTOM, or none. */
typedef struct tahr__custom {
    tahr_custom_mode_fn run;
    void *user;
} tahr__custom;

/* Where the config's shape may go without meeting anything that is at rest for good, while the ground stays what it
 * was: as told by the slot walk. What else there is, is not near: else it is not asked (calm.h). */
typedef struct tahr__clear {
    vec3 at;
    double far2;     /* m2: square of how far from there */
    uint64_t ground; /* of the world; 0: nothing is known */
} tahr__clear;

/* Gravity while it rises or while it falls, and the chords that it makes. */
typedef struct tahr__weight {
    double gravity; /* m/s2 */
    double chord;   /* s at most of a chord: off the arc by no more than config.arc_tolerance, |a| t^2 / 8 */
} tahr__weight;

/* What a rise or fall the short way (plummet.h) asks of config and limits, and what it remembers. */
typedef struct tahr__dive {
    tahr__asked asked;     /* of the last one, */
    tahr__law law;         /* and how its move is approached, */
    uint32_t odd_flags;    /* and the flags of a state that is none for it, */
    uint32_t held_flags;   /* but for these, which it has to have */
    uint32_t wishes;       /* law_wishes of law */
    uint32_t presses;      /* 1: a press of the button may do something in the air */
    tahr__weight rising;   /* of who rises, */
    tahr__weight released; /* with the button of the jump up, */
    tahr__weight falling;  /* and of who falls */
    double hover;          /* m/s: less of a rise is the rounding of an apex: it falls */
    double longest;        /* s: longer steps go the long way */
    double terminal;       /* m/s */
    tahr__clear clear;
} tahr__dive;

/* How far it is to the nearest special body (calm.h). In single precision, rounded to the safe side: a mover shall stay
 * small. */
typedef struct tahr__calm {
    double drift; /* the world's, when room was measured: */
    float at[3];
    float room;  /* m from there to the nearest, less what a step reaches that stands still */
    float speed; /* m/s that a step may add to what it begins with, */
    float pull;  /* m/s2, and gravity at most */
    tahr__backoff looks;
    uint32_t seen;            /* of the state before the step under way, */
    uint8_t on;               /* which is calm; */
    uint8_t changed;          /* bits: its seen had to be changed, its floor_revision was the world's last one */
    uint8_t may_go_short_way; /* what the mover may do in such a step */
    uint8_t may;              /* 1: its steps may be calm */
} tahr__calm;

/* What a state remembers, from base on, that has nothing to remember; and how it is made, for who needs to know it when
 * it is compiled. */
extern const tahr_state tahr__blank;
#define TAHR__EIGHT(x)         \
    {                          \
        x, x, x, x, x, x, x, x \
    }
#define TAHR__BLANK                                                                                                  \
    {                                                                                                                \
        .base = {.body = TAHR_NO_BODY, .pose = {.orientation = {0, 0, 0, 1}}}, .touched = TAHR__EIGHT(TAHR_NO_BODY), \
        .wall_body = TAHR_NO_BODY, .drop_body = TAHR_NO_BODY                                                         \
    }

/* In the order in which a step reads it: what a short walk (short_way.h) costs of memory ends with the limits' foot,
 * what a short fall costs is the begin, up to what is held, and the dive. */
struct tahr_mover {
    _Alignas(64) tahr_world *world;
    struct tahr__company *company; /* in a step of a crowd: who else is there (neighbours.h), else NULL */
    void *cache;
    uint8_t busy;
    uint8_t is_recorded; /* 1: the step under way has been told of */
    uint8_t dozes;       /* 0: sleep.noted is 0; 2: tahr__step_wide looks first */
    uint8_t plain;       /* 1: neither world nor config hold anything that a state remembers */
    uint8_t may_go_short_way;
    uint8_t long_way;  /* 1: the last step could have been no short one (short_way.h) */
    uint8_t wide;      /* tahr__is_wide */
    uint8_t not_quick; /* 1: it takes no step as short_step.h does: it may not go the short way, or up is not +z */
    tahr__backoff short_way;
    tahr__pace pace;
    tahr__limits limits;
    tahr__dive dive;
    tahr__calm calm;
    tahr__backoff onward;   /* of the looks of onward.h */
    uint32_t record_round;  /* of the recording that has numbered it, */
    uint32_t record_number; /* and the number */
    uint64_t gathers;       /* of a short way that came to nothing: the long one tells of them */
    tahr_config config;
    size_t cache_size;
    tahr__custom custom;
    tahr__sleep sleep;
};

/* A step begins that may change something: what the last one was is forgotten. Most movers have nothing to forget, and
 * leave that memory alone. */
static inline void mover_wake(tahr_mover *mover)
{
    if (mover->dozes) {
        mover->dozes = 0;
        mover->sleep.noted = 0;
    }
}

/* Public as the opaque tahr_step of a custom mode. */
typedef tahr_step tahr__step;

/* One step in progress: working copies of what it writes, so that an error leaves the caller's untouched. */
struct tahr__step {
    const tahr_config *config;
    const tahr__limits *limits;
    tahr_world *world;
    const tahr_input *input;
    const tahr__pull *pull;
    const tahr__custom *custom;
    tahr_state state;
    tahr_report report;
    struct tahr__trail *trail;                 /* NULL in a world without sensors (trail.h) */
    const struct tahr__neighbours *around;     /* other characters of a crowd that are near, or NULL, */
    const struct tahr__neighbours *neighbours; /* and whether they are there already: this step has been carried */
    tahr_query_context context;
    tahr__limits own_limits;  /* what limits points to while the shape is not the config's */
    tahr_input own_input;     /* what input points to while it is held in a plane, */
    const tahr_input *given;  /* instead of the caller's, */
    vec3 began;               /* and where the character was before */
    vec3 announced;           /* where the character was when the step was */
    uint32_t ignore_body;     /* not there for this step's queries now, or TAHR_NO_BODY */
    uint32_t passes;          /* 1: no one-way body is there for this step's sweeps now */
    uint32_t just_teleported; /* put somewhere without a motion of its own: its displacement is no velocity */
    uint32_t frame_body;      /* what state.velocity is relative to in this step, or TAHR_NO_BODY (base_motion.c) */
    uint32_t frame_is_base;   /* 1: it stood on it; 0: it meets it in the air */
    vec3 frame_velocity;      /* m/s, of that body at the foot, or at the height at which it was met */
    double decay_mean;        /* m/s, of an imparted velocity in what is left of this step; 0: none decays */
    double decay_left;        /* m/s, of it at the end of the step */
    double dt;                /* s of the whole step */
    double push_left;         /* m of depenetration still allowed */
    double time;              /* s since the start of the step, at the begin of the slice */
    double ahead;             /* s from there to what is being worked on: events happen then */
    uint32_t queries;         /* asked so far, of TAHR_MAX_QUERIES_PER_STEP */
    tahr_status error;        /* sticky: after it every query answers "blocked here" */
    uint32_t iterations;      /* slices begun so far, of max_substeps: STEPPED, TWO_WALLS */
    uint32_t apexes;          /* of them cut short at an apex */
    uint32_t calm;            /* 1: nothing special is near (calm.h) */
    /* The mover's, if the last piece along a wall may be asked for with the floor under its end (onward.h), or NULL. */
    tahr__backoff *onward;
    /* For what a perch meets (perch.h), or NULL. */
    struct tahr__inner *inner;
};

/* Walking and falling may hand a step to each other this often (an edge that holds for a hair's breadth); then it ends.
 * Each time costs 10 to 50 queries to find where the floor ended. */
enum { TAHR__MAX_SLICES = 6 };

/* s: slices shorter than this are rounding of the times of contacts. */
#define TAHR__SHORTEST 1e-9

/* Where a slice of time goes on: a mode never calls another one, it returns this. */
typedef struct tahr__next {
    uint32_t mode;
    double time_left; /* s */
} tahr__next;

/* May bodies squeeze a character? Asked of the scene, not of what was moved so far: a rollback must find the same
 * answer. */
static inline int step_squeezes(const tahr__step *step)
{
    return (step->world->has & TAHR__HAS_SQUEEZERS) != 0;
}

static inline vec3 step_foot(const tahr__step *step)
{
    return add_scaled(step->state.position, step->state.up, -step->limits->shape.half_height);
}

/* The part across up. */
static inline vec3 step_level(const tahr__step *step, vec3 v)
{
    return reject(v, step->state.up);
}

/* Of two dimensions, x and y? */
static inline int world_is_planar(const tahr_world *world)
{
    return (world->backend->capabilities & TAHR_CAP_PLANAR) != 0;
}

/* m from a place to a body, on all of the way of its last motion; less than 0 within the ball around it. */
static inline double note_gap(const tahr_world *world, const tahr__body_note *note, vec3 p)
{
    vec3 way = sub(note->pose.position, note->before.position), off = sub(p, note->before.position);
    if (world_is_planar(world)) { /* there is no far and near along z */
        way.z = off.z = 0;
    }
    const double length2 = length_squared(way), t = length2 > 0 ? clamp(dot(off, way) / length2, 0, 1) : 0;
    return length(add_scaled(off, way, -t)) - note->reach;
}

/* What is said of a vector that leaves such a world. */
#define TAHR__NO_Z "must have no z: the world has two dimensions, x and y"

static inline vec3 clean(vec3 v)
{
    return vec(v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

/* What any step may write, up to the radius. -0.0 and 0.0 are one number; the caller's state holds only one of them, so
 * that memcmp agrees with ==. The tail is zero on both sides of a step, and stays where it is. */
static inline void tahr__clean_state(const tahr_state *s, tahr_state *out)
{
    const tahr_quat q = s->orientation;
    out->position = clean(s->position);
    out->velocity = clean(s->velocity);
    out->orientation = (tahr_quat){q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};
    out->up = clean(s->up);
    out->mode = s->mode;
    out->flags = s->flags;
    out->floor.normal = clean(s->floor.normal);
    out->floor.surface_normal = clean(s->floor.surface_normal);
    out->floor.point = clean(s->floor.point);
    out->floor.distance = s->floor.distance + 0.0;
    out->floor.perch_distance = s->floor.perch_distance + 0.0;
    out->floor.flags = s->floor.flags;
    out->floor.body = s->floor.body;
    out->floor.feature = s->floor.feature;
    out->floor.surface = s->floor.surface;
    out->floor_position = clean(s->floor_position);
    out->floor_revision = s->floor_revision;
    out->jump_hold = s->jump_hold + 0.0;
}

/* What another character of a crowd is to who meets it. */
enum { TAHR__CHARACTER_FLAGS = TAHR_BODY_CHARACTER | TAHR_BODY_MOVABLE | TAHR_BODY_NO_BASE | TAHR_BODY_NO_STEP };

/* Does this number name one? */
static inline int world_is_character(const tahr_world *world, uint32_t body)
{
    return world->crowds > 0 && body >= TAHR_CHARACTER_BODY && body != TAHR_NO_BODY;
}

/* TAHR_BODY_* of a body that the core described or of a character, else 0. */
static inline uint32_t world_body_flags(const tahr_world *world, uint32_t body)
{
    if (body < world->body_count && world->bodies) {
        return world->bodies[body].flags;
    }
    return world_is_character(world, body) ? (uint32_t)TAHR__CHARACTER_FLAGS : 0;
}

#endif

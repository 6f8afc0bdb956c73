/* SPDX-License-Identifier: MIT
 * mover.h: the input of a character, and the step itself. */
#ifndef TAHR_MOVER_H
#define TAHR_MOVER_H

#include <tahr/world.h>
#include <tahr/state.h>
#include <tahr/report.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_mover tahr_mover;

/* MODE: change to input.mode at the start of this step: WALKING needs a floor within config.snap_distance, SWIMMING a
 * fluid deep enough, CUSTOM a function; else TAHR_REPORT_MODE_REFUSED.
 * DROP: fall through the one-way bodies that it stands on, one layer per press: it must be off for a step before it
 * counts again. A press on another floor, where that holds too, or in the air is spent; a jump pressed with it does not
 * start. A layer is one surface, of however many bodies: what it stands on, and whatever one-way it meets next that
 * does not lie under that (where both are: behind its plane, with that before the plane of the other, by more than a
 * floor may be away, 2 skins), and so on from face to face, until all of its foot is under it. So slope and flat, the
 * sides of a valley or of a crest and a row of tiles are one layer; platforms over each other, and the treads of a
 * stair, are one each. Down a slope it leaves along it; from a lift as from one at rest: it is a fall from the first
 * moment, with config.fall_gravity, even while the lift's speed carries it up. */
enum {
    TAHR_INPUT_GRAVITY = 1 << 0, /* input.gravity counts */
    TAHR_INPUT_FACING = 1 << 1,  /* input.facing counts */
    TAHR_INPUT_MODE = 1 << 2,
    TAHR_INPUT_SHAPE = 1 << 3,  /* have radius and half_height in this step; growing waits until there is room */
    TAHR_INPUT_LAUNCH = 1 << 4, /* add launch to the velocity, and leave the ground or an edge; ends a held jump */
    TAHR_INPUT_LAUNCH_LEVEL = 1 << 5, /* with LAUNCH: the part across up replaces that of the velocity */
    TAHR_INPUT_LAUNCH_UP = 1 << 6,    /* with LAUNCH: the part along up replaces it */
    TAHR_INPUT_IMPULSE = 1 << 7,      /* add impulse / config.mass; leaves the ground if that points upward */
    TAHR_INPUT_DRIVE = 1 << 8,     /* drive is the velocity of this step (root motion); walking, its part across up */
    TAHR_INPUT_DRIVE_ADD = 1 << 9, /* with DRIVE: it comes on top of state.velocity, and is not kept in it */
    TAHR_INPUT_DRIVE_LEVEL = 1 << 10, /* with DRIVE: only across up; falling goes on */
    TAHR_INPUT_DROP = 1 << 11
};

/* What the player or an AI wants during one step. All vectors world frame. move: its length is the part, 0 to 1, of the
 * mode's speed, longer is shortened to 1; the part along up counts only in swimming and flying. crouch: half height
 * config.crouched_half_height, about the foot on ground, else about the centre; not of spheres and hulls, not while
 * hanging. */
typedef struct tahr_input {
    uint32_t struct_size;
    uint32_t flags;     /* TAHR_INPUT_*: which of the optional fields below count */
    uint32_t jump;      /* 1 while the button is held; a jump starts when it goes down */
    uint32_t crouch;    /* 1 while crouched */
    tahr_vec3 move;     /* where to, and how fast */
    tahr_vec3 facing;   /* with FACING: turn toward this direction */
    tahr_vec3 gravity;  /* m/s2, with GRAVITY: instead of config.gravity */
    double radius;      /* m, with SHAPE; 0 of boxes, ellipsoids and hulls */
    double half_height; /* m, with SHAPE */
    tahr_vec3 launch;   /* m/s, with LAUNCH */
    tahr_vec3 impulse;  /* N s, with IMPULSE */
    tahr_vec3 drive;    /* m/s, with DRIVE */
    uint32_t mode;      /* with MODE */
    uint32_t reserved;
} tahr_input;

/* Scratch memory and gather cache of one character at a time; holds nothing that matters to gameplay, so one mover may
 * step many characters and any state may be stepped by any mover of the same world and config, with the same bits.
 * [in] world, which must outlive the mover; config, copied. [out] mover, untouched on error; destroy it with
 * tahr_mover_destroy. Allocates from the world's allocator. May run on several threads, also while movers of the world
 * step, if that allocator and the log may be called so; not while the world is opened, changed or closed.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (shape not among the backend's, a hull on
 * one without the margin, unknown tail of config not zero, a plane or a gravity that leaves the plane of a
 * TAHR_CAP_PLANAR world), TAHR_E_ARGUMENT (the log names the field; a hull must be a TAHR_BODY_TEMPLATE of a described
 * world, and as large), TAHR_E_MEMORY. Since 0.1. */
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
 * state not finite or out of range, or, in a TAHR_CAP_PLANAR world, up, a normal or base.velocity of the state with a
 * z; the log names the field), TAHR_E_BACKEND, TAHR_E_REENTRANT.
 * Allocates nothing. Pure: the result depends on world, config, input, dt and state only. Different movers may step on
 * different threads at once. Queries: at most TAHR_MAX_QUERIES_PER_STEP; on flat ground 2 sweeps moving, 1 standing, 0
 * standing on a cached floor or asleep; on a base that moves 1 more (3 where it tilts); for every body that moves near
 * the character 1 or 2, and 12 more while it pushes; near sensors those of TAHR_MAX_SENSOR_QUERIES_PER_STEP besides. A
 * report with decisions or queries keeps the step awake. Since 0.1. */
TAHR_API tahr_status tahr_mover_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                     tahr_report *report);

#ifdef __cplusplus
}
#endif
#endif

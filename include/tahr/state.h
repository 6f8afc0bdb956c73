/* SPDX-License-Identifier: MIT
 * state.h: everything that decides a character's future: the state, made, moved elsewhere, hashed. */
#ifndef TAHR_STATE_H
#define TAHR_STATE_H

#include <tahr/config.h>

#ifdef __cplusplus
extern "C" {
#endif

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

/* What is below the shape. distance is the way down until the shape would be skin above it, plus skin; with SHRUNK
 * until it touches, negative where it overlaps. */
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
    TAHR_STATE_EDGE_SPENT = 1 << 7, /* an edge as high as floor.point was let go: none there before falling below it */
    TAHR_STATE_CRUSHED = 1 << 8,    /* overlaps something that it could not be pushed out of */
    TAHR_STATE_DROPPING = 1 << 9,   /* falling, and nothing one-way as near as a floor is there for it */
    TAHR_STATE_DROP_HELD = 1 << 10  /* TAHR_INPUT_DROP was on in the last step */
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
    uint32_t
        drop_body; /* while DROPPING the one-way body that it stood on, or met last of that layer (floor tells where),
                         * and falls away from; else TAHR_NO_BODY */
    uint32_t drop_feature; /* of that body, for users: no step depends on it */
    uint8_t reserved[40];
} tahr_state;

/* A character at rest at a place, in free air or on the ground: mode FALLING until a step finds the floor; up opposite
 * to config.gravity.
 * [out] state; [in] config (valid), position (finite, |x| <= 1e7 m).
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED, TAHR_E_ARGUMENT (config or position); untouched
 * on error. Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_state_init(tahr_state *state, const tahr_config *config, const tahr_vec3 *position);

/* Puts a character somewhere else: floor, base, touched sensors and the memory of walls are forgotten, no event tells
 * of them; velocity, mode and shape stay.
 * [in,out] state; [in] position (finite, |x| <= 1e7 m). Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT; untouched on
 * error. Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_state_teleport(tahr_state *state, const tahr_vec3 *position);

/* 64-bit FNV-1a hash of the 512 bytes with -0.0 read as 0.0; equal states have equal hashes on every machine (bytes of
 * each word from the lowest). 0 for NULL. Since 0.1. */
TAHR_API uint64_t tahr_state_hash(const tahr_state *state);

/* "walking"; "?" for a number that is none. Static memory. May run on several threads. Since 0.1. */
TAHR_API const char *tahr_mode_name(uint32_t mode);

#ifdef __cplusplus
}
#endif
#endif

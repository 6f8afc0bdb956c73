/* SPDX-License-Identifier: MIT
 * config.h: the settings of a character and their presets. SI units and radians. */
#ifndef TAHR_CONFIG_H
#define TAHR_CONFIG_H

#include <tahr/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* PRECISE: closed forms, a constant skin, all planes at once: rate-independent, the default. UNREAL: the behaviour, the
 * constants and the order of queries of Unreal's CharacterMovementComponent, in SI units, for projects that need to
 * move alike. PLATFORMER: PRECISE for a side-scroller in the plane of x and y, up = +y: a jump two tiles of 1 m high,
 * and the forgiveness that its players expect. All are settings of the one code: every line below with more than one
 * default. */
enum { TAHR_PRESET_PRECISE = 1, TAHR_PRESET_UNREAL = 2, TAHR_PRESET_PLATFORMER = 3 };

/* How velocity becomes a displacement. EXACT: the closed form of the whole piece; the same at every frame rate.
 * STEPPED: sub-steps of at most max_substep, the velocity first and then velocity * time; costs accuracy (stopping
 * distances vary threefold between 20 and 120 Hz), buys parity. */
enum { TAHR_INTEGRATOR_EXACT = 1, TAHR_INTEGRATOR_STEPPED = 2 };

/* How a motion is bent. JOINT: projected on all touched planes at once, walls met at their exact time; no drift in
 * gutters and no ping-pong in corners. TWO_WALLS: one slide and one adjustment for a second wall, what is left is
 * dropped; at most 2 sweeps, parity. */
enum { TAHR_SLIDE_JOINT = 1, TAHR_SLIDE_TWO_WALLS = 2 };

/* What keeps the shape off surfaces. MARGIN: sweeps stop a skin away, measured along the normal, whatever the motion.
 * PULL_BACK: sweeps stop at contact and are taken back by a part of the motion; the gap depends on the frame's
 * length. */
enum { TAHR_SEPARATION_MARGIN = 1, TAHR_SEPARATION_PULL_BACK = 2 };

/* What looks for the floor. WHOLE: the shape with its skin. SHRUNK: a shorter shape without a skin, a thinner one where
 * that touched the rim, then a ray: finds the depth of what is overlapped, and needs up to 3 queries (6 with a perch).
 * The clearance band is then one along up, not along the normal: made for PULL_BACK. */
enum { TAHR_FLOOR_PROBE_WHOLE = 1, TAHR_FLOOR_PROBE_SHRUNK = 2 };

/* How overlaps are left. JOINT: the least motion that frees of all surfaces together. SINGLE: the depth of one surface
 * at a time, tested and retried; may swap between two walls for a while. */
enum { TAHR_DEPENETRATION_JOINT = 1, TAHR_DEPENETRATION_SINGLE = 2 };

/* What a step up is judged by. TREAD: the face behind the edge, the same at every frame rate. CONTACT: where the shape
 * came down after this frame's motion. */
enum { TAHR_STEP_BY_TREAD = 1, TAHR_STEP_BY_CONTACT = 2 };

/* Which velocity of a base goes with a character that leaves it: across up; along up, also downward, so that a jump is
 * as high above a lift that sinks as above the ground; and of the base's turning. */
enum { TAHR_IMPART_LEVEL = 1 << 0, TAHR_IMPART_UP = 1 << 1, TAHR_IMPART_TURN = 1 << 2 };

/* Defaults in brackets are those of TAHR_PRESET_PRECISE, after a bar those of TAHR_PRESET_UNREAL, and after a double
 * bar those of TAHR_PRESET_PLATFORMER, where they differ.
 * Ranges, inclusive, h = shape.half_height (tahr_config_check names what is outside): skin 1e-5 h..0.5 h; pull_back
 * 1e-6 h..0.1 h; path_tolerance 0..h; max_depenetration, max_depenetration_character and perch_threshold 0..1e4 m;
 * plane unit or zero; mass 1e-3..1e6 kg; push_force 0..1e9 N; walkable_angle 0..90 degrees and no more with its
 * hysteresis; 1 <= floor_target <= floor_max <= 10; step_height 0..2 h; snap_distance and perch_extra 0..1e3 m;
 * edge_tolerance 0..0.5 h; speeds 0..1e4
 * m/s, terminal_speed from 1e-3; accelerations 0..1e6 m/s2; gravity -1e4..1e4 m/s2 per axis; frictions, drags and
 * turn_rate 0..1e4 1/s; times 0..1e3 s; air_control and air_boost 0..100; buoyancy 0..10; swim_immersion 0.01..1;
 * jump_release_gravity and fall_gravity 0.1..100; crouched_half_height and the lengths of shape 1e-6..1e4 m;
 * ledge_grab and corner_correction 0..2 h; arc_tolerance 1e-6 h..h; max_dt 1e-6..10 s; max_substep and braking_substep
 * 1e-3..10 s; max_slides 1..16; max_substeps 1..64; air_jumps 0..1000; switches 0 or 1. */
typedef struct tahr_config {
    uint32_t struct_size;
    uint32_t preset;
    tahr_shape shape; /* [capsule, radius 0.35, half height 0.9 | 0.34, 0.88] */

    /* Methods */
    uint32_t integrator;    /* TAHR_INTEGRATOR_* [EXACT | STEPPED] */
    uint32_t slide_solver;  /* TAHR_SLIDE_* [JOINT | TWO_WALLS] */
    uint32_t separation;    /* TAHR_SEPARATION_* [MARGIN | PULL_BACK] */
    uint32_t floor_probe;   /* TAHR_FLOOR_PROBE_* [WHOLE | SHRUNK] */
    uint32_t depenetration; /* TAHR_DEPENETRATION_* [JOINT | SINGLE] */
    uint32_t step_rule;     /* TAHR_STEP_BY_* [TREAD | CONTACT] */
    /* [0] 1, with SHRUNK: a round shape looks for the floor with a box (0.707 of the radius), if the backend has boxes:
     * does not sink at edges; rests higher over slopes, up to 10 queries; a fall still slides off what only the
     * outermost edge_tolerance of the round shape meets */
    uint32_t flat_base;
    /* [0 | 1] 1: the speed asked for is the level one on ramps, as far as a slice then rises no more than step_height;
     * 0: the one along the surface */
    uint32_t keep_level_speed;

    /* Collision */
    uint32_t mask; /* [all bits] bodies this character meets; 0: none */
    uint32_t
        max_slides; /* [8] sweeps of one slice of walking or falling, besides those of path_tolerance; then the rest
                          * of the motion is dropped */
    double skin;    /* m [0.01 | 0.019] distance kept from everything that blocks (PULL_BACK: from floors) */
    /* m [0.002] EXACT, JOINT: a slide around an edge or a round body is bent on within a slice, and a walk that turns
     * into something is cut up, so that what is swept lies no further off the true way, in at most 16 pieces; 0: off,
     * straight until the next slice. Asks two sweeps more for every turn and one for every piece of such slices, mostly
     * one or two in all, and none in others */
    double path_tolerance;
    /* m [0.001] PULL_BACK: least distance taken back, 0.004 of it the shortest motion; SINGLE: 1.25 of it is added to
     * every push, where a shape larger by it fits */
    double pull_back;
    double max_depenetration; /* m [1.0 | 5.0] JOINT: longest way out of overlaps per step; SINGLE: longest push */
    double max_depenetration_character; /* m [1.0] SINGLE: the same, out of a body with TAHR_BODY_CHARACTER */
    /* [0 || (0, 0, 1)] unit normal of the plane through the character that it stays in (a side-scroller); zero: none.
     * In a world of two dimensions (TAHR_CAP_PLANAR) it must be (0, 0, 1) or (0, 0, -1). Wishes, gravity, launches and
     * pushes count along it. Equal to up (seen from above): nothing falls, jumps, steps up or snaps down */
    tahr_vec3 plane;
    double mass;       /* kg [80 | 100] */
    double push_force; /* N [500] most that is reported as a push against a body with a mass */

    /* Floor */
    double walkable_angle;      /* rad [50 | 44.765 degrees] steepest floor that can be stood on */
    double walkable_hysteresis; /* rad [1 degree | 0] a floor that was walkable stays so this much longer */
    double floor_target;        /* of skin [1.25 | 2.15/1.9] clearance that a correction aims at */
    double floor_max; /* of skin [1.5 | 2.4/1.9] clearance up to which nothing is corrected; the band starts at skin */
    double step_height;     /* m [0.4 | 0.45] highest step, floor to landing face */
    double snap_distance;   /* m [0.4 | 0.45] how far down the floor is followed while walking */
    double perch_threshold; /* m [0.15 | 0] a contact in the outermost ring of this width needs a floor further in */
    double perch_extra;     /* m [0.4] how much deeper than snap_distance that floor may lie */
    double edge_tolerance;  /* m [1e-4 | 0.0015] impacts this close to the rim of the shape are no floor */
    /* [1 | 0] 0: look for the floor even when nothing changed. It is the same one, to the last bit but where a walk
     * that ended in another 4 m cell than its last step began in comes to rest: native rounds in that of the begin. */
    uint32_t cached_floor;
    uint32_t walk_off_ledges;          /* [1] 0: stop at ledges instead of falling */
    uint32_t walk_off_ledges_crouched; /* [1 | 0] */
    /* [1] 0: with TREAD and MARGIN, asks what is ahead at step height also where the side of the wall that was met is
     * seen to be in the way up there too. The same step, as far as the backend's answers agree with each other */
    uint32_t barred_steps;

    /* Walking */
    double max_speed;            /* m/s [6] */
    double acceleration;         /* m/s2 [20.48 || 40] along the wish */
    double turn_friction;        /* 1/s [8] decay of the velocity across the wish */
    double braking_deceleration; /* m/s2 [20.48 || 40] without input, or above the speed asked for */
    double braking_drag;         /* 1/s [16] added to it, proportional to speed */
    double stop_speed;           /* m/s [0 | 0.1] STEPPED: braking below this is standing */

    /* Falling */
    tahr_vec3 gravity;          /* m/s2 [0, 0, -9.81 | -9.8 || 0, -19.62, 0]; up is opposite */
    double jump_speed;          /* m/s [4.2 || 9] */
    double jump_hold_time;      /* s [0] a held jump button suspends gravity this long */
    double terminal_speed;      /* m/s [40 || 25] fastest fall */
    double air_control;         /* of acceleration [0.25 | 0.05 || 1] */
    double air_boost;           /* of air_control [1 | 2] below air_boost_speed */
    double air_boost_speed;     /* m/s [0 | 0.25] */
    double air_turn_friction;   /* 1/s [0] turn_friction in the air */
    double arc_tolerance;       /* m [0.001] EXACT: how far the swept chords may lie off the arc of a fall */
    uint32_t jump_hold_gravity; /* [0 | 1] 1: gravity acts while the button is held, the jump speed is set each step */
    uint32_t apex_substep;      /* [1] STEPPED: a slice of a fall ends at its apex */

    /* Bases that move */
    uint32_t impart;           /* TAHR_IMPART_* [all] what a base hands to who leaves it */
    uint32_t turn_with_base;   /* [1] the orientation follows the base's yaw */
    double imparted_half_life; /* s [0] the velocity that a base imparted halves in this time; 0: it stays */

    /* Crouching */
    double crouched_half_height; /* m [0.55 | 0.4 || 0.45] with input.crouch; the radius, if that is more */
    double crouched_speed;       /* m/s [3] */

    /* Swimming and flying. EXACT, in water: from rest a full wish accelerates by acceleration and tends to swim_speed;
     * without one the drag is left (standing from 1 mm/s on); an upward wish loses its thrust on the way from whole
     * immersion to swim_immersion, so that nobody swims out through the surface. It walks where it meets a floor at
     * less than 0.9 of swim_immersion, and falls at less than 0.8 of it. In the air: the law of walking with fly_drag
     * as its braking. */
    double swim_speed;       /* m/s [3] */
    double swim_immersion;   /* [0.65] part of the height below the surface that makes it swim; at most 1 / buoyancy */
    double buoyancy;         /* of gravity [1], when wholly immersed; 1: neither sinks nor rises */
    double fluid_friction;   /* 1/s [0.3] drag of a fluid that says none of its own */
    double water_exit_speed; /* m/s [5.5 | 4.2] upward, of a jump at the surface: 5.5 leads over a rim at its height */
    double fly_speed;        /* m/s [6] */
    double fly_drag;         /* 1/s [0.15] drag of flying without input */

    /* Feel: all off but in PLATFORMER; times count inside steps, the same at every frame rate. A press of the jump
     * button starts the first that is possible of: a jump from the ground, one within coyote_time, one off a wall, one
     * of air_jumps; else it is remembered for jump_buffer and starts at the next landing or wall. A press starts one
     * jump at most, and no jump is higher than the one from the ground: in the air the speed against gravity is
     * raised to jump_speed, never beyond. A wall leans by 15 degrees at most; one that was jumped off, or any that
     * faces alike within 30 degrees, cannot be again before the ground or the touch of another wall. */
    double coyote_time; /* s [0 || 0.1] a jump still starts this long after the floor ended, unless by jump or launch */
    double jump_buffer; /* s [0 || 0.12] a jump asked for this long before a landing starts at it */
    double jump_release_gravity; /* of gravity [1 || 3] while a jump rises with its button up: variable height */
    double fall_gravity;         /* of gravity [1 || 1.5] while falling; seen from a lift that it drops through */
    double wall_slide_speed;     /* m/s [0: off || 3] fastest fall while pushing against a wall */
    double wall_jump_speed;      /* m/s [0: off || 6] away from the wall, with jump_speed upward */
    double wall_coyote_time; /* s [0 || 0.1] a wall jump still starts this long after the wall was left by 1.5 skin */
    /* m [0: off] falling and pushing into a wall, hangs (TAHR_MODE_HANGING) where its head passes an edge, or on one at
     * most this far above it; a jump climbs, crouching or moving away lets go */
    double ledge_grab;
    /* m [0: off || 0.25] the corner of a ceiling is a wall and no ceiling for a rising head that is under it by at most
     * this much: the head is put beside it, whichever way it goes or wishes, and keeps its rise; what of its velocity
     * points back to the corner ends there, as at a wall. Off where that is not free, beside and above */
    double corner_correction;
    double lift_momentum;   /* s [0 || 0.1] the velocity of a base is still imparted this long after it stopped */
    uint32_t air_jumps;     /* [0] before the next landing, water or edge; walking off a ledge costs none */
    uint32_t reserved_feel; /* 0 */

    /* Time and turning */
    double max_dt;          /* s [1] longest step accepted */
    double max_substep;     /* s [0.05] STEPPED: longest slice */
    double braking_substep; /* s [1/33] STEPPED: longest piece of braking */
    uint32_t max_substeps;  /* [8] STEPPED: slices of a step; the last takes all that is left */
    uint32_t sleep;         /* [1] 0: compute also a step whose like has just changed nothing */
    /* [1] 0: a walk over open ground, the last piece of one along walls, a fall in free air, and what is far from all
     * that moves, carries or is only felt, too, are computed the long way, query by query. The same bits; queries for
     * what could not be there are not counted */
    uint32_t short_ways;
    uint32_t reserved_time; /* 0 */
    double turn_rate;       /* rad/s [12.5 | 6.283] of the orientation toward input.facing */
} tahr_config;

/* Fills a config with a preset and sets its struct_size. [out] config of size bytes (sizeof(tahr_config)). Untouched on
 * error. Allocates nothing; may run on several threads.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_ARGUMENT (no such preset). Since 0.1. */
TAHR_API tahr_status tahr_config_init(tahr_config *config, size_t size, int32_t preset);

/* Multiplies every length, speed and acceleration, so that a character of another size moves alike. factor > 0, finite.
 * Untouched on error. Allocates nothing; may run on several threads (not on one config).
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED, TAHR_E_ARGUMENT (factor, or
 * a field that would leave its range). Since 0.1. */
TAHR_API tahr_status tahr_config_scale(tahr_config *config, double factor);

/* Checks every field. [out] field may be NULL; receives the name of the first bad one in static memory, or NULL.
 * Allocates nothing; may run on several threads.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (unknown tail not zero), TAHR_E_ARGUMENT. Since
 * 0.1. */
TAHR_API tahr_status tahr_config_check(const tahr_config *config, const char **field);

/* "precise", "unreal", "platformer", or "?". Static memory. Since 0.1. */
TAHR_API const char *tahr_preset_name(int32_t preset);

#ifdef __cplusplus
}
#endif
#endif

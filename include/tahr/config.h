/* SPDX-License-Identifier: MIT
 * config.h: the settings of a character and their presets. SI units and radians. */
#ifndef TAHR_CONFIG_H
#define TAHR_CONFIG_H

#include <tahr/types.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TAHR_PRESET_PRECISE = 1 };

/* Defaults in brackets are those of TAHR_PRESET_PRECISE. Ranges, inclusive, h = shape.half_height (tahr_config_check
 * names what is outside): skin 1e-5 h..0.5 h; max_depenetration and perch_threshold 0..1e4 m; walkable_angle 0..90
 * degrees and no more with its hysteresis; 1 <= floor_target <= floor_max <= 10; step_height 0..2 h; snap_distance and
 * perch_extra 0..1e3 m; edge_tolerance 0..0.5 h; speeds 0..1e4 m/s, terminal_speed from 1e-3; accelerations 0..1e6
 * m/s2; gravity -1e4..1e4 m/s2 per axis; turn_friction, braking_drag, air_turn_friction and turn_rate 0..1e4;
 * jump_hold_time 0..1e3 s; air_control 0..100; arc_tolerance 1e-6 h..h; max_dt 1e-6..10 s; switches 0 or 1. */
typedef struct tahr_config {
    uint32_t struct_size;
    uint32_t preset;
    tahr_shape shape; /* [capsule, radius 0.35, half height 0.9] */

    /* Collision */
    uint32_t mask;       /* [all bits] bodies this character meets; 0: none */
    uint32_t max_slides; /* [8] sweeps of one slice of walking or falling, then the rest of the motion is dropped; 1..16 */
    double skin;         /* m [0.01] distance kept from everything that blocks */
    double max_depenetration; /* m [1.0] longest push out of an overlap per step */

    /* Floor */
    double walkable_angle;      /* rad [50 degrees] steepest floor that can be stood on */
    double walkable_hysteresis; /* rad [1 degree] a floor that was walkable stays so this much longer */
    double floor_target;        /* of skin [1.25] clearance that a correction aims at */
    double floor_max;           /* of skin [1.5] clearance up to which nothing is corrected; the band starts at skin */
    double step_height;         /* m [0.4] highest step, floor to landing face */
    double snap_distance;       /* m [0.4] how far down the floor is followed while walking */
    double perch_threshold;     /* m [0.15] a contact in the outermost ring of this width needs a floor further in */
    double perch_extra;         /* m [0.4] how much deeper than snap_distance that floor may lie */
    double edge_tolerance;      /* m [1e-4] impacts this close to the rim of the shape are no floor */
    uint32_t cached_floor;      /* [1] 0: look for the floor even when nothing changed */
    uint32_t walk_off_ledges;   /* [1] 0: stop at ledges instead of falling */

    /* Walking */
    double max_speed;            /* m/s [6] */
    double acceleration;         /* m/s2 [20.48] along the wish */
    double turn_friction;        /* 1/s [8] decay of the velocity across the wish */
    double braking_deceleration; /* m/s2 [20.48] without input, or above the speed asked for */
    double braking_drag;         /* 1/s [16] added to it, proportional to speed */

    /* Falling */
    tahr_vec3 gravity;        /* m/s2 [0, 0, -9.81]; up is opposite */
    double jump_speed;        /* m/s [4.2] */
    double jump_hold_time;    /* s [0] a held jump button suspends gravity this long */
    double terminal_speed;    /* m/s [40] fastest fall */
    double air_control;       /* of acceleration [0.25] */
    double air_turn_friction; /* 1/s [0] turn_friction in the air */
    double arc_tolerance;     /* m [0.001] how far the swept chords may lie off the arc of a fall */

    /* Time and turning */
    double max_dt;     /* s [1] longest step accepted */
    double turn_rate;  /* rad/s [12.5] of the orientation toward input.facing */
    uint32_t sleep;    /* [1] 0: compute also a step whose like has just changed nothing */
    uint32_t reserved; /* 0 */
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

/* "precise", or "?" . Static memory. Since 0.1. */
TAHR_API const char *tahr_preset_name(int32_t preset);

#ifdef __cplusplus
}
#endif
#endif

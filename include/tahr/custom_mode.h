/* SPDX-License-Identifier: MIT
 * custom_mode.h: a mode of the caller's own (a ladder, a rope, a jet pack): one function that moves the character
 * through a piece of time with the library's own moves. tests/examples/ladder.c is a worked example. */
#ifndef TAHR_CUSTOM_MODE_H
#define TAHR_CUSTOM_MODE_H

#include <tahr/mover.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The step under way. Valid during the call that hands it out, on its thread, and nowhere else. */
typedef struct tahr__step tahr_step;

/* What the function answers. Frozen; before the call mode is CUSTOM and time_left 0: all of the time was used, and it
 * goes on. mode is any but HANGING; WALKING without a floor and SWIMMING without a fluid go on to FALLING. */
typedef struct tahr_custom_next {
    uint32_t mode;     /* TAHR_MODE_*, that goes on */
    uint32_t reserved; /* 0 */
    double time_left;  /* s, 0 to the time given: for the mode that goes on */
} tahr_custom_next;

/* [in] user, of tahr_mover_set_custom_mode; step; time (s, > 0) to be used; [out] next. Called while the character's
 * mode is TAHR_MODE_CUSTOM, at most 6 times a step. To repeat a step the function must do the same again: let it depend
 * on what the step tells, on the world and on constants behind user, on nothing else. Return TAHR_OK, or a negative
 * status to end the step with TAHR_E_BACKEND and the state untouched. It may ask the world directly; the mover that
 * calls it answers TAHR_E_REENTRANT, and must not be destroyed. */
typedef tahr_status (*tahr_custom_mode_fn)(void *user, tahr_step *step, double time, tahr_custom_next *next);

/* Sets the function of TAHR_MODE_CUSTOM; NULL: none, then the mode is refused (TAHR_REPORT_MODE_REFUSED), and who is in
 * it stays where it is. A character in the mode never sleeps. Returns TAHR_OK, TAHR_E_NULL (mover), TAHR_E_REENTRANT
 * (inside a step of this mover). Allocates nothing; not while the mover steps. Since 0.1. */
TAHR_API tahr_status tahr_mover_set_custom_mode(tahr_mover *mover, tahr_custom_mode_fn fn, void *user);

/* What the step knows; each pointer is NULL for NULL, and valid as long as the step. The state is the working copy: it
 * moves with the calls below. Since 0.1. */
TAHR_API const tahr_state *tahr_step_state(const tahr_step *step);
TAHR_API const tahr_input *tahr_step_input(const tahr_step *step);
TAHR_API const tahr_config *tahr_step_config(const tahr_step *step);
/* The gravity of this step, of the input or of the config: m/s2, world. Since 0.1. */
TAHR_API const tahr_vec3 *tahr_step_gravity(const tahr_step *step);

/* Sets the velocity (m/s, world, up to 1e5; in a plane, config.plane, its part along it, also of the motions of the two
 * calls below). It moves nothing by itself. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT
 * (not finite, or too fast): then it stays as it was. Since 0.1. */
TAHR_API tahr_status tahr_step_set_velocity(tahr_step *step, const tahr_vec3 *velocity);

/* What a slide did. Frozen. */
typedef struct tahr_step_moved {
    tahr_vec3 motion; /* m, world: from where it began to where it ended */
    tahr_hit last;    /* what was met last; blocking 0 if nothing */
    uint32_t hits;    /* times something was met */
    uint32_t reserved;
} tahr_step_moved;

/* Moves the character by `motion` (m, world, up to 1e6), keeping the skin to everything, and along what is in the way:
 * never into anything, whatever the motion. An overlap at the start is left first. Takes off the velocity what points
 * into something that was met, and reports each as TAHR_EVENT_HIT. [out] moved or NULL. At most config.max_slides
 * sweeps, and what leaving an overlap asks. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT (motion not finite or too
 * long), TAHR_E_BACKEND (an invalid answer: the step fails). Since 0.1. */
TAHR_API tahr_status tahr_step_slide(tahr_step *step, const tahr_vec3 *motion, tahr_step_moved *moved);

/* Where the character's shape would be stopped, a skin away, without moving it. [out] hit: fraction 1 and blocking 0 if
 * nothing is in the way. One sweep; statuses as for tahr_step_slide. Since 0.1. */
TAHR_API tahr_status tahr_step_sweep(tahr_step *step, const tahr_vec3 *motion, tahr_hit *hit);

/* The first thing between origin and origin + motion. One ray; statuses as for tahr_step_slide, and TAHR_E_ARGUMENT for
 * a motion with a z in a TAHR_CAP_PLANAR world. Since 0.1. */
TAHR_API tahr_status tahr_step_ray(tahr_step *step, const tahr_vec3 *origin, const tahr_vec3 *motion, tahr_hit *hit);

/* How deep the character is in a fluid. One fluid query where there may be any. Returns TAHR_OK, TAHR_E_NULL,
 * TAHR_E_BACKEND. Since 0.1. */
TAHR_API tahr_status tahr_step_fluid(tahr_step *step, tahr_fluid *fluid);

/* Reports TAHR_EVENT_CUSTOM with a finite value of the caller's own, `after` seconds (0 or more) into the time that the
 * function was given. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT. Since 0.1. */
TAHR_API tahr_status tahr_step_event(tahr_step *step, double after, double value);

#ifdef __cplusplus
}
#endif
#endif

/* SPDX-License-Identifier: MIT
 * launch.h: velocities from outside: launches, impulses, the drive of an animation. */
#ifndef TAHR_LAUNCH_H
#define TAHR_LAUNCH_H

#include "core.h"
#include "path.h"

/* What the input adds to the velocity at the begin of a step: a launch, which leaves the ground; an impulse, which
 * leaves it if it points upward; a drive, which is the velocity for this step. No query. */
void tahr__launch(tahr__step *step);

enum { TAHR__DRIFT = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD };

/* Is the drive the velocity of this step? */
static inline int is_driven(const tahr__step *step)
{
    return (step->input->flags & TAHR__DRIFT) == TAHR_INPUT_DRIVE;
}

/* Does the drive come on top of the character's own velocity? Then state.velocity is the own one alone. */
static inline int is_drifting(const tahr__step *step)
{
    return (step->input->flags & TAHR__DRIFT) == TAHR__DRIFT;
}

/* m/s: the drive, or its part across up with DRIVE_LEVEL. */
static inline vec3 drive_of(const tahr__step *step)
{
    int level = (step->input->flags & TAHR_INPUT_DRIVE_LEVEL) != 0;
    return level ? step_level(step, step->input->drive) : step->input->drive;
}

/* m/s at which the character moves: its own velocity and what drifts it. */
static inline vec3 whole_velocity(const tahr__step *step)
{
    vec3 v = step->state.velocity;
    return is_drifting(step) ? add(v, drive_of(step)) : v;
}

/* Answers to the drive with that velocity, whatever it was: a law that keeps it. drive lies across up. */
static inline tahr__law drive_law(vec3 drive)
{
    double size = length(drive);
    tahr__law law = {.wish = size > 0 ? scale(drive, 1.0 / size) : vec(0, 0, 0), .speed = size};
    return law;
}

/* Puts a piece of a walk, just begun, under the drive: at its velocity, as far as the walls leave it, or drifting with
 * it. No query. */
void tahr__drive_piece(tahr__step *step, tahr__path *w);

/* As tahr__law_time, of a motion that drifts. */
double tahr__drift_time(const tahr__law *law, vec3 v, vec3 drift, double duration, vec3 whole, double part);

#endif

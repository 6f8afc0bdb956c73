/* SPDX-License-Identifier: MIT
 * trail.h: where the character has been in this step, for the sensors on the way (overlap.h). Kept in worlds with
 * sensors only. */
#ifndef TAHR_TRAIL_H
#define TAHR_TRAIL_H

#include "core.h"

/* Legs that wait to be asked about. The last one takes in what no longer fits while a scope may take legs back. */
enum { TAHR__LEGS = 24 };

/* How time runs along a leg: evenly; as a walk does; as a fall does, with an acceleration that stays the same. */
enum { TAHR__PACE_EVEN, TAHR__PACE_WALK, TAHR__PACE_FALL };

/* A part of a piece of a walk: its closed form, when it began (s from the start of the step), and the parts of its
 * way. */
typedef struct tahr__stretch {
    tahr__law law;
    vec3 velocity, whole; /* at its begin; displacement of all of it */
    double start, duration;
    double first, last;
} tahr__stretch;

/* A straight way, without a gap to the one before. */
typedef struct tahr__leg {
    vec3 from, to;
    double begin, end; /* s from the start of the step */
    uint32_t clear;    /* its sweep met no sensor */
    uint32_t ignore_body;
    uint32_t pace; /* TAHR__PACE_* */
    uint32_t reserved;
    vec3 velocity;         /* FALL: m/s, at its begin */
    tahr__stretch stretch; /* WALK */
} tahr__leg;

typedef struct tahr__trail {
    uint32_t count;
    uint32_t timed;    /* the first so many legs have their times */
    uint32_t resolved; /* legs that were asked about and forgotten */
    uint32_t held;     /* 1: a scope may take legs back; until the slice ends */
    uint32_t spans;    /* 1: that scope goes on over the ends of slices (wading.c) */
    uint32_t asked;    /* sweeps for sensors */
    uint32_t current;  /* at the start of the step neither the character nor the world had moved since the last one */
    uint32_t swept, clear;
    double slice;                  /* s from the start of the step at which the slice began */
    vec3 sweep_from, sweep_motion; /* of the last sweep of the whole shape, if swept */
    vec3 at;                       /* where the last leg ends */
    vec3 up;                       /* at the start of the step, like the rest */
    tahr_quat orientation;
    double radius, half_height;
    tahr__leg legs[TAHR__LEGS];
} tahr__trail;

/* Begins a trail at the state's position, before anything else is done. */
void tahr__trail_begin(tahr__trail *trail, tahr__step *step);

/* A leg from where the trail ends to where the character is now; its time comes with the next stamp. */
void tahr__trail_reach(tahr__step *step);

/* The same, where a motion begins: costs a branch where there is no trail. */
static inline void tahr__trail_go(tahr__step *step)
{
    if (step->trail) {
        tahr__trail_reach(step);
    }
}

/* A sweep of the whole shape was made; clear: it met no sensor. */
void tahr__trail_swept(tahr__trail *trail, const tahr_sweep *sweep, int clear);

/* A sweep of the whole shape that also finds out whether it meets a sensor: a leg that does not need not be asked
 * about. */
tahr_status tahr__sensing_sweep(tahr__step *step, const tahr_sweep *q, tahr_hit *hit, uint32_t *count);

/* The legs without a time were gone along between two times (s from the start of the step). */
void tahr__trail_stamp(tahr__step *step, double begin, double end);

/* The last leg is such a stretch of a walk; legs without a time before it took none. */
void tahr__trail_stamp_walk(tahr__step *step, const tahr__stretch *stretch);

/* The last leg, which began at `from`, went only as far as the character is now; part: of the piece, where it is a
 * walk's. */
void tahr__trail_cut(tahr__step *step, vec3 from, double part);

/* Everything behind the first so many legs was not gone along; the character is where they end. */
void tahr__trail_forget(tahr__step *step, uint32_t count);

/* When a plane with this normal was met at a fraction of a leg, s from the start of the step. */
double tahr__leg_time(const tahr__leg *leg, double fraction, vec3 normal);

#endif

/* SPDX-License-Identifier: MIT
 * path.h: the path of one slice of walking: closed-form pieces, bent by walls, lifted onto ramps and steps. */
#ifndef TAHR_PATH_H
#define TAHR_PATH_H

#include "around.h"
#include "trail.h"

/* Where a slice is: the piece of it that is under way, and what has been met. A piece is one closed-form motion; a wall
 * ends it and begins the next. */
typedef struct tahr__path {
    tahr__law law;
    vec3 velocity;    /* at the begin of the piece */
    double began;     /* s from the begin of the slice */
    double duration;  /* s of the piece, if nothing ends it */
    double rest;      /* s of the slice after it: 0 unless it goes around something */
    vec3 wish;        /* level displacement of the whole piece */
    double left;      /* part of it not yet covered */
    double stop_time; /* s from the begin of the slice at which the character stops; < 0: it does not */
    tahr__plane walls[TAHR__MAX_PLANES];
    uint32_t wall_count;
    vec3 ramps[TAHR__MAX_PLANES]; /* normals of the walkable faces that carry */
    uint32_t ramp_count;
    vec3 slope;  /* normal of the ground that sets the speed */
    double ease; /* rise per metre that keeps rounding from pointing into a ramp */
    vec3 start;  /* where the slice began */
    vec3 from;   /* the last straight piece of the way, to find the place where a floor ended */
    double left_before;
    uint32_t turns;            /* times that something was met */
    uint32_t careful;          /* 1: the path ends where it meets something without a floor underfoot */
    uint32_t lowered;          /* 1: here a step ended that something overhead cut short */
    double lost;               /* s of the piece that a cap or an answer dropped */
    struct tahr__scope *scope; /* to open where something is first met, as it was at the begin; NULL: it is open */
    vec3 given;                /* the state's velocity then */
    uint32_t drifts;           /* 1: a drive comes on top of the velocity */
    vec3 drift;                /* m/s, with drifts: its level part */
    tahr__around around;       /* what the last wall belongs to */
    double chord;              /* s of each piece of a way that bends; 0: it is not cut up */
    uint32_t chords;           /* of them */
    uint32_t knows_below;      /* 1: what the foot meets where the path is now: */
    tahr_hit below;
} tahr__path;

/* Starts a path of `duration` seconds at the state's position and velocity. No query. */
void tahr__path_begin(tahr__step *step, tahr__path *w, double duration);

/* Looks at the ground that sets the speed, where the floor is steep. 0 or 1 ray. */
void tahr__path_find_slope(tahr__path *w, tahr__step *step);

/* Goes along the path until its end, or until nothing of it is left. At most max_slides sweeps, and what the steps in
 * the way ask; two more for each turn around something (report.arcs). */
void tahr__path_walk(tahr__step *step, tahr__path *w);

/* The floor under the end of that walk, as tahr__find_floor tells it; the walk may have met it already. */
void tahr__path_look_below(tahr__step *step, tahr__path *w, tahr_floor *floor);

/* The last straight piece of the way went only a part of it, to where the character is now. No query. */
void tahr__path_cut(tahr__step *step, tahr__path *w, double part);

/* s of the present piece that are used up where the path is now. No query. */
double tahr__path_used(const tahr__path *w);

/* Events from here on happen where the path is now. Returns the s of the present piece that are used up; < 0 if nobody
 * asks for events, and it was not worked out. No query. */
double tahr__path_look_ahead(tahr__step *step, const tahr__path *w);

/* A wall was added to the set: the rest of the slice is a piece of its own. No query. */
void tahr__path_bend(tahr__step *step, tahr__path *w);

/* Cosine: floors that are steeper may be the bevel of a step; see tahr__path_find_slope. */
#define TAHR__GENTLE 0.966

/* How a wish (m/s, across up, of `size`) is approached, of which walls leave the part `kept`: `asked` m/s. No query. */
static inline tahr__law tahr__law_of_wish(const tahr_config *c, const tahr__decay *known, vec3 wish, double size,
                                          double asked, double kept)
{
    tahr__law law = {.wish = size > 0 ? scale(wish, 1.0 / size) : vec(0, 0, 0),
                     .speed = asked * kept,
                     .acceleration = c->acceleration * kept,
                     .turn_friction = c->turn_friction,
                     .braking = c->braking_deceleration,
                     .drag = c->braking_drag,
                     .decay = *known};
    return law;
}

/* A level displacement with its rise, as long as it is level on a slope that it climbs by `climb`. No query. */
static inline vec3 tahr__lift(vec3 level, vec3 up, double rise, double climb)
{
    double size = length(level);
    return scale(add_scaled(level, up, rise), size / sqrt(size * size + climb * climb));
}

/* Takes the state's floor as the ramp that carries. No query. */
void tahr__path_carry_floor(tahr__path *w, const tahr__step *step);

#endif

/* SPDX-License-Identifier: MIT
 * around.h: going on around an edge or a round body within a slice: when a slide is turned, and by how much. */
#ifndef TAHR_AROUND_H
#define TAHR_AROUND_H

#include "core.h"

/* What is gone around: the character's place lies on a circle about an axis, or on a sphere about a point, and the
 * plane that it slides along touches that. */
typedef struct tahr__around {
    vec3 pivot;    /* of the place: a point of the axis, or the centre */
    vec3 axis;     /* unit; zero: about the point */
    double radius; /* m */
    vec3 normal;   /* of the plane as it is now */
    double piece;  /* s between two turns */
    double next;   /* s until the next one */
    double rest;   /* s from a turn to where the circle is touched again, */
    double over;   /* and m along the tangent, of a constant velocity */
    double reach;  /* m across the axis until the next turn, of a constant velocity; 0: as the law says */
    double rested; /* s and m of rest and over that are in this piece: where it touches the circle */
    double passed;
    uint32_t body, feature;
    uint32_t is_round; /* 1: what was met last can be gone around */
    uint32_t turns;    /* 1: and is: the plane is turned */
    uint32_t done;     /* turns in this slice */
    uint32_t is_over;  /* 1: no more of it in this slice */
    uint32_t leaves;   /* 1: flies off along a curve: */
    vec3 aside;        /* m: its second half, after half of the tangent */
} tahr__around;

/* Of the time of what lies ahead. */
#define TAHR__GLIMPSE 0.0625

/* The most turns of a slice: 16 of a tolerance of 2 mm go around a quarter of a pillar of 10 m. */
enum { TAHR__MOST_TURNS = 16 };

/* Nothing was met yet. */
static inline void tahr__around_begin(tahr__around *a)
{
    a->is_round = a->turns = a->done = a->is_over = a->leaves = 0;
    a->normal.x = a->normal.y = a->normal.z = 0;
}

/* It is left behind. */
static inline void tahr__around_leave(tahr__around *a)
{
    a->is_round = a->turns = a->leaves = 0;
}

/* Something was met: of the planes that one goes which was turned. No query. */
void tahr__around_hit(const tahr__around *a, tahr__plane *planes, uint32_t *count);

/* Looks at what was met at the character's place: an edge, or a round body. level: 1: of a character that stays at its
 * height, which goes around what is upright or a ball. No query. */
void tahr__around_meet(const tahr__step *step, const tahr_hit *hit, int level, tahr__around *a);

/* What lies ahead. */
typedef struct tahr__ahead {
    vec3 velocity;  /* m/s, now, */
    vec3 along;     /* m: the way along the plane, in `time`, */
    vec3 freely;    /* and a glimpse of the one without it: in TAHR__GLIMPSE of it */
    double longest; /* m: no way along the thing is longer */
    double time;    /* s */
} tahr__ahead;

/* m: the way in a time at the fastest that this law leads to from a speed. Pieces of one duration are then none of them
 * too long. */
double tahr__around_longest(const tahr__law *law, double speed, double time);

/* Turns from here on if the character is pressed against what it met and the way is long enough to matter. Returns 0 if
 * it is not pressed: the free path leaves the circle. */
int tahr__around_start(const tahr__step *step, tahr__around *a, const tahr__ahead *ahead);

/* The velocity of who is held by what it goes around: none off it. */
static inline vec3 tahr__around_hold(const tahr__around *a, vec3 normal, vec3 velocity)
{
    return a->turns ? reject(velocity, normal) : velocity;
}

/* The same of a constant velocity `wish`, of which the planes leave `along`: as far as it goes until the next turn is
 * then a closed form. time: s that are left. */
void tahr__around_drive(const tahr__step *step, tahr__around *a, vec3 wish, vec3 along, double time);

/* The way of a piece of `time` seconds at that velocity, and when a part of it was covered. */
vec3 tahr__around_way(const tahr__around *a, vec3 along, double time);
double tahr__around_time(const tahr__around *a, double time, double part);

/* s of a piece that the next turn leaves of `time`. */
static inline double tahr__around_piece(const tahr__around *a, double time)
{
    return a->turns && a->next < time ? a->next : time;
}

/* `time` seconds of a piece passed with nothing met. Returns 1 if the plane must be turned now. */
int tahr__around_use(tahr__around *a, double time);

/* Turns the plane at the character's place. [out] plane: it, [in,out] velocity: turned with it. Returns 0 if there is
 * nothing to turn. No query. */
int tahr__around_turn(tahr__step *step, tahr__around *a, tahr__plane *plane, vec3 *velocity);

#endif

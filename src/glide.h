/* SPDX-License-Identifier: MIT
 * glide.h: moving freely in three dimensions: straight pieces, bent along everything that is touched. What swimming,
 * flying and a caller's own mode share. */
#ifndef TAHR_GLIDE_H
#define TAHR_GLIDE_H

#include "around.h"
#include "slide.h"

/* A slice of it. */
typedef struct tahr__glide {
    vec3 start;        /* where it began */
    vec3 lifted;       /* m, by steps: no motion of its own */
    double time, left; /* s */
    uint32_t hits, pieces;
    tahr__plane planes[TAHR__MAX_PLANES]; /* only what is counted is read */
    uint32_t plane_count;
    tahr__around around; /* what the last one belongs to */
} tahr__glide;

/* A slice swept in more pieces than this has lost its way. */
enum { TAHR__GLIDE_PIECES = 64 };

void tahr__glide_begin(tahr__step *step, tahr__glide *glide, double time);

/* Is there time left, and may it still be used? Forgets what was left behind. */
int tahr__glide_goes_on(const tahr__step *step, tahr__glide *glide);

/* s of the next piece: straight within a skin of a path that bends with this acceleration (m/s2), and no longer than
 * until it is turned. */
double tahr__glide_piece(const tahr__step *step, const tahr__glide *glide, double acceleration);

/* What the planes leave of a velocity or a motion. */
static inline vec3 tahr__glide_bend(const tahr__glide *glide, vec3 v)
{
    return tahr__slide(glide->planes, glide->plane_count, v);
}

/* Nothing was met for the time of a piece, which is counted: what it slides along is turned, if it is time. No
 * query. */
void tahr__glide_pass(tahr__step *step, tahr__glide *glide, double time);

/* Counts the time of a piece. */
void tahr__glide_use(tahr__step *step, tahr__glide *glide, double time);

/* Something was met: along it from here on. Returns 0 if nothing can go on from here (an overlap, or an answer that is
 * none). No query. */
int tahr__glide_meet(tahr__step *step, tahr__glide *glide, const tahr_hit *hit);

/* Over what was met, if that is as low as a step from the foot on, and the motion level enough. rest: what is left of
 * it, whose time is not counted here. Returns the part of the rest that it made, if it stands on it now, on the state's
 * floor, with `keeps` or without an opinion of it; 0 with everything as it was. 3 to 12 queries where the front is
 * steep, else none. */
double tahr__glide_step_up(tahr__step *step, tahr__glide *glide, const tahr_hit *hit, vec3 rest,
                           int (*keeps)(tahr__step *));

/* config.slide_solver TWO_WALLS: the whole piece of `time` seconds at once, over, or along one surface and a second
 * one. The velocity of one that was blocked is what was covered. keeps as above. [out] hit: what was met first. Returns
 * 1 if it stepped up. 1 to 4 sweeps, up to 12 queries for a step, and what overlaps ask. */
typedef struct tahr__glide_motion {
    vec3 way;
    double time; /* s */
    int (*keeps)(tahr__step *step);
} tahr__glide_motion;
int tahr__glide_two_walls(tahr__step *step, tahr__glide *glide, const tahr__glide_motion *motion, tahr_hit *hit);

/* The end of a slice: what could not be used is lost. STEPPED: the velocity is what was really covered, unless by a
 * push out of an overlap. */
void tahr__glide_end(tahr__step *step, tahr__glide *glide);

/* No floor is known, as nothing looks for one in these modes. */
void tahr__glide_forget_floor(tahr__step *step);

#endif

/* SPDX-License-Identifier: MIT
 * score_distance.h: what the files of score.h share: the distance in long double, with the start of the query as
 * origin. */
#ifndef TAHR_ACCURACY_SCORE_DISTANCE_H
#define TAHR_ACCURACY_SCORE_DISTANCE_H

#include "score.h"

#define TAHR_TRUTH_REAL long double
#include "quad_distance.h"

/* The core at a fraction of the motion. */
core score__core(const tahr_sweep *query, long double fraction);
triangle score__triangle(const score_body *body, const tahr_sweep *query, uint32_t index);
/* 1: no point of a core within way (m) of where it starts is nearer to the triangle than reach. */
int score__beyond(const tahr_sweep *query, const triangle *t, double way, double reach);
/* Is the core's centre in the solid? */
int score__inside(const score_body *body, const tahr_sweep *query, long double fraction);
/* Of the whole scene: the nearest, or squared < 0 if nothing is within reach. */
nearest score__nearest(const score_scene *scene, const tahr_sweep *query, long double fraction, double reach);

#endif

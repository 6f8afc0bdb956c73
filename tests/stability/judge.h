/* SPDX-License-Identifier: MIT
 * judge.h: an independent look at a trial: how near the character is to what blocks, and whether it went through it.
 * Nothing of it is shared with the library. */
#ifndef STABILITY_JUDGE_H
#define STABILITY_JUDGE_H

#include "trial.h"

typedef struct judge judge;

/* t must stay as it is. NULL: out of memory. */
judge *judge_open(const trial *t);
void judge_close(judge *j);

/* m between the state's upright capsule and the nearest body where poses says they are, at most limit; below 0 it
 * overlaps one, told as long as its axis does not. body may be NULL. */
double judge_gap(const judge *j, const tahr_pose *poses, const tahr_state *state, double limit, uint32_t *body);

/* The same to body i alone, in long double by brute force: for who is accused. */
double judge_gap_again(const judge *j, const tahr_pose *poses, const tahr_state *state, uint32_t body);

/* Whether the middle of the character, on a straight way from `from` to `to`, went through body i, which moved from
 * one pose to the other meanwhile. */
int judge_crossed(const judge *j, uint32_t body, const tahr_pose *before, const tahr_pose *now, tahr_vec3 from,
                  tahr_vec3 to);

#endif

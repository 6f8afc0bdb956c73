/* SPDX-License-Identifier: MIT
 * push.h: bodies that move into a character, and characters that push bodies. */
#ifndef TAHR_PUSH_H
#define TAHR_PUSH_H

#include "core.h"

/* What the bodies that tahr_world_move moved do to a character that was at `from` before they did: push it, or, in the
 * air, become what its velocity is relative to. For each body near: 1 to 2 sweeps of 16
 * pieces at most; 12 for a push, and what a step up asks. */
void tahr__meet_bodies(tahr__step *step, vec3 from, double dt);

/* Has a body moved, but for one, within reach of the character or of its look for the floor? No query. */
int tahr__moves_near(const tahr__step *step, uint32_t except);

/* m, how deep the character is in bodies that never move. No query. */
double tahr__fixed_depth(const tahr__step *step, const tahr_contact *contacts, uint32_t count);

/* A push that not all contacts allow, corrected so that no body that never moves is entered: what moves gives way, or
 * crushes. No query. */
vec3 tahr__spare_the_fixed(const tahr__step *step, const tahr_contact *contacts, uint32_t count, vec3 push);

/* Reports the push of a hit against a body that has a mass. speed: of the character into it, m/s. */
void tahr__report_push(tahr__step *step, const tahr_hit *hit, double speed);

/* Reports the weight on a floor that has a mass. */
void tahr__press_down(tahr__step *step);

#endif

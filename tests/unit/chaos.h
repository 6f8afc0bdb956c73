/* SPDX-License-Identifier: MIT
 * chaos.h: random valid settings, input and scenes for tests of everything at once. */
#ifndef CHAOS_H
#define CHAOS_H

#include <tahr/tahr.h>

#include "dice.h"

/* A valid config: every combination of methods, every kind of shape, the numbers drawn over their useful ranges, one in
 * eight at the end of what is allowed. */
tahr_config chaos_config(oracle_random *dice);

/* Valid input of every kind; calm: what a player does, mostly. state: what it is for. */
tahr_input chaos_input(oracle_random *dice, int calm, const tahr_config *config, const tahr_state *state);

/* s: mostly the usual rates, else 1e-4 to 0.2, seldom 0, the longest allowed, or too short to move. */
double chaos_dt(oracle_random *dice, const tahr_config *config);

/* A closed hall, 16 m x 16 m x 8 m about the origin, with all kinds of bodies in it. */
enum { CHAOS_BODIES = 36, CHAOS_MOVABLES = 20 };
typedef struct chaos_scene {
    double vertices[13 * 13 * 3];
    uint32_t indices[12 * 12 * 6];
    tahr_body_desc bodies[CHAOS_BODIES];
    tahr_body_pose poses[CHAOS_MOVABLES]; /* of all that may move, now */
    tahr_vec3 homes[CHAOS_MOVABLES];
} chaos_scene;

/* Describes it; fluids: whether the backend knows them. */
void chaos_build(chaos_scene *scene, oracle_random *dice, int fluids);

/* Goes on with some of the poses, for tahr_world_move over dt: drifts, turns, lifts, teleports. Returns how many of
 * moves[CHAOS_MOVABLES] it filled in; scene->poses follow. */
uint32_t chaos_drift(chaos_scene *scene, oracle_random *dice, double dt, tahr_body_pose *moves);

/* The section of all this with a plane, for backends of two dimensions: x stays, what was up becomes +y, the hills
 * become a chain, the walls in front and behind are put away, and some bodies are one-way. */
tahr_vec3 chaos_flat(tahr_vec3 v);
void chaos_flatten(chaos_scene *scene);
/* And of what chaos_drift says of a flattened scene; scene->poses follow. */
void chaos_flatten_moves(chaos_scene *scene, tahr_body_pose *moves, uint32_t count);

#endif

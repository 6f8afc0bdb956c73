/* SPDX-License-Identifier: MIT
 * stepped.h: velocity and time in steps, as config.integrator STEPPED takes them. Asks nothing, allocates nothing. */
#ifndef TAHR_STEPPED_H
#define TAHR_STEPPED_H

#include "core.h"

/* s: what is left of a step is rounding below this (MIN_TICK_TIME). */
#define TAHR__LEAST_TIME 1e-6

/* GetSimulationTimeStep: s of the next slice of the `left` s that a step still has: no more than max_substep, the last
 * two of equal length, and all that is left in the max_substeps-th. iteration counts from 1. EXACT: all that is
 * left. */
double tahr__time_step(const tahr_config *config, double left, uint32_t iteration);

/* Counts one more slice of the step. Returns its s, of the `left` s; 0 if the step has no slice left: then the rest is
 * reported as lost. */
double tahr__begin_iteration(tahr__step *step, double left);

/* ApplyVelocityBraking: drag (1/s) and deceleration braking (m/s2) against a velocity for t seconds, in pieces of at
 * most braking_substep; a reversal or less than stop_speed is standing. */
vec3 tahr__velocity_braking(const tahr_config *config, const tahr__law *law, vec3 velocity, double t);

/* CalcVelocity: braking or turning, the friction of a fluid (1/s, 0: none), then acceleration. law->acceleration is
 * that of this input. */
vec3 tahr__calc_velocity(const tahr_config *config, const tahr__law *law, double fluid, vec3 velocity, double t);

/* NewFallVelocity: gravity for t seconds, along it no faster than terminal. */
vec3 tahr__new_fall_velocity(const tahr__pull *pull, double terminal, vec3 velocity, double t);

/* The law of a constant velocity: what a slice keeps after its velocity was stepped. */
tahr__law tahr__constant_law(void);

/* How the state's velocity across up answers to the input, walking. */
tahr__law tahr__walking_law(const tahr__step *step);

/* GetFallingLateralAcceleration: the same in the air: air control, with its boost at low speed, never more than the
 * full acceleration. */
tahr__law tahr__falling_law(const tahr__step *step);

/* MaintainHorizontalGroundVelocity: the level velocity of one that walks: its level part if the level speed is kept,
 * else the same speed across up. */
vec3 tahr__level_velocity(const tahr__step *step, vec3 velocity);

#endif

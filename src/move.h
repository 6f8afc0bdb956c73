/* SPDX-License-Identifier: MIT
 * move.h: moving the character's shape through the world without touching anything. */
#ifndef TAHR_MOVE_H
#define TAHR_MOVE_H

#include "core.h"

/* One sweep of the character, and what came of it. */
typedef struct tahr__swept {
    tahr_hit hit;        /* fraction: of the motion that was made, after the pull-back */
    vec3 start;          /* centre before */
    vec3 location;       /* centre at the contact, before the pull-back: the field's Location */
    vec3 motion;         /* asked for, within config.plane */
    uint32_t overlapped; /* there was an overlap at the start, which a safe move has tried to leave */
    uint32_t reserved;
} tahr__swept;

/* IsValidBlockingHit: stopped on the way, not from the start by an overlap. */
static inline int is_blocked(const tahr_hit *hit)
{
    return hit->blocking && !hit->start_overlap;
}

/* The same, and known what by: something that can be slid along or landed on. */
static inline int is_met(const tahr_hit *hit)
{
    return hit->blocking && !hit->start_overlap && !hit->unknown;
}

/* Sweeps the character by motion, keeping skin, and puts it where the sweep ended. An overlap at the start is resolved
 * first and the motion tried once more. [out] hit. Returns 1 if there was one. One sweep; at most
 * 2 + TAHR__DEPENETRATION_QUERIES. */
int tahr__move(tahr__step *step, vec3 motion, tahr_hit *hit);

/* The same with another config.separation or config.depenetration: apart, so that the usual one stays small. */
int tahr__move_otherwise(tahr__step *step, vec3 motion, tahr_hit *hit);

/* Pushes the character out of everything that it overlaps, all at once. What cannot be resolved is halved between the
 * walls and reported as crushed. Returns 1 if nothing is overlapped any more. */
int tahr__depenetrate(tahr__step *step);

enum { TAHR__DEPENETRATION_ROUNDS = 4, TAHR__DEPENETRATION_QUERIES = 2 * TAHR__DEPENETRATION_ROUNDS + 1 };

/* MoveUpdatedComponent: one sweep by motion, with config.separation; the character goes as far as that lets. flags:
 * TAHR_SWEEP_LEAVE_OVERLAP to ignore an overlap that the motion leaves, 0 to be stopped by every one (the field's
 * "never ignore"). A motion too short to matter is skipped: no query, nothing moves, nothing was hit, and that is a
 * success. [out] swept. Returns 0 if something was in the way from the start. 0 or 1 sweep. */
int tahr__move_updated(tahr__step *step, vec3 motion, uint32_t flags, tahr__swept *swept);

/* SafeMoveUpdatedComponent: the same; an overlap at the start is left by config.depenetration and, if that succeeded,
 * the whole motion tried once more. [out] swept: of the last try. Returns what that returned. 0 or 1 sweep; out of a
 * single overlap 3 queries with SINGLE; at most TAHR__SAFE_MOVE_QUERIES with SINGLE, 2 + TAHR__DEPENETRATION_QUERIES
 * with JOINT. */
int tahr__safe_move(tahr__step *step, vec3 motion, tahr__swept *swept);

enum { TAHR__RESOLVE_QUERIES = 5, TAHR__SAFE_MOVE_QUERIES = 2 + TAHR__RESOLVE_QUERIES };

/* PullBack: the part of a motion of `length` metres that is taken back in front of a blocker. */
double tahr__pull_back_part(const tahr_config *config, double length);

/* The fraction t of such a motion after the pull-back. */
double tahr__pull_back(const tahr_config *config, double t, double length);

/* GetPenetrationAdjustment: the push out of a hit that is a start in overlap, no longer than config.max_depenetration,
 * or _character out of a TAHR_BODY_CHARACTER; zero of another hit. (A simulated proxy of the field is a character with
 * smaller values of these two.) No query. */
vec3 tahr__penetration_adjustment(const tahr__step *step, const tahr_hit *hit);

/* ResolvePenetration: out of the overlap that stopped `swept`: by `adjustment` at once if a little more than the shape
 * fits there, else as far as sweeps let, of it, of it and that of a second surface, of it and the motion. Returns 1 if
 * the character was moved; then step->just_teleported is set. 1 contact query and up to 4 sweeps. */
int tahr__resolve_penetration(tahr__step *step, vec3 adjustment, const tahr__swept *swept);

#endif

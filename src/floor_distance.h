/* SPDX-License-Identifier: MIT
 * floor_distance.h: how far below the floor is, found by a shorter shape without a skin (TAHR_FLOOR_PROBE_SHRUNK).
 *
 * The ends of a shape that touches, or overlaps, what it stands on cannot be swept from where they are. A shape that is
 * shorter at both ends can, and finds the depth of an overlap as a negative distance. Lengths named in centimetres are
 * those of the field; here they are parts of config.skin, edge_tolerance and pull_back, and so grow with the
 * character. */
#ifndef TAHR_FLOOR_DISTANCE_H
#define TAHR_FLOOR_DISTANCE_H

#include "floor.h"

/* How a floor is looked for. */
typedef struct tahr__floor_look {
    vec3 from;                      /* centre of the character's shape */
    double line_distance;           /* m below the shape that a ray may go */
    double sweep_distance;          /* m below the shape that a sweep may go, >= line_distance */
    double radius;                  /* m, of the probe: limits.width, or less */
    const tahr__supplied *supplied; /* a sweep that may take the place of the first one, or NULL */
} tahr__floor_look;

/* m, 1e-4 cm: lengths that differ by less are the same. */
static inline double tiny_length(const tahr_config *c)
{
    return 1e-3 * c->pull_back;
}

/* IsWithinEdgeTolerance: is the point of an impact, seen along up, well inside the rim of a probe of this radius at
 * `centre`? For boxes the radius stands for how much thinner than the character the probe is. No query. */
int tahr__is_within_edge_tolerance(const tahr__step *step, vec3 centre, vec3 point, double radius);

/* FloorSweepTest: sweeps a probe down from `from` without a skin; with config.flat_base a box in place of a round one,
 * if the backend has boxes: its corners on the axes first, then its sides. Returns 1 if something was met. 1 sweep,
 * with flat_base 1 or 2. */
int tahr__floor_sweep_test(tahr__step *step, const tahr__foot *probe, vec3 from, double range, tahr_hit *hit);

/* ComputeFloorDist: the floor below: by the supplied sweep; else a sweep, once more with a thinner probe where that
 * overlapped something or touched at the rim; else a ray under the axis. floor->distance is the way down until the
 * shape touches (negative: the way up out of an overlap), floor->perch_distance with TAHR_FLOOR_LINE what the ray
 * found. At most 2 sweeps (with flat_base 4) and 1 ray. */
void tahr__compute_floor_distance(tahr__step *step, const tahr__floor_look *look, tahr_floor *floor);

enum { TAHR__FLOOR_DISTANCE_QUERIES = 3 };

#endif

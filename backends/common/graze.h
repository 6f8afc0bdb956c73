/* SPDX-License-Identifier: MIT
 * graze.h: a motion that comes as near to an edge as its margin, and no nearer, passes it: a head under a ceiling that
 * is exactly a skin above it. Whoever arrives within a tolerance finds such an edge in its way, and where a floor lies
 * below the way round it is shut. */
#ifndef TAHR_COMMON_GRAZE_H
#define TAHR_COMMON_GRAZE_H

#include "hits.h"

/* Slope against the surface up to which a second look is worth its cost. An edge at a distance of r is arrived at
 * within 1e-9 m at a slope of sqrt(2e-9 m / r): this one for 20 um. */
#define TAHR__GRAZING 1e-2

/* How far the distance is above the margin at a fraction of the motion, and by how much it falls per fraction. */
typedef struct tahr__descent {
    double gap, speed, fraction;
} tahr__descent;

/* Where to look a second time: as far beyond an edge, passed at a distance of radius, as here is before it. */
static inline double tahr__beyond(const tahr__descent *here, double radius, double motion_length)
{
    return here->fraction + 2 * radius * here->speed / (motion_length * motion_length);
}

/* The distance is convex: between two places it lies above the tangents of both. Is it never below the margin by more
 * than the tolerance? `there` is beyond `here`, and what is approached from there too is no edge that is passed. */
static inline int tahr__grazes(const tahr__descent *here, const tahr__descent *there, double motion_length,
                               double tolerance)
{
    double way = there->fraction - here->fraction, closing = here->speed - there->speed;

    if (there->speed > TAHR__PARALLEL * motion_length || !(closing > 0)) return 0;
    double lowest = here->gap - here->speed * (here->gap - there->gap - there->speed * way) / closing;
    return lowest >= -tolerance;
}

#endif

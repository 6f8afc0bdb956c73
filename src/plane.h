/* SPDX-License-Identifier: MIT
 * plane.h: motion held in one plane (config.plane), as in a side-scroller. */
#ifndef TAHR_PLANE_H
#define TAHR_PLANE_H

#include "core.h"
#include "shape.h"

static inline int is_in_plane(const tahr__step *step)
{
    return step->limits->in_plane != 0;
}

/* The part of v that the plane allows; all of it without one. */
static inline vec3 along_plane(const tahr__limits *limits, vec3 v)
{
    return limits->in_plane ? reject(v, limits->plane) : v;
}

/* Can it rise at all? Not if up points out of the plane: seen from above, nothing falls, jumps, steps or snaps. */
static inline int may_rise(const tahr__step *step)
{
    double out = dot(step->limits->plane, step->state.up);
    return !is_in_plane(step) || (out < 1e-6 && out > -1e-6);
}

/* Is it seen from the side, and may not turn about up? In a world of two dimensions, and a shape that is not round:
 * half turned it would be another one in the plane. */
static inline int is_flat(const tahr__step *step)
{
    return is_in_plane(step) && may_rise(step) &&
           (world_is_planar(step->world) || !shape_is_round(&step->limits->shape));
}

/* Makes what a surface forbids into what it forbids in the plane: normal . x >= offset. Returns 0, and a half-space
 * that forbids nothing, for a surface that faces out of the plane, which nothing in it can meet or leave. */
int tahr__plane_surface(const tahr__step *step, vec3 *normal, double *offset);

/* Holds the input and the velocity in the plane, for the step; and at its end the place and the velocity. No query. */
void tahr__plane_begin(tahr__step *step);
void tahr__plane_end(tahr__step *step);

#endif

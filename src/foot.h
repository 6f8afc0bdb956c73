/* SPDX-License-Identifier: MIT
 * foot.h: what is swept downward with its skin to find the floor: the whole shape, or a thinner one. */
#ifndef TAHR_FOOT_H
#define TAHR_FOOT_H

#include "query.h"

/* What sweeps the way down for a shape on a backend with these TAHR_CAP_*. */
tahr__foot tahr__foot_of(const tahr_shape *shape, uint32_t capabilities);

/* The foot of the character's shape, thinner all round, with its end where it was. */
tahr__foot tahr__thinner_foot(const tahr__step *step, double by);

/* Makes a shape thinner all round, with its height and the kind of its ends kept; never thinner than a part of it. A
 * hull cannot be: it becomes the box of its extents, or stays as it is where the backend has no boxes. */
void tahr__thin_shape(tahr_shape *shape, double by, double part, uint32_t capabilities);

/* Sweeps a foot down from the character's position, keeping the skin. One sweep. */
static inline void foot_sweep(tahr__step *step, const tahr__foot *foot, double range, tahr_hit *hit)
{
    vec3 up = step->state.up;
    vec3 from = add_scaled(step->state.position, up, foot->offset);
    /* Between walls that move in on the character only what is below counts. */
    uint32_t flags = step_squeezes(step) ? (uint32_t)TAHR_SWEEP_LEAVE_OVERLAP : 0u;
    tahr__sweep(step, &foot->shape, from, scale(up, -range), step->config->skin, flags, hit);
}

/* How far down the foot looks for a floor within reach. */
static inline double foot_range(const tahr_config *c, double reach)
{
    return reach + (c->floor_max - 1) * c->skin;
}

/* Clearance below in the direction of up, from such a sweep over `range`. */
static inline double foot_clearance(const tahr__step *step, const tahr_hit *hit, double range)
{
    double skin = step->config->skin;
    if (hit->fraction > 0 || hit->distance >= skin) {
        return hit->fraction * range + skin;
    }
    /* Closer than skin already: the way up that restores it, for slopes not steeper than 78 degrees. */
    double rate = max_of(dot(hit->normal, step->state.up), 0.2);
    return skin - (skin - max_of(hit->distance, 0)) / rate;
}

#endif

/* SPDX-License-Identifier: MIT
 * figure.h: a character as the others of its crowd see it in a tick, and the plane between two of them. */
#ifndef TAHR_FIGURE_H
#define TAHR_FIGURE_H

#include "core.h"
#include "neighbours.h"

typedef struct tahr__figure {
    vec3 at;       /* once what it stands on has carried it */
    vec3 box;      /* m, half extents of what it can touch in this tick, along the world's axes; negative x: not there */
    vec3 reach;    /* m, of that what it may go */
    vec3 up;
    tahr_quat orientation;
    tahr_shape shape;
    vec3 way;         /* m, that it would go in this tick with its velocity */
    double half_skin; /* m that it keeps from a plane; 0 with PULL_BACK */
    double mass;      /* kg */
    uint32_t id, groups, mask; /* mask 0: meets nobody */
    uint32_t escaped;          /* 1: its first step went farther than reach, */
    double extra;              /* m, and then how much farther a second one may go */
} tahr__figure;

/* The figure of a character with this config and state, which have been checked, in a tick of dt seconds. */
void tahr__figure_of(tahr__figure *figure, const tahr_mover *mover, const tahr_member *member, const tahr_input *input,
                     const tahr_state *state, double dt);

/* May the two meet in this tick? Boxes only. */
static inline int figures_near(const tahr__figure *a, const tahr__figure *b, double extra)
{
    double x = a->at.x - b->at.x, y = a->at.y - b->at.y, z = a->at.z - b->at.z;
    return (x < 0 ? -x : x) <= a->box.x + b->box.x + extra && (y < 0 ? -y : y) <= a->box.y + b->box.y + extra &&
           (z < 0 ? -z : z) <= a->box.z + b->box.z + extra;
}

static inline int figures_meet(const tahr__figure *a, const tahr__figure *b)
{
    return (a->groups & b->mask) && (b->groups & a->mask);
}

/* The plane that keeps `self` from `other`. again: self takes its step a second time, with a larger reach. Returns 0 if
 * they are too far apart to meet. */
int tahr__figure_plane(const tahr__figure *self, const tahr__figure *other, int again, int flat,
                       tahr__neighbour *plane);

#endif

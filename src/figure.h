/* SPDX-License-Identifier: MIT
 * figure.h: a character as the others of its crowd see it in a tick, and the plane between two of them. */
#ifndef TAHR_FIGURE_H
#define TAHR_FIGURE_H

#include "core.h"
#include "neighbours.h"

enum {
    TAHR__FIGURE_THERE = 1 << 0,   /* others meet it */
    TAHR__FIGURE_BESIDE = 1 << 1,  /* and somebody is near: its look is known */
    TAHR__FIGURE_STRAYED = 1 << 2, /* its first step would have gone farther than foreseen */
    TAHR__FIGURE_NOTED = 1 << 3,   /* it is that of the state that its mover has noted (sleep.h) */
    TAHR__FIGURE_STILL = 1 << 4    /* and that is still its state: figure and step are those of the last tick */
};

/* What it takes to see that nobody is near, which is most of the time. */
typedef struct tahr__figure {
    vec3 box; /* m, half extents around range.at of what it can touch in this tick, along the world's axes */
    tahr__range range;
    double swell; /* m, that its shape may become larger by within the tick, whichever way */
    uint32_t id, groups, mask;
    uint32_t flags; /* TAHR__FIGURE_* */
} tahr__figure;

/* And what decides where the plane lies between it and another one. */
typedef struct tahr__look {
    vec3 up;
    tahr_quat orientation;
    tahr_shape shape;
    vec3 way;         /* m, that it would go in this tick with its velocity */
    double half_skin; /* m that it keeps from a plane; 0 with PULL_BACK */
    double mass;      /* kg */
} tahr__look;

/* One of a pair. */
typedef struct tahr__party {
    const tahr__figure *figure;
    const tahr__look *look;
} tahr__party;

/* Of a character with this config and state in a tick of dt seconds; id, groups and mask are set. Nobody sees one whose
 * state is not valid. */
void tahr__figure_of(tahr__figure *figure, const tahr_mover *mover, const tahr_input *input, const tahr_state *state,
                     double dt);
void tahr__look_of(tahr__look *look, const tahr_mover *mover, const tahr_state *state, double dt);

/* May the two meet in this tick? Boxes only. extra: m that they may go farther. */
static inline int figures_near(const tahr__figure *a, const tahr__figure *b, double extra)
{
    double x = a->range.at.x - b->range.at.x, y = a->range.at.y - b->range.at.y, z = a->range.at.z - b->range.at.z;
    return (x < 0 ? -x : x) <= a->box.x + b->box.x + extra && (y < 0 ? -y : y) <= a->box.y + b->box.y + extra &&
           (z < 0 ? -z : z) <= a->box.z + b->box.z + extra;
}

static inline int figures_meet(const tahr__figure *a, const tahr__figure *b)
{
    return (a->groups & b->mask) && (b->groups & a->mask);
}

/* FLAT: in a world of two dimensions. LEVEL_HEADS: where one is over the other a level plane, if there is one: then
 * neither is in the other's way. AGAIN: self takes its step a second time, and may go farther. */
enum { TAHR__PAIR_FLAT = 1 << 0, TAHR__PAIR_LEVEL_HEADS = 1 << 1, TAHR__PAIR_AGAIN = 1 << 2 };

/* The plane that keeps `self` from `other`. Returns 0 if they are too far apart to meet. */
int tahr__figure_plane(tahr__party self, tahr__party other, uint32_t rules, tahr__neighbour *plane);

/* The plane that keeps one who takes its step again from all that the other one, who does not know, can reach. */
void tahr__figure_wall(tahr__party self, const tahr__figure *other, uint32_t rules, tahr__neighbour *plane);

/* m, from the character to a plane. */
double tahr__figure_away(const tahr__look *look, const tahr__neighbour *plane);

#endif

/* SPDX-License-Identifier: MIT
 * neighbours.h: the other characters around one of a crowd, as obstacles of its step: a half-space for each. */
#ifndef TAHR_NEIGHBOURS_H
#define TAHR_NEIGHBOURS_H

#include "core.h"

/* Everything with normal . (x - anchor) < offset + behind is the other's. The surface from which the character keeps
 * its skin lies `behind` that plane. */
typedef struct tahr__neighbour {
    vec3 normal;   /* unit, from the other to this one */
    double offset; /* m, of the surface */
    double behind; /* m, 0 or more */
    double give;   /* m by which it steps aside before its step, if there is room: they were squeezed together */
    uint32_t body; /* TAHR_CHARACTER_BODY + the other's id */
    uint32_t reserved;
} tahr__neighbour;

/* Sorted by body. Fixed during a step. */
typedef struct tahr__neighbours {
    vec3 anchor; /* where the character is, once what it stands on has carried it */
    uint32_t count;
    uint32_t walkable_rule; /* TAHR_WALKABLE_* of heads */
    tahr__neighbour *planes;
} tahr__neighbours;

/* How far a step was foreseen to go. */
typedef struct tahr__range {
    vec3 at;        /* where the character is, once what it stands on has carried it */
    vec3 reach;     /* m from there, along the world's axes */
    double extra;   /* m on top of it, for who takes its step again */
    uint32_t bound; /* 0: nobody minds how far it goes */
    uint32_t reserved;
} tahr__range;

/* What a crowd tells the step of one of its characters. */
typedef struct tahr__company {
    const tahr__neighbours *neighbours; /* or NULL */
    const tahr__range *range;
    double strayed; /* [out] m from range->at, if the step returned TAHR__STRAYED */
} tahr__company;

/* What a step returns that would have gone farther than foreseen: nothing was written. */
enum { TAHR__STRAYED = 1000 };

static inline int company_strays(tahr__company *company, vec3 position)
{
    const tahr__range *r = company->range;
    const double x = fabs(position.x - r->at.x), y = fabs(position.y - r->at.y), z = fabs(position.z - r->at.z);
    if (!r->bound || (x <= r->reach.x + r->extra && y <= r->reach.y + r->extra && z <= r->reach.z + r->extra)) {
        return 0;
    }
    company->strayed = max_of(x, max_of(y, z));
    return 1;
}

/* From here on the step's neighbours are there: it has been carried. Pushes it out of those that it overlaps. */
void tahr__meet_neighbours(tahr__step *step);

/* Corrects the answer of the world to a sweep by what the neighbours stop. */
void tahr__neighbours_sweep(const tahr__neighbours *neighbours, const tahr_sweep *query, tahr_hit *hit,
                            uint32_t *count);

/* Adds the neighbours to a list of contacts, which stays sorted; the last ones go if there is no room. Returns the new
 * count. */
uint32_t tahr__neighbours_contacts(const tahr__neighbours *neighbours, const tahr_contact_query *query,
                                   tahr_contact *contacts, uint32_t capacity, uint32_t count);

#endif

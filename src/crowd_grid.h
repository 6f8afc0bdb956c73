/* SPDX-License-Identifier: MIT
 * crowd_grid.h: who is near whom: a hashed grid over the two axes along which a crowd is spread the most. */
#ifndef TAHR_CROWD_GRID_H
#define TAHR_CROWD_GRID_H

#include "figure.h"

/* Sizes of figures by powers of two, from 2^-20 m. */
enum { TAHR__SIZES = 48 };

/* What a part of the figures adds up to. No order changes it. */
typedef struct tahr__spread {
    vec3 min, max;
    int axis[2]; /* along which sizes are taken */
    double largest[TAHR__SIZES]; /* m, half width of a box, of those of a size */
    uint32_t count[TAHR__SIZES];
} tahr__spread;

typedef struct tahr__grid {
    const tahr__figure *figures;
    uint32_t count;
    double cell; /* m */
    double wide; /* m: whose box is larger is in no cell */
    int axis[2];         /* of the last tick, until grid_begin */
    uint32_t mask;       /* of a hash */
    uint32_t wide_count; /* those, first in order */
    uint32_t *bucket;    /* of each figure */
    uint32_t *start;     /* of each bucket in order; mask + 4 of them */
    uint32_t *order;
} tahr__grid;

void tahr__spread_begin(tahr__spread *spread, const int axis[2]);
void tahr__spread_add(tahr__spread *spread, const tahr__figure *figure);
void tahr__spread_merge(tahr__spread *into, const tahr__spread *other);

/* Decides on cells. figures, count, mask and the arrays are set. */
void tahr__grid_begin(tahr__grid *grid, const tahr__spread *spread);
/* Says where one figure belongs; different ones on different threads. */
void tahr__grid_place(tahr__grid *grid, uint32_t figure);
/* All are placed: sorts them. */
void tahr__grid_sort(tahr__grid *grid);

/* Calls nobody twice. Returns the number of runs in order that hold whoever may be near a figure: at most 5, in arrays of 6. */
int tahr__grid_around(const tahr__grid *grid, uint32_t figure, uint32_t begin[6], uint32_t end[6]);

#endif

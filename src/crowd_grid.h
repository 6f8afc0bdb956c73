/* SPDX-License-Identifier: MIT
 * crowd_grid.h: who is near whom: a hashed grid over the two axes along which a crowd is spread the most. */
#ifndef TAHR_CROWD_GRID_H
#define TAHR_CROWD_GRID_H

#include "figure.h"

/* Sizes of figures by powers of two: below 2^-6 m, and from there up to 2^8 m and more. */
enum { TAHR__SIZES = 16 };

/* What a part of the figures adds up to. No order changes it. */
typedef struct tahr__spread {
    vec3 min, max;
    int axis[2];                 /* along which sizes are taken */
    double largest[TAHR__SIZES]; /* m, half width of a box, of those of a size */
    uint32_t count[TAHR__SIZES];
} tahr__spread;

typedef struct tahr__cells {
    double per_cell; /* 1/m */
    double wide;     /* m: whose box is larger is in no cell */
    int axis[2];     /* of the last tick, until grid_begin */
} tahr__cells;

typedef struct tahr__grid {
    const tahr__figure *figures;
    uint32_t count; /* of the last tick, until grid_begin */
    tahr__cells cells;
    uint32_t mask;       /* of a hash */
    uint32_t wide_count; /* those, first in order */
    uint32_t *bucket;    /* of each figure, */
    uint64_t *corner;    /* and of the first of the four cells around it, unscrambled */
    uint32_t *start;     /* of each bucket in order; mask + 4 of them */
    uint32_t *order;
} tahr__grid;

void tahr__spread_begin(tahr__spread *spread, const int axis[2]);
void tahr__spread_add(tahr__spread *spread, const tahr__figure *figure);
void tahr__spread_merge(tahr__spread *into, const tahr__spread *other);

/* Decides on cells. figures, count, mask and the arrays are set. */
void tahr__grid_begin(tahr__grid *grid, const tahr__spread *spread);
/* Says where some figures belong; different ones on different threads. kept: flags of those for which that is known. */
void tahr__grid_place(tahr__grid *grid, uint32_t begin, uint32_t end, uint32_t kept);
/* All are placed: sorts them. */
void tahr__grid_sort(tahr__grid *grid);

/* A cell's numbers are mixed as sums of odd multiples: the cells beside it are an addition away. */
#define TAHR__ALONG 0x9E3779B97F4A7C15u
#define TAHR__ACROSS 0xC2B2AE3D27D4EB4Fu

static inline uint32_t grid_bucket(const tahr__grid *g, uint64_t mixed)
{
    return 1 + ((uint32_t)(mixed >> 32) & g->mask);
}

static inline int grid_add_run(const tahr__grid *g, uint32_t bucket, uint32_t *begin, uint32_t *end, int runs)
{
    if (g->start[bucket] < g->start[bucket + 1]) {
        begin[runs] = g->start[bucket];
        end[runs] = g->start[bucket + 1];
        return runs + 1;
    }
    return runs;
}

/* The runs in order that hold whoever may be near a figure, nobody twice. Returns their number, at most 5. */
static inline int grid_around(const tahr__grid *g, uint32_t figure, uint32_t begin[5], uint32_t end[5])
{
    if (g->bucket[figure] == 0 || g->figures[figure].flags & TAHR__FIGURE_STRAYED) { /* everybody */
        begin[0] = 0;
        end[0] = g->start[g->mask + 2];
        return 1;
    }
    const uint64_t h = g->corner[figure];
    const uint32_t a = grid_bucket(g, h), b = grid_bucket(g, h + TAHR__ALONG), c = grid_bucket(g, h + TAHR__ACROSS);
    const uint32_t d = grid_bucket(g, h + TAHR__ALONG + TAHR__ACROSS);
    int runs = g->wide_count > 0 ? grid_add_run(g, 0, begin, end, 0) : 0;
    runs = grid_add_run(g, a, begin, end, runs);
    runs = b != a ? grid_add_run(g, b, begin, end, runs) : runs;
    runs = c != a && c != b ? grid_add_run(g, c, begin, end, runs) : runs;
    return d != a && d != b && d != c ? grid_add_run(g, d, begin, end, runs) : runs;
}

#endif

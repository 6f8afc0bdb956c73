/* SPDX-License-Identifier: MIT
 * wide.h: a tree of eight children a node over boxes that stay where they are: about eleven bytes an item, and one look
 * at a node decides about all eight.
 *
 * All bounds are whole numbers on a lattice of 2^24 places along the longest side of all that is in the tree. A node is
 * one line of memory: where its box begins, a power of two per axis, and the bounds of its children as steps of that
 * size, 0 to 255, rounded outward. Children are nodes, or items; the children of a node follow each other, and so do
 * its items.
 *
 * A walk finds every item whose box is within reach (proof): tahr__bvh_box_make and the way onto the lattice never
 * decrease and round outward, and so do the steps of a node; so a gap on the lattice is never larger than the true one,
 * and where there is none there stays none. A query is told from a farther one up to 2^30 places off, 64 times the size
 * of the tree: beyond that it only comes nearer, and a reach of half of it finds all. The gap is computed in floats.
 * Whole numbers below 2^24 are exact in them, and a query's bound farther away is rounded by 2^-24 of it; the limit is
 * larger by 1e-6, more than rounding the difference, three squares and two sums may take off. What only asks which
 * boxes meet takes the query's box as much larger as the reach, on the lattice, and compares whole numbers. */
#ifndef TAHR_COMMON_WIDE_H
#define TAHR_COMMON_WIDE_H

#include "bvh.h"

enum { TAHR__WIDE = 8 };

typedef struct tahr__wide_node {
    /* Per axis: the low 24 bits: where the box begins; the next five: the logarithm of a step; the last three: of axis
     * 0 how many children, less one, of axis 1 whether they are items. */
    uint32_t base[3];
    uint32_t first; /* child, or item */
    uint8_t lo[3][TAHR__WIDE], hi[3][TAHR__WIDE];
} tahr__wide_node;

/* A box on the lattice, and how near (squared) counts. */
typedef struct tahr__wide_box {
    int32_t lo[4], hi[4]; /* the last of each is room for vectors */
    float limit;
} tahr__wide_box;

/* One bit per child within reach. [out] away: squared distances of all children to the point; NULL: nobody asks. */
typedef uint32_t tahr__wide_fn(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t point[4],
                               float away[TAHR__WIDE]);
/* One child at a time; four; eight, where the processor has AVX2. All the same bits. */
tahr__wide_fn tahr__wide_test_1, tahr__wide_test_4, tahr__wide_test_8;
/* The fastest that this machine can run. */
tahr__wide_fn *tahr__wide_best(void);

struct tahr__wide;
/* Items that a box meets (its limit is nothing), at most capacity and seven more. Returns how many; more than capacity:
 * there may be others. */
typedef uint32_t tahr__wide_items_fn(const struct tahr__wide *tree, const tahr__wide_box *box, uint32_t *items,
                                     uint32_t capacity);
/* One child at a time; eight, where the processor has AVX2; 512: eight by AVX-512. All the same items in the same
 * order. */
tahr__wide_items_fn tahr__wide_items_1, tahr__wide_items_8, tahr__wide_items_512;
/* The fastest that this machine can run. */
tahr__wide_items_fn *tahr__wide_items_best(void);

typedef struct tahr__wide {
    tahr__wide_node *nodes;
    uint32_t node_count, node_capacity;
    tahr__wide_fn *test;
    tahr__wide_items_fn *items;
    tahr_vec3 centre; /* boxes are relative to it */
    double low[3];    /* where the lattice begins, relative to the centre */
    double scale;     /* 1 / step, a power of two */
} tahr__wide;

/* Builds over count (>= 1) boxes as tahr__bvh_build does. [out] order: the items in the order of the tree. TAHR_OK or
 * TAHR_E_MEMORY. */
tahr_status tahr__wide_build(const tahr_host *host, tahr__bvh_box *boxes, uint32_t *order, uint32_t count,
                             tahr_vec3 centre, tahr__wide *tree);
void tahr__wide_free(const tahr_host *host, tahr__wide *tree);

/* Items that come within reach of a box along each axis, in no order that means anything: at most capacity and seven
 * more, for which there must be room. Returns how many; more than capacity: there may be others. */
uint32_t tahr__wide_collect(const tahr__wide *tree, const tahr_bounds *box, double reach, uint32_t *items,
                            uint32_t capacity);

/* Every level of the tree leaves at most seven others to look at; 80 levels: see TAHR__BVH_STACK. So many as are SORTED
 * a walk keeps in the order of their distances; if there are more it goes down to the bottom of each at once. */
enum { TAHR__WIDE_STACK = 7 * 80 + TAHR__WIDE, TAHR__WIDE_SORTED = 192 };

/* Walks all items within reach of a box, of all nodes and items that are known the nearest to a point first, or in no
 * order that means anything. */
typedef struct tahr__wide_walk {
    const tahr__wide *tree;
    tahr__wide_box box;
    int32_t near[4]; /* as well */
    float places;    /* the reach on the lattice, rounded up */
    float farthest;  /* squared: nothing beyond this distance from the point is within reach */
    uint32_t ordered, narrowed, top;
    /* The squared distance to the point, whose bits are ordered as it is, and the child: node * 8 + child. The nearest
     * last, of the first TAHR__WIDE_SORTED. */
    uint64_t entries[TAHR__WIDE_SORTED + TAHR__WIDE_STACK];
} tahr__wide_walk;

/* near: NULL: in any order. */
void tahr__wide_walk_begin(tahr__wide_walk *walk, const tahr__wide *tree, const tahr_bounds *box, double reach,
                           const tahr_vec3 *near);
/* Narrows the box of a walk under way (a hit was found). */
void tahr__wide_walk_narrow(tahr__wide_walk *walk, const tahr_bounds *box);
/* 1 and the next item, or 0 at the end. */
int tahr__wide_walk_next(tahr__wide_walk *walk, uint32_t *item);

#endif

/* SPDX-License-Identifier: MIT
 * bvh.h: a bounding volume hierarchy over boxes: built once by a binned surface area heuristic, walked without
 * recursion. Node bounds are floats relative to a centre, rounded outward, so a walk can only find too much. */
#ifndef TAHR_COMMON_BVH_H
#define TAHR_COMMON_BVH_H

#include "vec.h"

#include <tahr/backend.h>

/* Depth is at most 64 by construction (48 chosen levels, then halving), a walk keeps one node per level beside its
 * path. */
enum { TAHR__BVH_STACK = 96, TAHR__BVH_LEAF = 4 };

typedef struct tahr__bvh_node {
    float lo[3], hi[3];
    uint32_t first; /* leaf: first item of `order`; inner: left child, the right one follows it */
    uint32_t count; /* items of a leaf, 0 for inner nodes */
} tahr__bvh_node;

typedef struct tahr__bvh {
    tahr__bvh_node *nodes;
    uint32_t node_count;
    uint32_t node_capacity; /* what was allocated */
    tahr_vec3 centre;
    uint32_t leaf; /* most items of a leaf */
    uint32_t reserved;
} tahr__bvh;

/* Bounds of one item, relative to the centre and rounded outward. */
typedef struct tahr__bvh_box {
    float lo[3], hi[3];
} tahr__bvh_box;

tahr__bvh_box tahr__bvh_box_make(const tahr_bounds *bounds, tahr_vec3 centre);

/* Builds over count (>= 1) boxes. bvh: zeroed but for leaf, 0: TAHR__BVH_LEAF. [out] order (count entries): the items
 * in leaf order. boxes is scratch of the caller and is reordered with it. TAHR_OK or TAHR_E_MEMORY. */
tahr_status tahr__bvh_build(const tahr_host *host, tahr__bvh_box *boxes, uint32_t *order, uint32_t count,
                            tahr_vec3 centre, tahr__bvh *bvh);
void tahr__bvh_free(const tahr_host *host, tahr__bvh *bvh);

/* New node bounds for the same tree; boxes[i] belongs to the item at leaf position i. */
void tahr__bvh_refit(tahr__bvh *bvh, const tahr__bvh_box *boxes);

/* Walks all leaves within reach of a box, those nearest to a point first. */
typedef struct tahr__bvh_walk {
    const tahr__bvh *bvh;
    float lo[3], hi[3]; /* the box, relative to the tree's centre */
    float near[3];
    float limit; /* squared reach, rounded up */
    uint32_t top;
    uint32_t narrowed; /* nodes on the stack may have come out of reach since they were put there */
    uint32_t stack[TAHR__BVH_STACK];
} tahr__bvh_walk;

void tahr__bvh_walk_begin(tahr__bvh_walk *walk, const tahr__bvh *bvh, const tahr_bounds *box, double reach,
                          tahr_vec3 near);
/* Narrows the box of a walk under way (a hit was found). */
void tahr__bvh_walk_narrow(tahr__bvh_walk *walk, const tahr_bounds *box);
/* 1 and the leaf's items [first, first + count), or 0 at the end. */
int tahr__bvh_walk_next(tahr__bvh_walk *walk, uint32_t *first, uint32_t *count);

#endif

/* SPDX-License-Identifier: MIT
 * body_tree.h: a tree over the bounds of bodies: built at open, made to fit again where a body moves. */
#ifndef TAHR_COMMON_BODY_TREE_H
#define TAHR_COMMON_BODY_TREE_H

#include "bvh.h"

typedef struct tahr__body_tree {
    tahr__bvh bvh;
    tahr__bvh_box *boxes; /* in leaf order */
    uint32_t *order;      /* the body at a place in leaf order */
    uint32_t *place;      /* the other way round */
    uint32_t count;       /* 0: no tree */
    uint32_t reserved;
} tahr__body_tree;

/* Builds over the bounds of count bodies (0 allowed). TAHR_OK or TAHR_E_MEMORY. */
tahr_status tahr__body_tree_open(const tahr_host *host, const tahr_bounds *bounds, uint32_t count,
                                 tahr__body_tree *tree);
void tahr__body_tree_close(const tahr_host *host, tahr__body_tree *tree);

/* The new bounds of a body; the tree fits again after tahr__body_tree_refit. */
void tahr__body_tree_set(tahr__body_tree *tree, uint32_t body, const tahr_bounds *bounds);
void tahr__body_tree_refit(tahr__body_tree *tree);

/* The bodies whose bounds may meet a box: those near its start first. Bounds are rounded outward to floats, so that
 * some come that do not. */
typedef struct tahr__body_walk {
    const tahr__body_tree *tree;
    tahr__bvh_walk walk;
    uint32_t first, count;
} tahr__body_walk;

void tahr__body_walk_begin(tahr__body_walk *walk, const tahr__body_tree *tree, const tahr_bounds *box, tahr_vec3 start);
/* 1 and the body, or 0 at the end. */
int tahr__body_walk_next(tahr__body_walk *walk, uint32_t *body);

#endif

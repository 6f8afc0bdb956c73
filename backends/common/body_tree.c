/* SPDX-License-Identifier: MIT
 * body_tree.c: see body_tree.h. */
#include "body_tree.h"

#include "room.h"

tahr_status tahr__body_tree_open(const tahr_host *host, const tahr_bounds *bounds, uint32_t count,
                                 tahr__body_tree *tree)
{
    memset(tree, 0, sizeof *tree);
    if (count == 0) return TAHR_OK;
    tahr_vec3 low = bounds[0].min, high = bounds[0].max;
    for (uint32_t i = 1; i < count; i++) {
        low = v_min(low, bounds[i].min);
        high = v_max(high, bounds[i].max);
    }
    tahr_vec3 centre = v_scale(v_add(low, high), 0.5);
    tree->count = count;
    tree->boxes = tahr__room_get(host, count, sizeof *tree->boxes);
    tree->order = tahr__room_get(host, count, sizeof *tree->order);
    tree->place = tahr__room_get(host, count, sizeof *tree->place);
    tahr_status status = tree->boxes && tree->order && tree->place ? TAHR_OK : TAHR_E_MEMORY;
    for (uint32_t i = 0; i < count && status == TAHR_OK; i++)
        tree->boxes[i] = tahr__bvh_box_make(&bounds[i], centre);
    if (status == TAHR_OK) status = tahr__bvh_build(host, tree->boxes, tree->order, count, centre, &tree->bvh);
    if (status < 0) {
        tahr__body_tree_close(host, tree);
        return status;
    }
    for (uint32_t i = 0; i < count; i++)
        tree->place[tree->order[i]] = i;
    return TAHR_OK;
}

void tahr__body_tree_close(const tahr_host *host, tahr__body_tree *tree)
{
    tahr__room_put(host, tree->boxes, tree->count, sizeof *tree->boxes);
    tahr__room_put(host, tree->order, tree->count, sizeof *tree->order);
    tahr__room_put(host, tree->place, tree->count, sizeof *tree->place);
    tahr__bvh_free(host, &tree->bvh);
    memset(tree, 0, sizeof *tree);
}

void tahr__body_tree_set(tahr__body_tree *tree, uint32_t body, const tahr_bounds *bounds)
{
    tree->boxes[tree->place[body]] = tahr__bvh_box_make(bounds, tree->bvh.centre);
}

void tahr__body_tree_refit(tahr__body_tree *tree)
{
    if (tree->count > 0) tahr__bvh_refit(&tree->bvh, tree->boxes);
}

void tahr__body_walk_begin(tahr__body_walk *walk, const tahr__body_tree *tree, const tahr_bounds *box, tahr_vec3 start)
{
    walk->tree = tree;
    walk->first = walk->count = 0;
    if (tree->count > 0)
        tahr__bvh_walk_begin(&walk->walk, &tree->bvh, box, 0, start);
    else
        walk->walk.top = 0;
}

static int overlap(const tahr__bvh_box *a, const tahr__bvh_walk *b)
{
    for (int i = 0; i < 3; i++) {
        if (a->lo[i] > b->hi[i] || b->lo[i] > a->hi[i]) return 0;
    }
    return 1;
}

int tahr__body_walk_next(tahr__body_walk *walk, uint32_t *body)
{
    const tahr__body_tree *tree = walk->tree;
    while (walk->count > 0 || tahr__bvh_walk_next(&walk->walk, &walk->first, &walk->count)) {
        uint32_t at = walk->first++;
        walk->count--;
        if (!overlap(&tree->boxes[at], &walk->walk)) continue;
        *body = tree->order[at];
        return 1;
    }
    return 0;
}

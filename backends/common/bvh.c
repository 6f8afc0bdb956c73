/* SPDX-License-Identifier: MIT
 * bvh.c: building by a binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume
 * hierarchies") and walking near-first. */
#include "bvh.h"

#include <string.h>

enum { BINS = 12, SAH_LEVELS = 48 };

/* Of a range: there is no node for it, a leaf holds it. */
#define IN_LEAF 0xFFFFFFFFu

typedef struct builder {
    tahr__bvh_box *boxes;
    uint32_t *order;
    tahr__bvh *bvh;
} builder;

typedef struct range {
    uint32_t node, first, count, level;
} range;

typedef struct bin {
    tahr__bvh_box box;
    uint32_t count;
} bin;

tahr__bvh_box tahr__bvh_box_make(const tahr_bounds *bounds, tahr_vec3 centre)
{
    tahr__bvh_box box;
    for (int i = 0; i < 3; i++) {
        box.lo[i] = d_down(v_get(bounds->min, i) - v_get(centre, i));
        box.hi[i] = d_up(v_get(bounds->max, i) - v_get(centre, i));
    }
    return box;
}

static tahr__bvh_box box_empty(void)
{
    tahr__bvh_box box;
    for (int i = 0; i < 3; i++) {
        box.lo[i] = 3e38f;
        box.hi[i] = -3e38f;
    }
    return box;
}

static void box_grow(tahr__bvh_box *box, const tahr__bvh_box *other)
{
    for (int i = 0; i < 3; i++) {
        box->lo[i] = other->lo[i] < box->lo[i] ? other->lo[i] : box->lo[i];
        box->hi[i] = other->hi[i] > box->hi[i] ? other->hi[i] : box->hi[i];
    }
}

static float box_area(const tahr__bvh_box *box)
{
    float x = box->hi[0] - box->lo[0], y = box->hi[1] - box->lo[1], z = box->hi[2] - box->lo[2];
    return x * y + y * z + z * x;
}

static float box_middle(const tahr__bvh_box *box, int axis)
{
    return box->lo[axis] * 0.5f + box->hi[axis] * 0.5f;
}

static void swap_items(builder *b, uint32_t i, uint32_t j)
{
    tahr__bvh_box box = b->boxes[i];
    uint32_t item = b->order[i];
    b->boxes[i] = b->boxes[j];
    b->order[i] = b->order[j];
    b->boxes[j] = box;
    b->order[j] = item;
}

static int bin_of(float middle, float low, float scale)
{
    int k = (int)((middle - low) * scale);
    return k < 0 ? 0 : k >= BINS ? BINS - 1 : k;
}

/* Cheapest plane between two bins; returns the cost, *split = last bin of the left side. */
static float best_split(const bin *bins, int *split)
{
    float right_cost[BINS], best = 3e38f;
    tahr__bvh_box box = box_empty();
    uint32_t count = 0;
    for (int k = BINS - 1; k > 0; k--) {
        box_grow(&box, &bins[k].box);
        count += bins[k].count;
        right_cost[k] = count ? box_area(&box) * (float)count : 3e38f;
    }
    box = box_empty();
    count = 0;
    for (int k = 0; k < BINS - 1; k++) {
        box_grow(&box, &bins[k].box);
        count += bins[k].count;
        float cost = count ? box_area(&box) * (float)count + right_cost[k + 1] : 3e38f;
        if (cost < best) {
            best = cost;
            *split = k;
        }
    }
    return best;
}

/* Partitions by the cheapest of three axes; returns the size of the left side, 0 if nothing was separated. */
static uint32_t partition_sah(builder *b, const range *r, const tahr__bvh_box *middles)
{
    float best = 3e38f, best_low = 0, best_scale = 0;
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; axis++) {
        float low = middles->lo[axis], width = middles->hi[axis] - low;
        if (!(width > 0)) continue;
        float scale = (float)BINS / width;
        if (!(scale < 3e38f)) continue;
        bin bins[BINS];
        for (int k = 0; k < BINS; k++) {
            bins[k].box = box_empty();
            bins[k].count = 0;
        }
        for (uint32_t i = r->first; i < r->first + r->count; i++) {
            bin *into = &bins[bin_of(box_middle(&b->boxes[i], axis), low, scale)];
            box_grow(&into->box, &b->boxes[i]);
            into->count++;
        }
        int split = 0;
        float cost = best_split(bins, &split);
        if (cost < best) {
            best = cost;
            best_axis = axis;
            best_bin = split;
            best_low = low;
            best_scale = scale;
        }
    }
    if (best_axis < 0) return 0;
    uint32_t i = r->first, j = r->first + r->count;
    while (i < j) {
        if (bin_of(box_middle(&b->boxes[i], best_axis), best_low, best_scale) <= best_bin)
            i++;
        else
            swap_items(b, i, --j);
    }
    return i - r->first;
}

/* Halves by the order the items are in: whatever the heuristic cannot separate (equal middles) or should not any
 * deeper. */
static uint32_t partition(builder *b, const range *r, const tahr__bvh_box *middles)
{
    uint32_t left = r->level < SAH_LEVELS ? partition_sah(b, r, middles) : 0;
    return left == 0 || left == r->count ? r->count / 2 : left;
}

static void put_box(tahr__bvh_node *node, const tahr__bvh_box *box)
{
    memcpy(node->lo, box->lo, sizeof node->lo);
    memcpy(node->hi, box->hi, sizeof node->hi);
}

/* Splits down to TAHR__BVH_LEAF whatever the leaves hold: the order of the items, and what goes by it, is one for all
 * trees. */
static void build_ranges(builder *b, uint32_t count)
{
    range stack[TAHR__BVH_STACK];
    uint32_t top = 0;
    stack[top++] = (range){0, 0, count, 0};
    b->bvh->node_count = 1;
    while (top > 0) {
        range r = stack[--top];
        tahr__bvh_box box = box_empty(), middles = box_empty();
        for (uint32_t i = r.first; i < r.first + r.count; i++) {
            tahr__bvh_box middle;
            for (int k = 0; k < 3; k++)
                middle.lo[k] = middle.hi[k] = box_middle(&b->boxes[i], k);
            box_grow(&box, &b->boxes[i]);
            box_grow(&middles, &middle);
        }
        uint32_t child[2] = {IN_LEAF, IN_LEAF};
        if (r.node != IN_LEAF) {
            tahr__bvh_node *node = &b->bvh->nodes[r.node];
            put_box(node, &box);
            node->first = r.first;
            node->count = r.count;
            if (r.count > b->bvh->leaf) {
                child[0] = node->first = b->bvh->node_count;
                child[1] = child[0] + 1;
                node->count = 0;
                b->bvh->node_count += 2;
            }
        }
        if (r.count <= TAHR__BVH_LEAF) continue;
        uint32_t left = partition(b, &r, &middles);
        stack[top++] = (range){child[1], r.first + left, r.count - left, r.level + 1};
        stack[top++] = (range){child[0], r.first, left, r.level + 1};
    }
}

tahr_status tahr__bvh_build(const tahr_host *host, tahr__bvh_box *boxes, uint32_t *order, uint32_t count,
                            tahr_vec3 centre, tahr__bvh *bvh)
{
    /* Every leaf holds at least one item. A second, exact allocation gives back what fuller leaves save. */
    const tahr_allocator *a = &host->allocator;
    uint32_t capacity = 2 * count - 1;
    builder b = {boxes, order, bvh};
    bvh->centre = centre;
    if (bvh->leaf == 0) bvh->leaf = TAHR__BVH_LEAF;
    bvh->node_capacity = capacity;
    bvh->nodes = a->alloc(a->user, capacity * sizeof *bvh->nodes, 64);
    if (!bvh->nodes) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        order[i] = i;
    build_ranges(&b, count);
    tahr__bvh_node *exact = a->alloc(a->user, bvh->node_count * sizeof *exact, 64);
    if (exact) {
        memcpy(exact, bvh->nodes, bvh->node_count * sizeof *exact);
        tahr__bvh_free(host, bvh);
        bvh->nodes = exact;
        bvh->node_capacity = bvh->node_count;
    }
    return TAHR_OK;
}

void tahr__bvh_free(const tahr_host *host, tahr__bvh *bvh)
{
    if (bvh->nodes) host->allocator.free(host->allocator.user, bvh->nodes, bvh->node_capacity * sizeof *bvh->nodes, 64);
    bvh->nodes = NULL;
}

void tahr__bvh_refit(tahr__bvh *bvh, const tahr__bvh_box *boxes)
{
    /* Children come after their parent, so from the back every child is ready. */
    for (uint32_t i = bvh->node_count; i-- > 0;) {
        tahr__bvh_node *node = &bvh->nodes[i];
        tahr__bvh_box box = box_empty();
        for (uint32_t k = 0; k < node->count; k++)
            box_grow(&box, &boxes[node->first + k]);
        for (uint32_t k = 0; node->count == 0 && k < 2; k++) {
            tahr__bvh_box child;
            memcpy(child.lo, bvh->nodes[node->first + k].lo, sizeof child.lo);
            memcpy(child.hi, bvh->nodes[node->first + k].hi, sizeof child.hi);
            box_grow(&box, &child);
        }
        put_box(node, &box);
    }
}

/* Squared distance of a node to a box. No branches: which side is nearer is anybody's guess. */
static float square_distance(const tahr__bvh_node *n, const float lo[3], const float hi[3])
{
    float square[3];
    for (int i = 0; i < 3; i++) {
        float under = n->lo[i] - hi[i], over = lo[i] - n->hi[i];
        float gap = under > over ? under : over;
        gap = gap > 0 ? gap : 0;
        square[i] = gap * gap;
    }
    return (square[0] + square[1]) + square[2];
}

static int within(const tahr__bvh_walk *w, const tahr__bvh_node *n)
{
    return square_distance(n, w->lo, w->hi) <= w->limit;
}

void tahr__bvh_walk_narrow(tahr__bvh_walk *walk, const tahr_bounds *box)
{
    tahr__bvh_box b = tahr__bvh_box_make(box, walk->bvh->centre);
    memcpy(walk->lo, b.lo, sizeof walk->lo);
    memcpy(walk->hi, b.hi, sizeof walk->hi);
    walk->narrowed = 1;
}

void tahr__bvh_walk_begin(tahr__bvh_walk *walk, const tahr__bvh *bvh, const tahr_bounds *box, double reach,
                          tahr_vec3 near)
{
    walk->bvh = bvh;
    tahr__bvh_walk_narrow(walk, box);
    for (int i = 0; i < 3; i++)
        walk->near[i] = (float)(v_get(near, i) - v_get(bvh->centre, i));
    walk->limit = d_up(reach * reach * (1 + 1e-6));
    walk->stack[0] = 0;
    walk->top = within(walk, &bvh->nodes[0]) ? 1 : 0;
    walk->narrowed = 0;
}

int tahr__bvh_walk_next(tahr__bvh_walk *walk, uint32_t *first, uint32_t *count)
{
    while (walk->top > 0) {
        const tahr__bvh_node *node = &walk->bvh->nodes[walk->stack[--walk->top]];
        if (walk->narrowed && !within(walk, node)) continue;
        if (node->count > 0) {
            *first = node->first;
            *count = node->count;
            return 1;
        }
        const tahr__bvh_node *left = &walk->bvh->nodes[node->first], *right = left + 1;
        int go_left = within(walk, left), go_right = within(walk, right);
        uint32_t first_right = 0;
        if (go_left && go_right) {
            first_right =
                !(square_distance(left, walk->near, walk->near) <= square_distance(right, walk->near, walk->near));
        }
        if (go_left && first_right) walk->stack[walk->top++] = node->first;
        if (go_right) walk->stack[walk->top++] = node->first + 1;
        if (go_left && !first_right) walk->stack[walk->top++] = node->first;
    }
    return 0;
}

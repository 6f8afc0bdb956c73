/* SPDX-License-Identifier: MIT
 * wide.c: making eight children out of two by two (as Wald, Benthin, Boulos 2008, "Getting rid of packets": the largest
 * box is opened first), and walking. Bounds in steps of a node: Mahovsky 2005, "Ray tracing with reduced-precision
 * bounding volume hierarchies". */
#include "wide.h"

#include "room.h"

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

/* The lattice, and how far beyond it a query may lie: farther is as far. */
#define PLACES 16777215.0
#define BEYOND 1073741824.0
#define FARTHEST 1073741824
/* The smallest step (m), 2^-30: of what is smaller than a grain a walk may find all. */
#define FINEST 9.3132257461547852e-10

static int32_t down(const tahr__wide *t, int axis, double x)
{
    double at = floor((x - t->low[axis]) * t->scale);
    return (int32_t)d_max(-BEYOND, d_min(at, BEYOND));
}

static int32_t up(const tahr__wide *t, int axis, double x)
{
    return -(int32_t)d_max(-BEYOND, d_min(floor(-((x - t->low[axis]) * t->scale)), BEYOND));
}

/* Building. */

typedef struct grid_box {
    int32_t lo[3], hi[3];
} grid_box;

static grid_box to_lattice(const tahr__wide *t, const float lo[3], const float hi[3])
{
    grid_box b;
    for (int i = 0; i < 3; i++) {
        b.lo[i] = down(t, i, (double)lo[i]);
        b.hi[i] = up(t, i, (double)hi[i]);
    }
    return b;
}

static void set_lattice(tahr__wide *t, const tahr__bvh_node *root)
{
    double longest = 0, step = 1;
    for (int i = 0; i < 3; i++) {
        t->low[i] = (double)root->lo[i];
        longest = d_max(longest, (double)root->hi[i] - t->low[i]);
    }
    while (longest > PLACES * step)
        step *= 2;
    while (step > FINEST && longest <= PLACES * 0.5 * step)
        step *= 0.5;
    t->scale = 1 / step;
}

typedef struct children {
    grid_box box[TAHR__WIDE];
    uint32_t node[TAHR__WIDE]; /* of the tree of two */
    uint32_t count;
} children;

static void put_node(tahr__wide_node *n, const children *c, uint32_t first, uint32_t items)
{
    for (int a = 0; a < 3; a++) {
        int32_t low = c->box[0].lo[a], high = c->box[0].hi[a];
        uint32_t shift = 0;
        for (uint32_t i = 1; i < c->count; i++) {
            low = c->box[i].lo[a] < low ? c->box[i].lo[a] : low;
            high = c->box[i].hi[a] > high ? c->box[i].hi[a] : high;
        }
        while ((high - low + (1 << shift) - 1) >> shift > 255)
            shift++;
        n->base[a] = (uint32_t)low | shift << 24;
        for (uint32_t i = 0; i < TAHR__WIDE; i++) {
            const grid_box *b = &c->box[i < c->count ? i : 0];
            n->lo[a][i] = (uint8_t)((b->lo[a] - low) >> shift);
            n->hi[a][i] = (uint8_t)((b->hi[a] - low + (1 << shift) - 1) >> shift);
        }
    }
    n->base[0] |= (c->count - 1) << 29;
    n->base[1] |= items << 29;
    n->first = first;
}

typedef struct collapse {
    tahr__wide *tree;
    const tahr__bvh_node *two;
    const tahr__bvh_box *boxes;
} collapse;

static void put_items(const collapse *b, tahr__wide_node *n, uint32_t first, uint32_t count)
{
    children c;
    c.count = count;
    for (uint32_t i = 0; i < count; i++) {
        const tahr__bvh_box *box = &b->boxes[first + i];
        c.box[i] = to_lattice(b->tree, box->lo, box->hi);
    }
    put_node(n, &c, first, 1);
}

static float area(const tahr__bvh_node *n)
{
    float x = n->hi[0] - n->lo[0], y = n->hi[1] - n->lo[1], z = n->hi[2] - n->lo[2];
    return x * y + y * z + z * x;
}

/* Up to eight nodes below one of the tree of two: the largest that has children is replaced by them, in its place, as
 * long as there is room. */
static void open_children(const collapse *b, const tahr__bvh_node *node, children *c)
{
    c->node[0] = node->first;
    c->node[1] = node->first + 1;
    c->count = 2;
    while (c->count < TAHR__WIDE) {
        uint32_t best = TAHR__WIDE;
        for (uint32_t i = 0; i < c->count; i++) {
            const tahr__bvh_node *n = &b->two[c->node[i]];
            if (n->count > 0) continue;
            if (best == TAHR__WIDE || area(n) > area(&b->two[c->node[best]])) best = i;
        }
        if (best == TAHR__WIDE) break;
        for (uint32_t i = c->count++; i > best + 1; i--)
            c->node[i] = c->node[i - 1];
        c->node[best] = b->two[c->node[best]].first;
        c->node[best + 1] = c->node[best] + 1;
    }
    for (uint32_t i = 0; i < c->count; i++)
        c->box[i] = to_lattice(b->tree, b->two[c->node[i]].lo, b->two[c->node[i]].hi);
}

/* A node that is still to be made, out of one of the tree of two. */
typedef struct pending {
    uint32_t wide, two;
} pending;

static void make_nodes(const collapse *b)
{
    pending stack[TAHR__WIDE_STACK];
    uint32_t top = 0;
    stack[top++] = (pending){0, 0};
    b->tree->node_count = 1;
    while (top > 0) {
        pending p = stack[--top];
        const tahr__bvh_node *two = &b->two[p.two];
        tahr__wide_node *node = &b->tree->nodes[p.wide];
        children c;
        if (two->count > 0) {
            put_items(b, node, two->first, two->count);
            continue;
        }
        open_children(b, two, &c);
        put_node(node, &c, b->tree->node_count, 0);
        for (uint32_t i = c.count; i-- > 0;)
            stack[top++] = (pending){b->tree->node_count + i, c.node[i]};
        b->tree->node_count += c.count;
    }
}

/* How many nodes make_nodes makes at most: every node of the tree of two but the root is the child of one node or is
 * left out. */
static tahr_status give_nodes(const tahr_host *host, tahr__wide *tree, uint32_t most)
{
    const tahr_allocator *a = &host->allocator;
    tree->nodes = a->alloc(a->user, most * sizeof *tree->nodes, 64);
    tree->node_capacity = most;
    return tree->nodes ? TAHR_OK : TAHR_E_MEMORY;
}

tahr_status tahr__wide_build(const tahr_host *host, tahr__bvh_box *boxes, uint32_t *order, uint32_t count,
                             tahr_vec3 centre, tahr__wide *tree)
{
    tahr__bvh two;
    memset(tree, 0, sizeof *tree);
    memset(&two, 0, sizeof two);
    two.leaf = TAHR__WIDE;
    tahr_status status = tahr__bvh_build(host, boxes, order, count, centre, &two);
    if (status == TAHR_OK) status = give_nodes(host, tree, two.node_count);
    if (status == TAHR_OK) {
        collapse b = {tree, two.nodes, boxes};
        tree->centre = centre;
        tree->test = tahr__wide_best();
        tree->items = tahr__wide_items_best();
        set_lattice(tree, two.nodes);
        make_nodes(&b);
    }
    tahr__bvh_free(host, &two);
    if (status != TAHR_OK || tree->node_count == tree->node_capacity) return status;
    /* A second, exact allocation gives back what was not needed. */
    tahr__wide exact = *tree;
    if (give_nodes(host, &exact, tree->node_count) != TAHR_OK) return TAHR_OK;
    memcpy(exact.nodes, tree->nodes, tree->node_count * sizeof *tree->nodes);
    tahr__wide_free(host, tree);
    *tree = exact;
    return TAHR_OK;
}

void tahr__wide_free(const tahr_host *host, tahr__wide *tree)
{
    tahr__room_put(host, tree->nodes, tree->node_capacity, sizeof *tree->nodes);
    tree->nodes = NULL;
}

/* Asking. */

static void set_box(const tahr__wide *tree, const tahr_bounds *box, tahr__wide_box *out)
{
    tahr__bvh_box b = tahr__bvh_box_make(box, tree->centre);
    for (int i = 0; i < 3; i++) {
        out->lo[i] = down(tree, i, (double)b.lo[i]);
        out->hi[i] = up(tree, i, (double)b.hi[i]);
    }
    out->lo[3] = out->hi[3] = 0;
}

/* A reach on the lattice. */
static float places_of(const tahr__wide *tree, double reach)
{
    /* 1e-3 of a place: what is subtracted on the way onto the lattice is rounded by less. As far as queries are told
     * apart a reach finds all. */
    double places = reach * tree->scale + 1e-3;
    return places < 0.5 * BEYOND ? d_up(places) : INFINITY;
}

static float limit_of(float places)
{
    return places * places * 1.000001f;
}

static uint32_t children_of(const tahr__wide_node *n)
{
    return (n->base[0] >> 29) + 1;
}

static uint32_t has_items(const tahr__wide_node *n)
{
    return n->base[1] >> 29;
}

#if defined(__GNUC__)
static uint32_t lowest(uint32_t bits)
{
    return (uint32_t)__builtin_ctz(bits);
}
#else
static uint32_t lowest(uint32_t bits)
{
    uint32_t i = 0;
    while (!(bits >> i & 1))
        i++;
    return i;
}
#endif

uint32_t tahr__wide_collect(const tahr__wide *tree, const tahr_bounds *box, double reach, uint32_t *items,
                            uint32_t capacity)
{
    tahr__wide_box b;
    set_box(tree, box, &b);
    int32_t grow = (int32_t)d_min((double)places_of(tree, reach), BEYOND - 1) + 1;
    for (int i = 0; i < 3; i++) {
        b.lo[i] = b.lo[i] > -FARTHEST + grow ? b.lo[i] - grow : -FARTHEST;
        b.hi[i] = b.hi[i] < FARTHEST - grow ? b.hi[i] + grow : FARTHEST;
    }
    return tree->items(tree, &b, items, capacity);
}

void tahr__wide_walk_narrow(tahr__wide_walk *walk, const tahr_bounds *box)
{
    float sum = 0;
    set_box(walk->tree, box, &walk->box);
    walk->narrowed = 1;
    if (!walk->ordered) return;
    /* The corner of the box that is farthest from the point, and the reach, and a place for the point's rounding. */
    for (int a = 0; a < 3; a++) {
        const int64_t at = walk->near[a]; /* twice BEYOND is more than 32 bits hold */
        float before = (float)(at - walk->box.lo[a]), behind = (float)(walk->box.hi[a] - at);
        float away = (before > behind ? before : behind) + walk->places + 1;
        sum += away > 0 ? away * away : 0;
    }
    walk->farthest = sum * 1.000001f;
}

/* Takes in the children within reach. Into their places among all entries: bounds are coarse high up in the tree, so
 * what seems nearest there may not be, and whoever looks for a first hit should not go through all of it before. */
static void push(tahr__wide_walk *w, uint32_t node)
{
    float away[TAHR__WIDE];
    uint32_t near = w->tree->test(&w->tree->nodes[node], &w->box, w->near, w->ordered ? away : NULL);
    for (; near; near &= near - 1) {
        uint32_t i = lowest(near), k = w->top++, bits = 0;
        if (w->ordered) memcpy(&bits, &away[i], sizeof bits);
        uint64_t entry = (uint64_t)bits << 32 | (node * TAHR__WIDE + i);
        if (w->ordered && k < TAHR__WIDE_SORTED) {
            for (; k > 0 && w->entries[k - 1] < entry; k--)
                w->entries[k] = w->entries[k - 1];
        }
        w->entries[k] = entry;
    }
}

void tahr__wide_walk_begin(tahr__wide_walk *walk, const tahr__wide *tree, const tahr_bounds *box, double reach,
                           const tahr_vec3 *near)
{
    walk->tree = tree;
    set_box(tree, box, &walk->box);
    walk->places = places_of(tree, reach);
    walk->box.limit = limit_of(walk->places);
    walk->farthest = INFINITY;
    walk->ordered = near != NULL;
    for (int i = 0; near && i < 3; i++)
        walk->near[i] = down(tree, i, v_get(*near, i) - v_get(tree->centre, i));
    walk->near[3] = 0;
    walk->top = walk->narrowed = 0;
    push(walk, 0);
}

/* Is one child still within reach? */
static int holds(const tahr__wide_walk *w, const tahr__wide_node *n, uint32_t child)
{
    const tahr__wide_box *b = &w->box;
    float sum[3];
    for (int a = 0; a < 3; a++) {
        int32_t base = (int32_t)(n->base[a] & 0xFFFFFF);
        uint32_t shift = n->base[a] >> 24 & 31;
        float under = (float)((int32_t)n->lo[a][child] << shift) - (float)(b->hi[a] - base);
        float over = (float)(b->lo[a] - base) - (float)((int32_t)n->hi[a][child] << shift);
        float gap = under > over ? under : over;
        gap = gap > 0 ? gap : 0;
        sum[a] = gap * gap;
    }
    return (sum[0] + sum[1]) + sum[2] <= b->limit;
}

int tahr__wide_walk_next(tahr__wide_walk *walk, uint32_t *item)
{
    while (walk->top > 0) {
        uint64_t entry = walk->entries[--walk->top];
        uint32_t bits = (uint32_t)(entry >> 32), child = (uint32_t)entry % TAHR__WIDE;
        const tahr__wide_node *n = &walk->tree->nodes[(uint32_t)entry / TAHR__WIDE];
        float away;
        memcpy(&away, &bits, sizeof away);
        if (away > walk->farthest) {
            if (walk->top < TAHR__WIDE_SORTED) break; /* so are all others */
            continue;
        }
        if (walk->narrowed && !holds(walk, n, child)) continue;
        if (has_items(n)) {
            *item = n->first + child;
            return 1;
        }
        push(walk, n->first + child);
    }
    walk->top = 0;
    return 0;
}

/* One node, one child at a time. */

static float square(float low, float high, float from, float to)
{
    float under = low - to, over = from - high;
    float gap = under > over ? under : over;
    gap = gap > 0 ? gap : 0;
    return gap * gap;
}

uint32_t tahr__wide_test_1(const tahr__wide_node *n, const tahr__wide_box *box, const int32_t point[4],
                           float away[TAHR__WIDE])
{
    uint32_t near = 0;
    for (uint32_t i = 0; i < children_of(n); i++) {
        float to_box[3], to_point[3];
        for (int a = 0; a < 3; a++) {
            int32_t base = (int32_t)(n->base[a] & 0xFFFFFF);
            float step = (float)(1u << (n->base[a] >> 24 & 31)), at = (float)(point[a] - base);
            float low = (float)n->lo[a][i] * step, high = (float)n->hi[a][i] * step;
            to_box[a] = square(low, high, (float)(box->lo[a] - base), (float)(box->hi[a] - base));
            to_point[a] = square(low, high, at, at);
        }
        if (away) away[i] = (to_point[0] + to_point[1]) + to_point[2];
        near |= (uint32_t)((to_box[0] + to_box[1]) + to_box[2] <= box->limit) << i;
    }
    return near;
}

/* Which children of a node a box meets: in its steps, so much of the box as it can tell. */
static uint32_t meets(const tahr__wide_node *n, const tahr__wide_box *box)
{
    uint32_t apart = 0;
    for (int a = 0; a < 3; a++) {
        int32_t base = (int32_t)(n->base[a] & 0xFFFFFF), shift = (int32_t)(n->base[a] >> 24 & 31);
        int32_t from = box->lo[a] - base, to = box->hi[a] - base;
        from = from > 0 ? (from + (1 << shift) - 1) >> shift : 0;
        if (to < 0 || from > 255) return 0;
        to >>= shift;
        for (uint32_t i = 0; i < TAHR__WIDE; i++)
            apart |= (uint32_t)((n->lo[a][i] > to) | (n->hi[a][i] < from)) << i;
    }
    return ~apart & (0xFFu >> (8 - children_of(n)));
}

static uint32_t put_bits(uint32_t *to, uint32_t first, uint32_t bits)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < TAHR__WIDE; i++) {
        to[count] = first + i;
        count += bits >> i & 1;
    }
    return count;
}

#include "wide_collect.h"

uint32_t tahr__wide_items_1(const tahr__wide *tree, const tahr__wide_box *box, uint32_t *items, uint32_t capacity)
{
    return wide_collect(tree, box, items, capacity);
}

/* SPDX-License-Identifier: MIT
 * octree.cpp: voxel maps: finding their cells through FCL's OcTree. Reading them is octree_file.cpp. */
#include "engine_fcl.h"

using namespace tahr_fcl;

using Octree = fcl::OcTree<double>;
using Node = Octree::OcTreeNode;

namespace
{
/* A cell: its lowest corner by key, its depth below the root. */
struct Cell {
    uint32_t key[3];
    uint32_t depth;

    uint32_t size() const
    {
        return 1u << (TAHR__FCL_LEVELS - depth);
    }
    Cell child(uint32_t i) const
    {
        uint32_t half = size() / 2;
        return {{key[0] + (i & 1 ? half : 0), key[1] + (i & 2 ? half : 0), key[2] + (i & 4 ? half : 0)}, depth + 1};
    }
};

/* A range of keys, both ends in it. */
struct Range {
    int64_t low[3], high[3];

    bool meets(const Cell &c) const
    {
        for (int i = 0; i < 3; i++) {
            if (c.key[i] > high[i] || c.key[i] + c.size() - 1 < low[i]) return false;
        }
        return true;
    }
};

template <class Visit>
void visit_cells(const Octree &tree, const Node *node, const Cell &cell, const Range &range, Visit &&visit)
{
    bool alone = true;
    for (uint32_t i = 0; i < 8 && cell.depth < TAHR__FCL_LEVELS; i++) {
        if (!tree.nodeChildExists(node, i)) continue;
        Cell child = cell.child(i);
        alone = false;
        if (range.meets(child)) visit_cells(tree, tree.getNodeChild(node, i), child, range, visit);
    }
    if (alone && tree.isNodeOccupied(node)) visit(cell);
}

double resolution_of(const Octree &tree)
{
    return tree.getRootBV().width() / (2.0 * ORIGIN);
}

int64_t key_of(double x, double resolution)
{
    double key = floor(x / resolution) + ORIGIN;
    return key < -1 ? -1 : key > 2 * TAHR__FCL_ORIGIN ? 2 * TAHR__FCL_ORIGIN : static_cast<int64_t>(key);
}

tahr__fcl_part part_of(uint32_t body, const Cell &cell)
{
    return {
        body,
        0,
        {static_cast<uint16_t>(cell.key[0]), static_cast<uint16_t>(cell.key[1]), static_cast<uint16_t>(cell.key[2])},
        static_cast<uint16_t>(cell.depth)};
}
} // namespace

void tahr_fcl::find_in_octree(const Geometry &geometry, const tahr_bounds &box, const Sink &sink)
{
    const auto &tree = static_cast<const Octree &>(geometry);
    double r = resolution_of(tree);
    Range range = {{key_of(box.min.x, r), key_of(box.min.y, r), key_of(box.min.z, r)},
                   {key_of(box.max.x, r), key_of(box.max.y, r), key_of(box.max.z, r)}};

    if (!tree.getRoot()) return;
    visit_cells(tree, tree.getRoot(), Cell{{0, 0, 0}, 0}, range, [&](const Cell &cell) {
        tahr__fcl_part part = part_of(sink.body, cell);
        tahr__fcl_list_add(sink.list, &part);
    });
}

static const Octree &octree_of(const tahr__fcl_engine *engine, uint32_t body)
{
    return static_cast<const Octree &>(*engine->bodies[body].object->collisionGeometry());
}

int tahr__fcl_engine_occupied(const tahr__fcl_engine *engine, uint32_t body, const int32_t key[3])
{
    const Octree &tree = octree_of(engine, body);
    const Node *node = tree.getRoot();
    uint32_t bit = TAHR__FCL_ORIGIN;

    for (int i = 0; i < 3; i++) {
        if (key[i] < 0 || key[i] >= 2 * TAHR__FCL_ORIGIN) return 0;
    }
    for (; node && tree.nodeHasChildren(node); bit >>= 1) {
        uint32_t child = 0;
        for (uint32_t i = 0; i < 3; i++)
            child |= static_cast<uint32_t>(key[i]) & bit ? 1u << i : 0u;
        if (bit == 0 || !tree.nodeChildExists(node, child)) return 0;
        node = tree.getNodeChild(node, child);
    }
    return node && tree.isNodeOccupied(node);
}

void tahr__fcl_engine_cells(const tahr__fcl_engine *engine, uint32_t body,
                            void (*visit)(void *user, const tahr__fcl_part *cell), void *user)
{
    const Octree &tree = octree_of(engine, body);
    Range all = {{0, 0, 0}, {2 * TAHR__FCL_ORIGIN, 2 * TAHR__FCL_ORIGIN, 2 * TAHR__FCL_ORIGIN}};

    if (!tree.getRoot()) return;
    visit_cells(tree, tree.getRoot(), Cell{{0, 0, 0}, 0}, all, [&](const Cell &cell) {
        tahr__fcl_part part = part_of(body, cell);
        visit(user, &part);
    });
}

/* SPDX-License-Identifier: MIT
 * make_voxels.cpp: writes the level of voxels.h as an OctoMap file: make_voxels FILE.bt|FILE.ot */
#include "voxels.h"

#include <cstdio>
#include <octomap/OcTree.h>
#include <string>

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: make_voxels FILE.bt|FILE.ot\n", stderr);
        return 2;
    }
    std::string name = argv[1];
    std::vector<double> points = voxel_level();
    octomap::OcTree tree(VOXEL);
    for (size_t i = 0; i < points.size(); i += 3)
        tree.updateNode(points[i], points[i + 1], points[i + 2], true, true);
    tree.updateInnerOccupancy();
    tree.prune();
    bool binary = name.size() > 3 && name.compare(name.size() - 3, 3, ".bt") == 0;
    return (binary ? tree.writeBinary(name) : tree.write(name)) ? 0 : 1;
}

/* SPDX-License-Identifier: MIT
 * octree_file.cpp: voxel maps from files of OctoMap and from points. OctoMap reads a broken file to its end and beyond,
 * as deep as its bytes say; so every byte is checked here first. */
#include "engine_fcl.h"

#include <cstdio>
#include <cstring>
#include <sstream>
#include <string>

using namespace tahr_fcl;

namespace
{
/* A complaint about a file, at a byte or a line. */
struct Trouble {
    tahr_status status;
    std::string text;
};

struct Header {
    bool binary; /* .bt: two bits per cell; else .ot: a float per node */
    double resolution;
    size_t data; /* where the tree begins */
};

std::string read_all(const char *path)
{
    std::string text;
    char block[65536];
    FILE *file = fopen(path, "rb");
    size_t got;

    if (!file) throw Trouble{TAHR_E_NOT_FOUND, "cannot be opened"};
    while ((got = fread(block, 1, sizeof block, file)) > 0)
        text.append(block, got);
    bool failed = ferror(file) != 0;
    fclose(file);
    if (failed) throw Trouble{TAHR_E_NOT_FOUND, "cannot be read"};
    return text;
}

Header read_header(const std::string &text)
{
    Header header = {false, 0, 0};
    size_t at = 0;
    bool known = false;

    for (int line = 1; line < 1000; line++) {
        size_t end = text.find('\n', at);
        std::string number = "line " + std::to_string(line) + ": ";
        if (end == std::string::npos) break;
        std::string words = text.substr(at, end - at);
        at = end + 1;
        if (line == 1) {
            header.binary = words.rfind("# Octomap OcTree binary file", 0) == 0;
            if (!header.binary && words.rfind("# Octomap OcTree file", 0) != 0)
                throw Trouble{TAHR_E_GEOMETRY, number + "expected '# Octomap OcTree file' or '... binary file'"};
        } else if (words.rfind("id ", 0) == 0) {
            known = words == "id OcTree";
            if (!known) throw Trouble{TAHR_E_GEOMETRY, number + "expected 'id OcTree', the tree of plain nodes"};
        } else if (words.rfind("res ", 0) == 0) {
            char *rest = nullptr;
            header.resolution = strtod(words.c_str() + 4, &rest);
        } else if (words == "data") {
            header.data = at;
            break;
        }
    }
    if (!known) throw Trouble{TAHR_E_GEOMETRY, "no line 'id OcTree'"};
    if (!(header.resolution >= 1e-3 && header.resolution <= 1e3))
        throw Trouble{TAHR_E_GEOMETRY, "line 'res': expected the edge of a cell, 1e-3 to 1e3 m"};
    if (header.data == 0) throw Trouble{TAHR_E_GEOMETRY, "no line 'data'"};
    return header;
}

/* Walks the nodes as OctoMap will: at most 16 levels below the root, all of them there. */
struct Walker {
    const std::string &text;
    size_t at;

    unsigned take(size_t bytes)
    {
        if (text.size() - at < bytes)
            throw Trouble{TAHR_E_GEOMETRY, "byte " + std::to_string(text.size()) + ": the tree ends early"};
        at += bytes;
        return static_cast<unsigned char>(text[at - 1]);
    }
    void check_depth(int depth) const
    {
        if (depth > TAHR__FCL_LEVELS)
            throw Trouble{TAHR_E_GEOMETRY, "byte " + std::to_string(at) + ": nodes deeper than 16 levels"};
    }
    void walk_binary(int depth)
    {
        unsigned low = take(1), bits = low | take(1) << 8;
        if (depth >= TAHR__FCL_LEVELS && bits != 0) check_depth(depth + 1);
        for (int i = 0; i < 8; i++) {
            if ((bits >> (2 * i) & 3) == 3) walk_binary(depth + 1);
        }
    }
    void walk_full(int depth)
    {
        float value;
        take(sizeof value);
        memcpy(&value, &text[at - sizeof value], sizeof value);
        if (!(value - value == 0)) throw Trouble{TAHR_E_GEOMETRY, "byte " + std::to_string(at - 4) + ": not finite"};
        unsigned children = take(1);
        check_depth(depth + (children != 0));
        for (int i = 0; i < 8; i++) {
            if (children >> i & 1) walk_full(depth + 1);
        }
    }
};

std::shared_ptr<octomap::OcTree> read_file(const char *path)
{
    std::string text = read_all(path);
    Header header = read_header(text);
    Walker walker = {text, header.data};

    if (header.binary)
        walker.walk_binary(0);
    else
        walker.walk_full(0);
    auto tree = std::make_shared<octomap::OcTree>(header.resolution);
    std::istringstream data(text.substr(header.data));
    if (header.binary)
        tree->readBinaryData(data);
    else
        tree->readData(data);
    /* A root that is alone would be one occupied cell as large as all that can be mapped. */
    if (tree->getRoot() && !tree->nodeHasChildren(tree->getRoot())) tree->clear();
    return tree;
}

std::shared_ptr<octomap::OcTree> read_points(const tahr_fcl_octree &desc)
{
    if (!(desc.resolution >= 1e-3 && desc.resolution <= 1e3))
        throw Trouble{TAHR_E_ARGUMENT, "resolution is not 1e-3..1e3 m"};
    if (!desc.points || desc.point_count == 0) throw Trouble{TAHR_E_ARGUMENT, "neither path nor points are given"};
    auto tree = std::make_shared<octomap::OcTree>(desc.resolution);
    for (size_t i = 0; i < desc.point_count; i++) {
        const double *p = desc.points + 3 * i;
        octomap::OcTreeKey key;
        for (unsigned k = 0; k < 3; k++) {
            double cell = floor(p[k] / desc.resolution) + ORIGIN;
            if (!(cell >= 0 && cell < 2 * TAHR__FCL_ORIGIN))
                throw Trouble{TAHR_E_GEOMETRY,
                              "points[" + std::to_string(i) + "] is not finite or beyond 32768 cells from the origin"};
            key[k] = static_cast<octomap::key_type>(cell);
        }
        tree->updateNode(key, true, true);
    }
    tree->updateInnerOccupancy();
    tree->prune();
    return tree;
}
} // namespace

tahr_status tahr__fcl_octree_read(tahr__fcl_engine *engine, const tahr_host *host, const tahr_fcl_octree *desc,
                                  tahr__fcl_geometry *geometry)
{
    return guarded([&]() -> tahr_status {
        try {
            std::shared_ptr<octomap::OcTree> tree = desc->path ? read_file(desc->path) : read_points(*desc);
            engine->read = std::make_shared<fcl::OcTree<double>>(tree);
            *geometry = {};
            geometry->kind = TAHR__FCL_OCTREE;
            geometry->radius = tree->getResolution();
            geometry->identity = &engine->read;
            return TAHR_OK;
        } catch (const Trouble &trouble) {
            std::string text = std::string("octree '") + (desc->path ? desc->path : "points") + "': " + trouble.text;
            host->log.write(host->log.user, TAHR_LOG_ERROR, text.c_str());
            return trouble.status;
        }
    });
}

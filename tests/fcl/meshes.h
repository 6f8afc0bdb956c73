/* SPDX-License-Identifier: MIT
 * meshes.h: random hills, as a body of Tahr's and as a model of FCL's. */
#ifndef TAHR_TEST_MESHES_H
#define TAHR_TEST_MESHES_H

#include "worlds.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <memory>

/* 12 x 12 cells of 0.5 m around the origin, faces up, heights within 0.6 m. */
struct Hills {
    enum { CELLS = 12 };
    std::vector<double> vertices;
    std::vector<uint32_t> indices;

    explicit Hills(Dice &dice)
    {
        for (int i = 0; i < (CELLS + 1) * (CELLS + 1); i++)
            vertices.insert(vertices.end(),
                            {(i % (CELLS + 1) - CELLS / 2) * 0.5,
                             static_cast<double>(i / (CELLS + 1) - CELLS / 2) * 0.5, dice.uniform(0, 0.6)});
        for (uint32_t i = 0; i < CELLS * CELLS; i++) {
            uint32_t a = i / CELLS * (CELLS + 1) + i % CELLS;
            indices.insert(indices.end(), {a, a + 1, a + CELLS + 2, a, a + CELLS + 2, a + CELLS + 1});
        }
    }
    tahr_body_desc body() const
    {
        tahr_body_desc b = make_body(TAHR_BODY_MESH);
        b.flags = TAHR_BODY_TWO_SIDED;
        b.vertices = vertices.data();
        b.indices = indices.data();
        b.vertex_count = static_cast<uint32_t>(vertices.size() / 3);
        b.triangle_count = static_cast<uint32_t>(indices.size() / 3);
        return b;
    }
    template <class BV> std::shared_ptr<fcl::BVHModel<BV>> model() const
    {
        auto m = std::make_shared<fcl::BVHModel<BV>>();
        std::vector<fcl::Vector3<double>> points;
        std::vector<fcl::Triangle> triangles;
        for (size_t i = 0; i < vertices.size(); i += 3)
            points.emplace_back(vertices[i], vertices[i + 1], vertices[i + 2]);
        for (size_t i = 0; i < indices.size(); i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        m->beginModel();
        m->addSubModel(points, triangles);
        m->endModel();
        return m;
    }
};

#endif

/* SPDX-License-Identifier: MIT
 * engine_fcl.h: what the C++ files of the engine share. */
#ifndef TAHR_FCL_ENGINE_FCL_H
#define TAHR_FCL_ENGINE_FCL_H

#include "engine.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <memory>
#include <new>
#include <unordered_map>
#include <vector>

namespace tahr_fcl
{

/* As a number: clang warns of enumerators among doubles. */
constexpr int ORIGIN = TAHR__FCL_ORIGIN;

using Manager = fcl::DynamicAABBTreeCollisionManager<double>;
using Object = fcl::CollisionObject<double>;
using Geometry = fcl::CollisionGeometry<double>;
using Vector = fcl::Vector3<double>;

/* Where what a search found goes. */
struct Sink {
    tahr__fcl_list *list;
    uint32_t body;
    const std::vector<uint32_t> *order; /* FCL's triangle to the body's; NULL: the same */

    void triangle(int id) const
    {
        tahr__fcl_part part = {body, static_cast<uint32_t>(id), {0, 0, 0}, 0};
        if (order) part.triangle = (*order)[part.triangle];
        if (part.triangle != UINT32_MAX) tahr__fcl_list_add(list, &part);
    }
};

/* Tells sink about everything of a geometry that may reach into a box in its frame. */
using Find = void (*)(const Geometry &geometry, const tahr_bounds &box, const Sink &sink);

struct Body {
    std::shared_ptr<Geometry> geometry; /* own, or NULL */
    std::unique_ptr<Object> own;
    const Object *object;        /* own, or the user's */
    Find find;                   /* NULL: the body is one piece */
    std::vector<uint32_t> order; /* FCL triangle to the triangle of the body; empty: the same */
    bool all;                    /* without a tree: every triangle is near (a polytope, a lone triangle) */
};

Find find_in_mesh(const Geometry &geometry, bool collide);
void find_in_octree(const Geometry &geometry, const tahr_bounds &box, const Sink &sink);

/* Runs f; no exception leaves. */
template <class F> tahr_status guarded(F f) noexcept
{
    try {
        return f();
    } catch (const std::bad_alloc &) {
        return TAHR_E_MEMORY;
    } catch (...) {
        return TAHR_E_BACKEND;
    }
}

} // namespace tahr_fcl

struct tahr__fcl_engine {
    tahr_fcl_desc desc;
    const tahr_host *host;
    std::vector<tahr_fcl::Body> bodies;
    tahr_fcl::Manager own;
    const tahr_fcl::Manager *manager; /* own, or the user's */
    std::unordered_map<const tahr_fcl::Object *, uint32_t> index;
    std::vector<tahr_fcl::Object *> moved;
    std::vector<tahr_fcl::Object *> offered; /* by an attached manager */
    std::vector<double> vertices;            /* of the geometry that is looked at */
    std::vector<uint32_t> indices;
    std::shared_ptr<tahr_fcl::Geometry> read; /* the octree that was read last */
};

#endif

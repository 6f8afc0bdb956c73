/* SPDX-License-Identifier: MIT
 * engine.cpp: FCL's objects: taking bodies in, placing them, letting them go. */
#include "engine_fcl.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

using namespace tahr_fcl;

template <class BV> static std::shared_ptr<Geometry> make_mesh(const tahr__fcl_geometry &g)
{
    auto model = std::make_shared<fcl::BVHModel<BV>>();
    std::vector<Vector> points;
    std::vector<fcl::Triangle> triangles;

    points.reserve(g.vertex_count);
    triangles.reserve(g.triangle_count);
    for (size_t i = 0; i < g.vertex_count; i++)
        points.emplace_back(g.vertices[3 * i], g.vertices[3 * i + 1], g.vertices[3 * i + 2]);
    for (size_t i = 0; i < g.triangle_count; i++)
        triangles.emplace_back(g.indices[3 * i], g.indices[3 * i + 1], g.indices[3 * i + 2]);
    if (model->beginModel(static_cast<int>(g.triangle_count), static_cast<int>(g.vertex_count)) != fcl::BVH_OK ||
        model->addSubModel(points, triangles) != fcl::BVH_OK || model->endModel() != fcl::BVH_OK)
        return nullptr;
    return model;
}

/* FCL only finds it by its bounds, for which it needs no faces. */
static std::shared_ptr<Geometry> make_hull(const tahr__fcl_geometry &g)
{
    auto points = std::make_shared<std::vector<Vector>>();
    auto faces = std::make_shared<std::vector<int>>();

    for (size_t i = 0; i < g.vertex_count; i++)
        points->emplace_back(g.vertices[3 * i], g.vertices[3 * i + 1], g.vertices[3 * i + 2]);
    return std::make_shared<fcl::Convex<double>>(points, 0, faces);
}

static std::shared_ptr<Geometry> make_geometry(const tahr_fcl_desc &desc, const tahr__fcl_geometry &g)
{
    switch (g.kind) {
    case TAHR_BODY_MESH:
        if (desc.volumes == TAHR_FCL_OBBRSS) return make_mesh<fcl::OBBRSS<double>>(g);
        return make_mesh<fcl::AABB<double>>(g);
    case TAHR_BODY_BOX:
        return std::make_shared<fcl::Box<double>>(2 * g.half_extents.x, 2 * g.half_extents.y, 2 * g.half_extents.z);
    case TAHR_BODY_SPHERE: return std::make_shared<fcl::Sphere<double>>(g.radius);
    case TAHR_BODY_CAPSULE: return std::make_shared<fcl::Capsule<double>>(g.radius, 2 * g.reach);
    case TAHR_BODY_CYLINDER: return std::make_shared<fcl::Cylinder<double>>(g.radius, 2 * g.reach);
    case TAHR_BODY_CONE: return std::make_shared<fcl::Cone<double>>(g.radius, 2 * g.reach);
    case TAHR_BODY_ELLIPSOID:
        return std::make_shared<fcl::Ellipsoid<double>>(g.half_extents.x, g.half_extents.y, g.half_extents.z);
    case TAHR_BODY_HULL: return make_hull(g);
    case TAHR__FCL_OCTREE: return *static_cast<std::shared_ptr<Geometry> *>(const_cast<void *>(g.identity));
    default: return nullptr;
    }
}

static fcl::Transform3<double> transform_of(const tahr_pose &pose)
{
    tahr__mat turn = m_from_quat(pose.orientation);
    fcl::Transform3<double> t = fcl::Transform3<double>::Identity();

    for (int i = 0; i < 3; i++)
        t.linear().row(i) << turn.row[i].x, turn.row[i].y, turn.row[i].z;
    t.translation() << pose.position.x, pose.position.y, pose.position.z;
    return t;
}

tahr_status tahr__fcl_engine_open(const tahr_host *host, const tahr_fcl_desc *desc, tahr__fcl_engine **engine)
{
    return guarded([&] {
        auto made = std::make_unique<tahr__fcl_engine>();
        made->desc = *desc;
        made->host = host;
        made->manager = desc->manager ? static_cast<const Manager *>(desc->manager) : &made->own;
        *engine = made.release();
        return TAHR_OK;
    });
}

void tahr__fcl_engine_close(tahr__fcl_engine *engine)
{
    delete engine;
}

tahr_status tahr__fcl_engine_add(tahr__fcl_engine *engine, const tahr__fcl_geometry *g, const tahr_pose *pose)
{
    return guarded([&]() -> tahr_status {
        Body body = {};
        body.geometry = make_geometry(engine->desc, *g);
        if (!body.geometry) return TAHR_E_BACKEND;
        if (g->kind == TAHR_BODY_MESH)
            body.find = find_in_mesh(*body.geometry, engine->desc.search == TAHR_FCL_COLLIDE);
        if (g->kind == TAHR__FCL_OCTREE) body.find = find_in_octree;
        body.own = std::make_unique<Object>(body.geometry, transform_of(*pose));
        body.object = body.own.get();
        engine->index.emplace(body.object, static_cast<uint32_t>(engine->bodies.size()));
        engine->moved.push_back(body.own.get());
        engine->bodies.push_back(std::move(body));
        return TAHR_OK;
    });
}

tahr_status tahr__fcl_engine_finish(tahr__fcl_engine *engine)
{
    return guarded([&] {
        if (engine->manager != &engine->own || engine->moved.empty()) return TAHR_OK;
        engine->own.registerObjects(engine->moved);
        engine->own.setup();
        engine->moved.clear();
        return TAHR_OK;
    });
}

tahr_status tahr__fcl_engine_place(tahr__fcl_engine *engine, uint32_t body, const tahr_pose *pose)
{
    return guarded([&] {
        Object *object = engine->bodies[body].own.get();
        object->setTransform(transform_of(*pose));
        object->computeAABB();
        engine->moved.push_back(object);
        return TAHR_OK;
    });
}

tahr_status tahr__fcl_engine_update(tahr__fcl_engine *engine)
{
    return guarded([&] {
        engine->own.update(engine->moved);
        engine->moved.clear();
        return TAHR_OK;
    });
}

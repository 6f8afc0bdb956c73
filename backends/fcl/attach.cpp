/* SPDX-License-Identifier: MIT
 * attach.cpp: the objects of a user's manager. Their geometry is looked at once, where they are is asked again by every
 * query. */
#include "engine_fcl.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

using namespace tahr_fcl;

static uint32_t add_vertex(tahr__fcl_engine &engine, const Vector &v)
{
    engine.vertices.insert(engine.vertices.end(), {v.x(), v.y(), v.z()});
    return static_cast<uint32_t>(engine.vertices.size() / 3 - 1);
}

static void finish_mesh(tahr__fcl_engine &engine, tahr__fcl_geometry &g, bool two_sided)
{
    g.kind = TAHR_BODY_MESH;
    g.two_sided = two_sided;
    g.vertices = engine.vertices.data();
    g.indices = engine.indices.data();
    g.vertex_count = static_cast<uint32_t>(engine.vertices.size() / 3);
    g.triangle_count = static_cast<uint32_t>(engine.indices.size() / 3);
}

/* Two-sided: nothing in FCL says which way a model's triangles face. */
template <class BV> static void look_at_model(tahr__fcl_engine &engine, const Geometry &geometry, tahr__fcl_geometry &g)
{
    const auto &model = static_cast<const fcl::BVHModel<BV> &>(geometry);

    g.name = "a BVHModel";
    if (model.getModelType() != fcl::BVH_MODEL_TRIANGLES || model.getNumBVs() == 0 || model.num_tris <= 0) return;
    for (int i = 0; i < model.num_vertices; i++)
        add_vertex(engine, model.vertices[i]);
    for (int i = 0; i < model.num_tris; i++) {
        for (int k = 0; k < 3; k++)
            engine.indices.push_back(static_cast<uint32_t>(model.tri_indices[i][k]));
    }
    finish_mesh(engine, g, true);
}

/* The faces of a polytope as fans; they face outward. */
static void look_at_convex(tahr__fcl_engine &engine, const fcl::Convex<double> &convex, tahr__fcl_geometry &g)
{
    const std::vector<int> &faces = convex.getFaces();

    for (const Vector &v : convex.getVertices())
        add_vertex(engine, v);
    for (size_t at = 0; at < faces.size(); at += static_cast<size_t>(faces[at]) + 1) {
        for (size_t i = 2; i < static_cast<size_t>(faces[at]) && at + i + 1 < faces.size(); i++) {
            for (size_t k : {at + 1, at + i, at + i + 1})
                engine.indices.push_back(static_cast<uint32_t>(faces[k]));
        }
    }
    finish_mesh(engine, g, false);
}

static void look_at_triangle(tahr__fcl_engine &engine, const fcl::TriangleP<double> &t, tahr__fcl_geometry &g)
{
    for (const Vector *v : {&t.a, &t.b, &t.c})
        engine.indices.push_back(add_vertex(engine, *v));
    finish_mesh(engine, g, true);
}

static void look_at_half_space(uint32_t kind, const Vector &n, double d, tahr__fcl_geometry &g)
{
    g.kind = n.allFinite() && n.squaredNorm() > 0.99 && d * 0 == 0 ? kind : 0;
    g.two_sided = kind == TAHR__FCL_PLANE;
    g.half_extents = {n.x(), n.y(), n.z()};
    g.radius = d;
}

static bool is_size(double x)
{
    return x >= 1e-6 && x <= 1e6;
}

static void look_at_solid(const Geometry &geometry, tahr__fcl_geometry &g)
{
    if (geometry.getNodeType() == fcl::GEOM_BOX) {
        const Vector &side = static_cast<const fcl::Box<double> &>(geometry).side;
        g.name = "a Box";
        g.kind = is_size(side.x()) && is_size(side.y()) && is_size(side.z()) ? TAHR_BODY_BOX : 0;
        g.half_extents = {0.5 * side.x(), 0.5 * side.y(), 0.5 * side.z()};
    } else if (geometry.getNodeType() == fcl::GEOM_SPHERE) {
        g.name = "a Sphere";
        g.radius = static_cast<const fcl::Sphere<double> &>(geometry).radius;
        g.kind = is_size(g.radius) ? TAHR_BODY_SPHERE : 0;
    } else {
        const auto &capsule = static_cast<const fcl::Capsule<double> &>(geometry);
        g.name = "a Capsule";
        g.radius = capsule.radius;
        g.reach = 0.5 * capsule.lz;
        g.kind = is_size(g.radius) && g.reach >= 0 && g.reach <= 1e6 ? TAHR_BODY_CAPSULE : 0;
    }
}

/* A Cylinder or a Cone, whose apex is up +z as a body's. */
template <class Shape> static void look_at_swept(const Shape &shape, tahr__fcl_geometry &g)
{
    bool is_cone = shape.getNodeType() == fcl::GEOM_CONE;

    g.name = is_cone ? "a Cone" : "a Cylinder";
    g.radius = shape.radius;
    g.reach = 0.5 * shape.lz;
    g.kind = !is_size(g.radius) || !is_size(g.reach) ? 0 : is_cone ? TAHR_BODY_CONE : TAHR_BODY_CYLINDER;
}

static void look_at_ellipsoid(const fcl::Ellipsoid<double> &ellipsoid, tahr__fcl_geometry &g)
{
    const Vector &radii = ellipsoid.radii;

    g.name = "an Ellipsoid";
    g.half_extents = {radii.x(), radii.y(), radii.z()};
    g.kind = is_size(radii.x()) && is_size(radii.y()) && is_size(radii.z()) ? TAHR_BODY_ELLIPSOID : 0;
}

static void look_at(tahr__fcl_engine &engine, const Geometry &geometry, tahr__fcl_geometry &g)
{
    switch (geometry.getNodeType()) {
    case fcl::BV_AABB: return look_at_model<fcl::AABB<double>>(engine, geometry, g);
    case fcl::BV_OBB: return look_at_model<fcl::OBB<double>>(engine, geometry, g);
    case fcl::BV_RSS: return look_at_model<fcl::RSS<double>>(engine, geometry, g);
    case fcl::BV_kIOS: return look_at_model<fcl::kIOS<double>>(engine, geometry, g);
    case fcl::BV_OBBRSS: return look_at_model<fcl::OBBRSS<double>>(engine, geometry, g);
    case fcl::BV_KDOP16: return look_at_model<fcl::KDOP<double, 16>>(engine, geometry, g);
    case fcl::BV_KDOP18: return look_at_model<fcl::KDOP<double, 18>>(engine, geometry, g);
    case fcl::BV_KDOP24: return look_at_model<fcl::KDOP<double, 24>>(engine, geometry, g);
    case fcl::GEOM_BOX:
    case fcl::GEOM_SPHERE:
    case fcl::GEOM_CAPSULE: return look_at_solid(geometry, g);
    case fcl::GEOM_CYLINDER: return look_at_swept(static_cast<const fcl::Cylinder<double> &>(geometry), g);
    case fcl::GEOM_CONE: return look_at_swept(static_cast<const fcl::Cone<double> &>(geometry), g);
    case fcl::GEOM_ELLIPSOID: return look_at_ellipsoid(static_cast<const fcl::Ellipsoid<double> &>(geometry), g);
    case fcl::GEOM_CONVEX: return look_at_convex(engine, static_cast<const fcl::Convex<double> &>(geometry), g);
    case fcl::GEOM_TRIANGLE: return look_at_triangle(engine, static_cast<const fcl::TriangleP<double> &>(geometry), g);
    case fcl::GEOM_HALFSPACE: {
        const auto &h = static_cast<const fcl::Halfspace<double> &>(geometry);
        return look_at_half_space(TAHR__FCL_HALF_SPACE, h.n, h.d, g);
    }
    case fcl::GEOM_PLANE: {
        const auto &p = static_cast<const fcl::Plane<double> &>(geometry);
        return look_at_half_space(TAHR__FCL_PLANE, p.n, p.d, g);
    }
    case fcl::GEOM_OCTREE:
        g.kind = TAHR__FCL_OCTREE;
        g.radius = static_cast<const fcl::OcTree<double> &>(geometry).getRootBV().width() / (2.0 * ORIGIN);
        return;
    default: return;
    }
}

/* FCL takes any matrix. Who is placed by none that turns and moves, is nowhere, or of another size. */
static bool is_placed(const Object &object)
{
    const fcl::Transform3<double> &t = object.getTransform();
    return t.translation().allFinite() && t.linear().allFinite() && t.linear().isUnitary(1e-6) &&
           t.linear().determinant() > 0;
}

tahr_status tahr__fcl_engine_attach(tahr__fcl_engine *engine, uint32_t *count)
{
    return guarded([&]() -> tahr_status {
        engine->manager->getObjects(engine->offered);
        if (engine->offered.size() > 1u << 30) return TAHR_E_UNSUPPORTED;
        *count = static_cast<uint32_t>(engine->offered.size());
        return TAHR_OK;
    });
}

tahr_status tahr__fcl_engine_object(tahr__fcl_engine *engine, uint32_t i, const void **object,
                                    tahr__fcl_geometry *geometry)
{
    return guarded([&] {
        const Object *offered = engine->offered[i];
        *object = offered;
        *geometry = {};
        geometry->name = "this geometry";
        geometry->identity = offered->collisionGeometry().get();
        engine->vertices.clear();
        engine->indices.clear();
        look_at(*engine, *offered->collisionGeometry(), *geometry);
        if (!is_placed(*offered)) {
            geometry->kind = 0;
            geometry->name = "a geometry with such a transform";
        }
        return TAHR_OK;
    });
}

tahr_status tahr__fcl_engine_adopt(tahr__fcl_engine *engine, uint32_t i, const tahr__fcl_geometry *geometry,
                                   const uint32_t *order)
{
    return guarded([&] {
        const Object *object = engine->offered[i];
        const Geometry &g = *object->collisionGeometry();
        Body body = {};
        body.object = object;
        bool is_model = g.getObjectType() == fcl::OT_BVH;
        if (is_model) {
            body.find = find_in_mesh(g, engine->desc.search == TAHR_FCL_COLLIDE);
            body.order.assign(order, order + geometry->triangle_count);
        } else if (geometry->kind == TAHR_BODY_MESH) {
            body.order.assign(order, order + geometry->triangle_count);
            body.all = true;
        } else if (geometry->kind == TAHR__FCL_OCTREE) {
            body.find = find_in_octree;
        }
        engine->index.emplace(object, static_cast<uint32_t>(engine->bodies.size()));
        engine->bodies.push_back(std::move(body));
        return TAHR_OK;
    });
}

void tahr__fcl_engine_pose(const tahr__fcl_engine *engine, uint32_t body, tahr_pose *pose, tahr__mat *turn)
{
    const fcl::Transform3<double> &t = engine->bodies[body].object->getTransform();
    fcl::Quaternion<double> q(t.linear());

    pose->position = {t.translation().x(), t.translation().y(), t.translation().z()};
    pose->orientation = {q.x(), q.y(), q.z(), q.w()};
    for (int i = 0; i < 3; i++)
        turn->row[i] = {t.linear()(i, 0), t.linear()(i, 1), t.linear()(i, 2)};
}

const void *tahr__fcl_engine_object_of(const tahr__fcl_engine *engine, uint32_t body)
{
    return engine->bodies[body].object;
}

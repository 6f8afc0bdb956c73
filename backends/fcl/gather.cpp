/* SPDX-License-Identifier: MIT
 * gather.cpp: what FCL finds: bodies by the AABB tree of its manager, triangles by the trees of its meshes. */
#include "engine_fcl.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>

using namespace tahr_fcl;

/* What FCL is asked about is larger by this (m, and relative): its own tests err by 1e-5 m where things touch, and the
 * asker looks at every part again. */
static const double SLACK = 1e-3;
static const double RELATIVE_SLACK = 1e-9;

/* A box as a volume of each kind, and which part of a node's volume is compared with it. AABB and KDOP grow by
 * points. */
template <class BV> struct Volume {
    BV bv;
    explicit Volume(const tahr_bounds &b) : bv(Vector(b.min.x, b.min.y, b.min.z))
    {
        for (int i = 1; i < 8; i++)
            bv += Vector(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z);
    }
    bool meets(const BV &node) const
    {
        return bv.overlap(node);
    }
};

static fcl::OBB<double> oriented(const tahr_bounds &b)
{
    Vector low(b.min.x, b.min.y, b.min.z), high(b.max.x, b.max.y, b.max.z);
    return fcl::OBB<double>(fcl::Matrix3<double>::Identity(), 0.5 * (low + high), 0.5 * (high - low));
}

template <> struct Volume<fcl::OBB<double>> {
    fcl::OBB<double> obb;
    explicit Volume(const tahr_bounds &b) : obb(oriented(b))
    {
    }
    bool meets(const fcl::OBB<double> &node) const
    {
        return obb.overlap(node);
    }
};

template <> struct Volume<fcl::OBBRSS<double>> : Volume<fcl::OBB<double>> {
    using Volume<fcl::OBB<double>>::Volume;
    bool meets(const fcl::OBBRSS<double> &node) const
    {
        return obb.overlap(node.obb);
    }
};

template <> struct Volume<fcl::kIOS<double>> : Volume<fcl::OBB<double>> {
    using Volume<fcl::OBB<double>>::Volume;
    bool meets(const fcl::kIOS<double> &node) const
    {
        return obb.overlap(node.obb);
    }
};

/* As deep as the tree, which FCL built by recursion too. */
template <class BV>
static void descend(const fcl::BVHModel<BV> &model, int at, const Volume<BV> &volume, const Sink &sink)
{
    for (;;) {
        const fcl::BVNode<BV> &node = model.getBV(at);
        if (!volume.meets(node.bv)) return;
        if (node.isLeaf()) {
            sink.triangle(node.primitiveId());
            return;
        }
        descend(model, node.leftChild(), volume, sink);
        at = node.rightChild();
    }
}

template <class BV> static void find_by_descent(const Geometry &geometry, const tahr_bounds &box, const Sink &sink)
{
    const auto &model = static_cast<const fcl::BVHModel<BV> &>(geometry);
    if (model.getNumBVs() > 0) descend(model, 0, Volume<BV>(box), sink);
}

/* The mesh comes first: FCL's answers are only reliable in that order. No contact points: a boolean per triangle. */
static void find_by_collide(const Geometry &geometry, const tahr_bounds &b, const Sink &sink)
{
    const fcl::Box<double> box(b.max.x - b.min.x, b.max.y - b.min.y, b.max.z - b.min.z);
    fcl::Transform3<double> at = fcl::Transform3<double>::Identity();
    fcl::CollisionRequest<double> request(static_cast<size_t>(INT32_MAX), false);
    fcl::CollisionResult<double> result;

    at.translation() << 0.5 * (b.min.x + b.max.x), 0.5 * (b.min.y + b.max.y), 0.5 * (b.min.z + b.max.z);
    fcl::collide<double>(&geometry, fcl::Transform3<double>::Identity(), &box, at, request, result);
    for (size_t i = 0; i < result.numContacts(); i++)
        sink.triangle(static_cast<int>(result.getContact(i).b1));
}

Find tahr_fcl::find_in_mesh(const Geometry &geometry, bool collide)
{
    switch (geometry.getNodeType()) {
    case fcl::BV_AABB: return find_by_descent<fcl::AABB<double>>;
    case fcl::BV_OBB: return collide ? find_by_collide : find_by_descent<fcl::OBB<double>>;
    case fcl::BV_RSS: return find_by_collide;
    case fcl::BV_kIOS: return collide ? find_by_collide : find_by_descent<fcl::kIOS<double>>;
    case fcl::BV_OBBRSS: return collide ? find_by_collide : find_by_descent<fcl::OBBRSS<double>>;
    case fcl::BV_KDOP16: return find_by_descent<fcl::KDOP<double, 16>>;
    case fcl::BV_KDOP18: return find_by_descent<fcl::KDOP<double, 18>>;
    case fcl::BV_KDOP24: return find_by_descent<fcl::KDOP<double, 24>>;
    default: return nullptr;
    }
}

static tahr_bounds grown(const tahr_bounds &b)
{
    auto grow = [](double x) { return SLACK + RELATIVE_SLACK * fabs(x); };
    return {{b.min.x - grow(b.min.x), b.min.y - grow(b.min.y), b.min.z - grow(b.min.z)},
            {b.max.x + grow(b.max.x), b.max.y + grow(b.max.y), b.max.z + grow(b.max.z)}};
}

/* The box that holds a world box in the frame of an object. */
static tahr_bounds local_box(const Object &object, const tahr_bounds &b)
{
    const fcl::Transform3<double> &t = object.getTransform();
    Vector low(b.min.x, b.min.y, b.min.z), high(b.max.x, b.max.y, b.max.z);
    Vector centre = t.linear().transpose() * (0.5 * (low + high) - t.translation());
    Vector half = t.linear().transpose().cwiseAbs() * (0.5 * (high - low));

    low = centre - half;
    high = centre + half;
    return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

namespace
{
struct Search {
    const tahr__fcl_engine *engine;
    const tahr__fcl_question *question;
    tahr__fcl_list *list;
    tahr_bounds box;
};
} // namespace

/* FCL calls it for every object whose bounds meet the query's. False: go on. */
static bool take(Object *object, Object *, void *data)
{
    const Search &s = *static_cast<Search *>(data);
    auto found = s.engine->index.find(object);

    if (found == s.engine->index.end()) return false;
    uint32_t i = found->second;
    if (s.question->wants && !s.question->wants(s.question->user, i)) return false;
    const Body &body = s.engine->bodies[i];
    tahr__fcl_part whole = {i, 0, {0, 0, 0}, 0};
    Sink sink = {s.list, i, body.order.empty() ? nullptr : &body.order};
    if (body.find)
        body.find(*object->collisionGeometry(), local_box(*object, s.box), sink);
    else if (body.all)
        for (size_t k = 0; k < body.order.size(); k++)
            sink.triangle(static_cast<int>(k));
    else
        tahr__fcl_list_add(s.list, &whole);
    return s.list->status < 0;
}

tahr_status tahr__fcl_engine_gather(const tahr__fcl_engine *engine, const tahr__fcl_question *question,
                                    tahr__fcl_list *list)
{
    return guarded([&] {
        Search search = {engine, question, list, grown(question->box)};
        const tahr_bounds &b = search.box;
        fcl::Box<double> box(b.max.x - b.min.x, b.max.y - b.min.y, b.max.z - b.min.z);
        /* Not owned, so that nothing is allocated. */
        std::shared_ptr<Geometry> borrowed(std::shared_ptr<void>(), &box);
        fcl::Transform3<double> at = fcl::Transform3<double>::Identity();
        at.translation() << 0.5 * (b.min.x + b.max.x), 0.5 * (b.min.y + b.max.y), 0.5 * (b.min.z + b.max.z);
        Object query(borrowed, at);
        engine->manager->collide(&query, &search, take);
        return list->status;
    });
}

namespace
{
struct Wish {
    const tahr__fcl_engine *engine;
    uint32_t body;
};
} // namespace

static int is_wished(const void *user, uint32_t body)
{
    return static_cast<const Wish *>(user)->body == body;
}

int tahr__fcl_engine_finds(const tahr__fcl_engine *engine, uint32_t body, uint32_t triangle, const tahr_vec3 *at)
{
    const Object &object = *engine->bodies[body].object;
    const fcl::AABB<double> &bounds = object.getAABB();
    Vector low = bounds.min_, high = bounds.max_;
    tahr__fcl_part room[64];
    tahr__fcl_list list;
    Wish wish = {engine, body};
    int found = 0;

    if (engine->bodies[body].find == find_in_octree) return 1; /* its cells were just listed */
    if (engine->bodies[body].find) low = high = object.getTransform() * Vector(at->x, at->y, at->z);
    tahr__fcl_question question = {{{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}}, is_wished, &wish};
    tahr__fcl_list_begin(&list, engine->host, room, 64);
    if (tahr__fcl_engine_gather(engine, &question, &list) < 0) list.count = 0;
    for (uint32_t i = 0; i < list.count; i++)
        found |= list.parts[i].body == body && list.parts[i].triangle == triangle;
    tahr__fcl_list_free(&list);
    return found;
}

/* SPDX-License-Identifier: MIT
 * engine_v2.cpp: what Box2D 2.4 does for the backend. */
#include "engine.h"

#include <algorithm>
#include <new>
#include <vector>

#include <box2d/box2d.h>

namespace
{

b2AABB aabb_of(const tahr__b2_box &box)
{
    b2AABB aabb;
    aabb.lowerBound.Set(tahr__b2_down(box.low.x), tahr__b2_down(box.low.y));
    aabb.upperBound.Set(tahr__b2_up(box.high.x), tahr__b2_up(box.high.y));
    return aabb;
}

void *tree_open()
{
    try {
        return new b2DynamicTree;
    } catch (const std::bad_alloc &) {
        return nullptr;
    }
}

void tree_close(void *tree)
{
    delete static_cast<b2DynamicTree *>(tree);
}

void *packed(uint32_t item)
{
    return reinterpret_cast<void *>(static_cast<uintptr_t>(item));
}

int32_t tree_add(void *tree, const tahr__b2_box *box, uint32_t item)
{
    return static_cast<b2DynamicTree *>(tree)->CreateProxy(aabb_of(*box), packed(item));
}

/* Not MoveProxy, which leaves a box where it is while it is inside its fat one: answers would come in an order that
 * depends on where a body was before. */
int32_t tree_move(void *tree, int32_t proxy, const tahr__b2_box *box, uint32_t item)
{
    static_cast<b2DynamicTree *>(tree)->DestroyProxy(proxy);
    return tree_add(tree, box, item);
}

struct tree_question {
    const b2DynamicTree *tree;
    tahr__b2_found_fn found;
    void *user;

    bool QueryCallback(int32 proxy)
    {
        found(user, static_cast<uint32_t>(reinterpret_cast<uintptr_t>(tree->GetUserData(proxy))));
        return true;
    }
};

void tree_ask(const void *tree, const tahr__b2_box *box, tahr__b2_found_fn found, void *user)
{
    tree_question q = {static_cast<const b2DynamicTree *>(tree), found, user};
    q.tree->Query(&q, aabb_of(*box));
}

uint32_t id_of(const tahr_box2d_desc *desc, b2Body *body)
{
    return desc->body_id ? desc->body_id(desc->user, body) : static_cast<uint32_t>(body->GetUserData().pointer);
}

b2World *world_of(const tahr_box2d_desc *desc)
{
    return static_cast<b2World *>(desc->world2);
}

const char *world_check(const tahr_box2d_desc *desc)
{
    try {
        std::vector<uint32_t> ids;
        for (b2Body *b = world_of(desc)->GetBodyList(); b; b = b->GetNext())
            ids.push_back(id_of(desc, b));
        std::sort(ids.begin(), ids.end());
        if (std::adjacent_find(ids.begin(), ids.end()) != ids.end())
            return "options.world2: two bodies have one number (b2BodyUserData.pointer, or options.body_id)";
        return !ids.empty() && ids.back() == TAHR_NO_BODY ? "options.world2: the number of a body is TAHR_NO_BODY"
                                                          : nullptr;
    } catch (const std::exception &) {
        return "options.world2: no memory";
    }
}

/* One fixture, or one segment of a chain, on its way into a piece. */
struct world_question {
    const tahr_box2d_desc *desc;
    const tahr__b2_search *search;
    const b2BroadPhase *tree;

    bool QueryCallback(int32 proxy)
    {
        const auto *p = static_cast<const b2FixtureProxy *>(tree->GetUserData(proxy));
        take(p->fixture, p->childIndex);
        return true;
    }

    tahr__vec2 place(const b2Transform &xf, const b2Vec2 &v) const
    {
        double c = xf.q.c, s = xf.q.s, x = v.x, y = v.y;
        double px = static_cast<double>(xf.p.x) - search->origin.x, py = static_cast<double>(xf.p.y) - search->origin.y;
        return f_make(px + (c * x - s * y), py + (s * x + c * y));
    }

    void set_segment(tahr__b2_piece &piece, const b2Transform &xf, const b2Vec2 &a, const b2Vec2 &b) const
    {
        piece.flat.count = 2;
        piece.flat.corner[0] = place(xf, a);
        piece.flat.corner[1] = place(xf, b);
    }

    /* Of one-sided edges: the ghosts say where the line goes on. */
    void set_edge(tahr__b2_piece &piece, const b2Transform &xf, const b2EdgeShape &edge) const
    {
        set_segment(piece, xf, edge.m_vertex1, edge.m_vertex2);
        piece.flat.one_sided = edge.m_oneSided && !(piece.owner.flags & TAHR_BODY_TWO_SIDED);
        piece.flat.lone = !edge.m_oneSided;
        if (!edge.m_oneSided) return;
        piece.ghosts = TAHR__B2_GHOST_BEFORE | TAHR__B2_GHOST_AFTER;
        piece.before = place(xf, edge.m_vertex0);
        piece.after = place(xf, edge.m_vertex3);
    }

    /* Polygons, edges and chains have a radius too: Box2D's skin, which is none of their geometry. */
    bool set_shape(tahr__b2_piece &piece, const b2Transform &xf, const b2Shape &shape, int32 child) const
    {
        piece.flat.radius = 0;
        piece.flat.one_sided = 0;
        piece.flat.lone = 1;
        switch (shape.GetType()) {
        case b2Shape::e_circle:
            piece.flat.count = 1;
            piece.flat.radius = shape.m_radius;
            piece.flat.corner[0] = place(xf, static_cast<const b2CircleShape &>(shape).m_p);
            return true;
        case b2Shape::e_edge: set_edge(piece, xf, static_cast<const b2EdgeShape &>(shape)); return true;
        case b2Shape::e_polygon: {
            const auto &polygon = static_cast<const b2PolygonShape &>(shape);
            piece.flat.count = polygon.m_count;
            for (int32 i = 0; i < polygon.m_count; i++)
                piece.flat.corner[i] = place(xf, polygon.m_vertices[i]);
            return true;
        }
        case b2Shape::e_chain: {
            b2EdgeShape edge;
            static_cast<const b2ChainShape &>(shape).GetChildEdge(&edge, child);
            set_edge(piece, xf, edge);
            return true;
        }
        default: return false;
        }
    }

    /* Fixtures of a body are told apart by their order in it. */
    static uint32_t ordinal_of(const b2Fixture *fixture)
    {
        uint32_t after = 0;
        for (const b2Fixture *f = fixture->GetNext(); f; f = f->GetNext())
            after++;
        return after;
    }

    void take(b2Fixture *fixture, int32 child)
    {
        const b2Filter &filter = fixture->GetFilterData();
        b2Body *body = fixture->GetBody();
        const uint32_t id = id_of(desc, body);
        tahr_box2d_shape told = {};
        tahr__b2_piece piece;

        if (!tahr__b2_filter(desc, filter.categoryBits, filter.maskBits, filter.groupIndex)) return;
        told.shape = fixture;
        told.body = id;
        told.flags = fixture->IsSensor() ? static_cast<uint32_t>(TAHR_BODY_SENSOR) : 0u;
        if (desc->shape) desc->shape(desc->user, &told);
        if (told.hidden) return;
        piece.owner = {id, told.flags, filter.categoryBits, told.surface, told.walkable_rule, 0, told.walkable_angle};
        piece.feature = ordinal_of(fixture) << 16 | static_cast<uint32_t>(child);
        piece.is_box = 0;
        piece.ghosts = TAHR__B2_NO_GHOST;
        if (set_shape(piece, body->GetTransform(), *fixture->GetShape(), child)) search->take(search->user, &piece);
    }
};

void world_ask(const tahr_box2d_desc *desc, const tahr__b2_search *search)
{
    const b2BroadPhase &tree = world_of(desc)->GetContactManager().m_broadPhase;
    world_question q = {desc, search, &tree};
    tree.Query(&q, aabb_of(search->box));
}

tahr_status world_motion(const tahr_box2d_desc *desc, uint32_t id, tahr_body_motion *motion)
{
    b2Body *body = world_of(desc)->GetBodyList();

    while (body && (id_of(desc, body) != id || !body->IsEnabled()))
        body = body->GetNext();
    if (!body) return TAHR_E_NOT_FOUND;
    const b2Transform &xf = body->GetTransform();
    const b2Vec2 speed = body->GetLinearVelocityFromLocalPoint(b2Vec2(0.0f, 0.0f));
    motion->pose.position = {xf.p.x, xf.p.y, 0};
    motion->pose.orientation = tahr__b2_quat(xf.q.c, xf.q.s);
    motion->flags = body->GetType() == b2_staticBody ? static_cast<uint32_t>(TAHR_BODY_NO_BASE) : 0u;
    if (body->GetType() == b2_staticBody) return TAHR_OK;
    motion->velocity = {speed.x, speed.y, 0};
    motion->angular_velocity = {0, 0, body->GetAngularVelocity()};
    motion->mass = body->GetType() == b2_dynamicBody ? static_cast<double>(body->GetMass()) : 0;
    return TAHR_OK;
}

} // namespace

extern "C" const tahr__b2_engine tahr__b2_engine_2 = {"2.4",    tree_open,   tree_close, tree_add,    tree_move,
                                                      tree_ask, world_check, world_ask,  world_motion};

/* SPDX-License-Identifier: MIT
 * yard_2.cpp: see yard.h; Box2D 2.4. */
#include "yard.h"

#include <box2d/box2d.h>

#include <vector>

namespace
{

struct place {
    b2World world{b2Vec2(0, 0)};
    uint32_t next = 0;
};

void *open()
{
    return new place;
}

void close(void *world)
{
    delete static_cast<place *>(world);
}

void attach(void *world, tahr_box2d_desc *options)
{
    options->world2 = &static_cast<place *>(world)->world;
}

b2Body *find(void *world, uint32_t id)
{
    for (b2Body *b = static_cast<place *>(world)->world.GetBodyList(); b; b = b->GetNext())
        if (b->GetUserData().pointer == id) return b;
    return nullptr;
}

void put(b2Body *body, b2FixtureDef def, const b2Shape &shape)
{
    def.shape = &shape;
    def.density = 1;
    body->CreateFixture(&def);
}

float f(double x)
{
    return static_cast<float>(x);
}

void put_shape(b2Body *body, const b2FixtureDef &def, const yard_body *y)
{
    b2PolygonShape box;
    b2CircleShape circle;
    b2EdgeShape edge;
    b2ChainShape chain;
    std::vector<b2Vec2> corners;

    switch (y->shape) {
    case YARD_BOX:
        box.SetAsBox(f(y->a), f(y->b));
        put(body, def, box);
        break;
    case YARD_CIRCLE:
        circle.m_radius = f(y->a);
        put(body, def, circle);
        break;
    case YARD_EDGE:
        edge.SetTwoSided(b2Vec2(-f(y->a), 0), b2Vec2(f(y->a), 0));
        put(body, def, edge);
        break;
    default:
        for (int i = 0; i < y->corner_count; i++)
            corners.emplace_back(f(y->corners[2 * i]), f(y->corners[2 * i + 1]));
        chain.CreateChain(corners.data() + 1, y->corner_count - 2, corners.front(), corners.back());
        put(body, def, chain);
    }
}

uint32_t add(void *world, const yard_body *y)
{
    place *p = static_cast<place *>(world);
    const b2BodyType types[] = {b2_staticBody, b2_kinematicBody, b2_dynamicBody};
    b2BodyDef def;
    b2FixtureDef fixture;
    def.type = types[y->type];
    def.position.Set(f(y->x), f(y->y));
    def.angle = f(y->angle);
    def.userData.pointer = p->next;
    fixture.isSensor = y->sensor != 0;
    fixture.filter.categoryBits = static_cast<uint16>(y->category ? y->category : 1);
    fixture.filter.maskBits = static_cast<uint16>(y->mask ? y->mask : 0xFFFF);
    fixture.filter.groupIndex = static_cast<int16>(y->group);
    put_shape(p->world.CreateBody(&def), fixture, y);
    return p->next++;
}

void remove(void *world, uint32_t id)
{
    static_cast<place *>(world)->world.DestroyBody(find(world, id));
}

void drive(void *world, uint32_t id, double vx, double vy, double turn)
{
    find(world, id)->SetLinearVelocity(b2Vec2(f(vx), f(vy)));
    find(world, id)->SetAngularVelocity(f(turn));
}

void step(void *world, double dt)
{
    static_cast<place *>(world)->world.Step(f(dt), 8, 3);
}

void where(void *world, uint32_t id, double at[3])
{
    b2Body *b = find(world, id);
    at[0] = static_cast<double>(b->GetPosition().x);
    at[1] = static_cast<double>(b->GetPosition().y);
    at[2] = static_cast<double>(b->GetAngle());
}

} // namespace

const yard yard_2 = {"2.4", 0, open, close, attach, add, remove, drive, step, where};

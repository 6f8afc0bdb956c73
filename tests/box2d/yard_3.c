/* SPDX-License-Identifier: MIT
 * yard_3.c: see yard.h; Box2D 3. */
#include "yard.h"

#include <math.h>
#include <stdlib.h>

#include <box2d/box2d.h>

enum { MOST = 256 };

typedef struct place {
    b2WorldId world;
    b2BodyId bodies[MOST];
    int count;
} place;

static void *open_yard(void)
{
    place *p = calloc(1, sizeof *p);
    b2WorldDef def = b2DefaultWorldDef();
    def.gravity = (b2Vec2){0, 0};
    p->world = b2CreateWorld(&def);
    return p;
}

static void close_yard(void *world)
{
    b2DestroyWorld(((place *)world)->world);
    free(world);
}

static void attach(void *world, tahr_box2d_desc *options)
{
    options->world3 = b2StoreWorldId(((place *)world)->world);
}

/* As tahr/box2d.h says. */
static uint32_t id_of(b2BodyId body)
{
    return (uint32_t)(body.index1 - 1) | (uint32_t)(body.generation & 0xFFF) << 20;
}

static b2BodyId find(void *world, uint32_t id)
{
    place *p = world;
    for (int i = p->count - 1; i > 0; i--) {
        if (id_of(p->bodies[i]) == id) {
            return p->bodies[i];
        }
    }
    return p->bodies[0];
}

static void put_chain(b2BodyId body, const yard_body *y, b2Filter filter)
{
    b2Vec2 corners[64];
    b2ChainDef def = b2DefaultChainDef();
    for (int i = 0; i < y->corner_count; i++) {
        corners[i] = (b2Vec2){(float)y->corners[2 * i], (float)y->corners[2 * i + 1]};
    }
    def.points = corners;
    def.count = y->corner_count;
    def.filter = filter;
    b2CreateChain(body, &def);
}

static void put_shape(b2BodyId body, const b2ShapeDef *def, const yard_body *y)
{
    float a = (float)y->a, b = (float)y->b;
    b2Polygon box = b2MakeBox(a, y->shape == YARD_BOX ? b : a);
    b2Circle circle = {{0, 0}, a};
    b2Capsule capsule = {{0, -a}, {0, a}, b};
    b2Segment segment = {{-a, 0}, {a, 0}};
    switch (y->shape) {
    case YARD_BOX: b2CreatePolygonShape(body, def, &box); break;
    case YARD_CIRCLE: b2CreateCircleShape(body, def, &circle); break;
    case YARD_CAPSULE: b2CreateCapsuleShape(body, def, &capsule); break;
    case YARD_EDGE: b2CreateSegmentShape(body, def, &segment); break;
    default: put_chain(body, y, def->filter);
    }
}

static uint32_t add(void *world, const yard_body *y)
{
    const b2BodyType types[] = {b2_staticBody, b2_kinematicBody, b2_dynamicBody};
    place *p = world;
    b2BodyDef def = b2DefaultBodyDef();
    b2ShapeDef shape = b2DefaultShapeDef();
    def.type = types[y->type];
    def.position.x = (float)y->x;
    def.position.y = (float)y->y;
    def.rotation = b2MakeRot((float)y->angle);
    shape.isSensor = y->sensor != 0;
    shape.filter.categoryBits = y->category ? y->category : 1;
    shape.filter.maskBits = y->mask ? y->mask : ~(uint64_t)0;
    shape.filter.groupIndex = y->group;
    b2BodyId body = b2CreateBody(p->world, &def);
    put_shape(body, &shape, y);
    p->bodies[p->count++] = body;
    return id_of(body);
}

static void remove_body(void *world, uint32_t id)
{
    b2DestroyBody(find(world, id));
}

static void drive(void *world, uint32_t id, double vx, double vy, double turn)
{
    b2Body_SetLinearVelocity(find(world, id), (b2Vec2){(float)vx, (float)vy});
    b2Body_SetAngularVelocity(find(world, id), (float)turn);
}

static void step(void *world, double dt)
{
    b2World_Step(((place *)world)->world, (float)dt, 4);
}

static void where(void *world, uint32_t id, double at[3])
{
    at[0] = (double)b2Body_GetPosition(find(world, id)).x;
    at[1] = (double)b2Body_GetPosition(find(world, id)).y;
    b2Rot q = b2Body_GetRotation(find(world, id)); /* its own arc tangent is good to 1e-4 */
    at[2] = atan2((double)q.s, (double)q.c);
}

const yard yard_3 = {"3", 1, open_yard, close_yard, attach, add, remove_body, drive, step, where};

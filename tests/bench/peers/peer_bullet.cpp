/* SPDX-License-Identifier: MIT
 * peer_bullet.cpp: Bullet's btKinematicCharacterController. Its step down looks at y whatever up is set to, so it gets
 * the frame that it was written for: (x, y, z) here is (x, z, -y) there. */
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletCollisionCommon.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "peer.h"

namespace
{

struct character {
    std::unique_ptr<btPairCachingGhostObject> ghost;
    std::unique_ptr<btKinematicCharacterController> controller;
};

struct crowd {
    std::vector<btScalar> vertices;
    std::vector<int> indices;
    std::unique_ptr<btTriangleIndexVertexArray> triangles;
    std::unique_ptr<btCollisionShape> level_shape;
    std::unique_ptr<btConvexShape> shape;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btGhostPairCallback ghost_pairs;
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};
    btCollisionObject level;
    std::vector<character> characters;
    btScalar dt;

    ~crowd()
    {
        for (character &one : characters) {
            world.removeCollisionObject(one.ghost.get());
        }
        world.removeCollisionObject(&level);
    }
};

btVector3 to_bullet(const double v[3])
{
    return btVector3(btScalar(v[0]), btScalar(v[2]), btScalar(-v[1]));
}

void from_bullet(const btVector3 &v, double out[3])
{
    out[0] = double(v.x());
    out[1] = -double(v.z());
    out[2] = double(v.y());
}

void make_mesh(crowd *c, const method_level *level)
{
    for (uint32_t i = 0; i < level->vertex_count; i++) {
        btVector3 v = to_bullet(level->vertices + 3 * size_t(i));
        c->vertices.insert(c->vertices.end(), {v.x(), v.y(), v.z()});
    }
    c->indices.assign(level->indices, level->indices + 3 * size_t(level->triangle_count));
    c->triangles.reset(new btTriangleIndexVertexArray(int(level->triangle_count), c->indices.data(), 3 * sizeof(int),
                                                      int(level->vertex_count), c->vertices.data(),
                                                      3 * sizeof(btScalar)));
    c->level_shape.reset(new btBvhTriangleMeshShape(c->triangles.get(), true));
}

void build(crowd *c, const method_level *level)
{
    c->world.getDispatchInfo().m_allowedCcdPenetration = btScalar(0.0001); /* as its demo; the default lets sink 4 cm */
    c->broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&c->ghost_pairs);
    if (level->box) {
        c->level_shape.reset(new btStaticPlaneShape(btVector3(0, 1, 0), btScalar(level->box[5])));
    } else {
        make_mesh(c, level);
    }
    c->level.setCollisionShape(c->level_shape.get());
    c->world.addCollisionObject(&c->level, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::CharacterFilter);
}

void add(crowd *c, const method_character *who)
{
    character one;
    one.ghost.reset(new btPairCachingGhostObject());
    one.ghost->setCollisionShape(c->shape.get());
    one.ghost->setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    c->world.addCollisionObject(one.ghost.get(), btBroadphaseProxy::CharacterFilter, btBroadphaseProxy::StaticFilter);
    one.controller.reset(new btKinematicCharacterController(one.ghost.get(), c->shape.get(), btScalar(who->step_height),
                                                            btVector3(0, 1, 0)));
    one.controller->setGravity(btVector3(0, btScalar(-who->gravity), 0));
    one.controller->setJumpSpeed(btScalar(who->jump_speed));
    one.controller->setMaxSlope(btScalar(who->walkable_angle));
    c->characters.push_back(std::move(one));
}

void *open_crowd(const method *, const method_level *level, const method_character *who, uint32_t count, char *error)
{
    if (level->planar) {
        snprintf(error, METHOD_ERROR, "three dimensions only");
        return nullptr;
    }
    std::unique_ptr<crowd> c(new crowd);
    c->dt = btScalar(who->dt);
    c->shape.reset(new btCapsuleShape(btScalar(who->radius), btScalar(2 * (who->half_height - who->radius))));
    build(c.get(), level);
    for (uint32_t i = 0; i < count; i++) {
        add(c.get(), who);
    }
    return c.release();
}

void close_crowd(void *self)
{
    delete static_cast<crowd *>(self);
}

/* setUp and setGravity have turned the ghost from z to y: the whole transform is set again, not only its origin. */
void place(void *self, uint32_t i, const double position[3])
{
    crowd *c = static_cast<crowd *>(self);
    character &one = c->characters[i];
    one.controller->reset(&c->world);
    one.ghost->setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(position)));
    c->world.updateSingleAabb(one.ghost.get());
}

void step(void *self, uint32_t i, const double wish[3], int jump)
{
    crowd *c = static_cast<crowd *>(self);
    btKinematicCharacterController *controller = c->characters[i].controller.get();
    controller->setWalkDirection(to_bullet(wish) * c->dt);
    if (jump && controller->canJump()) {
        controller->jump();
    }
    controller->updateAction(&c->world, c->dt);
}

void look(void *self, uint32_t i, method_place *out)
{
    const character &one = static_cast<crowd *>(self)->characters[i];
    from_bullet(one.ghost->getWorldTransform().getOrigin(), out->position);
    from_bullet(one.controller->getLinearVelocity(), out->velocity);
    out->grounded = one.controller->onGround();
    out->queries = 0;
}

} // namespace

PEER_EXPORT const method *method_bullet()
{
    static const method m = {"bullet",
                             PEER_VERSION,
                             "btKinematicCharacterController with its defaults (0.2 m of penetration left alone) and "
                             "the demo's allowed penetration of 0.1 mm; walk directions; triangle mesh with quantised BVH, plane "
                             "as btStaticPlaneShape; the distribution's build: single precision, SSE2",
                             open_crowd,
                             close_crowd,
                             place,
                             step,
                             look,
                             nullptr};
    return &m;
}

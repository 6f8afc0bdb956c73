/* SPDX-License-Identifier: MIT
 * peer_jolt.cpp: Jolt's CharacterVirtual, moved by ExtendedUpdate the way Jolt's own character sample does it. Jolt has y
 * up, the courses z: (x, y, z) here is (x, z, -y) there. */
#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Character/CharacterVirtual.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/Physics/Collision/Shape/RotatedTranslatedShape.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "peer.h"

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

namespace
{

/* As large as in Jolt's samples: contacts of one update, not of all characters. */
constexpr JPH::uint SCRATCH = 10 * 1024 * 1024;

class one_broad_layer final : public JPH::BroadPhaseLayerInterface
{
  public:
    JPH::uint GetNumBroadPhaseLayers() const override
    {
        return 1;
    }
    JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer) const override
    {
        return JPH::BroadPhaseLayer(0);
    }
#if defined(JPH_EXTERNAL_PROFILE) || defined(JPH_PROFILE_ENABLED)
    const char *GetBroadPhaseLayerName(JPH::BroadPhaseLayer) const override
    {
        return "level";
    }
#endif
};

/* Jolt's tables of types are global: made with the first world, dropped with the last. */
struct types {
    types()
    {
        if (users++ == 0) {
            JPH::RegisterDefaultAllocator();
            JPH::Factory::sInstance = new JPH::Factory();
            JPH::RegisterTypes();
        }
    }
    ~types()
    {
        if (--users == 0) {
            JPH::UnregisterTypes();
            delete JPH::Factory::sInstance;
            JPH::Factory::sInstance = nullptr;
        }
    }
    types(const types &) = delete;
    types &operator=(const types &) = delete;
    static int users;
};
int types::users = 0;

struct crowd {
    types registered; /* first: everything else needs it */
    one_broad_layer layers;
    JPH::ObjectVsBroadPhaseLayerFilter all_layers;
    JPH::ObjectLayerPairFilter all_pairs;
    JPH::TempAllocatorImpl scratch{SCRATCH};
    JPH::PhysicsSystem system;
    JPH::CharacterVirtual::ExtendedUpdateSettings update;
    std::vector<JPH::Ref<JPH::CharacterVirtual>> characters;
    float dt, jump_speed, to_centre; /* to_centre: from what Jolt calls the character's position, with the padding */
};

JPH::Vec3 to_jolt(const double v[3])
{
    return JPH::Vec3(float(v[0]), float(v[2]), float(-v[1]));
}

void from_jolt(JPH::Vec3Arg v, double out[3])
{
    out[0] = v.GetX();
    out[1] = -v.GetZ();
    out[2] = v.GetY();
}

JPH::ShapeSettings::ShapeResult make_mesh(const method_level *level)
{
    JPH::VertexList vertices;
    JPH::IndexedTriangleList triangles;
    for (uint32_t i = 0; i < level->vertex_count; i++) {
        JPH::Float3 v;
        to_jolt(level->vertices + 3 * size_t(i)).StoreFloat3(&v);
        vertices.push_back(v);
    }
    for (uint32_t i = 0; i < level->triangle_count; i++) {
        const uint32_t *t = level->indices + 3 * size_t(i);
        triangles.push_back(JPH::IndexedTriangle(t[0], t[1], t[2]));
    }
    JPH::MeshShapeSettings settings(vertices, triangles);
    settings.mMaxTrianglesPerLeaf = 4; /* Jolt's documentation: faster, 8 is smaller */
    return settings.Create();
}

/* The middle of a box, in Jolt's frame, and its shape. */
JPH::ShapeSettings::ShapeResult make_box(const double box[6], JPH::Vec3 &middle)
{
    JPH::Vec3 low = to_jolt(box), high = to_jolt(box + 3);
    middle = 0.5f * (low + high);
    return JPH::BoxShapeSettings((0.5f * (high - low)).Abs()).Create();
}

bool build(crowd *c, const method_level *level, char *error)
{
    JPH::Vec3 middle = JPH::Vec3::sZero();
    JPH::ShapeSettings::ShapeResult shape = level->box ? make_box(level->box, middle) : make_mesh(level);
    if (shape.HasError()) {
        snprintf(error, METHOD_ERROR, "%s", shape.GetError().c_str());
        return false;
    }
    c->system.Init(1, 0, 1, 1, c->layers, c->all_layers, c->all_pairs);
    JPH::BodyCreationSettings body(shape.Get(), middle, JPH::Quat::sIdentity(), JPH::EMotionType::Static, 0);
    JPH::BodyInterface &bodies = c->system.GetBodyInterface();
    if (bodies.CreateAndAddBody(body, JPH::EActivation::DontActivate).IsInvalid()) {
        snprintf(error, METHOD_ERROR, "no body for the level");
        return false;
    }
    c->system.OptimizeBroadPhase();
    return true;
}

void populate(crowd *c, const method_character *who, uint32_t count)
{
    JPH::CharacterVirtualSettings settings;
    float radius = float(who->radius), core = float(who->half_height - who->radius);
    c->to_centre = float(who->half_height) + settings.mCharacterPadding;
    c->jump_speed = float(who->jump_speed);
    c->dt = float(who->dt);
    settings.mShape = JPH::RotatedTranslatedShapeSettings(JPH::Vec3(0, float(who->half_height), 0), JPH::Quat::sIdentity(),
                                                          new JPH::CapsuleShape(core, radius))
                          .Create()
                          .Get();
    settings.mMaxSlopeAngle = float(who->walkable_angle);
    settings.mSupportingVolume = JPH::Plane(JPH::Vec3::sAxisY(), -radius); /* of the lower sphere only, as the sample */
    c->update.mWalkStairsStepUp = JPH::Vec3(0, float(who->step_height), 0);
    c->system.SetGravity(JPH::Vec3(0, float(-who->gravity), 0));
    for (uint32_t i = 0; i < count; i++) {
        c->characters.push_back(
            new JPH::CharacterVirtual(&settings, JPH::RVec3::sZero(), JPH::Quat::sIdentity(), 0, &c->system));
    }
}

void *open_crowd(const method *, const method_level *level, const method_character *who, uint32_t count, char *error)
{
    if (level->planar) {
        snprintf(error, METHOD_ERROR, "three dimensions only");
        return nullptr;
    }
    std::unique_ptr<crowd> c(new crowd);
    if (!build(c.get(), level, error)) {
        return nullptr;
    }
    populate(c.get(), who, count);
    return c.release();
}

void close_crowd(void *self)
{
    delete static_cast<crowd *>(self);
}

void refresh(crowd *c, JPH::CharacterVirtual *character)
{
    character->RefreshContacts(c->system.GetDefaultBroadPhaseLayerFilter(0), c->system.GetDefaultLayerFilter(0), {}, {},
                               c->scratch);
}

void place(void *self, uint32_t i, const double position[3])
{
    crowd *c = static_cast<crowd *>(self);
    JPH::CharacterVirtual *character = c->characters[i];
    character->SetPosition(to_jolt(position) - JPH::Vec3(0, c->to_centre, 0));
    character->SetLinearVelocity(JPH::Vec3::sZero());
    refresh(c, character);
}

/* On ground it takes the ground's velocity and forgets its own fall; in the air it keeps its fall. The wish is the level
 * velocity in both cases. */
void step(void *self, uint32_t i, const double wish[3], int jump)
{
    crowd *c = static_cast<crowd *>(self);
    JPH::CharacterVirtual *character = c->characters[i];
    character->UpdateGroundVelocity();
    JPH::Vec3 up = character->GetUp(), ground = character->GetGroundVelocity();
    JPH::Vec3 rise = character->GetLinearVelocity().Dot(up) * up, velocity = rise;
    bool towards = rise.GetY() - ground.GetY() < 0.1f; /* the sample's limit for having left the ground */
    if (character->GetGroundState() == JPH::CharacterBase::EGroundState::OnGround && towards) {
        velocity = ground + (jump ? c->jump_speed : 0.0f) * up;
    }
    velocity += c->dt * c->system.GetGravity() + to_jolt(wish);
    character->SetLinearVelocity(velocity);
    character->ExtendedUpdate(c->dt, c->system.GetGravity(), c->update, c->system.GetDefaultBroadPhaseLayerFilter(0),
                              c->system.GetDefaultLayerFilter(0), {}, {}, c->scratch);
}

void look(void *self, uint32_t i, method_place *out)
{
    const JPH::CharacterVirtual *character = static_cast<crowd *>(self)->characters[i];
    from_jolt(JPH::Vec3(character->GetCenterOfMassTransform().GetTranslation()), out->position);
    from_jolt(character->GetLinearVelocity(), out->velocity);
    out->grounded = character->GetGroundState() == JPH::CharacterBase::EGroundState::OnGround;
    out->queries = 0;
}

} // namespace

PEER_EXPORT const method *method_jolt()
{
    static const method m = {
        "jolt",
        TEXT(JPH_VERSION_MAJOR) "." TEXT(JPH_VERSION_MINOR) "." TEXT(JPH_VERSION_PATCH),
        "CharacterVirtual::ExtendedUpdate with the defaults of its settings (padding 0.02, "
        "predictive distance 0.1, stick to floor 0.5) and the sample's loop and supporting volume; 4 "
        "triangles a leaf, "
        "plane as a box; single precision, AVX2, no profiler",
        open_crowd,
        close_crowd,
        place,
        step,
        look,
        nullptr};
    return &m;
}

/* SPDX-License-Identifier: MIT
 * bullet_playground.cpp: Tahr over a Bullet world, an engine that Tahr has no backend for, in two ways: through
 * Bullet's convex sweeps (tahr_callbacks), and through the triangles that Bullet finds in a box
 * (tahr_native_desc.gather). Both walk the same course: bullet_course.h. The game that they walk in, as a user would
 * have it: bullet_game.h.
 *
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     c++ -std=c++17 bullet_playground.cpp $(pkg-config --cflags --libs tahr bullet) -o bullet_playground
 *     ./bullet_playground               a part of the bundled playground: stairs, a ramp, a thin wall
 *     ./bullet_playground FILE.obj      all of it, from `tahr level playground.obj >FILE.obj` */
#include <tahr/native.h>

#include "bullet_course.h"
#include "bullet_game.h"

namespace
{

btVector3 to_bullet(const tahr_vec3 &v)
{
    return btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z));
}

tahr_vec3 to_tahr(const btVector3 &v)
{
    return {double(v.x()), double(v.y()), double(v.z())};
}

btTransform upright_at(const btVector3 &at)
{
    return btTransform(btQuaternion::getIdentity(), at);
}

btCapsuleShapeZ capsule_of(const tahr_shape &s)
{
    return btCapsuleShapeZ(btScalar(s.radius), btScalar(2 * (s.half_height - s.radius)));
}

/* ---- The first way: Bullet's sweeps. ---- */

/* Of two directions: does the first go into what the second comes out of? Along it is not into it. */
bool opposed(const btVector3 &way, const btVector3 &normal)
{
    return normal.dot(way) < btScalar(-1e-4) * way.length();
}

/* The first hit that a motion goes into: what it leaves or glides along is none. */
struct first_opposed : btCollisionWorld::ClosestConvexResultCallback {
    using ClosestConvexResultCallback::ClosestConvexResultCallback;

    btScalar addSingleResult(btCollisionWorld::LocalConvexResult &hit, bool in_world) override
    {
        if (!opposed(m_convexToWorld - m_convexFromWorld, hit.m_hitNormalLocal)) return 1;
        return ClosestConvexResultCallback::addSingleResult(hit, in_world);
    }
};

tahr_status bullet_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    auto *game = static_cast<bullet_game *>(user);
    btCapsuleShapeZ capsule = capsule_of(q->shape);
    btSphereShape sphere(btScalar(q->shape.radius)); /* of the rays that Tahr derives */
    btConvexShape *shape = &sphere;
    if (q->shape.type == TAHR_SHAPE_CAPSULE) shape = &capsule;
    btVector3 from = to_bullet(q->position), way = to_bullet(q->motion);

    /* Where it stands: with TAHR_CALLBACKS_NO_MARGIN a capsule that has come larger by the skin is often in the floor
     * by a fraction of a millimetre. */
    deepest overlap = game->overlap(*shape, upright_at(from));
    if (overlap.distance < 0 && (opposed(way, overlap.normal) || !(q->flags & TAHR_SWEEP_LEAVE_OVERLAP))) {
        hit->start_overlap = 1;
        hit->depth = -double(overlap.distance);
        hit->normal = to_tahr(overlap.normal);
        hit->body = uint32_t(overlap.body);
        return TAHR_OK;
    }
    if (way.length() == 0) return TAHR_OK;
    /* What the motion leaves is left at once, so that the sweep begins outside of it. */
    if (overlap.distance < 0) from += overlap.normal * (btScalar(1e-4) - overlap.distance);
    first_opposed found(from, from + way);
    game->world.convexSweepTest(shape, upright_at(from), upright_at(from + way), found);
    if (!found.hasHit()) return TAHR_OK;
    hit->blocking = 1;
    hit->fraction = double(found.m_closestHitFraction);
    hit->normal = to_tahr(found.m_hitNormalWorld.normalized());
    hit->point = to_tahr(found.m_hitPointWorld);
    hit->body = uint32_t(found.m_hitCollisionObject->getUserIndex());
    return TAHR_OK;
}

tahr_world *open_on_sweeps(bullet_game &game)
{
    tahr_world *world = nullptr;
    tahr_callbacks callbacks{};
    callbacks.struct_size = sizeof callbacks;
    callbacks.flags = TAHR_CALLBACKS_NO_MARGIN; /* Bullet's sweeps know of no margin */
    callbacks.user = &game;
    callbacks.sweep = bullet_sweep;
    return tahr_world_open_callbacks(&callbacks, nullptr, &world) < 0 ? nullptr : world;
}

/* ---- The second way: the triangles in a box. ---- */

struct hand_over : btTriangleCallback {
    tahr_gather *out = nullptr;
    uint32_t body = 0;
    btVector3 at{0, 0, 0};

    void processTriangle(btVector3 *corners, int, int index) override
    {
        tahr_triangle t{};
        for (int i = 0; i < 3; i++) {
            t.corners[i] = to_tahr(corners[i] + at);
        }
        t.body = body;
        t.feature = uint32_t(index);
        t.flags = TAHR_BODY_TWO_SIDED; /* as it is for Bullet */
        out->add(out, &t);
    }
};

/* The twelve triangles of a box: bits of the number of a corner say where it has the negative x, y and z. */
void hand_over_box(hand_over &to, const btBoxShape &box)
{
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int f = 0; f < 6; f++) {
        btVector3 v[4];
        for (int k = 0; k < 4; k++) {
            box.getVertex(faces[f][k], v[k]);
        }
        btVector3 halves[2][3] = {{v[0], v[2], v[1]}, {v[0], v[3], v[2]}};
        to.processTriangle(halves[0], 0, 2 * f);
        to.processTriangle(halves[1], 0, 2 * f + 1);
    }
}

tahr_status bullet_gather(void *user, const tahr_bounds *box, uint32_t, tahr_gather *out)
{
    hand_over to;
    to.out = out;
    for (const auto &object : static_cast<bullet_game *>(user)->objects) {
        btVector3 low, high, min = to_bullet(box->min), max = to_bullet(box->max);
        const btCollisionShape *shape = object->getCollisionShape();
        shape->getAabb(object->getWorldTransform(), low, high);
        if (!TestAabbAgainstAabb2(low, high, min, max)) continue;
        to.body = uint32_t(object->getUserIndex());
        to.at = object->getWorldTransform().getOrigin();
        if (shape->isConcave()) {
            static_cast<const btConcaveShape *>(shape)->processAllTriangles(&to, min - to.at, max - to.at);
        } else {
            hand_over_box(to, *static_cast<const btBoxShape *>(shape));
        }
    }
    return TAHR_OK;
}

tahr_world *open_on_triangles(bullet_game &game)
{
    tahr_world *world = nullptr;
    tahr_native_desc native{};
    native.struct_size = sizeof native;
    native.gather = bullet_gather;
    native.gather_user = &game;
    tahr_world_desc scene;
    tahr_world_desc_init(&scene, sizeof scene);
    scene.options = &native;
    return tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0 ? nullptr : world;
}

} // namespace

int main(int count, char **arguments)
{
    bullet_game game;
    if (count < 2) {
        game.build();
    } else if (!game.read(arguments[1])) {
        std::fprintf(stderr, "%s: no triangles\n", arguments[1]);
        return 2;
    }
    auto depth = [&](const tahr_shape &shape, const tahr_vec3 &at) {
        btCapsuleShapeZ capsule = capsule_of(shape);
        return 0 - double(game.overlap(capsule, upright_at(to_bullet(at))).distance);
    };
    tahr_world *swept = open_on_sweeps(game), *gathered = open_on_triangles(game);
    bool good = swept && gathered;
    good = good && walk_course("through Bullet's sweeps", swept, depth);
    good = good && walk_course("through gathered triangles", gathered, depth);
    tahr_world_close(swept);
    tahr_world_close(gathered);
    return good ? 0 : 1;
}

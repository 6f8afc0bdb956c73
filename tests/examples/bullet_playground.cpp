/* SPDX-License-Identifier: MIT
 * bullet_playground.cpp: Tahr over a Bullet world, an engine that Tahr has no backend for, in two ways: through Bullet's
 * convex sweeps (tahr_callbacks), and through the triangles that Bullet finds in a box (tahr_native_desc.gather). Both
 * walk the same way.
 *
 *     bullet_playground               a part of the bundled playground, built here: stairs, a ramp, a thin wall
 *     bullet_playground FILE.obj      all of it, from `tahr level playground.obj >FILE.obj` */
#include <btBulletCollisionCommon.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <tahr/native.h>
#include <tahr/tahr.h>

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

/* The user's game: a level of one mesh and some boxes, in Bullet. */
class game_world
{
  public:
    game_world() : dispatcher(&configuration), world(&dispatcher, &broadphase, &configuration)
    {
    }

    void quad(btVector3 a, btVector3 b, btVector3 c, btVector3 d)
    {
        mesh.addTriangle(a, b, c);
        mesh.addTriangle(a, c, d);
    }

    void box(btVector3 low, btVector3 high)
    {
        boxes.push_back(std::make_unique<btBoxShape>((high - low) / 2));
        boxes.back()->setMargin(btScalar(0.001)); /* Bullet rounds its corners by the margin */
        add(*boxes.back(), (low + high) / 2);
    }

    /* Y up, as `tahr level` writes it. */
    bool read(const char *path)
    {
        std::ifstream file(path);
        std::vector<btVector3> vertices;
        for (std::string line; std::getline(file, line);) {
            std::istringstream in(line);
            std::string kind;
            in >> kind;
            if (kind == "v") {
                double x = 0, y = 0, z = 0;
                in >> x >> y >> z;
                vertices.emplace_back(btScalar(x), btScalar(-z), btScalar(y));
            } else if (kind == "f") {
                size_t i[3] = {0, 0, 0};
                in >> i[0] >> i[1] >> i[2];
                for (size_t k : i) {
                    if (k < 1 || k > vertices.size()) return false;
                }
                mesh.addTriangle(vertices[i[0] - 1], vertices[i[1] - 1], vertices[i[2] - 1]);
            }
        }
        return mesh.getNumTriangles() > 0;
    }

    void finish()
    {
        shape = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
        shape->setMargin(0); /* else every triangle is 4 cm thick */
        add(*shape, btVector3(0, 0, 0));
    }

    std::vector<std::unique_ptr<btCollisionObject>> objects;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher;
    btDbvtBroadphase broadphase;
    btCollisionWorld world;

  private:
    void add(btCollisionShape &of, btVector3 at)
    {
        objects.push_back(std::make_unique<btCollisionObject>());
        btCollisionObject &object = *objects.back();
        object.setCollisionShape(&of);
        object.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
        object.setUserIndex(int(objects.size()) - 1);
        world.addCollisionObject(&object);
    }

    btTriangleMesh mesh;
    std::unique_ptr<btBvhTriangleMeshShape> shape;
    std::vector<std::unique_ptr<btBoxShape>> boxes;
};

/* ---- The first way: Bullet's sweeps. ---- */

/* The deepest contact of a shape with the world. */
struct deepest : btCollisionWorld::ContactResultCallback {
    const btCollisionObject *self = nullptr;
    btVector3 normal{0, 0, 0}; /* from the world to the shape */
    btScalar distance = 0;     /* < 0: there is one */
    int body = -1;

    btScalar addSingleResult(btManifoldPoint &point, const btCollisionObjectWrapper *a, int, int,
                             const btCollisionObjectWrapper *b, int, int) override
    {
        bool first = a->getCollisionObject() == self;
        if (point.getDistance() < distance) {
            distance = point.getDistance();
            normal = first ? point.m_normalWorldOnB : -point.m_normalWorldOnB;
            body = (first ? b : a)->getCollisionObject()->getUserIndex();
        }
        return 0;
    }
};

/* The first hit that a motion goes into: what it leaves or glides along is none. */
struct first_opposed : btCollisionWorld::ClosestConvexResultCallback {
    using ClosestConvexResultCallback::ClosestConvexResultCallback;
    btVector3 way{0, 0, 0};

    btScalar addSingleResult(btCollisionWorld::LocalConvexResult &hit, bool in_world) override
    {
        btVector3 n = hit.m_hitNormalLocal;
        if (n.dot(way) > btScalar(-1e-4) * way.length()) return 1;
        return ClosestConvexResultCallback::addSingleResult(hit, in_world);
    }
};

tahr_status bullet_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    auto *game = static_cast<game_world *>(user);
    btScalar radius = btScalar(q->shape.radius);
    btCapsuleShapeZ capsule(radius, btScalar(2 * (q->shape.half_height - q->shape.radius)));
    btSphereShape sphere(radius); /* of the rays that Tahr derives */
    btConvexShape *shape = &sphere;
    if (q->shape.type == TAHR_SHAPE_CAPSULE) shape = &capsule;
    btTransform from(btQuaternion::getIdentity(), to_bullet(q->position));

    /* Where it stands: with TAHR_CALLBACKS_NO_MARGIN a capsule that has come larger by the skin is often in the floor by
     * a fraction of a millimetre. */
    btCollisionObject self;
    deepest overlap;
    self.setCollisionShape(shape);
    self.setWorldTransform(from);
    overlap.self = &self;
    game->world.contactTest(&self, overlap);
    btVector3 way = to_bullet(q->motion);
    bool deeper = overlap.normal.dot(way) < btScalar(-1e-4) * way.length();
    if (overlap.distance < 0 && (deeper || !(q->flags & TAHR_SWEEP_LEAVE_OVERLAP))) {
        hit->start_overlap = 1;
        hit->depth = -double(overlap.distance);
        hit->normal = to_tahr(overlap.normal);
        hit->body = uint32_t(overlap.body);
        return TAHR_OK;
    }
    if (way.length() == 0) return TAHR_OK;
    /* What the motion leaves is left at once, so that the sweep begins outside of it. */
    if (overlap.distance < 0) from.setOrigin(from.getOrigin() + overlap.normal * (btScalar(1e-4) - overlap.distance));
    btTransform to(btQuaternion::getIdentity(), from.getOrigin() + way);
    first_opposed found(from.getOrigin(), to.getOrigin());
    found.way = way;
    game->world.convexSweepTest(shape, from, to, found);
    if (!found.hasHit()) return TAHR_OK;
    hit->blocking = 1;
    hit->fraction = double(found.m_closestHitFraction);
    hit->normal = to_tahr(found.m_hitNormalWorld.normalized());
    hit->point = to_tahr(found.m_hitPointWorld);
    hit->body = uint32_t(found.m_hitCollisionObject->getUserIndex());
    return TAHR_OK;
}

/* ---- The second way: the triangles in a box. ---- */

struct hand_over : btTriangleCallback {
    tahr_gather *out = nullptr;
    uint32_t body = 0;
    btVector3 at{0, 0, 0};

    void give(const btVector3 *corners, uint32_t feature)
    {
        tahr_triangle t{};
        for (int i = 0; i < 3; i++) {
            t.corners[i] = to_tahr(corners[i] + at);
        }
        t.body = body;
        t.feature = feature;
        t.flags = TAHR_BODY_TWO_SIDED; /* as it is for Bullet */
        out->add(out, &t);
    }

    void processTriangle(btVector3 *corners, int, int index) override
    {
        give(corners, uint32_t(index));
    }
};

/* The twelve triangles of a box. */
void give_box(hand_over &to, const btBoxShape &box)
{
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    btVector3 half = box.getHalfExtentsWithMargin();
    for (uint32_t f = 0; f < 6; f++) {
        btVector3 v[4];
        for (int k = 0; k < 4; k++) {
            int i = faces[f][k];
            v[k].setValue(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z());
        }
        const btVector3 first[3] = {v[0], v[1], v[2]}, second[3] = {v[0], v[2], v[3]};
        to.give(first, 2 * f);
        to.give(second, 2 * f + 1);
    }
}

tahr_status bullet_gather(void *user, const tahr_bounds *box, uint32_t, tahr_gather *out)
{
    auto *game = static_cast<game_world *>(user);
    hand_over to;
    to.out = out;
    for (const auto &object : game->objects) {
        btVector3 low, high;
        const btCollisionShape *shape = object->getCollisionShape();
        shape->getAabb(object->getWorldTransform(), low, high);
        if (!TestAabbAgainstAabb2(low, high, to_bullet(box->min), to_bullet(box->max))) continue;
        to.body = uint32_t(object->getUserIndex());
        to.at = object->getWorldTransform().getOrigin();
        if (shape->isConcave()) {
            static_cast<const btConcaveShape *>(shape)->processAllTriangles(&to, to_bullet(box->min) - to.at,
                                                                            to_bullet(box->max) - to.at);
        } else {
            give_box(to, *static_cast<const btBoxShape *>(shape));
        }
    }
    return TAHR_OK;
}

/* ---- The walk. ---- */

/* Up eight steps of 0.3 m and down again, over a ramp of 35 degrees, round to a wall of 2 cm, and against it. */
struct waypoint {
    double x, y, seconds;
    const char *name;
};
const waypoint COURSE[] = {{-24, 14.75, 4, "top of the stairs"}, {-19, 14.75, 4, "foot of the stairs"},
                           {-13.5, 11.05, 4, "before the ramp"}, {-8, 11.05, 4, "top of the ramp"},
                           {-2, 11.05, 4, "behind the ramp"},    {0.5, 7.5, 3, "beside the rough ground"},
                           {0.5, -7.5, 5, "south of it"},        {13, -8, 5, "before the wall"},
                           {13, -12, 2, "behind the wall"}};
enum { STOPS = sizeof COURSE / sizeof COURSE[0] };

struct walked {
    tahr_vec3 at[STOPS];
    double deepest = 0; /* m, of the capsule itself in Bullet's world */
    double queries = 0; /* per step */
    int steps = 0, failed = 0;
};

/* Bullet's own opinion of where the character is. */
double depth_in(game_world &game, const tahr_config &c, const tahr_vec3 &at)
{
    btCapsuleShapeZ capsule(btScalar(c.shape.radius), btScalar(2 * (c.shape.half_height - c.shape.radius)));
    btCollisionObject self;
    deepest overlap;
    self.setCollisionShape(&capsule);
    self.setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(at)));
    overlap.self = &self;
    game.world.contactTest(&self, overlap);
    return 0 - double(overlap.distance);
}

walked walk(game_world &game, tahr_world *world)
{
    walked w;
    tahr_config config;
    tahr_state state;
    tahr_mover *mover = nullptr;
    tahr_input input{};
    tahr_report report{};
    input.struct_size = sizeof input;
    report.struct_size = sizeof report;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_vec3 start = {-29.2, 14.75, config.shape.half_height + 0.02};
    tahr_state_init(&state, &config, &start);
    w.failed = tahr_mover_create(world, &config, &mover) < 0;
    for (int stop = 0; stop < STOPS && !w.failed; stop++) {
        const waypoint &to = COURSE[stop];
        for (int i = 0; i < to.seconds * 60 && !w.failed; i++) {
            double x = to.x - state.position.x, y = to.y - state.position.y, away = std::sqrt(x * x + y * y);
            if (away < 0.1) break;
            input.move = {x / away, y / away, 0};
            w.failed = tahr_mover_step(mover, &input, 1.0 / 60, &state, &report) < 0;
            w.queries += report.sweeps + report.contact_queries + report.rays;
            w.deepest = std::fmax(w.deepest, depth_in(game, config, state.position));
            w.steps++;
        }
        w.at[stop] = state.position;
    }
    tahr_mover_destroy(mover);
    return w;
}

/* Arrived everywhere at the right height, but not through the wall. */
bool is_good(const char *name, const walked &w)
{
    const double foot = 0.9 + 0.0125; /* half height, and a clearance of 1 to 1.5 cm */
    const double height[STOPS] = {2.4, 0, 0, 2, 0, 0, 0, 0, 0};
    bool good = !w.failed;
    std::printf("%s\n", name);
    for (int i = 0; i < STOPS && !w.failed; i++) {
        bool last = i == STOPS - 1;
        /* The wall's face is at y = -9.99; the skin is 1 cm. */
        double x = w.at[i].x - COURSE[i].x, y = w.at[i].y - (last ? -9.99 + 0.35 + 0.01 : COURSE[i].y);
        bool here = std::fabs(x) < 0.12 && std::fabs(y) < (last ? 0.005 : 0.12);
        bool high = std::fabs(w.at[i].z - foot - height[i]) < 0.01;
        std::printf("  %-26s %8.3f %8.3f %7.3f%s\n", COURSE[i].name, w.at[i].x, w.at[i].y, w.at[i].z,
                    here && high ? "" : "   WRONG");
        good = good && here && high;
    }
    std::printf("  %d steps, %.2f queries each, at most %.2f mm inside anything\n", w.steps, w.queries / w.steps,
                1000 * w.deepest);
    return good && w.deepest < 0.005;
}

/* A line of (x, z) corners, drawn out from y0 to y1. */
void profile(game_world &game, const std::vector<std::pair<double, double>> &line, double y0, double y1)
{
    for (size_t i = 0; i + 1 < line.size(); i++) {
        auto at = [&](size_t k, double y) { return to_bullet({line[k].first, y, line[k].second}); };
        game.quad(at(i, y0), at(i + 1, y0), at(i + 1, y1), at(i, y1));
    }
}

void build(game_world &game)
{
    for (int x = -30; x < 30; x += 2) {
        for (int y = -20; y < 34; y += 2) {
            profile(game, {{x, 0}, {x + 2, 0}}, y, y + 2);
        }
    }
    std::vector<std::pair<double, double>> stairs = {{-28, 0}};
    for (int i = 1; i <= 8; i++) {
        stairs.emplace_back(-28 + 0.3 * (i - 1), 0.3 * i);
        stairs.emplace_back(-28 + 0.3 * i, 0.3 * i);
    }
    for (int i = 0; i < 8; i++) {
        stairs.emplace_back(-22.6 + 0.3 * (i + 1), 2.4 - 0.3 * i);
        stairs.emplace_back(-22.6 + 0.3 * (i + 1), 2.1 - 0.3 * i);
    }
    profile(game, stairs, 13, 16.5);
    profile(game, {{-11.856, 0}, {-9, 2}, {-7, 2}, {-4.144, 0}}, 9.8, 12.3);
    game.box(btVector3(11, btScalar(-10.01), 0), btVector3(15, btScalar(-9.99), btScalar(2.5)));
}

} // namespace

int main(int count, char **arguments)
{
    game_world game;
    if (count < 2) {
        build(game);
    } else if (!game.read(arguments[1])) {
        std::fprintf(stderr, "%s: no triangles\n", arguments[1]);
        return 2;
    }
    game.finish();

    tahr_world *swept = nullptr, *gathered = nullptr;
    tahr_callbacks callbacks{};
    callbacks.struct_size = sizeof callbacks;
    callbacks.flags = TAHR_CALLBACKS_NO_MARGIN; /* Bullet's sweeps know of no margin */
    callbacks.user = &game;
    callbacks.sweep = bullet_sweep;
    if (tahr_world_open_callbacks(&callbacks, nullptr, &swept) < 0) return 1;

    tahr_native_desc native{};
    native.struct_size = sizeof native;
    native.gather = bullet_gather;
    native.gather_user = &game;
    tahr_world_desc scene;
    tahr_world_desc_init(&scene, sizeof scene);
    scene.options = &native;
    if (tahr_world_open(tahr_backend_v1_native(), &scene, &gathered) < 0) return 1;

    walked by_sweeps = walk(game, swept), by_triangles = walk(game, gathered);
    bool good = is_good("through Bullet's sweeps", by_sweeps);
    good = is_good("through gathered triangles", by_triangles) && good;
    tahr_world_close(swept);
    tahr_world_close(gathered);
    return good ? 0 : 1;
}

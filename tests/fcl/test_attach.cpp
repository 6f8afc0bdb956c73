/* SPDX-License-Identifier: MIT
 * test_attach.cpp: a world over a user's own manager answers what the same things described to Tahr answer; its objects
 * are where the user puts them, and what cannot be held is refused by name. */
#include "meshes.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;
using Object = fcl::CollisionObject<double>;

/* A user's program: objects in a manager. */
struct Program {
    std::vector<std::unique_ptr<Object>> objects;
    fcl::DynamicAABBTreeCollisionManager<double> manager;

    Object *add(const Geometry &geometry, tahr_pose pose = {{0, 0, 0}, {0, 0, 0, 1}})
    {
        objects.push_back(std::make_unique<Object>(geometry));
        put(objects.back().get(), pose);
        manager.registerObject(objects.back().get());
        manager.setup();
        return objects.back().get();
    }
    void put(Object *object, const tahr_pose &p)
    {
        object->setTransform(
            fcl::Quaternion<double>(p.orientation.w, p.orientation.x, p.orientation.y, p.orientation.z),
            fcl::Vector3<double>(p.position.x, p.position.y, p.position.z));
        object->computeAABB();
    }
    void move(Object *object, const tahr_pose &p)
    {
        put(object, p);
        manager.update(object);
    }
    tahr_fcl_desc desc()
    {
        tahr_fcl_desc d = {};
        d.struct_size = sizeof d;
        d.manager = &manager;
        return d;
    }
    tahr_world *open()
    {
        tahr_fcl_desc d = desc();
        return open_fcl({}, &d);
    }
};

static int compare(tahr_world *a, tahr_world *b, uint64_t seed, int count)
{
    Dice dice = {seed};
    int hits = 0;
    for (int i = 0; i < count; i++) {
        tahr_sweep q =
            make_sweep(round_shape(dice.uniform(0.1, 0.4), i % 2 ? 0 : 0.7), dice.vec(-3, 3), dice.vec(-1.5, 1.5));
        tahr_hit x, y;
        if (i % 2) q.shape.half_height = q.shape.radius;
        uint32_t found = sweep(a, q, &x);
        assert_int_equal(sweep(b, q, &y), found);
        if (!found) continue;
        hits++;
        assert_int_equal(x.body, y.body);
        assert_true(same_stop(q, x, y));
    }
    return hits;
}

template <class BV> static void check_model(const Hills &hills, const tahr_pose &pose, bool collide)
{
    Program program;
    tahr_body_desc body = hills.body();
    body.pose = pose;
    program.add(hills.model<BV>(), pose);
    tahr_fcl_desc desc = program.desc();
    desc.search = collide ? TAHR_FCL_COLLIDE : TAHR_FCL_DESCEND;
    tahr_world *attached = open_fcl({}, &desc), *described = open_fcl({body}, nullptr);
    assert_true(compare(attached, described, 41, 300) > 60);
    tahr_world_close(attached);
    tahr_world_close(described);
}

static void models_of_every_kind_of_volume_answer_as_described_ones(void **)
{
    Dice dice = {40};
    Hills hills(dice);
    tahr_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
    for (int i = 0; i < 2; i++) {
        check_model<fcl::AABB<double>>(hills, pose, i > 0);
        check_model<fcl::OBB<double>>(hills, pose, i > 0);
        check_model<fcl::RSS<double>>(hills, pose, i > 0);
        check_model<fcl::kIOS<double>>(hills, pose, i > 0);
        check_model<fcl::OBBRSS<double>>(hills, pose, i > 0);
        check_model<fcl::KDOP<double, 16>>(hills, pose, i > 0);
        check_model<fcl::KDOP<double, 18>>(hills, pose, i > 0);
        check_model<fcl::KDOP<double, 24>>(hills, pose, i > 0);
        pose = {{0.2, -0.3, 0.4}, dice.turn()};
    }
}

static std::shared_ptr<fcl::Convex<double>> make_cube(double half)
{
    auto vertices = std::make_shared<std::vector<fcl::Vector3<double>>>();
    auto faces = std::make_shared<std::vector<int>>(
        std::vector<int>{4, 0, 4, 6, 2, 4, 1, 3, 7, 5, 4, 0, 1, 5, 4, 4, 2, 6, 7, 3, 4, 0, 2, 3, 1, 4, 4, 5, 7, 6});
    for (int i = 0; i < 8; i++)
        vertices->emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
    return std::make_shared<fcl::Convex<double>>(vertices, 6, faces);
}

static void solids_answer_as_described_ones(void **)
{
    Dice dice = {42};
    Program program;
    std::vector<tahr_body_desc> bodies;
    const uint32_t kinds[3] = {TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE};

    for (uint32_t kind : kinds) {
        tahr_body_desc body = make_body(kind);
        body.pose = {dice.vec(-2, 2), dice.turn()};
        body.half_extents = {0.5, 0.75, 0.25};
        body.radius = 0.4;
        body.half_height = 1;
        bodies.push_back(body);
    }
    program.add(std::make_shared<fcl::Box<double>>(1.0, 1.5, 0.5), bodies[0].pose);
    program.add(std::make_shared<fcl::Sphere<double>>(0.4), bodies[1].pose);
    program.add(std::make_shared<fcl::Capsule<double>>(0.4, 1.2), bodies[2].pose);
    /* The manager lists its objects as it likes: names by user data. */
    for (size_t i = 0; i < 3; i++)
        program.objects[i]->setUserData(reinterpret_cast<void *>(i));
    tahr_fcl_desc desc = program.desc();
    desc.object = [](void *, const void *object, uint32_t *id, tahr_body_desc *) -> tahr_status {
        *id = static_cast<uint32_t>(reinterpret_cast<size_t>(static_cast<const Object *>(object)->getUserData()));
        return TAHR_OK;
    };
    tahr_world *attached = open_fcl({}, &desc), *described = open_native(bodies);
    assert_true(compare(attached, described, 43, 4000) > 150);
    tahr_world_close(attached);
    tahr_world_close(described);
}

/* Closed forms: where a capsule that falls straight down stops, its foot at the margin above the top. */
static void polytopes_triangles_planes_and_octrees_are_met_where_they_are(void **)
{
    std::vector<std::pair<Geometry, double>> cases; /* geometry, height of its top at x = y = 0.05 */
    auto tree = std::make_shared<octomap::OcTree>(0.1);
    const fcl::Vector3<double> a(-2, -2, 0.5), b(2, -2, 0.5), c(-2, 3, 0.5);

    for (int i = -5; i < 5; i++)
        for (int j = -5; j < 5; j++)
            tree->updateNode(0.1 * i + 0.05, 0.1 * j + 0.05, 0.25, true);
    cases.emplace_back(make_cube(0.5), 0.5);
    cases.emplace_back(std::make_shared<fcl::TriangleP<double>>(a, b, c), 0.5);
    cases.emplace_back(std::make_shared<fcl::Halfspace<double>>(fcl::Vector3<double>(0, 0, 1), 0.25), 0.25);
    cases.emplace_back(std::make_shared<fcl::Plane<double>>(fcl::Vector3<double>(0, 0, 1), -0.5), -0.5);
    cases.emplace_back(std::make_shared<fcl::OcTree<double>>(tree), 0.3);
    for (const auto &one : cases) {
        Program program;
        tahr_hit hit;
        program.add(one.first);
        tahr_world *world = program.open();
        tahr_sweep q = make_sweep(round_shape(0.3, 0.9), {0.05, 0.05, 2.9}, {0, 0, -4});
        assert_int_equal(sweep(world, q, &hit), 1);
        assert_true(std::fabs(hit.fraction - (2.9 - 0.9 - 0.01 - one.second) / 4) < 1e-8);
        assert_true(hit.normal.z > 1 - 1e-9);
        tahr_ray ray = {{0.05, 0.05, 2}, {0, 0, -4}, 0xFFFFFFFFu, TAHR_NO_BODY};
        uint32_t count;
        assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
        assert_true(count == 1 && std::fabs(hit.fraction - (2 - one.second) / 4) < 1e-8);
        tahr_world_close(world);
    }
}

static void objects_are_where_the_user_puts_them(void **)
{
    Program program;
    Object *box = program.add(std::make_shared<fcl::Box<double>>(1.0, 1.0, 1.0), {{3, 0, 0}, {0, 0, 0, 1}});
    tahr_world *world = program.open();
    tahr_sweep q = make_sweep(round_shape(0.5, 0.5), {0, 0, 0}, {10, 0, 0});
    tahr_body_motion motion;
    tahr_hit hit;

    assert_int_equal(sweep(world, q, &hit), 1);
    assert_true(std::fabs(hit.fraction - 0.199) < 1e-9);
    program.move(box, {{5, 0, 0}, {0, 0, 0, 1}});
    assert_int_equal(tahr_world_touch(world), TAHR_OK);
    assert_int_equal(sweep(world, q, &hit), 1);
    assert_true(std::fabs(hit.fraction - 0.399) < 1e-9);
    assert_int_equal(tahr_world_body(world, 0, &motion), TAHR_OK);
    assert_true(motion.pose.position.x == 5 && motion.velocity.x == 0);
    assert_int_equal(tahr_world_body(world, 1, &motion), TAHR_E_NOT_FOUND);
    program.manager.unregisterObject(box);
    assert_int_equal(sweep(world, q, &hit), 0);
    tahr_world_close(world);
}

/* Names, masks and speeds from callbacks. */
struct Names {
    const void *second;
    uint32_t first_id;
};

static tahr_status name(void *user, const void *object, uint32_t *id, tahr_body_desc *desc)
{
    const Names *names = static_cast<const Names *>(user);
    *id = object == names->second ? 70 : names->first_id;
    desc->surface = object == names->second ? 5 : 4;
    desc->mask = object == names->second ? 2 : 1;
    desc->surface_velocity.x = 3;
    return TAHR_OK;
}

static tahr_status glide(void *, const void *, uint32_t, tahr_body_motion *motion)
{
    motion->velocity.y = 2;
    return TAHR_OK;
}

/* Straight down onto each, a sphere of 0.5 without a margin from 5 m above: where it is stopped is elementary. */
static void round_solids_are_met_where_they_are(void **)
{
    /* Radius 0.5, height 2, on the side: its top is a line 0.5 above the axis. */
    const tahr_quat on_side = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    const struct {
        std::shared_ptr<fcl::CollisionGeometry<double>> geometry;
        tahr_quat turn;
        double top, aside; /* m; where the sphere comes down beside the middle, along x */
    } cases[] = {
        {std::make_shared<fcl::Cylinder<double>>(0.5, 2.0), {0, 0, 0, 1}, 1.0, 0.25},
        {std::make_shared<fcl::Cylinder<double>>(0.5, 2.0), on_side, 0.5, 0},
        {std::make_shared<fcl::Cone<double>>(0.5, 2.0), {0, 0, 0, 1}, 1.0, 0},    /* the apex */
        {std::make_shared<fcl::Cone<double>>(0.5, 2.0), {1, 0, 0, 0}, 1.0, 0.25}, /* upside down: its base */
        {std::make_shared<fcl::Ellipsoid<double>>(0.5, 0.75, 1.25), {0, 0, 0, 1}, 1.25, 0},
        {std::make_shared<fcl::Ellipsoid<double>>(0.5, 0.75, 1.25), on_side, 0.75, 0},
    };

    for (const auto &c : cases) {
        Program program;
        program.add(c.geometry, {{3, 2, 1}, c.turn});
        tahr_fcl_desc desc = program.desc();
        tahr_world *world = open_fcl({}, &desc);
        tahr_sweep q = make_sweep(round_shape(0.5, 0.5), {3 + c.aside, 2, 1 + 5}, {0, 0, -5});
        tahr_hit hit;
        q.margin = 0;
        assert_int_equal(sweep(world, q, &hit), 1);
        assert_true(std::fabs(hit.fraction - (5 - 0.5 - c.top) / 5) < 1e-9);
        assert_true(hit.normal.z > 1 - 1e-9 && std::fabs(hit.point.z - (1 + c.top)) < 1e-8);
        assert_true(hit.surface_normal.z >
                    (c.geometry->getNodeType() == fcl::GEOM_CONE && c.aside == 0 ? 0 : 1 - 1e-9));
        tahr_world_close(world);
    }
}

static void callbacks_name_and_move_the_objects(void **)
{
    Program program;
    program.add(std::make_shared<fcl::Box<double>>(1.0, 1.0, 1.0), {{3, 0, 0}, {0, 0, 0, 1}});
    Names names = {program.add(std::make_shared<fcl::Box<double>>(1.0, 1.0, 1.0), {{5, 0, 0}, {0, 0, 0.6, 0.8}}), 8};
    tahr_fcl_desc desc = program.desc();
    tahr_sweep q = make_sweep(round_shape(0.5, 0.5), {0, 0, 0}, {10, 0, 0});
    tahr_body_motion motion;
    tahr_hit hit;

    desc.object = name;
    desc.motion = glide;
    desc.user = &names;
    tahr_world *world = open_fcl({}, &desc);
    assert_int_equal(sweep(world, q, &hit), 1);
    assert_true(hit.body == 8 && hit.surface == 4);
    q.mask = 2;
    assert_int_equal(sweep(world, q, &hit), 1);
    assert_true(hit.body == 70 && hit.surface == 5);
    assert_int_equal(tahr_world_body(world, 70, &motion), TAHR_OK);
    /* The turn by 2 asin(0.6): cosine 0.28, sine 0.96. */
    assert_true(motion.velocity.y == 2 && std::fabs(motion.surface_velocity.x - 0.84) < 1e-12 &&
                std::fabs(motion.surface_velocity.y - 2.88) < 1e-12);
    tahr_world_close(world);
}

static void what_cannot_be_held_is_refused_by_name(void **)
{
    Log log;
    tahr_world *world;

    Program cylinder;
    cylinder.add(std::make_shared<fcl::Cylinder<double>>(0.5, 1e8));
    tahr_fcl_desc desc = cylinder.desc();
    assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &desc, &log, &world), TAHR_E_UNSUPPORTED);
    assert_true(log.text.find("a Cylinder") != std::string::npos);
    desc.object = [](void *, const void *, uint32_t *, tahr_body_desc *) -> tahr_status { return TAHR_E_NOT_FOUND; };
    assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &desc, &log, &world), TAHR_OK); /* left out */
    tahr_world_close(world);

    Program twins;
    for (double x : {0.0, 3.0})
        twins.add(std::make_shared<fcl::Sphere<double>>(0.5), {{x, 0, 0}, {0, 0, 0, 1}});
    desc = twins.desc();
    desc.object = [](void *, const void *, uint32_t *id, tahr_body_desc *) -> tahr_status {
        *id = 7;
        return TAHR_OK;
    };
    assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &desc, &log, &world), TAHR_E_ARGUMENT);
    assert_true(log.text.find("id") != std::string::npos);

    Program huge;
    huge.add(std::make_shared<fcl::Sphere<double>>(1e8));
    desc = huge.desc();
    assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &desc, &log, &world), TAHR_E_UNSUPPORTED);

    for (double bad : {double{NAN}, 3.0}) { /* nowhere, and three times as large */
        Program misplaced;
        fcl::Transform3<double> at = fcl::Transform3<double>::Identity();
        if (bad == 3.0)
            at.linear() *= bad;
        else
            at.translation().x() = bad;
        misplaced.add(std::make_shared<fcl::Sphere<double>>(0.5), {{0, 0, 0}, {0, 0, 0, 1}});
        misplaced.objects[0]->setTransform(at);
        desc = misplaced.desc();
        log.text.clear();
        assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &desc, &log, &world), TAHR_E_UNSUPPORTED);
        assert_true(log.text.find("such a transform") != std::string::npos);
    }

    Program empty;
    desc = empty.desc();
    assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &desc, &log, &world), TAHR_OK);
    tahr_world_close(world);
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_of_every_kind_of_volume_answer_as_described_ones),
        cmocka_unit_test(solids_answer_as_described_ones),
        cmocka_unit_test(polytopes_triangles_planes_and_octrees_are_met_where_they_are),
        cmocka_unit_test(objects_are_where_the_user_puts_them),
        cmocka_unit_test(round_solids_are_met_where_they_are),
        cmocka_unit_test(callbacks_name_and_move_the_objects),
        cmocka_unit_test(what_cannot_be_held_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

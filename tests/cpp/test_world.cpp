/* SPDX-License-Identifier: MIT
 * test_world.cpp: scenes of bodies from containers, opened, moved and asked; and worlds on plugins. */
#include "cpp_test.hpp"

static double height_below(const tahr::world &world, double x, double y)
{
    const tahr_ray ray = {{x, y, 10}, {0, 0, -20}, 0xFFFFFFFFu, TAHR_NO_BODY};
    tahr_hit hit = world.ray(ray).value();
    return hit.blocking ? 10 - 20 * hit.fraction : -1000;
}

static tahr::result<tahr::world> open_one(const tahr_body_desc &body)
{
    return tahr::world::open(tahr_backend_v1_native(), tahr::view<const tahr_body_desc>(&body, 1));
}

/* The same square from numbers and from vectors, in a C array, a std::vector, a std::array and a pointer and count. */
static void meshes_come_from_any_container(void **)
{
    const double numbers[] = {-9, -9, 2, 9, -9, 2, 9, 9, 2, -9, 9, 2};
    std::vector<tahr_vec3> points = {{-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2}};
    const std::array<uint32_t, 6> corners = {0, 1, 2, 0, 2, 3};
    const std::vector<uint32_t> more(corners.begin(), corners.end());
    tahr::view<const double> some(numbers, 12);
    for (const tahr_body_desc &body :
         {tahr::mesh_body(numbers, corners).value(), tahr::mesh_body(points, more).value(),
          tahr::mesh_body(some, more).value(), tahr::mesh_body(tahr::view<const double>(some), corners).value()}) {
        assert_int_equal(body.vertex_count, 4);
        assert_int_equal(body.triangle_count, 2);
        tahr::world world = open_one(body).value();
        assert_near(height_below(world, 3, -4), 2, 1e-9);
        assert_near(height_below(world, 9.5, 0), -1000, 0);
    }
}

static void other_bodies_have_their_shapes(void **)
{
    const std::vector<double> heights = {1, 1, 1, 1, 3, 1, 1, 1, 1};
    const tahr_vec3 roof[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 2}};
    tahr_body_desc hull = tahr::hull_body(roof).value(), field = tahr::heights_body(heights, 3, 4, 4).value();
    hull.pose.position = {10, 0, 0};
    field.pose.position = {-10, 0, 0};
    assert_int_equal(field.rows, 3);
    const tahr_body_desc bodies[] = {tahr::box_body({1, 1, 0.5}), tahr::sphere_body(1.5, {5, 0, 0}), hull, field,
                                     tahr::round_body(TAHR_BODY_CAPSULE, 0.5, 2, {0, 5, 0})};
    tahr::world world = tahr::world::open(tahr_backend_v1_native(), bodies).value();
    assert_near(height_below(world, 0.3, 0.2), 0.5, 1e-9);
    assert_near(height_below(world, 5, 0), 1.5, 1e-9);
    assert_near(height_below(world, 10, 0), 2, 1e-9);
    assert_near(height_below(world, -10, 0), 3, 1e-9);
    assert_near(height_below(world, 0, 5), 2, 1e-9);
    const tahr_vec3 line[] = {{-1, 0, 0}, {1, 0, 0}};
    assert_int_equal(tahr::chain_body(line)->vertex_count, 2);
    assert_int_equal(tahr::ellipsoid_body({1, 2, 3}).type, TAHR_BODY_ELLIPSOID);
}

static void arrays_that_do_not_fit_are_named(void **)
{
    const std::vector<double> seven(7), nine(9);
    const std::vector<uint32_t> four(4), three = {0, 1, 2};
    assert_says(tahr::mesh_body(seven, three), TAHR_E_ARGUMENT, "tahr::mesh_body: vertices has 7 numbers");
    assert_says(tahr::mesh_body(nine, four), TAHR_E_ARGUMENT, "tahr::mesh_body: indices has 4 numbers");
    assert_says(tahr::hull_body(seven), TAHR_E_ARGUMENT, "tahr::hull_body: vertices has 7");
    assert_says(tahr::heights_body(seven, 2, 1, 1), TAHR_E_ARGUMENT, "heights has 7 numbers, expected rows of 2");
    assert_says(tahr::heights_body(seven, 0, 1, 1), TAHR_E_ARGUMENT, "expected rows of 0");
}

static void bad_bodies_are_named_and_the_users_log_hears_too(void **)
{
    std::string heard;
    auto write = [&heard](int32_t level, const char *message) {
        if (level == TAHR_LOG_ERROR) heard = message;
    };
    const tahr_log log = tahr::log_to(write);
    const tahr_body_desc bodies[] = {tahr::box_body({1, 1, 1}), tahr::sphere_body(-1)};
    tahr_world_desc desc = tahr::make_world_desc();
    desc.bodies = bodies;
    desc.body_count = 2;
    desc.log = &log;
    tahr::result<tahr::world> none = tahr::world::open(tahr_backend_v1_native(), desc);
    assert_says(none, TAHR_E_ARGUMENT, "bodies[1].radius");
    assert_string_equal(heard.c_str(), none.message());
}

static void bodies_move_and_are_asked(void **)
{
    tahr_body_desc lift = tahr::box_body({1, 1, 1});
    lift.flags = TAHR_BODY_MOVABLE;
    tahr::world world = open_one(lift).value();
    uint64_t revision = world.revision();
    tahr_body_pose up{};
    up.pose = tahr::make_pose({0, 0, 1});
    const std::vector<tahr_body_pose> poses = {up};
    assert_int_equal(world.move(poses, 0.5).value(), TAHR_OK);
    assert_true(world.revision() != revision);
    assert_near(world.body(0).value().velocity.z, 2, 1e-12);
    assert_near(height_below(world, 0, 0), 2, 1e-9);
    up.pose.position.z = -1;
    assert_int_equal(world.set({&up, 1}).value(), TAHR_OK);
    assert_near(world.body(0).value().velocity.z, 0, 0);
    assert_near(height_below(world, 0, 0), 0, 1e-9);
    up.body = 9;
    assert_says(world.move({&up, 1}, 0.5), TAHR_E_NOT_FOUND, "poses[0].body");
    assert_says(world.body(9), TAHR_E_NOT_FOUND, "tahr_world_body");
    assert_true(world.memory() > 0);
}

static void nothing_met_is_a_fraction_of_one(void **)
{
    tahr::world world = open_floor();
    tahr_sweep away = fall_from(3);
    away.motion.z = 1;
    tahr_hit hit = world.sweep(away).value();
    assert_int_equal(hit.blocking, 0);
    assert_near(hit.fraction, 1, 0);
    away.margin = -1;
    assert_says(world.sweep(away), TAHR_E_ARGUMENT, "margin");
}

static void description_is_handed_over_line_by_line(void **)
{
    std::vector<std::string> lines;
    tahr::world world = open_floor();
    assert_int_equal(world.describe([&lines](const char *line) { lines.push_back(line); }).value(), TAHR_OK);
    assert_true(lines.size() > 1);
    assert_non_null(strstr(lines[0].c_str(), "native"));
    assert_says(world.describe([](const char *) { return TAHR_E_FILE; }), TAHR_E_FILE, "tahr_world_describe");
#ifndef TAHR_CPP_NO_EXCEPTIONS
    int caught = 0;
    try {
        world.describe([](const char *) { throw std::out_of_range("no paper"); }).value();
    } catch (const std::out_of_range &e) {
        caught += !strcmp(e.what(), "no paper");
    }
    assert_int_equal(caught, 1);
#endif
}

static void empty_world_says_null(void **)
{
    tahr::world none;
    assert_int_equal(none.touch().code(), TAHR_E_NULL);
    assert_int_equal(none.sweep(fall_from(1)).code(), TAHR_E_NULL);
    assert_int_equal(tahr::mover::create(none, precise()).code(), TAHR_E_NULL);
    assert_int_equal(tahr::crowd::create(none, tahr::make_crowd_desc()).code(), TAHR_E_NULL);
    assert_string_equal(none.backend_name(), "?");
    assert_true(none.revision() == 0 && none.memory() == 0);
}

static void plugin_stays_while_a_world_is_open(void **)
{
#ifdef TEST_PLUGIN
    tahr::world world;
    {
        tahr::plugin plugin = tahr::plugin::load(TEST_PLUGIN).value();
        assert_string_equal(plugin.backend()->name, "native");
        const tahr_body_desc bodies[] = {tahr::box_body({50, 50, 1}, {0, 0, -1})};
        world = tahr::world::open(plugin, bodies).value();
    }
    tahr::mover mover = tahr::mover::create(world, precise()).value(), linked;
    uint64_t hash = walk(mover);
    linked = tahr::mover::create(open_floor(), precise()).value();
    assert_true(hash == walk(linked));
#else
    print_message("SKIP: plugin_stays_while_a_world_is_open: the shared libraries were not built\n");
    skip();
#endif
}

static void plugin_that_is_not_there_is_named(void **)
{
    assert_says(tahr::plugin::load("./no_such_file.so"), TAHR_E_NOT_FOUND, "no_such_file.so");
    assert_says(tahr::plugin::load(nullptr), TAHR_E_NULL, "tahr_plugin_load");
    tahr::plugin none;
    assert_null(none.backend());
    assert_int_equal(tahr::world::open(none, tahr::view<const tahr_body_desc>()).code(), TAHR_E_NULL);
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_come_from_any_container),
        cmocka_unit_test(other_bodies_have_their_shapes),
        cmocka_unit_test(arrays_that_do_not_fit_are_named),
        cmocka_unit_test(bad_bodies_are_named_and_the_users_log_hears_too),
        cmocka_unit_test(bodies_move_and_are_asked),
        cmocka_unit_test(nothing_met_is_a_fraction_of_one),
        cmocka_unit_test(description_is_handed_over_line_by_line),
        cmocka_unit_test(empty_world_says_null),
        cmocka_unit_test(plugin_stays_while_a_world_is_open),
        cmocka_unit_test(plugin_that_is_not_there_is_named),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

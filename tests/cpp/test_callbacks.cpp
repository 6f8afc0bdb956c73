/* SPDX-License-Identifier: MIT
 * test_callbacks.cpp: lambdas and objects as engines: called as functions of C are, kept as long as they are needed,
 * and what they throw comes out where it belongs. */
#include "cpp_test.hpp"

static uint64_t walk_over_c()
{
    tahr_callbacks callbacks{};
    callbacks.struct_size = sizeof callbacks;
    callbacks.sweep = meet_plane_c;
    tahr_world *world = nullptr;
    tahr_mover *mover = nullptr;
    const tahr_config config = precise();
    assert_int_equal(tahr_world_open_callbacks(&callbacks, nullptr, &world), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    uint64_t hash = walk(mover);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return hash;
}

static void lambda_moves_as_a_function_of_c(void **)
{
    int calls = 0;
    tahr::world world = tahr::world::open([&calls](const tahr_sweep &q, tahr_hit &hit) {
                            calls++;
                            meet_plane(q, hit);
                        }).value();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    assert_true(walk(mover) == walk_over_c());
    assert_true(calls > 0);
    assert_string_equal(world.backend_name(), "callbacks");
}

static tahr_status plain_function(const tahr_sweep &q, tahr_hit &hit)
{
    meet_plane(q, hit);
    return TAHR_OK;
}

static void function_is_an_engine_too(void **)
{
    tahr::world world = tahr::world::open(plain_function).value();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    assert_true(walk(mover) == walk_over_c());
}

/* What a lambda holds stays in its place, and lives until the last of world and movers is gone. */
static void lambda_stays_when_worlds_and_movers_move(void **)
{
    int alive = 0;
    {
        tahr::mover kept;
        {
            tahr::world first = tahr::world::open([token = counted(alive)](const tahr_sweep &q, tahr_hit &hit) {
                                    if (*token.alive == 1) meet_plane(q, hit);
                                }).value();
            assert_int_equal(alive, 1);
            tahr::mover mover = tahr::mover::create(first, precise()).value();
            tahr::world second = std::move(first);
            assert_false(static_cast<bool>(first));
            assert_null(first.handle());
            second = tahr::world(std::move(second));
            kept = std::move(mover);
            assert_false(static_cast<bool>(mover));
        }
        assert_int_equal(alive, 1);
        assert_true(walk(kept) == walk_over_c());
    }
    assert_int_equal(alive, 0);
}

/* An engine with all that can be asked. */
struct everything {
    double ground = 0;
    void sweep(const tahr_sweep &q, tahr_hit &hit)
    {
        tahr_sweep moved = q;
        moved.position.z -= ground;
        meet_plane(moved, hit);
    }
    void contacts(const tahr_contact_query &q, tahr::answers<tahr_contact> &out)
    {
        for (uint32_t body = 0; body < 3; body++) {
            tahr_contact c{};
            c.distance = q.position.z - q.shape.half_height - ground + body * 0.01;
            c.normal = c.surface_normal = {0, 0, 1};
            c.point = {q.position.x, q.position.y, ground};
            c.body = body;
            if (c.distance <= q.margin && !out.add(c)) return;
        }
    }
    tahr_status ray(const tahr_ray &q, tahr_hit &hit)
    {
        hit.blocking = 1;
        hit.fraction = (ground - q.origin.z) / q.motion.z;
        hit.normal = {0, 0, 1};
        return TAHR_OK;
    }
    void sensors(const tahr_sweep &, tahr::answers<tahr_hit> &out)
    {
        tahr_hit h{};
        h.sensor = 1;
        h.fraction = 0.25;
        h.body = 7;
        out.add(h);
    }
    tahr::status body(uint32_t id, tahr_body_motion &motion)
    {
        if (id != 7) return TAHR_E_NOT_FOUND;
        motion.pose = tahr::make_pose({1, 2, 3});
        motion.velocity = {4, 0, 0};
        return TAHR_OK;
    }
    void fluid(const tahr_fluid_query &, tahr_fluid &fluid)
    {
        fluid.immersion = 0.5;
        fluid.body = 7;
    }
};

static void check_everything(const tahr::world &world, double ground)
{
    tahr_hit hit = world.sweep(fall_from(3)).value();
    assert_near(hit.fraction, (2.5 - ground) / 6, 1e-12);
    const tahr_ray ray = {{0, 0, 4}, {0, 0, -8}, 0xFFFFFFFFu, TAHR_NO_BODY};
    assert_near(world.ray(ray).value().fraction, (4 - ground) / 8, 1e-12);
    tahr_contact_query near{};
    near.shape = fall_from(1).shape;
    near.position = {0, 0, ground + 0.5};
    near.up = {0, 0, 1};
    near.orientation = {0, 0, 0, 1};
    near.margin = 0.1;
    near.mask = 0xFFFFFFFFu;
    near.ignore_body = TAHR_NO_BODY;
    tahr_contact contacts[4];
    assert_int_equal(world.contacts(near, contacts).value(), 3);
    assert_int_equal(contacts[2].body, 2);
    tahr::result<uint32_t> two = world.contacts(near, {contacts, 2});
    assert_int_equal(two.code(), TAHR_TRUNCATED);
    assert_int_equal(*two, 2);
    tahr_sweep feel = fall_from(3);
    feel.flags = TAHR_SWEEP_SENSORS;
    tahr_hit felt[2];
    assert_int_equal(world.sweep(feel, felt).value(), 1);
    assert_int_equal(felt[0].body, 7);
    assert_near(world.body(7).value().velocity.x, 4, 0);
    assert_int_equal(world.body(8).code(), TAHR_E_NOT_FOUND);
    const tahr_fluid_query wet = {{0, 0, 1}, {0, 0, 1}, 0.3, 0.9, 0xFFFFFFFFu, 0};
    assert_near(world.fluid(wet).value().immersion, 0.5, 0);
}

static void object_answers_all_that_it_has(void **)
{
    everything mine;
    tahr::world owned = tahr::world::open(everything{0.25}).value();
    check_everything(owned, 0.25);
    tahr::world borrowed = tahr::world::open(&mine).value();
    check_everything(borrowed, 0);
    mine.ground = 0.5;
    assert_int_equal(borrowed.touch().code(), TAHR_OK);
    check_everything(borrowed, 0.5);
}

static void lambdas_together_are_an_engine(void **)
{
    everything e;
    tahr::world world =
        tahr::world::open(
            tahr::engine{
                tahr::on_sweep{[&e](const tahr_sweep &q, tahr_hit &hit) { e.sweep(q, hit); }},
                tahr::on_contacts{
                    [&e](const tahr_contact_query &q, tahr::answers<tahr_contact> &out) { e.contacts(q, out); }},
                tahr::on_ray{[&e](const tahr_ray &q, tahr_hit &hit) { return e.ray(q, hit); }},
                tahr::on_sensors{[&e](const tahr_sweep &q, tahr::answers<tahr_hit> &out) { e.sensors(q, out); }},
                tahr::on_body{[&e](uint32_t id, tahr_body_motion &motion) { return e.body(id, motion); }},
                tahr::on_fluid{[&e](const tahr_fluid_query &q, tahr_fluid &fluid) { e.fluid(q, fluid); }}})
            .value();
    check_everything(world, 0);
}

/* Without a ray of its own one is derived: a sphere of 1 mm is swept. */
static void missing_functions_are_derived(void **)
{
    tahr::world world = tahr::world::open(tahr::engine{tahr::on_sweep{meet_plane}}).value();
    const tahr_ray ray = {{0, 0, 4}, {0, 0, -8}, 0xFFFFFFFFu, TAHR_NO_BODY};
    tahr_hit hit = world.ray(ray).value();
    assert_int_equal(hit.blocking, 1);
    assert_near(hit.fraction, 0.5, 0.001);
    assert_true(hit.fraction < 0.5);
}

static void flags_and_mistakes_reach_the_library(void **)
{
    assert_says(tahr::world::open(plain_function, 1u << 30), TAHR_E_UNSUPPORTED, "flags");
    everything *nobody = nullptr;
    assert_says(tahr::world::open(nobody), TAHR_E_NULL, "engine is NULL");
}

static void status_of_a_lambda_ends_the_step(void **)
{
    tahr_status answer = TAHR_OK;
    tahr::world world = tahr::world::open([&answer](const tahr_sweep &q, tahr_hit &hit) {
                            meet_plane(q, hit);
                            return answer;
                        }).value();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing(), before = state;
    answer = TAHR_E_FILE;
    assert_says(mover.step(wish(1, 0), DT, state), TAHR_E_BACKEND, "file");
    assert_memory_equal(&state, &before, sizeof state);
    answer = TAHR_OK;
    assert_int_equal(mover.step(wish(1, 0), DT, state).code(), TAHR_OK);
}

/* Triangles of the plane z = 0 around the box that is asked for. */
static void add_ground(const tahr_bounds &box, tahr::triangles &out)
{
    double x0 = box.min.x - 1, x1 = box.max.x + 1, y0 = box.min.y - 1, y1 = box.max.y + 1;
    tahr_triangle t{};
    t.body = 5;
    const tahr_vec3 corners[4] = {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
    for (uint32_t half = 0; half < 2; half++) {
        t.corners[0] = corners[0];
        t.corners[1] = corners[1 + half];
        t.corners[2] = corners[2 + half];
        t.feature = half;
        out.add(t);
    }
}

static void gathering_lambda_is_walked_on(void **)
{
    int calls = 0, alive = 0;
    {
        tahr::world world =
            tahr::world::open(tahr::gathering([&calls, token = counted(alive)](const tahr_bounds &box, uint32_t,
                                                                               tahr::triangles &out) {
                calls++;
                add_ground(box, out);
            })).value();
        assert_int_equal(alive, 1);
        tahr_hit hit = world.sweep(fall_from(3)).value();
        assert_near(hit.fraction, 2.5 / 6, 1e-9);
        assert_int_equal(hit.body, 5);
        assert_true(calls > 0);
        assert_string_equal(world.backend_name(), "native");
    }
    assert_int_equal(alive, 0);
    tahr_native_desc options = tahr::make_native_desc();
    options.cache_triangles = 1000000;
    auto nothing = [](const tahr_bounds &, uint32_t, tahr::triangles &) {};
    assert_says(tahr::world::open(tahr::gathering(nothing, options)), TAHR_E_ARGUMENT, "cache_triangles");
}

static void bad_triangle_is_named(void **)
{
    tahr::world world = tahr::world::open(tahr::gathering([](const tahr_bounds &, uint32_t, tahr::triangles &out) {
                            tahr_triangle t{};
                            t.corners[1].x = 1e300;
                            out.add(t);
                        })).value();
    assert_says(world.sweep(fall_from(3)), TAHR_E_BACKEND, "corner");
}

/* Counts what is taken and given back. */
struct ledger {
    size_t taken = 0, given = 0;
    tahr_allocator allocator()
    {
        return {this,
                [](void *user, size_t size, size_t alignment) noexcept {
                    static_cast<ledger *>(user)->taken += size;
                    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
                },
                [](void *user, void *memory, size_t size, size_t alignment) noexcept {
                    static_cast<ledger *>(user)->given += memory ? size : 0;
                    ::operator delete(memory, std::align_val_t(alignment));
                }};
    }
};

static void all_memory_is_of_the_users_allocator(void **)
{
    ledger book;
    const tahr_allocator allocator = book.allocator();
    tahr_world_desc desc = tahr::make_world_desc();
    desc.allocator = &allocator;
    struct large {
        char bytes[100000] = {};
        void sweep(const tahr_sweep &q, tahr_hit &hit)
        {
            meet_plane(q, hit);
        }
    };
    {
        tahr::world world = tahr::world::open(large{}, 0, desc).value();
        assert_true(book.taken > 100000);
        tahr::mover mover = tahr::mover::create(world, precise()).value();
        size_t before = book.taken;
        assert_true(walk(mover) == walk_over_c());
        assert_int_equal(book.taken, before);
    }
    assert_int_equal(book.taken, book.given);
    const tahr_allocator empty = {nullptr, [](void *, size_t, size_t) -> void * { return nullptr; }, allocator.free};
    desc.allocator = &empty;
    assert_says(tahr::world::open(large{}, 0, desc), TAHR_E_MEMORY, "allocator");
}

#ifndef TAHR_CPP_NO_EXCEPTIONS
struct broken_level {
    int number;
};

static void exceptions_come_out_of_value(void **)
{
    int throws = 0;
    tahr::world world = tahr::world::open([&throws](const tahr_sweep &q, tahr_hit &hit) {
                            if (throws == 1) throw std::out_of_range("sector 7");
                            if (throws == 2) throw broken_level{42};
                            meet_plane(q, hit);
                        }).value();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing(), before = state;
    int caught = 0;
    throws = 1;
    tahr::status failed = mover.step(wish(1, 0), DT, state);
    assert_says(failed, TAHR_E_BACKEND, "a callback threw: sector 7");
    try {
        failed.value();
    } catch (const std::out_of_range &e) {
        caught += !strcmp(e.what(), "sector 7");
    }
    throws = 2;
    try {
        world.sweep(fall_from(3)).value();
    } catch (const broken_level &e) {
        caught += e.number == 42;
    }
    assert_int_equal(caught, 2);
    assert_memory_equal(&state, &before, sizeof state);
    throws = 0;
    assert_int_equal(mover.step(wish(1, 0), DT, state).value(), TAHR_OK);
}

static void unread_exceptions_are_forgotten(void **)
{
    int throws = 1;
    tahr::world world = tahr::world::open([&throws](const tahr_sweep &q, tahr_hit &hit) -> tahr_status {
                            if (throws == 1) throw std::out_of_range("sector 7");
                            meet_plane(q, hit);
                            return throws == 2 ? TAHR_E_FILE : TAHR_OK;
                        }).value();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing();
    assert_false(mover.step(wish(1, 0), DT, state).ok());
    throws = 2;
    int caught = 0;
    try {
        mover.step(wish(1, 0), DT, state).value();
    } catch (const tahr::error &e) {
        caught++;
        assert_int_equal(e.code(), TAHR_E_BACKEND);
        assert_null(strstr(e.what(), "sector 7"));
    }
    assert_int_equal(caught, 1);
}

/* The error of a question that a callback asks itself, by value(). */
static void errors_of_inner_calls_come_out(void **)
{
    tahr::world inner = open_floor();
    tahr::world world = tahr::world::open([&inner](const tahr_sweep &, tahr_hit &hit) {
                            tahr_sweep wrong = fall_from(3);
                            wrong.margin = -1;
                            hit = inner.sweep(wrong).value();
                        }).value();
    int caught = 0;
    try {
        world.sweep(fall_from(3)).value();
    } catch (const tahr::error &e) {
        caught++;
        assert_int_equal(e.code(), TAHR_E_ARGUMENT);
        assert_non_null(strstr(e.what(), "margin"));
    }
    assert_int_equal(caught, 1);
}

static void exceptions_of_gathering_come_out(void **)
{
    tahr::world world = tahr::world::open(tahr::gathering([](const tahr_bounds &, uint32_t, tahr::triangles &) {
                            throw std::out_of_range("sector 8");
                        })).value();
    int caught = 0;
    try {
        world.sweep(fall_from(3)).value();
    } catch (const std::out_of_range &e) {
        caught += !strcmp(e.what(), "sector 8");
    }
    assert_int_equal(caught, 1);
}
#endif

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lambda_moves_as_a_function_of_c),
        cmocka_unit_test(function_is_an_engine_too),
        cmocka_unit_test(lambda_stays_when_worlds_and_movers_move),
        cmocka_unit_test(object_answers_all_that_it_has),
        cmocka_unit_test(lambdas_together_are_an_engine),
        cmocka_unit_test(missing_functions_are_derived),
        cmocka_unit_test(flags_and_mistakes_reach_the_library),
        cmocka_unit_test(status_of_a_lambda_ends_the_step),
        cmocka_unit_test(gathering_lambda_is_walked_on),
        cmocka_unit_test(bad_triangle_is_named),
        cmocka_unit_test(all_memory_is_of_the_users_allocator),
#ifndef TAHR_CPP_NO_EXCEPTIONS
        cmocka_unit_test(exceptions_come_out_of_value),
        cmocka_unit_test(unread_exceptions_are_forgotten),
        cmocka_unit_test(errors_of_inner_calls_come_out),
        cmocka_unit_test(exceptions_of_gathering_come_out),
#endif
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

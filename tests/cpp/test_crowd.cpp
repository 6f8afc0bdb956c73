/* SPDX-License-Identifier: MIT
 * test_crowd.cpp: crowds over containers, on the user's scheduler and on the pool of threads, with the bits of C. */
#include "cpp_test.hpp"

#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.hpp>
#endif

/* Enough to be cut into tasks. */
enum : uint32_t { COUNT = 96 };

static tahr_crowd_desc crowd_of(const tahr_config &config)
{
    tahr_crowd_desc desc = tahr::make_crowd_desc();
    desc.capacity = COUNT;
    desc.configs = &config;
    desc.config_count = 1;
    return desc;
}

static std::vector<tahr_state> states_of_all()
{
    std::vector<tahr_state> states;
    for (uint32_t i = 0; i < COUNT; i++)
        states.push_back(standing(i % 12 - 5.5, i / 12 - 3.5));
    return states;
}

/* Everybody to the middle. */
static void wish_inward(const std::vector<tahr_state> &states, std::vector<tahr_input> &inputs)
{
    inputs.clear();
    for (const tahr_state &s : states)
        inputs.push_back(wish(-s.position.x, -s.position.y));
}

static uint64_t hash_of(const std::vector<tahr_state> &states)
{
    uint64_t hash = 0;
    for (const tahr_state &s : states)
        hash = hash * 31 + tahr::hash(s);
    return hash;
}

static uint64_t gather_in(tahr::crowd &crowd)
{
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs;
    for (int i = 0; i < 30; i++) {
        wish_inward(states, inputs);
        assert_true(crowd.step(DT, inputs, states).ok());
    }
    return hash_of(states);
}

static uint64_t gather_in_c(const tahr::world &world)
{
    const tahr_config config = precise();
    const tahr_crowd_desc desc = crowd_of(config);
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs;
    tahr_crowd *crowd = nullptr;
    assert_int_equal(tahr_crowd_create(world.handle(), &desc, &crowd), TAHR_OK);
    for (int i = 0; i < 30; i++) {
        tahr_crowd_tick tick;
        wish_inward(states, inputs);
        tahr_crowd_tick_init(&tick, sizeof tick);
        tick.count = COUNT;
        tick.dt = DT;
        tick.inputs = inputs.data();
        tick.states = states.data();
        assert_true(tahr_crowd_step(crowd, &tick) >= 0);
    }
    tahr_crowd_destroy(crowd);
    return hash_of(states);
}

static void containers_step_as_arrays_of_c(void **)
{
    tahr::world world = open_floor();
    const tahr_config config = precise();
    tahr::crowd crowd = tahr::crowd::create(world, crowd_of(config)).value();
    assert_true(gather_in(crowd) == gather_in_c(world));
    assert_int_equal(crowd.counts()->steps, 30 * COUNT);
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs;
    std::array<tahr_report, COUNT> reports;
    std::vector<tahr_status> statuses(COUNT, -1);
    reports.fill(tahr::make_report());
    wish_inward(states, inputs);
    assert_true(crowd.step(DT, inputs, states, {{}, reports, statuses, {}}).ok());
    assert_int_equal(statuses[COUNT - 1], TAHR_OK);
    assert_true(reports[COUNT - 1].slices > 0);
}

static void sizes_that_differ_are_named(void **)
{
    tahr::world world = open_floor();
    const tahr_config config = precise();
    tahr::crowd crowd = tahr::crowd::create(world, crowd_of(config)).value();
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs(COUNT, tahr::make_input());
    uint64_t before = hash_of(states);
    assert_says(crowd.step(DT, {inputs.data(), 3}, states), TAHR_E_ARGUMENT,
                "inputs has 3 elements, expected 96, as many as states");
    std::vector<tahr_member> members(1);
    std::vector<tahr_report> reports(2, tahr::make_report());
    std::vector<tahr_status> statuses(5);
    std::vector<tahr_delay> delays(6);
    assert_says(crowd.step(DT, inputs, states, {members, {}, {}, {}}), TAHR_E_ARGUMENT, "members has 1");
    assert_says(crowd.step(DT, inputs, states, {{}, reports, {}, {}}), TAHR_E_ARGUMENT, "reports has 2");
    assert_says(crowd.step(DT, inputs, states, {{}, {}, statuses, {}}), TAHR_E_ARGUMENT, "statuses has 5");
    assert_says(crowd.step(DT, inputs, states, {{}, {}, {}, delays}), TAHR_E_ARGUMENT, "delays has 6");
    assert_says(crowd.step(-1, inputs, states), TAHR_E_ARGUMENT, "dt");
    assert_true(hash_of(states) == before);
}

static void failed_character_is_named(void **)
{
    tahr::world world = open_floor();
    const tahr_config config = precise();
    tahr::crowd crowd = tahr::crowd::create(world, crowd_of(config)).value();
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs(COUNT, tahr::make_input());
    inputs[7].move.x = 1e300;
    assert_says(crowd.step(DT, inputs, states), TAHR_E_ARGUMENT, "character 7");
}

/* Every task on a thread of its own. */
struct thread_each {
    int *calls;
    void operator()(tahr::task task, uint32_t count) const
    {
        std::vector<std::thread> threads;
        ++*calls;
        for (uint32_t i = 0; i < count; i++)
            threads.emplace_back([task, i] { task(i); });
        for (std::thread &t : threads)
            t.join();
    }
};

static void scheduler_runs_all_tasks(void **)
{
    int calls = 0, alive = 0;
    tahr::world world = open_floor();
    uint64_t expected = gather_in_c(world);
    const tahr_config config = precise();
    tahr_crowd_desc desc = crowd_of(config);
    desc.tasks = 4;
    {
        auto backwards = [&calls, token = counted(alive)](tahr::task task, uint32_t count) {
            calls++;
            while (count > 0)
                task(--count);
        };
        tahr::crowd crowd = tahr::crowd::create(world, desc, std::move(backwards)).value();
        tahr::crowd moved(std::move(crowd));
        assert_true(gather_in(moved) == expected);
        assert_int_equal(alive, 2);
        assert_true(calls > 0);
        moved = tahr::crowd::create(world, desc, thread_each{&calls}).value();
        assert_int_equal(alive, 1);
        assert_true(gather_in(moved) == expected);
    }
    assert_int_equal(alive, 0);
}

static void crowds_keep_their_world(void **)
{
    tahr::crowd orphan;
    const tahr_config config = precise();
    uint64_t expected;
    {
        tahr::world world = open_floor();
        expected = gather_in_c(world);
        orphan = tahr::crowd::create(world, crowd_of(config)).value();
    }
    assert_true(gather_in(orphan) == expected);
    assert_int_equal(tahr::crowd().step(tahr_crowd_tick{}).code(), TAHR_E_NULL);
}

static void words_of_other_threads_are_heard(void **)
{
    int calls = 0;
    tahr::world world = tahr::world::open(tahr::gathering([](const tahr_bounds &, uint32_t, tahr::triangles &out) {
                            tahr_triangle t{};
                            t.corners[1].x = 1e300;
                            out.add(t);
                        })).value();
    const tahr_config config = precise();
    tahr::crowd crowd = tahr::crowd::create(world, crowd_of(config), thread_each{&calls}).value();
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs(COUNT, tahr::make_input());
    assert_says(crowd.step(DT, inputs, states), TAHR_E_BACKEND, "corner");
    assert_true(calls > 0);
}

#ifndef TAHR_CPP_NO_EXCEPTIONS
static void exceptions_come_out_of_other_threads(void **)
{
    bool throws = true;
    int calls = 0, caught = 0;
    tahr::world world = tahr::world::open([&throws](const tahr_sweep &q, tahr_hit &hit) {
                            if (throws) throw std::out_of_range("sector 7");
                            meet_plane(q, hit);
                        }).value();
    const tahr_config config = precise();
    tahr_crowd_desc desc = crowd_of(config);
    desc.tasks = 4;
    tahr::crowd threaded = tahr::crowd::create(world, desc, thread_each{&calls}).value();
    tahr::crowd alone = tahr::crowd::create(world, desc).value();
    std::vector<tahr_state> states = states_of_all();
    std::vector<tahr_input> inputs(COUNT, tahr::make_input());
    uint64_t before = hash_of(states);
    for (tahr::crowd *crowd : {&threaded, &alone}) {
        try {
            crowd->step(DT, inputs, states).value();
        } catch (const std::out_of_range &e) {
            caught += !strcmp(e.what(), "sector 7");
        }
    }
    assert_int_equal(caught, 2);
    assert_true(calls > 0);
    assert_true(hash_of(states) == before);
    throws = false;
    assert_true(threaded.step(DT, inputs, states).ok());
    assert_true(hash_of(states) != before);
}
#endif

#ifdef TAHR_HAVE_THREADS
static void pool_of_threads_is_a_scheduler(void **)
{
    tahr::world world = open_floor();
    uint64_t expected = gather_in_c(world);
    const tahr_config config = precise();
    tahr::crowd crowd;
    {
        tahr::threads pool = tahr::threads::create(3).value();
        assert_int_equal(pool.count(), 3);
        crowd = tahr::crowd::create(world, crowd_of(config), pool.scheduler()).value();
    }
    assert_true(gather_in(crowd) == expected);
    tahr::threads of_c = tahr::threads::create(2).value(), none;
    crowd = tahr::crowd::create(world, crowd_of(config), none.scheduler()).value();
    assert_true(gather_in(crowd) == expected);
    assert_int_equal(none.count(), 0);
    assert_says(tahr::threads::create(1000), TAHR_E_ARGUMENT, "count is 1000");
}
#endif

/* One for every call of tahr_run_tasks_fn. */
static void run_in_order(void *user, tahr_task_fn task, void *argument, uint32_t count)
{
    ++*static_cast<int *>(user);
    for (uint32_t i = 0; i < count; i++)
        task(argument, i);
}

static void scheduler_of_c_is_run(void **)
{
    int calls = 0;
    tahr::world world = open_floor();
    const tahr_config config = precise();
    tahr_crowd_desc desc = crowd_of(config);
    desc.run_tasks = run_in_order;
    desc.run_user = &calls;
    tahr::crowd crowd = tahr::crowd::create(world, desc).value();
    assert_true(gather_in(crowd) == gather_in_c(world));
    assert_true(calls >= 30);
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(containers_step_as_arrays_of_c),
        cmocka_unit_test(sizes_that_differ_are_named),
        cmocka_unit_test(failed_character_is_named),
        cmocka_unit_test(scheduler_runs_all_tasks),
        cmocka_unit_test(scheduler_of_c_is_run),
        cmocka_unit_test(crowds_keep_their_world),
        cmocka_unit_test(words_of_other_threads_are_heard),
#ifndef TAHR_CPP_NO_EXCEPTIONS
        cmocka_unit_test(exceptions_come_out_of_other_threads),
#endif
#ifdef TAHR_HAVE_THREADS
        cmocka_unit_test(pool_of_threads_is_a_scheduler),
#endif
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

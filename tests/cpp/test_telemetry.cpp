/* SPDX-License-Identifier: MIT
 * test_telemetry.cpp: lambdas and objects as sinks: told what functions of C are told, kept as long as the telemetry's
 * thread may call them, and what they throw comes out of stop(). */
#include "cpp_test.hpp"

#include <condition_variable>
#include <mutex>

#include <tahr/telemetry.hpp>

static const int STEPS = 120;

static tahr_input walk_input(int i)
{
    tahr_input input = wish(i < 80 ? 1 : 0, 0.3);
    input.jump = i == 30;
    return input;
}

/* The walk, by telemetry.step; returns the state after it. */
static tahr_state walk_told(tahr::telemetry &telemetry, tahr::mover &mover, const tahr::track &who = {})
{
    tahr_state state = standing();
    tahr::event_report<16> report;
    for (int i = 0; i < STEPS; i++)
        assert_int_equal(telemetry.step(who, mover, walk_input(i), DT, state, &report).value(), TAHR_OK);
    return state;
}

/* Hears everything. */
struct ears {
    uint32_t heard[TAHR_MESSAGE_COUNT] = {};
    uint32_t flushes = 0, step_flags = 0, kind = 0;
    uint64_t hash = 0, last_state = 0, revision = 0;
    std::string level, backend;
    std::thread::id thread;

    void state(const tahr_stamp &, const tahr_state &state)
    {
        heard[TAHR_MESSAGE_STATE]++;
        last_state = tahr::hash(state);
        hash = hash * 31 + last_state;
        thread = std::this_thread::get_id();
    }
    void event(const tahr_stamp &, const tahr_event &)
    {
        heard[TAHR_MESSAGE_EVENT]++;
    }
    tahr_status input(const tahr_stamp &, const tahr_sink_input &input)
    {
        heard[TAHR_MESSAGE_INPUT]++;
        step_flags = input.flags;
        return TAHR_OK;
    }
    tahr::status report(const tahr_stamp &, const tahr_sink_report &report)
    {
        heard[TAHR_MESSAGE_REPORT]++;
        return report.hash == last_state ? TAHR_OK : TAHR_E_ARGUMENT;
    }
    void snapshot(const tahr_stamp &, const tahr_state &)
    {
        heard[TAHR_MESSAGE_SNAPSHOT]++;
    }
    void change(const tahr_sink_change &change)
    {
        heard[TAHR_MESSAGE_BODY]++;
        kind = change.kind;
        revision = change.revision;
    }
    void world(const tahr_sink_world &world)
    {
        heard[TAHR_MESSAGE_WORLD]++;
        level = world.level;
        backend = world.backend;
    }
    void flush()
    {
        flushes++;
    }
};

static void object_hears_what_was_counted(void **)
{
    ears heard;
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config config = precise();
    tahr_telemetry_desc desc = tahr::make_telemetry_desc();
    desc.configs = &config;
    desc.config_count = desc.characters = 1;
    desc.level = "floor";
    desc.backend = world.backend_name();
    tahr::telemetry telemetry = tahr::telemetry::create(desc, &heard).value();
    uint64_t end = tahr::hash(walk_told(telemetry, mover));
    world.touch().value();
    assert_int_equal(telemetry.change(world, TAHR_CHANGE_TOUCH).value(), TAHR_OK);
    assert_int_equal(telemetry.stop().value(), TAHR_OK);
    assert_int_equal(telemetry.stop().value(), TAHR_OK);
    const tahr_telemetry_counts counts = telemetry.counts().value();
    for (uint32_t kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        assert_int_equal(heard.heard[kind], counts.delivered[kind]);
        assert_true(counts.delivered[kind] > 0);
        assert_int_equal(counts.failed[kind], 0);
    }
    assert_int_equal(heard.heard[TAHR_MESSAGE_STATE], STEPS);
    assert_int_equal(heard.heard[TAHR_MESSAGE_INPUT], STEPS);
    assert_int_equal(heard.heard[TAHR_MESSAGE_REPORT], STEPS);
    assert_int_equal(heard.heard[TAHR_MESSAGE_SNAPSHOT], 1);
    assert_int_equal(heard.heard[TAHR_MESSAGE_BODY], 1);
    assert_true(heard.last_state == end);
    assert_int_equal(heard.kind, TAHR_CHANGE_TOUCH);
    assert_true(heard.revision == world.revision());
    assert_true(heard.flushes > 0);
    assert_string_equal(heard.level.c_str(), "floor");
    assert_string_equal(heard.backend.c_str(), "native");
    assert_true(heard.thread != std::this_thread::get_id());
}

/* The states are those of the same walk without telemetry, and the last are delivered by the destructor. */
static void lambda_hears_every_state(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise()};
    uint64_t hash = 0, expected = walk(mover);
    int states = 0;
    {
        tahr::telemetry telemetry =
            tahr::telemetry::create(world, configs, 4, [&](const tahr_stamp &stamp, const tahr_state &state) {
                states += stamp.character == 3;
                hash = hash * 31 + tahr::hash(state);
            }).value();
        tahr::telemetry moved = std::move(telemetry);
        assert_false(static_cast<bool>(telemetry));
        assert_int_equal(telemetry.stop().code(), TAHR_E_NULL);
        telemetry = std::move(moved);
        walk_told(telemetry, mover, {3});
    }
    assert_int_equal(states, STEPS);
    assert_true(hash == expected);
}

static void step_tells_what_begin_and_push_tell(void **)
{
    ears by_step, by_hand;
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise(), precise()};
    tahr::telemetry one = tahr::telemetry::create(world, configs, 2, &by_step).value();
    tahr::telemetry other = tahr::telemetry::create(world, configs, 2, &by_hand).value();
    const tahr::track who = {1, 0, 1};
    walk_told(one, mover, who);
    tahr_state state = standing();
    tahr::event_report<16> report;
    for (int i = 0; i < STEPS; i++) {
        const tahr_input input = walk_input(i);
        assert_int_equal(other.begin(who, state).value(), TAHR_OK);
        tahr_telemetry_step step{};
        step.character = 77; /* not read */
        step.status = mover.step(input, DT, state, &report).value();
        step.input = &input;
        step.state = &state;
        step.report = &report;
        step.dt = DT;
        assert_int_equal(other.push(who, step).value(), TAHR_OK);
    }
    one.stop().value();
    other.stop().value();
    assert_true(by_step.hash == by_hand.hash);
    for (uint32_t kind = 0; kind < TAHR_MESSAGE_WORLD; kind++)
        assert_int_equal(by_step.heard[kind], by_hand.heard[kind]);
    assert_int_equal(by_step.heard[TAHR_MESSAGE_STATE], STEPS);
}

static void custom_mode_is_told_of(void **)
{
    ears heard;
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise()};
    tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 1, &heard).value();
    mover.set_custom_mode([](tahr::custom_step &, double, tahr_custom_next &) {}).value();
    walk_told(telemetry, mover);
    telemetry.stop().value();
    assert_int_equal(heard.step_flags, TAHR_STEP_CUSTOM);
    tahr::telemetry again = tahr::telemetry::create(world, configs, 1, &heard).value();
    mover.set_custom_mode(nullptr).value();
    walk_told(again, mover);
    again.stop().value();
    assert_int_equal(heard.step_flags, 0);
}

/* Fails, or throws, at every event. */
struct clumsy {
    int *states;
    void state(const tahr_stamp &, const tahr_state &)
    {
        ++*states;
    }
    tahr_status event(const tahr_stamp &stamp, const tahr_event &)
    {
#ifdef TAHR_CPP_NO_EXCEPTIONS
        return stamp.sequence < 9999 ? TAHR_E_BACKEND : TAHR_OK;
#else
        throw std::out_of_range("event " + std::to_string(stamp.sequence));
#endif
    }
};

static void sink_that_throws_is_counted_and_heard_of(void **)
{
    int states = 0;
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise()};
    tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 1, clumsy{&states}).value();
    walk_told(telemetry, mover);
#ifdef TAHR_CPP_NO_EXCEPTIONS
    assert_int_equal(telemetry.stop().value(), TAHR_OK);
#else
    tahr::status stopped = telemetry.stop();
    assert_says(stopped, TAHR_E_BACKEND, "event 0");
    std::string first;
    try {
        stopped.value();
    } catch (const std::out_of_range &e) {
        first = e.what();
    }
    assert_string_equal(first.c_str(), "event 0");
#endif
    assert_int_equal(telemetry.stop().value(), TAHR_OK);
    const tahr_telemetry_counts counts = telemetry.counts().value();
    assert_true(counts.offered[TAHR_MESSAGE_EVENT] > 1);
    assert_int_equal(counts.failed[TAHR_MESSAGE_EVENT], counts.offered[TAHR_MESSAGE_EVENT]);
    assert_int_equal(counts.last_failure, TAHR_E_BACKEND);
    assert_int_equal(states, STEPS);
}

/* Returns from its first call only when it is let go, and says when it is gone itself. */
struct gate {
    std::mutex lock;
    std::condition_variable changed;
    bool entered = false, open = false, gone = false;
    void wait_for(bool &what)
    {
        std::unique_lock<std::mutex> held(lock);
        changed.wait(held, [&] { return what; });
    }
    void set(bool &what)
    {
        std::lock_guard<std::mutex> held(lock);
        what = true;
        changed.notify_all();
    }
};

struct stuck {
    gate *g;
    explicit stuck(gate *waits) : g(waits)
    {
    }
    stuck(stuck &&other) noexcept : g(std::exchange(other.g, nullptr))
    {
    }
    stuck(const stuck &) = delete;
    stuck &operator=(const stuck &) = delete;
    ~stuck()
    {
        if (g) g->set(g->gone);
    }
    void world(const tahr_sink_world &)
    {
        g->set(g->entered);
        g->wait_for(g->open);
    }
};

static void sink_that_hangs_lives_until_it_returns(void **)
{
    gate g;
    {
        const tahr_config configs[] = {precise()};
        tahr::world world = open_floor();
        tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 1, stuck(&g)).value();
        g.wait_for(g.entered);
        assert_says(telemetry.stop(TAHR_STOP_ABANDON, 0), TAHR_E_TIMEOUT, "does not return");
    }
    {
        std::lock_guard<std::mutex> held(g.lock);
        assert_false(g.gone);
    }
    g.set(g.open);
    g.wait_for(g.gone); /* by the thread that was left alone */
    std::lock_guard<std::mutex> held(g.lock);
}

/* After the two seconds of tahr_telemetry_destroy, and without a word in what another call is told. */
static void destructor_lets_a_sink_go_that_hangs(void **)
{
    gate g;
    tahr::world world = open_floor();
    tahr::status failed;
    {
        const tahr_config configs[] = {precise()};
        tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 1, stuck(&g)).value();
        g.wait_for(g.entered);
        failed = telemetry.stop(7, 1);
    }
    assert_says(failed, TAHR_E_ARGUMENT, "how is 7");
    tahr_state state = standing();
    tahr::status other = tahr::telemetry().begin({}, state);
    assert_null(strstr(other.message(), "does not return"));
    g.set(g.open);
    g.wait_for(g.gone);
    std::lock_guard<std::mutex> held(g.lock);
}

static void sink_ends_with_its_telemetry(void **)
{
    int alive = 0;
    const tahr_config configs[] = {precise()};
    tahr::world world = open_floor();
    auto sink_of = [&] { return [token = counted(alive)](const tahr_stamp &, const tahr_state &) {}; };
    tahr::telemetry kept;
    {
        tahr::telemetry made = tahr::telemetry::create(world, configs, 1, sink_of()).value();
        assert_int_equal(alive, 1);
        made.stop().value();
        assert_int_equal(alive, 1);
        kept = std::move(made);
    }
    assert_int_equal(alive, 1);
    kept = tahr::telemetry::create(world, configs, 1, sink_of()).value();
    assert_int_equal(alive, 1);
    kept = tahr::telemetry();
    assert_int_equal(alive, 0);
    assert_int_equal(tahr::telemetry::create(world, configs, 0, sink_of()).code(), TAHR_E_ARGUMENT);
    assert_int_equal(alive, 0);
}

static int c_states;
static tahr_status hear_c(void *, const tahr_stamp *, const tahr_state *)
{
    c_states++;
    return TAHR_OK;
}
static void hear_function(const tahr_stamp &, const tahr_state &)
{
    c_states += 1000;
}

static void sinks_of_c_and_functions_will_do(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise()};
    tahr_sink sink{};
    sink.struct_size = sizeof sink;
    sink.abi_major = TAHR_ABI_MAJOR;
    sink.abi_minor = TAHR_ABI_MINOR;
    sink.name = "c";
    sink.state = hear_c;
    tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 1, &sink).value();
    walk_told(telemetry, mover);
    telemetry.stop().value();
    assert_int_equal(c_states, STEPS);
    tahr::telemetry other = tahr::telemetry::create(world, configs, 1, hear_function).value();
    walk_told(other, mover);
    other.stop().value();
    assert_int_equal(c_states, 1001 * STEPS);
}

static void present_is_answered(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise()};
    ears heard;
    tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 2, &heard).value();
    tahr_state state = standing(5, 5);
    const uint64_t before = tahr::hash(state);
    assert_int_equal(telemetry.latest(1, state).code(), TAHR_E_NOT_FOUND);
    assert_true(tahr::hash(state) == before);
    const uint64_t end = tahr::hash(walk_told(telemetry, mover, {1}));
    tahr_stamp stamp{};
    assert_int_equal(telemetry.latest(1, state, &stamp).value(), TAHR_OK);
    assert_true(tahr::hash(state) == end);
    assert_int_equal(stamp.step, STEPS - 1);
    assert_says(telemetry.latest(2, state), TAHR_E_ARGUMENT, "character is 2, expected below 2");
}

static void wrong_arguments_are_named(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    const tahr_config configs[] = {precise()};
    ears heard, *nobody = nullptr;
    const tahr_sink *no_sink = nullptr;
    assert_says(tahr::telemetry::create(world, configs, 0, &heard), TAHR_E_ARGUMENT, "desc.characters is 0");
    assert_says(tahr::telemetry::create(world, configs, 1, nobody), TAHR_E_NULL, "sink is NULL");
    assert_says(tahr::telemetry::create(world, configs, 1, no_sink), TAHR_E_NULL, "sink is NULL");
    tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 2, &heard).value();
    tahr_state state = standing();
    const uint64_t before = tahr::hash(state);
    const char *words = "character 0 on lane 1 with config 0, dt 0, expected below 2, 1 and 1";
    assert_says(telemetry.step({0, 1}, mover, wish(1, 0), DT, state), TAHR_E_ARGUMENT, words);
    assert_says(telemetry.begin({0, 0, 1}, state), TAHR_E_ARGUMENT, "tahr_telemetry_begin: character 0");
    assert_true(tahr::hash(state) == before);
    assert_says(telemetry.step({}, mover, wish(1, 0), -1, state), TAHR_E_ARGUMENT, "dt");
    assert_true(tahr::hash(state) == before);
    const tahr_input input = wish(1, 0);
    tahr_telemetry_step step{};
    step.input = &input;
    step.state = &state;
    step.dt = 11;
    assert_says(telemetry.push({}, step), TAHR_E_ARGUMENT, "dt 11");
    assert_says(telemetry.change(world, TAHR_CHANGE_MOVE), TAHR_E_ARGUMENT, "with 0 poses and dt 0");
    assert_says(telemetry.stop(7, 1), TAHR_E_ARGUMENT, "how is 7");
    assert_says(tahr::telemetry().begin({}, state), TAHR_E_NULL, "tahr_telemetry_begin");
    assert_int_equal(tahr::telemetry().counts().code(), TAHR_E_NULL);
    telemetry.stop().value();
    assert_int_equal(heard.heard[TAHR_MESSAGE_STATE], 0);
}

static void memory_comes_from_the_allocator_and_goes_back(void **)
{
    const tahr_config config = precise();
    tahr_telemetry_desc desc = tahr::make_telemetry_desc();
    desc.configs = &config;
    desc.config_count = desc.characters = 1;
    int made = 0;
    for (int left = 0; !made; left++) {
        assert_true(left < 10);
        budget b{left};
        const tahr_allocator allocator = {&b, budget::alloc, budget::free};
        desc.allocator = &allocator;
        {
            tahr::result<tahr::telemetry> r = tahr::telemetry::create(desc, ears{});
            made = r.ok();
            if (made) assert_true(b.taken == left && left >= 2);
            if (!made) assert_says(r, TAHR_E_MEMORY, "allocator");
        }
        assert_int_equal(b.taken, 0);
    }
    const tahr_allocator broken = {nullptr, budget::alloc, nullptr};
    desc.allocator = &broken;
    assert_says(tahr::telemetry::create(desc, ears{}), TAHR_E_NULL, "no free");
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(object_hears_what_was_counted),
        cmocka_unit_test(lambda_hears_every_state),
        cmocka_unit_test(step_tells_what_begin_and_push_tell),
        cmocka_unit_test(custom_mode_is_told_of),
        cmocka_unit_test(sink_that_throws_is_counted_and_heard_of),
        cmocka_unit_test(sink_that_hangs_lives_until_it_returns),
        cmocka_unit_test(destructor_lets_a_sink_go_that_hangs),
        cmocka_unit_test(sink_ends_with_its_telemetry),
        cmocka_unit_test(sinks_of_c_and_functions_will_do),
        cmocka_unit_test(present_is_answered),
        cmocka_unit_test(wrong_arguments_are_named),
        cmocka_unit_test(memory_comes_from_the_allocator_and_goes_back),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

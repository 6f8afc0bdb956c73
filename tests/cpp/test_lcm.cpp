/* SPDX-License-Identifier: MIT
 * test_lcm.cpp: telemetry of a walk over LCM's memory queue, from C++: what is published, and by whom it is kept. */
#include "cpp_test.hpp"

#include <cstdio>
#include <cstdlib>
#include <unistd.h>

#include <lcm/lcm.h>
#include <tahr_lcm/tahr_state_t.h>

#include <tahr/lcm.hpp>
#include <tahr/telemetry.hpp>

static const int STEPS = 60;

/* Reads a queue that is filled before. */
struct listener {
    lcm_t *lcm = lcm_create("memq://");
    int states = 0;
    double x = 0;
    std::string channel;
    ~listener()
    {
        lcm_destroy(lcm);
    }
    static void hear(const lcm_recv_buf_t *buffer, const char *channel, void *user)
    {
        listener &self = *static_cast<listener *>(user);
        tahr_state_t state;
        assert_true(tahr_state_t_decode(buffer->data, 0, static_cast<int>(buffer->data_size), &state) >= 0);
        self.states++;
        self.x = state.position[0];
        self.channel = channel;
        tahr_state_t_decode_cleanup(&state);
    }
};

static double walk_told(tahr::telemetry &telemetry, const tahr::world &world)
{
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing();
    for (int i = 0; i < STEPS; i++)
        telemetry.step({}, mover, wish(1, 0), DT, state).value();
    return state.position.x;
}

/* The telemetry keeps the sink, whose owner is gone before the first step. */
static void walk_is_published(void **)
{
    listener l;
    assert_non_null(l.lcm);
    assert_non_null(lcm_subscribe(l.lcm, "A_TAHR_STATE", listener::hear, &l));
    tahr::world world = open_floor();
    const tahr_config configs[] = {precise()};
    tahr_lcm_desc desc = tahr::make_lcm_desc();
    desc.lcm = l.lcm;
    desc.prefix = "A_";
    budget memory{9};
    const tahr_allocator allocator = {&memory, budget::alloc, budget::free};
    desc.allocator = &allocator;
    tahr::telemetry telemetry;
    {
        tahr::lcm lcm = tahr::lcm::open(desc).value();
        tahr::lcm moved = std::move(lcm);
        assert_false(static_cast<bool>(lcm));
        assert_null(lcm.handle());
        assert_non_null(moved.handle());
        telemetry = tahr::telemetry::create(world, configs, 1, moved).value();
    }
    const double x = walk_told(telemetry, world);
    assert_int_equal(telemetry.stop().value(), TAHR_OK);
    assert_true(memory.taken >= 2); /* ours and the library's, which takes more when it publishes */
    const tahr_telemetry_counts counts = telemetry.counts().value();
    assert_int_equal(counts.delivered[TAHR_MESSAGE_STATE], STEPS);
    assert_int_equal(counts.failed[TAHR_MESSAGE_STATE], 0);
    for (int i = 0; i < STEPS; i++)
        assert_int_equal(lcm_handle(l.lcm), 0);
    assert_int_equal(l.states, STEPS);
    assert_near(l.x, x, 0);
    assert_true(x > 1);
    assert_string_equal(l.channel.c_str(), "A_TAHR_STATE");
    telemetry = tahr::telemetry();
    assert_int_equal(memory.taken, 0);
}

static void url_is_enough(void **)
{
    const char *folder = getenv("TMPDIR");
    std::string path = std::string(folder ? folder : "/tmp") + "/tahr_cpp_XXXXXX";
    int file = mkstemp(path.data());
    assert_true(file >= 0);
    close(file);
    {
        tahr::world world = open_floor();
        const tahr_config configs[] = {precise()};
        tahr::lcm lcm = tahr::lcm::open(("file://" + path).c_str()).value();
        tahr::telemetry telemetry = tahr::telemetry::create(world, configs, 1, std::move(lcm)).value();
        (void)walk_told(telemetry, world);
    }
    lcm_eventlog_t *log = lcm_eventlog_create(path.c_str(), "r");
    assert_non_null(log);
    int states = 0;
    for (lcm_eventlog_event_t *e; (e = lcm_eventlog_read_next_event(log)); lcm_eventlog_free_event(e))
        states += strcmp(e->channel, "TAHR_STATE") == 0;
    lcm_eventlog_destroy(log);
    remove(path.c_str());
    assert_int_equal(states, STEPS);
}

static void wrong_descriptions_are_named(void **)
{
    assert_says(tahr::lcm::open("carrier://pigeon"), TAHR_E_UNSUPPORTED, "carrier://pigeon");
    assert_says(tahr::lcm::open("file:///nonexistent/folder/log"), TAHR_E_FILE, "/nonexistent/folder/log");
    tahr_lcm_desc desc = tahr::make_lcm_desc();
    desc.url = "memq://";
    desc.prefix = "two words";
    int told = 0;
    auto count = [&](int32_t, const char *) { told++; };
    const tahr_log log = tahr::log_to(count);
    desc.log = &log;
    assert_says(tahr::lcm::open(desc), TAHR_E_ARGUMENT, "desc.prefix");
    assert_int_equal(told, 1);
    tahr::world world = open_floor();
    const tahr_config configs[] = {precise()};
    assert_says(tahr::telemetry::create(world, configs, 1, tahr::lcm()), TAHR_E_NULL, "sink is NULL");
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walk_is_published),
        cmocka_unit_test(url_is_enough),
        cmocka_unit_test(wrong_descriptions_are_named),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

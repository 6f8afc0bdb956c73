/* SPDX-License-Identifier: MIT
 * test_mover.cpp: steps are those of C, to the bit and to the byte of memory; movers keep their world; custom modes. */
#include "cpp_test.hpp"

#include <cstdlib>

/* What operator new was asked for since the program began. */
static size_t allocations;

void *operator new(size_t size)
{
    allocations++;
    void *memory = malloc(size);
    if (!memory) abort();
    return memory;
}
void *operator new(size_t size, std::align_val_t alignment, const std::nothrow_t &) noexcept
{
    size_t block = static_cast<size_t>(alignment);
    allocations++;
    return aligned_alloc(block, (size + block - 1) / block * block);
}
void operator delete(void *memory, std::align_val_t) noexcept
{
    free(memory);
}
void operator delete(void *memory) noexcept
{
    free(memory);
}
void operator delete(void *memory, size_t) noexcept
{
    free(memory);
}

static void steps_are_those_of_c(void **)
{
    tahr::world world = open_floor();
    const tahr_config config = precise();
    tahr::mover mover = tahr::mover::create(world, config).value();
    tahr_mover *of_c = nullptr;
    assert_int_equal(tahr_mover_create(world.handle(), &config, &of_c), TAHR_OK);
    assert_true(walk(mover) == walk(of_c));
    assert_true(walk(mover) == walk(mover.handle()));
    tahr_mover_destroy(of_c);
}

static void steps_allocate_nothing(void **)
{
    tahr::world world = tahr::world::open(meet_plane).value();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    size_t before = allocations;
    assert_true(before > 0);
    (void)walk(mover);
    tahr_state state = standing();
    assert_int_equal(mover.step(wish(1, 0), -1, state).code(), TAHR_E_ARGUMENT);
    assert_int_equal(allocations, before);
}

static void movers_keep_their_world(void **)
{
    tahr::mover orphan = tahr::mover::create(open_floor(), precise()).value();
    tahr::mover other = tahr::mover::create(open_floor(), precise()).value();
    uint64_t hash = walk(orphan);
    tahr::mover moved(std::move(orphan));
    assert_true(walk(moved) == hash);
    moved = std::move(other);
    assert_true(walk(moved) == hash);
    assert_int_equal(orphan.step(wish(1, 0), DT, *tahr::make_state(precise(), {0, 0, 1})).code(), TAHR_E_NULL);
}

static void reports_have_room_for_events(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = tahr::make_state(precise(), {0, 0, 1.5}).value();
    tahr::event_report<8> report;
    int landed = 0;
    for (int i = 0; i < 60; i++) {
        assert_int_equal(mover.step(wish(0, 0), DT, state, &report).value(), TAHR_OK);
        for (const tahr_event &e : tahr::events(report))
            landed += e.type == TAHR_EVENT_LANDED;
    }
    assert_int_equal(landed, 1);
    tahr_report plain = tahr::make_report();
    assert_int_equal(mover.step(wish(1, 0), DT, state, &plain).value(), TAHR_OK);
    assert_true(tahr::events(plain).empty() && tahr::decisions(plain).empty() && tahr::queries(plain).empty());
}

static tahr_status rise_c(void *, tahr_step *step, double time, tahr_custom_next *next)
{
    const tahr_vec3 motion = {0, 0, 2 * time};
    if (tahr_step_state(step)->position.z > 2) next->mode = TAHR_MODE_FALLING, next->time_left = time;
    return tahr_step_slide(step, &motion, nullptr);
}

static uint64_t rise(tahr::mover &mover, tahr_status last = TAHR_OK)
{
    tahr_state state = standing();
    tahr_input input = wish(0, 0);
    input.flags = TAHR_INPUT_MODE;
    input.mode = TAHR_MODE_CUSTOM;
    uint64_t hash = 0;
    for (int i = 0; i < 60; i++) {
        tahr_status code = mover.step(input, DT, state).code();
        if (code != TAHR_OK) {
            assert_int_equal(code, last);
            return 0;
        }
        input.flags = 0;
        hash = hash * 31 + tahr::hash(state);
    }
    assert_true(state.position.z > 1);
    return hash;
}

static void custom_mode_is_a_lambda(void **)
{
    int alive = 0;
    {
        tahr::mover mover = tahr::mover::create(open_floor(), precise()).value();
        assert_int_equal(tahr_mover_set_custom_mode(mover.handle(), rise_c, nullptr), TAHR_OK);
        uint64_t of_c = rise(mover);
        auto mode = [token = counted(alive)](tahr::custom_step &step, double time, tahr_custom_next &next) {
            if (step.state().position.z > 2) next.mode = TAHR_MODE_FALLING, next.time_left = time;
            return step.slide({0, 0, 2 * time});
        };
        assert_int_equal(mover.set_custom_mode(std::move(mode)).value(), TAHR_OK);
        tahr::mover moved = std::move(mover);
        assert_true(rise(moved) == of_c);
        assert_int_equal(alive, 2);
        assert_int_equal(moved.set_custom_mode(nullptr).value(), TAHR_OK);
        assert_int_equal(alive, 1);
    }
    assert_int_equal(alive, 0);
    assert_int_equal(tahr::mover().set_custom_mode(nullptr).code(), TAHR_E_NULL);
}

static void custom_mode_is_told_of_the_step(void **)
{
    tahr::mover mover = tahr::mover::create(open_floor(), precise()).value();
    int asked = 0;
    auto mode = [&asked](tahr::custom_step &step, double time, tahr_custom_next &) -> tahr::status {
        asked++;
        assert_near(time, DT, 1e-12);
        assert_near(step.gravity().z, -9.81, 0);
        assert_near(step.config().skin, precise().skin, 0);
        assert_int_equal(step.input().mode, TAHR_MODE_CUSTOM);
        assert_int_equal(step.sweep({0, 0, -5})->blocking, 1);
        assert_int_equal(step.ray(step.state().position, {0, 0, -5})->blocking, 1);
        assert_near(step.fluid()->immersion, 0, 0);
        assert_int_equal(step.event(0, 4.5).code(), TAHR_OK);
        assert_says(step.set_velocity({1e300, 0, 0}), TAHR_E_ARGUMENT, "velocity");
        return step.set_velocity({0, 0, 1});
    };
    assert_int_equal(mover.set_custom_mode(mode).value(), TAHR_OK);
    tahr_state state = standing();
    tahr_input input = wish(0, 0);
    input.flags = TAHR_INPUT_MODE;
    input.mode = TAHR_MODE_CUSTOM;
    tahr::event_report<8> report;
    assert_int_equal(mover.step(input, DT, state, &report).value(), TAHR_OK);
    assert_int_equal(asked, 1);
    assert_near(state.velocity.z, 1, 0);
    double value = 0;
    for (const tahr_event &e : tahr::events(report)) {
        if (e.type == TAHR_EVENT_CUSTOM) value = e.value;
    }
    assert_near(value, 4.5, 0);
}

#ifndef TAHR_CPP_NO_EXCEPTIONS
static void exceptions_of_a_custom_mode_come_out(void **)
{
    tahr::mover mover = tahr::mover::create(open_floor(), precise()).value();
    auto mode = [](tahr::custom_step &step, double, tahr_custom_next &) { step.set_velocity({1e300, 0, 0}).value(); };
    assert_int_equal(mover.set_custom_mode(mode).value(), TAHR_OK);
    tahr_state state = standing(), before = state;
    tahr_input input = wish(0, 0);
    input.flags = TAHR_INPUT_MODE;
    input.mode = TAHR_MODE_CUSTOM;
    int caught = 0;
    try {
        mover.step(input, DT, state).value();
    } catch (const tahr::error &e) {
        caught += e.code() == TAHR_E_ARGUMENT && strstr(e.what(), "velocity");
    }
    assert_int_equal(caught, 1);
    assert_memory_equal(&state, &before, sizeof state);
    (void)rise(mover, TAHR_E_BACKEND);
}
#endif

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_those_of_c),
        cmocka_unit_test(steps_allocate_nothing),
        cmocka_unit_test(movers_keep_their_world),
        cmocka_unit_test(reports_have_room_for_events),
        cmocka_unit_test(custom_mode_is_a_lambda),
        cmocka_unit_test(custom_mode_is_told_of_the_step),
#ifndef TAHR_CPP_NO_EXCEPTIONS
        cmocka_unit_test(exceptions_of_a_custom_mode_come_out),
#endif
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

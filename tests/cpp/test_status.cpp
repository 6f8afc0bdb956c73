/* SPDX-License-Identifier: MIT
 * test_status.cpp: what a call came to, in a number, in words, and as an exception or the end of the program. */
#include "cpp_test.hpp"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

static void ok_but_is_no_error(void **)
{
    tahr::status truncated = TAHR_TRUNCATED, failed = TAHR_E_FILE;
    assert_true(truncated && truncated.ok());
    assert_int_equal(truncated.value(), TAHR_TRUNCATED);
    assert_string_equal(truncated.name(), "truncated");
    assert_false(failed.ok());
    assert_int_equal(failed.code(), TAHR_E_FILE);
    assert_string_equal(failed.message(), tahr_status_message(TAHR_E_FILE));
    static_assert(sizeof(tahr::status) == sizeof(tahr_status));
}

static void message_names_the_argument(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing();
    assert_says(mover.step(wish(1e300, 0), DT, state), TAHR_E_ARGUMENT, "tahr_mover_step: input.move");
    assert_says(mover.step(wish(1, 0), -1, state), TAHR_E_ARGUMENT, "tahr_mover_step: dt");
    tahr_config config = precise();
    config.skin = -1;
    assert_says(tahr::mover::create(world, config), TAHR_E_ARGUMENT, "skin");
    assert_says(tahr::check(config), TAHR_E_ARGUMENT, "config.skin");
    assert_says(tahr::make_state(config, {0, 0, 1}), TAHR_E_ARGUMENT, "config.skin");
    assert_says(tahr::make_state(precise(), {1e300, 0, 1}), TAHR_E_ARGUMENT, "position is (1e+300, 0, 1)");
    assert_says(tahr::teleport(state, {0, 1e300, 1}), TAHR_E_ARGUMENT, "position is (0, 1e+300, 1)");
    assert_says(tahr::make_config(77), TAHR_E_ARGUMENT, "preset is 77");
    assert_says(tahr::scale(config, 0), TAHR_E_ARGUMENT, "tahr_config_scale");
}

/* What an older failure said is not taken for the words of a newer one, nor of one of another kind. */
static void message_is_that_of_the_last_failure(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing();
    tahr::status first = mover.step(wish(1, 0), -1, state);
    assert_says(first, TAHR_E_ARGUMENT, "dt");
    tahr::status second = tahr::mover().step(wish(1, 0), DT, state);
    assert_says(second, TAHR_E_NULL, "tahr_mover_step");
    assert_null(strstr(second.message(), "dt"));
    assert_string_equal(first.message(), tahr_status_message(TAHR_E_ARGUMENT));
}

/* The log is told of them too, on the same thread. */
static void failures_of_c_beside_it_do_not_drown_the_words(void **)
{
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_state state = standing();
    const tahr_input input = wish(1e300, 0);
    for (int i = 0; i < 20; i++)
        assert_int_equal(tahr_mover_step(mover.handle(), &input, DT, &state, nullptr), TAHR_E_ARGUMENT);
    assert_says(mover.step(wish(1, 0), -1, state), TAHR_E_ARGUMENT, "tahr_mover_step: dt is -1");
}

static void each_thread_has_its_own_message(void **)
{
    tahr::world world = open_floor();
    tahr::mover here = tahr::mover::create(world, precise()).value();
    tahr_state state = standing();
    tahr::status mine = here.step(wish(1, 0), -1, state);
    std::thread([&world] {
        tahr::mover there = tahr::mover::create(world, precise()).value();
        tahr_state other = standing();
        assert_says(there.step(wish(1e300, 0), DT, other), TAHR_E_ARGUMENT, "input.move");
    }).join();
    assert_says(mine, TAHR_E_ARGUMENT, "dt");
    assert_null(strstr(mine.message(), "input.move"));
}

static void results_hand_over_what_was_made(void **)
{
    tahr::result<tahr_config> config = tahr::make_config(TAHR_PRESET_UNREAL);
    assert_true(config.ok());
    assert_int_equal(config->preset, TAHR_PRESET_UNREAL);
    assert_int_equal(config.value().preset, TAHR_PRESET_UNREAL);
    tahr::result<tahr::world> none = tahr::world::open(nullptr, tahr::view<const tahr_body_desc>());
    assert_int_equal(none.code(), TAHR_E_NULL);
    assert_null(none->handle());
}

#ifdef TAHR_CPP_NO_EXCEPTIONS
static void value_of_an_error_says_it_and_aborts(void **)
{
    int ends[2], state = 0;
    char text[512] = "";
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(ends[1], 2);
        signal(SIGABRT, SIG_DFL);
        (void)tahr::make_config(77).value();
        _exit(0);
    }
    close(ends[1]);
    assert_true(read(ends[0], text, sizeof text - 1) > 0);
    close(ends[0]);
    assert_int_equal(waitpid(child, &state, 0), child);
    assert_true(WIFSIGNALED(state) && WTERMSIG(state) == SIGABRT);
    assert_non_null(strstr(text, "preset is 77"));
}
#else
static void value_of_an_error_throws_it(void **)
{
    int caught = 0;
    try {
        (void)tahr::make_config(77).value();
    } catch (const tahr::error &e) {
        caught++;
        assert_int_equal(e.code(), TAHR_E_ARGUMENT);
        assert_non_null(strstr(e.what(), "preset is 77"));
    }
    try {
        (void)tahr::status(TAHR_E_FILE).value();
    } catch (const std::runtime_error &e) {
        caught++;
        assert_string_equal(e.what(), tahr_status_message(TAHR_E_FILE));
    }
    assert_int_equal(caught, 2);
}
#endif

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ok_but_is_no_error),
        cmocka_unit_test(message_names_the_argument),
        cmocka_unit_test(message_is_that_of_the_last_failure),
        cmocka_unit_test(failures_of_c_beside_it_do_not_drown_the_words),
        cmocka_unit_test(each_thread_has_its_own_message),
        cmocka_unit_test(results_hand_over_what_was_made),
#ifdef TAHR_CPP_NO_EXCEPTIONS
        cmocka_unit_test(value_of_an_error_says_it_and_aborts),
#else
        cmocka_unit_test(value_of_an_error_throws_it),
#endif
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}

/* SPDX-License-Identifier: MIT
 * test_sleep_inputs.c: with all that an input may ask for, among bodies that move now and then, in water and on edges:
 * a mover that sleeps goes the same way as one that never does. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "room.h"

static void asleep_and_awake_go_the_same_way(uint32_t preset, uint64_t seed)
{
    enum { STEPS = 9000 };
    oracle_random dice = {seed};
    rig on, off;
    int asleep = 0, left = 0, modes[TAHR_MODE_CUSTOM + 1] = {0};
    room_open(&on, preset, 1);
    room_open(&off, preset, 0);
    for (int n = 0; n < STEPS; n++) {
        if (left-- == 0) {
            left = (int)oracle_uniform(&dice, 1, 120);
            on.input = off.input = room_input(&dice);
        }
        room_carry(&on, n);
        room_carry(&off, n);
        room_move(&on, n);
        room_move(&off, n);
        room_step(&on);
        room_step(&off);
        if (memcmp(&on.state, &off.state, sizeof on.state) != 0) {
            fail_msg("seed %d, step %d: the states differ", (int)seed, n);
        }
        assert_int_equal(on.status, off.status);
        assert_int_equal(on.report.flags & ~(uint32_t)TAHR_REPORT_ASLEEP, off.report.flags);
        assert_int_equal(on.report.event_count, off.report.event_count);
        assert_memory_equal(on.events, off.events, on.report.event_count * sizeof on.events[0]);
        asleep += (on.report.flags & TAHR_REPORT_ASLEEP) != 0;
        modes[on.state.mode]++;
    }
    print_message("    %d of %d steps asleep\n", asleep, STEPS);
    assert_true(asleep > STEPS / 20); /* and it was worth it */
    assert_true(modes[TAHR_MODE_WALKING] && modes[TAHR_MODE_FALLING] && modes[TAHR_MODE_SWIMMING]);
    rig_close(&on);
    rig_close(&off);
}

static void whatever_is_asked_for_a_sleeper_goes_the_same_way(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        asleep_and_awake_go_the_same_way(TAHR_PRESET_PRECISE, seed);
        asleep_and_awake_go_the_same_way(TAHR_PRESET_UNREAL, seed + 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(whatever_is_asked_for_a_sleeper_goes_the_same_way)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

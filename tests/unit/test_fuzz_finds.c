/* SPDX-License-Identifier: MIT
 * test_fuzz_finds.c: what the fuzzers found, each as the smallest case that failed. The inputs themselves are replayed
 * from fuzz/corpus. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "core.h"
#include "trail.h"

/* fuzz_liar, found_way_without_a_square: the event of a sensor left on a way of 1e-303 m had no time: 0 / 0. */
static void a_way_too_short_to_square_takes_no_time(void **state)
{
    static tahr__step step;
    static tahr__trail trail;
    (void)state;
    memset(&step, 0, sizeof step);
    memset(&trail, 0, sizeof trail);
    step.trail = &trail;
    step.state.position = trail.at = vec(5e-304, 0, 0);
    trail.count = 1;
    trail.legs[0].to = trail.at;
    tahr__trail_stamp(&step, 0.01, 0.02);
    assert_true(trail.legs[0].begin >= 0.01 && trail.legs[0].begin <= trail.legs[0].end);
    assert_true(trail.legs[0].end == 0.02);
    step.state.position = vec(2e-304, 0, 0);
    tahr__trail_cut(&step, vec(0, 0, 0), 0.5);
    assert_true(trail.legs[0].end >= 0.01 && trail.legs[0].end <= 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_way_too_short_to_square_takes_no_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

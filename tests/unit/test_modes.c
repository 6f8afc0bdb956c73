/* SPDX-License-Identifier: MIT
 * test_modes.c: the table of modes, and what changing one says. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "modes.h"
#include "rig.h"

static void every_mode_has_a_name_and_nothing_else_has(void **unused)
{
    (void)unused;
    assert_string_equal(tahr_mode_name(TAHR_MODE_NONE), "none");
    assert_string_equal(tahr_mode_name(TAHR_MODE_WALKING), "walking");
    assert_string_equal(tahr_mode_name(TAHR_MODE_FALLING), "falling");
    for (uint32_t mode = 0; mode < 100; mode++) {
        assert_int_equal(tahr__is_mode(mode), strcmp(tahr_mode_name(mode), "?") != 0);
    }
    assert_false(tahr__is_mode(0xFFFFFFFFu));
}

static void a_change_is_said_once_and_only_if_it_is_one(void **unused)
{
    tahr_event events[4];
    tahr__step step;
    (void)unused;
    memset(&step, 0, sizeof step);
    step.report.events = events;
    step.report.event_capacity = 4;
    step.state.mode = TAHR_MODE_WALKING;
    tahr__change_mode(&step, TAHR_MODE_WALKING);
    assert_int_equal(step.report.event_count, 0);
    tahr__change_mode(&step, TAHR_MODE_FALLING);
    assert_int_equal(step.report.event_count, 1);
    assert_true(events[0].type == TAHR_EVENT_MODE && events[0].value == TAHR_MODE_FALLING);
    assert_int_equal(step.state.mode, TAHR_MODE_FALLING);
}

static void none_takes_all_the_time_and_stays(void **unused)
{
    tahr__step step;
    (void)unused;
    memset(&step, 0, sizeof step);
    step.time = 0.25;
    step.ahead = 7; /* of a slice before */
    assert_true(tahr__run_mode(&step, 0.5) == 0);
    assert_true(step.time == 0.75 && step.ahead == 0 && step.state.mode == TAHR_MODE_NONE);
}

/* A step that lands goes on walking in the time that is left, and the mode's event lies at the landing. */
static void a_step_goes_on_in_the_other_mode(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1.4));
    r.input.move = fake_vec(1, 0, 0);
    rig_step(&r, 0.6);
    const tahr_event *landed = rig_event(&r, TAHR_EVENT_LANDED), *mode = rig_event(&r, TAHR_EVENT_MODE);
    assert_true(landed && mode && mode->time == landed->time && mode->value == TAHR_MODE_WALKING);
    assert_near(landed->time, sqrt(2 * 0.49 / 9.81), 1e-9);
    assert_int_equal(r.report.slices, 2);
    assert_true(r.state.velocity.x > 20.48 * 0.25 * landed->time); /* faster than the air allows alone */
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_mode_has_a_name_and_nothing_else_has),
                                       cmocka_unit_test(a_change_is_said_once_and_only_if_it_is_one),
                                       cmocka_unit_test(none_takes_all_the_time_and_stays),
                                       cmocka_unit_test(a_step_goes_on_in_the_other_mode)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

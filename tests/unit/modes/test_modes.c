/* SPDX-License-Identifier: MIT
 * test_modes.c: the table of modes, and what changing one says. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "modes.h"
#include "pool.h"

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

static void a_change_that_is_not_in_the_table_is_refused(void **unused)
{
    static const uint32_t known[][2] = {{1, 2}, {1, 3}, {2, 1}, {2, 3}, {2, 5}, {3, 1}, {3, 2},
                                        {5, 1}, {5, 2}, {6, 0}, {6, 1}, {6, 2}, {6, 3}, {6, 4}};
    int changes = 0;
    (void)unused;
    for (uint32_t from = 0; from <= TAHR_MODE_CUSTOM; from++) {
        for (uint32_t to = 0; to <= TAHR_MODE_CUSTOM + 2; to++) {
            int there = 0;
            tahr__step step;
            memset(&step, 0, sizeof step);
            step.state.mode = from;
            for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
                there |= known[i][0] == from && known[i][1] == to;
            }
            tahr__change_mode(&step, to);
            assert_int_equal(step.state.mode, there ? to : from);
            assert_int_equal(step.report.flags, there || from == to ? 0 : TAHR_REPORT_MODE_REFUSED);
            assert_int_equal(tahr__transition(from, to) != NULL, there);
            changes += there;
        }
    }
    assert_int_equal(changes, sizeof known / sizeof known[0]);
}

/* Asks for a mode in one step of a millisecond. Returns 1 if it was granted. */
static int ask(rig *r, uint32_t mode)
{
    r->input.flags = TAHR_INPUT_MODE;
    r->input.mode = mode;
    rig_step(r, 1e-3);
    r->input.flags = 0;
    assert_int_equal((r->report.flags & TAHR_REPORT_MODE_REFUSED) != 0, r->state.mode != mode);
    return r->state.mode == mode;
}

static void what_is_asked_for_is_granted_where_it_makes_sense(void **unused)
{
    pool p;
    rig r;
    (void)unused;
    pool_init(&p);
    fake_add_box(&p.world, fake_vec(-5, -5, -1), fake_vec(5, 5, 3));
    pool_open(&r, &p, NULL, fake_vec(0, 0, 4));
    rig_settle(&r);
    assert_true(ask(&r, TAHR_MODE_NONE));
    assert_true(r.state.floor.flags & TAHR_FLOOR_WALKABLE); /* it still stands there */
    assert_true(ask(&r, TAHR_MODE_WALKING));
    assert_true(ask(&r, TAHR_MODE_FLYING));
    const tahr_event *left = rig_event(&r, TAHR_EVENT_LEFT_GROUND), *mode = rig_event(&r, TAHR_EVENT_MODE);
    assert_true(left && left->value == TAHR_LEFT_MODE && mode && mode->value == TAHR_MODE_FLYING);
    assert_true(r.state.floor.flags == 0 && r.state.floor.body == TAHR_NO_BODY && r.state.floor_revision == 0);
    assert_false(ask(&r, TAHR_MODE_SWIMMING)); /* in the air */
    assert_false(ask(&r, TAHR_MODE_HANGING));
    assert_false(ask(&r, TAHR_MODE_CUSTOM));
    r.state.position.z += 0.3; /* within snap_distance */
    assert_true(ask(&r, TAHR_MODE_WALKING));
    assert_non_null(rig_event(&r, TAHR_EVENT_LANDED));
    assert_near(r.state.position.z, 3.9 + 1.25 * 0.01, 1e-9);
    assert_true(ask(&r, TAHR_MODE_FLYING));
    r.state.position.z += 1;
    assert_false(ask(&r, TAHR_MODE_WALKING)); /* too high */
    assert_true(ask(&r, TAHR_MODE_FALLING));
    r.state.position = fake_vec(20, 0, -3);
    assert_true(ask(&r, TAHR_MODE_FLYING)); /* flies under water too */
    assert_true(ask(&r, TAHR_MODE_SWIMMING));
    rig_close(&r);
}

/* Writing the mode between steps is another way to ask; where it makes no sense the mode itself goes on to another. */
static void a_mode_that_is_written_where_it_cannot_be_ends_by_itself(void **unused)
{
    const uint32_t modes[] = {TAHR_MODE_WALKING, TAHR_MODE_SWIMMING};
    (void)unused;
    for (int i = 0; i < 2; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 30));
        r.state.mode = modes[i];
        rig_step(&r, 0.1);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_near(r.state.position.z, 30 - 0.5 * 9.81 * 0.01, 1e-12); /* in all of the time */
        rig_close(&r);
    }
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
                                       cmocka_unit_test(a_change_that_is_not_in_the_table_is_refused),
                                       cmocka_unit_test(what_is_asked_for_is_granted_where_it_makes_sense),
                                       cmocka_unit_test(a_mode_that_is_written_where_it_cannot_be_ends_by_itself),
                                       cmocka_unit_test(none_takes_all_the_time_and_stays),
                                       cmocka_unit_test(a_step_goes_on_in_the_other_mode)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

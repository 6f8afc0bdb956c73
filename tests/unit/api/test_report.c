/* SPDX-License-Identifier: MIT
 * test_report.c: arrays that are too small, absent, or never asked for. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "report.h"
#include "rig.h"

/* One jump from start to landing in one step: six events or more. */
static tahr_status jump(uint32_t events, uint32_t decisions, tahr_report *report, tahr_state *end, tahr_event *storage)
{
    fake_world w;
    rig r;
    static tahr_decision kept[64];
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.jump = 1;
    memset(report, 0, sizeof *report);
    report->struct_size = sizeof *report;
    report->events = storage;
    report->event_capacity = events;
    report->decisions = decisions ? kept : NULL;
    report->decision_capacity = decisions;
    tahr_status status = tahr_mover_step(r.mover, &r.input, 1, &r.state, report);
    *end = r.state;
    rig_close(&r);
    return status;
}

static void events_that_do_not_fit_are_counted_and_flagged(void **unused)
{
    tahr_event all[32], some[33];
    tahr_report full, short_report;
    tahr_state a, b;
    (void)unused;
    assert_int_equal(jump(32, 0, &full, &a, all), TAHR_OK);
    assert_true(full.event_count >= 5 && full.events_lost == 0);
    for (uint32_t capacity = 0; capacity < full.event_count; capacity++) {
        memset(some, 0x12, sizeof some);
        assert_int_equal(jump(capacity, 0, &short_report, &b, some), TAHR_TRUNCATED);
        assert_int_equal(short_report.event_count, capacity);
        assert_int_equal(short_report.events_lost, full.event_count - capacity);
        assert_true(short_report.flags & TAHR_REPORT_TRUNCATED);
        assert_memory_equal(some, all, capacity * sizeof all[0]);
        assert_int_equal(((unsigned char *)&some[capacity])[0], 0x12);
        assert_memory_equal(&a, &b, sizeof a);
    }
}

static void absent_arrays_lose_nothing_and_change_nothing(void **unused)
{
    tahr_event all[32];
    tahr_report full, none;
    tahr_state a, b;
    (void)unused;
    jump(32, 0, &full, &a, all);
    assert_int_equal(jump(32, 0, &none, &b, NULL), TAHR_OK);
    assert_int_equal(none.event_count + none.events_lost, 0);
    assert_memory_equal(&a, &b, sizeof a);
}

static void decisions_that_do_not_fit_are_counted(void **unused)
{
    tahr_event all[32];
    tahr_report full, r;
    tahr_state a, b;
    (void)unused;
    assert_int_equal(jump(32, 64, &full, &a, all), TAHR_OK);
    assert_true(full.decision_count >= 3 && full.decisions_lost == 0);
    assert_int_equal(jump(32, 2, &r, &b, all), TAHR_TRUNCATED);
    assert_int_equal(r.decision_count, 2);
    assert_int_equal(r.decisions_lost, full.decision_count - 2);
    assert_memory_equal(&a, &b, sizeof a);
}

static void unused_report_words_are_written_not_added_to(void **unused)
{
    tahr_report report;
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 50));
    memset(&report, 0x7F, sizeof report);
    report.struct_size = sizeof report;
    report.events = NULL;
    report.decisions = NULL;
    report.queries = NULL;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report), TAHR_OK);
    assert_true(report.sweeps == 1 && report.slices == 1 && report.flags == 0 && report.arcs == 0 &&
                report.step_offset == 0);
    rig_close(&r);
}

static void mode_none_rests_and_takes_its_time(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 5));
    r.state.mode = TAHR_MODE_NONE;
    r.input.move = fake_vec(1, 0, 0);
    r.input.jump = 1;
    rig_step(&r, 0.5);
    assert_true(r.state.position.z == 5 && r.state.position.x == 0 && r.state.mode == TAHR_MODE_NONE);
    assert_int_equal(w.sweeps + w.contact_queries, 0);
    assert_true(r.report.slices == 1 && r.report.event_count == 0 && r.report.time_lost == 0);
    rig_close(&r);
}

/* Only a world that contradicts itself can say so. */
static void events_never_run_backward(void **unused)
{
    const double times[] = {0.1, 0.0229, 0.05, 0.2, 0.15}, reported[] = {0.1, 0.1, 0.1, 0.2, 0.2};
    tahr_event events[5];
    tahr__step step;
    (void)unused;
    memset(&step, 0, sizeof step);
    step.report.events = events;
    step.report.event_capacity = 5;
    step.dt = 1;
    for (int i = 0; i < 5; i++) {
        step.time = 0.5 * times[i];
        step.ahead = 0.5 * times[i];
        tahr__event(&step, TAHR_EVENT_APEX, NULL, 0);
        assert_true(events[i].time == reported[i]);
    }
}

/* Slices are added up: their sum may be a rounding beyond the step. */
static void no_event_lies_after_the_end_of_its_step(void **unused)
{
    tahr_event events[2];
    tahr__step step;
    (void)unused;
    memset(&step, 0, sizeof step);
    step.report.events = events;
    step.report.event_capacity = 2;
    step.dt = 0.1;
    step.time = 0.10000000000000002;
    tahr__event(&step, TAHR_EVENT_APEX, NULL, 0);
    tahr__event_at(&step, &(tahr_event){.type = TAHR_EVENT_OVERLAP_END, .time = 0.10000000000000002});
    assert_true(0.10000000000000002 > 0.1 && events[0].time == 0.1 && events[1].time == 0.1);
}

/* Whatever comes in at its place, what is kept is the earliest part of all. */
static void an_event_that_is_told_late_goes_where_its_time_belongs(void **unused)
{
    const double times[] = {0.3, 0.1, 0.2, 0.1, 0.4, 0};
    const uint32_t sorted[] = {5, 1, 3, 2, 0, 4};
    (void)unused;
    for (uint32_t room = 0; room <= 6; room++) {
        tahr_event events[7];
        tahr__step step;
        memset(&step, 0, sizeof step);
        memset(events, 0x12, sizeof events);
        step.report.events = events;
        step.report.event_capacity = room;
        step.dt = 1;
        for (uint32_t i = 0; i < 6; i++) {
            tahr_event e = {.type = TAHR_EVENT_OVERLAP_BEGIN, .body = i, .time = times[i]};
            tahr__event_at(&step, &e);
        }
        assert_true(step.report.event_count == room && step.report.events_lost == 6 - room);
        assert_int_equal((step.report.flags & TAHR_REPORT_TRUNCATED) != 0, room < 6);
        for (uint32_t i = 0; i < room; i++) {
            assert_int_equal(events[i].body, sorted[i]);
        }
        assert_int_equal(((unsigned char *)&events[room])[0], 0x12);
        step.report.events = NULL;
        tahr_event e = {.type = TAHR_EVENT_OVERLAP_END};
        tahr__event_at(&step, &e);
        assert_int_equal(step.report.events_lost, 6 - room); /* nobody asked */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(events_that_do_not_fit_are_counted_and_flagged),
                                       cmocka_unit_test(absent_arrays_lose_nothing_and_change_nothing),
                                       cmocka_unit_test(decisions_that_do_not_fit_are_counted),
                                       cmocka_unit_test(unused_report_words_are_written_not_added_to),
                                       cmocka_unit_test(events_never_run_backward),
                                       cmocka_unit_test(no_event_lies_after_the_end_of_its_step),
                                       cmocka_unit_test(an_event_that_is_told_late_goes_where_its_time_belongs),
                                       cmocka_unit_test(mode_none_rests_and_takes_its_time)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_overlap.c: what a state remembers of the sensors that it is inside of, and what its events tell, on every
 * backend. When they are entered and left: test_overlap_times.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sensor_rig.h"

static void standing_inside_changes_nothing_and_sleeps(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        uint32_t body = sensor_gate(&s, -2, 2);
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_step(&s.r, 1.0 / 60);
        const tahr_event *begin = sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, body);
        assert_true(begin && begin->time == 0); /* it was put there */
        rig_settle(&s.r);
        assert_true(s.r.state.touched_count == 1 && s.r.state.touched[0] == body);
        tahr_state before = s.r.state;
        for (int i = 0; i < 5; i++) {
            rig_step(&s.r, 1.0 / 60); /* with a trace, so it is computed */
            assert_int_equal(s.r.report.event_count, 0);
            assert_int_equal(s.r.report.sweeps, 1);
            assert_memory_equal(&before, &s.r.state, sizeof before);
        }
        tahr_report report = {.struct_size = sizeof report};
        for (int i = 0; i < 2; i++) {
            assert_int_equal(tahr_mover_step(s.r.mover, &s.r.input, 1.0 / 60, &s.r.state, &report), TAHR_OK);
        }
        assert_true(report.flags & TAHR_REPORT_ASLEEP);
        assert_int_equal(report.sweeps, 0);
        sensor_close(&s);
    }
}

/* None where none is near; one inside; two where it is entered; one where it is left. */
static void sensors_cost_sweeps_only_where_they_are(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig with, without;
        sensor_begin(&with, backend);
        sensor_begin(&without, backend);
        sensor_gate(&with, 4.53, 8.53);
        sensor_open(&with, NULL, fake_vec(0, 0, 1));
        sensor_open(&without, NULL, fake_vec(0, 0, 1));
        rig_settle(&with.r);
        rig_settle(&without.r);
        with.r.state.velocity = without.r.state.velocity = fake_vec(6, 0, 0);
        with.r.input.move = without.r.input.move = fake_vec(1, 0, 0);
        uint32_t seen[4] = {0, 0, 0, 0};
        for (int i = 0; i < 120; i++) {
            uint32_t was = with.r.state.touched_count;
            rig_step(&with.r, 1.0 / 60);
            rig_step(&without.r, 1.0 / 60);
            uint32_t is = with.r.state.touched_count, expected = was ? 1 : 2 * is;
            uint32_t legs = with.r.report.sweeps - without.r.report.sweeps;
            assert_int_equal(legs, expected);
            seen[2 * was + is]++;
        }
        assert_true(seen[0] > 40 && seen[1] == 1 && seen[2] == 1 && seen[3] > 40);
        sensor_close(&with);
        sensor_close(&without);
    }
}

static void a_sensor_that_is_put_elsewhere_is_left_at_once(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        for (int moving = 0; moving < 2; moving++) {
            sensor_rig s;
            sensor_begin(&s, backend);
            uint32_t body = sensor_gate(&s, -4, 4);
            sensor_open(&s, NULL, fake_vec(0, 0, 1));
            rig_settle(&s.r);
            s.r.input.move = fake_vec(0, moving, 0);
            for (int i = 0; i < 4; i++) {
                int there = i % 2;
                sensor_put(&s, body, fake_vec(there ? 0 : 30, 0, 3));
                rig_step(&s.r, 1.0 / 60);
                const tahr_event *e =
                    sensor_event(&s.r, there ? TAHR_EVENT_OVERLAP_BEGIN : TAHR_EVENT_OVERLAP_END, body);
                assert_true(e && e->time == 0);
                assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), there);
                assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_END), !there);
                assert_int_equal(s.r.state.touched_count, there);
                rig_step(&s.r, 1.0 / 60);
                assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 0);
                assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_END), 0);
            }
            sensor_close(&s);
        }
    }
}

/* Put in front of a walker that it was around: left, and entered again where it is now. */
static void a_sensor_put_ahead_is_left_and_entered_again(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        uint32_t body = sensor_gate(&s, -1, 1);
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_settle(&s.r);
        s.r.state.velocity = fake_vec(6, 0, 0);
        s.r.input.move = fake_vec(1, 0, 0);
        sensor_put(&s, body, fake_vec(1.5, 0, 3)); /* from 0.5 on: 0.15 m away */
        rig_step(&s.r, 0.1);
        rig_assert_in_order(&s.r, 0.1);
        const tahr_event *end = sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, body);
        const tahr_event *begin = sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, body);
        assert_true(end && begin && end < begin && end->time == 0);
        assert_near(begin->time, 0.15 / 6, 1e-9);
        assert_int_equal(s.r.state.touched_count, 1);
        sensor_close(&s);
    }
}

/* A beam that turns about its middle, 3 m off: over the character at 0 degrees, beside it at 45. */
static void a_sensor_that_turns_away_is_left(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        if (backend == ON_CALLBACKS) {
            continue; /* its boxes do not turn */
        }
        sensor_begin(&s, backend);
        uint32_t body = sensor_box(&s, fake_vec(-4, 2.75, 0.5), fake_vec(4, 3.25, 1.5));
        sensor_open(&s, NULL, fake_vec(3, 3, 1));
        rig_settle(&s.r);
        assert_int_equal(s.r.state.touched_count, 1);
        const double half = 0.39269908169872414; /* 22.5 degrees */
        tahr_body_pose pose = {body, 0, {{0, 3, 1}, {0, 0, sin(half), cos(half)}}};
        assert_int_equal(tahr_world_set(s.r.world, &pose, 1), TAHR_OK);
        rig_step(&s.r, 1.0 / 60);
        assert_non_null(sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, body));
        assert_int_equal(s.r.state.touched_count, 0);
        sensor_close(&s);
    }
}

/* The lowest eight are remembered; when one of them goes the next takes its place. */
static void more_than_eight_sensors_are_said_to_be_too_many(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        for (int i = 0; i < 10; i++) {
            sensor_gate(&s, -2 - i, 2 + i);
        }
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_step(&s.r, 1.0 / 60);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 8);
        rig_settle(&s.r);
        rig_step(&s.r, 1.0 / 60);
        assert_true(s.r.report.flags & TAHR_REPORT_TOUCHED_LOST);
        assert_int_equal(s.r.report.event_count, 0);
        assert_int_equal(s.r.state.touched_count, 8);
        for (uint32_t i = 0; i < 8; i++) {
            assert_int_equal(s.r.state.touched[i], i + 1);
        }
        sensor_put(&s, 3, fake_vec(60, 0, 3));
        sensor_put(&s, 4, fake_vec(60, 0, 3));
        rig_step(&s.r, 1.0 / 60);
        assert_true(sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, 3) && sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, 4));
        assert_true(sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, 9) &&
                    sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, 10));
        assert_int_equal(s.r.report.flags & TAHR_REPORT_TOUCHED_LOST, 0);
        const uint32_t left[8] = {1, 2, 5, 6, 7, 8, 9, 10};
        assert_memory_equal(s.r.state.touched, left, sizeof left);
        sensor_close(&s);
    }
}

/* The capsule's side lies exactly in the sensor's face: not inside. A tenth of a millimetre more is. */
static void touching_is_not_inside(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        tahr_config c = rig_config();
        c.shape.radius = 0.25;
        sensor_begin(&s, backend);
        uint32_t body = sensor_gate(&s, 0.25, 2.25);
        sensor_open(&s, &c, fake_vec(0, 0, 1));
        rig_settle(&s.r);
        for (int i = 0; i < 30; i++) { /* along the face, and back */
            s.r.input.move = fake_vec(0, i < 15 ? 1 : -1, 0);
            rig_step(&s.r, 1.0 / 60);
            assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 0);
            assert_true(s.r.state.touched_count == 0 && s.r.state.position.x == 0);
        }
        rig_settle(&s.r);
        sensor_put(&s, body, fake_vec(1.25 - 1e-4, 0, 3));
        rig_step(&s.r, 1.0 / 60);
        assert_true(s.r.state.touched_count == 1 && sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, body));
        sensor_close(&s);
    }
}

static void another_mask_ends_what_it_does_not_meet(void **unused)
{
    sensor_rig s;
    (void)unused;
    sensor_begin(&s, ON_NATIVE);
    uint32_t body = sensor_gate(&s, -2, 2);
    s.bodies[body].mask = 4;
    sensor_open(&s, NULL, fake_vec(0, 0, 1));
    rig_settle(&s.r);
    assert_int_equal(s.r.state.touched_count, 1);
    tahr_mover *own = s.r.mover;
    tahr_config other = s.r.config;
    other.mask = ~4u;
    assert_int_equal(tahr_mover_create(s.r.world, &other, &s.r.mover), TAHR_OK);
    rig_step(&s.r, 1.0 / 60);
    const tahr_event *e = sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, body);
    assert_true(e && e->time == 0);
    assert_int_equal(s.r.state.touched_count, 0);
    tahr_mover_destroy(own);
    sensor_close(&s);
}

/* A volume to swim in is entered like any other sensor. */
static void a_fluid_is_a_sensor_too(void **unused)
{
    sensor_rig s;
    (void)unused;
    sensor_begin(&s, ON_NATIVE);
    uint32_t body = sensor_gate(&s, 2, 4);
    s.bodies[body].flags = TAHR_BODY_FLUID;
    sensor_open(&s, NULL, fake_vec(3, 0, 12));
    int begins = 0;
    for (int i = 0; i < 60; i++) {
        rig_step(&s.r, 1.0 / 60);
        begins += sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN);
    }
    assert_int_equal(begins, 1);
    assert_true(s.r.state.touched_count == 1 && s.r.state.touched[0] == body);
    sensor_close(&s);
}

/* A jump among sensors in one step: with too little room the earliest events are kept. */
static void overlaps_that_do_not_fit_are_counted(void **unused)
{
    sensor_rig s;
    tahr_event all[RIG_EVENTS], some[RIG_EVENTS + 1];
    (void)unused;
    sensor_begin(&s, ON_NATIVE);
    sensor_gate(&s, -1, 1);
    sensor_gate(&s, 2, 2.5);
    sensor_box(&s, fake_vec(-16, -16, 2), fake_vec(16, 16, 3));
    sensor_open(&s, NULL, fake_vec(0, 0, 1));
    rig_settle(&s.r);
    s.r.input.move = fake_vec(1, 0, 0);
    s.r.input.jump = 1;
    const tahr_state start = s.r.state;
    rig_step(&s.r, 1);
    rig_assert_in_order(&s.r, 1);
    const tahr_state end = s.r.state;
    const uint32_t n = s.r.report.event_count;
    memcpy(all, s.r.events, sizeof all);
    assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 2); /* the second gate, the layer above */
    assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_END), 2);   /* the first gate, and that layer */
    for (uint32_t room = 0; room < n; room++) {
        tahr_report report = {.struct_size = sizeof report, .events = some, .event_capacity = room};
        s.r.state = start;
        memset(some, 0x12, sizeof some);
        assert_int_equal(tahr_mover_step(s.r.mover, &s.r.input, 1, &s.r.state, &report), TAHR_TRUNCATED);
        assert_true(report.event_count == room && report.events_lost == n - room);
        assert_memory_equal(some, all, room * sizeof all[0]);
        assert_int_equal(((unsigned char *)&some[room])[0], 0x12);
        assert_memory_equal(&s.r.state, &end, sizeof end);
    }
    sensor_close(&s);
}

/* Ten seconds of falling are hundreds of pieces; after 64 sweeps for sensors only the end is looked at. */
static void sweeps_for_sensors_are_capped(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig with, without;
        tahr_config c = rig_config();
        c.max_dt = 10;
        sensor_begin(&with, backend);
        sensor_begin(&without, backend);
        uint32_t inside = sensor_box(&with, fake_vec(-16, -16, -900), fake_vec(16, 16, 900));
        uint32_t last = sensor_box(&with, fake_vec(-16, -16, 430), fake_vec(16, 16, 450));
        sensor_open(&with, &c, fake_vec(0, 0, 600));
        sensor_open(&without, &c, fake_vec(0, 0, 600));
        rig_step(&with.r, 6);
        rig_step(&without.r, 6);
        rig_assert_in_order(&with.r, 6);
        assert_true(with.r.report.sweeps > without.r.report.sweeps + TAHR_MAX_SENSOR_QUERIES_PER_STEP / 2);
        assert_true(with.r.report.sweeps <= without.r.report.sweeps + TAHR_MAX_SENSOR_QUERIES_PER_STEP);
        assert_memory_equal(&with.r.state.position, &without.r.state.position, sizeof(tahr_vec3));
        assert_near(with.r.state.position.z, 600 - 40 * 40 / (2 * 9.81) - 40 * (6 - 40 / 9.81), 1e-6); /* terminal */
        assert_true(with.r.state.touched_count == 2 && with.r.state.touched[1] == last);
        assert_non_null(sensor_event(&with.r, TAHR_EVENT_OVERLAP_BEGIN, inside));
        assert_non_null(sensor_event(&with.r, TAHR_EVENT_OVERLAP_BEGIN, last));
        sensor_close(&with);
        sensor_close(&without);
    }
}

static void a_sleeper_wakes_when_its_sensor_goes(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        tahr_event events[8];
        tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 8};
        sensor_begin(&s, backend);
        uint32_t body = sensor_gate(&s, -2, 2);
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_settle(&s.r);
        for (int i = 0; i < 3; i++) {
            assert_int_equal(tahr_mover_step(s.r.mover, &s.r.input, 0.1, &s.r.state, &report), TAHR_OK);
        }
        assert_true(report.flags & TAHR_REPORT_ASLEEP && report.event_count == 0);
        sensor_put(&s, body, fake_vec(40, 0, 3));
        assert_int_equal(tahr_mover_step(s.r.mover, &s.r.input, 0.1, &s.r.state, &report), TAHR_OK);
        assert_true(!(report.flags & TAHR_REPORT_ASLEEP) && report.event_count == 1);
        assert_true(events[0].type == TAHR_EVENT_OVERLAP_END && events[0].body == body && events[0].time == 0);
        sensor_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(standing_inside_changes_nothing_and_sleeps),
                                       cmocka_unit_test(sensors_cost_sweeps_only_where_they_are),
                                       cmocka_unit_test(a_sensor_that_is_put_elsewhere_is_left_at_once),
                                       cmocka_unit_test(a_sensor_put_ahead_is_left_and_entered_again),
                                       cmocka_unit_test(a_sensor_that_turns_away_is_left),
                                       cmocka_unit_test(more_than_eight_sensors_are_said_to_be_too_many),
                                       cmocka_unit_test(touching_is_not_inside),
                                       cmocka_unit_test(another_mask_ends_what_it_does_not_meet),
                                       cmocka_unit_test(a_fluid_is_a_sensor_too),
                                       cmocka_unit_test(overlaps_that_do_not_fit_are_counted),
                                       cmocka_unit_test(sweeps_for_sensors_are_capped),
                                       cmocka_unit_test(a_sleeper_wakes_when_its_sensor_goes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

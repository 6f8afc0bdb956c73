/* SPDX-License-Identifier: MIT
 * test_overlap_times.c: sensors are entered and left at the times of closed forms, at every frame rate, on every
 * backend. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "sensor_rig.h"
#include "stage.h"

/* When a sensor was entered and left, in the rig's time; < 0: it was not. Every step's events are in order. */
typedef struct visit {
    double begin, end;
    int begins, ends;
} visit;

static void watch(sensor_rig *s, double dt, uint32_t body, visit *v)
{
    double start = s->r.time;
    rig_step(&s->r, dt);
    rig_assert_in_order(&s->r, dt);
    for (uint32_t i = 0; i < s->r.report.event_count; i++) {
        const tahr_event *e = &s->r.events[i];
        if (e->body != body) {
            continue;
        }
        if (e->type == TAHR_EVENT_OVERLAP_BEGIN) {
            v->begin = start + e->time;
            v->begins++;
            assert_int_equal(e->surface, s->bodies[body].surface);
        } else if (e->type == TAHR_EVENT_OVERLAP_END) {
            v->end = start + e->time;
            v->ends++;
        }
    }
}

static void a_walk_at_constant_speed_enters_and_leaves_on_time(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        for (int rate = 0; rate < RIG_RATES; rate++) {
            sensor_rig s;
            visit v = {-1, -1, 0, 0};
            sensor_begin(&s, backend);
            uint32_t body = sensor_gate(&s, 4.5, 5.5);
            sensor_open(&s, NULL, fake_vec(0, 0, 1));
            rig_settle(&s.r);
            s.r.time = 0;
            s.r.state.velocity = fake_vec(6, 0, 0);
            s.r.input.move = fake_vec(1, 0, 0);
            while (s.r.time < 1.5) {
                watch(&s, 1 / rig_rates[rate], body, &v);
            }
            assert_true(v.begins == 1 && v.ends == 1);
            assert_near(v.begin, (4.5 - 0.35) / 6, 1e-9);
            assert_near(v.end, (5.5 + 0.35) / 6, 1e-9);
            assert_int_equal(s.r.state.touched_count, 0);
            sensor_close(&s);
        }
    }
}

/* From rest x = A t^2 / 2 until 6 m/s, then evenly on. */
static void a_walk_that_speeds_up_enters_and_leaves_on_time(void **unused)
{
    const double A = 20.48, reached = 6 / A, there = 0.5 * A * reached * reached;
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        for (int rate = 0; rate < RIG_RATES; rate++) {
            sensor_rig s;
            visit v = {-1, -1, 0, 0};
            sensor_begin(&s, backend);
            uint32_t body = sensor_gate(&s, 0.75, 1);
            sensor_open(&s, NULL, fake_vec(0, 0, 1));
            rig_settle(&s.r);
            s.r.time = 0;
            s.r.input.move = fake_vec(1, 0, 0);
            while (s.r.time < 0.6) {
                watch(&s, 1 / rig_rates[rate], body, &v);
            }
            assert_true(v.begins == 1 && v.ends == 1);
            assert_near(v.begin, sqrt(2 * (0.75 - 0.35) / A), 1e-9);
            assert_near(v.end, reached + (1 + 0.35 - there) / 6, 1e-9);
            sensor_close(&s);
        }
    }
}

/* A fall from rest: z = -g t^2 / 2, though it is swept in chords. */
static void a_fall_enters_and_leaves_on_time(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        for (int rate = 0; rate < RIG_RATES; rate++) {
            sensor_rig s;
            visit v = {-1, -1, 0, 0};
            sensor_begin(&s, backend);
            uint32_t body = sensor_box(&s, fake_vec(-16, -16, 15), fake_vec(16, 16, 16));
            sensor_open(&s, NULL, fake_vec(0, 0, 20));
            while (s.r.time < 1.2) {
                watch(&s, 1 / rig_rates[rate], body, &v);
            }
            assert_true(v.begins == 1 && v.ends == 1);
            assert_near(v.begin, sqrt(2 * (20 - 0.9 - 16) / 9.81), 1e-9);
            assert_near(v.end, sqrt(2 * (20 + 0.9 - 15) / 9.81), 1e-9);
            sensor_close(&s);
        }
    }
}

/* Row X3: 1 cm thick, 40 m/s, one step. */
static void row_X3_a_thin_sensor_is_begun_then_ended_in_the_step_that_passes_it(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        tahr_config c = rig_config();
        c.gravity = fake_vec(0, 0, 0);
        sensor_begin(&s, backend);
        uint32_t body = sensor_gate(&s, 1.5, 1.51);
        sensor_open(&s, &c, fake_vec(0, 0, 3));
        s.r.state.velocity = fake_vec(40, 0, 0);
        s.r.input.move = fake_vec(1, 0, 0);
        rig_step(&s.r, 0.1);
        rig_assert_in_order(&s.r, 0.1);
        const tahr_event *begin = sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, body);
        const tahr_event *end = sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, body);
        assert_true(begin && end && begin < end);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 1);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_END), 1);
        assert_near(begin->time, (1.5 - 0.35) / 40, 2e-8); /* the box is rounded by up to 2e-7 m on native */
        assert_near(end->time, (1.51 + 0.35) / 40, 2e-8);
        assert_near(begin->position.x, 1.5 - 0.35, 1e-6);
        assert_near(begin->normal.x, -1, 1e-6);
        assert_int_equal(s.r.state.touched_count, 0);
        sensor_close(&s);
    }
}

/* Down a slope of 30 degrees into the water, which is a sensor too, in one long step: the walk that leads too deep is
 * taken back, and begins the sensor once, when a walk without water does. */
static tahr_event wade_in(uint32_t kind, uint32_t *mode)
{
    const double half = 15 * 3.14159265358979323846 / 180;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, -10), fake_vec(50, 50, 10))};
    tahr_config c;
    rig r;
    bodies[0].pose.orientation = (tahr_quat){0, sin(half), 0, cos(half)}; /* its top would be lower by 1 / cos - 1 */
    bodies[0].pose.position = fake_vec(-sin(2 * half), 0, -cos(2 * half));
    bodies[1].flags = kind;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    c.max_substep = 0.02;
    c.max_substeps = 32;
    rig_open_bodies(&r, bodies, 2, &c, fake_vec(-0.8, 0, 1.6));
    rig_settle(&r);
    r.input.move = fake_vec(1, 0, 0);
    r.state.velocity = fake_vec(6, 0, 0);
    rig_step(&r, 0.6);
    rig_assert_in_order(&r, 0.6);
    assert_int_equal(sensor_events(&r, TAHR_EVENT_OVERLAP_BEGIN), 1);
    assert_int_equal(sensor_events(&r, TAHR_EVENT_OVERLAP_END), 0);
    assert_true(r.state.touched_count == 1 && r.state.touched[0] == 1);
    tahr_event e = *rig_event(&r, TAHR_EVENT_OVERLAP_BEGIN);
    *mode = r.state.mode;
    rig_close(&r);
    return e;
}

static void a_walk_that_is_taken_back_at_the_water_line_begins_its_sensor_once(void **unused)
{
    uint32_t mode;
    (void)unused;
    tahr_event dry = wade_in(TAHR_BODY_SENSOR, &mode);
    assert_int_equal(mode, TAHR_MODE_WALKING);
    tahr_event wet = wade_in(TAHR_BODY_FLUID, &mode);
    assert_int_equal(mode, TAHR_MODE_SWIMMING);
    assert_true(dry.time > 0.02 && dry.time < 0.3);
    assert_near(wet.time, dry.time, 1e-9);
    assert_near(wet.position.x, dry.position.x, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walk_at_constant_speed_enters_and_leaves_on_time),
        cmocka_unit_test(a_walk_that_speeds_up_enters_and_leaves_on_time),
        cmocka_unit_test(a_fall_enters_and_leaves_on_time),
        cmocka_unit_test(row_X3_a_thin_sensor_is_begun_then_ended_in_the_step_that_passes_it),
        cmocka_unit_test(a_walk_that_is_taken_back_at_the_water_line_begins_its_sensor_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_scope.c: motions that are taken back leave nothing: rows X1 and X2, and whole steps that walk a slice again. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "move.h"
#include "report.h"
#include "scope.h"
#include "sensor_rig.h"

/* Row X1: three motions, two of them blocked, and a sensor on the way: one begin, then both hits, in order of time. */
static void row_X1_a_step_tells_sensors_once_and_hits_in_order(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        const tahr_vec3 walls[2][2] = {{{2, -8, -1}, {3, 8, 4}}, {{-8, 2.5, -1}, {8, 3.5, 4}}};
        for (int i = 0; i < 2; i++) {
            uint32_t body = sensor_box(&s, walls[i][0], walls[i][1]);
            s.bodies[body].flags = 0;
            s.sensors.count--;
            fake_add_box(&s.solid, walls[i][0], walls[i][1]);
        }
        sensor_box(&s, fake_vec(0.75, -8, -1), fake_vec(1, 8, 4));
        uint32_t sensor = backend == ON_CALLBACKS ? 1 : 3;
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_settle(&s.r);
        s.r.state.velocity = fake_vec(4.8, 3.6, 0);
        s.r.input.move = fake_vec(0.8, 0.6, 0);
        rig_step(&s.r, 1);
        rig_assert_in_order(&s.r, 1);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 1);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_END), 1);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_HIT), 2);
        const tahr_event *begin = sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, sensor);
        const tahr_event *end = sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, sensor);
        const tahr_event *first = sensor_event(&s.r, TAHR_EVENT_HIT, 1),
                         *second = sensor_event(&s.r, TAHR_EVENT_HIT, 2);
        assert_true(begin && end && first && second && begin < end && end < first && first < second);
        assert_near(begin->time, (0.75 - 0.35) / 4.8, 1e-9);
        assert_near(end->time, (1 + 0.35) / 4.8, 1e-9);
        assert_near(first->time, (2 - 0.36) / 4.8, 1e-8);
        sensor_close(&s);
    }
}

/* A step in progress of the rig's mover, as mover.c would make it. */
static void begin(rig *r, tahr__step *step, tahr__trail *trail)
{
    memset(step, 0, sizeof *step);
    step->config = &r->mover->config;
    step->limits = &r->mover->limits;
    step->world = r->world;
    step->input = &r->input;
    step->pull = &r->mover->limits.pull;
    step->state = r->state;
    step->ignore_body = TAHR_NO_BODY;
    step->push_left = 1;
    step->report.events = r->events;
    step->report.event_capacity = 3;
    tahr__trail_begin(trail, step);
}

/* Everything that a blocked motion writes, and more. */
static void collide(tahr__step *step, tahr_vec3 motion)
{
    tahr_hit hit;
    tahr__move(step, motion, &hit);
    tahr__trail_go(step);
    assert_true(hit.blocking);
    tahr__event(step, TAHR_EVENT_HIT, &hit, 1);
    step->state.velocity = fake_vec(0, 1, 2);
    step->state.flags ^= TAHR_STATE_JUMPING | TAHR_STATE_FLOOR_MOVED;
    step->state.floor.distance += 1;
    step->state.floor_revision++;
    step->state.floor_position.x += 1;
    step->report.step_offset += 0.3;
    step->report.slides++;
    step->report.residual = 0.1;
    step->report.flags |= TAHR_REPORT_CRUSHED;
    step->ahead += 0.01;
}

/* Row X2: the inner one of two scopes is reverted, then the outer one. */
static void row_X2_a_reverted_scope_leaves_every_bit_as_it_was(void **unused)
{
    sensor_rig s;
    tahr__step step;
    static tahr__trail trail;
    tahr__scope outer, inner;
    (void)unused;
    sensor_begin(&s, ON_CALLBACKS);
    sensor_box(&s, fake_vec(0.5, -8, -1), fake_vec(1, 8, 4));
    fake_add_box(&s.solid, fake_vec(2, -8, -1), fake_vec(3, 8, 4));
    sensor_open(&s, NULL, fake_vec(0, 0, 1));
    rig_settle(&s.r);
    begin(&s.r, &step, &trail);
    const tahr_state at_start = step.state;
    const tahr_report report = step.report;
    tahr__scope_open(&step, &outer);
    collide(&step, fake_vec(3, 0, 0));
    const tahr_state between = step.state;
    const tahr_report told = step.report;
    assert_int_equal(trail.count, 1);
    tahr__scope_open(&step, &inner);
    collide(&step, fake_vec(0.1, 0, 0)); /* touches already */
    step.state.position.y += 1;
    tahr__trail_go(&step);
    collide(&step, fake_vec(1, 0, 0));
    tahr__event(&step, TAHR_EVENT_HIT, NULL, 2); /* does not fit */
    assert_true(step.report.events_lost == 1 && step.report.flags & TAHR_REPORT_TRUNCATED);
    assert_int_equal(trail.count, 2);
    uint32_t sweeps = step.report.sweeps;
    tahr__scope_revert(&step, &inner);
    assert_memory_equal(&step.state, &between, sizeof between);
    assert_int_equal(step.report.sweeps, sweeps); /* asked is asked */
    tahr_report now = step.report;
    now.sweeps = told.sweeps;
    assert_memory_equal(&now, &told, sizeof now);
    assert_true(step.ahead == 0.01);
    assert_int_equal(trail.count, 1);
    tahr__scope_revert(&step, &outer);
    assert_memory_equal(&step.state, &at_start, sizeof at_start);
    now = step.report;
    now.sweeps = report.sweeps;
    assert_memory_equal(&now, &report, sizeof now);
    assert_int_equal(trail.count, 0);
    assert_true(step.ahead == 0);
    sensor_close(&s);
}

static void lost_decisions_stay_lost(void **unused)
{
    sensor_rig s;
    tahr__step step;
    static tahr__trail trail;
    tahr__scope scope;
    tahr_decision none;
    tahr_query_record one;
    (void)unused;
    sensor_begin(&s, ON_CALLBACKS);
    fake_add_box(&s.solid, fake_vec(2, -8, -1), fake_vec(3, 8, 4));
    sensor_open(&s, NULL, fake_vec(0, 0, 1));
    for (int lost = 0; lost < 3; lost++) { /* nothing, decisions, queries */
        begin(&s.r, &step, &trail);
        step.report.decisions = lost == 1 ? &none : NULL;
        step.report.queries = lost == 2 ? &one : NULL;
        tahr__scope_open(&step, &scope);
        collide(&step, fake_vec(3, 0, 0));
        tahr__scope_revert(&step, &scope);
        assert_int_equal((step.report.flags & TAHR_REPORT_TRUNCATED) != 0, lost > 0);
    }
    sensor_close(&s);
}

/* The floor ends at x = 64. A look ahead at walking height goes through a sensor that the fall passes below; where the
 * path is bent by a wall first, the slice is walked twice. Neither may tell of what did not happen. */
static void what_is_walked_again_is_told_once(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        for (int bent = 0; bent < 2; bent++) {
            sensor_rig s;
            sensor_begin(&s, backend);
            uint32_t wall = sensor_box(&s, fake_vec(50, 0.625, -9), fake_vec(80, 1.625, 9));
            s.bodies[wall].flags = 0;
            s.sensors.count--;
            fake_add_box(&s.solid, fake_vec(50, 0.625, -9), fake_vec(80, 1.625, 9));
            sensor_box(&s, fake_vec(65.25, -3, 1.75), fake_vec(65.5, 3, 1.875));
            sensor_open(&s, NULL, fake_vec(62, 0, 1));
            rig_settle(&s.r);
            s.r.input.move = bent ? fake_vec(0.96, 0.28, 0) : fake_vec(1, 0, 0);
            s.r.state.velocity = fake_vec(6 * s.r.input.move.x, 6 * s.r.input.move.y, 0);
            rig_step(&s.r, 0.75);
            rig_assert_in_order(&s.r, 0.75);
            assert_int_equal(sensor_events(&s.r, TAHR_EVENT_LEFT_GROUND), 1);
            const tahr_event *hit = rig_event(&s.r, TAHR_EVENT_HIT), *left = rig_event(&s.r, TAHR_EVENT_LEFT_GROUND);
            int on_floor = 0; /* in the air it may run into the wall again */
            for (; hit && hit < left; hit++) {
                on_floor += hit->type == TAHR_EVENT_HIT;
            }
            assert_int_equal(on_floor, bent);
            assert_true(s.r.state.position.x > 65.5 && s.r.state.mode == TAHR_MODE_FALLING);
            assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 0);
            assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_END), 0);
            sensor_close(&s);
        }
    }
}

/* The same sensor where the fall does pass, and one over the floor before: each once, at the times of the law of
 * walking and of the arc. The floor carries a foot up to radius + skin - perch_threshold beyond its end. */
static void a_ledge_in_the_middle_of_a_step_keeps_the_times(void **unused)
{
    const double edge = 64 + 0.35 + 0.01 - 0.15;
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        uint32_t near = sensor_box(&s, fake_vec(62.5, -8, 0), fake_vec(63, 8, 3));
        uint32_t far = sensor_box(&s, fake_vec(66, -8, -8), fake_vec(66.5, 8, 8));
        sensor_open(&s, NULL, fake_vec(61, 0, 1));
        rig_settle(&s.r);
        s.r.input.move = fake_vec(1, 0, 0);
        s.r.state.velocity = fake_vec(6, 0, 0);
        rig_step(&s.r, 1);
        rig_assert_in_order(&s.r, 1);
        assert_near(rig_event(&s.r, TAHR_EVENT_LEFT_GROUND)->time, (edge - 61) / 6, 2e-5);
        assert_near(sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, near)->time, (62.5 - 0.35 - 61) / 6, 1e-9);
        assert_near(sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, near)->time, (63 + 0.35 - 61) / 6, 1e-9);
        assert_near(sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, far)->time, (66 - 0.35 - 61) / 6, 1e-9);
        assert_near(sensor_event(&s.r, TAHR_EVENT_OVERLAP_END, far)->time, (66.5 + 0.35 - 61) / 6, 1e-9);
        assert_int_equal(sensor_events(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 2);
        sensor_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(row_X1_a_step_tells_sensors_once_and_hits_in_order),
        cmocka_unit_test(row_X2_a_reverted_scope_leaves_every_bit_as_it_was),
        cmocka_unit_test(lost_decisions_stay_lost),
        cmocka_unit_test(what_is_walked_again_is_told_once),
        cmocka_unit_test(a_ledge_in_the_middle_of_a_step_keeps_the_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

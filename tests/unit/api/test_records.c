/* SPDX-License-Identifier: MIT
 * test_records.c: recorded queries are those that the report counts, in order, as asked and answered (row X4). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "move.h"
#include "sensor_rig.h"

enum { ROOM = 300 };
static tahr_query_record records[ROOM];

static tahr_status step_recorded(rig *r, double dt, uint32_t room)
{
    memset(&r->report, 0, sizeof r->report);
    r->report.struct_size = sizeof r->report;
    r->report.queries = records;
    r->report.query_capacity = room;
    tahr_status status = tahr_mover_step(r->mover, &r->input, dt, &r->state, &r->report);
    assert_true(status >= 0);
    return status;
}

static uint32_t of_type(uint32_t count, uint32_t type)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        n += records[i].type == type;
    }
    return n;
}

static void flat_walking_records_the_move_and_the_floor(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_settle(&s.r);
        s.r.state.velocity = fake_vec(6, 0, 0);
        s.r.input.move = fake_vec(1, 0, 0);
        double z = s.r.state.position.z;
        assert_int_equal(step_recorded(&s.r, 1.0 / 64, ROOM), TAHR_OK);
        assert_true(s.r.report.query_count == 2 && s.r.report.queries_lost == 0);
        const tahr_query_record *move = &records[0], *floor = &records[1];
        assert_true(move->type == TAHR_QUERY_SWEEP && move->count == 0 && move->fraction == 1);
        assert_true(move->shape.type == TAHR_SHAPE_CAPSULE && move->shape.half_height == 0.9);
        assert_true(move->position.x == 0 && move->position.z == z && move->margin == 0.01);
        assert_near(move->motion.x, 6.0 / 64, 1e-12);
        assert_int_equal(move->body, TAHR_NO_BODY);
        assert_true(floor->type == TAHR_QUERY_SWEEP && floor->count == 1 && floor->body == 0);
        assert_near(floor->position.x, 6.0 / 64, 1e-12);
        assert_true(floor->motion.z < 0 && floor->normal.z == 1);
        assert_near(floor->point.z, 0, 1e-9);
        sensor_close(&s);
    }
}

/* A steep slope asks a ray too; being put into the floor asks for contacts. */
static void every_kind_of_query_is_recorded_as_it_is_counted(void **unused)
{
    fake_world w;
    rig r, off;
    uint32_t rays = 0, contacts = 0;
    (void)unused;
    fake_world_init(&w);
    fake_add_slope(&w, 30);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 2));
    rig_open(&off, &w, NULL, fake_vec(0, 0, 2));
    off.state = r.state;
    r.input.move = off.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 60; i++) {
        if (i % 10 == 9) {
            r.state.position.z -= 0.05;
            off.state = r.state;
        }
        step_recorded(&r, 1.0 / 60, ROOM);
        rig_step(&off, 1.0 / 60);
        const tahr_report *report = &r.report;
        uint32_t n = report->query_count;
        assert_int_equal(report->queries_lost, 0);
        assert_int_equal(of_type(n, TAHR_QUERY_SWEEP), report->sweeps);
        assert_int_equal(of_type(n, TAHR_QUERY_CONTACTS), report->contact_queries);
        assert_int_equal(of_type(n, TAHR_QUERY_RAY), report->rays);
        assert_int_equal(of_type(n, TAHR_QUERY_FLUID), report->fluid_queries);
        assert_int_equal(n, report->sweeps + report->contact_queries + report->rays + report->fluid_queries);
        assert_true(off.report.query_count == 0 && off.report.sweeps == report->sweeps);
        assert_memory_equal(&r.state, &off.state, sizeof r.state);
        rays += report->rays;
        contacts += report->contact_queries;
    }
    assert_true(rays > 0 && contacts > 0);
    rig_close(&r);
    rig_close(&off);
}

static void records_that_do_not_fit_are_counted_and_flagged(void **unused)
{
    static tahr_query_record all[ROOM];
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -1);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.move = fake_vec(0.8, 0.6, 0);
    const tahr_state start = r.state;
    assert_int_equal(step_recorded(&r, 0.5, ROOM), TAHR_OK);
    const tahr_state end = r.state;
    uint32_t asked = r.report.query_count;
    memcpy(all, records, sizeof all);
    assert_true(asked > 2); /* the way, the way along the wall, the floor */
    for (uint32_t room = 0; room < asked; room++) {
        r.state = start;
        memset(records, 0x12, sizeof records);
        assert_int_equal(step_recorded(&r, 0.5, room), TAHR_TRUNCATED);
        assert_true(r.report.query_count == room && r.report.queries_lost == asked - room);
        assert_memory_equal(records, all, room * sizeof all[0]);
        assert_int_equal(((unsigned char *)&records[room])[0], 0x12);
        assert_memory_equal(&r.state, &end, sizeof end);
    }
    rig_close(&r);
}

/* Row X4 by the joint depenetration: 2 cm in the floor, asked to move on: the sweep that finds the overlap, the
 * contacts it is left by, the push, the look at what is left, and the motion again. Without the array nothing is
 * written. */
static void row_X4_a_move_out_of_the_floor_records_each_query_once(void **unused)
{
    const uint32_t expected[] = {TAHR_QUERY_SWEEP, TAHR_QUERY_CONTACTS, TAHR_QUERY_SWEEP, TAHR_QUERY_CONTACTS,
                                 TAHR_QUERY_SWEEP};
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0.88));
    for (int on = 1; on >= 0; on--) {
        tahr__step step;
        tahr_hit hit;
        memset(&step, 0, sizeof step);
        step.config = &r.mover->config;
        step.limits = &r.mover->limits;
        step.world = r.world;
        step.input = &r.input;
        step.state = r.state;
        step.push_left = 1;
        step.ignore_body = TAHR_NO_BODY;
        step.report.queries = on ? records : NULL;
        step.report.query_capacity = on ? ROOM : 0;
        memset(records, 0, sizeof records);
        tahr__move(&step, fake_vec(0.1, 0, 0), &hit);
        assert_near(step.state.position.x, 0.1, 1e-12);
        assert_near(step.state.position.z, 0.91, 1e-9);
        assert_int_equal(step.report.query_count, on ? 5 : 0);
        for (uint32_t i = 0; i < 5; i++) {
            assert_int_equal(records[i].type, on ? expected[i] : 0);
        }
        if (on) {
            assert_near(records[0].distance, -0.02, 1e-9);
            assert_near(records[1].distance, -0.02, 1e-9);
            assert_near(records[2].motion.z, 0.03, 1e-9);
            assert_true(records[3].count == 0 || fabs(records[3].distance - 0.01) < 1e-9); /* at the margin: rounding */
            assert_true(records[4].fraction == 1 && records[4].motion.x == 0.1);
        }
    }
    rig_close(&r);
}

static void sweeps_for_sensors_are_recorded_too(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        sensor_begin(&s, backend);
        uint32_t body = sensor_box(&s, fake_vec(0.5, -8, -1), fake_vec(1, 8, 4));
        sensor_open(&s, NULL, fake_vec(0, 0, 1));
        rig_settle(&s.r);
        s.r.state.velocity = fake_vec(6, 0, 0);
        s.r.input.move = fake_vec(1, 0, 0);
        step_recorded(&s.r, 1.0 / 16, ROOM);
        assert_true(s.r.report.query_count == 4 && s.r.report.sweeps == 4);
        assert_true(records[2].margin == 0 && records[2].motion.x < 0 && records[2].body == body);
        assert_true(records[3].margin == 0 && records[3].motion.x > 0 && records[3].body == body);
        assert_near(records[3].fraction, 0.15 / 0.375, 1e-9);
        sensor_close(&s);
    }
}

static void recording_wakes_a_sleeper(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.move = fake_vec(0, 0, 0);
    tahr_report plain = {.struct_size = sizeof plain};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, &plain), TAHR_OK);
    }
    assert_true(plain.flags & TAHR_REPORT_ASLEEP);
    assert_int_equal(step_recorded(&r, 0.1, 0), TAHR_OK); /* a cached floor: no query, none lost */
    assert_int_equal(r.report.flags & TAHR_REPORT_ASLEEP, 0);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_walking_records_the_move_and_the_floor),
        cmocka_unit_test(every_kind_of_query_is_recorded_as_it_is_counted),
        cmocka_unit_test(records_that_do_not_fit_are_counted_and_flagged),
        cmocka_unit_test(row_X4_a_move_out_of_the_floor_records_each_query_once),
        cmocka_unit_test(sweeps_for_sensors_are_recorded_too),
        cmocka_unit_test(recording_wakes_a_sleeper),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

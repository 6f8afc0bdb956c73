/* SPDX-License-Identifier: MIT
 * test_sensor_queries.c: sensors in direct queries on every backend, and what a user's sensor function may leave out or
 * get wrong. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sensor_rig.h"

static tahr_sweep sweep_x(const sensor_rig *s, double from, double by)
{
    tahr_sweep q = {.shape = s->r.config.shape,
                    .position = {from, 0, 1},
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = {by, 0, 0},
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    return q;
}

/* A sensor, a wall in a second sensor, a third behind. Bodies of sensors: 1, 2, 3; of the wall 4, or 1 of callbacks. */
static void open_gallery(sensor_rig *s, int backend)
{
    sensor_begin(s, backend);
    sensor_box(s, fake_vec(1, -8, -2), fake_vec(2, 8, 8));
    sensor_box(s, fake_vec(3, -8, -2), fake_vec(6, 8, 8));
    sensor_box(s, fake_vec(7, -8, -2), fake_vec(8, 8, 8));
    uint32_t wall = sensor_box(s, fake_vec(4, -8, -2), fake_vec(5, 8, 8));
    s->bodies[wall].flags = 0;
    s->sensors.count--;
    fake_add_box(&s->solid, fake_vec(4, -8, -2), fake_vec(5, 8, 8));
    sensor_open(s, NULL, fake_vec(0, 0, 1));
}

static void a_sweep_tells_sensors_before_the_wall_then_the_wall(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        tahr_hit hits[8], alone;
        uint32_t count = 0;
        open_gallery(&s, backend);
        tahr_sweep q = sweep_x(&s, 0, 8);
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 8, &count), TAHR_OK);
        assert_int_equal(count, 3);
        assert_true(hits[0].sensor && !hits[0].blocking && hits[0].body == 1 && hits[0].surface == 41);
        assert_true(hits[1].sensor && !hits[1].blocking && hits[1].body == 2);
        assert_true(hits[2].blocking && !hits[2].sensor);
        assert_near(hits[0].fraction, (1 - 0.35) / 8, 1e-9);
        assert_near(hits[1].fraction, (3 - 0.35) / 8, 1e-9);
        assert_near(hits[2].fraction, (4 - 0.35) / 8, 1e-9);
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 2, &count), TAHR_TRUNCATED);
        assert_true(count == 2 && hits[0].body == 1 && hits[1].blocking);
        assert_int_equal(tahr_world_sweep(s.r.world, &q, &alone, 1, &count), TAHR_OK);
        assert_true(count == 1 && alone.blocking && alone.fraction == hits[1].fraction);
        sensor_close(&s);
    }
}

static void a_sweep_for_sensors_goes_through_walls(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        tahr_hit hits[8];
        uint32_t count = 0;
        open_gallery(&s, backend);
        tahr_sweep q = sweep_x(&s, 4.5, 4); /* from inside of the wall */
        q.flags = TAHR_SWEEP_SENSORS;
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 8, &count), TAHR_OK);
        assert_int_equal(count, 2);
        assert_true(hits[0].sensor && hits[0].start_overlap && hits[0].fraction == 0 && hits[0].body == 2);
        assert_true(hits[1].sensor && !hits[1].start_overlap && hits[1].body == 3);
        assert_near(hits[1].fraction, (7 - 0.35 - 4.5) / 4, 1e-9);
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 1, &count), TAHR_TRUNCATED);
        assert_true(count == 1 && hits[0].body == 2);
        q.motion.x = 0;
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 8, &count), TAHR_OK);
        assert_true(count == 1 && hits[0].start_overlap && hits[0].body == 2);
        q.position.x = 2.5; /* 0.15 m from two of them */
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 8, &count), TAHR_OK);
        assert_int_equal(count, 0);
        q.flags = TAHR_SWEEP_PASS << 1;
        assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 8, &count), TAHR_E_ARGUMENT);
        sensor_close(&s);
    }
}

static void contacts_of_what_is_solid_leave_sensors_out(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        tahr_contact out[8];
        uint32_t count = 0;
        if (backend == ON_CALLBACKS) {
            continue; /* a user's contacts know no sensors */
        }
        open_gallery(&s, backend);
        tahr_contact_query q = {.shape = s.r.config.shape,
                                .position = {3.75, 0, 2},
                                .up = {0, 0, 1},
                                .orientation = {0, 0, 0, 1},
                                .mask = 0xFFFFFFFFu,
                                .ignore_body = TAHR_NO_BODY};
        assert_int_equal(tahr_world_contacts(s.r.world, &q, out, 8, &count), TAHR_OK);
        assert_true(count == 2 && out[0].sensor && !out[1].sensor); /* 1.1 m and 0.1 m deep */
        q.flags = TAHR_CONTACTS_SOLID;
        assert_int_equal(tahr_world_contacts(s.r.world, &q, out, 8, &count), TAHR_OK);
        assert_true(count == 1 && out[0].body == 4 && !out[0].sensor);
        assert_near(out[0].distance, -0.1, 1e-9);
        sensor_close(&s);
    }
}

/* A step nearer or farther by the last bit is inside by its radius; so is the plane of the face itself. */
static void an_axis_in_the_plane_of_a_face_is_inside_by_its_radius(void **unused)
{
    (void)unused;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        sensor_rig s;
        open_gallery(&s, backend);
        const double at[] = {nextafter(3, 0), 3, nextafter(3, 9)};
        for (int i = 0; i < 3; i++) {
            tahr_hit hits[8];
            uint32_t count = 0;
            tahr_sweep q = sweep_x(&s, at[i], -0.1);
            q.flags = TAHR_SWEEP_SENSORS;
            assert_int_equal(tahr_world_sweep(s.r.world, &q, hits, 8, &count), TAHR_OK);
            assert_true(count == 1 && hits[0].start_overlap && hits[0].body == 2);
            if (backend != ON_CALLBACKS) {
                assert_near(hits[0].depth, 0.35, 1e-9);
            }
        }
        sensor_close(&s);
    }
}

/* A user's sensors that say a body and a fraction, or something wrong. */
typedef struct user_sensors {
    fake_world world;
    int answer;
} user_sensors;

enum { PLAIN, NOT_A_NUMBER, BEYOND, TOO_MANY, FAILED, BAD_NORMAL, ANSWERS };

static tahr_status user_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    return fake_sweep(&((user_sensors *)user)->world, query, hit);
}

static tahr_status user_sense(void *user, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    const user_sensors *u = user;
    assert_true(hits[0].body == 0 && hits[0].fraction == 0 && *count == 0);
    double front = query->position.x + 0.35; /* all beyond x = 1 is the sensor */
    if (front <= 1 && front + query->motion.x <= 1) {
        return TAHR_OK;
    }
    hits[0].body = 7;
    hits[0].start_overlap = front > 1;
    hits[0].fraction = front > 1 ? 0 : (1 - front) / query->motion.x;
    hits[0].fraction = u->answer == NOT_A_NUMBER ? NAN : (u->answer == BEYOND ? 3 : hits[0].fraction);
    hits[0].normal.y = u->answer == BAD_NORMAL ? 0.2 : 0;
    *count = u->answer == TOO_MANY ? capacity + 1 : 1;
    return u->answer == FAILED ? TAHR_E_GEOMETRY : TAHR_OK;
}

static void a_users_sensors_may_be_terse_but_not_wrong(void **unused)
{
    static const char *const named[ANSWERS] = {"", "fraction", "fraction", "count", "status", "normal"};
    (void)unused;
    for (int answer = 0; answer < ANSWERS; answer++) {
        user_sensors u;
        rig r;
        tahr_report report = {.struct_size = sizeof report};
        tahr_event events[4];
        u.answer = answer;
        fake_world_flat(&u.world);
        tahr_callbacks c = {.struct_size = sizeof c, .user = &u, .sweep = user_sweep, .sensors = user_sense};
        rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 0.9125));
        rig_settle(&r);
        r.state.velocity = fake_vec(6, 0, 0);
        r.input.move = fake_vec(1, 0, 0);
        report.events = events;
        report.event_capacity = 4;
        const tahr_state before = r.state;
        tahr_status status = tahr_mover_step(r.mover, &r.input, 0.2, &r.state, &report);
        if (answer == PLAIN) {
            assert_int_equal(status, TAHR_OK);
            assert_true(report.event_count > 0 && events[0].type == TAHR_EVENT_OVERLAP_BEGIN && events[0].body == 7);
            assert_near(events[0].time, 0.65 / 6, 1e-12);
            assert_true(events[0].normal.x == -1);
        } else {
            assert_int_equal(status, TAHR_E_BACKEND);
            assert_non_null(strstr(r.log.text, named[answer]));
            assert_memory_equal(&before, &r.state, sizeof before);
        }
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sweep_tells_sensors_before_the_wall_then_the_wall),
        cmocka_unit_test(a_sweep_for_sensors_goes_through_walls),
        cmocka_unit_test(contacts_of_what_is_solid_leave_sensors_out),
        cmocka_unit_test(an_axis_in_the_plane_of_a_face_is_inside_by_its_radius),
        cmocka_unit_test(a_users_sensors_may_be_terse_but_not_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

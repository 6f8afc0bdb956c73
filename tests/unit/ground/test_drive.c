/* SPDX-License-Identifier: MIT
 * test_drive.c: the drive of an animation (root motion): a velocity that is kept, or one that comes on top, with the
 * same way at every rate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static const double G = 9.81, SKIN = 0.01, RADIUS = 0.35;

static void stand(rig *r, fake_world *w)
{
    fake_world_flat(w);
    rig_stand(r, w, NULL, fake_vec(0, 0, 1));
}

static void a_drive_is_the_speed_on_ground_whatever_is_wished(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        stand(&r, &w);
        double z = r.state.position.z;
        r.input.flags = TAHR_INPUT_DRIVE;
        r.input.drive = fake_vec(1.5, -2, 4); /* the floor says how high */
        r.input.move = fake_vec(-1, 0, 0);
        r.state.velocity = fake_vec(0, 6, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 1.5, 1e-9);
        assert_near(r.state.position.y, -2, 1e-9);
        assert_near(r.state.position.z, z, 0);
        assert_near(r.state.velocity.x, 1.5, 1e-12);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        r.input.flags = 0; /* and from there on as ever: brakes, along its way, at once below the wish's */
        rig_step(&r, 1 / rig_rates[i]);
        assert_true(r.state.velocity.x < 1.5);
        rig_close(&r);
    }
}

static void a_drive_of_nothing_holds_still_and_sleeps(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    stand(&r, &w);
    r.input.flags = TAHR_INPUT_DRIVE;
    r.input.move = fake_vec(1, 0, 0);
    r.state.velocity = fake_vec(5, 0, 0);
    double x = r.state.position.x;
    tahr_report report;
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report;
    for (int i = 0; i < 4; i++) {
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.01, &r.state, &report), TAHR_OK);
    }
    assert_near(r.state.position.x, x, 0);
    assert_true(report.flags & TAHR_REPORT_ASLEEP);
    rig_close(&r);
}

static void a_drive_climbs_slopes_along_the_surface_and_steps(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_init(&w);
        fake_add_slope(&w, 30);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1.2));
        r.input.flags = TAHR_INPUT_DRIVE;
        r.input.drive = fake_vec(2, 0, 0);
        double x = r.state.position.x;
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x - x, 2 * sqrt(0.75), 1e-6);
        rig_close(&r);

        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(1, -3, 0), fake_vec(9, 3, 0.3));
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.flags = TAHR_INPUT_DRIVE;
        r.input.drive = fake_vec(3, 0, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 3, 0.02 * 3); /* steps cost no more than 2 % */
        assert_true(r.state.position.x <= 3 + 1e-9);
        assert_near(r.state.position.z, 0.3 + 0.9125, 0.0026);
        rig_close(&r);
    }
}

static void a_drive_slides_along_walls_and_goes_on_where_they_end(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        stand(&r, &w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), -1); /* at x = 1 */
        r.input.flags = TAHR_INPUT_DRIVE;
        r.input.drive = fake_vec(3, 4, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 1 - RADIUS - SKIN, 1e-6);
        assert_near(r.state.position.y, 4, 1e-6);
        rig_close(&r);
    }
}

static void in_the_air_a_drive_takes_the_place_of_gravity_or_not(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_init(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 0));
        r.state.velocity = fake_vec(7, 0, -3);
        r.input.move = fake_vec(0, 1, 0);
        r.input.flags = TAHR_INPUT_DRIVE;
        r.input.drive = fake_vec(1, 2, 3);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 1, 1e-9);
        assert_near(r.state.position.y, 2, 1e-9);
        assert_near(r.state.position.z, 3, 1e-9);
        r.input.drive = fake_vec(0, 0, -300); /* terminal_speed is that of falling */
        rig_step(&r, 0.1);
        assert_near(r.state.position.z, 3 - 30, 1e-9);
        rig_close(&r);

        rig_open(&r, &w, NULL, fake_vec(0, 0, 0));
        r.state.velocity = fake_vec(7, 0, 3);
        r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_LEVEL;
        r.input.drive = fake_vec(1, 2, 50);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 1, 1e-9);
        assert_near(r.state.position.y, 2, 1e-9);
        assert_near(r.state.position.z, 3 - 0.5 * G, 1e-9);
        assert_near(r.state.velocity.z, 3 - G, 1e-9);
        rig_close(&r);
    }
}

static void an_added_drive_comes_on_top_and_is_not_kept(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        stand(&r, &w);
        r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD;
        r.input.drive = fake_vec(-1, 2, 0);
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 6 - 36 / (2 * 20.48) - 1, 1e-9);
        assert_near(r.state.position.y, 2, 1e-9);
        assert_near(r.state.velocity.x, 6, 1e-9);
        assert_near(r.state.velocity.y, 0, 1e-12);
        rig_close(&r);

        fake_world_init(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 0));
        r.state.velocity = fake_vec(1, 0, 2);
        r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD;
        r.input.drive = fake_vec(3, 0, 1);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 4, 1e-9);
        assert_near(r.state.position.z, 3 - 0.5 * G, 1e-9);
        assert_near(r.state.velocity.x, 1, 1e-12);
        assert_near(r.state.velocity.z, 2 - G, 1e-9);
        rig_close(&r);
    }
}

static void an_added_drive_stands_against_the_own_walk(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    stand(&r, &w);
    r.state.velocity = fake_vec(6, 0, 0);
    r.input.move = fake_vec(1, 0, 0);
    r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD;
    r.input.drive = fake_vec(-6, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.position.x, 0, 1e-12);
    assert_near(r.state.velocity.x, 6, 1e-12);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_close(&r);
}

static void what_an_added_drive_runs_into_is_met_in_time_and_stops_it(void **unused)
{
    /* From rest, 20.48 m/s2 and 2 m/s more: way 10.24 t^2 + 2 t. */
    const double way = 1 - RADIUS - SKIN, when = (-2 + sqrt(4 + 4 * 10.24 * way)) / (2 * 10.24);
    (void)unused;
    for (int own = 0; own < 2; own++) {
        for (int i = 0; i < RIG_RATES; i++) {
            fake_world w;
            rig r;
            double dt = 1 / rig_rates[i], at = -1;
            stand(&r, &w);
            fake_add_plane(&w, fake_vec(-1, 0, 0), -1); /* at x = 1 */
            r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD;
            r.input.drive = fake_vec(2, own ? 0 : 1, 0);
            r.input.move = fake_vec(own, 0, 0);
            for (int k = 0; k < (int)rig_rates[i]; k++) {
                rig_step(&r, dt);
                const tahr_event *e = rig_event(&r, TAHR_EVENT_HIT);
                if (e && at < 0) {
                    at = k * dt + e->time;
                    assert_near(e->value, own ? 2 + 20.48 * when : 2, 1e-5);
                }
            }
            assert_near(at, own ? when : way / 2, 1e-6);
            assert_near(r.state.position.x, 1 - RADIUS - SKIN, 1e-6);
            assert_near(r.state.position.y, own ? 0 : 1, 1e-6);
            rig_close(&r);
        }
    }
}

static void an_added_drive_lands_what_rises_by_itself(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    c.gravity = fake_vec(0, 0, 0);
    fake_world_flat(&w);
    rig_open(&r, &w, &c, fake_vec(0, 0, 2.91)); /* 2 m over its skin */
    r.state.velocity = fake_vec(0, 0, 1);
    r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD;
    r.input.drive = fake_vec(0, 0, -5);
    rig_step(&r, 0.6);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_LANDED);
    assert_non_null(e);
    assert_near(e->time, 0.5, 1e-9);
    assert_near(e->value, 4, 1e-9);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_close(&r);
}

static void drive_flags_without_a_drive_are_nothing(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    stand(&r, &w);
    r.input.flags = TAHR_INPUT_DRIVE_ADD | TAHR_INPUT_DRIVE_LEVEL | TAHR_INPUT_LAUNCH_LEVEL | TAHR_INPUT_LAUNCH_UP;
    r.input.drive = r.input.launch = fake_vec(3, 3, 3);
    tahr_state before = r.state;
    rig_step(&r, 0.1);
    assert_memory_equal(&before, &r.state, sizeof before);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_drive_is_the_speed_on_ground_whatever_is_wished),
                                       cmocka_unit_test(a_drive_of_nothing_holds_still_and_sleeps),
                                       cmocka_unit_test(a_drive_climbs_slopes_along_the_surface_and_steps),
                                       cmocka_unit_test(a_drive_slides_along_walls_and_goes_on_where_they_end),
                                       cmocka_unit_test(in_the_air_a_drive_takes_the_place_of_gravity_or_not),
                                       cmocka_unit_test(an_added_drive_comes_on_top_and_is_not_kept),
                                       cmocka_unit_test(an_added_drive_stands_against_the_own_walk),
                                       cmocka_unit_test(what_an_added_drive_runs_into_is_met_in_time_and_stops_it),
                                       cmocka_unit_test(an_added_drive_lands_what_rises_by_itself),
                                       cmocka_unit_test(drive_flags_without_a_drive_are_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_walking.c: speeds and distances against the closed forms, query counts, walls, slopes, ledges. What holds on
 * every ground is in test_course.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static void distance_after_acceleration_is_the_closed_form(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.move = fake_vec(0.6, 0.8, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        double distance = 6 - 36 / (2 * 20.48);
        assert_near(r.state.position.x, 0.6 * distance, 1e-9);
        assert_near(r.state.position.y, 0.8 * distance, 1e-9);
        assert_near(r.state.velocity.x, 3.6, 1e-9);
        rig_close(&r);
    }
}

static void half_a_stick_is_half_the_speed(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.move = fake_vec(0.5, 0, 3); /* the part along up is ignored */
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.velocity.x, 3, 1e-12);
    assert_near(r.state.velocity.z, 0, 0);
    rig_close(&r);
}

static void braking_stops_when_and_where_the_closed_form_says(void **unused)
{
    const double truth = log1p(16 * 6 / 20.48) / 16, place = 6 / 16.0 - 20.48 / 16 * truth;
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double dt = 1 / rig_rates[i], at = -1;
        int stops = 0;
        fake_world_flat(&w);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.state.velocity = fake_vec(6, 0, 0);
        for (int k = 0; k < (int)rig_rates[i]; k++) {
            rig_step(&r, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_STOPPED);
            if (e) {
                stops++;
                at = k * dt + e->time;
                assert_near(e->position.x, place, 1e-9 * place);
            }
        }
        assert_int_equal(stops, 1);
        assert_near(at, truth, 1e-9 * truth);
        assert_near(r.state.position.x, place, 1e-9 * place);
        assert_true(r.state.velocity.x == 0);
        rig_close(&r);
    }
}

static void flat_ground_costs_two_sweeps_walking_one_standing_none_cached(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 30; i++) {
        w.sweeps = w.contact_queries = 0;
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps + r.report.contact_queries + r.report.rays, 0);
        assert_int_equal(w.sweeps + w.contact_queries, 0);
        assert_true(r.report.flags & TAHR_REPORT_CACHED_FLOOR);
    }
    r.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 30; i++) {
        w.sweeps = w.contact_queries = 0;
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps, 2);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
        assert_int_equal(w.sweeps, 2);
        assert_int_equal(w.contact_queries, 0);
    }
    rig_close(&r);
    c.cached_floor = c.sleep = 0;
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    for (int i = 0; i < 30; i++) {
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps, 1);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void falling_free_costs_one_sweep(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 100));
    for (int i = 0; i < 100; i++) {
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps, 1);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void what_is_placed_into_an_idle_character_pushes_it_out(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    double radius = r.config.shape.radius, skin = r.config.skin;
    fake_add_box(&w, fake_vec(radius - 0.05, -1, 0), fake_vec(3, 1, 2));
    rig_step(&r, 1.0 / 60);
    assert_true(r.state.position.x == 0); /* nobody said that the world changed */
    assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.position.x, -0.05 - skin, 1e-9);
    assert_non_null(rig_event(&r, TAHR_EVENT_DEPENETRATED));
    rig_close(&r);
}

static void idle_character_does_not_move_by_one_bit(void **unused)
{
    (void)unused;
    for (int cached = 0; cached < 2; cached++) {
        for (int degrees = 0; degrees <= 45; degrees += 9) {
            fake_world w;
            rig r;
            tahr_config c = rig_config();
            c.cached_floor = (uint32_t)cached;
            c.sleep = 0; /* computed each time */
            fake_world_init(&w);
            fake_add_slope(&w, degrees);
            rig_stand(&r, &w, &c, fake_vec(0, 0, 1.5));
            tahr_state rest = r.state;
            for (int i = 0; i < 200; i++) {
                rig_step(&r, i % 2 ? 1.0 / 60 : 0.25);
                assert_memory_equal(&r.state, &rest, sizeof rest);
            }
            rig_close(&r);
        }
    }
}

static void speed_along_a_slope_is_the_asked_one(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int direction = -1; direction <= 1; direction += 2) {
            fake_world w;
            rig r;
            fake_world_init(&w);
            fake_add_slope(&w, 45);
            rig_stand(&r, &w, NULL, fake_vec(0, 0, 1.5));
            double x = r.state.position.x;
            r.input.move = fake_vec(direction, 0, 0);
            for (int k = 0; k < (int)rig_rates[i]; k++) {
                rig_step(&r, 1 / rig_rates[i]);
                assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
                assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-8);
            }
            double along = 6 - 36 / (2 * 20.48);
            assert_near((r.state.position.x - x) * direction, along * sqrt(0.5), 1e-6);
            rig_close(&r);
        }
    }
}

/* Three seconds slantwise toward a wall at x = 2: most of them along it. */
static void walk_along_a_wall(rig *r, fake_world *w, double rate)
{
    fake_world_flat(w);
    fake_add_plane(w, fake_vec(-1, 0, 0), -2);
    rig_stand(r, w, NULL, fake_vec(0, 0, 1));
    r->input.move = fake_vec(0.8, 0.6, 0);
    rig_steps(r, (int)(3 * rate), 1 / rate);
}

static void wall_is_slid_along_without_penetration(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        walk_along_a_wall(&r, &w, rig_rates[i]);
        double gap = fake_clearance(&w, &r.config.shape, r.state.position);
        assert_near(2 - 0.35 - r.state.position.x, 0.01, 1e-8);
        assert_true(gap >= 0.01 - 1e-8);
        assert_true(r.state.velocity.x <= 1e-9);
        rig_close(&r);
    }
}

/* Only contact events may depend on the step: the steady speed along a wall is that of the wish's part along it. */
static void speed_along_a_wall_is_the_part_of_the_wish_along_it_at_every_rate(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        walk_along_a_wall(&r, &w, rig_rates[i]);
        double y = r.state.position.y;
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.y - y, 3.6, 0.02 * 3.6);
        rig_close(&r);
    }
}

static void acute_corner_is_a_place_to_rest(void **unused)
{
    const double degrees[] = {5, 8, 12, 30, 60, 89};
    (void)unused;
    for (int i = 0; i < 6; i++) {
        fake_world w;
        rig r;
        double a = degrees[i] * acos(-1.0) / 360;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(-sin(a), cos(a), 0), -3 * sin(a)); /* closing at x = 3 */
        fake_add_plane(&w, fake_vec(-sin(a), -cos(a), 0), -3 * sin(a));
        rig_stand(&r, &w, NULL, fake_vec(3 - 4 - 0.36 / sin(a), 0.01, 1));
        r.input.move = fake_vec(1, 0.05, 0);
        uint32_t sweeps = 0;
        for (int k = 0; k < 400; k++) {
            rig_step(&r, 1.0 / 60);
            sweeps = r.report.sweeps > sweeps ? r.report.sweeps : sweeps;
            assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
        }
        assert_near(r.state.position.x, 3 - 0.36 / sin(a), 1e-4 / sin(a));
        tahr_vec3 rest = r.state.position;
        rig_steps(&r, 60, 1.0 / 60);
        assert_near(r.state.position.x, rest.x, 1e-5);
        assert_true(sweeps <= 30);
        rig_close(&r);
    }
}

/* At rest 4 m before the end of a plateau at x = 0, its side edge at y = 5, all turned about z by an angle. */
static void stand_before_a_ledge(rig *r, fake_world *w, const tahr_config *config, double angle)
{
    fake_world_init(w);
    w->frame.z = sin(angle / 2);
    w->frame.w = cos(angle / 2);
    fake_add_box(w, fake_vec(-20, -5, -1), fake_vec(0, 5, 0));
    rig_stand(r, w, config, fake_turn(w->frame, fake_vec(-4, 0, 1)));
}

static void walking_off_a_ledge_falls_with_the_level_speed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        int left = 0;
        stand_before_a_ledge(&r, &w, NULL, 0);
        r.input.move = fake_vec(1, 0, 0);
        for (int k = 0; k < (int)(1.5 * rig_rates[i]); k++) {
            rig_step(&r, 1 / rig_rates[i]);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
            if (e) {
                left++;
                assert_true(e->position.x > 0 && e->position.x < 0.36);
            }
        }
        assert_int_equal(left, 1);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_near(r.state.velocity.x, 6, 1e-6);
        rig_close(&r);
    }
}

static void ledge_guard_keeps_the_character_up(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int turn = 0; turn < 6; turn++) {
            fake_world w;
            rig r;
            tahr_config c = rig_config();
            c.walk_off_ledges = 0;
            stand_before_a_ledge(&r, &w, &c, 0.3 * turn);
            r.input.move = fake_turn(w.frame, fake_vec(0.8, 0.6, 0));
            tahr_vec3 p = {0, 0, 0};
            for (int k = 0; k < (int)(4 * rig_rates[i]); k++) {
                rig_step(&r, 1 / rig_rates[i]);
                assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
                p = fake_turn_back(w.frame, r.state.position);
                assert_true(p.x < 0.35 && p.y < 5.35);
            }
            assert_true(p.y > 4.5); /* it went on along the edge */
            rig_close(&r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_after_acceleration_is_the_closed_form),
        cmocka_unit_test(half_a_stick_is_half_the_speed),
        cmocka_unit_test(braking_stops_when_and_where_the_closed_form_says),
        cmocka_unit_test(flat_ground_costs_two_sweeps_walking_one_standing_none_cached),
        cmocka_unit_test(falling_free_costs_one_sweep),
        cmocka_unit_test(what_is_placed_into_an_idle_character_pushes_it_out),
        cmocka_unit_test(idle_character_does_not_move_by_one_bit),
        cmocka_unit_test(speed_along_a_slope_is_the_asked_one),
        cmocka_unit_test(wall_is_slid_along_without_penetration),
        cmocka_unit_test(speed_along_a_wall_is_the_part_of_the_wish_along_it_at_every_rate),
        cmocka_unit_test(acute_corner_is_a_place_to_rest),
        cmocka_unit_test(walking_off_a_ledge_falls_with_the_level_speed),
        cmocka_unit_test(ledge_guard_keeps_the_character_up)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

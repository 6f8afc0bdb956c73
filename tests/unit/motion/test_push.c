/* SPDX-License-Identifier: MIT
 * test_push.c: bodies that move into a character push it, at any speed, and crush it only where there is no room;
 * conveyors; what a character does to bodies that have a mass. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"

static const tahr_quat LEVEL = {0, 0, 0, 1};
static const double REACH = 0.35 + 0.01; /* radius and skin */

/* The ground and a wall of 1 x 10 x 4 m (body 1) at x = -5. */
static void stand_by_wall(rig *r, tahr_vec3 at)
{
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(-5, 0, 2), fake_vec(0.5, 5, 2))};
    rig_open_bodies(r, bodies, 2, NULL, at);
    rig_settle(r);
}

static void a_wall_pushes_a_character_at_any_speed(void **unused)
{
    const double speeds[] = {0.1, 1, 10, 100, 1000};
    (void)unused;
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            rig r;
            double dt = 1 / rig_rates[i];
            stand_by_wall(&r, fake_vec(0, 0.3, 1));
            double height = r.state.position.z;
            for (int n = 1; n * dt * speeds[k] < 20; n++) {
                tahr_pose pose = {{-5 + speeds[k] * n * dt, 0, 2}, LEVEL};
                stage_step(&r, 1, pose, dt);
                assert_near(r.state.position.x, fmax(0, pose.position.x + 0.5 + REACH), 1e-9);
                assert_near(r.state.position.y, 0.3, 1e-9);
                assert_near(r.state.position.z, height, 1e-9);
                assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
                if (n * dt > 2) {
                    break;
                }
            }
            rig_close(&r);
        }
    }
}

static void a_swinging_door_sweeps_a_character_along(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        /* A rod of 2 x 0.04 m half extents about its middle; 6 rad/s: at 10 Hz it turns by 34 degrees a step. */
        tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, 1), fake_vec(2, 0.02, 1))};
        rig_open_bodies(&r, bodies, 2, NULL, fake_vec(1, 0.6, 1));
        rig_settle(&r);
        for (int n = 1; n * dt < 0.4; n++) {
            double angle = 6 * n * dt;
            tahr_pose pose = {{0, 0, 1}, stage_yaw(angle)};
            stage_step(&r, 1, pose, dt);
            double across = -sin(angle) * r.state.position.x + cos(angle) * r.state.position.y;
            double along = cos(angle) * r.state.position.x + sin(angle) * r.state.position.y;
            assert_true(along > 2 || across > 0.02 + 0.35 - 1e-6);
        }
        assert_true(stage_distance(r.state.position, fake_vec(1, 0.6, r.state.position.z)) > 0.5);
        rig_close(&r);
    }
}

static void a_rod_that_spins_short_of_a_character_does_not_touch_it(void **unused)
{
    rig r;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, 1), fake_vec(2, 0.02, 1))};
    (void)unused;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(1.5, -1.95, 1)); /* 2.460 m from the axis: 0.1 m clear of the tips */
    rig_settle(&r);
    tahr_vec3 at = r.state.position;
    for (int n = 1; n <= 40; n++) { /* 34 degrees a step: the chord of its way, seen from the rod, is 0.107 m further
                                     * in */
        stage_step(&r, 1, (tahr_pose){{0, 0, 1}, stage_yaw(0.6 * n)}, 0.1);
        assert_true(stage_distance(at, r.state.position) < 1e-9);
    }
    rig_close(&r);
}

static void a_motion_pushes_once_however_many_steps_see_it(void **unused)
{
    rig r;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, 1), fake_vec(0.3, 0.5, 1))};
    (void)unused;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0.1, 1.2, 1));
    rig_settle(&r);
    r.input.move = fake_vec(0, -1, 0);
    stage_step(&r, 1, (tahr_pose){{1.5, 0, 1}, LEVEL}, 1.0 / 60);
    rig_steps(&r, 60, 1.0 / 60); /* walks over the place where the box was */
    assert_true(r.state.position.y < -3);
    assert_near(r.state.position.x, 0.1, 0);
    rig_close(&r);
}

/* Between two walls, 0.1 m into each, and under a press, 0.15 m into it: the least of all depths would be 0.1 m down in
 * the floor, which is 5 cm below. */
static void a_crushed_character_is_not_pressed_into_the_floor(void **unused)
{
    rig r;
    tahr_body_desc bodies[4] = {stage_ground(), stage_box(fake_vec(9, 0, 1), fake_vec(1, 1, 1)),
                                stage_box(fake_vec(12, 0, 1), fake_vec(1, 1, 1)),
                                stage_box(fake_vec(15, 0, 1), fake_vec(1, 1, 1))};
    const tahr_body_pose poses[3] = {{1, TAHR_POSE_TELEPORT, {{1.25, 0, 1}, LEVEL}},
                                     {2, TAHR_POSE_TELEPORT, {{-1.25, 0, 1}, LEVEL}},
                                     {3, TAHR_POSE_TELEPORT, {{0, 0, 2.7}, LEVEL}}};
    (void)unused;
    rig_open_bodies(&r, bodies, 4, NULL, fake_vec(0, 0, 0.95));
    assert_int_equal(tahr_world_move(r.world, poses, 3, 1e-3), TAHR_OK);
    rig_step(&r, 1e-3);
    assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
    assert_true(r.state.position.z >= 0.9 - 1e-6);
    rig_close(&r);
}

static void a_rising_floor_takes_a_character_up_and_a_press_crushes_it_under_the_ceiling(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc bodies[2] = {stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25)),
                                stage_box(fake_vec(0, 0, 4), fake_vec(5, 5, 0.5))};
    (void)unused;
    bodies[1].flags = 0;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    int crushed = 0;
    double z = 0;
    for (int n = 1; n <= 150; n++) { /* 1 m/s up to 2.2 m below a ceiling at 3.5 m, then down again */
        z = n <= 120 ? n * dt : (240 - n) * dt;
        tahr_pose pose = {{0, 0, -0.25 + z}, LEVEL};
        stage_step(&r, 0, pose, dt);
        double room = 3.5 - z - 1.8;
        if (room > 0) {
            assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
        } else {
            assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
            assert_near(r.report.residual, -room, 0.02); /* the skins of both sides are part of it */
            assert_int_equal(r.status, r.report.flags & TAHR_REPORT_STUCK ? TAHR_STUCK : TAHR_CRUSHED);
            crushed++;
        }
        assert_true(r.state.position.z + 0.9 < 3.5 + 1e-6); /* never into what does not move */
    }
    assert_in_range(crushed, 30, 40);
    rig_settle(&r);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_near(r.state.position.z - 0.9 - z, 0.0125, 0.0026); /* in the band again */
    rig_close(&r);
}

/* Two walls that close to a gap and open again. gap 0.71: room for the shape, not for its skins. */
static void closing_walls_crush_only_when_they_leave_no_room(void **unused)
{
    const double gaps[] = {0.8, 0.73, 0.71, 0.6};
    (void)unused;
    for (int k = 0; k < 4; k++) {
        rig r;
        const double dt = 1.0 / 60;
        tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(-3, 0, 1.5), fake_vec(1, 3, 1.5)),
                                    stage_box(fake_vec(3, 0, 1.5), fake_vec(1, 3, 1.5))};
        rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0.3, 0, 1));
        rig_settle(&r);
        int crushed = 0;
        for (int n = 1; n <= 200; n++) {
            double half = fmax(gaps[k] / 2, n <= 100 ? 2 - 2 * n * dt : gaps[k] / 2 + 2 * (n - 100) * dt);
            tahr_body_pose poses[2] = {{1, 0, {{-1 - half, 0, 1.5}, LEVEL}}, {2, 0, {{1 + half, 0, 1.5}, LEVEL}}};
            assert_int_equal(tahr_world_move(r.world, poses, 2, dt), TAHR_OK);
            rig_step(&r, dt);
            crushed += (r.report.flags & TAHR_REPORT_CRUSHED) != 0;
            assert_true(fabs(r.state.position.x) < fmax(half - 0.35, 0) + 0.03);
            assert_near(r.state.position.z, 0.9125, 0.003);
        }
        assert_true((crushed > 0) == (gaps[k] < 0.7));
        r.input.move = fake_vec(0, 1, 0);
        rig_steps(&r, 60, dt);
        assert_true(r.state.position.y > 5); /* free again */
        rig_close(&r);
    }
}

/* Two walls 2 degrees off parallel: 0.2 m nearer, and there is room again 0.2 / tan(2 degrees) = 5.7 m along them. What
 * pushes goes 0.2 m, and an overlap is left by max_depenetration = 1 m at most: each of two overlaps by itself. */
static void nobody_is_flung_along_walls_that_close(void **unused)
{
    const double dt = 1.0 / 60, lean = 2 * 0.017453292519943295;
    tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(0, 1.4, 1.5), fake_vec(20, 1, 1.5)),
                                stage_box(fake_vec(0, -1.45, 1.5), fake_vec(20, 1, 1.5))};
    rig r;
    (void)unused;
    bodies[2].pose.orientation = stage_yaw(lean);
    rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    tahr_vec3 from = r.state.position;
    tahr_pose pose = {{0, -1.25, 1.5}, stage_yaw(lean)};
    stage_step(&r, 2, pose, dt);
    assert_true(stage_distance(from, r.state.position) < 0.2 + 2 * 1.0);
    assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
    rig_close(&r);
}

static void a_press_from_above_squeezes_out_who_is_near_its_edge(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, 4), fake_vec(1, 1, 1))};
    (void)unused;
    bodies[1].type = TAHR_BODY_SPHERE;
    bodies[1].radius = 1;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0.2, 0.1, 1));
    rig_settle(&r);
    for (int n = 1; n <= 180; n++) {
        tahr_pose pose = {{0, 0, 4 - n * dt}, LEVEL};
        stage_step(&r, 1, pose, dt);
        assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
        assert_near(r.state.position.z, 0.9125, 0.003);
    }
    double away = hypot(r.state.position.x, r.state.position.y);
    assert_true(away > 1.3);
    assert_near(r.state.position.y / r.state.position.x, 0.5, 1e-3); /* straight away from its axis */
    rig_close(&r);
}

static void a_pushed_character_slides_along_what_is_in_the_way(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    /* A fixed wall at 45 degrees across the way of a piston along x. */
    tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(-3, 0, 1.5), fake_vec(1, 5, 1.5)),
                                stage_box(fake_vec(2, 0, 1.5), fake_vec(0.2, 5, 1.5))};
    (void)unused;
    bodies[2].flags = 0;
    bodies[2].pose.orientation = stage_yaw(0.7853981633974483);
    rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    for (int n = 1; n <= 240; n++) {
        tahr_pose pose = {{-3 + n * dt, 0, 1.5}, LEVEL};
        stage_step(&r, 1, pose, dt);
        assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
        assert_true(r.state.position.x >= pose.position.x + 1 + REACH - 1e-5);
        assert_true((r.state.position.x - 2) * sqrt(0.5) + r.state.position.y * sqrt(0.5) <= -0.2 - REACH + 1e-5);
    }
    /* In the corner of both: x = -3 + 4 + 1 + REACH, (x - 2 + y) / sqrt 2 = -0.2 - REACH. */
    assert_near(r.state.position.x, 2 + REACH, 1e-5);
    assert_near(r.state.position.y, -REACH - sqrt(2) * (0.2 + REACH), 1e-4);
    rig_close(&r);
}

static void a_pushed_character_steps_up(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(-3, 0, 1.5), fake_vec(1, 5, 1.5)),
                                    stage_box(fake_vec(5, 0, 0), fake_vec(4, 5, 0.25))};
        bodies[2].flags = 0; /* a step of 0.25 m at x = 1 */
        rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        for (int n = 1; n * dt < 4; n++) {
            tahr_pose pose = {{-3 + n * dt, 0, 2}, LEVEL};
            stage_step(&r, 1, pose, dt);
            assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
            assert_true(r.state.position.x >= pose.position.x + 1 + REACH - 1e-5);
        }
        assert_near(r.state.position.z - 0.9 - 0.25, 0.0125, 0.0026);
        rig_close(&r);
    }
}

static void a_floor_that_rises_into_a_falling_character_is_landed_on_at_its_speed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i], speed = -1;
        tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25));
        rig_open_bodies(&r, &slab, 1, NULL, fake_vec(0, 0, 2.9));
        for (int n = 1; n * dt < 1; n++) {
            tahr_pose pose = {{0, 0, -0.25 + 5 * n * dt}, LEVEL};
            stage_step(&r, 0, pose, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_LANDED);
            if (e) {
                speed = e->value;
            }
            assert_true(r.state.position.z - 0.9 >= pose.position.z + 0.25 + 0.01 - 1e-9);
        }
        /* 1.99 m apart: 5 t + g t^2 / 2; sqrt(5^2 + 2 g 1.99) at the meeting */
        assert_near(speed, sqrt(25 + 2 * 9.81 * 1.99), 1e-4);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.velocity.z, 0, 0);
        rig_close(&r);
    }
}

static void a_conveyor_carries_and_hands_over_its_velocity(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        tahr_body_desc belt = stage_box(fake_vec(0, 0, -0.25), fake_vec(20, 2, 0.25));
        belt.flags = 0;
        belt.surface_velocity = fake_vec(2, 0, 0);
        belt.pose.orientation = stage_yaw(1.5707963267948966); /* it runs along y in the world */
        rig_open_bodies(&r, &belt, 1, NULL, fake_vec(0, 0, 0.9125));
        rig_step(&r, dt); /* lands */
        while (r.state.mode != TAHR_MODE_WALKING || fabs(r.state.velocity.y) > 0) {
            rig_step(&r, dt);
        }
        double start = r.state.position.y;
        rig_steps(&r, (int)rig_rates[i], dt);
        assert_near(r.state.position.y - start, 2, 1e-9);
        assert_near(r.state.position.x, 0, 1e-9);
        assert_near(r.state.velocity.y, 0, 1e-9);
        r.input.jump = 1;
        rig_step(&r, dt);
        assert_near(r.state.velocity.y, 2, 1e-9);
        rig_close(&r);
    }
}

static void hitting_a_body_with_a_mass_reports_its_push(void **unused)
{
    const double masses[] = {0, 5, 80, 1e6};
    (void)unused;
    for (int k = 0; k < 4; k++) {
        rig r;
        const double dt = 1.0 / 60;
        tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(2, 0, 1), fake_vec(0.5, 0.5, 1))};
        bodies[1].mass = masses[k];
        rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(1, 0, 0);
        const tahr_event *hit = NULL, *push = NULL;
        for (int n = 0; n < 60 && !hit; n++) {
            rig_step(&r, dt);
            hit = rig_event(&r, TAHR_EVENT_HIT);
            push = rig_event(&r, TAHR_EVENT_PUSHED);
        }
        assert_non_null(hit);
        assert_true((push != NULL) == (masses[k] > 0));
        if (push) {
            double reduced = 80 * masses[k] / (80 + masses[k]);
            assert_near(push->value, fmin(hit->value * reduced, 500 * dt), 1e-9);
            assert_near(push->normal.x, -1, 1e-9);
            assert_near(push->position.x, 1.5, 1e-6);
            assert_int_equal(push->body, 1);
        }
        rig_steps(&r, 30, dt); /* leaning against it goes on pushing: 20.48 / 60 m/s more each step, were it not
                                * there */
        push = rig_event(&r, TAHR_EVENT_PUSHED);
        assert_true((push != NULL) == (masses[k] > 0));
        if (push) {
            assert_near(push->value, fmin(20.48 * dt * 80 * masses[k] / (80 + masses[k]), 500 * dt), 1e-9);
        }
        rig_close(&r);
    }
}

static void standing_on_a_body_with_a_mass_reports_the_weight(void **unused)
{
    rig r;
    tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25));
    (void)unused;
    slab.mass = 20;
    rig_open_bodies(&r, &slab, 1, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    rig_step(&r, 1.0 / 60);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_PUSHED);
    assert_non_null(e);
    assert_near(e->value, 80 * 9.81 / 60, 1e-9);
    assert_near(e->normal.z, 1, 1e-12);
    assert_near(e->position.z, 0, 1e-6);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_pushes_a_character_at_any_speed),
        cmocka_unit_test(a_swinging_door_sweeps_a_character_along),
        cmocka_unit_test(a_rod_that_spins_short_of_a_character_does_not_touch_it),
        cmocka_unit_test(a_motion_pushes_once_however_many_steps_see_it),
        cmocka_unit_test(a_crushed_character_is_not_pressed_into_the_floor),
        cmocka_unit_test(a_rising_floor_takes_a_character_up_and_a_press_crushes_it_under_the_ceiling),
        cmocka_unit_test(closing_walls_crush_only_when_they_leave_no_room),
        cmocka_unit_test(nobody_is_flung_along_walls_that_close),
        cmocka_unit_test(a_press_from_above_squeezes_out_who_is_near_its_edge),
        cmocka_unit_test(a_pushed_character_slides_along_what_is_in_the_way),
        cmocka_unit_test(a_pushed_character_steps_up),
        cmocka_unit_test(a_floor_that_rises_into_a_falling_character_is_landed_on_at_its_speed),
        cmocka_unit_test(a_conveyor_carries_and_hands_over_its_velocity),
        cmocka_unit_test(hitting_a_body_with_a_mass_reports_its_push),
        cmocka_unit_test(standing_on_a_body_with_a_mass_reports_the_weight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_base_velocity.c: what a moving base hands over to who leaves it, and takes off who lands on it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"

static void jumps_are_as_high_above_a_base_as_above_the_ground(void **unused)
{
    const double speeds[] = {-12, -3, 0, 3, 12};
    (void)unused;
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            rig r;
            double dt = 1 / rig_rates[i], top = 0, t = 0;
            stage_stand_on_slab(&r, NULL, 0, 0);
            double ground = stage_foot(&r).z;
            for (int n = 1; t < 1.5; n++) {
                tahr_pose pose = {{2 * n * dt, 0, -0.25 + speeds[k] * n * dt}, STAGE_LEVEL};
                r.input.jump = n * dt > 0.2 && n * dt < 0.4;
                stage_step(&r, 0, pose, dt);
                t = n * dt;
                top = fmax(top, stage_foot(&r).z - (pose.position.z + 0.25) - ground);
                assert_near(r.state.position.x, 2 * t, 1e-6);
            }
            /* 4.2^2 / (2 g) = 0.8991 m; sampled at the ends of steps: lower by up to g dt^2 / 8 */
            assert_near(top, 4.2 * 4.2 / 19.62 - 0.5 * 9.81 * dt * dt / 4, 0.5 * 9.81 * dt * dt / 4 + 2e-3);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            rig_close(&r);
        }
    }
}

static void who_walks_off_a_base_keeps_its_velocity(void **unused)
{
    (void)unused;
    for (uint32_t flags = 0; flags < 4; flags++) {
        rig r;
        tahr_config c = rig_config();
        const double dt = 1.0 / 60;
        c.impart = flags;
        stage_stand_on_slab(&r, &c, 4, 0);
        r.input.move = fake_vec(1, 0, 0);
        for (int n = 1; r.state.mode == TAHR_MODE_WALKING; n++) {
            tahr_pose pose = {{0, 3 * n * dt, -0.25 + 2 * n * dt}, STAGE_LEVEL};
            stage_step(&r, 0, pose, dt);
            assert_true(n < 60);
        }
        assert_int_equal(r.state.base.body, TAHR_NO_BODY);
        assert_near(r.state.velocity.y, flags & TAHR_IMPART_LEVEL ? 3 : 0, 1e-9);
        assert_near(r.state.base.velocity.y, flags & TAHR_IMPART_LEVEL ? 3 : 0, 1e-9);
        assert_near(r.state.base.velocity.z, flags & TAHR_IMPART_UP ? 2 : 0, 1e-9);
        rig_close(&r);
    }
}

static void a_turntable_hands_over_the_tangent_velocity(void **unused)
{
    (void)unused;
    for (uint32_t turn = 0; turn < 2; turn++) {
        rig r;
        tahr_config c = rig_config();
        c.impart = TAHR_IMPART_LEVEL | TAHR_IMPART_UP | (turn ? (uint32_t)TAHR_IMPART_TURN : 0u);
        stage_stand_on_slab(&r, &c, 3, 0);
        for (int n = 1; n <= 61; n++) {
            r.input.jump = n == 61;
            stage_step(&r, 0, (tahr_pose){{0, 0, -0.25}, stage_yaw(n / 60.0)}, 1.0 / 60);
        }
        double angle = 61.0 / 60; /* w x r, w = 1 rad/s, r = 3 m */
        assert_near(r.state.velocity.x, turn ? -3 * sin(angle) : 0, 1e-9);
        assert_near(r.state.velocity.y, turn ? 3 * cos(angle) : 0, 1e-9);
        assert_near(r.state.velocity.z, 4.2 - 9.81 / 60, 1e-9);
        rig_close(&r);
    }
}

static void imparted_velocity_halves_in_its_half_life(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        tahr_config c = rig_config();
        double dt = 1 / rig_rates[i];
        c.imparted_half_life = 0.25;
        stage_stand_on_slab(&r, &c, 0, 0);
        tahr_pose pose = {{8 * dt, 0, -0.25}, STAGE_LEVEL};
        r.input.jump = 1;
        stage_step(&r, 0, pose, dt);
        double left = 8 * exp2(-dt / 0.25); /* it decays from the jump on, not from the next step on */
        assert_near(r.state.velocity.x, left, 1e-9);
        pose.position.x = 1000;
        tahr_body_pose away = {0, TAHR_POSE_TELEPORT, pose};
        assert_int_equal(tahr_world_move(r.world, &away, 1, dt), TAHR_OK);
        rig_steps(&r, (int)(rig_rates[i] / 2), dt);
        assert_near(r.state.velocity.x, left / 4, 1e-9);
        assert_near(r.state.base.velocity.x, left / 4, 1e-9);
        rig_close(&r);
    }
}

static void lift_momentum_remembers_a_base_that_stopped(void **unused)
{
    const double dt = 1.0 / 60;
    (void)unused;
    for (int late = 0; late < 2; late++) {
        rig r;
        tahr_config c = rig_config();
        c.lift_momentum = 0.1;
        stage_stand_on_slab(&r, &c, 0, 0);
        for (int n = 1; n <= 30; n++) {
            tahr_pose pose = {{0, 0, -0.25 + 5 * n * dt}, STAGE_LEVEL};
            stage_step(&r, 0, pose, dt);
        }
        assert_int_equal(tahr_world_move(r.world, NULL, 0, dt), TAHR_OK);
        rig_steps(&r, late ? 7 : 3, dt);
        r.input.jump = 1;
        rig_step(&r, dt);
        assert_near(r.state.velocity.z, 4.2 + (late ? 0 : 5) - 9.81 * dt, 1e-9);
        rig_close(&r);
    }
}

static void landing_on_a_moving_base_takes_its_velocity_off(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i], t = 0;
        tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(20, 5, 0.25));
        tahr_config c = rig_config();
        c.braking_deceleration = c.braking_drag = 0;
        rig_open_bodies(&r, &slab, 1, &c, fake_vec(0, 0, 1.9));
        r.state.velocity = fake_vec(3, 0, 0);
        for (int n = 1; t < 1; n++) {
            tahr_pose pose = {{8 * n * dt, 0, -0.25}, STAGE_LEVEL};
            stage_step(&r, 0, pose, dt);
            t = n * dt;
        }
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_int_equal(r.state.base.body, 0);
        assert_near(r.state.velocity.x, 3 - 8, 1e-9);
        assert_near(r.state.position.x, 3 * t, 1e-6); /* frictionless: the world velocity stays 3 m/s throughout */
        rig_close(&r);
    }
}

static void who_steps_from_one_base_to_the_next_keeps_its_velocity_in_the_world(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_config c = rig_config();
    tahr_body_desc bodies[2] = {stage_box(fake_vec(0, 0, -0.25), fake_vec(20, 2, 0.25)),
                                stage_box(fake_vec(0, 4, -0.25), fake_vec(20, 2, 0.25))};
    (void)unused;
    c.braking_deceleration = c.braking_drag = 0;
    rig_open_bodies(&r, bodies, 2, &c, fake_vec(0, 0.5, 1));
    rig_settle(&r);
    r.state.velocity = fake_vec(0, 2, 0);
    int changes = 0;
    for (int n = 1; n <= 60; n++) {
        tahr_body_pose poses[2] = {{0, 0, {{1 * n * dt, 0, -0.25}, STAGE_LEVEL}},
                                   {1, 0, {{-2 * n * dt, 4, -0.25}, STAGE_LEVEL}}};
        assert_int_equal(tahr_world_move(r.world, poses, 2, dt), TAHR_OK);
        rig_step(&r, dt);
        const tahr_event *e = rig_event(&r, TAHR_EVENT_BASE);
        if (e && n > 1) {
            changes++;
            assert_int_equal(e->body, 1);
        }
        double base = r.state.base.body == 0 ? 1 : -2;
        assert_near(r.state.velocity.x + base, 1, 1e-9);
        assert_near(r.state.velocity.y, 2, 1e-9);
    }
    assert_int_equal(changes, 1);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(jumps_are_as_high_above_a_base_as_above_the_ground),
        cmocka_unit_test(who_walks_off_a_base_keeps_its_velocity),
        cmocka_unit_test(a_turntable_hands_over_the_tangent_velocity),
        cmocka_unit_test(imparted_velocity_halves_in_its_half_life),
        cmocka_unit_test(lift_momentum_remembers_a_base_that_stopped),
        cmocka_unit_test(landing_on_a_moving_base_takes_its_velocity_off),
        cmocka_unit_test(who_steps_from_one_base_to_the_next_keeps_its_velocity_in_the_world)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

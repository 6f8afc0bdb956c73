/* SPDX-License-Identifier: MIT
 * test_two_walls_inputs.c: what the input asks of a character of the unreal preset beside walking: crouching, drives,
 * launches, a plane; and bases that move. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "parity.h"
#include "rig.h"

static const double rates[] = {10, 30, 60, 240};
enum { RATES = 4, METHODS = 2 };

/* The unreal preset, stepped and in closed forms. */
static tahr_config config_of(int method)
{
    tahr_config c = parity_config();
    c.integrator = method ? TAHR_INTEGRATOR_EXACT : TAHR_INTEGRATOR_STEPPED;
    return c;
}

static void crouched_characters_walk_at_their_speed(void **unused)
{
    (void)unused;
    for (int k = 0; k < METHODS * RATES; k++) {
        const tahr_config c = config_of(k / RATES);
        double hz = rates[k % RATES];
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.input.crouch = 1;
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, (int)hz, 1 / hz);
        assert_near(r.state.velocity.x, 3, 1e-9);
        assert_near(r.state.half_height, 0.4, 1e-12);
        rig_close(&r);
    }
}

static void a_drive_is_the_velocity_of_its_step(void **unused)
{
    (void)unused;
    for (int k = 0; k < METHODS * RATES; k++) {
        const tahr_config c = config_of(k / RATES);
        double hz = rates[k % RATES];
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.state.velocity = fake_vec(0, 5, 0);
        r.input.move = fake_vec(0, 1, 0);
        r.input.flags = TAHR_INPUT_DRIVE;
        r.input.drive = fake_vec(2, 0, 0);
        rig_steps(&r, (int)hz, 1 / hz);
        assert_near(r.state.position.x, 2, 1e-9);
        assert_near(r.state.position.y, 0, 1e-9);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        rig_close(&r);
    }
}

static void a_drive_in_the_air_leaves_falling_alone_or_floats(void **unused)
{
    (void)unused;
    for (int k = 0; k < 2 * METHODS * RATES; k++) {
        const tahr_config c = config_of(k / RATES % METHODS);
        double hz = rates[k % RATES], fall = 0.5 * 9.8;
        int level = k >= METHODS * RATES;
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_open(&r, &w, &c, fake_vec(0, 0, 30));
        r.input.flags = TAHR_INPUT_DRIVE | (level ? TAHR_INPUT_DRIVE_LEVEL : 0u);
        r.input.drive = fake_vec(2, 1, -1.5);
        rig_steps(&r, (int)hz, 1 / hz);
        assert_near(r.state.position.x, 2, 1e-9);
        assert_near(r.state.position.y, 1, 1e-9);
        assert_near(r.state.position.z, 30 - (level ? fall : 1.5), 1e-9);
        rig_close(&r);
    }
}

static void a_drift_comes_on_top_and_is_not_kept(void **unused)
{
    (void)unused;
    for (int k = 0; k < METHODS * RATES; k++) {
        const tahr_config c = config_of(k / RATES);
        double hz = rates[k % RATES];
        for (int air = 0; air < 2; air++) {
            fake_world w;
            rig r;
            fake_world_flat(&w);
            if (air) {
                rig_open(&r, &w, &c, fake_vec(0, 0, 30));
            } else {
                rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
            }
            r.state.velocity = fake_vec(6, 0, 0);
            r.input.move = fake_vec(1, 0, 0);
            r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD | TAHR_INPUT_DRIVE_LEVEL;
            r.input.drive = fake_vec(0, 2, 0);
            rig_steps(&r, (int)hz, 1 / hz);
            assert_near(r.state.position.x, 6, 1e-6);
            assert_near(r.state.position.y, 2, 1e-6);
            assert_near(r.state.velocity.x, 6, 1e-6);
            assert_near(r.state.velocity.y, 0, 1e-9);
            rig_close(&r);
        }
    }
}

static void a_drift_into_a_wall_leaves_no_velocity_behind(void **unused)
{
    (void)unused;
    for (int k = 0; k < METHODS * RATES; k++) {
        const tahr_config c = config_of(k / RATES);
        double hz = rates[k % RATES];
        for (int air = 0; air < 2; air++) {
            fake_world w;
            rig r;
            fake_world_flat(&w);
            fake_add_plane(&w, fake_vec(-1, 0, 0), -1);
            if (air) {
                rig_open(&r, &w, &c, fake_vec(0, 0, 30));
            } else {
                rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
            }
            r.input.flags = TAHR_INPUT_DRIVE | TAHR_INPUT_DRIVE_ADD | TAHR_INPUT_DRIVE_LEVEL;
            r.input.drive = fake_vec(3, 0, 0);
            rig_steps(&r, (int)hz, 1 / hz);
            assert_near(r.state.velocity.x, 0, 1e-9);
            assert_true(r.state.position.x > 0.5 && r.state.position.x < 0.66);
            rig_close(&r);
        }
    }
}

static void motion_stays_in_its_plane(void **unused)
{
    (void)unused;
    for (int k = 0; k < METHODS * RATES; k++) {
        tahr_config c = config_of(k / RATES);
        double hz = rates[k % RATES];
        fake_world w;
        rig r;
        c.plane = fake_vec(0, 1, 0);
        fake_world_flat(&w);
        fake_add_plane(&w, unit(vec(-1, 0.6, 0)), -3); /* a wall that would push it aside */
        fake_add_box(&w, fake_vec(1, -5, 0), fake_vec(1.5, 5, 0.3));
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        for (int i = 0; i < (int)(3 * hz); i++) {
            r.input.move = fake_vec(1, 0.7, 0);
            r.input.jump = i / (int)(0.5 * hz) % 2 == 1;
            rig_step(&r, 1 / hz);
            assert_near(r.state.position.y, 0, 1e-12);
            assert_near(r.state.velocity.y, 0, 1e-12);
        }
        assert_true(r.state.position.x > 1.6);
        rig_close(&r);
    }
}

/* On a slab at 2 m/s: walking is relative to it, a jump takes its velocity along. */
static void bases_carry_and_are_jumped_off(void **unused)
{
    (void)unused;
    for (int k = 0; k < METHODS * RATES; k++) {
        const tahr_config c = config_of(k / RATES);
        double hz = rates[k % RATES];
        tahr_body_desc slab = native_box(fake_vec(0, 0, -0.5), fake_vec(20, 20, 0.5));
        rig r;
        slab.flags = TAHR_BODY_MOVABLE;
        rig_open_bodies(&r, &slab, 1, &c, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.time = 0;
        uint32_t body = 0;
        tahr_vec3 from = r.state.position;
        for (int i = 1; i <= (int)(1.5 * hz); i++) {
            tahr_body_pose pose = {.body = body, .pose = {{2 * i / hz, 0, -0.5}, {0, 0, 0, 1}}};
            assert_int_equal(tahr_world_move(r.world, &pose, 1, 1 / hz), TAHR_OK);
            r.input.jump = i > (int)hz;
            rig_step(&r, 1 / hz);
            if (i == (int)hz) {
                assert_near(r.state.position.x - from.x, 2, 1e-6);
                assert_near(r.state.velocity.x, 0, 1e-9);
                assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            }
        }
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_near(r.state.velocity.x, 2, 1e-6);
        assert_near(r.state.position.x - from.x, 2 * (int)(1.5 * hz) / hz, 1e-6);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crouched_characters_walk_at_their_speed),
        cmocka_unit_test(a_drive_is_the_velocity_of_its_step),
        cmocka_unit_test(a_drive_in_the_air_leaves_falling_alone_or_floats),
        cmocka_unit_test(a_drift_comes_on_top_and_is_not_kept),
        cmocka_unit_test(a_drift_into_a_wall_leaves_no_velocity_behind),
        cmocka_unit_test(motion_stays_in_its_plane),
        cmocka_unit_test(bases_carry_and_are_jumped_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

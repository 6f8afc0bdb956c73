/* SPDX-License-Identifier: MIT
 * test_platformer.c: the preset of the side-scroller does what its comments promise, at every frame rate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "layers.h"

/* m/s2 rising and falling, m/s: from the preset's own table in config.h. */
static const double RISING = 19.62, FALLING = 1.5 * 19.62, JUMP = 9;

static void stand(layers *l, rig *r, double x)
{
    tahr_config c = layers_config(l, TAHR_PRESET_PLATFORMER);
    layers_open(l, r, &c, x, 0.02);
    rig_settle(r);
}

static void is_precise_but_for_what_its_table_says(void **unused)
{
    (void)unused;
    tahr_config p, c;
    const char *field = NULL;
    assert_int_equal(tahr_config_init(&p, sizeof p, TAHR_PRESET_PRECISE), TAHR_OK);
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PLATFORMER), TAHR_OK);
    assert_int_equal(tahr_config_check(&c, &field), TAHR_OK);
    assert_string_equal(tahr_preset_name(TAHR_PRESET_PLATFORMER), "platformer");
    assert_true(c.plane.z == 1 && c.gravity.y == -19.62 && c.jump_speed == 9 && c.coyote_time == 0.1);
    assert_true(c.acceleration == 40 && c.braking_deceleration == 40 && c.air_control == 1 && c.terminal_speed == 25);
    assert_true(c.jump_buffer == 0.12 && c.jump_release_gravity == 3 && c.fall_gravity == 1.5);
    assert_true(c.wall_slide_speed == 3 && c.wall_jump_speed == 6 && c.wall_coyote_time == 0.1);
    assert_true(c.corner_correction == 0.25 && c.lift_momentum == 0.1 && c.crouched_half_height == 0.45);
    c.preset = p.preset;
    c.plane = p.plane;
    c.gravity = p.gravity;
    c.jump_speed = p.jump_speed;
    c.acceleration = p.acceleration;
    c.braking_deceleration = p.braking_deceleration;
    c.air_control = p.air_control;
    c.terminal_speed = p.terminal_speed;
    c.coyote_time = c.jump_buffer = c.wall_slide_speed = c.wall_jump_speed = c.wall_coyote_time = 0;
    c.jump_release_gravity = c.fall_gravity = 1;
    c.corner_correction = c.lift_momentum = 0;
    c.crouched_half_height = p.crouched_half_height;
    assert_memory_equal(&c, &p, sizeof c);
}

/* 2.06 m: onto a ledge two tiles high, with the foot 1.25 skins above the ground. */
static void a_whole_jump_is_two_tiles_high(void **unused)
{
    (void)unused;
    for (int world = 0; world < 2; world++) {
        for (int i = 0; i < RIG_RATES; i++) {
            static layers l;
            rig r;
            player p;
            layers_begin(&l, world);
            layers_add(&l, LAYER_BOX, -20, 20, 0, 0);
            stand(&l, &r, 0);
            double foot = layers_foot(&l, &r), up = JUMP / RISING, high = JUMP * JUMP / (2 * RISING);
            player_begin(&p, &r, rig_rates[i]);
            player_press(&p, up + 0.01);
            assert_near(p.when[TAHR_EVENT_APEX], up, 1e-9);
            assert_near(layers_height(&l, p.last[TAHR_EVENT_APEX].position) - 0.9 - foot, high, 1e-9);
            player_await(&p, TAHR_EVENT_LANDED);
            assert_near(p.when[TAHR_EVENT_LANDED], up + sqrt(2 * (high + foot - 0.01) / FALLING), 1e-6);
            assert_true(high > 2.0625);
            rig_close(&r);
        }
    }
}

/* Let go at 0.1 s it weighs three times as much from then on. */
static void a_short_press_is_a_low_jump(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        static layers l;
        rig r;
        player p;
        layers_begin(&l, 1);
        layers_add(&l, LAYER_BOX, -20, 20, 0, 0);
        stand(&l, &r, 0);
        double foot = layers_foot(&l, &r), v = JUMP - RISING * 0.1;
        double high = JUMP * 0.1 - RISING * 0.005 + v * v / (6 * RISING);
        player_begin(&p, &r, rig_rates[i]);
        player_press(&p, 0.1);
        player_release(&p, 0.5);
        assert_near(p.when[TAHR_EVENT_APEX], 0.1 + v / (3 * RISING), 1e-9);
        assert_near(layers_height(&l, p.last[TAHR_EVENT_APEX].position) - 0.9 - foot, high, 1e-9);
        rig_close(&r);
    }
}

/* Pressed after the end of the floor, and before a landing on a platform. */
static void jumps_are_forgiven_late_and_early(void **unused)
{
    (void)unused;
    static const double LATE[] = {0.03, 0.099, 0.101, 0.2};
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            static layers l;
            rig r;
            player p;
            layers_begin(&l, 1);
            layers_add(&l, LAYER_BOX, -20, 0, 0, 0);
            layers_add(&l, LAYER_TILES, 0, 20, -30, TAHR_BODY_ONE_WAY);
            stand(&l, &r, -3);
            r.input.move = layers_at(&l, 1, 0);
            player_begin(&p, &r, rig_rates[i]);
            player_await(&p, TAHR_EVENT_LEFT_GROUND);
            double left = p.when[TAHR_EVENT_LEFT_GROUND];
            if (p.time > left + LATE[k]) { /* the step was longer */
                rig_close(&r);
                continue;
            }
            player_until(&p, left + LATE[k]);
            player_press(&p, left + LATE[k] + 0.02);
            assert_int_equal(p.seen[TAHR_EVENT_JUMPED], LATE[k] < 0.1 ? 1 : 0);
            rig_close(&r);
        }
    }
    for (int k = 0; k < 2; k++) {
        static layers l;
        rig r;
        player p;
        double early = k ? 0.121 : 0.119, lands = sqrt(2 * (2 - 0.01) / FALLING);
        layers_begin(&l, 1);
        layers_add(&l, LAYER_TILES, -5, 5, 0, TAHR_BODY_ONE_WAY);
        tahr_config c = layers_config(&l, TAHR_PRESET_PLATFORMER);
        layers_open(&l, &r, &c, 0.2, 2);
        player_begin(&p, &r, 144);
        player_until(&p, lands - early);
        player_press(&p, lands + 0.1);
        assert_int_equal(p.seen[TAHR_EVENT_JUMPED], k ? 0 : 1);
        assert_near(p.when[TAHR_EVENT_LANDED], lands, 1e-9);
        assert_true(k || fabs(p.when[TAHR_EVENT_JUMPED] - lands) < 1e-9);
        rig_close(&r);
    }
}

/* Slides down a wall no faster than 3 m/s and jumps off it; the side of a one-way body is none. */
static void walls_are_slid_down_and_jumped_off(void **unused)
{
    (void)unused;
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            static layers l;
            rig r;
            player p;
            layers_begin(&l, 1);
            tahr_body_desc *b = &l.bodies[l.count++];
            tahr_body_desc_init(b, sizeof *b, TAHR_BODY_BOX);
            b->pose.position = (tahr_vec3){1.36, 0, 0};
            b->half_extents = (tahr_vec3){1, 40, 5};
            b->flags = k ? TAHR_BODY_ONE_WAY : 0;
            tahr_config c = layers_config(&l, TAHR_PRESET_PLATFORMER);
            layers_open(&l, &r, &c, 0, 10);
            r.input.move = layers_at(&l, 1, 0);
            player_begin(&p, &r, rig_rates[i]);
            player_until(&p, 0.5);
            double free = 3 / FALLING, fallen = k ? FALLING * 0.125 : 1.5 * free + 3 * (0.5 - free);
            assert_near(layers_foot(&l, &r), 10 - fallen, 1e-6);
            player_press(&p, 0.52);
            assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], !k);
            assert_int_equal(p.seen[TAHR_EVENT_HIT] > 0, !k);
            rig_close(&r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_precise_but_for_what_its_table_says),
        cmocka_unit_test(a_whole_jump_is_two_tiles_high),
        cmocka_unit_test(a_short_press_is_a_low_jump),
        cmocka_unit_test(jumps_are_forgiven_late_and_early),
        cmocka_unit_test(walls_are_slid_down_and_jumped_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

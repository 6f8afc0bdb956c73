/* SPDX-License-Identifier: MIT
 * test_methods.c: the jump helpers with every way to fall: in steps, with two walls, with the other preset. What
 * steps cost in exactness is theirs: times are right to a slice. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "player.h"

enum { PRECISE, STEPS, TWO_WALLS, UNREAL, METHODS };

static const double V = 4.2;

static tahr_config config_of(int method)
{
    tahr_config c = rig_config();
    if (method == UNREAL) {
        assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    }
    c.integrator = method == STEPS ? TAHR_INTEGRATOR_STEPPED : c.integrator;
    c.slide_solver = method == TWO_WALLS ? TAHR_SLIDE_TWO_WALLS : c.slide_solver;
    return c;
}

static double height(const tahr_config *c)
{
    return V * V / (-2 * c->gravity.z);
}

/* m, from the centre to a wall that is touched. */
static double flush(const tahr_config *c)
{
    return c->shape.radius + (c->separation == TAHR_SEPARATION_MARGIN ? c->skin : c->pull_back);
}

static void coyote_and_buffered_jumps_start_and_are_as_high(void **unused)
{
    (void)unused;
    for (int method = 0; method < METHODS; method++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = config_of(method);
        c.coyote_time = c.jump_buffer = 0.15;
        c.perch_threshold = 0;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-10, -10, -1), fake_vec(0, 10, 0));
        fake_add_plane(&w, fake_vec(0, 0, 1), -3);
        rig_stand(&r, &w, &c, fake_vec(-3, 0, 1));
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, 60);
        player_await(&p, TAHR_EVENT_LEFT_GROUND);
        player_until(&p, p.when[TAHR_EVENT_LEFT_GROUND] + 0.1);
        double z = r.state.position.z;
        player_press(&p, p.time + 0.6);
        assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, z + height(&c), 1e-6);
        r.input.jump = 0;
        while (r.state.position.z > -3 + c.shape.half_height + 0.8) { /* 0.1 s before the ground at 7 m/s */
            player_until(&p, p.time + 1.0 / 60);
        }
        player_press(&p, p.time + 1.0 / 60);
        r.input.jump = 0;
        player_await(&p, TAHR_EVENT_APEX);
        assert_true(p.seen[TAHR_EVENT_LANDED] == 1 && p.seen[TAHR_EVENT_JUMPED] == 2);
        assert_near(p.when[TAHR_EVENT_JUMPED], p.when[TAHR_EVENT_LANDED], 1e-9);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, p.last[TAHR_EVENT_JUMPED].position.z + height(&c), 1e-6);
        rig_close(&r);
    }
}

static void walls_are_slid_down_and_jumped_off_once(void **unused)
{
    (void)unused;
    for (int method = 0; method < METHODS; method++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = config_of(method);
        c.wall_slide_speed = 2;
        c.wall_jump_speed = 4;
        c.wall_coyote_time = 0.2;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), 0);
        rig_open(&r, &w, &c, fake_vec(-flush(&c), 0, 30));
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, 60);
        player_until(&p, 1);
        assert_near(r.state.velocity.z, -2, 0.01);
        assert_true(r.state.flags & TAHR_STATE_WALL_TOUCHED);
        double z = r.state.position.z;
        player_press(&p, 1.3);
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], 1);
        assert_true(r.state.position.x < -1 && !(r.state.flags & TAHR_STATE_WALL_TOUCHED));
        player_await(&p, TAHR_EVENT_APEX);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, z + height(&c), 1e-6);
        player_release(&p, p.time + 0.1);
        player_press(&p, p.time + 0.1);
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], 1);
        rig_close(&r);
    }
}

static void edges_are_grabbed_and_climbed(void **unused)
{
    (void)unused;
    for (int method = 0; method < METHODS; method++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = config_of(method);
        c.ledge_grab = 0.3;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(0, -5, 0), fake_vec(6, 5, 10));
        rig_open(&r, &w, &c, fake_vec(-flush(&c), 0, 11 - c.shape.half_height));
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, 60);
        player_until(&p, 1);
        assert_int_equal(r.state.mode, TAHR_MODE_HANGING);
        assert_near(p.when[TAHR_EVENT_GRABBED], sqrt(2 / -c.gravity.z), 1.0 / 60);
        assert_near(r.state.position.z, 10 - c.shape.half_height, 1e-8);
        assert_near(r.state.position.x, -flush(&c), 1e-3);
        r.input.move = fake_vec(0, 0, 0);
        player_press(&p, 1.1);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.position.z, 10 + c.shape.half_height + 1.25 * c.skin, 0.5 * c.skin);
        rig_close(&r);
    }
}

static void corners_are_passed(void **unused)
{
    (void)unused;
    for (int method = 0; method < METHODS; method++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = config_of(method);
        c.corner_correction = 0.15;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(0.25, -5, 2.4), fake_vec(10, 5, 6));
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        double z = r.state.position.z;
        player_begin(&p, &r, 60);
        player_press(&p, 0.7);
        assert_int_equal(p.seen[TAHR_EVENT_HIT], 0);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, z + height(&c), 0.01);
        assert_near(r.state.position.x, 0.25 - c.shape.radius - c.skin, 1e-4);
        rig_close(&r);
    }
}

static void gravity_follows_the_button_and_the_direction(void **unused)
{
    (void)unused;
    for (int method = 0; method < METHODS; method++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = config_of(method);
        c.jump_release_gravity = 3;
        c.fall_gravity = 2;
        c.jump_speed = 8;
        double g = -c.gravity.z, rest = 8 - g * 0.3;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        double z = r.state.position.z;
        player_begin(&p, &r, 60);
        player_press(&p, 0.3);
        player_release(&p, 2);
        double top = z + 8 * 0.3 - g * 0.045 + rest * rest / (6 * g);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, top, 1e-6);
        assert_near(p.last[TAHR_EVENT_LANDED].value, sqrt(4 * g * (top - c.shape.half_height)), 0.5);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coyote_and_buffered_jumps_start_and_are_as_high),
        cmocka_unit_test(walls_are_slid_down_and_jumped_off_once), cmocka_unit_test(edges_are_grabbed_and_climbed),
        cmocka_unit_test(corners_are_passed), cmocka_unit_test(gravity_follows_the_button_and_the_direction)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

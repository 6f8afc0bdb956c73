/* SPDX-License-Identifier: MIT
 * test_feel.c: what is forgiven when a jump is pressed early, late or short, against the parabola, at every frame
 * rate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "player.h"

static const double G = 9.81, V = 4.2;

/* m, how high the jump of the preset rises. */
static double height(void)
{
    return V * V / (2 * G);
}

/* A platform 50 m up that ends at x = 0, walked toward its end at 6 m/s until the floor ended. The floor ends where the
 * foot does, so that nothing of it is met while falling. Returns the time at which it ended. */
static double walk_off(rig *r, fake_world *w, player *p, tahr_config *c, double rate)
{
    fake_world_init(w);
    fake_add_box(w, fake_vec(-10, -10, -1), fake_vec(0, 10, 0));
    fake_add_plane(w, fake_vec(0, 0, 1), -50);
    c->perch_threshold = 0;
    rig_stand(r, w, c, fake_vec(-4, 0, 1));
    r->input.move = fake_vec(1, 0, 0);
    player_begin(p, r, rate);
    player_await(p, TAHR_EVENT_LEFT_GROUND);
    assert_true(p->last[TAHR_EVENT_LEFT_GROUND].value == TAHR_LEFT_LEDGE);
    return p->when[TAHR_EVENT_LEFT_GROUND];
}

static void coyote_jump_is_as_high_as_any_other(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int late = 0; late <= 1; late++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = rig_config();
            c.coyote_time = 0.15;
            double left = walk_off(&r, &w, &p, &c, rig_rates[i]);
            double z = p.last[TAHR_EVENT_LEFT_GROUND].position.z;
            double after = late ? 0.15 + 1e-6 : 0.15 - 1e-6; /* more than the longest step of 0.1 s, in which it left */
            player_until(&p, left + after);
            assert_near(r.state.position.z, z - G * after * after / 2, 1e-9);
            double begin = r.state.position.z;
            player_press(&p, left + 1);
            assert_int_equal(p.seen[TAHR_EVENT_JUMPED], late ? 0 : 1);
            assert_int_equal(p.seen[TAHR_EVENT_LEFT_GROUND], 1);
            if (!late) {
                assert_near(p.last[TAHR_EVENT_APEX].position.z, begin + height(), 1e-9);
                assert_near(p.when[TAHR_EVENT_APEX], left + after + V / G, 1e-9);
            }
            rig_close(&r);
        }
    }
}

static void neither_jump_nor_launch_leaves_coyote_time(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = rig_config();
    (void)unused;
    c.coyote_time = 0.5;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    player_begin(&p, &r, 60);
    player_press(&p, 0.1);
    player_release(&p, 0.2);
    assert_true(r.state.coyote_left == 0);
    player_press(&p, 0.3);
    assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
    rig_close(&r);

    walk_off(&r, &w, &p, &c, 60);
    assert_true(r.state.coyote_left > 0.4);
    r.input.flags = TAHR_INPUT_LAUNCH;
    r.input.launch = fake_vec(0, 0, 1);
    rig_step(&r, 1.0 / 60);
    assert_true(r.state.coyote_left == 0);
    rig_close(&r);
}

static void coyote_jump_uses_up_the_time_and_a_second_press_does_nothing(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = rig_config();
    (void)unused;
    c.coyote_time = 0.3;
    double left = walk_off(&r, &w, &p, &c, 60);
    player_press(&p, left + 0.1);
    player_release(&p, left + 0.15);
    player_press(&p, left + 0.5);
    assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
    rig_close(&r);
}

/* Falls from 3 m; the press comes `early` s before the landing. */
static void drop(rig *r, fake_world *w, player *p, const tahr_config *c, double rate)
{
    fake_world_flat(w);
    rig_open(r, w, c, fake_vec(0, 0, 3));
    player_begin(p, r, rate);
}

static void buffered_jump_starts_at_the_landing_and_is_as_high_as_any_other(void **unused)
{
    const double lands = sqrt(2 * (3 - 0.91) / G);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int held = 0; held <= 1; held++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = rig_config();
            c.jump_buffer = 1.2; /* longer than the jump: pressed once, it jumps once */
            drop(&r, &w, &p, &c, rig_rates[i]);
            player_until(&p, lands - 0.11);
            player_press(&p, lands - 0.1);
            r.input.jump = (uint32_t)held;
            player_until(&p, lands + 0.5);
            assert_int_equal(p.seen[TAHR_EVENT_LANDED], 1);
            assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
            assert_near(p.when[TAHR_EVENT_JUMPED], lands, 1e-9);
            assert_near(p.last[TAHR_EVENT_APEX].position.z, 0.91 + height(), 1e-9);
            assert_near(p.when[TAHR_EVENT_APEX], lands + V / G, 1e-9);
            player_until(&p, lands + 3); /* used up: it stays on the ground */
            assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            rig_close(&r);
        }
    }
}

static void press_earlier_than_the_buffer_is_forgotten(void **unused)
{
    const double lands = sqrt(2 * (3 - 0.91) / G);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int late = 0; late <= 1; late++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = rig_config();
            c.jump_buffer = 0.12;
            drop(&r, &w, &p, &c, rig_rates[i]);
            player_until(&p, lands - (late ? 0.12 - 1e-6 : 0.12 + 1e-6));
            player_press(&p, lands + 0.5);
            assert_int_equal(p.seen[TAHR_EVENT_JUMPED], late);
            assert_true(r.state.buffer_left == 0);
            rig_close(&r);
        }
    }
}

static void jump_held_from_the_buffer_is_held_as_long_as_any_other(void **unused)
{
    const double lands = sqrt(2 * (3 - 0.91) / G);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = rig_config();
        c.jump_buffer = 0.12;
        c.jump_hold_time = 0.2;
        drop(&r, &w, &p, &c, rig_rates[i]);
        player_until(&p, lands - 0.1);
        player_press(&p, lands + 1);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, 0.91 + V * 0.2 + height(), 1e-9);
        rig_close(&r);
    }
}

/* Up at 8 m/s, the button let go after 0.3 s: from there on three times the gravity; down at twice. */
static void released_jump_is_cut_and_a_new_press_does_not_restore_it(void **unused)
{
    const double v = 8, t = 0.3, rest = v - G * t, top = v * t - G * t * t / 2 + rest * rest / (2 * 3 * G);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int again = 0; again <= 1; again++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = rig_config();
            c.jump_speed = v;
            c.jump_release_gravity = 3;
            c.fall_gravity = 2;
            fake_world_flat(&w);
            rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
            double z = r.state.position.z;
            player_begin(&p, &r, rig_rates[i]);
            player_press(&p, t);
            player_release(&p, t + 0.05);
            r.input.jump = (uint32_t)again;
            player_until(&p, 2);
            assert_near(p.last[TAHR_EVENT_APEX].position.z, z + top, 1e-9);
            assert_near(p.when[TAHR_EVENT_APEX], t + rest / (3 * G), 1e-9);
            double falls = sqrt(2 * (z + top - 0.91) / (2 * G));
            assert_near(p.when[TAHR_EVENT_LANDED], t + rest / (3 * G) + falls, 1e-8);
            assert_near(p.last[TAHR_EVENT_LANDED].value, 2 * G * falls, 1e-8);
            rig_close(&r);
        }
    }
}

static void release_gravity_is_for_jumps_alone(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = rig_config();
    (void)unused;
    c.jump_release_gravity = 3;
    fake_world_flat(&w);
    rig_open(&r, &w, &c, fake_vec(0, 0, 3));
    r.state.velocity = fake_vec(0, 0, V); /* thrown, not jumped */
    player_begin(&p, &r, 60);
    player_await(&p, TAHR_EVENT_APEX);
    assert_near(p.last[TAHR_EVENT_APEX].position.z, 3 + height(), 1e-9);
    rig_close(&r);
}

/* The first press at rest, the second 0.2 s later while it still rises, the third 0.6 s after that while it falls. */
static void air_jumps_reach_the_speed_of_a_jump_and_no_more(void **unused)
{
    const double second = V * 0.2 - G * 0.04 / 2, third = second + V * 0.6 - G * 0.36 / 2;
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = rig_config();
        c.air_jumps = 2;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        double z = r.state.position.z;
        player_begin(&p, &r, rig_rates[i]);
        player_press(&p, 0.1);
        player_release(&p, 0.2);
        player_press(&p, 0.3);
        assert_int_equal(r.state.jump_count, 1);
        player_release(&p, 0.8);
        assert_near(r.state.position.z, z + third, 1e-9);
        player_press(&p, 0.9);
        player_release(&p, 1);
        player_press(&p, 1.1); /* one too many */
        assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 3);
        assert_int_equal(r.state.jump_count, 2);
        player_until(&p, 3);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, z + third + height(), 1e-9);
        assert_int_equal(r.state.jump_count, 0); /* given back by the ground */
        rig_close(&r);
    }
}

static void walking_off_a_ledge_costs_no_air_jump(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = rig_config();
    (void)unused;
    c.air_jumps = 1;
    double left = walk_off(&r, &w, &p, &c, 60);
    for (int i = 0; i < 3; i++) {
        player_press(&p, left + 0.2 * i + 0.1);
        player_release(&p, left + 0.2 * i + 0.2);
    }
    assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
    rig_close(&r);
}

static void coyote_comes_before_the_air_jump(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = rig_config();
    (void)unused;
    c.air_jumps = 1;
    c.coyote_time = 0.2;
    double left = walk_off(&r, &w, &p, &c, 60);
    player_press(&p, left + 0.1);
    assert_true(p.seen[TAHR_EVENT_JUMPED] == 1 && r.state.jump_count == 0);
    player_release(&p, left + 0.2);
    player_press(&p, left + 0.3);
    assert_true(p.seen[TAHR_EVENT_JUMPED] == 2 && r.state.jump_count == 1);
    rig_close(&r);
}

static void nothing_is_remembered_while_all_is_off(void **unused)
{
    fake_world w;
    rig r;
    player p;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_state start = r.state;
    player_begin(&p, &r, 60);
    for (int i = 0; i < 40; i++) {
        const tahr_state *s = &r.state;
        player_press(&p, 0.1 * i + 0.05);
        player_release(&p, 0.1 * i + 0.1);
        assert_true(s->coyote_left + s->buffer_left + s->wall_left + s->lift_left == 0 && s->jump_count == 0);
        assert_memory_equal(&s->wall_normal, &start.wall_normal, sizeof s->wall_normal);
        assert_int_equal(s->wall_body, TAHR_NO_BODY);
        assert_int_equal(s->flags & ~(uint32_t)(TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMPING | TAHR_STATE_FLOOR_MOVED), 0);
    }
    rig_close(&r);
}

static void timers_run_out_to_zero_and_the_state_repeats(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    (void)unused;
    c.coyote_time = c.jump_buffer = c.wall_coyote_time = 0.3;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.state.coyote_left = 0.1;
    r.state.wall_left = 1.0 / 60; /* over with the step but for rounding */
    for (int i = 1; i <= 12; i++) {
        rig_step(&r, 1.0 / 60);
        assert_near(r.state.coyote_left, fmax(0.1 - i / 60.0, 0), 1e-12);
        assert_true(r.state.wall_left == 0);
    }
    assert_true(r.state.coyote_left == 0);
    tahr_state before = r.state;
    rig_step(&r, 1.0 / 60);
    assert_memory_equal(&before, &r.state, sizeof before);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coyote_jump_is_as_high_as_any_other),
        cmocka_unit_test(neither_jump_nor_launch_leaves_coyote_time),
        cmocka_unit_test(coyote_jump_uses_up_the_time_and_a_second_press_does_nothing),
        cmocka_unit_test(buffered_jump_starts_at_the_landing_and_is_as_high_as_any_other),
        cmocka_unit_test(press_earlier_than_the_buffer_is_forgotten),
        cmocka_unit_test(jump_held_from_the_buffer_is_held_as_long_as_any_other),
        cmocka_unit_test(released_jump_is_cut_and_a_new_press_does_not_restore_it),
        cmocka_unit_test(release_gravity_is_for_jumps_alone),
        cmocka_unit_test(air_jumps_reach_the_speed_of_a_jump_and_no_more),
        cmocka_unit_test(walking_off_a_ledge_costs_no_air_jump),
        cmocka_unit_test(coyote_comes_before_the_air_jump),
        cmocka_unit_test(nothing_is_remembered_while_all_is_off),
        cmocka_unit_test(timers_run_out_to_zero_and_the_state_repeats)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_wall.c: walls in the air: sliding down, jumping off, and that one wall is never climbed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "player.h"

static const double G = 9.81, V = 4.2, FLUSH = 0.36; /* m, radius and skin */

static double height(void)
{
    return V * V / (2 * G);
}

/* The ground z = 0 and a wall that faces -x at x = 0. */
static void wall_world(fake_world *w)
{
    fake_world_flat(w);
    fake_add_plane(w, fake_vec(-1, 0, 0), 0);
}

static tahr_config wall_config(void)
{
    tahr_config c = rig_config();
    c.wall_jump_speed = 5;
    c.wall_slide_speed = 2;
    return c;
}

static void slide_is_no_faster_than_asked_while_pushing(void **unused)
{
    const double T = 1, gain = 2 / G; /* s until it is as fast as it may */
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int push = 0; push <= 1; push++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = wall_config();
            wall_world(&w);
            rig_open(&r, &w, &c, fake_vec(-FLUSH, 0, 20));
            r.input.move = fake_vec(push, 1 - push, 0);
            player_begin(&p, &r, rig_rates[i]);
            player_until(&p, T);
            assert_near(r.state.position.z, push ? 20 - gain - 2 * (T - gain) : 20 - G * T * T / 2, 1e-6);
            assert_near(r.state.velocity.z, push ? -2 : -G * T, 1e-9);
            assert_near(r.state.position.x, -FLUSH, 1e-8);
            rig_close(&r);
        }
    }
}

static void fall_that_meets_a_wall_is_slowed_there_at_once(void **unused)
{
    const double T = 0.5;
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        double meets = 0.25;
        wall_world(&w);
        c.air_control = 0;
        rig_open(&r, &w, &c, fake_vec(-FLUSH - 4 * meets, 0, 20));
        r.state.velocity = fake_vec(4, 0, -3);
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, rig_rates[i]);
        player_until(&p, T);
        assert_int_equal(p.seen[TAHR_EVENT_HIT], 1);
        assert_near(p.when[TAHR_EVENT_HIT], meets, 1e-8);
        assert_near(r.state.position.z, 20 - 3 * meets - G * meets * meets / 2 - 2 * (T - meets), 1e-6);
        rig_close(&r);
    }
}

static void wall_jump_leads_away_and_as_high_as_any_other(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        wall_world(&w);
        rig_open(&r, &w, &c, fake_vec(-FLUSH, 0, 20));
        r.state.velocity = fake_vec(0, 1, 0); /* along the wall: kept */
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, rig_rates[i]);
        player_until(&p, 0.3);
        r.input.move = fake_vec(0, 0, 0);
        double z = r.state.position.z, x = r.state.position.x;
        player_press(&p, 1);
        assert_true(p.seen[TAHR_EVENT_WALL_JUMPED] == 1 && p.seen[TAHR_EVENT_JUMPED] == 0);
        assert_true(p.last[TAHR_EVENT_WALL_JUMPED].value == 5 && p.last[TAHR_EVENT_WALL_JUMPED].normal.x == -1);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, z + height(), 1e-9);
        assert_near(p.last[TAHR_EVENT_APEX].position.x, x - 5 * V / G, 1e-8);
        assert_near(r.state.velocity.x, -5, 1e-9);
        assert_near(r.state.velocity.y, 1, 1e-9);
        rig_close(&r);
    }
}

/* Back to the wall at once, and the button hammered: gb-studio#2019 and #2078 climbed for ever that way. */
static void one_wall_is_never_climbed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        c.coyote_time = c.wall_coyote_time = c.jump_buffer = 0.15;
        c.wall_jump_speed = 1;
        c.air_control = 1;
        wall_world(&w);
        rig_stand(&r, &w, &c, fake_vec(-1, 0, 1));
        double z = r.state.position.z;
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, rig_rates[i]);
        for (int k = 0; k < 60; k++) {
            player_press(&p, 0.1 * k + 0.05);
            player_release(&p, 0.1 * k + 0.1);
        }
        assert_true(p.seen[TAHR_EVENT_WALL_JUMPED] >= 2); /* the ground gives it back */
        assert_true(p.top <= z + 2 * height() + 1e-9);
        rig_close(&r);
    }
}

static void ground_gives_the_wall_back_and_walls_that_face_each_other_are_climbed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        wall_world(&w);
        fake_add_plane(&w, fake_vec(1, 0, 0), -2); /* 2 m apart */
        c.jump_buffer = 0.01;
        rig_stand(&r, &w, &c, fake_vec(-FLUSH, 0, 1));
        player_begin(&p, &r, rig_rates[i]);
        double way = (2 - 2 * FLUSH) / 5, side = -1; /* s from wall to wall, while it still rises */
        player_press(&p, 0.05);
        r.input.move = fake_vec(1, 0, 0);
        player_release(&p, 0.1);
        r.input.move = fake_vec(0, 0, 0);
        double z = r.state.position.z;
        for (int k = 0; k < 10; k++) {
            double t = p.time;
            player_press(&p, t + 0.1);
            assert_near(r.state.velocity.x, 5 * side, 1e-9);
            player_release(&p, t + way + 1e-5);
            side = -side;
        }
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], 10);
        assert_near(r.state.position.z, z + 10 * (V * (way + 1e-5) - G * (way + 1e-5) * (way + 1e-5) / 2), 1e-6);
        rig_close(&r);
    }
}

static void press_before_the_wall_jumps_where_it_is_met(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        double meets = 0.4;
        c.jump_buffer = 0.1;
        wall_world(&w);
        rig_open(&r, &w, &c, fake_vec(-FLUSH - 4 * meets, 0, 20));
        r.state.velocity = fake_vec(4, 0, 0);
        player_begin(&p, &r, rig_rates[i]);
        player_until(&p, meets - 0.09);
        player_press(&p, meets + 0.5);
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], 1);
        assert_near(p.when[TAHR_EVENT_WALL_JUMPED], meets, 1e-8);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, 20 - G * meets * meets / 2 + height(), 1e-7);
        rig_close(&r);
    }
}

/* godot#76756: without input a wall that is touched stays touched. */
static void contact_stays_without_input(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = wall_config();
    (void)unused;
    wall_world(&w);
    rig_open(&r, &w, &c, fake_vec(-FLUSH, 0, 50));
    r.input.move = fake_vec(1, 0, 0);
    player_begin(&p, &r, 60);
    player_until(&p, 0.1);
    r.input.move = fake_vec(0, 0, 0);
    for (int k = 0; k < 60; k++) {
        player_until(&p, 0.1 + (k + 1) / 60.0);
        assert_true(r.state.flags & TAHR_STATE_WALL_TOUCHED);
        assert_true(r.state.wall_normal.x == -1 && r.state.wall_body == 1);
        assert_int_equal(r.report.contact_queries, 1);
    }
    assert_near(r.state.velocity.z, -0.1 * G - G, 1e-9);
    player_press(&p, 1.2);
    assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], 1);
    rig_close(&r);
}

/* From rest at the wall, half a skin is covered by an acceleration of a quarter of 20.48 in sqrt(skin / a). */
static void wall_coyote_counts_from_where_the_wall_was_left(void **unused)
{
    const double leaves = 0.2 + sqrt(0.01 / (20.48 * 0.25));
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int late = 0; late <= 1; late++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = wall_config();
            c.wall_coyote_time = 0.2;
            wall_world(&w);
            rig_open(&r, &w, &c, fake_vec(-FLUSH, 0, 50));
            player_begin(&p, &r, rig_rates[i]);
            r.input.move = fake_vec(1, 0, 0);
            player_until(&p, 0.2);
            r.input.move = fake_vec(-1, 0, 0);
            player_until(&p, leaves + 0.15);
            assert_near(r.state.wall_left, 0.05, 1e-6);
            assert_false(r.state.flags & TAHR_STATE_WALL_TOUCHED);
            player_until(&p, leaves + 0.2 + (late ? 1e-5 : -1e-5));
            double z = r.state.position.z;
            player_press(&p, leaves + 1);
            assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], late ? 0 : 1);
            if (!late) {
                assert_near(p.last[TAHR_EVENT_APEX].position.z, z + height(), 1e-9);
            }
            rig_close(&r);
        }
    }
}

/* A wall that ends above: a box character is past it where the line between the edges leans by 15 degrees. */
static void wall_coyote_counts_from_where_the_wall_ended(void **unused)
{
    const double ends = sqrt(2 * (2 + 0.01 * tan(acos(-1.0) / 12)) / G);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        c.shape = (tahr_shape){TAHR_SHAPE_BOX, 0, 0, 0.9, 0.35, 0.35};
        c.wall_slide_speed = 0;
        c.wall_coyote_time = 1;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(0, -5, 10), fake_vec(5, 5, 30));
        rig_open(&r, &w, &c, fake_vec(-FLUSH, 0, 12 - 0.9)); /* the head 2 m above the end */
        r.input.move = fake_vec(0.06, 0, 0);
        player_begin(&p, &r, rig_rates[i]);
        player_until(&p, 1e-4);
        r.input.move = fake_vec(0, 0, 0);
        player_until(&p, 1);
        assert_near(r.state.wall_left, ends, 1e-6);
        rig_close(&r);
    }
}

static void what_leans_more_than_fifteen_degrees_is_no_wall(void **unused)
{
    (void)unused;
    for (int lean = -16; lean <= 16; lean += 2) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        double a = lean * acos(-1.0) / 180;
        fake_world_init(&w);
        fake_add_plane(&w, fake_vec(-cos(a), 0, sin(a)), 0);
        rig_open(&r, &w, &c, fake_vec(-1.2, 0, 0));
        r.input.move = fake_vec(1, 0, 0);
        r.state.velocity = fake_vec(3, 0, 0);
        player_begin(&p, &r, 60);
        player_await(&p, TAHR_EVENT_HIT);
        player_press(&p, p.time + 0.1);
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], abs(lean) <= 15);
        rig_close(&r);
    }
}

/* Walls that meet at an angle: within 30 degrees they are one. */
static void walls_that_face_alike_are_one_wall(void **unused)
{
    (void)unused;
    for (int turn = 20; turn <= 40; turn += 20) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = wall_config();
        double a = turn * acos(-1.0) / 180;
        c.wall_jump_speed = 3;
        c.air_control = 1;
        fake_world_init(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), 0);
        fake_add_plane(&w, fake_vec(-cos(a), -sin(a), 0), 0);
        rig_open(&r, &w, &c, fake_vec(-FLUSH, -4, 50));
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, 60);
        player_until(&p, 0.1);
        player_press(&p, 0.2);
        r.input.move = fake_vec(0.5, 0.8, 0);
        player_release(&p, 3); /* along to the other wall */
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], 1);
        assert_true(r.state.flags & TAHR_STATE_WALL_TOUCHED);
        assert_int_equal((r.state.flags & TAHR_STATE_WALL_SPENT) != 0, turn == 20);
        player_press(&p, 3.1);
        assert_int_equal(p.seen[TAHR_EVENT_WALL_JUMPED], turn == 20 ? 1 : 2);
        rig_close(&r);
    }
}

/* The script of a jump, a jump off the wall, one off the wall across, and what follows, in a world turned by q. */
static tahr_state play_turned(tahr_quat q)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = wall_config();
    c.jump_buffer = c.wall_coyote_time = 0.1;
    c.fall_gravity = 1.5;
    c.ledge_grab = 0.3;
    c.corner_correction = 0.1;
    c.gravity = fake_turn(q, c.gravity);
    wall_world(&w);
    fake_add_plane(&w, fake_vec(1, 0, 0), -2);
    w.frame = q;
    rig_open(&r, &w, &c, fake_turn(q, fake_vec(-FLUSH, 0, 2)));
    player_begin(&p, &r, 60);
    player_until(&p, 1);
    r.input.move = fake_turn(q, fake_vec(1, 0.2, 0));
    for (int i = 0; i < 4; i++) {
        player_press(&p, p.time + 0.1);
        player_release(&p, p.time + 0.25);
    }
    assert_true(p.seen[TAHR_EVENT_WALL_JUMPED] >= 2 && p.seen[TAHR_EVENT_JUMPED] == 1);
    rig_close(&r);
    return r.state;
}

static void all_turns_with_gravity(void **unused)
{
    const tahr_quat turns[] = {{0.5, 0.5, 0.5, 0.5}, {1, 0, 0, 0}, {0.6, 0, 0, 0.8}, {0.48, 0.36, 0, 0.8}};
    tahr_state truth = play_turned((tahr_quat){0, 0, 0, 1});
    (void)unused;
    for (int i = 0; i < 4; i++) {
        tahr_state s = play_turned(turns[i]);
        tahr_vec3 at = fake_turn_back(turns[i], s.position), n = fake_turn_back(turns[i], s.wall_normal);
        assert_near(at.x, truth.position.x, 1e-7);
        assert_near(at.y, truth.position.y, 1e-7);
        assert_near(at.z, truth.position.z, 1e-7);
        assert_near(n.x, truth.wall_normal.x, 1e-9);
        assert_int_equal(s.flags, truth.flags);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slide_is_no_faster_than_asked_while_pushing),
        cmocka_unit_test(fall_that_meets_a_wall_is_slowed_there_at_once),
        cmocka_unit_test(wall_jump_leads_away_and_as_high_as_any_other),
        cmocka_unit_test(one_wall_is_never_climbed),
        cmocka_unit_test(ground_gives_the_wall_back_and_walls_that_face_each_other_are_climbed),
        cmocka_unit_test(press_before_the_wall_jumps_where_it_is_met),
        cmocka_unit_test(contact_stays_without_input),
        cmocka_unit_test(wall_coyote_counts_from_where_the_wall_was_left),
        cmocka_unit_test(wall_coyote_counts_from_where_the_wall_ended),
        cmocka_unit_test(what_leans_more_than_fifteen_degrees_is_no_wall),
        cmocka_unit_test(walls_that_face_alike_are_one_wall),
        cmocka_unit_test(all_turns_with_gravity)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_hanging.c: hanging on edges, letting go and climbing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "player.h"

static const double G = 9.81, V = 4.2, FLUSH = 0.36, EDGE = 10;

/* The ground z = 0 and a block 10 m high whose face looks toward -x at x = 0. */
static fake_solid *block(fake_world *w)
{
    fake_world_flat(w);
    return fake_add_box(w, fake_vec(0, -5, 0), fake_vec(6, 5, EDGE));
}

static tahr_config hang_config(void)
{
    tahr_config c = rig_config();
    c.ledge_grab = 0.3;
    return c;
}

/* Falls along the block, pushing into it, with its head `over` m above the edge and `speed` m/s down. */
static void fall_past(rig *r, fake_world *w, player *p, const tahr_config *c, double rate, double over, double speed)
{
    rig_open(r, w, c, fake_vec(-FLUSH, 0, EDGE - 0.9 + over));
    r->state.velocity = fake_vec(0, 0, -speed);
    r->input.move = fake_vec(1, 0, 0);
    player_begin(p, r, rate);
}

static void assert_hangs(const rig *r)
{
    assert_int_equal(r->state.mode, TAHR_MODE_HANGING);
    assert_near(r->state.position.x, -FLUSH, 1e-8);
    assert_near(r->state.position.z, EDGE - 0.9, 1e-8);
    assert_true(r->state.velocity.x == 0 && r->state.velocity.y == 0 && r->state.velocity.z == 0);
}

static void hangs_where_and_when_the_head_passes_the_edge(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int fast = 0; fast <= 1; fast++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = hang_config();
            double over = 1.2, speed = fast ? 30 : 0; /* 3 m in a step at 10 Hz: past the edge and its reach */
            double truth = (sqrt(speed * speed + 2 * G * over) - speed) / G;
            block(&w);
            fall_past(&r, &w, &p, &c, rig_rates[i], over, speed);
            player_await(&p, TAHR_EVENT_GRABBED);
            assert_near(p.when[TAHR_EVENT_GRABBED], truth, 1e-8);
            assert_int_equal(p.last[TAHR_EVENT_GRABBED].body, 1);
            assert_near(p.last[TAHR_EVENT_GRABBED].position.z, EDGE - 0.9, 1e-8);
            player_until(&p, p.time + 1);
            assert_hangs(&r);
            assert_near(r.state.floor.point.z, EDGE, 1e-9);
            assert_true(r.state.floor.normal.x == -1 && r.state.wall_normal.x == -1);
            assert_int_equal(r.state.wall_body, 1);
            rig_close(&r);
        }
    }
}

/* Without air control nothing presses it to the wall: what hangs is flush all the same. */
static void hangs_flush_though_it_fell_a_little_off_the_wall(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = hang_config();
        c.air_control = 0;
        block(&w);
        fall_past(&r, &w, &p, &c, rig_rates[i], 1.2, 0);
        r.state.velocity.x = 1;
        player_until(&p, 0.01);
        assert_int_equal(p.seen[TAHR_EVENT_HIT], 1);
        r.state.position.x -= 0.004; /* less than half a skin */
        player_until(&p, 1);
        assert_hangs(&r);
        assert_near(p.when[TAHR_EVENT_GRABBED], sqrt(2 * 1.2 / G), 1e-8);
        rig_close(&r);
    }
}

static void edge_above_the_head_is_grabbed_within_reach_only(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int far = 0; far <= 1; far++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = hang_config();
            block(&w);
            fall_past(&r, &w, &p, &c, rig_rates[i], far ? -0.302 : -0.29, 1);
            player_until(&p, 0.5);
            if (far) {
                assert_true(p.seen[TAHR_EVENT_GRABBED] == 0 && r.state.mode == TAHR_MODE_FALLING);
            } else {
                assert_hangs(&r);
                assert_true(p.when[TAHR_EVENT_GRABBED] < 1e-6);
            }
            rig_close(&r);
        }
    }
}

static void rise_does_not_grab_but_its_apex_does(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int high = 0; high <= 1; high++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = hang_config();
            double top = high ? 0.5 : -0.1; /* of the head over the edge, at the apex */
            block(&w);
            fall_past(&r, &w, &p, &c, rig_rates[i], top - V * V / (2 * G), -V);
            player_await(&p, TAHR_EVENT_GRABBED);
            assert_near(p.when[TAHR_EVENT_GRABBED], V / G + (high ? sqrt(2 * 0.5 / G) : 0), 1e-7);
            assert_hangs(&r);
            rig_close(&r);
        }
    }
}

static void who_does_not_push_does_not_grab(void **unused)
{
    (void)unused;
    for (int crouch = 0; crouch <= 1; crouch++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = hang_config();
        block(&w);
        fall_past(&r, &w, &p, &c, 60, 1, 0);
        r.input.move = fake_vec(crouch, 1 - crouch, 0);
        r.input.crouch = (uint32_t)crouch;
        player_await(&p, TAHR_EVENT_LANDED);
        assert_int_equal(p.seen[TAHR_EVENT_GRABBED], 0);
        rig_close(&r);
    }
}

static void top_that_cannot_be_stood_on_is_no_edge(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = hang_config();
    (void)unused;
    block(&w)->walkable_rule = TAHR_WALKABLE_NEVER;
    fall_past(&r, &w, &p, &c, 60, 1, 0);
    player_await(&p, TAHR_EVENT_LANDED);
    assert_int_equal(p.seen[TAHR_EVENT_GRABBED], 0);
    rig_close(&r);
}

/* Let go, it falls past the reach of the same edge; only then, jumping up again, it may grab it. */
static void edge_let_go_is_not_grabbed_before_it_is_out_of_reach(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int late = 0; late <= 1; late++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = hang_config();
            double falls = sqrt(2 * 0.3 / G), t = 1 + falls + (late ? 0.02 : -0.02);
            c.air_jumps = 1;
            block(&w);
            fall_past(&r, &w, &p, &c, rig_rates[i], 0.2, 0);
            player_until(&p, 1);
            assert_hangs(&r);
            r.input.crouch = 1;
            player_until(&p, 1 + 1 / rig_rates[i]); /* one step: longer, and it would crouch, its head below the
                                                     * reach */
            assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
            r.input.crouch = 0;
            player_until(&p, t);
            player_press(&p, t + 1.5);
            assert_int_equal(p.seen[TAHR_EVENT_GRABBED], late ? 2 : 1);
            rig_close(&r);
        }
    }
}

static void moving_away_lets_go(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = hang_config();
    (void)unused;
    block(&w);
    fall_past(&r, &w, &p, &c, 60, 0.2, 0);
    player_until(&p, 1);
    r.input.move = fake_vec(0, 0, 0);
    player_until(&p, 2);
    assert_hangs(&r);
    r.input.move = fake_vec(-1, 0, 0);
    player_until(&p, 2.5);
    assert_near(r.state.position.z, EDGE - 0.9 - G * 0.25 / 2, 1e-8);
    assert_true(r.state.velocity.x < -2);
    rig_close(&r);
}

static void jump_climbs_and_stands_on_the_top(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = hang_config();
        block(&w);
        fall_past(&r, &w, &p, &c, rig_rates[i], 0.2, 0);
        player_until(&p, 1);
        r.input.move = fake_vec(0, 0, 0);
        r.input.jump = 1;
        rig_step(&r, 1 / rig_rates[i]);
        const tahr_event *e = rig_event(&r, TAHR_EVENT_STEPPED_UP);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.position.x, 0.6 * 0.35, 1e-8); /* half the width behind the place it looked at */
        assert_true(r.state.position.z >= EDGE + 0.91 - 1e-8 && r.state.position.z <= EDGE + 0.915 + 1e-8);
        assert_true(e && rig_event(&r, TAHR_EVENT_JUMPED) == NULL);
        assert_near(e->value, 1.8 + 0.01, 0.0051);
        assert_near(r.report.step_offset, r.state.position.z - (EDGE - 0.9), 1e-9);
        assert_int_equal(r.state.floor.body, 1);
        rig_settle(&r);
        rig_close(&r);
    }
}

/* A shelf 1 m over the top leaves no room to stand. */
static void jump_goes_straight_up_where_there_is_no_room(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = hang_config();
    (void)unused;
    block(&w);
    fake_add_box(&w, fake_vec(0, -5, EDGE + 1), fake_vec(6, 5, EDGE + 20));
    fall_past(&r, &w, &p, &c, 60, 0.2, 0);
    player_until(&p, 1);
    assert_hangs(&r);
    r.input.move = fake_vec(0, 0, 0);
    player_press(&p, 1.5);
    assert_int_equal(p.seen[TAHR_EVENT_JUMPED], 1);
    assert_near(p.last[TAHR_EVENT_APEX].position.z, EDGE - 0.9 + V * V / (2 * G), 1e-8);
    rig_close(&r);
}

static void hanging_repeats_bit_for_bit_and_asks_nothing(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = hang_config();
    (void)unused;
    block(&w);
    fall_past(&r, &w, &p, &c, 60, 0.2, 0);
    player_until(&p, 1);
    tahr_state before = r.state;
    rig_step(&r, 1.0 / 60);
    assert_memory_equal(&before, &r.state, sizeof before);
    assert_true(r.report.sweeps + r.report.contact_queries + r.report.rays == 0 && r.report.event_count == 0);
    rig_close(&r);
}

/* The block rises or sinks by 0.2 m, comes nearer or goes away by 0.1, or is gone. */
static void edge_that_moves_is_followed_and_one_that_goes_is_let_go(void **unused)
{
    const double up[] = {0.2, -0.2, 0, 0, -3}, aside[] = {0, 0, -0.1, 0.1, 0};
    (void)unused;
    for (int i = 0; i < 5; i++) {
        tahr_body_desc bodies[2];
        rig r;
        player p;
        tahr_config c = hang_config();
        memset(bodies, 0, sizeof bodies);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(tahr_body_desc_init(&bodies[k], sizeof bodies[k], TAHR_BODY_BOX), TAHR_OK);
        }
        bodies[0].half_extents = fake_vec(20, 20, 0.5);
        bodies[0].pose.position = fake_vec(0, 0, -0.5);
        bodies[1].half_extents = fake_vec(3, 5, 2);
        bodies[1].pose.position = fake_vec(3, 0, EDGE - 2);
        bodies[1].flags = TAHR_BODY_MOVABLE;
        rig_open_bodies(&r, bodies, 2, &c, fake_vec(-FLUSH, 0, EDGE - 0.7));
        r.input.move = fake_vec(1, 0, 0);
        player_begin(&p, &r, 60);
        player_until(&p, 1);
        assert_int_equal(r.state.mode, TAHR_MODE_HANGING);
        tahr_body_pose place = {.body = 1, .pose = bodies[1].pose};
        place.pose.position.x += aside[i];
        place.pose.position.z += up[i];
        assert_int_equal(tahr_world_set(r.world, &place, 1), TAHR_OK);
        r.input.move = fake_vec(0, 0, 0);
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.state.mode, i < 4 ? TAHR_MODE_HANGING : TAHR_MODE_FALLING);
        if (i < 4) {
            assert_near(r.state.position.x, aside[i] - FLUSH, 1e-9);
            assert_near(r.state.position.z, EDGE - 0.9 + up[i], 1e-9);
        }
        rig_close(&r);
    }
}

static void mode_set_where_there_is_no_edge_falls(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = hang_config();
    (void)unused;
    for (int on = 0; on <= 1; on++) {
        fake_world_flat(&w);
        c.ledge_grab = on ? 0.3 : 0;
        rig_open(&r, &w, &c, fake_vec(0, 0, 5));
        r.state.mode = TAHR_MODE_HANGING;
        r.input.jump = (uint32_t)on;
        rig_step(&r, 0.1);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(hangs_where_and_when_the_head_passes_the_edge),
                                       cmocka_unit_test(hangs_flush_though_it_fell_a_little_off_the_wall),
                                       cmocka_unit_test(edge_above_the_head_is_grabbed_within_reach_only),
                                       cmocka_unit_test(rise_does_not_grab_but_its_apex_does),
                                       cmocka_unit_test(who_does_not_push_does_not_grab),
                                       cmocka_unit_test(top_that_cannot_be_stood_on_is_no_edge),
                                       cmocka_unit_test(edge_let_go_is_not_grabbed_before_it_is_out_of_reach),
                                       cmocka_unit_test(moving_away_lets_go),
                                       cmocka_unit_test(jump_climbs_and_stands_on_the_top),
                                       cmocka_unit_test(jump_goes_straight_up_where_there_is_no_room),
                                       cmocka_unit_test(hanging_repeats_bit_for_bit_and_asks_nothing),
                                       cmocka_unit_test(edge_that_moves_is_followed_and_one_that_goes_is_let_go),
                                       cmocka_unit_test(mode_set_where_there_is_no_edge_falls)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

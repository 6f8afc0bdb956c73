/* SPDX-License-Identifier: MIT
 * test_path.c: the path of one long step: what happens on it carries its time, and what is dropped of it is
 * reported. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

/* At full speed slantwise into a wall, along it, and up a step: one long step. */
static void a_step_after_a_wall_carries_its_own_time(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(-50, 1, -1), fake_vec(50, 3, 5));
    fake_add_box(&w, fake_vec(2, -50, -1), fake_vec(12, 50, 0.3));
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 0.9125));
    r.input.move = fake_vec(0.8, 0.6, 0);
    r.state.velocity = fake_vec(4.8, 3.6, 0);
    /* The foot's lower cap, its centre a radius over the foot, meets the edge with the skin between them. */
    double over = r.state.position.z - 0.9 + r.config.shape.radius - 0.3, reach = sqrt(0.36 * 0.36 - over * over);
    rig_step(&r, 0.5);
    const tahr_event *hit = rig_event(&r, TAHR_EVENT_HIT), *up = rig_event(&r, TAHR_EVENT_STEPPED_UP);
    rig_assert_in_order(&r, 0.5);
    assert_true(hit && up && hit < up);
    assert_near(hit->time, (1 - 0.36) / 3.6, 1e-9);
    assert_near(hit->position.x, 4.8 * hit->time, 1e-9);
    assert_near(hit->value, 3.6, 1e-9);
    assert_true(up->time >= (2 - reach) / 4.8 - 1e-9); /* met, and up within half a foot of it */
    assert_true(up->time <= (2 - reach + 0.5 * r.config.shape.radius) / 4.8 + 1e-9);
    assert_near(up->value, 0.3, 1e-6);
    assert_near(r.state.position.x, 4.8 * 0.5, 1e-6); /* along the wall at the wish's part along it, the step too */
    assert_near(r.report.time_lost, 0, 0);
    rig_close(&r);
}

/* Braking from 6 m/s, 5 cm before a wall that is met slantwise: what is left of the speed brakes along it. */
static void a_stop_after_a_wall_carries_its_own_time(void **unused)
{
    const double drag = 16, brake = 20.48; /* the preset's */
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(-50, 1, -1), fake_vec(50, 3, 5));
    rig_stand(&r, &w, NULL, fake_vec(0, 1 - 0.36 - 0.05, 0.9125));
    r.state.velocity = fake_vec(4.8, 3.6, 0);
    rig_step(&r, 0.5);
    rig_assert_in_order(&r, 0.5);
    const tahr_event *hit = rig_event(&r, TAHR_EVENT_HIT), *stop = rig_event(&r, TAHR_EVENT_STOPPED);
    assert_true(hit && stop && hit < stop);
    double left = 0.8 * ((6 + brake / drag) * exp(-drag * hit->time) - brake / drag);
    assert_near(stop->time, hit->time + log1p(drag * left / brake) / drag, 1e-9);
    rig_close(&r);
}

static void steps_of_one_long_step_come_at_their_times(void **unused)
{
    const double dts[] = {0.5, 1.0 / 3, 0.25, 0.1};
    fake_world w;
    (void)unused;
    fake_world_flat(&w);
    for (int i = 0; i < 6; i++) {
        fake_add_box(&w, fake_vec(2 + 0.6 * i, -5, -1), fake_vec(50, 5, 0.2 * (i + 1)));
    }
    for (int k = 0; k < 4; k++) {
        rig r;
        uint32_t steps = 0;
        double last = -1;
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 0.9125));
        r.input.move = fake_vec(1, 0, 0);
        r.state.velocity = fake_vec(6, 0, 0);
        for (int i = 0; i < 100 && r.state.position.x < 7; i++) {
            double begin = r.time, from = r.state.position.x;
            rig_step(&r, dts[k]);
            rig_assert_in_order(&r, dts[k]);
            for (uint32_t n = 0; n < r.report.event_count; n++) {
                const tahr_event *e = &r.events[n];
                if (e->type == TAHR_EVENT_STEPPED_UP) {
                    assert_true(begin + e->time > last + 1e-3);
                    last = begin + e->time;
                    steps++;
                    /* A step changes the height and no velocity: the way tells the time, within half a foot. */
                    assert_near(e->time, (e->position.x - from) / 6, 0.175 / 6 + 1e-9);
                }
            }
        }
        assert_int_equal(steps, 6);
        rig_close(&r);
    }
}

/* One sweep, spent on the way to the wall: what was left of the step after it is said to be lost. */
static void motion_dropped_at_the_cap_of_slides_is_reported_as_time(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(-50, 1, -1), fake_vec(50, 3, 5));
    c.max_slides = 1;
    rig_stand(&r, &w, &c, fake_vec(0, 0, 0.9125));
    r.input.move = fake_vec(0.8, 0.6, 0);
    r.state.velocity = fake_vec(4.8, 3.6, 0);
    rig_step(&r, 0.5);
    assert_near(r.state.position.y, 1 - 0.36, 1e-9);
    assert_near(r.report.time_lost, 0.5 - (1 - 0.36) / 3.6, 1e-9);
    assert_int_equal(r.report.flags, TAHR_REPORT_TIME_LOST);
    assert_near(r.state.position.x, 4.8 * (0.5 - r.report.time_lost), 1e-9);
    rig_close(&r);
}

/* Along stairs at 6 m/s, which a step changes nothing of: the way that is missing and the time that is said to be lost
 * are one thing. Returns the time lost. */
static double walk_stairs(fake_world *w, double from, double height, double dt)
{
    rig r;
    double lost = 0;
    rig_stand(&r, w, NULL, fake_vec(from, 0, height + 0.9125));
    r.time = 0;
    r.input.move = fake_vec(1, 0, 0);
    r.state.velocity = fake_vec(6, 0, 0);
    for (int i = 0; i < (int)(1 / dt + 0.5); i++) {
        rig_step(&r, dt);
        lost += r.report.time_lost;
        assert_true(r.report.time_lost >= 0 && r.report.time_lost < dt);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    }
    assert_near(r.state.position.x, from + 6 * (r.time - lost), 1e-6);
    rig_close(&r);
    return lost;
}

static void time_that_a_long_step_loses_on_stairs_up_is_reported(void **unused)
{
    const double dts[] = {0.8, 0.5, 0.3, 0.2, 0.1, 1.0 / 60};
    fake_world w;
    (void)unused;
    fake_world_flat(&w);
    for (int i = 0; i < 14; i++) {
        fake_add_box(&w, fake_vec(1 + 0.3 * i, -5, -1), fake_vec(60, 5, 0.3 * (i + 1)));
    }
    assert_true(walk_stairs(&w, -2, 0, 1) > 0.1);
    for (int i = 0; i < 6; i++) {
        double lost = walk_stairs(&w, -2, 0, dts[i]);
        assert_true(i < 4 || lost == 0);
    }
}

static void time_that_a_long_step_loses_on_stairs_down_is_reported(void **unused)
{
    const double dts[] = {1, 0.8, 0.5, 0.3, 0.2, 0.1, 1.0 / 60};
    fake_world w;
    (void)unused;
    fake_world_flat(&w);
    for (int i = 0; i < 14; i++) {
        fake_add_box(&w, fake_vec(-60, -5, -1), fake_vec(1 - 0.3 * i, 5, 0.3 * (i + 1)));
    }
    for (int i = 0; i < 7; i++) {
        double lost = walk_stairs(&w, -6, 4.2, dts[i]);
        assert_true(i < 5 || lost == 0);
    }
}

/* The last slide of the walk ends at a wall with nothing below: the rest of the step is fallen through, as it is with
 * more slides to spare, and nothing is lost. */
static void time_that_falling_takes_over_is_not_lost(void **unused)
{
    fake_world w;
    rig r[2];
    (void)unused;
    fake_world_init(&w);
    fake_add_box(&w, fake_vec(-60, -50, -1), fake_vec(0, 50, 0));
    fake_add_box(&w, fake_vec(1, -50, -100), fake_vec(2, 50, 10));
    for (int i = 0; i < 2; i++) {
        tahr_config c = rig_config();
        c.max_slides = i == 0 ? 8 : 2;
        rig_stand(&r[i], &w, &c, fake_vec(-0.5, 0, 0.9125));
        r[i].input.move = fake_vec(0.8, 0.6, 0);
        r[i].state.velocity = fake_vec(4.8, 3.6, 0);
        rig_step(&r[i], 0.4);
        assert_int_equal(r[i].state.mode, TAHR_MODE_FALLING);
        assert_near(r[i].state.position.y, r[0].state.position.y, 1e-5);
        assert_near(r[i].state.position.z, r[0].state.position.z, 1e-5);
        assert_near(r[i].report.time_lost, 0, 0);
    }
    rig_close(&r[0]);
    rig_close(&r[1]);
}

/* Two seconds along a gutter into a wall that leans over it and is turned by yaw: either side of the gutter carries,
 * the one that rises more for the way it goes. Returns the time lost. */
static double walk_gutter(double yaw, double way, double dt)
{
    const double lean = 0.5, side = 0.5;
    double lost = 0;
    fake_world w;
    rig r;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(0, sin(side), cos(side)), 0);
    fake_add_plane(&w, fake_vec(0, -sin(side), cos(side)), 0);
    fake_add_plane(&w, fake_vec(-cos(lean) * cos(yaw), -cos(lean) * sin(yaw), -sin(lean)), -2.5);
    rig_stand(&r, &w, NULL, fake_vec(-2, 0.05, 1.2));
    r.input.move = fake_vec(cos(way), sin(way), 0);
    for (int k = 0; k < (int)(2 / dt); k++) {
        rig_step(&r, dt);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-6);
        lost += r.report.time_lost;
    }
    rig_close(&r);
    return lost;
}

/* Never entered, and at 10 Hz in three directions out of four no time is lost: with one wall only, for the side that
 * comes first, the slides of a long step are used up in every third. */
static void a_wall_that_leans_over_a_gutter_is_slid_along(void **unused)
{
    const double dts[] = {0.1, 1.0 / 30, 1.0 / 60, 1.0 / 144};
    int runs = 0, whole = 0;
    (void)unused;
    for (int i = 0; i < 4; i++) {
        for (int yaw = -6; yaw <= 6; yaw++) {
            for (int way = -4; way <= 4; way++) {
                double lost = walk_gutter(0.2 * yaw, 0.25 * way, dts[i]);
                runs += i == 0;
                whole += i == 0 && lost == 0;
            }
        }
    }
    assert_true(4 * whole >= 3 * runs);
}

/* A plateau that ends at x = 0, and over the void beyond it a wall at x = 1 that bends the way: the floor ends before
 * the wall is met, at the perch radius and the skin over the edge. */
static void a_floor_that_ends_before_a_bend_is_left_where_it_ends(void **unused)
{
    const double dts[] = {0.4, 0.3, 0.1, 1.0 / 60};
    fake_world w;
    (void)unused;
    fake_world_init(&w);
    fake_add_box(&w, fake_vec(-60, -50, -1), fake_vec(0, 50, 0));
    fake_add_box(&w, fake_vec(1, -50, -100), fake_vec(2, 50, 10));
    for (int i = 0; i < 4; i++) {
        rig r;
        const tahr_event *left = NULL;
        rig_stand(&r, &w, NULL, fake_vec(-0.5, 0, 0.9125));
        r.input.move = fake_vec(0.8, 0.6, 0);
        r.state.velocity = fake_vec(4.8, 3.6, 0);
        double time = 0;
        for (; !left && time < 0.45; time += dts[i]) {
            rig_step(&r, dts[i]);
            left = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
            rig_assert_in_order(&r, dts[i]);
        }
        assert_non_null(left);
        assert_near(left->position.x, 0.35 - 0.15 + 0.01, 1e-5);
        assert_near(time - dts[i] + left->time, (0.5 + 0.21) / 4.8, 1e-5);
        rig_close(&r);
    }
}

/* The floor goes on beyond x = 1 as a body of its own, and nobody steps up. What is met of
 * that body at its edge is told as its front, as an engine may whose bodies know nothing of each other. */
typedef struct seam {
    fake_world world;
    uint32_t rule;
} seam;

static tahr_status sweep_seam(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    seam *s = user;
    tahr_status status = fake_sweep(&s->world, query, hit);
    if (status >= 0 && hit->blocking && hit->body == 1 && query->motion.x > 0 && query->motion.z > -1e-3) {
        hit->surface_normal = fake_vec(-1, 0, 0);
        hit->walkable_rule = s->rule;
    }
    return status;
}

/* Runs for half a second against the seam, a skin over the floor. Returns how far it came. */
static double run_over_seam(double height, uint32_t rule, double *lifted)
{
    static seam s;
    rig r;
    tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .user = &s, .sweep = sweep_seam};
    tahr_config c = rig_config();
    s.rule = rule;
    fake_world_flat(&s.world);
    fake_add_box(&s.world, fake_vec(1, -50, -1), fake_vec(50, 50, height));
    c.step_height = 0;
    rig_open_callbacks(&r, &callbacks, &c, fake_vec(0, 0, 0.91));
    rig_steps(&r, 2, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    r.state.position = fake_vec(0, 0, 0.91);
    r.state.velocity = fake_vec(6, 0, 0);
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 30, 1.0 / 60);
    *lifted = r.state.position.z - 0.91;
    double x = r.state.position.x;
    rig_close(&r);
    return x;
}

/* Half a second at 6 m/s is 3 m; who is held stands where the skin meets the edge. */
static void an_edge_as_high_as_the_floor_holds_nobody(void **unused)
{
    static const double RADIUS = 0.36;
    double lifted;
    (void)unused;
    assert_near(run_over_seam(5e-10, 0, &lifted), 3, 1e-6);
    assert_near(lifted, 1e-9, 1e-9);
    assert_near(run_over_seam(5e-10, TAHR_WALKABLE_NEVER, &lifted), 1 - sqrt(2 * RADIUS * 5e-10), 1e-5);
    assert_near(lifted, 0, 1e-9);
    assert_near(run_over_seam(1e-6, 0, &lifted), 1 - sqrt(2 * RADIUS * 1e-6), 1e-5);
    assert_near(lifted, 0, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(an_edge_as_high_as_the_floor_holds_nobody),
                                       cmocka_unit_test(a_floor_that_ends_before_a_bend_is_left_where_it_ends),
                                       cmocka_unit_test(a_step_after_a_wall_carries_its_own_time),
                                       cmocka_unit_test(a_wall_that_leans_over_a_gutter_is_slid_along),
                                       cmocka_unit_test(a_stop_after_a_wall_carries_its_own_time),
                                       cmocka_unit_test(steps_of_one_long_step_come_at_their_times),
                                       cmocka_unit_test(motion_dropped_at_the_cap_of_slides_is_reported_as_time),
                                       cmocka_unit_test(time_that_a_long_step_loses_on_stairs_up_is_reported),
                                       cmocka_unit_test(time_that_a_long_step_loses_on_stairs_down_is_reported),
                                       cmocka_unit_test(time_that_falling_takes_over_is_not_lost)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_step_up.c: steps up and down at every frame rate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static void block(fake_world *w, double height)
{
    fake_world_flat(w);
    fake_add_box(w, fake_vec(2, -5, -1), fake_vec(40, 5, height));
}

static void steps_below_the_limit_are_climbed_and_above_refused(void **unused)
{
    const double heights[] = {0.05, 0.2, 0.399, 0.401, 0.6, 2};
    const double speeds[] = {1, 0.3, 0.05};
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int h = 0; h < 6; h++) {
            for (int s = 0; s < 3; s++) {
                fake_world w;
                rig r;
                block(&w, heights[h]);
                rig_stand(&r, &w, NULL, fake_vec(1.5, 0, 1));
                r.input.move = fake_vec(speeds[s], 0, 0);
                double step = 0;
                for (int k = 0; k < (int)(rig_rates[i] * 2); k++) {
                    tahr_vec3 before = r.state.position;
                    rig_step(&r, 1 / rig_rates[i]);
                    step = r.state.position.x - before.x;
                    assert_true(step <= 6 * speeds[s] / rig_rates[i] * (1 + 1e-9));
                    if (r.state.mode != TAHR_MODE_WALKING) {
                        fail_msg("%g Hz, speed %g, height %g: falls at x %.9g z %.9g", rig_rates[i], speeds[s],
                                 heights[h], r.state.position.x, r.state.position.z);
                    }
                    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
                }
                int climbed = r.state.position.z > 0.9 + heights[h];
                if (climbed != (heights[h] < 0.4)) {
                    fail_msg("%g Hz, speed %g, height %g: at x %g z %g", rig_rates[i], speeds[s], heights[h],
                             r.state.position.x, r.state.position.z);
                }
                rig_close(&r);
            }
        }
    }
}

static void a_step_up_says_so_once_with_its_height(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        int events = 0;
        double offset = 0, value = 0;
        block(&w, 0.3);
        rig_stand(&r, &w, NULL, fake_vec(1, 0, 1));
        double z = r.state.position.z;
        r.input.move = fake_vec(1, 0, 0);
        for (int k = 0; k < (int)rig_rates[i]; k++) {
            rig_step(&r, 1 / rig_rates[i]);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_STEPPED_UP);
            offset += r.report.step_offset;
            if (e) {
                events++;
                value = e->value;
                assert_int_equal(e->body, 1);
            }
        }
        assert_int_equal(events, 1);
        assert_true(value > 0.01 && value < 0.32); /* what that step gained: a round foot rises over several */
        assert_near(offset, r.state.position.z - z, 1e-9);
        assert_near(r.state.velocity.x, 6, 1e-9);
        rig_close(&r);
    }
}

static void stairs(fake_world *w)
{
    fake_world_flat(w);
    for (int k = 0; k < 10; k++) {
        double x = 2 + 0.3 * k, top = 0.3 * (k + 1);
        fake_add_box(w, fake_vec(x, -5, -1), fake_vec(k == 9 ? 30 : x + 0.3, 5, top));
    }
}

/* movement.md section 0: a flight of level length L takes L / speed within 2 %. */
static void a_flight_of_stairs_takes_its_level_length_over_speed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int up = 0; up < 2; up++) {
            fake_world w;
            rig r;
            double dt = 1 / rig_rates[i], enter = -1, leave = -1;
            stairs(&w);
            rig_stand(&r, &w, NULL, up ? fake_vec(-1, 0, 1) : fake_vec(9, 0, 4));
            r.input.move = fake_vec(up ? 4 / 6.0 : -4 / 6.0, 0, 0);
            for (int k = 0; k < (int)(rig_rates[i] * 4) && leave < 0; k++) {
                double before = r.state.position.x;
                rig_step(&r, dt);
                double x = r.state.position.x;
                assert_true(fabs(x - before) <= 4 * dt * (1 + 1e-9));
                if (!up) {
                    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
                }
                double t = k * dt;
                if (enter < 0 && (up ? x >= 1 : x <= 6)) {
                    enter = t + dt * ((up ? 1 : 6) - before) / (x - before);
                }
                if (enter >= 0 && (up ? x >= 6 : x <= 1)) {
                    leave = t + dt * ((up ? 6 : 1) - before) / (x - before);
                }
            }
            if (fabs((leave - enter) / 1.25 - 1) > 0.02) {
                fail_msg("%g Hz %s: %g s instead of 1.25", rig_rates[i], up ? "up" : "down", leave - enter);
            }
            rig_close(&r);
        }
    }
}

/* A step of 0.3 m at x = 2 whose edge is cut off, steeper than can be stood on: its profile, drawn out along y. */
static tahr_body_desc bevelled_step(double width)
{
    static double vertices[30];
    static uint32_t indices[24];
    const double profile[5][2] = {{-9, 0}, {2, 0}, {2, 0.3 - 1.6 * width}, {2 + width, 0.3}, {9, 0.3}};
    tahr_body_desc body;
    for (uint32_t i = 0; i < 10; i++) {
        vertices[3 * i] = profile[i / 2][0];
        vertices[3 * i + 1] = i % 2 ? 5 : -5;
        vertices[3 * i + 2] = profile[i / 2][1];
    }
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t at = 2 * i, quad[6] = {at, at + 2, at + 3, at, at + 3, at + 1};
        memcpy(indices + 6 * i, quad, sizeof quad);
    }
    assert_int_equal(tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH), TAHR_OK);
    body.vertices = vertices, body.vertex_count = 10;
    body.indices = indices, body.triangle_count = 8;
    return body;
}

/* The face that is met and landed on is too steep to stand on; what it leads to is not. At a run: a foot that comes to
 * rest half-way up is refused the rest. */
static void a_bevel_too_steep_to_stand_on_is_climbed_at_a_run(void **unused)
{
    const double widths[] = {0.03, 0.04, 0.05};
    (void)unused;
    for (int i = 0; i < 3; i++) {
        rig r;
        const tahr_body_desc body = bevelled_step(widths[i]);
        rig_open_bodies(&r, &body, 1, NULL, fake_vec(0.5, 0, 0.9125));
        rig_settle(&r);
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, 30, 1.0 / 30);
        assert_true(r.state.position.x > 4);
        assert_near(r.state.position.z, 1.2125, 0.0026);
        rig_close(&r);
    }
}

static void a_low_ceiling_over_the_step_refuses_it(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    block(&w, 0.3);
    fake_add_box(&w, fake_vec(1.9, -5, 2.0), fake_vec(9, 5, 3));
    rig_stand(&r, &w, NULL, fake_vec(1, 0, 1));
    r.input.move = fake_vec(1, 0, 0);
    for (int k = 0; k < 120; k++) {
        rig_step(&r, 1.0 / 60);
        assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
    }
    assert_near(r.state.position.x, 2 - 0.36, 0.02);
    assert_true(r.state.position.z < 0.93);
    const tahr_decision *d = rig_decision(&r, TAHR_RULE_STEP_UP);
    assert_non_null(d);
    assert_int_equal(d->accepted, 0);
    rig_close(&r);
}

static void a_ceiling_just_high_enough_lets_the_step_through(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    block(&w, 0.3);
    fake_add_box(&w, fake_vec(-9, -5, 0.3 + 1.8 + 0.05), fake_vec(9, 5, 3));
    rig_stand(&r, &w, NULL, fake_vec(1, 0, 0.95));
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    assert_true(r.state.position.x > 4);
    rig_close(&r);
}

static void no_step_height_means_no_step(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    (void)unused;
    c.step_height = 0;
    block(&w, 0.3);
    rig_stand(&r, &w, &c, fake_vec(1, 0, 1));
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    double over = r.state.position.z - 0.9 + 0.35 - 0.3; /* the lower cap's centre over the edge */
    assert_near(r.state.position.x, 2 - sqrt(0.36 * 0.36 - over * over), 1e-6);
    rig_close(&r);
}

static void a_refused_tall_wall_costs_one_extra_sweep(void **unused)
{
    fake_world w;
    rig climber, other;
    tahr_config c = rig_config();
    uint32_t met = 0;
    (void)unused;
    c.step_height = 0;
    block(&w, 3);
    rig_stand(&climber, &w, NULL, fake_vec(1, 0, 1));
    rig_stand(&other, &w, &c, fake_vec(1, 0, 1));
    climber.input.move = other.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 60; i++) {
        rig_step(&climber, 1.0 / 60);
        rig_step(&other, 1.0 / 60);
        uint32_t at_wall = climber.state.position.x > 2 - 0.36 - 1e-6;
        assert_int_equal(climber.report.sweeps, other.report.sweeps + at_wall);
        assert_int_equal(climber.report.contact_queries + climber.report.rays, 0);
        assert_true(climber.report.sweeps <= 3);
        assert_near(climber.state.position.x, other.state.position.x, 0);
        met += at_wall;
    }
    assert_true(met > 10);
    rig_close(&climber);
    rig_close(&other);
}

static void stepping_down_is_followed_and_said(void **unused)
{
    fake_world w;
    rig r;
    int downs = 0;
    (void)unused;
    block(&w, 0.35);
    rig_stand(&r, &w, NULL, fake_vec(3, 0, 1.4));
    r.input.move = fake_vec(-1, 0, 0);
    for (int k = 0; k < 60; k++) {
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        const tahr_event *e = rig_event(&r, TAHR_EVENT_STEPPED_DOWN);
        if (e) {
            downs++;
            assert_true(e->value > 0 && e->value < 0.4);
        }
    }
    assert_true(downs >= 1);
    assert_near(r.state.position.z, 0.9125, 0.0026);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(steps_below_the_limit_are_climbed_and_above_refused),
                                       cmocka_unit_test(a_step_up_says_so_once_with_its_height),
                                       cmocka_unit_test(a_flight_of_stairs_takes_its_level_length_over_speed),
                                       cmocka_unit_test(a_bevel_too_steep_to_stand_on_is_climbed_at_a_run),
                                       cmocka_unit_test(a_low_ceiling_over_the_step_refuses_it),
                                       cmocka_unit_test(a_ceiling_just_high_enough_lets_the_step_through),
                                       cmocka_unit_test(no_step_height_means_no_step),
                                       cmocka_unit_test(a_refused_tall_wall_costs_one_extra_sweep),
                                       cmocka_unit_test(stepping_down_is_followed_and_said)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

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

/* A step at x = 2, seen from the side and drawn out along y, whose edge is cut off: `run` wide, `slope` degrees steep.
 * The cut is a body of its own if it is never walkable. */
typedef struct edge {
    double height, slope, run;
    int never;
    double vertices[30];
    uint32_t indices[24];
} edge;

enum { EDGE_POINTS = 5, EDGE_BODIES = 3 };

static uint32_t edge_bodies(edge *e, tahr_body_desc *bodies)
{
    const double low = e->height - e->run * tan(e->slope * 3.14159265358979 / 180);
    const double profile[EDGE_POINTS][2] = {
        {-9, 0}, {2, 0}, {2, low}, {2 + e->run, e->height}, {20, e->height},
    };
    const uint32_t first[EDGE_BODIES + 1] = {0, 2, 3, 4}; /* quads of the floor, of the cut, of the tread */
    uint32_t count = 0;
    for (uint32_t i = 0; i < 2 * EDGE_POINTS; i++) {
        e->vertices[3 * i] = profile[i / 2][0];
        e->vertices[3 * i + 1] = i % 2 ? 25 : -25;
        e->vertices[3 * i + 2] = profile[i / 2][1];
    }
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t at = 2 * i, quad[6] = {at, at + 2, at + 3, at, at + 3, at + 1};
        memcpy(e->indices + 6 * i, quad, sizeof quad);
    }
    for (uint32_t i = 0; i < EDGE_BODIES; i++) {
        tahr_body_desc *body = &bodies[count];
        if (e->never || count == 0) {
            assert_int_equal(tahr_body_desc_init(body, sizeof *body, TAHR_BODY_MESH), TAHR_OK);
            body->vertices = e->vertices, body->vertex_count = 2 * EDGE_POINTS;
            body->indices = e->indices + 6 * first[i];
            body->walkable_rule = i == 1 ? TAHR_WALKABLE_NEVER : TAHR_WALKABLE_DEFAULT;
            count++;
        }
        bodies[count - 1].triangle_count += 2 * (first[i + 1] - first[i]);
    }
    return count;
}

static void open_edge(rig *r, edge *e, double x, double z)
{
    tahr_body_desc bodies[EDGE_BODIES];
    const uint32_t count = edge_bodies(e, bodies);
    rig_open_bodies(r, bodies, count, NULL, fake_vec(x, 0, z + 0.9125));
    rig_settle(r);
}

/* Walks over the edge in the direction of `way` (+1 up, -1 down) and fails where it does otherwise than over a sharp
 * one. */
static void walk_over(edge *e, double speed, double rate, int way)
{
    rig r;
    double x = way > 0 ? 1.2 : 3, begin = x, dt = 1 / rate;
    open_edge(&r, e, x, way > 0 ? 0 : e->height);
    r.input.move = fake_vec(way * speed / 6, 0, 0);
    r.state.velocity = fake_vec(way * speed, 0, 0);
    const int steps = (int)(rate * 1.6 / speed) + 1;
    for (int k = 0; k < steps; k++) {
        rig_step(&r, dt);
        const double gone = way * (r.state.position.x - x);
        if (r.state.mode != TAHR_MODE_WALKING || fabs(gone / (speed * dt) - 1) > 1e-9) {
            fail_msg("%g Hz, %g m/s, %g degrees %g wide, %g high: %s at x %.9g z %.9g, %.3g of the way", rate, speed,
                     e->slope, e->run, e->height, tahr_mode_name(r.state.mode), r.state.position.x, r.state.position.z,
                     gone / (speed * dt));
        }
        x = r.state.position.x;
    }
    assert_near(x, begin + way * steps * speed * dt, 1e-6);
    assert_near(r.state.position.z, 0.9125 + (way > 0 ? e->height : 0), 0.0026);
    rig_close(&r);
}

static void walk_over_at_every_rate(edge *e)
{
    const double speeds[] = {1, 2, 6};
    for (int i = 0; i < RIG_RATES; i++) {
        for (int s = 0; s < 3; s++) {
            walk_over(e, speeds[s], rig_rates[i], 1);
            walk_over(e, speeds[s], rig_rates[i], -1);
        }
    }
}

/* The face that is met and landed on is too steep to stand on; what it leads to is not. */
static void a_bevel_too_steep_to_stand_on_is_walked_over_like_a_sharp_edge(void **unused)
{
    const double slopes[] = {51, 58, 70, 80}, runs[] = {0.005, 0.02, 0.05}, heights[] = {0.3, 0.399};
    (void)unused;
    for (int i = 0; i < 24; i++) {
        edge e = {.height = heights[i % 2], .slope = slopes[i / 2 % 4], .run = runs[i / 8]};
        walk_over_at_every_rate(&e);
    }
}

static void an_edge_that_is_never_walkable_is_walked_over_like_a_sharp_one(void **unused)
{
    const double slopes[] = {20, 45, 58, 80};
    (void)unused;
    for (int i = 0; i < 4; i++) {
        edge e = {.height = 0.3, .slope = slopes[i], .run = 0.02, .never = 1};
        walk_over_at_every_rate(&e);
    }
}

/* No front is harder to climb than a vertical one: a slope is a step if its top is no higher than one. */
static void a_slope_too_steep_to_stand_on_is_a_step_if_it_is_no_higher_than_one(void **unused)
{
    const double slopes[] = {51, 58, 70, 85}, heights[] = {0.39, 0.399, 0.402, 0.41, 0.5};
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int k = 0; k < 20; k++) {
            rig r;
            edge e = {.height = heights[k % 5], .slope = slopes[k / 5]};
            e.run = e.height / tan(e.slope * 3.14159265358979 / 180);
            open_edge(&r, &e, 1, 0);
            r.input.move = fake_vec(k % 3 ? 1 : 0.2, 0, 0);
            rig_steps(&r, (int)(rig_rates[i] * 2), 1 / rig_rates[i]);
            const int up = r.state.position.x > 2.5 && r.state.position.z > e.height + 0.9;
            const int below = r.state.position.x < 2 && r.state.position.z < 0.916;
            if (!(e.height < 0.4 ? up : below)) {
                fail_msg("%g Hz, %g degrees, %g high: at x %.9g z %.9g", rig_rates[i], e.slope, e.height,
                         r.state.position.x, r.state.position.z);
            }
            rig_close(&r);
        }
    }
}

/* The front of a step holds a walker wherever on it the foot is: at rest to the bit, and with the way open on and
 * back. */
static void who_stops_half_way_up_a_bevel_rests_there_and_goes_on(void **unused)
{
    (void)unused;
    for (int k = 0; k < 40; k++) {
        rig r;
        edge e = {.height = 0.3, .slope = 58, .run = 0.05};
        open_edge(&r, &e, 1.5, 0);
        r.input.move = fake_vec(1.0 / 6, 0, 0);
        for (int i = 0; i < 1000 && r.state.position.x < 1.66 + 0.01 * k; i++) {
            rig_step(&r, 1e-3);
        }
        memset(&r.input.move, 0, sizeof r.input.move);
        rig_steps(&r, 300, 1e-3);
        const tahr_vec3 rest = r.state.position;
        for (int i = 0; i < 60; i++) {
            rig_step(&r, 1.0 / 60);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        }
        assert_memory_equal(&r.state.position, &rest, sizeof rest);
        r.input.move = fake_vec(k % 2 ? 1.0 / 6 : -1.0 / 6, 0, 0);
        rig_steps(&r, 90, 1.0 / 60);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.position.z, k % 2 ? 1.2125 : 0.9125, 0.0026);
        rig_close(&r);
    }
}

/* From under a ceiling, along a step: where the ceiling ends its edge lets the head rise only as it goes on, and the
 * foot goes on over the edge of the step only as it rises. */
static void a_ceiling_that_ends_beside_a_step_takes_no_time(void **unused)
{
    (void)unused;
    for (int i = 0; i < 200; i++) {
        fake_world w;
        rig r;
        const double low = 0.1 + 0.1 * (i % 4), high = 1.83 + 0.02 * (i / 4 % 10), way = 0.15 * (2 + i / 40);
        block(&w, low);
        fake_add_box(&w, fake_vec(-9, -20, high), fake_vec(40, 0, 9));
        rig_stand(&r, &w, NULL, fake_vec(1.5, -1, 0.915));
        r.input.move = fake_vec(cos(way), sin(way), 0);
        for (int k = 0; k < 72; k++) {
            rig_step(&r, 1.0 / 60);
            if (r.report.time_lost > 0) {
                fail_msg("%g m high, ceiling at %g, way %g: %g s lost", low, high, way, r.report.time_lost);
            }
        }
        assert_true(r.state.position.x > 2 && r.state.position.z > low + 0.9);
        rig_close(&r);
    }
}

/* Past the edge of a slope that is no step the floor has ended: walked down from above it is not held to, nor from
 * below. */
static void the_upper_end_of_a_high_steep_slope_holds_nobody(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        int fell = 0;
        edge e = {.height = 1, .slope = 58, .run = 0.6248};
        open_edge(&r, &e, 4, 1);
        r.input.move = fake_vec(-1.0 / 6, 0, 0);
        for (int k = 0; k < (int)(rig_rates[i] * 4); k++) {
            rig_step(&r, 1 / rig_rates[i]);
            fell += r.state.mode == TAHR_MODE_FALLING;
        }
        assert_true(fell > 0.2 * rig_rates[i]);
        assert_true(r.state.position.z < 0.916);
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_below_the_limit_are_climbed_and_above_refused),
        cmocka_unit_test(a_step_up_says_so_once_with_its_height),
        cmocka_unit_test(a_flight_of_stairs_takes_its_level_length_over_speed),
        cmocka_unit_test(a_bevel_too_steep_to_stand_on_is_walked_over_like_a_sharp_edge),
        cmocka_unit_test(an_edge_that_is_never_walkable_is_walked_over_like_a_sharp_one),
        cmocka_unit_test(a_slope_too_steep_to_stand_on_is_a_step_if_it_is_no_higher_than_one),
        cmocka_unit_test(who_stops_half_way_up_a_bevel_rests_there_and_goes_on),
        cmocka_unit_test(a_ceiling_that_ends_beside_a_step_takes_no_time),
        cmocka_unit_test(the_upper_end_of_a_high_steep_slope_holds_nobody),
        cmocka_unit_test(a_low_ceiling_over_the_step_refuses_it),
        cmocka_unit_test(a_ceiling_just_high_enough_lets_the_step_through),
        cmocka_unit_test(no_step_height_means_no_step),
        cmocka_unit_test(a_refused_tall_wall_costs_one_extra_sweep),
        cmocka_unit_test(stepping_down_is_followed_and_said)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

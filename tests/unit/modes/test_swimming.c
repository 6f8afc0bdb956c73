/* SPDX-License-Identifier: MIT
 * test_swimming.c: swimming in the deep and at the surface against closed forms, at every rate. Entering and leaving is
 * in test_water_line.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pool.h"

static void open_deep(rig *r, pool *p, const tahr_config *config)
{
    pool_open(r, p, config, fake_vec(0, 0, -50));
    r->state.mode = TAHR_MODE_SWIMMING;
}

/* Thrust and drag in proportion to the velocity: v = V (1 - e^-kt), which starts with k V = acceleration. */
static void a_swimmer_gains_the_speed_asked_for_in_any_direction(void **unused)
{
    const double k = 20.48 / 3, way = 3 * (2 - (1 - exp(-2 * k)) / k);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        open_deep(&r, &p, NULL);
        r.input.move = fake_vec(2.0 / 3, 1.0 / 3, -2.0 / 3);
        assert_int_equal(pool_run(&r, 2, 1 / rig_rates[i]), 0);
        assert_near(r.state.position.x, way * 2 / 3, 1e-9);
        assert_near(r.state.position.y, way / 3, 1e-9);
        assert_near(r.state.position.z, -50 - way * 2 / 3, 1e-9);
        assert_near(r.state.velocity.x, 2 * (1 - exp(-2 * k)), 1e-9);
        rig_close(&r);
    }
}

static void half_a_stick_swims_half_as_fast_and_a_long_one_no_faster(void **unused)
{
    const double sticks[] = {0.5, 1, 40};
    (void)unused;
    for (int i = 0; i < 3; i++) {
        pool p;
        rig r;
        pool_init(&p);
        open_deep(&r, &p, NULL);
        r.input.move = fake_vec(0, sticks[i], 0);
        pool_run(&r, 10, 0.1);
        assert_near(r.state.velocity.y, 3 * fmin(sticks[i], 1), 1e-9);
        rig_close(&r);
    }
}

static void without_input_only_drag_is_left_and_ends(void **unused)
{
    /* At 1 mm/s it stands: then a way of 1 mm/s / F is left. */
    const double f = 0.3, speed = 2.25, whole = (speed - 1e-3) / f;
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        open_deep(&r, &p, NULL);
        r.state.velocity = fake_vec(speed * 0.8, 0, -speed * 0.6);
        pool_run(&r, 2, 1 / rig_rates[i]);
        assert_near(r.state.position.x, 0.8 * speed * (1 - exp(-2 * f)) / f, 1e-9);
        assert_near(r.state.velocity.z, -0.6 * speed * exp(-2 * f), 1e-9);
        if (rig_rates[i] < 100) {
            pool_run(&r, 26, 1 / rig_rates[i]);
            assert_near(r.state.position.x, 0.8 * whole, 1e-8);
            assert_true(r.state.velocity.x == 0 && r.state.velocity.z == 0);
            tahr_state before = r.state;
            rig_step(&r, 1 / rig_rates[i]);
            assert_memory_equal(&before, &r.state, sizeof before);
        }
        rig_close(&r);
    }
}

static void a_fluid_says_its_own_friction_and_carries_with_its_current(void **unused)
{
    const double f = 2.5, t = 3;
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        p.water.friction = f;
        p.water.velocity = fake_vec(0.5, 1, -0.25);
        open_deep(&r, &p, NULL);
        pool_run(&r, t, 1 / rig_rates[i]);
        double way = t - (1 - exp(-f * t)) / f;
        assert_near(r.state.position.x, 0.5 * way, 1e-9);
        assert_near(r.state.position.y, way, 1e-9);
        assert_near(r.state.position.z, -50 - 0.25 * way, 1e-9);
        rig_close(&r);
    }
}

static void what_buoyancy_does_not_carry_sinks_to_the_speed_that_drag_holds(void **unused)
{
    const double f = 0.3, t = 2;
    const double buoyancies[] = {0.8, 1.1, 0};
    (void)unused;
    for (int b = 0; b < 3; b++) {
        for (int i = 0; i < RIG_RATES; i++) {
            tahr_config c = rig_config();
            pool p;
            rig r;
            c.buoyancy = buoyancies[b];
            pool_init(&p);
            open_deep(&r, &p, &c);
            pool_run(&r, t, 1 / rig_rates[i]);
            double a = 9.81 * (c.buoyancy - 1);
            assert_near(r.state.velocity.z, a / f * (1 - exp(-f * t)), 1e-9);
            assert_near(r.state.position.z, -50 + a / f * (t - (1 - exp(-f * t)) / f), 1e-9);
            rig_close(&r);
        }
    }
}

/* Near the surface the lift is in proportion to the height: a damped spring. w^2 = g b / H; at the surface at least
 * half of the critical damping. */
static void a_bob_is_a_damped_spring(void **unused)
{
    const double b = 1.3, w2 = 9.81 * b / 1.8, d = sqrt(w2) / 2, w = sqrt(w2 - d * d);
    const double rest = 0.9 - 1.8 / b, from = -0.6, times[] = {0.5, 1, 2};
    (void)unused;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            tahr_config c = rig_config();
            pool p;
            rig r;
            double t = times[k];
            c.buoyancy = b;
            pool_init(&p);
            pool_open(&r, &p, &c, fake_vec(0, 0, from));
            r.state.mode = TAHR_MODE_SWIMMING;
            assert_int_equal(pool_run(&r, t, 1 / rig_rates[i]), 0);
            double y = (from - rest) * exp(-d * t) * (cos(w * t) + d / w * sin(w * t));
            assert_near(r.state.position.z, rest + y, 1e-9);
            rig_close(&r);
        }
    }
}

static void what_floats_comes_to_rest_where_it_is_carried_and_repeats(void **unused)
{
    const double buoyancies[] = {1.05, 1.3, 1.9, 4};
    (void)unused;
    for (int b = 0; b < 4; b++) {
        for (int i = 0; i < RIG_RATES; i++) {
            tahr_config c = rig_config();
            pool p;
            rig r;
            c.buoyancy = buoyancies[b];
            pool_init(&p);
            pool_open(&r, &p, &c, fake_vec(0, 0, 1.5));
            pool_run(&r, b ? 15 : 40, 1 / rig_rates[i]); /* the lightest load takes longest to come up */
            double rest = 0.9 - 1.8 / c.buoyancy, w = sqrt(9.81 * c.buoyancy / 1.8);
            assert_int_equal(r.state.mode, TAHR_MODE_SWIMMING);
            assert_near(r.state.position.z, rest, 1e-3 / w); /* 1 mm/s of a swing */
            tahr_state before = r.state;
            rig_step(&r, 1 / rig_rates[i]);
            rig_step(&r, 1 / rig_rates[i]);
            assert_memory_equal(&before, &r.state, sizeof before);
            rig_close(&r);
        }
    }
}

/* All of the stick upward: thrust A (m - 0.65) / 0.35 against the weight 9.81 (1 - m) that is out of the water. */
static void nobody_swims_out_through_the_surface(void **unused)
{
    const double thrust = 20.48, line = 0.65, m = (9.81 + thrust * line / (1 - line)) / (9.81 + thrust / (1 - line));
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        pool_open(&r, &p, NULL, fake_vec(0, 0, -6));
        r.state.mode = TAHR_MODE_SWIMMING;
        r.input.move = fake_vec(0, 0, 1);
        assert_int_equal(pool_run(&r, 8, 1 / rig_rates[i]), 0);
        assert_near(pool_immersion(r.state.position.z), m, 1e-3);
        assert_true(r.state.velocity.z == 0);
        r.input.move = fake_vec(0.8, 0, 0.6);
        assert_int_equal(pool_run(&r, 3, 1 / rig_rates[i]), 0);
        assert_near(r.state.velocity.x, 2.4, 1e-6);
        rig_close(&r);
    }
}

static void without_gravity_water_neither_lifts_nor_lets_fall(void **unused)
{
    const double k = 20.48 / 3;
    pool p;
    rig r;
    (void)unused;
    pool_init(&p);
    pool_open(&r, &p, NULL, fake_vec(0, 0, -0.5));
    r.state.mode = TAHR_MODE_SWIMMING;
    r.input.flags = TAHR_INPUT_GRAVITY;
    tahr_state before = r.state;
    pool_run(&r, 5, 1.0 / 60);
    assert_memory_equal(&before, &r.state, sizeof before);
    r.input.move = fake_vec(1, 0, 0);
    pool_run(&r, 2, 1.0 / 60);
    assert_near(r.state.position.x, 3 * (2 - (1 - exp(-2 * k)) / k), 1e-9);
    assert_true(r.state.position.z == -0.5);
    rig_close(&r);
}

static void a_swimmer_slides_along_walls_and_stops_in_corners(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        fake_add_plane(&p.world, fake_vec(-1, 0, 0), -3);     /* x < 3 */
        fake_add_plane(&p.world, fake_vec(0, -1, 0), -5);     /* y < 5 */
        fake_add_plane(&p.world, fake_vec(0, 0.6, 0.8), -54); /* a bottom that slopes */
        open_deep(&r, &p, NULL);
        r.input.move = fake_vec(0.6, 0.8, 0);
        pool_run(&r, 1.8, 1 / rig_rates[i]);
        assert_near(r.state.position.x, 3 - 0.36, 1e-6);
        assert_near(r.state.velocity.y, 2.4, 0.1); /* what the wall leaves of the wish */
        r.input.move = fake_vec(0.6, 0.64, -0.48); /* into both walls, and down */
        pool_run(&r, 12, 1 / rig_rates[i]);
        assert_near(r.state.position.x, 3 - 0.36, 1e-6);
        assert_near(r.state.position.y, 5 - 0.36, 1e-6);
        assert_true(fake_clearance(&p.world, &r.config.shape, r.state.position) > 0.01 - 1e-6);
        assert_true(r.report.sweeps <= r.config.max_slides + 16);
        rig_close(&r);
    }
}

static void deep_water_costs_one_sweep_and_two_looks_at_it(void **unused)
{
    pool p;
    rig r;
    (void)unused;
    pool_init(&p);
    open_deep(&r, &p, NULL);
    r.input.move = fake_vec(1, 0, 0);
    pool_run(&r, 2, 1.0 / 60);
    assert_int_equal(r.report.sweeps, 1);
    assert_int_equal(r.report.fluid_queries, 2);
    assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    tahr_query_record records[8];
    tahr_report report = {.struct_size = sizeof report, .queries = records, .query_capacity = 8};
    const tahr_state before = r.state;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report), TAHR_OK);
    assert_int_equal(report.query_count, 3);
    assert_true(records[0].type == TAHR_QUERY_FLUID && records[0].position.x == before.position.x);
    assert_true(records[0].distance == 1 && records[0].count == 1 && records[0].body == 7);
    r.input.move = fake_vec(0, 0, 0);
    r.state.velocity = fake_vec(0, 0, 0);
    rig_step(&r, 1.0 / 60);
    assert_int_equal(r.report.sweeps, 0);
    assert_int_equal(r.report.fluid_queries, 1);
    rig_close(&r);
}

/* 1.6 of the field: half of the friction damps, all of it brakes; what is carried takes its part of the weight. */
static void stepped_swimming_is_the_step_of_the_field(void **unused)
{
    tahr_config c;
    pool p;
    rig r;
    const double h = 1.0 / 30, swim = 3;
    (void)unused;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    pool_init(&p);
    pool_open(&r, &p, &c, fake_vec(0, 0, -50));
    r.state.mode = TAHR_MODE_SWIMMING;
    r.input.move = fake_vec(1, 0, 0);
    rig_step(&r, h);
    assert_near(r.state.velocity.x, 20.48 * h, 1e-12);
    assert_near(r.state.position.x, 20.48 * h * h, 1e-12);
    double v = r.state.velocity.x * (1 - 0.15 * h) + 20.48 * h;
    rig_step(&r, h);
    assert_near(r.state.velocity.x, v, 1e-12);
    r.input.move = fake_vec(0, 0, 0);
    r.state.velocity = fake_vec(1, 0, 2 * swim);
    rig_step(&r, 1.0 / 60);
    /* wholly immersed: rise * 1; braking 0.3 / s, then the fluid's 0.15 / s */
    assert_near(r.state.velocity.z, 2 * swim * (1 - 0.3 / 60) * (1 - 0.15 / 60), 1e-12);
    /* 0.6 immersed: rise 2 * 0.36 < 0.99; friction 0.18 / s and 0.09 / s; 0.4 of the weight is left */
    r.state.position = fake_vec(0, 0, 0.88 - 0.6 * 1.76);
    r.state.velocity = fake_vec(0, 0, 2);
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.velocity.z, 0.99 * (1 - 0.18 / 60) * (1 - 0.09 / 60) - 9.8 * 0.4 / 60, 1e-12);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_swimmer_gains_the_speed_asked_for_in_any_direction),
        cmocka_unit_test(half_a_stick_swims_half_as_fast_and_a_long_one_no_faster),
        cmocka_unit_test(without_input_only_drag_is_left_and_ends),
        cmocka_unit_test(a_fluid_says_its_own_friction_and_carries_with_its_current),
        cmocka_unit_test(what_buoyancy_does_not_carry_sinks_to_the_speed_that_drag_holds),
        cmocka_unit_test(a_bob_is_a_damped_spring),
        cmocka_unit_test(what_floats_comes_to_rest_where_it_is_carried_and_repeats),
        cmocka_unit_test(nobody_swims_out_through_the_surface),
        cmocka_unit_test(without_gravity_water_neither_lifts_nor_lets_fall),
        cmocka_unit_test(a_swimmer_slides_along_walls_and_stops_in_corners),
        cmocka_unit_test(deep_water_costs_one_sweep_and_two_looks_at_it),
        cmocka_unit_test(stepped_swimming_is_the_step_of_the_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

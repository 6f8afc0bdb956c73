/* SPDX-License-Identifier: MIT
 * test_water_line.c: how fluids are entered and left: falling in, wading in and out, jumping out, stepping out. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pool.h"

/* Centre of the preset's capsule on the line where it begins to swim: 0.65 of 1.8 m under water. */
static const double LINE = 0.9 - 0.65 * 1.8;

static void a_fall_ends_where_the_water_carries_at_its_exact_time(void **unused)
{
    const double truth = sqrt(2 * (3 - LINE) / 9.81);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        double dt = 1 / rig_rates[i], at = -1;
        pool_init(&p);
        pool_open(&r, &p, NULL, fake_vec(0, 0, 3));
        for (int k = 0; k < (int)rig_rates[i]; k++) {
            rig_step(&r, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_MODE);
            if (e) {
                assert_true(at < 0 && e->value == TAHR_MODE_SWIMMING);
                at = k * dt + e->time;
                assert_near(e->position.z, LINE, 1e-8);
                assert_true(rig_rates[i] < 100 || r.report.fluid_queries <= 6); /* a level surface is found by one
                                                                                 * look */
            }
        }
        assert_near(at, truth, 1e-8);
        rig_close(&r);
    }
}

/* The water does not carry what rises: who jumps out of it gets away. */
static void a_rise_through_the_line_goes_on(void **unused)
{
    pool p;
    rig r;
    (void)unused;
    pool_init(&p);
    pool_open(&r, &p, NULL, fake_vec(0, 0, -0.5)); /* 0.78 under water */
    r.state.velocity = fake_vec(0, 0, 3);
    rig_step(&r, 0.01);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    assert_near(r.state.velocity.z, 3 - 0.0981, 1e-12);
    r.state.position.z = -5; /* all of it under water: no free flight there */
    rig_step(&r, 0.01);
    assert_int_equal(r.state.mode, TAHR_MODE_SWIMMING);
    rig_close(&r);
}

static void a_jump_at_the_surface_leaves_the_water_and_one_below_does_not(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        double dt = 1 / rig_rates[i], top = -INFINITY;
        pool_init(&p);
        pool_open(&r, &p, NULL, fake_vec(0, 0, -4));
        r.state.mode = TAHR_MODE_SWIMMING;
        r.input.jump = 1;
        rig_step(&r, dt);
        assert_true(r.state.mode == TAHR_MODE_SWIMMING && !rig_event(&r, TAHR_EVENT_JUMPED));
        r.input.jump = 0;
        r.input.move = fake_vec(0, 0, 1);
        pool_run(&r, 5, dt);
        double from = r.state.position.z;
        assert_true(r.state.velocity.z == 0);
        r.input.jump = 1;
        for (int k = 0; k < (int)(0.6 * rig_rates[i] + 0.5); k++) {
            rig_step(&r, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_APEX);
            top = e ? e->position.z : top;
            if (k == 0) {
                const tahr_event *jumped = rig_event(&r, TAHR_EVENT_JUMPED);
                assert_true(jumped && jumped->time == 0 && jumped->value == 5.5);
                assert_false(rig_event(&r, TAHR_EVENT_LEFT_GROUND) != NULL);
            }
        }
        assert_near(top, from + 5.5 * 5.5 / (2 * 9.81), 1e-9);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        pool_run(&r, 3, dt);
        assert_int_equal(r.state.mode, TAHR_MODE_SWIMMING); /* the button was held: no second jump */
        rig_close(&r);
    }
}

static void a_jump_onto_the_rim_of_a_pool_stands_there(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        tahr_config c = rig_config();
        pool p;
        rig r;
        c.water_exit_speed = 6; /* the foot hangs 1.3 m deep: 5.1 m/s would do */
        pool_init(&p);
        fake_add_box(&p.world, fake_vec(2, -50, -50), fake_vec(50, 50, 0));
        pool_open(&r, &p, &c, fake_vec(0, 0, -2));
        r.state.mode = TAHR_MODE_SWIMMING;
        r.input.move = fake_vec(0.6, 0, 0.8);
        pool_run(&r, 5, 1 / rig_rates[i]);
        assert_near(r.state.position.x, 2 - 0.36, 1e-6);
        r.input.jump = 1;
        r.input.move = fake_vec(1, 0, 0);
        pool_run(&r, 2, 1 / rig_rates[i]);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(r.state.position.x > 2 && r.state.position.z > 0.9);
        rig_close(&r);
    }
}

/* A shore: the sea's bottom rises toward -x at 1 in 4. */
static void add_shore(pool *p)
{
    const double size = sqrt(1 + 1.0 / 16);
    fake_add_plane(&p->world, fake_vec(0.25 / size, 0, 1 / size), 0);
}

/* At half the speed, and while it still accelerates. */
static void a_walk_into_the_sea_swims_where_it_is_deep_enough(void **unused)
{
    (void)unused;
    for (int n = 0; n < 2 * RIG_RATES; n++) {
        int i = n / 2;
        pool p;
        rig r;
        double dt = 1 / rig_rates[i];
        int found = 0;
        pool_init(&p);
        add_shore(&p);
        pool_open(&r, &p, NULL, n % 2 ? fake_vec(4.62, 0, 0) : fake_vec(-4, 0, 2.5));
        rig_settle(&r);
        r.input.move = fake_vec(n % 2 ? 1 : 0.5, 0, 0);
        for (int k = 0; k < (int)(6 * rig_rates[i]) && !found; k++) {
            rig_step(&r, dt);
            rig_assert_in_order(&r, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_MODE), *left = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
            if (e) {
                found = 1;
                assert_true(e->value == TAHR_MODE_SWIMMING && left && left->value == TAHR_LEFT_MODE);
                assert_true(left->time == e->time);
                assert_near(pool_immersion(e->position.z), 0.65, 1e-4);
                assert_near(r.report.time_lost, 0, 0);
            }
        }
        assert_true(found);
        assert_int_equal(pool_run(&r, 6, dt), 0); /* swims out to sea */
        assert_true(r.state.floor.body == TAHR_NO_BODY && r.state.floor.flags == 0);
        rig_close(&r);
    }
}

static void a_swim_to_the_shore_walks_there_and_changes_its_mode_once(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        double dt = 1 / rig_rates[i];
        pool_init(&p);
        add_shore(&p);
        pool_open(&r, &p, NULL, fake_vec(12, 0, -0.9));
        r.state.mode = TAHR_MODE_SWIMMING;
        r.input.move = fake_vec(-1, 0, 0);
        assert_int_equal(pool_run(&r, 8, dt), 1);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(pool_immersion(r.state.position.z) == 0);
        rig_close(&r);
    }
}

/* At every depth around the line: who stands goes on standing, who swims comes to one of both. */
static void nobody_swaps_between_two_modes_in_the_shallows(void **unused)
{
    (void)unused;
    for (double depth = 0.85; depth < 1.35; depth += 0.0103) {
        for (int swims = 0; swims < 2; swims++) {
            pool p;
            rig r;
            pool_init(&p);
            fake_add_plane(&p.world, fake_vec(0, 0, 1), -depth);
            pool_open(&r, &p, NULL, fake_vec(0, 0, 0.92 - depth));
            r.state.mode = swims ? TAHR_MODE_SWIMMING : TAHR_MODE_FALLING;
            assert_true(pool_run(&r, 2, 1.0 / 60) <= 2);
            uint32_t mode = r.state.mode;
            for (int k = 0; k < 5; k++) { /* and where it walks about on the level */
                r.input.move = fake_vec(k % 2 ? 1 : -0.3, 0, 0);
                assert_int_equal(pool_run(&r, 1, 1.0 / 60), 0);
            }
            assert_int_equal(r.state.mode, mode);
            rig_close(&r);
        }
    }
}

static void a_swimmer_steps_up_on_a_low_ledge_and_walks_on(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        fake_add_plane(&p.world, fake_vec(0, 0, 1), -1.25);
        fake_add_box(&p.world, fake_vec(2, -50, -50), fake_vec(50, 50, -0.9)); /* 0.35 m high, 0.9 m of water over it */
        pool_open(&r, &p, NULL, fake_vec(0, 0, -0.33));
        r.state.mode = TAHR_MODE_SWIMMING;
        r.input.move = fake_vec(1, 0, 0);
        pool_run(&r, 3, 1 / rig_rates[i]);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(r.state.position.x > 2.5);
        rig_close(&r);
    }
}

static void a_step_in_the_deep_is_a_wall_to_a_swimmer(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        tahr_config c = rig_config();
        pool p;
        rig r;
        c.buoyancy = 0.9;
        pool_init(&p);
        fake_add_plane(&p.world, fake_vec(0, 0, 1), -8);
        fake_add_box(&p.world, fake_vec(2, -50, -50), fake_vec(50, 50, -7.62)); /* a walker would take it */
        pool_open(&r, &p, &c, fake_vec(0, 0, -7.09));
        r.state.mode = TAHR_MODE_SWIMMING;
        r.input.move = fake_vec(1, 0, 0);
        assert_int_equal(pool_run(&r, 3, 1 / rig_rates[i]), 0);
        assert_near(r.state.position.x, 2 - 0.36, 1e-6);
        assert_near(r.state.position.z, -8 + 0.91, 1e-6);
        assert_true(r.report.step_offset == 0 && r.state.floor.flags == 0);
        rig_close(&r);
    }
}

static void water_that_ends_sideways_is_left_there(void **unused)
{
    tahr_body_desc pond;
    rig r;
    (void)unused;
    assert_int_equal(tahr_body_desc_init(&pond, sizeof pond, TAHR_BODY_BOX), TAHR_OK);
    pond.flags = TAHR_BODY_FLUID;
    pond.half_extents = fake_vec(5, 5, 10);
    rig_open_bodies(&r, &pond, 1, NULL, fake_vec(0, 0, 0));
    r.state.mode = TAHR_MODE_SWIMMING;
    r.input.move = fake_vec(1, 0, 0);
    for (int k = 0; k < 600 && r.state.mode == TAHR_MODE_SWIMMING; k++) {
        rig_step(&r, 1.0 / 60);
    }
    const tahr_event *e = rig_event(&r, TAHR_EVENT_MODE);
    assert_true(e && e->value == TAHR_MODE_FALLING);
    assert_near(e->position.x, 5, 3.0 / 60 / 1024);
    rig_close(&r);
}

static void an_answer_that_is_none_ends_the_step_and_leaves_the_state(void **unused)
{
    const uint32_t modes[] = {TAHR_MODE_SWIMMING, TAHR_MODE_FALLING, TAHR_MODE_WALKING};
    (void)unused;
    for (int lie = POOL_NAN; lie < POOL_LIES; lie++) {
        for (int m = 0; m < 3; m++) {
            pool p;
            rig r;
            pool_init(&p);
            fake_add_plane(&p.world, fake_vec(0, 0, 1), -0.5);
            pool_open(&r, &p, NULL, fake_vec(0, 0, 0.6));
            rig_settle(&r);
            p.lie = lie;
            r.state.mode = modes[m];
            r.input.move = fake_vec(1, 0, 0);
            tahr_state before = r.state;
            tahr_report untouched = r.report;
            assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &r.report), TAHR_E_BACKEND);
            assert_memory_equal(&before, &r.state, sizeof before);
            assert_memory_equal(&untouched, &r.report, sizeof untouched);
            assert_non_null(strstr(r.log.text, pool_fields[lie]));
            rig_close(&r);
        }
    }
}

/* Water that is there and is not, from place to place, and a gravity that turns over: no step asks more than
 * promised. */
static void a_fluid_without_rhyme_leaves_a_finite_character(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        pool p;
        rig r;
        pool_init(&p);
        fake_add_plane(&p.world, fake_vec(0, 0, 1), -3);
        fake_add_plane(&p.world, fake_vec(0, 0, -1), -3);
        p.lie = POOL_NOISE;
        p.water.velocity = fake_vec(3, -2, 1);
        pool_open(&r, &p, NULL, fake_vec(0, 0, 0));
        r.input.flags = TAHR_INPUT_GRAVITY;
        for (int k = 0; k < 1000; k++) {
            r.input.gravity = fake_vec(0, 0, k / 200 % 2 ? 9.81 : -9.81);
            r.input.move = fake_vec(sin(k * 0.37), cos(k * 0.91), sin(k * 0.53));
            r.input.jump = k % 7 == 0;
            rig_step(&r, 1 / rig_rates[i]);
            tahr_vec3 at = r.state.position, v = r.state.velocity;
            assert_true(isfinite(at.x + at.y + at.z) && isfinite(v.x + v.y + v.z));
            assert_true(at.z >= -3 + 0.9 && at.z <= 3 - 0.9);
            assert_true(r.report.sweeps + r.report.contact_queries + r.report.rays + r.report.fluid_queries <=
                        TAHR_MAX_QUERIES_PER_STEP);
        }
        rig_close(&r);
    }
}

static void a_pool_that_is_drained_lets_the_swimmer_fall(void **unused)
{
    tahr_body_desc pond;
    tahr_body_pose away = {.body = 0, .pose = {{0, 0, -100}, {0, 0, 0, 1}}};
    rig r;
    (void)unused;
    assert_int_equal(tahr_body_desc_init(&pond, sizeof pond, TAHR_BODY_BOX), TAHR_OK);
    pond.flags = TAHR_BODY_FLUID | TAHR_BODY_MOVABLE;
    pond.half_extents = fake_vec(5, 5, 10);
    rig_open_bodies(&r, &pond, 1, NULL, fake_vec(0, 0, 0));
    r.state.mode = TAHR_MODE_SWIMMING;
    for (int k = 0; k < 3; k++) { /* at rest, and asleep */
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_OK);
    }
    assert_true(r.state.mode == TAHR_MODE_SWIMMING && r.state.position.z == 0);
    assert_int_equal(tahr_world_set(r.world, &away, 1), TAHR_OK);
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_OK);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    assert_near(r.state.position.z, -0.5 * 9.81 * 0.01, 1e-12);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fall_ends_where_the_water_carries_at_its_exact_time),
        cmocka_unit_test(a_rise_through_the_line_goes_on),
        cmocka_unit_test(a_jump_at_the_surface_leaves_the_water_and_one_below_does_not),
        cmocka_unit_test(a_jump_onto_the_rim_of_a_pool_stands_there),
        cmocka_unit_test(a_walk_into_the_sea_swims_where_it_is_deep_enough),
        cmocka_unit_test(a_swim_to_the_shore_walks_there_and_changes_its_mode_once),
        cmocka_unit_test(nobody_swaps_between_two_modes_in_the_shallows),
        cmocka_unit_test(a_swimmer_steps_up_on_a_low_ledge_and_walks_on),
        cmocka_unit_test(a_step_in_the_deep_is_a_wall_to_a_swimmer),
        cmocka_unit_test(water_that_ends_sideways_is_left_there),
        cmocka_unit_test(a_fluid_without_rhyme_leaves_a_finite_character),
        cmocka_unit_test(a_pool_that_is_drained_lets_the_swimmer_fall),
        cmocka_unit_test(an_answer_that_is_none_ends_the_step_and_leaves_the_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

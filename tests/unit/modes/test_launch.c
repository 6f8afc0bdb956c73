/* SPDX-License-Identifier: MIT
 * test_launch.c: launches and impulses against ballistics and braking; the same numbers at every rate. Drives are in
 * test_drive.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static const double G = 9.81;

static void stand(rig *r, fake_world *w)
{
    fake_world_flat(w);
    rig_stand(r, w, NULL, fake_vec(0, 0, 1));
}

/* One step with the flags, and none of them after it. */
static void ask(rig *r, uint32_t flags, double dt)
{
    r->input.flags = flags;
    rig_step(r, dt);
    r->input.flags = 0;
}

static void a_launch_flies_the_parabola_at_every_rate(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double dt = 1 / rig_rates[i];
        stand(&r, &w);
        double z = r.state.position.z;
        r.input.launch = fake_vec(3, -2, 8);
        ask(&r, TAHR_INPUT_LAUNCH, dt);
        const tahr_event *left = rig_event(&r, TAHR_EVENT_LEFT_GROUND), *e = rig_event(&r, TAHR_EVENT_LAUNCHED);
        assert_non_null(left);
        assert_near(left->value, TAHR_LEFT_LAUNCH, 0);
        assert_non_null(e);
        assert_near(e->value, sqrt(9 + 4 + 64), 1e-12);
        assert_near(e->time, 0, 0);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        rig_steps(&r, (int)rig_rates[i] - 1, dt);
        assert_near(r.state.position.x, 3, 1e-9);
        assert_near(r.state.position.y, -2, 1e-9);
        assert_near(r.state.position.z, z + 8 - 0.5 * G, 1e-9);
        assert_near(r.state.velocity.z, 8 - G, 1e-9);
        rig_close(&r);
    }
}

static void launches_add_to_the_velocity_or_replace_a_part_of_it(void **unused)
{
    const struct {
        uint32_t flags;
        double x, z;
    } cases[] = {{0, 5, 9},
                 {TAHR_INPUT_LAUNCH_LEVEL, 1, 9},
                 {TAHR_INPUT_LAUNCH_UP, 5, 7},
                 {TAHR_INPUT_LAUNCH_LEVEL | TAHR_INPUT_LAUNCH_UP, 1, 7}};
    (void)unused;
    for (int i = 0; i < 4; i++) {
        fake_world w;
        rig r;
        fake_world_init(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 0));
        r.state.velocity = fake_vec(4, 0, 2);
        r.input.launch = fake_vec(1, 0, 7);
        ask(&r, TAHR_INPUT_LAUNCH | cases[i].flags, 0.01);
        assert_near(r.state.velocity.x, cases[i].x, 1e-12);
        assert_near(r.state.velocity.z, cases[i].z - G * 0.01, 1e-12);
        rig_close(&r);
    }
}

static void a_launch_along_the_ground_leaves_it_and_lands_again(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    stand(&r, &w);
    r.state.position.z = 0.9 + r.config.skin + 0.004;
    r.input.launch = fake_vec(5, 0, 0);
    ask(&r, TAHR_INPUT_LAUNCH, 0.1);
    const tahr_event *landed = rig_event(&r, TAHR_EVENT_LANDED);
    assert_non_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
    assert_non_null(landed);
    assert_near(landed->time, sqrt(2 * 0.004 / G), 1e-6);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_close(&r);
}

static void a_launch_ends_what_a_held_jump_still_gave(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    c.jump_hold_time = 1;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.input.jump = 1;
    rig_step(&r, 0.1);
    assert_near(r.state.velocity.z, 4.2, 1e-12); /* suspended */
    r.input.launch = fake_vec(0, 0, 2);
    ask(&r, TAHR_INPUT_LAUNCH | TAHR_INPUT_LAUNCH_UP, 0.1);
    assert_near(r.state.velocity.z, 2 - 0.1 * G, 1e-12);
    rig_close(&r);
}

static void an_impulse_along_the_ground_slides_until_braking_stops_it(void **unused)
{
    /* 320 N s on 80 kg: 4 m/s, and up to 1e-10 of it upward by rounding. Braking: v' = -16 v - 20.48. */
    const double place = 4 / 16.0 - 20.48 / 256 * log1p(16 * 4 / 20.48);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        stand(&r, &w);
        double z = r.state.position.z;
        r.input.impulse = fake_vec(320, 0, i % 2 ? 3.2e-8 : -500);
        ask(&r, TAHR_INPUT_IMPULSE, 1 / rig_rates[i]);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
        assert_null(rig_event(&r, TAHR_EVENT_LAUNCHED));
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, place, 1e-9);
        assert_near(r.state.position.z, z, 0);
        assert_true(r.state.velocity.x == 0);
        rig_close(&r);
    }
}

static void an_impulse_that_points_up_leaves_the_ground(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double dt = 1 / rig_rates[i];
        stand(&r, &w);
        double z = r.state.position.z;
        r.input.impulse = fake_vec(80, 0, 800);
        ask(&r, TAHR_INPUT_IMPULSE, dt);
        assert_near(rig_event(&r, TAHR_EVENT_LEFT_GROUND)->value, TAHR_LEFT_LAUNCH, 0);
        assert_near(rig_event(&r, TAHR_EVENT_LAUNCHED)->value, sqrt(101), 1e-12);
        rig_steps(&r, (int)rig_rates[i] - 1, dt);
        assert_near(r.state.position.x, 1, 1e-9);
        assert_near(r.state.position.z, z + 10 - 0.5 * G, 1e-9);
        rig_close(&r);
    }
}

static void an_impulse_in_the_air_adds_its_velocity(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_init(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0));
    r.state.velocity = fake_vec(1, 0, 0);
    r.input.impulse = fake_vec(80, 160, -240);
    ask(&r, TAHR_INPUT_IMPULSE, 0.01);
    assert_near(r.state.velocity.x, 2, 1e-12);
    assert_near(r.state.velocity.y, 2, 1e-12);
    assert_near(r.state.velocity.z, -3 - 0.01 * G, 1e-12);
    rig_close(&r);
}

/* Ground speed is along the surface: from a slope of 30 degrees, running up it, the air takes over both parts. */
static void launched_from_a_slope_the_run_goes_on_along_it(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_init(&w);
    fake_add_slope(&w, 30);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1.2));
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    r.input.move = fake_vec(0, 0, 0);
    r.input.launch = fake_vec(0, 0, 5);
    ask(&r, TAHR_INPUT_LAUNCH, 1e-3);
    assert_near(r.state.velocity.x, 6 * sqrt(0.75), 1e-6);
    rig_close(&r);
}

static void who_flies_does_not_fall_and_who_is_frozen_stays(void **unused)
{
    const uint32_t flags = TAHR_INPUT_LAUNCH | TAHR_INPUT_IMPULSE | TAHR_INPUT_DRIVE;
    (void)unused;
    fake_world w;
    rig r;
    fake_world_init(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0));
    r.input.launch = r.input.impulse = r.input.drive = fake_vec(1, 2, 3);
    r.state.mode = TAHR_MODE_FLYING;
    ask(&r, flags, 0.01);
    assert_int_not_equal(r.state.mode, TAHR_MODE_FALLING);
    assert_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
    assert_non_null(rig_event(&r, TAHR_EVENT_LAUNCHED));
    r.state.mode = TAHR_MODE_NONE;
    r.state.velocity = fake_vec(0, 0, 0);
    tahr_state before = r.state;
    ask(&r, flags, 0.01);
    assert_memory_equal(&before, &r.state, sizeof before);
    assert_int_equal(r.report.event_count, 0);
    rig_close(&r);
}

static void absurd_requests_are_refused_and_name_their_field(void **unused)
{
    const double sizes[] = {1e30, 1.0001e9, NAN, -INFINITY};
    const uint32_t flags[] = {TAHR_INPUT_LAUNCH, TAHR_INPUT_IMPULSE, TAHR_INPUT_DRIVE};
    const char *names[] = {"input.launch", "input.impulse", "input.drive"};
    (void)unused;
    fake_world w;
    rig r;
    stand(&r, &w);
    for (int i = 0; i < 12; i++) {
        tahr_vec3 *fields[] = {&r.input.launch, &r.input.impulse, &r.input.drive};
        memset(&r.input, 0, sizeof r.input);
        r.input.struct_size = sizeof r.input;
        r.input.flags = flags[i % 3];
        fields[i % 3]->y = sizes[i / 3];
        tahr_state before = r.state;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.01, &r.state, NULL), TAHR_E_ARGUMENT);
        assert_non_null(strstr(r.log.text, names[i % 3]));
        assert_memory_equal(&before, &r.state, sizeof before);
        r.input.flags = 0; /* what is not asked for is not looked at */
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.01, &r.state, NULL), TAHR_OK);
    }
    rig_close(&r);
}

/* However often it is launched as hard as a launch may be, what a step leaves is a state that a step takes. */
static void launching_again_and_again_leaves_a_valid_state(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    c.mass = 1e-3;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.input.launch = fake_vec(6e4, 0, 7e4);
    r.input.impulse = fake_vec(0, 1e9, 0);
    r.input.flags = TAHR_INPUT_LAUNCH | TAHR_INPUT_IMPULSE;
    for (int i = 0; i < 100; i++) {
        rig_step(&r, 1.0 / 60);
        tahr_vec3 v = r.state.velocity;
        assert_true(sqrt(v.x * v.x + v.y * v.y + v.z * v.z) <= 1e5);
    }
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_launch_flies_the_parabola_at_every_rate),
                                       cmocka_unit_test(launches_add_to_the_velocity_or_replace_a_part_of_it),
                                       cmocka_unit_test(a_launch_along_the_ground_leaves_it_and_lands_again),
                                       cmocka_unit_test(a_launch_ends_what_a_held_jump_still_gave),
                                       cmocka_unit_test(an_impulse_along_the_ground_slides_until_braking_stops_it),
                                       cmocka_unit_test(an_impulse_that_points_up_leaves_the_ground),
                                       cmocka_unit_test(an_impulse_in_the_air_adds_its_velocity),
                                       cmocka_unit_test(launched_from_a_slope_the_run_goes_on_along_it),
                                       cmocka_unit_test(who_flies_does_not_fall_and_who_is_frozen_stays),
                                       cmocka_unit_test(absurd_requests_are_refused_and_name_their_field),
                                       cmocka_unit_test(launching_again_and_again_leaves_a_valid_state)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

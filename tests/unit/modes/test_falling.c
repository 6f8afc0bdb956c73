/* SPDX-License-Identifier: MIT
 * test_falling.c: falls, jumps and landings against the parabola, at every frame rate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

/* Steps until an event of the type; [out] its time since the first of these steps. Fails if there is none. */
static const tahr_event *await(rig *r, uint32_t type, double dt, double *time)
{
    *time = INFINITY; /* the compiler does not know that fail_msg does not return */
    for (int i = 0; i < 20000; i++) {
        double before = i * dt;
        rig_step(r, dt);
        const tahr_event *e = rig_event(r, type);
        if (e) {
            *time = before + e->time;
            return e;
        }
    }
    fail_msg("no %s", tahr_event_name(type));
    return NULL;
}

static void free_fall_lands_when_and_where_the_parabola_says(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double t, truth = sqrt(2 * (5 - 0.91) / 9.81);
        fake_world_flat(&w);
        rig_open(&r, &w, NULL, fake_vec(1, 2, 5));
        r.state.velocity = fake_vec(0.5, -1, 0);
        const tahr_event *e = await(&r, TAHR_EVENT_LANDED, 1 / rig_rates[i], &t);
        assert_near(t, truth, 1e-9 * truth);
        assert_near(e->position.z, 0.91, 1e-9);
        assert_near(e->position.x, 1 + 0.5 * truth, 1e-9);
        assert_near(e->position.y, 2 - truth, 1e-9);
        assert_near(e->value, 9.81 * truth, 1e-8);
        rig_close(&r);
    }
}

static void jump_has_its_apex_and_landing_where_the_parabola_says(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double t_apex, t_land, dt = 1 / rig_rates[i], rise = 4.2 / 9.81;
        fake_world_flat(&w);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        double z = r.state.position.z;
        tahr_state start = r.state;
        r.input.jump = 1;
        const tahr_event *e = await(&r, TAHR_EVENT_APEX, dt, &t_apex);
        assert_near(t_apex, rise, 1e-9 * rise);
        assert_near(e->position.z - z, 4.2 * 4.2 / (2 * 9.81), 1e-9);
        r.state = start;
        double to_skin = (4.2 + sqrt(4.2 * 4.2 + 2 * 9.81 * (z - 0.91))) / 9.81;
        e = await(&r, TAHR_EVENT_LANDED, dt, &t_land);
        assert_near(t_land, to_skin, 1e-9 * to_skin);
        assert_near(e->position.z, 0.91, 1e-9);
        rig_close(&r);
    }
}

static void jump_events_come_in_order_and_once(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    uint32_t seen[16] = {0};
    r.input.jump = 1; /* kept down: no second jump */
    for (int i = 0; i < 120; i++) {
        rig_step(&r, 1.0 / 60);
        double last = 0;
        for (uint32_t k = 0; k < r.report.event_count; k++) {
            assert_true(r.events[k].time >= last && r.events[k].time <= 1.0 / 60 + 1e-12);
            last = r.events[k].time;
            seen[r.events[k].type]++;
        }
    }
    assert_int_equal(seen[TAHR_EVENT_JUMPED], 1);
    assert_int_equal(seen[TAHR_EVENT_LEFT_GROUND], 1);
    assert_int_equal(seen[TAHR_EVENT_APEX], 1);
    assert_int_equal(seen[TAHR_EVENT_LANDED], 1);
    assert_int_equal(seen[TAHR_EVENT_MODE], 2);
    assert_int_equal(seen[TAHR_EVENT_HIT], 0);
    rig_close(&r);
}

static void running_jump_covers_the_closed_distance(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double t, dt = 1 / rig_rates[i];
        fake_world_flat(&w);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, (int)(2 * rig_rates[i]), dt);
        double x = r.state.position.x, z = r.state.position.z;
        r.input.jump = 1;
        const tahr_event *e = await(&r, TAHR_EVENT_LANDED, dt, &t);
        double flight = (4.2 + sqrt(4.2 * 4.2 + 2 * 9.81 * (z - 0.91))) / 9.81;
        assert_near(e->position.x - x, 6 * flight, 1e-8);
        rig_close(&r);
    }
}

/* Walking, the speed is that along the slope; in the air its level part goes on. */
static void jump_from_a_slope_keeps_the_level_part_of_the_speed(void **unused)
{
    (void)unused;
    for (int direction = -1; direction <= 1; direction += 2) {
        fake_world w;
        rig r;
        double level = 6 * cos(acos(-1.0) / 6);
        fake_world_init(&w);
        fake_add_slope(&w, 30);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1.5));
        r.input.move = fake_vec(direction, 0, 0);
        rig_steps(&r, 60, 1.0 / 60);
        double x = r.state.position.x;
        r.input.move = fake_vec(0, 0, 0);
        r.input.jump = 1;
        rig_steps(&r, 5, 1.0 / 60);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_near(r.state.velocity.x, direction * level, 1e-9);
        assert_near(r.state.position.x - x, direction * level * 5 / 60, 1e-9);
        rig_close(&r);
    }
}

static void air_control_accelerates_by_its_share(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 50));
        r.input.move = fake_vec(0, 2, 0); /* shortened to 1 */
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.y, 0.5 * 5.12, 1e-9);
        assert_near(r.state.velocity.y, 5.12, 1e-9);
        assert_near(r.state.position.z, 50 - 9.81 / 2, 1e-9);
        rig_close(&r);
    }
}

static void fall_is_never_faster_than_terminal(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double to_terminal = 40 / 9.81;
        fake_world_flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1000));
        rig_steps(&r, (int)(6 * rig_rates[i]), 1 / rig_rates[i]);
        assert_near(r.state.velocity.z, -40, 1e-12);
        assert_near(r.state.position.z, 1000 - 40 * to_terminal / 2 - 40 * (6 - to_terminal), 1e-8);
        rig_close(&r);
    }
}

static void held_jump_rises_by_the_hold(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        double t;
        c.jump_hold_time = 0.25;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        double z = r.state.position.z;
        r.input.jump = 1;
        const tahr_event *e = await(&r, TAHR_EVENT_APEX, 1 / rig_rates[i], &t);
        assert_near(t, 0.25 + 4.2 / 9.81, 1e-9);
        assert_near(e->position.z - z, 4.2 * 0.25 + 4.2 * 4.2 / (2 * 9.81), 1e-9);
        rig_close(&r);
    }
}

static void released_jump_stops_holding(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    double t;
    (void)unused;
    c.jump_hold_time = 0.25;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    double z = r.state.position.z;
    r.input.jump = 1;
    rig_step(&r, 0.1);
    r.input.jump = 0;
    const tahr_event *e = await(&r, TAHR_EVENT_APEX, 0.01, &t);
    assert_near(e->position.z - z, 4.2 * 0.1 + 4.2 * 4.2 / (2 * 9.81), 1e-9);
    rig_close(&r);
}

static void ceiling_stops_the_rise_and_is_never_touched(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        int hit = 0;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(0, 0, -1), -2.2); /* 0.39 m above the head */
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.jump = 1;
        for (int k = 0; k < (int)rig_rates[i] * 2; k++) {
            rig_step(&r, 1 / rig_rates[i]);
            hit += rig_event(&r, TAHR_EVENT_HIT) != NULL;
            assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-8);
            assert_true(!hit || r.state.velocity.z <= 1e-9);
        }
        assert_true(hit);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        rig_close(&r);
    }
}

static void sliding_down_a_steep_slope_accelerates_at_g_sine(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double angle = acos(-1.0) / 3, T = 1;
        fake_world_init(&w);
        fake_add_slope(&w, 60);
        double height = (0.35 + 0.01) / cos(angle) + 0.55; /* the lower cap's centre stands r + skin off the slope */
        rig_open(&r, &w, NULL, fake_vec(0, 0, height));
        rig_steps(&r, (int)(T * rig_rates[i]), 1 / rig_rates[i]);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        double along = 0.5 * 9.81 * sin(angle) * T * T;
        assert_near(r.state.position.x, -along * cos(angle), 1e-6);
        assert_near(r.state.position.z, height - along * sin(angle), 1e-6);
        double speed = sqrt(r.state.velocity.x * r.state.velocity.x + r.state.velocity.z * r.state.velocity.z);
        assert_near(speed, 9.81 * sin(angle) * T, 1e-6);
        rig_close(&r);
    }
}

static void steep_slope_does_not_lift_a_falling_character(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_init(&w);
        fake_add_slope(&w, 60);
        fake_add_plane(&w, fake_vec(0, 0, 1), -50);
        rig_open(&r, &w, NULL, fake_vec(-1, 0, 1));
        r.state.velocity = fake_vec(8, 1, 0);
        r.input.move = fake_vec(1, 0, 0);
        double z = r.state.position.z;
        for (int k = 0; k < (int)rig_rates[i]; k++) {
            rig_step(&r, 1 / rig_rates[i]);
            assert_true(r.state.position.z <= z + 1e-9);
            assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
            z = r.state.position.z;
        }
        rig_close(&r);
    }
}

/* Air control stronger than gravity would hold the character on the slope. The way down a slope of angle a is
 * g sin(a)^2 t^2 / 2, as without a wish; of a wish askew to it the part along it acts. The wish is whole for the
 * moment that a step takes to meet the slope anew: 0.1 mm for all of those. */
static void a_wish_into_a_steep_slope_holds_nobody_on_it(void **unused)
{
    (void)unused;
    static const double CONTROLS[] = {0.25, 0.6, 1, 3}, ANGLES[] = {55, 60, 75};
    for (int k = 0; k < 2 * 4 * 3 * RIG_RATES; k++) {
        fake_world w;
        rig r;
        double rate = rig_rates[k % RIG_RATES], T = 0.5;
        double degrees = ANGLES[k / RIG_RATES % 3], angle = degrees * acos(-1.0) / 180;
        int askew = k / RIG_RATES / 12;
        fake_world_init(&w);
        fake_add_slope(&w, degrees);
        tahr_config c = rig_config();
        c.air_control = CONTROLS[k / RIG_RATES / 3 % 4];
        c.max_speed = 100;
        double height = (0.35 + 0.01) / cos(angle) + 0.55;
        rig_open(&r, &w, &c, fake_vec(0, 0, height));
        r.input.move = askew ? fake_vec(0.8, 0.6, 0) : fake_vec(1, 0, 0);
        rig_steps(&r, (int)(T * rate), 1 / rate);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_near(r.state.position.z, height - 0.5 * 9.81 * sin(angle) * sin(angle) * T * T, 1e-4);
        assert_near(r.state.position.y, askew ? 0.5 * 0.6 * c.air_control * c.acceleration * T * T : 0, 1e-6);
        rig_close(&r);
    }
}

static void falling_along_a_wall_keeps_the_fall(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), -1);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 20));
        r.state.velocity = fake_vec(6, 0, 0);
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 1 - 0.36, 1e-8);
        assert_near(r.state.position.z, 20 - 9.81 / 2, 1e-6);
        assert_near(r.state.velocity.z, -9.81, 1e-6);
        rig_close(&r);
    }
}

static void remaining_time_after_landing_is_walked(void **unused)
{
    fake_world w;
    rig r;
    double fall = sqrt(2 * (2 - 0.91) / 9.81);
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 2));
    r.state.velocity = fake_vec(6, 0, 0);
    r.input.move = fake_vec(1, 0, 0);
    rig_step(&r, 1);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_true(fall < 1);
    assert_near(r.state.position.x, 6, 1e-9);
    rig_close(&r);
}

static void weightless_input_gravity_flies_straight(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 5));
    r.state.velocity = fake_vec(1, 2, 3);
    r.input.flags = TAHR_INPUT_GRAVITY;
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.position.x, 1, 1e-9);
    assert_near(r.state.position.y, 2, 1e-9);
    assert_near(r.state.position.z, 8, 1e-9);
    assert_near(r.state.up.z, 1, 0);
    rig_close(&r);
}

/* Between the edge of a low block at x = 0, z = 0 and a high wall at x = 0.66: a radius and a skin from the wall and from
 * the edge, 0.3 m beside it; the lower core point is as high as the third side of that triangle. The edge is at the rim
 * of the foot, too steep for a floor, and belongs to a face that is one. */
static void a_gap_that_is_too_narrow_to_fall_through_holds(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-5, -5, -3), fake_vec(0, 5, 0));
        fake_add_box(&w, fake_vec(0.66, -5, -3), fake_vec(5, 5, 9));
        rig_open(&r, &w, NULL, fake_vec(0.25, 0, 1.5));
        for (int k = 0; k < 2 * rig_rates[i]; k++) {
            rig_step(&r, 1.0 / rig_rates[i]);
            assert_true(r.report.time_lost == 0);
        }
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(r.state.floor.flags & TAHR_FLOOR_WEDGED);
        assert_int_equal(r.report.event_count, 0);
        assert_near(r.state.position.x, 0.66 - 0.36, 1e-6);
        assert_near(r.state.position.z, sqrt(0.36 * 0.36 - 0.3 * 0.3) + 0.9 - 0.35, 1e-6);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_gap_that_is_too_narrow_to_fall_through_holds),
                                       cmocka_unit_test(free_fall_lands_when_and_where_the_parabola_says),
                                       cmocka_unit_test(jump_has_its_apex_and_landing_where_the_parabola_says),
                                       cmocka_unit_test(jump_events_come_in_order_and_once),
                                       cmocka_unit_test(running_jump_covers_the_closed_distance),
                                       cmocka_unit_test(jump_from_a_slope_keeps_the_level_part_of_the_speed),
                                       cmocka_unit_test(air_control_accelerates_by_its_share),
                                       cmocka_unit_test(fall_is_never_faster_than_terminal),
                                       cmocka_unit_test(held_jump_rises_by_the_hold),
                                       cmocka_unit_test(released_jump_stops_holding),
                                       cmocka_unit_test(ceiling_stops_the_rise_and_is_never_touched),
                                       cmocka_unit_test(sliding_down_a_steep_slope_accelerates_at_g_sine),
                                       cmocka_unit_test(steep_slope_does_not_lift_a_falling_character),
                                       cmocka_unit_test(a_wish_into_a_steep_slope_holds_nobody_on_it),
                                       cmocka_unit_test(falling_along_a_wall_keeps_the_fall),
                                       cmocka_unit_test(remaining_time_after_landing_is_walked),
                                       cmocka_unit_test(weightless_input_gravity_flies_straight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

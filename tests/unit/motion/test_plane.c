/* SPDX-License-Identifier: MIT
 * test_plane.c: motion held in one plane: nothing leaves it, and in it everything is as ever. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "native_world.h"
#include "rig.h"

static const double G = 9.81, SKIN = 0.01, RADIUS = 0.35;

static tahr_config in_plane(tahr_vec3 normal)
{
    tahr_config c = rig_config();
    c.plane = normal;
    return c;
}

static double off(tahr_vec3 n, tahr_vec3 p, tahr_vec3 from)
{
    return n.x * (p.x - from.x) + n.y * (p.y - from.y) + n.z * (p.z - from.z);
}

/* A room with blocks that cross the plane, and walls and a floor that lean across it. */
static void furnish(fake_world *w)
{
    fake_world_flat(w);
    fake_add_plane(w, fake_vec(0, 0, -1), -5);
    fake_add_plane(w, fake_vec(0.6, 0.64, 0.48), -4);
    fake_add_plane(w, fake_vec(-0.8, -0.36, 0.48), -5);
    fake_add_plane(w, fake_vec(0, 0.6, 0.8), -0.4); /* 37 degrees, across */
    fake_add_box(w, fake_vec(1, -5, 0), fake_vec(2, 5, 0.3));
    fake_add_box(w, fake_vec(2, -5, 0), fake_vec(3, 5, 0.8));
    fake_add_box(w, fake_vec(-2, -5, 2.2), fake_vec(-1, 5, 2.5));
}

static void wander(oracle_random *dice, rig *r)
{
    if (oracle_below(dice, 12) == 0) {
        r->input.move = dice_vec(dice, -1, 1);
    }
    r->input.flags = 0;
    r->input.jump = oracle_below(dice, 10) == 0;
    if (oracle_below(dice, 40) == 0) {
        r->input.flags = TAHR_INPUT_LAUNCH;
        r->input.launch = dice_vec(dice, -5, 5);
    } else if (oracle_below(dice, 40) == 0) {
        r->input.flags = TAHR_INPUT_IMPULSE;
        r->input.impulse = dice_vec(dice, -400, 400);
    } else if (oracle_below(dice, 10) == 0) {
        r->input.flags = TAHR_INPUT_DRIVE | (oracle_below(dice, 2) ? TAHR_INPUT_DRIVE_ADD : TAHR_INPUT_DRIVE_LEVEL);
        r->input.drive = dice_vec(dice, -4, 4);
    }
}

static void nothing_leaves_the_plane_in_ten_thousand_steps(void **unused)
{
    const tahr_vec3 normals[] = {{0, 1, 0}, {0.6, 0.8, 0}, {0.28, -0.96, 0}};
    (void)unused;
    for (int i = 0; i < 6; i++) {
        fake_world w;
        rig r;
        oracle_random dice = {(uint64_t)i + 3};
        tahr_vec3 n = normals[i % 3], start = fake_vec(0.1, 0.2, 1);
        tahr_config c;
        assert_int_equal(tahr_config_init(&c, sizeof c, i < 3 ? TAHR_PRESET_PRECISE : TAHR_PRESET_UNREAL), TAHR_OK);
        c.plane = n;
        furnish(&w);
        rig_open(&r, &w, &c, start);
        double walked = 0;
        for (int k = 0; k < 10000; k++) {
            wander(&dice, &r);
            tahr_vec3 before = r.state.position, v;
            rig_step(&r, 1.0 / 60);
            v = r.state.velocity;
            assert_true(fabs(off(n, r.state.position, start)) <= (i % 3 ? 1e-12 : 0));
            assert_true(fabs(n.x * v.x + n.y * v.y + n.z * v.z) <= 1e-12);
            walked += fabs(r.state.position.x - before.x);
            if (i < 3) {
                assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > -1e-9);
            }
        }
        assert_true(walked > 50);
        rig_close(&r);
    }
}

static void wishes_across_the_plane_are_nothing_and_the_rest_is_whole(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        tahr_config c = in_plane(fake_vec(0, 1, 0));
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0.3, 1));
        r.input.move = fake_vec(0, 1, 0);
        tahr_state before = r.state;
        rig_step(&r, 1 / rig_rates[i]);
        assert_memory_equal(&before, &r.state, sizeof before);
        r.input.move = fake_vec(1, 1, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 6 - 36 / (2 * 20.48), 1e-9);
        assert_near(r.state.position.y, 0.3, 0);
        rig_close(&r);
    }
}

static void a_wall_that_leans_across_the_plane_stops_it(void **unused)
{
    (void)unused;
    for (int air = 0; air < 2; air++) {
        for (int i = 0; i < RIG_RATES; i++) {
            fake_world w;
            rig r;
            tahr_config c = in_plane(fake_vec(0, 1, 0));
            fake_world_flat(&w);
            fake_add_plane(&w, fake_vec(-0.6, 0.8, 0), -0.6); /* through x = 1 at y = 0 */
            if (air) {
                c.gravity = fake_vec(0, 0, 0);
                rig_open(&r, &w, &c, fake_vec(0, 0, 3));
                r.state.velocity = fake_vec(3, 0, 0);
            } else {
                rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
            }
            r.input.move = fake_vec(1, 0, 0);
            rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
            assert_near(r.state.position.x, 1 - (RADIUS + SKIN) / 0.6, 1e-6);
            assert_near(r.state.position.y, 0, 0);
            assert_near(r.state.velocity.x, 0, 1e-9);
            rig_close(&r);
        }
    }
}

static void a_floor_that_leans_across_the_plane_is_walked_along(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = in_plane(fake_vec(0, 1, 0));
    const double angle = 30 * 3.14159265358979323846 / 180;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(0, sin(angle), cos(angle)), 0);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1.3));
    double z = r.state.position.z;
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.position.x, 6 - 36 / (2 * 20.48), 1e-9);
    assert_near(r.state.position.z, z, 1e-6);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_close(&r);
}

static void what_overlaps_pushes_within_the_plane(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = in_plane(fake_vec(0, 1, 0));
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    fake_add_plane(&w, fake_vec(-0.6, 0.8, 0), -(RADIUS - 0.03)); /* 3 cm deep: free of it 4 cm / 0.6 further back */
    assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.position.x, -0.04 / 0.6, 1e-9);
    assert_near(r.state.position.y, 0, 0);
    assert_int_equal(r.status, TAHR_OK);
    rig_close(&r);
}

static void what_overlaps_from_the_side_crushes_and_moves_nothing(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = in_plane(fake_vec(0, 1, 0));
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    fake_add_plane(&w, fake_vec(0, 1, 0), -(RADIUS - 0.03));
    assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
    tahr_vec3 before = r.state.position;
    rig_step(&r, 1.0 / 60);
    assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
    assert_near(r.report.residual, 0.03, 1e-9);
    assert_memory_equal(&before, &r.state.position, sizeof before);
    rig_close(&r);
}

static void seen_from_above_nothing_falls_jumps_or_steps(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = in_plane(fake_vec(0, 0, 1));
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(2, -3, 0), fake_vec(3, 3, 0.2));
    rig_open(&r, &w, &c, fake_vec(0, 0, 0.93));
    rig_steps(&r, 10, 1.0 / 60); /* in the air: weightless */
    assert_near(r.state.position.z, 0.93, 0);
    r.state.mode = TAHR_MODE_WALKING;
    r.input.flags = TAHR_INPUT_LAUNCH;
    r.input.launch = fake_vec(0, 2, 5);
    r.input.jump = 1;
    rig_step(&r, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_null(rig_event(&r, TAHR_EVENT_JUMPED));
    assert_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
    assert_true(r.state.position.y > 0);
    r.input.flags = r.input.jump = 0;
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.position.z, 0.93, 0);
    /* Its lower cap is a ball around z = 0.38; the box's edge is 0.18 m lower. */
    assert_near(r.state.position.x, 2 - sqrt((RADIUS + SKIN) * (RADIUS + SKIN) - 0.18 * 0.18), 1e-6);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_close(&r);
}

/* Gravity counts along the plane, and up is against that part of it. The character is righted about its foot, and the
 * plane stays where its centre was: 0.9 (1 - 0.6) m along the new up. */
static void gravity_counts_along_the_plane(void **unused)
{
    (void)unused;
    for (int given = 0; given < 2; given++) {
        fake_world w;
        rig r;
        tahr_config c = in_plane(fake_vec(0.6, 0, 0.8));
        fake_world_init(&w);
        rig_open(&r, &w, &c, fake_vec(0, 0, 10));
        r.input.flags = given ? TAHR_INPUT_GRAVITY : 0;
        r.input.gravity = fake_vec(0, 0, -G);
        rig_steps(&r, 60, 1.0 / 60);
        double along = 0.9 * 0.4 - 0.5 * 0.6 * G;
        assert_near(r.state.position.x, -0.8 * along, 1e-9);
        assert_near(r.state.position.z, 10 + 0.6 * along, 1e-9);
        assert_near(r.state.up.x, -0.8, 1e-12);
        assert_near(r.state.up.z, 0.6, 1e-12);
        rig_close(&r);
    }
}

static void in_the_plane_rest_repeats_and_sleeps(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = in_plane(fake_vec(0.6, 0.8, 0));
    furnish(&w);
    rig_stand(&r, &w, &c, fake_vec(0.1, 0.2, 1));
    tahr_report report;
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report;
    tahr_state before = r.state;
    r.input.move = fake_vec(0.6, 0.8, 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report), TAHR_OK);
    }
    assert_memory_equal(&before, &r.state, sizeof before);
    assert_true(report.flags & TAHR_REPORT_ASLEEP);
    rig_close(&r);
}

/* A conveyor that runs at 3 m/s across the plane: who lands on it runs along the plane and asks about nothing else, and
 * comes as far as on ground that stands. */
static void a_base_that_moves_across_the_plane_takes_nobody_along(void **unused)
{
    double came[2];
    (void)unused;
    for (int moving = 0; moving < 2; moving++) {
        static tahr_query_record queries[256];
        rig r;
        tahr_config c = in_plane(fake_vec(0, 1, 0));
        tahr_body_desc ground = native_box(fake_vec(0, 0, -1), fake_vec(50, 50, 1));
        ground.surface_velocity = fake_vec(0, moving ? 3 : 0, 0);
        rig_open_bodies(&r, &ground, 1, &c, fake_vec(0, 0, 2));
        for (int i = 0; i < 12; i++) { /* 0.1 s each: it lands in the midst of one */
            tahr_report report = {.struct_size = sizeof report, .queries = queries, .query_capacity = 256};
            r.input.move = fake_vec(i < 8 ? 1 : 0, 0, 0);
            r.input.jump = i == 9;
            assert_true(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, &report) >= 0);
            for (uint32_t k = 0; k < report.query_count; k++) {
                assert_near(queries[k].motion.y, 0, 0);
            }
        }
        came[moving] = r.state.position.x;
        rig_close(&r);
    }
    assert_true(came[0] > 2);
    assert_near(came[1], came[0], 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_leaves_the_plane_in_ten_thousand_steps),
                                       cmocka_unit_test(wishes_across_the_plane_are_nothing_and_the_rest_is_whole),
                                       cmocka_unit_test(a_wall_that_leans_across_the_plane_stops_it),
                                       cmocka_unit_test(a_floor_that_leans_across_the_plane_is_walked_along),
                                       cmocka_unit_test(what_overlaps_pushes_within_the_plane),
                                       cmocka_unit_test(what_overlaps_from_the_side_crushes_and_moves_nothing),
                                       cmocka_unit_test(seen_from_above_nothing_falls_jumps_or_steps),
                                       cmocka_unit_test(gravity_counts_along_the_plane),
                                       cmocka_unit_test(a_base_that_moves_across_the_plane_takes_nobody_along),
                                       cmocka_unit_test(in_the_plane_rest_repeats_and_sleeps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

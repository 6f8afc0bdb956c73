/* SPDX-License-Identifier: MIT
 * test_overlap.c: characters that overlap from the start, stand on heads, or ride side by side. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "throng.h"

/* Rounding of places of some 10 m. */
#define ROUNDING 1e-13

/* Capsules of radius 0.35 m, 0.5 m apart, are 0.2 m deep in each other: each leaves by its half of that, and then keeps
 * its skin to the plane between them. */
static void two_that_overlap_leave_half_and_half(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 2);
    throng_place(&t, 0, -0.25, 1);
    throng_place(&t, 1, 0.25, 1);
    throng_step(&t);
    assert_near(t.states[0].position.x, -0.25 - 0.1 - t.config.skin, ROUNDING);
    assert_near(t.states[1].position.x, 0.25 + 0.1 + t.config.skin, ROUNDING);
    assert_near(t.states[0].position.y, 1, ROUNDING);
    throng_close(&t);
}

/* Of 0.2 m the one of 80 kg takes 3 / 4, the one of 240 kg 1 / 4. */
static void the_heavier_one_leaves_less(void **unused)
{
    tahr_config configs[2];
    throng t;
    (void)unused;
    throng_open_ground(&t);
    configs[0] = configs[1] = t.config;
    configs[1].mass = 3 * configs[0].mass;
    t.desc.configs = configs;
    t.desc.config_count = 2;
    throng_make(&t, 2);
    t.members[1].config = 1;
    throng_place(&t, 0, -0.25, 1);
    throng_place(&t, 1, 0.25, 1);
    throng_step(&t);
    assert_near(t.states[0].position.x, -0.25 - 0.15 - t.config.skin, ROUNDING);
    assert_near(t.states[1].position.x, 0.25 + 0.05 + t.config.skin, ROUNDING);
    throng_close(&t);
}

static void two_in_one_place_part(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 2);
    throng_place(&t, 0, 3, 1);
    throng_place(&t, 1, 3, 1);
    throng_step(&t);
    assert_near(throng_gap(&t.states[0], &t.states[1]), 2 * t.config.skin, ROUNDING);
    assert_near(t.states[0].position.z, t.states[1].position.z, ROUNDING);
    throng_close(&t);
}

static void who_stands_at_a_wall_lets_the_other_one_leave(void **unused)
{
    tahr_body_desc b[2];
    throng t;
    (void)unused;
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = i ? (tahr_vec3){1, 10, 5} : (tahr_vec3){30, 30, 1};
        b[i].pose.position = i ? (tahr_vec3){-1, 0, 0} : (tahr_vec3){0, 0, -1};
    }
    throng_open(&t, b, 2);
    throng_make(&t, 2);
    throng_place(&t, 0, 0.36, 0); /* a skin from the wall */
    throng_place(&t, 1, 0.56, 0);
    for (int i = 0; i < 40; i++) {
        throng_step(&t);
        assert_true(throng_deeper(&t) < 1e-6);
        assert_true(t.states[0].position.x >= 0.35 + t.config.skin - ROUNDING);
    }
    assert_true(throng_least_gap(&t) >= 0);
    throng_close(&t);
}

static void twelve_in_one_place_part(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 12);
    for (uint32_t i = 0; i < 12; i++) {
        throng_place(&t, i, 0, 0);
    }
    for (int i = 0; i < 240; i++) {
        assert_true(throng_step(&t) >= 0);
    }
    assert_true(throng_least_gap(&t) >= -1e-6);
    throng_close(&t);
}

/* One stands at the origin, and another one comes down on it from above, this far off its middle. */
static void land_on_a_head(throng *t, uint32_t flags, double off)
{
    throng_open_ground(t);
    t->desc.flags = flags;
    throng_make(t, 2);
    throng_place(t, 0, 0, 0);
    throng_place(t, 1, off, 0);
    t->states[1].position.z += 2.5;
}

static void run(throng *t, int ticks)
{
    for (int i = 0; i < ticks; i++) {
        throng_step(t);
        assert_true(throng_least_gap(t) >= -1e-6);
    }
}

static void who_lands_on_a_head_stands_there_if_heads_hold(void **unused)
{
    throng t;
    (void)unused;
    land_on_a_head(&t, TAHR_CROWD_STAND_ON_HEADS, 0.05);
    run(&t, 90);
    const double skin = t.config.skin, gap = t.states[1].position.z - t.states[0].position.z - 1.8;
    assert_int_equal(t.states[1].mode, TAHR_MODE_WALKING);
    assert_int_equal(t.states[1].floor.body, TAHR_CHARACTER_BODY + 0);
    assert_int_equal(t.states[1].base.body, TAHR_NO_BODY);
    assert_true(gap >= skin - 1e-9 && gap <= t.config.floor_max * skin + 1e-9);
    /* The one below goes away from under it: its head is no floor any more. */
    throng_go(&t, 0, 1, 0);
    run(&t, 90);
    assert_true(t.states[0].position.x > 2);
    assert_int_equal(t.states[1].mode, TAHR_MODE_WALKING);
    assert_int_equal(t.states[1].floor.body, 0);
    throng_close(&t);
}

static void who_lands_on_a_head_slides_off_if_heads_do_not_hold(void **unused)
{
    throng t;
    (void)unused;
    land_on_a_head(&t, 0, 0.05);
    run(&t, 240);
    assert_int_equal(t.states[1].floor.body, 0);
    assert_int_equal(t.states[1].mode, TAHR_MODE_WALKING);
    assert_near(t.states[0].position.x, 0, 1e-9);
    throng_close(&t);
}

/* A slab that moves, and two on it a little more than a skin apart. */
static void ride(tahr_vec3 velocity)
{
    tahr_body_desc slab;
    throng t;
    tahr_body_desc_init(&slab, sizeof slab, TAHR_BODY_BOX);
    slab.half_extents = (tahr_vec3){5, 5, 0.5};
    slab.pose.position.z = -0.5;
    slab.flags = TAHR_BODY_MOVABLE;
    throng_open(&t, &slab, 1);
    throng_make(&t, 2);
    throng_place(&t, 0, 0, 0);
    throng_place(&t, 1, 0.711, 0);
    for (int i = 0; i < 30; i++) {
        throng_step(&t); /* both find their floor */
    }
    const tahr_vec3 from[2] = {t.states[0].position, t.states[1].position};
    for (int i = 1; i <= 60; i++) {
        const double time = i / 60.0;
        tahr_body_pose pose = {.pose = {{velocity.x * time, velocity.y * time, velocity.z * time - 0.5}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_world_move(t.world, &pose, 1, 1.0 / 60), TAHR_OK);
        throng_step(&t);
        for (int k = 0; k < 2; k++) {
            assert_near(t.states[k].position.x, from[k].x + velocity.x * time, 1e-9);
            assert_near(t.states[k].position.y, from[k].y + velocity.y * time, 1e-9);
            assert_near(t.states[k].position.z, from[k].z + velocity.z * time, 1e-9);
            assert_false(t.reports[k].flags & TAHR_REPORT_BASE_LOST);
        }
    }
    throng_close(&t);
}

static void two_side_by_side_ride_as_one_alone_does(void **unused)
{
    (void)unused;
    ride((tahr_vec3){7, 0, 0});
    ride((tahr_vec3){-7, 3, 0});
    ride((tahr_vec3){0, 0, 2});
    ride((tahr_vec3){3, 0, -1});
}

static void who_rides_into_another_one_pushes_him_along(void **unused)
{
    tahr_body_desc slab;
    throng t;
    (void)unused;
    tahr_body_desc_init(&slab, sizeof slab, TAHR_BODY_BOX);
    slab.half_extents = (tahr_vec3){5, 5, 0.5};
    slab.pose.position.z = -0.5;
    slab.flags = TAHR_BODY_MOVABLE;
    throng_open(&t, &slab, 1);
    throng_make(&t, 2);
    throng_place(&t, 0, 0, 0);
    throng_place(&t, 1, 1.2, 0);
    t.states[1].mode = TAHR_MODE_FLYING; /* hovers, and is not carried */
    t.states[1].position.z += 0.5;
    for (int i = 1; i <= 60; i++) {
        tahr_body_pose pose = {.pose = {{0.05 * i, 0, -0.5}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_world_move(t.world, &pose, 1, 1.0 / 60), TAHR_OK);
        throng_step(&t);
        assert_true(throng_least_gap(&t) >= -1e-6);
    }
    assert_true(t.states[1].position.x > t.states[0].position.x + 0.7);
    assert_true(t.states[1].position.x > 2);
    throng_close(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_that_overlap_leave_half_and_half),
        cmocka_unit_test(the_heavier_one_leaves_less),
        cmocka_unit_test(two_in_one_place_part),
        cmocka_unit_test(who_stands_at_a_wall_lets_the_other_one_leave),
        cmocka_unit_test(twelve_in_one_place_part),
        cmocka_unit_test(who_lands_on_a_head_stands_there_if_heads_hold),
        cmocka_unit_test(who_lands_on_a_head_slides_off_if_heads_do_not_hold),
        cmocka_unit_test(two_side_by_side_ride_as_one_alone_does),
        cmocka_unit_test(who_rides_into_another_one_pushes_him_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

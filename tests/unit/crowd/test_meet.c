/* SPDX-License-Identifier: MIT
 * test_meet.c: characters that meet: nobody enters another, whatever the crush. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "near.h"
#include "throng.h"

/* Rounding of places of some 100 m, and of a few dozen operations on them. */
#define ROUNDING 1e-12

static void head_on_two_stop_a_skin_apart(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 2);
    throng_place(&t, 0, -2, 0.1);
    throng_place(&t, 1, 2, 0.1);
    for (int i = 0; i < 120; i++) {
        throng_go(&t, 0, 1, 0);
        throng_go(&t, 1, -1, 0);
        throng_step(&t);
        assert_true(throng_least_gap(&t) >= t.config.skin - ROUNDING);
    }
    assert_near(throng_least_gap(&t), t.config.skin, ROUNDING);
    assert_near(t.states[0].position.x, -t.states[1].position.x, ROUNDING);
    assert_true(fabs(t.states[0].velocity.x) < ROUNDING);
    throng_close(&t);
}

static void two_pass_each_other_in_a_corridor_two_wide(void **unused)
{
    tahr_body_desc b[3];
    throng t;
    (void)unused;
    for (int i = 0; i < 3; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = (tahr_vec3){30, 1, i ? 3 : 1};
        b[i].half_extents.y = i ? 1 : 4;
    }
    b[0].pose.position.z = -1;
    b[1].pose.position.y = -1.8; /* walls at y = +-0.8: two of 0.7 m and three skins fit */
    b[2].pose.position.y = 1.8;
    throng_open(&t, b, 3);
    throng_make(&t, 2);
    throng_place(&t, 0, -3, 0.1);
    throng_place(&t, 1, 3, -0.1);
    for (int i = 0; i < 240; i++) {
        throng_go(&t, 0, 1, 0);
        throng_go(&t, 1, -1, 0);
        throng_step(&t);
        assert_true(throng_least_gap(&t) >= t.config.skin - ROUNDING);
        for (int k = 0; k < 2; k++) {
            assert_true(fabs(t.states[k].position.y) <= 0.8 - 0.35 + ROUNDING);
        }
    }
    assert_true(t.states[0].position.x > 3 && t.states[1].position.x < -3);
    throng_close(&t);
}

/* Who follows at the same speed is not slowed: each tick the other one has left by then the room that he needs. */
static void follower_keeps_speed_one_step_behind(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 2);
    throng_place(&t, 0, 0, 0);
    const double step = t.config.max_speed / 60;
    throng_place(&t, 1, -(0.7 + t.config.skin + 1.01 * step), 0);
    for (int k = 0; k < 2; k++) {
        throng_go(&t, (uint32_t)k, 1, 0);
        t.states[k].velocity.x = t.config.max_speed;
    }
    for (int i = 0; i < 120; i++) {
        throng_step(&t);
        if (i > 2) { /* both have found the floor */
            assert_near(t.states[1].velocity.x, t.states[0].velocity.x, 1e-9);
        }
        assert_true(throng_least_gap(&t) >= t.config.skin - ROUNDING);
    }
    throng_close(&t);
}

/* A doorway 1.2 m wide at x = 0 in a wall across a room; count characters before it want to go through for so many
 * ticks. Returns how many did. A quarter of the time everybody gives way: who does not holds arches for ever. */
static uint32_t press_through_doorway(uint32_t count, int ticks)
{
    tahr_body_desc b[5];
    throng t;
    for (int i = 0; i < 5; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = (tahr_vec3){0.2, 10, 3};
    }
    b[0].half_extents = (tahr_vec3){40, 40, 1};
    b[0].pose.position.z = -1;
    b[1].pose.position.y = -10.6;
    b[2].pose.position.y = 10.6;
    b[3].half_extents = b[4].half_extents = (tahr_vec3){20, 0.2, 3};
    b[3].pose.position.y = -8;
    b[4].pose.position.y = 8;
    throng_open(&t, b, 5);
    throng_make(&t, count);
    for (uint32_t i = 0; i < count; i++) {
        throng_place(&t, i, -10 + 0.9 * (i % 10), 0.9 * (i / 10) - 4);
    }
    uint32_t through = 0;
    for (int i = 0; i < ticks; i++) {
        for (uint32_t k = 0; k < count; k++) {
            const tahr_vec3 p = t.states[k].position;
            const double d = hypot(p.x, p.y);
            const int past = p.x > -0.3, yields = (k * 7 + (uint32_t)i / 20 * 13) % 4 == 0;
            throng_go(&t, k, past ? 1 : (yields ? p.x : -p.x) / d, past ? 0 : -p.y / d);
        }
        assert_true(throng_step(&t) >= 0);
        if (i % 4 == 3) {
            assert_true(throng_least_gap(&t) >= -1e-6);
        }
        for (uint32_t k = 0; k < count; k++) {
            const tahr_vec3 p = t.states[k].position;
            assert_true(p.z > 0.9 - ROUNDING && fabs(p.y) < 7.8 - 0.35 + ROUNDING);
            assert_true(fabs(p.x) > 0.2 || fabs(p.y) < 0.6 - 0.35 + ROUNDING); /* inside of no door post */
        }
    }
    for (uint32_t k = 0; k < count; k++) {
        through += t.states[k].position.x > 0.55;
    }
    throng_close(&t);
    return through;
}

static void hundred_press_on_a_doorway(void **unused)
{
    (void)unused;
    press_through_doorway(100, 240);
}

static void ten_pass_a_doorway(void **unused)
{
    (void)unused;
    assert_int_equal(press_through_doorway(10, 600), 10);
}

static void press_on_one_point(uint32_t count, int ticks, double width)
{
    throng t;
    throng_open_ground(&t);
    throng_make(&t, count);
    const uint32_t row = (uint32_t)ceil(sqrt(count));
    for (uint32_t i = 0; i < count; i++) {
        throng_place(&t, i, (i % row - 0.5 * row) * width + 0.001 * (i % 7), (i / row - 0.5 * row) * width);
    }
    for (int i = 0; i < ticks; i++) {
        for (uint32_t k = 0; k < count; k++) {
            const tahr_vec3 p = t.states[k].position;
            const double d = fmax(hypot(p.x, p.y), 1e-9);
            throng_go(&t, k, -p.x / d, -p.y / d);
        }
        assert_true(throng_step(&t) >= 0);
        if (i % 8 == 7 || i == ticks - 1) {
            assert_true(throng_least_gap(&t) >= -1e-6);
        }
    }
    throng_close(&t);
}

static void thousand_press_on_one_point(void **unused)
{
    (void)unused;
    press_on_one_point(1000, 48, 0.78);
}

static void small_and_large_keep_apart(void **unused)
{
    tahr_config configs[3];
    throng t;
    (void)unused;
    throng_open_ground(&t);
    for (int i = 0; i < 3; i++) {
        configs[i] = t.config;
    }
    configs[1].shape.radius = 0.1;
    configs[1].shape.half_height = 0.2;
    configs[1].step_height = configs[1].snap_distance = 0.1;
    configs[1].skin = 0.004;
    configs[1].crouched_half_height = 0.15;
    configs[2].shape.radius = 1.5;
    configs[2].shape.half_height = 4;
    configs[2].crouched_half_height = 2;
    t.desc.configs = configs;
    t.desc.config_count = 3;
    throng_make(&t, 90);
    for (uint32_t i = 0; i < 90; i++) {
        t.members[i].config = i == 0 ? 2 : i % 2;
        throng_place(&t, i, i == 0 ? 0 : 3 + i % 9 * 0.8, i == 0 ? 0 : i / 9 * 0.8 - 4);
    }
    for (int i = 0; i < 150; i++) {
        for (uint32_t k = 0; k < 90; k++) {
            throng_go(&t, k, k == 0 ? 1 : -1, 0);
        }
        assert_true(throng_step(&t) >= 0);
        double least = INFINITY;
        for (uint32_t k = 0; k < 90; k++) {
            for (uint32_t j = 0; j < k; j++) {
                least = fmin(least, throng_gap(&t.states[k], &t.states[j]));
            }
        }
        assert_true(least >= -1e-6);
    }
    throng_close(&t);
}

static void groups_and_masks_say_who_meets_whom(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 8);
    for (uint32_t i = 0; i < 8; i++) {
        throng_place(&t, i, i % 2 ? 2 : -2, i / 2 * 3.0);
        throng_go(&t, i, i % 2 ? -1 : 1, 0);
    }
    t.members[2].groups = t.members[3].groups = 2; /* each is in a group that the other one's mask lacks */
    t.members[2].mask = t.members[3].mask = 1;
    t.members[4].mask = 6; /* one of the two does not meet the other: neither does */
    t.members[6].flags = TAHR_MEMBER_ALONE;
    for (int i = 0; i < 90; i++) {
        throng_step(&t);
    }
    assert_true(t.states[0].position.x < 0);
    for (int k = 2; k < 8; k += 2) {
        assert_true(t.states[k].position.x > 1);
    }
    throng_close(&t);
}

/* An engine of the user's own: the plane z = 0, and nothing but a sweep. */
static tahr_status sweep_plane(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    const double gap = q->position.z - q->shape.half_height - q->margin, drop = -q->motion.z;
    (void)user;
    hit->normal = (tahr_vec3){0, 0, 1};
    if (gap < -q->margin) {
        hit->start_overlap = 1;
        hit->depth = -gap - q->margin;
    } else if (drop > 0 && gap <= drop) {
        hit->blocking = 1;
        hit->fraction = gap > 0 ? gap / drop : 0;
    }
    return TAHR_OK;
}

static void over_callbacks_two_meet_too(void **unused)
{
    const tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .sweep = sweep_plane};
    throng t;
    double nearest = INFINITY;
    (void)unused;
    throng_open_ground(&t);
    tahr_world_close(t.world);
    assert_int_equal(tahr_world_open_callbacks(&callbacks, NULL, &t.world), TAHR_OK);
    throng_make(&t, 3);
    throng_place(&t, 0, -2, 0.05);
    throng_place(&t, 1, 2, 0);
    throng_place(&t, 2, 2.3, 0.1); /* overlaps the second one, and a sweep alone tells no contacts */
    for (int i = 0; i < 120; i++) {
        throng_go(&t, 0, 1, 0);
        throng_go(&t, 1, -1, 0);
        throng_go(&t, 2, -1, 0);
        assert_int_equal(throng_step(&t), TAHR_OK);
        assert_true(i == 0 || throng_least_gap(&t) >= t.config.skin - ROUNDING);
        nearest = fmin(nearest, throng_least_gap(&t));
    }
    assert_near(nearest, t.config.skin, 1e-6); /* they did meet */
    throng_close(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(head_on_two_stop_a_skin_apart),
        cmocka_unit_test(two_pass_each_other_in_a_corridor_two_wide),
        cmocka_unit_test(follower_keeps_speed_one_step_behind),
        cmocka_unit_test(hundred_press_on_a_doorway),
        cmocka_unit_test(ten_pass_a_doorway),
        cmocka_unit_test(thousand_press_on_one_point),
        cmocka_unit_test(small_and_large_keep_apart),
        cmocka_unit_test(groups_and_masks_say_who_meets_whom),
        cmocka_unit_test(over_callbacks_two_meet_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_turning.c: up follows gravity about the foot, is refused under a ceiling; facing turns at its rate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static double yaw(const tahr_state *s)
{
    tahr_quat q = s->orientation;
    return atan2(2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.y * q.y + q.z * q.z));
}

static void open_flat(rig *r, fake_world *w)
{
    fake_world_flat(w);
    rig_stand(r, w, NULL, fake_vec(0, 0, 1));
}

static void facing_turns_at_the_turn_rate_and_stops_at_the_goal(void **unused)
{
    const double goals[] = {0.1, 1, 2, 3.1, -0.5, -3.1};
    fake_world w;
    (void)unused;
    for (int g = 0; g < 6; g++) {
        rig r;
        open_flat(&r, &w);
        r.input.flags = TAHR_INPUT_FACING;
        r.input.facing = fake_vec(3 * cos(goals[g]), 3 * sin(goals[g]), 7);
        double turned = 0;
        for (int i = 0; i < 60; i++) {
            rig_step(&r, 1.0 / 60);
            turned = fmin(turned + 12.5 / 60, fabs(goals[g]));
            assert_near(yaw(&r.state), goals[g] < 0 ? -turned : turned, 1e-9);
        }
        tahr_quat q = r.state.orientation;
        assert_near(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-14);
        assert_true(r.state.position.x == 0 && r.state.mode == TAHR_MODE_WALKING);
        rig_close(&r);
    }
}

static void facing_backward_and_facing_up_are_harmless(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_flat(&r, &w);
    r.input.flags = TAHR_INPUT_FACING;
    r.input.facing = fake_vec(-1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(fabs(yaw(&r.state)), acos(-1.0), 1e-6);
    r.input.facing = fake_vec(0, 0, 1);
    double before = yaw(&r.state);
    rig_step(&r, 1.0 / 60);
    assert_near(yaw(&r.state), before, 0);
    r.input.facing = fake_vec(0, 0, 0);
    rig_step(&r, 1.0 / 60);
    assert_near(yaw(&r.state), before, 0);
    rig_close(&r);
}

static void one_long_step_turns_as_far_as_many_short_ones(void **unused)
{
    fake_world w;
    rig a, b;
    (void)unused;
    open_flat(&a, &w);
    open_flat(&b, &w);
    a.input.flags = b.input.flags = TAHR_INPUT_FACING;
    a.input.facing = b.input.facing = fake_vec(cos(2.5), sin(2.5), 0);
    rig_step(&a, 0.1);
    rig_steps(&b, 10, 0.01);
    assert_near(yaw(&a.state), 1.25, 1e-12);
    assert_near(yaw(&b.state), 1.25, 1e-12);
    rig_step(&a, 1);
    assert_near(yaw(&a.state), 2.5, 1e-12);
    rig_close(&a);
    rig_close(&b);
}

static void up_follows_gravity_about_the_foot(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 10));
    r.input.flags = TAHR_INPUT_GRAVITY;
    r.input.gravity = fake_vec(1e-5, 0, 0); /* weak, but it has a direction */
    rig_step(&r, 1e-6);
    assert_near(r.state.up.x, -1, 1e-12);
    assert_near(r.state.position.x, -0.9, 1e-6);
    assert_near(r.state.position.z, 9.1, 1e-6);
    tahr_quat q = r.state.orientation; /* its z axis is up */
    assert_near(2 * (q.x * q.z + q.w * q.y), -1, 1e-12);
    rig_close(&r);
}

static void weightlessness_keeps_up(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 10));
    r.input.flags = TAHR_INPUT_GRAVITY;
    r.input.gravity = fake_vec(1e-9, 0, 0);
    rig_step(&r, 0.1);
    assert_true(r.state.up.z == 1);
    rig_close(&r);
}

static void up_is_refused_where_the_turned_shape_would_overlap(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -0.5);
    fake_add_plane(&w, fake_vec(1, 0, 0), -0.5); /* a shaft, too narrow to lie in */
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.flags = TAHR_INPUT_GRAVITY;
    r.input.gravity = fake_vec(9.81, 0, 0);
    rig_step(&r, 1.0 / 60);
    assert_true(r.report.flags & TAHR_REPORT_UP_REFUSED);
    assert_true(r.state.up.z == 1);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
    rig_close(&r);
}

static void turning_gravity_upside_down_walks_on_the_ceiling(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(0, 0, -1), -6);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 3));
    r.input.flags = TAHR_INPUT_GRAVITY;
    r.input.gravity = fake_vec(0, 0, 9.81);
    rig_steps(&r, 180, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_near(r.state.position.z, 6 - 0.9125, 0.0026);
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.position.x, 6 - 36 / (2 * 20.48), 1e-6);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(facing_turns_at_the_turn_rate_and_stops_at_the_goal),
                                       cmocka_unit_test(facing_backward_and_facing_up_are_harmless),
                                       cmocka_unit_test(one_long_step_turns_as_far_as_many_short_ones),
                                       cmocka_unit_test(up_follows_gravity_about_the_foot),
                                       cmocka_unit_test(weightlessness_keeps_up),
                                       cmocka_unit_test(up_is_refused_where_the_turned_shape_would_overlap),
                                       cmocka_unit_test(turning_gravity_upside_down_walks_on_the_ceiling)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

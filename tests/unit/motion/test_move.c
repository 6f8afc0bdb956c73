/* SPDX-License-Identifier: MIT
 * test_move.c: getting out of overlaps: one plane, a corner, a corridor that is too narrow, the limit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static void overlap_with_one_plane_is_left_by_the_shortest_way(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), 0);
    rig_open(&r, &w, NULL, fake_vec(-0.25, 1, 2)); /* 0.1 m in */
    rig_step(&r, 1e-3);
    assert_near(r.state.position.x, -0.36, 1e-9);
    assert_near(r.state.position.y, 1, 1e-12);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_DEPENETRATED);
    assert_non_null(e);
    assert_near(e->value, 0.11, 1e-9);
    assert_int_equal(e->body, 0);
    assert_int_equal(r.report.flags & TAHR_REPORT_CRUSHED, 0);
    assert_int_equal(r.status, TAHR_OK);
    const tahr_decision *d = rig_decision(&r, TAHR_RULE_DEPENETRATION);
    assert_true(d && d->accepted);
    rig_close(&r);
}

static void overlap_in_a_corner_is_left_at_once(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(1, 0, 0), 0);
    fake_add_plane(&w, fake_vec(0.6, 0.8, 0), 0);
    fake_add_plane(&w, fake_vec(0, 0, 1), -5);
    rig_open(&r, &w, NULL, fake_vec(0.3, 0.05, 2));
    rig_step(&r, 1e-3);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) >= 0.01 - 1e-9);
    assert_int_equal(r.report.flags & TAHR_REPORT_CRUSHED, 0);
    rig_close(&r);
}

static void too_narrow_a_corridor_halves_the_overlap_and_says_crushed(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(1, 0, 0), -0.33);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -0.33);
    fake_add_plane(&w, fake_vec(0, 0, 1), 0);
    rig_open(&r, &w, NULL, fake_vec(0.003, 0, 0.9125));
    r.state.mode = TAHR_MODE_WALKING;
    r.input.move = fake_vec(0, 1, 0);
    for (int i = 0; i < 20; i++) {
        rig_step(&r, 1.0 / 60);
        assert_near(r.state.position.x, 0, 1e-6); /* no tug of war */
        assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
        assert_true(r.status >= TAHR_STUCK);
        assert_near(r.report.residual, 0.02, 1e-6);
        assert_non_null(rig_event(&r, TAHR_EVENT_CRUSHED));
    }
    rig_close(&r);
}

/* Three walls on one side outweigh the one on the other: the least-squares push would go on past the middle. */
static void a_push_that_makes_it_worse_is_not_taken(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(1, 0, 0), -0.3);
    for (int i = -1; i <= 1; i++) {
        fake_add_plane(&w, fake_vec(-cos(0.05 * i), sin(0.05 * i), 0), -0.3);
    }
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0.9125)); /* 0.05 m in all four */
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.position.x, 0, 0);
    assert_near(r.state.position.y, 0, 0);
    assert_null(rig_event(&r, TAHR_EVENT_DEPENETRATED));
    assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
    assert_near(r.report.residual, 0.05, 1e-12);
    rig_close(&r);
}

static void sensors_do_not_push(void **unused)
{
    tahr_body_desc bodies[2];
    rig r;
    (void)unused;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX), TAHR_OK);
        bodies[i].half_extents = fake_vec(5, 5, 1);
    }
    bodies[0].pose.position = fake_vec(0, 0, -1);
    bodies[1].pose.position = fake_vec(5.2, 0, 0.5); /* 0.15 m in, which is deeper than the floor */
    bodies[1].flags = TAHR_BODY_SENSOR;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 0.85));
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.position.x, 0, 0);
    assert_near(r.state.position.z, 0.91, 0.006);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_DEPENETRATED);
    assert_true(e && e->body == 0);
    rig_close(&r);
}

static void push_is_limited_per_step_and_goes_on_in_the_next(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    (void)unused;
    c.max_depenetration = 0.1;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), 0);
    rig_open(&r, &w, &c, fake_vec(-0.1, 0, 2)); /* 0.25 m in */
    rig_step(&r, 1e-4);
    assert_near(r.state.position.x, -0.2, 1e-9);
    assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
    rig_step(&r, 1e-4);
    rig_step(&r, 1e-4);
    assert_near(r.state.position.x, -0.36, 1e-9);
    rig_step(&r, 1e-4);
    assert_int_equal(r.report.flags & TAHR_REPORT_CRUSHED, 0);
    rig_close(&r);
}

static void standing_character_that_something_entered_is_pushed_out(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -1);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    w.solids[1].offset = -0.2; /* the wall came 0.15 m into the character */
    tahr_world_touch(r.world);
    rig_steps(&r, 3, 1.0 / 60);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) >= 0.01 - 1e-6);
    rig_close(&r);
}

static void floor_that_rose_into_the_character_lifts_it(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    w.solids[0].offset = 0.1;
    tahr_world_touch(r.world);
    rig_steps(&r, 3, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) >= 0.01 - 1e-6);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(overlap_with_one_plane_is_left_by_the_shortest_way),
                                       cmocka_unit_test(overlap_in_a_corner_is_left_at_once),
                                       cmocka_unit_test(too_narrow_a_corridor_halves_the_overlap_and_says_crushed),
                                       cmocka_unit_test(a_push_that_makes_it_worse_is_not_taken),
                                       cmocka_unit_test(sensors_do_not_push),
                                       cmocka_unit_test(push_is_limited_per_step_and_goes_on_in_the_next),
                                       cmocka_unit_test(standing_character_that_something_entered_is_pushed_out),
                                       cmocka_unit_test(floor_that_rose_into_the_character_lifts_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

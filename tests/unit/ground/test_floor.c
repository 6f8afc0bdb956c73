/* SPDX-License-Identifier: MIT
 * test_floor.c: what can be stood on: limits and overrides, hysteresis, rims, perches, wedges, the height band. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static const double DEGREE = 0.017453292519943295;

/* Drops a character onto a slope: does it stand after two seconds? */
static int stands_on(double degrees, uint32_t rule, double rule_degrees)
{
    fake_world w;
    rig r;
    fake_world_init(&w);
    fake_solid *s = fake_add_slope(&w, degrees);
    s->walkable_rule = rule;
    s->walkable_angle = rule_degrees * DEGREE;
    rig_open(&r, &w, NULL, fake_vec(0, 0, 2));
    rig_steps(&r, 120, 1.0 / 60);
    int stands = r.state.mode == TAHR_MODE_WALKING;
    rig_close(&r);
    return stands;
}

static void slopes_are_walkable_up_to_the_limit(void **unused)
{
    (void)unused;
    assert_true(stands_on(0, TAHR_WALKABLE_DEFAULT, 0));
    assert_true(stands_on(49.5, TAHR_WALKABLE_DEFAULT, 0));
    assert_true(stands_on(49.999, TAHR_WALKABLE_DEFAULT, 0));
    assert_false(stands_on(50.001, TAHR_WALKABLE_DEFAULT, 0));
    assert_false(stands_on(50.5, TAHR_WALKABLE_DEFAULT, 0));
    assert_false(stands_on(51.5, TAHR_WALKABLE_DEFAULT, 0));
}

static void overrides_widen_narrow_or_forbid(void **unused)
{
    (void)unused;
    assert_true(stands_on(60, TAHR_WALKABLE_INCREASE, 65));
    assert_false(stands_on(70, TAHR_WALKABLE_INCREASE, 65));
    assert_true(stands_on(45, TAHR_WALKABLE_INCREASE, 10)); /* only widens */
    assert_true(stands_on(60, TAHR_WALKABLE_INCREASE, 90));
    assert_true(stands_on(75, TAHR_WALKABLE_INCREASE, 90));
    assert_false(stands_on(30, TAHR_WALKABLE_DECREASE, 20));
    assert_true(stands_on(15, TAHR_WALKABLE_DECREASE, 20));
    assert_false(stands_on(60, TAHR_WALKABLE_DECREASE, 80)); /* only narrows */
    assert_true(stands_on(0, TAHR_WALKABLE_DECREASE, 0));
    assert_false(stands_on(1, TAHR_WALKABLE_DECREASE, 0));
    assert_false(stands_on(0, TAHR_WALKABLE_NEVER, 0));
}

static void override_angles_beyond_a_right_angle_are_taken_as_one(void **unused)
{
    (void)unused;
    assert_true(stands_on(75, TAHR_WALKABLE_INCREASE, 200));
    assert_true(stands_on(45, TAHR_WALKABLE_INCREASE, -30));
}

static void walkable_floor_gets_the_hysteresis_and_loses_it_beyond(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    fake_add_slope(&w, 49.9);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 2));
    w.count = 0;
    fake_add_slope(&w, 50.5); /* the ground tilts */
    tahr_world_touch(r.world);
    rig_steps(&r, 10, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    w.count = 0;
    fake_add_slope(&w, 51.2);
    tahr_world_touch(r.world);
    rig_steps(&r, 10, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    rig_close(&r);
}

/* Stands on a slope that is then another one: is that still a floor? */
static int floor_stays(double degrees, double then, int other_body)
{
    fake_world w;
    rig r;
    fake_world_init(&w);
    fake_add_slope(&w, degrees);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 2));
    w.count = 0;
    if (other_body) {
        fake_add_box(&w, fake_vec(90, 90, 90), fake_vec(91, 91, 91));
    }
    fake_add_slope(&w, then)->offset = -0.02; /* no overlap */
    tahr_world_touch(r.world);
    rig_steps(&r, 10, 1.0 / 60);
    int stays = r.state.mode == TAHR_MODE_WALKING;
    rig_close(&r);
    return stays;
}

static void another_face_gets_no_hysteresis(void **unused)
{
    (void)unused;
    assert_true(floor_stays(49.9, 50.5, 0));
    assert_false(floor_stays(49.9, 50.5, 1));
    assert_false(floor_stays(49, 50.5, 0)); /* the body may have many faces */
    assert_true(floor_stays(49, 49.9, 1));
}

/* Flat ground that meets a slope at x = 0. */
static void too_steep_slopes_are_walls_to_one_who_comes_from_flat_ground(void **unused)
{
    const double degrees[] = {49.5, 50.5, 51.5};
    (void)unused;
    for (int i = 0; i < 3; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_slope(&w, degrees[i]);
        rig_stand(&r, &w, NULL, fake_vec(-2, 0, 1));
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, 90, 1.0 / 60);
        assert_true(i == 0 ? r.state.position.z > 2 : r.state.position.z < 0.95);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
        rig_close(&r);
    }
}

static int stands_over_edge(double overhang, double lower_floor)
{
    fake_world w;
    rig r;
    fake_world_init(&w);
    fake_add_box(&w, fake_vec(-5, -5, -1), fake_vec(0, 5, 0));
    fake_add_plane(&w, fake_vec(0, 0, 1), -lower_floor);
    rig_open(&r, &w, NULL, fake_vec(overhang, 0, 1));
    rig_steps(&r, 120, 1.0 / 60);
    int stands = r.state.mode == TAHR_MODE_WALKING && r.state.position.z > 0.5 && r.state.position.x == overhang;
    rig_close(&r);
    return stands;
}

/* Perch threshold 0.15 of radius 0.35: the foot holds up to 0.2 m over the edge, beyond that only with a floor
 * below. */
static void perching_ends_where_the_thinner_foot_leaves_the_edge(void **unused)
{
    (void)unused;
    assert_true(stands_over_edge(-1, 10));
    assert_true(stands_over_edge(0, 10));
    assert_true(stands_over_edge(0.1, 10));
    assert_true(stands_over_edge(0.19, 10));
    assert_false(stands_over_edge(0.21, 10));
    assert_false(stands_over_edge(0.3, 10));
    assert_false(stands_over_edge(0.349, 10));
    assert_true(stands_over_edge(0.3, 0.5));
    assert_false(stands_over_edge(0.3, 2));
}

static void rim_contacts_are_no_floor(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    /* A post beside the foot whose top is met by the outermost hundredth of a millimetre of the shape plus skin. */
    fake_add_box(&w, fake_vec(0.35 + 0.01 - 1e-5, -1, 0), fake_vec(2, 1, 0.6));
    rig_open(&r, &w, NULL, fake_vec(0, 0, 2));
    rig_steps(&r, 180, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_true(r.state.position.z < 0.95);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
    rig_close(&r);
}

static void wedge(fake_world *w, double degrees)
{
    double a = degrees * DEGREE;
    fake_world_init(w);
    fake_add_plane(w, fake_vec(-sin(a), 0, cos(a)), 0);
    fake_add_plane(w, fake_vec(sin(a), 0, cos(a)), 0);
}

static void wedge_of_two_steep_faces_holds_and_lets_jump(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    wedge(&w, 60);
    rig_stand(&r, &w, NULL, fake_vec(0.1, 0, 3));
    assert_true(r.state.floor.flags & TAHR_FLOOR_WEDGED);
    assert_near(r.state.position.x, 0, 1e-3);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
    tahr_vec3 rest = r.state.position;
    r.input.jump = 1;
    rig_steps(&r, 10, 1.0 / 60);
    assert_true(r.state.position.z > rest.z + 0.3);
    rig_close(&r);
}

static void wedge_lets_walk_along_it(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    wedge(&w, 60);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 3));
    r.input.move = fake_vec(0, 1, 0);
    rig_steps(&r, 120, 1.0 / 60);
    assert_true(r.state.position.y > 6);
    assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
    rig_close(&r);
}

static void height_band_is_left_alone_and_corrected_outside(void **unused)
{
    const double gaps[] = {0.01, 0.0125, 0.0149999};
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    for (int i = 0; i < 3; i++) {
        rig_open(&r, &w, NULL, fake_vec(0, 0, 0.9 + gaps[i]));
        r.state.mode = TAHR_MODE_WALKING;
        rig_steps(&r, 3, 1.0 / 60);
        assert_true(r.state.position.z == 0.9 + gaps[i]);
        rig_close(&r);
    }
    const double off[] = {0.005, 0.0151, 0.1, 0.39};
    for (int i = 0; i < 4; i++) {
        rig_open(&r, &w, NULL, fake_vec(0, 0, 0.9 + off[i]));
        r.state.mode = TAHR_MODE_WALKING;
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.position.z, 0.9125, 1e-9);
        rig_close(&r);
    }
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0.9 + 0.45)); /* farther than the snap */
    r.state.mode = TAHR_MODE_WALKING;
    rig_step(&r, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    rig_close(&r);
}

static void decisions_give_value_limit_and_reason(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    fake_add_slope(&w, 60)->surface = 5;
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1.3));
    rig_steps(&r, 2, 1.0 / 60);
    const tahr_decision *d = NULL;
    for (int i = 0; i < 60 && !d; i++) {
        rig_step(&r, 1.0 / 60);
        d = rig_decision(&r, TAHR_RULE_WALKABLE);
    }
    assert_non_null(d);
    assert_int_equal(d->accepted, 0);
    assert_int_equal(d->body, 0);
    assert_near(d->value, 0.5, 1e-12);
    assert_near(d->limit, cos(50 * DEGREE), 1e-15);
    assert_non_null(d->reason);
    d = rig_decision(&r, TAHR_RULE_LANDING);
    assert_non_null(d);
    assert_int_equal(d->accepted, 0);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_walkable_up_to_the_limit),
                                       cmocka_unit_test(overrides_widen_narrow_or_forbid),
                                       cmocka_unit_test(override_angles_beyond_a_right_angle_are_taken_as_one),
                                       cmocka_unit_test(walkable_floor_gets_the_hysteresis_and_loses_it_beyond),
                                       cmocka_unit_test(another_face_gets_no_hysteresis),
                                       cmocka_unit_test(too_steep_slopes_are_walls_to_one_who_comes_from_flat_ground),
                                       cmocka_unit_test(perching_ends_where_the_thinner_foot_leaves_the_edge),
                                       cmocka_unit_test(rim_contacts_are_no_floor),
                                       cmocka_unit_test(wedge_of_two_steep_faces_holds_and_lets_jump),
                                       cmocka_unit_test(wedge_lets_walk_along_it),
                                       cmocka_unit_test(height_band_is_left_alone_and_corrected_outside),
                                       cmocka_unit_test(decisions_give_value_limit_and_reason)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_config.c: presets, scaling, and the check of every field. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static void init_fills_the_preset_and_reports_wrong_use(void **unused)
{
    tahr_config c, before;
    (void)unused;
    memset(&c, 0x5A, sizeof c);
    before = c;
    assert_int_equal(tahr_config_init(NULL, sizeof c, TAHR_PRESET_PRECISE), TAHR_E_NULL);
    assert_int_equal(tahr_config_init(&c, sizeof c - 1, TAHR_PRESET_PRECISE), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_config_init(&c, 0, TAHR_PRESET_PRECISE), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_config_init(&c, sizeof c, 0), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_config_init(&c, sizeof c, 77), TAHR_E_ARGUMENT);
    assert_memory_equal(&c, &before, sizeof c);
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
    assert_int_equal(c.struct_size, sizeof c);
    assert_true(c.shape.radius == 0.35 && c.shape.half_height == 0.9 && c.skin == 0.01 && c.step_height == 0.4);
    assert_true(c.max_speed == 6 && c.gravity.z == -9.81 && c.jump_speed == 4.2 && c.max_slides == 8);
    assert_near(c.walkable_angle, 50 * acos(-1.0) / 180, 1e-15);
}

static void a_longer_struct_is_accepted_only_with_a_zero_tail(void **unused)
{
    struct {
        tahr_config c;
        unsigned char tail[24];
    } longer;
    const char *field = "untouched";
    (void)unused;
    memset(&longer, 0xFF, sizeof longer);
    assert_int_equal(tahr_config_init(&longer.c, sizeof longer, TAHR_PRESET_PRECISE), TAHR_OK);
    assert_int_equal(longer.c.struct_size, sizeof longer);
    assert_int_equal(tahr_config_check(&longer.c, &field), TAHR_OK);
    assert_null(field);
    longer.tail[23] = 1;
    assert_int_equal(tahr_config_check(&longer.c, NULL), TAHR_E_UNSUPPORTED);
    assert_int_equal(tahr_config_scale(&longer.c, 2), TAHR_E_UNSUPPORTED);
    longer.c.struct_size = sizeof longer.c - 8;
    assert_int_equal(tahr_config_check(&longer.c, NULL), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_config_check(NULL, NULL), TAHR_E_NULL);
}

typedef struct place {
    const char *name;
    size_t offset;
    double low, high; /* just outside the range */
} place;

#define PLACE(field, low, high)                         \
    {                                                   \
#field, offsetof(tahr_config, field), low, high \
    }

static const place places[] = {PLACE(shape.radius, 1e-7, 0.95),
                               PLACE(shape.half_height, 0.3, 2e4),
                               PLACE(skin, 1e-9, 0.46),
                               PLACE(max_depenetration, -1e-9, 1.1e4),
                               PLACE(walkable_angle, -1e-9, 1.6),
                               PLACE(walkable_hysteresis, -1e-9, 0.8),
                               PLACE(floor_target, 0.99, 1.51),
                               PLACE(floor_max, 0.99, 11),
                               PLACE(step_height, -1e-9, 1.81),
                               PLACE(snap_distance, -1e-9, 1.1e3),
                               PLACE(perch_threshold, -1e-9, 1.1e4),
                               PLACE(perch_extra, -1e-9, 1.1e3),
                               PLACE(edge_tolerance, -1e-9, 0.46),
                               PLACE(max_speed, -1e-9, 1.1e4),
                               PLACE(acceleration, -1e-9, 1.1e6),
                               PLACE(turn_friction, -1e-9, 1.1e4),
                               PLACE(braking_deceleration, -1e-9, 1.1e6),
                               PLACE(braking_drag, -1e-9, 1.1e4),
                               PLACE(gravity.x, -1.1e4, 1.1e4),
                               PLACE(gravity.y, -1.1e4, 1.1e4),
                               PLACE(gravity.z, -1.1e4, 1.1e4),
                               PLACE(jump_speed, -1e-9, 1.1e4),
                               PLACE(jump_hold_time, -1e-9, 1.1e3),
                               PLACE(terminal_speed, 0, 1.1e4),
                               PLACE(air_control, -1e-9, 101),
                               PLACE(air_turn_friction, -1e-9, 1.1e4),
                               PLACE(path_tolerance, -1e-9, 1),
                               PLACE(arc_tolerance, 0, 1),
                               PLACE(max_dt, 0, 10.1),
                               PLACE(turn_rate, -1e-9, 1.1e4)};

/* A number that makes a related field's range impossible may be blamed on that one. */
static void expect_bad(const place *p, double value, int exact_name)
{
    tahr_config c = rig_config();
    const char *field = NULL;
    memcpy((char *)&c + p->offset, &value, sizeof value);
    if (tahr_config_check(&c, &field) != TAHR_E_ARGUMENT) {
        fail_msg("%s = %g was accepted", p->name, value);
    }
    assert_non_null(field);
    if (exact_name) {
        assert_string_equal(field, p->name);
    }
    assert_int_equal(tahr_config_scale(&c, 2), TAHR_E_ARGUMENT);
}

static void every_number_out_of_range_or_not_finite_is_named(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        int related = !strcmp(places[i].name, "shape.radius") || !strcmp(places[i].name, "floor_max") ||
                      !strcmp(places[i].name, "shape.half_height");
        expect_bad(&places[i], places[i].low, !related);
        expect_bad(&places[i], places[i].high, !related);
        expect_bad(&places[i], NAN, !related);
        expect_bad(&places[i], INFINITY, !related);
        expect_bad(&places[i], -INFINITY, !related);
    }
}

static void integers_out_of_range_are_named(void **unused)
{
    tahr_config c = rig_config();
    const char *field = NULL;
    (void)unused;
    c.max_slides = 0;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "max_slides");
    c.max_slides = 17;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    c = rig_config();
    c.cached_floor = 2;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "cached_floor");
    c = rig_config();
    c.walk_off_ledges = 2;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "walk_off_ledges");
    c = rig_config();
    c.preset = 9;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "preset");
    c = rig_config();
    c.shape.hull = 1;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "shape.hull");
}

static void shapes_are_checked_by_kind(void **unused)
{
    tahr_config c = rig_config();
    const char *field = NULL;
    (void)unused;
    c.shape.type = 8;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "shape.type");
    c.shape.type = TAHR_SHAPE_SPHERE; /* half_height is not the radius */
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "shape.half_height");
    c.shape.half_height = c.shape.radius;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_OK);
    c.shape.type = TAHR_SHAPE_BOX;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "shape.half_x");
    c.shape.half_x = c.shape.half_y = 0.3;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "shape.radius");
    c.shape.radius = 0;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_OK);
    c.shape.half_y = NAN;
    assert_int_equal(tahr_config_check(&c, &field), TAHR_E_ARGUMENT);
    assert_string_equal(field, "shape.half_y");
}

static void scale_multiplies_lengths_and_leaves_times_and_angles(void **unused)
{
    tahr_config c = rig_config(), was = c;
    (void)unused;
    assert_int_equal(tahr_config_scale(&c, 4), TAHR_OK);
    assert_true(c.shape.radius == 4 * was.shape.radius && c.shape.half_height == 4 * was.shape.half_height);
    assert_true(c.skin == 4 * was.skin && c.step_height == 4 * was.step_height &&
                c.snap_distance == 4 * was.snap_distance);
    assert_true(c.perch_threshold == 4 * was.perch_threshold && c.perch_extra == 4 * was.perch_extra);
    assert_true(c.max_speed == 4 * was.max_speed && c.acceleration == 4 * was.acceleration &&
                c.gravity.z == 4 * was.gravity.z);
    assert_true(c.jump_speed == 4 * was.jump_speed && c.terminal_speed == 4 * was.terminal_speed);
    assert_true(c.braking_deceleration == 4 * was.braking_deceleration &&
                c.max_depenetration == 4 * was.max_depenetration);
    assert_true(c.edge_tolerance == 4 * was.edge_tolerance && c.arc_tolerance == 4 * was.arc_tolerance &&
                c.path_tolerance == 4 * was.path_tolerance);
    assert_true(c.braking_drag == was.braking_drag && c.turn_friction == was.turn_friction && c.max_dt == was.max_dt);
    assert_true(c.walkable_angle == was.walkable_angle && c.floor_target == was.floor_target &&
                c.turn_rate == was.turn_rate);
    assert_int_equal(tahr_config_check(&c, NULL), TAHR_OK);
}

static void scale_refuses_bad_factors_and_touches_nothing(void **unused)
{
    const double bad[] = {0, -1, NAN, INFINITY, -INFINITY, 1e9, 1e-9};
    (void)unused;
    for (int i = 0; i < 7; i++) {
        tahr_config c = rig_config(), was = c;
        assert_int_equal(tahr_config_scale(&c, bad[i]), TAHR_E_ARGUMENT);
        assert_memory_equal(&c, &was, sizeof c);
    }
    assert_int_equal(tahr_config_scale(NULL, 2), TAHR_E_NULL);
}

static void a_scaled_character_moves_alike(void **unused)
{
    fake_world w, big_w;
    rig a, b;
    tahr_config big = rig_config();
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(2, -2, 0), fake_vec(4, 2, 0.25));
    fake_world_flat(&big_w);
    fake_add_box(&big_w, fake_vec(8, -8, 0), fake_vec(16, 8, 1));
    tahr_config_scale(&big, 4);
    rig_open(&a, &w, NULL, fake_vec(0, 0, 1));
    rig_open(&b, &big_w, &big, fake_vec(0, 0, 4));
    for (int i = 0; i < 150; i++) {
        a.input.move = b.input.move = fake_vec(1, 0.1, 0);
        a.input.jump = b.input.jump = i == 20;
        rig_step(&a, 1.0 / 60);
        rig_step(&b, 1.0 / 60);
        assert_int_equal(a.state.mode, b.state.mode);
        assert_near(4 * a.state.position.x, b.state.position.x, 1e-6);
        assert_near(4 * a.state.position.z, b.state.position.z, 1e-6);
    }
    rig_close(&a);
    rig_close(&b);
}

static void preset_names(void **unused)
{
    (void)unused;
    assert_string_equal(tahr_preset_name(TAHR_PRESET_PRECISE), "precise");
    assert_string_equal(tahr_preset_name(0), "?");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(init_fills_the_preset_and_reports_wrong_use),
                                       cmocka_unit_test(a_longer_struct_is_accepted_only_with_a_zero_tail),
                                       cmocka_unit_test(every_number_out_of_range_or_not_finite_is_named),
                                       cmocka_unit_test(integers_out_of_range_are_named),
                                       cmocka_unit_test(shapes_are_checked_by_kind),
                                       cmocka_unit_test(scale_multiplies_lengths_and_leaves_times_and_angles),
                                       cmocka_unit_test(scale_refuses_bad_factors_and_touches_nothing),
                                       cmocka_unit_test(a_scaled_character_moves_alike),
                                       cmocka_unit_test(preset_names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

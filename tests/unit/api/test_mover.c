/* SPDX-License-Identifier: MIT
 * test_mover.c: the entry checks of create and step: every status, every field, everything untouched on error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

/* The step must fail so, name the field, and touch nothing. */
static void expect(rig *r, double dt, tahr_status status, const char *field)
{
    tahr_state state = r->state;
    tahr_event event;
    tahr_report report, before;
    memset(&report, 0x33, sizeof report);
    memset(&event, 0x44, sizeof event);
    report.struct_size = sizeof report;
    report.events = &event;
    report.event_capacity = 1;
    report.decisions = NULL;
    before = report;
    r->log.count = 0;
    tahr_status got = tahr_mover_step(r->mover, &r->input, dt, &r->state, &report);
    if (got != status) {
        fail_msg("%s: %s instead of %s", field, tahr_status_name(got), tahr_status_name(status));
    }
    assert_memory_equal(&state, &r->state, sizeof state);
    assert_memory_equal(&report, &before, sizeof report);
    assert_int_equal(r->log.count, 1);
    if (!strstr(r->log.text, field) || !strstr(r->log.text, "tahr_mover_step")) {
        fail_msg("the message \"%s\" does not name %s", r->log.text, field);
    }
}

static void dt_out_of_range_is_refused(void **unused)
{
    const double bad[] = {-1e-9, -1, NAN, INFINITY, -INFINITY, 1.0000001, 1e9};
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 7; i++) {
        expect(&r, bad[i], TAHR_E_ARGUMENT, "dt");
    }
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 1, &r.state, NULL), TAHR_OK);
    rig_close(&r);
}

static void dt_zero_changes_nothing_and_zeroes_the_report(void **unused)
{
    fake_world w;
    rig r;
    tahr_report report;
    tahr_event events[4];
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_state before = r.state;
    memset(&report, 0x77, sizeof report);
    report.struct_size = sizeof report;
    report.events = events;
    report.event_capacity = 4;
    report.decisions = NULL;
    r.input.jump = 1;
    r.input.move.x = 1;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0, &r.state, &report), TAHR_OK);
    assert_memory_equal(&before, &r.state, sizeof before);
    assert_int_equal(report.flags, 0);
    assert_int_equal(report.event_count + report.events_lost + report.sweeps + report.slices + report.decision_count,
                     0);
    assert_true(report.events == events && report.event_capacity == 4 && report.struct_size == sizeof report);
    assert_true(report.step_offset == 0 && report.residual == 0 && report.time_lost == 0 && report.triangle_tests == 0);
    assert_int_equal(tahr_mover_step(r.mover, &r.input, -0.0, &r.state, NULL), TAHR_OK);
    rig_close(&r);
}

static void null_arguments_are_refused(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    assert_int_equal(tahr_mover_step(NULL, &r.input, 0.1, &r.state, NULL), TAHR_E_NULL);
    assert_int_equal(r.log.count, 0); /* no mover, no log */
    assert_int_equal(tahr_mover_step(r.mover, NULL, 0.1, &r.state, NULL), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_mover_step: input is NULL");
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, NULL, NULL), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_mover_step: state is NULL");
    tahr_mover *mover = (tahr_mover *)&r;
    assert_int_equal(tahr_mover_create(NULL, &r.config, &mover), TAHR_E_NULL);
    assert_int_equal(tahr_mover_create(r.world, NULL, &mover), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_mover_create: config is NULL");
    assert_int_equal(tahr_mover_create(r.world, &r.config, NULL), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_mover_create: mover is NULL");
    assert_int_equal(r.log.count, 4);
    assert_true(mover == (tahr_mover *)&r);
    tahr_mover_destroy(NULL);
    rig_close(&r);
}

static void every_input_field_is_checked(void **unused)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300};
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 4; i++) {
        for (int axis = 0; axis < 3; axis++) {
            memset(&r.input.move, 0, 3 * sizeof r.input.move);
            (&r.input.move.x)[axis] = bad[i];
            expect(&r, 0.1, TAHR_E_ARGUMENT, "input.move");
            r.input.move = fake_vec(0, 0, 0);
            r.input.flags = TAHR_INPUT_FACING;
            (&r.input.facing.x)[axis] = bad[i];
            expect(&r, 0.1, TAHR_E_ARGUMENT, "input.facing");
            r.input.facing = fake_vec(0, 0, 0);
            r.input.flags = TAHR_INPUT_GRAVITY;
            (&r.input.gravity.x)[axis] = bad[i];
            expect(&r, 0.1, TAHR_E_ARGUMENT, "input.gravity");
            r.input.flags = 0;
        }
    }
    memset(&r.input.move, 0, 3 * sizeof r.input.move);
    r.input.facing.x = NAN; /* without its flag it is not read */
    r.input.gravity.y = NAN;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.01, &r.state, NULL), TAHR_OK);
    r.input.flags = TAHR_INPUT_DROP << 1;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "input.flags");
    r.input.flags = 0;
    r.input.reserved = 7;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "input.reserved");
    rig_close(&r);
}

typedef struct field {
    const char *name;
    size_t offset;
} field;

static void every_number_of_the_state_is_checked(void **unused)
{
    static const field fields[] = {{"state.position", offsetof(tahr_state, position.x)},
                                   {"state.position", offsetof(tahr_state, position.y)},
                                   {"state.position", offsetof(tahr_state, position.z)},
                                   {"state.velocity", offsetof(tahr_state, velocity.x)},
                                   {"state.velocity", offsetof(tahr_state, velocity.y)},
                                   {"state.velocity", offsetof(tahr_state, velocity.z)},
                                   {"state.orientation", offsetof(tahr_state, orientation.x)},
                                   {"state.orientation", offsetof(tahr_state, orientation.y)},
                                   {"state.orientation", offsetof(tahr_state, orientation.z)},
                                   {"state.orientation", offsetof(tahr_state, orientation.w)},
                                   {"state.up", offsetof(tahr_state, up.x)},
                                   {"state.up", offsetof(tahr_state, up.y)},
                                   {"state.up", offsetof(tahr_state, up.z)},
                                   {"state.floor.normal", offsetof(tahr_state, floor.normal.x)},
                                   {"state.floor.normal", offsetof(tahr_state, floor.normal.z)},
                                   {"state.floor.surface_normal", offsetof(tahr_state, floor.surface_normal.x)},
                                   {"state.floor.surface_normal", offsetof(tahr_state, floor.surface_normal.z)},
                                   {"state.floor.point", offsetof(tahr_state, floor.point.x)},
                                   {"state.floor.point", offsetof(tahr_state, floor.point.z)},
                                   {"state.floor.distance", offsetof(tahr_state, floor.distance)},
                                   {"state.floor.perch_distance", offsetof(tahr_state, floor.perch_distance)},
                                   {"state.floor_position", offsetof(tahr_state, floor_position.x)},
                                   {"state.floor_position", offsetof(tahr_state, floor_position.y)},
                                   {"state.floor_position", offsetof(tahr_state, floor_position.z)},
                                   {"state.jump_hold", offsetof(tahr_state, jump_hold)}};
    const double bad[] = {NAN, INFINITY, -INFINITY};
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_state good = r.state;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        for (int k = 0; k < 3; k++) {
            r.state = good;
            memcpy((char *)&r.state + fields[i].offset, &bad[k], sizeof bad[k]);
            expect(&r, 0.1, TAHR_E_ARGUMENT, fields[i].name);
        }
    }
    rig_close(&r);
}

static void state_out_of_range_is_refused(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_state good = r.state;
    r.state.position.x = 3e7;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.position");
    r.state = good, r.state.velocity.y = 1e9;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.velocity");
    r.state = good, r.state.orientation.w = 0;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.orientation");
    r.state = good, r.state.up.z = 2;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.up");
    r.state = good, r.state.mode = 77;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.mode");
    r.state = good, r.state.flags = 1u << 20;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.flags");
    r.state = good, r.state.reserved[sizeof r.state.reserved - 1] = 1;
    expect(&r, 0.1, TAHR_E_ARGUMENT, "state.reserved");
    rig_close(&r);
}

static void struct_sizes_are_checked(void **unused)
{
    struct {
        tahr_input input;
        unsigned char tail[8];
    } longer;
    fake_world w;
    rig r;
    tahr_report report;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.struct_size = sizeof r.input - 1;
    expect(&r, 0.1, TAHR_E_STRUCT_SIZE, "input");
    r.input.struct_size = sizeof r.input;
    memset(&longer, 0, sizeof longer);
    longer.input.struct_size = sizeof longer;
    assert_int_equal(tahr_mover_step(r.mover, &longer.input, 0.01, &r.state, NULL), TAHR_OK);
    longer.tail[7] = 1;
    tahr_state before = r.state;
    assert_int_equal(tahr_mover_step(r.mover, &longer.input, 0.01, &r.state, NULL), TAHR_E_UNSUPPORTED);
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report - 4;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.01, &r.state, &report), TAHR_E_STRUCT_SIZE);
    assert_non_null(strstr(r.log.text, "report"));
    assert_null(strstr(r.log.text, "input"));
    assert_memory_equal(&before, &r.state, sizeof before);
    rig_close(&r);
}

static void create_names_the_bad_field_and_leaves_the_output(void **unused)
{
    struct {
        tahr_config c;
        unsigned char tail[8];
    } longer;
    fake_world w;
    rig r;
    tahr_mover *mover = (tahr_mover *)&r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    r.config.skin = NAN;
    assert_int_equal(tahr_mover_create(r.world, &r.config, &mover), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "skin"));
    r.config.struct_size = 8;
    assert_int_equal(tahr_mover_create(r.world, &r.config, &mover), TAHR_E_STRUCT_SIZE);
    memset(&longer, 0, sizeof longer);
    tahr_config_init(&longer.c, sizeof longer, TAHR_PRESET_PRECISE);
    longer.tail[0] = 9;
    assert_int_equal(tahr_mover_create(r.world, &longer.c, &mover), TAHR_E_UNSUPPORTED);
    assert_true(mover == (tahr_mover *)&r);
    longer.tail[0] = 0;
    assert_int_equal(tahr_mover_create(r.world, &longer.c, &mover), TAHR_OK);
    tahr_mover_destroy(mover);
    rig_close(&r);
}

static tahr_mover *inner_mover;
static tahr_status inner_status;

static void step_again(fake_world *w)
{
    tahr_input input = {.struct_size = sizeof input};
    tahr_state *state = w->user;
    inner_status = tahr_mover_step(inner_mover, &input, 0.1, state, NULL);
}

static void stepping_inside_a_callback_is_refused_and_harmless(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_state other = r.state, before = r.state;
    w.user = &other;
    w.on_sweep = step_again;
    inner_mover = r.mover;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_OK);
    assert_int_equal(inner_status, TAHR_E_REENTRANT);
    assert_memory_equal(&other, &before, sizeof other);
    assert_non_null(strstr(r.log.text, "mover"));
    w.on_sweep = NULL;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_OK); /* free again */
    rig_close(&r);
}

static void a_failed_step_leaves_the_mover_usable(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    expect(&r, NAN, TAHR_E_ARGUMENT, "dt");
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_OK);
    rig_close(&r);
}

static void jump_starts_only_when_the_button_goes_down_on_ground(void **unused)
{
    fake_world w;
    rig r;
    int jumps = 0;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1.2));
    r.input.jump = 1; /* pressed in the air, held on landing */
    for (int i = 0; i < 60; i++) {
        rig_step(&r, 1.0 / 60);
        jumps += rig_event(&r, TAHR_EVENT_JUMPED) != NULL;
    }
    assert_int_equal(jumps, 0);
    r.input.jump = 0;
    rig_step(&r, 1.0 / 60);
    r.input.jump = 1;
    rig_step(&r, 1.0 / 60);
    assert_non_null(rig_event(&r, TAHR_EVENT_JUMPED));
    const tahr_decision *d = rig_decision(&r, TAHR_RULE_JUMP);
    assert_true(d && d->accepted);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(dt_out_of_range_is_refused),
                                       cmocka_unit_test(dt_zero_changes_nothing_and_zeroes_the_report),
                                       cmocka_unit_test(null_arguments_are_refused),
                                       cmocka_unit_test(every_input_field_is_checked),
                                       cmocka_unit_test(every_number_of_the_state_is_checked),
                                       cmocka_unit_test(state_out_of_range_is_refused),
                                       cmocka_unit_test(struct_sizes_are_checked),
                                       cmocka_unit_test(create_names_the_bad_field_and_leaves_the_output),
                                       cmocka_unit_test(stepping_inside_a_callback_is_refused_and_harmless),
                                       cmocka_unit_test(a_failed_step_leaves_the_mover_usable),
                                       cmocka_unit_test(jump_starts_only_when_the_button_goes_down_on_ground)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_mover.c: the entry checks of create and step: every status, every field, everything untouched on error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"

typedef struct checked {
    fake_world fake;
    fake_log log;
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
} checked;

static void open_checked(checked *c)
{
    tahr_callbacks callbacks = {
        .struct_size = sizeof callbacks, .user = &c->fake, .sweep = fake_sweep, .contacts = fake_contacts};
    tahr_log log = fake_log_of(&c->log);
    tahr_world_desc desc;
    tahr_vec3 at = {0, 0, 1};
    fake_world_init(&c->fake);
    fake_add_plane(&c->fake, fake_vec(0, 0, 1), 0);
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.log = &log;
    assert_int_equal(tahr_world_open_callbacks(&callbacks, &desc, &c->world), TAHR_OK);
    c->config = fake_config();
    assert_int_equal(tahr_mover_create(c->world, &c->config, &c->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&c->state, &c->config, &at), TAHR_OK);
    memset(&c->input, 0, sizeof c->input);
    c->input.struct_size = sizeof c->input;
}

static void close_checked(checked *c)
{
    tahr_mover_destroy(c->mover);
    tahr_world_close(c->world);
}

/* The step must fail so, name the field, and touch nothing. */
static void expect(checked *c, double dt, tahr_status status, const char *field)
{
    tahr_state state = c->state;
    tahr_event event;
    tahr_report report, before;
    memset(&report, 0x33, sizeof report);
    memset(&event, 0x44, sizeof event);
    report.struct_size = sizeof report;
    report.events = &event;
    report.event_capacity = 1;
    report.decisions = NULL;
    before = report;
    c->log.count = 0;
    tahr_status got = tahr_mover_step(c->mover, &c->input, dt, &c->state, &report);
    if (got != status) {
        fail_msg("%s: %s instead of %s", field, tahr_status_name(got), tahr_status_name(status));
    }
    assert_memory_equal(&state, &c->state, sizeof state);
    assert_memory_equal(&report, &before, sizeof report);
    assert_int_equal(c->log.count, 1);
    if (!strstr(c->log.text, field) || !strstr(c->log.text, "tahr_mover_step")) {
        fail_msg("the message \"%s\" does not name %s", c->log.text, field);
    }
}

static void dt_out_of_range_is_refused(void **unused)
{
    const double bad[] = {-1e-9, -1, NAN, INFINITY, -INFINITY, 1.0000001, 1e9};
    checked c;
    (void)unused;
    open_checked(&c);
    for (int i = 0; i < 7; i++) {
        expect(&c, bad[i], TAHR_E_ARGUMENT, "dt");
    }
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 1, &c.state, NULL), TAHR_OK);
    close_checked(&c);
}

static void dt_zero_changes_nothing_and_zeroes_the_report(void **unused)
{
    checked c;
    tahr_report report;
    tahr_event events[4];
    (void)unused;
    open_checked(&c);
    tahr_state before = c.state;
    memset(&report, 0x77, sizeof report);
    report.struct_size = sizeof report;
    report.events = events;
    report.event_capacity = 4;
    report.decisions = NULL;
    c.input.jump = 1;
    c.input.move.x = 1;
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0, &c.state, &report), TAHR_OK);
    assert_memory_equal(&before, &c.state, sizeof before);
    assert_int_equal(report.flags, 0);
    assert_int_equal(report.event_count + report.events_lost + report.sweeps + report.slices + report.decision_count, 0);
    assert_true(report.events == events && report.event_capacity == 4 && report.struct_size == sizeof report);
    assert_true(report.step_offset == 0 && report.residual == 0 && report.time_lost == 0 && report.triangle_tests == 0);
    assert_int_equal(tahr_mover_step(c.mover, &c.input, -0.0, &c.state, NULL), TAHR_OK);
    close_checked(&c);
}

static void null_arguments_are_refused(void **unused)
{
    checked c;
    (void)unused;
    open_checked(&c);
    assert_int_equal(tahr_mover_step(NULL, &c.input, 0.1, &c.state, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_mover_step(c.mover, NULL, 0.1, &c.state, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0.1, NULL, NULL), TAHR_E_NULL);
    tahr_mover *mover = (tahr_mover *)&c;
    assert_int_equal(tahr_mover_create(NULL, &c.config, &mover), TAHR_E_NULL);
    assert_int_equal(tahr_mover_create(c.world, NULL, &mover), TAHR_E_NULL);
    assert_int_equal(tahr_mover_create(c.world, &c.config, NULL), TAHR_E_NULL);
    assert_true(mover == (tahr_mover *)&c);
    tahr_mover_destroy(NULL);
    close_checked(&c);
}

static void every_input_field_is_checked(void **unused)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300};
    checked c;
    (void)unused;
    open_checked(&c);
    for (int i = 0; i < 4; i++) {
        for (int axis = 0; axis < 3; axis++) {
            memset(&c.input.move, 0, 3 * sizeof c.input.move);
            (&c.input.move.x)[axis] = bad[i];
            expect(&c, 0.1, TAHR_E_ARGUMENT, "input.move");
            c.input.move = fake_vec(0, 0, 0);
            c.input.flags = TAHR_INPUT_FACING;
            (&c.input.facing.x)[axis] = bad[i];
            expect(&c, 0.1, TAHR_E_ARGUMENT, "input.facing");
            c.input.facing = fake_vec(0, 0, 0);
            c.input.flags = TAHR_INPUT_GRAVITY;
            (&c.input.gravity.x)[axis] = bad[i];
            expect(&c, 0.1, TAHR_E_ARGUMENT, "input.gravity");
            c.input.flags = 0;
        }
    }
    memset(&c.input.move, 0, 3 * sizeof c.input.move);
    c.input.facing.x = NAN; /* without its flag it is not read */
    c.input.gravity.y = NAN;
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0.01, &c.state, NULL), TAHR_OK);
    c.input.flags = 1u << 9;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "input.flags");
    c.input.flags = 0;
    c.input.reserved = 7;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "input.reserved");
    close_checked(&c);
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
                                   {"state.floor", offsetof(tahr_state, floor.normal.x)},
                                   {"state.floor", offsetof(tahr_state, floor.normal.z)},
                                   {"state.floor", offsetof(tahr_state, floor.surface_normal.x)},
                                   {"state.floor", offsetof(tahr_state, floor.surface_normal.z)},
                                   {"state.floor", offsetof(tahr_state, floor.point.x)},
                                   {"state.floor", offsetof(tahr_state, floor.point.z)},
                                   {"state.floor", offsetof(tahr_state, floor.distance)},
                                   {"state", offsetof(tahr_state, floor.perch_distance)},
                                   {"state", offsetof(tahr_state, floor_position.x)},
                                   {"state", offsetof(tahr_state, floor_position.y)},
                                   {"state", offsetof(tahr_state, floor_position.z)},
                                   {"state", offsetof(tahr_state, jump_hold)}};
    const double bad[] = {NAN, INFINITY, -INFINITY};
    checked c;
    (void)unused;
    open_checked(&c);
    tahr_state good = c.state;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        for (int k = 0; k < 3; k++) {
            c.state = good;
            memcpy((char *)&c.state + fields[i].offset, &bad[k], sizeof bad[k]);
            expect(&c, 0.1, TAHR_E_ARGUMENT, fields[i].name);
        }
    }
    close_checked(&c);
}

static void state_out_of_range_is_refused(void **unused)
{
    checked c;
    (void)unused;
    open_checked(&c);
    tahr_state good = c.state;
    c.state.position.x = 3e7;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.position");
    c.state = good, c.state.velocity.y = 1e9;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.velocity");
    c.state = good, c.state.orientation.w = 0;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.orientation");
    c.state = good, c.state.up.z = 2;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.up");
    c.state = good, c.state.mode = 77;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.mode");
    c.state = good, c.state.flags = 1u << 20;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.flags");
    c.state = good, c.state.reserved[255] = 1;
    expect(&c, 0.1, TAHR_E_ARGUMENT, "state.reserved");
    close_checked(&c);
}

static void struct_sizes_are_checked(void **unused)
{
    struct {
        tahr_input input;
        unsigned char tail[8];
    } longer;
    checked c;
    tahr_report report;
    (void)unused;
    open_checked(&c);
    c.input.struct_size = sizeof c.input - 1;
    expect(&c, 0.1, TAHR_E_STRUCT_SIZE, "input");
    c.input.struct_size = sizeof c.input;
    memset(&longer, 0, sizeof longer);
    longer.input.struct_size = sizeof longer;
    assert_int_equal(tahr_mover_step(c.mover, &longer.input, 0.01, &c.state, NULL), TAHR_OK);
    longer.tail[7] = 1;
    tahr_state before = c.state;
    assert_int_equal(tahr_mover_step(c.mover, &longer.input, 0.01, &c.state, NULL), TAHR_E_UNSUPPORTED);
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report - 4;
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0.01, &c.state, &report), TAHR_E_STRUCT_SIZE);
    assert_memory_equal(&before, &c.state, sizeof before);
    close_checked(&c);
}

static void create_names_the_bad_field_and_leaves_the_output(void **unused)
{
    struct {
        tahr_config c;
        unsigned char tail[8];
    } longer;
    checked c;
    tahr_mover *mover = (tahr_mover *)&c;
    (void)unused;
    open_checked(&c);
    c.config.skin = NAN;
    assert_int_equal(tahr_mover_create(c.world, &c.config, &mover), TAHR_E_ARGUMENT);
    assert_non_null(strstr(c.log.text, "skin"));
    c.config.struct_size = 8;
    assert_int_equal(tahr_mover_create(c.world, &c.config, &mover), TAHR_E_STRUCT_SIZE);
    memset(&longer, 0, sizeof longer);
    tahr_config_init(&longer.c, sizeof longer, TAHR_PRESET_PRECISE);
    longer.tail[0] = 9;
    assert_int_equal(tahr_mover_create(c.world, &longer.c, &mover), TAHR_E_UNSUPPORTED);
    assert_true(mover == (tahr_mover *)&c);
    longer.tail[0] = 0;
    assert_int_equal(tahr_mover_create(c.world, &longer.c, &mover), TAHR_OK);
    tahr_mover_destroy(mover);
    close_checked(&c);
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
    checked c;
    (void)unused;
    open_checked(&c);
    tahr_state other = c.state, before = c.state;
    c.fake.user = &other;
    c.fake.on_sweep = step_again;
    inner_mover = c.mover;
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0.1, &c.state, NULL), TAHR_OK);
    assert_int_equal(inner_status, TAHR_E_REENTRANT);
    assert_memory_equal(&other, &before, sizeof other);
    assert_non_null(strstr(c.log.text, "mover"));
    c.fake.on_sweep = NULL;
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0.1, &c.state, NULL), TAHR_OK); /* free again */
    close_checked(&c);
}

static void a_failed_step_leaves_the_mover_usable(void **unused)
{
    checked c;
    (void)unused;
    open_checked(&c);
    expect(&c, NAN, TAHR_E_ARGUMENT, "dt");
    assert_int_equal(tahr_mover_step(c.mover, &c.input, 0.1, &c.state, NULL), TAHR_OK);
    close_checked(&c);
}

static void jump_starts_only_when_the_button_goes_down_on_ground(void **unused)
{
    fake_world w;
    rig r;
    int jumps = 0;
    (void)unused;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(0, 0, 1), 0);
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

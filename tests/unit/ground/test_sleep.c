/* SPDX-License-Identifier: MIT
 * test_sleep.c: a step that repeats one which changed nothing costs no query and says all the same. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "rig.h"

/* Without a trace: with one every step is computed. */
static tahr_status step(rig *r, double dt, uint32_t event_capacity)
{
    tahr_report report = {
        .struct_size = sizeof report, .events = event_capacity ? r->events : NULL, .event_capacity = event_capacity};
    r->report = report;
    tahr_status status = tahr_mover_step(r->mover, &r->input, dt, &r->state, &r->report);
    if (status < 0) fail_msg("%s: %s", tahr_status_name(status), r->log.text);
    return status;
}

static int asleep(const rig *r)
{
    return (r->report.flags & TAHR_REPORT_ASLEEP) != 0;
}

/* Field by field; asleep, nothing was asked. */
static void assert_same_report(const rig *on, const rig *off)
{
    tahr_report a = on->report, b = off->report;
    if (a.flags & TAHR_REPORT_ASLEEP) {
        assert_int_equal(a.sweeps + a.contact_queries + a.rays, 0);
        assert_true(a.triangle_tests + a.narrow_iterations + a.gathers + a.escapes == 0);
        b.sweeps = b.contact_queries = b.rays = 0;
        b.triangle_tests = b.narrow_iterations = b.gathers = b.escapes = 0;
        b.flags |= TAHR_REPORT_ASLEEP;
        assert_int_equal(a.saved[TAHR_SHORTCUT_SLEEP], 1);
        memset(b.saved, 0, sizeof b.saved);
        b.saved[TAHR_SHORTCUT_SLEEP] = 1;
    }
    assert_true((a.events == NULL) == (b.events == NULL));
    a.events = b.events = NULL;
    assert_memory_equal(&a, &b, sizeof a);
    assert_memory_equal(on->events, off->events, a.event_count * sizeof on->events[0]);
}

/* A character that pushes straight into a wall and has come to rest there. */
static void open_at_wall(rig *r, fake_world *w, uint32_t sleep)
{
    tahr_config c = rig_config();
    c.sleep = sleep;
    fake_world_flat(w);
    fake_add_plane(w, fake_vec(-1, 0, 0), -2);
    rig_stand(r, w, &c, fake_vec(0, 0, 1));
    r->input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 120; i++)
        step(r, 1.0 / 60, RIG_EVENTS);
}

static void pushing_a_wall_costs_nothing_and_reports_the_hit(void **unused)
{
    fake_world w;
    rig on, off;
    (void)unused;
    open_at_wall(&on, &w, 1);
    w.sweeps = w.contact_queries = w.rays = 0;
    step(&on, 1.0 / 60, RIG_EVENTS);
    assert_true(asleep(&on));
    assert_int_equal(w.sweeps + w.contact_queries + w.rays, 0);
    assert_int_equal(on.report.sweeps + on.report.contact_queries + on.report.rays, 0);
    assert_non_null(rig_event(&on, TAHR_EVENT_HIT));
    open_at_wall(&off, &w, 0);
    step(&off, 1.0 / 60, RIG_EVENTS);
    assert_false(asleep(&off));
    assert_true(off.report.sweeps > 0);
    assert_memory_equal(&on.state, &off.state, sizeof on.state);
    assert_same_report(&on, &off);
    rig_close(&on);
    rig_close(&off);
}

/* Every argument of the step is looked at. */
static void any_change_wakes(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_at_wall(&r, &w, 1);
    for (int change = 0; change < 8; change++) {
        for (int i = 0; i < 3; i++) /* sees the changed world, repeats itself, sleeps */
            step(&r, 1.0 / 60, RIG_EVENTS);
        assert_true(asleep(&r));
        const tahr_state at_rest = r.state;
        const tahr_input pushing = r.input;
        double dt = 1.0 / 60;
        uint32_t capacity = RIG_EVENTS;
        switch (change) {
        case 0: r.input.move.y = 1e-9; break;
        case 1: r.input.jump = 1; break;
        case 2: r.input.flags = TAHR_INPUT_GRAVITY, r.input.gravity = fake_vec(0, 0, -9.81); break;
        case 3: dt = 1.0 / 61; break;
        case 4: r.state.velocity.x = nextafter(r.state.velocity.x, 1); break;
        case 5: r.state.position.y = 1e-12; break;
        case 6: assert_int_equal(tahr_world_touch(r.world), TAHR_OK); break;
        default: capacity = 0; break;
        }
        step(&r, dt, capacity);
        assert_false(asleep(&r));
        r.state = at_rest;
        r.input = pushing;
    }
    r.report.decisions = r.decisions;
    r.report.decision_capacity = RIG_DECISIONS;
    step(&r, 1.0 / 60, RIG_EVENTS);
    step(&r, 1.0 / 60, RIG_EVENTS);
    assert_true(asleep(&r));
    rig_step(&r, 1.0 / 60); /* with a trace */
    assert_false(asleep(&r));
    assert_true(r.report.decision_count > 0);
    rig_close(&r);
}

/* Without their flags. With them all counts again. */
static void fields_that_do_not_count_wake_nobody(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_at_wall(&r, &w, 1);
    r.input.facing = r.input.launch = r.input.drive = fake_vec(NAN, 1, 2);
    r.input.gravity = fake_vec(0, 0, INFINITY);
    r.input.radius = -1;
    r.input.mode = 77;
    step(&r, 1.0 / 60, RIG_EVENTS);
    assert_true(asleep(&r));
    r.input.facing = fake_vec(0, 1, 0);
    r.input.flags = TAHR_INPUT_FACING;
    for (int i = 0; i < 3; i++)
        step(&r, 1.0 / 60, RIG_EVENTS);
    r.input.launch = fake_vec(0, 0, 1);
    step(&r, 1.0 / 60, RIG_EVENTS);
    assert_false(asleep(&r));
    rig_close(&r);
}

/* What a caller of a newer version hands over. */
typedef struct newer {
    tahr_input input;
    double unknown;
} newer;

static void who_sleeps_refuses_what_is_wrong_as_well(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_at_wall(&r, &w, 1);
    newer input = {.input = r.input};
    const tahr_state at_rest = r.state;
    const double dt = 1.0 / 60;
    step(&r, dt, 0);
    step(&r, dt, 0);
    assert_true(asleep(&r));
    assert_int_equal(tahr_mover_step(r.mover, NULL, dt, &r.state, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_mover_step(r.mover, &r.input, dt, NULL, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_mover_step(r.mover, &r.input, NAN, &r.state, NULL), TAHR_E_ARGUMENT);
    tahr_report cut = {.struct_size = sizeof cut - 8};
    assert_int_equal(tahr_mover_step(r.mover, &r.input, dt, &r.state, &cut), TAHR_E_STRUCT_SIZE);
    cut.struct_size = 1u << 30;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, dt, &r.state, &cut), TAHR_E_STRUCT_SIZE);
    r.input.reserved = 1;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, dt, &r.state, NULL), TAHR_E_ARGUMENT);
    r.input.reserved = 0;
    r.state.reserved[sizeof r.state.reserved - 1] = 1;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, dt, &r.state, NULL), TAHR_E_ARGUMENT);
    r.state = at_rest;
    input.input.struct_size = sizeof input;
    for (int i = 0; i < 2; i++) {
        r.report = (tahr_report){.struct_size = sizeof r.report};
        assert_int_equal(tahr_mover_step(r.mover, &input.input, dt, &r.state, &r.report), TAHR_OK);
    }
    assert_true(asleep(&r));
    input.unknown = 1;
    assert_int_equal(tahr_mover_step(r.mover, &input.input, dt, &r.state, NULL), TAHR_E_UNSUPPORTED);
    assert_memory_equal(&r.state, &at_rest, sizeof at_rest);
    rig_close(&r);
}

/* A wall that goes away is noticed as soon as the world says so. */
static void a_changed_world_lets_go(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_at_wall(&r, &w, 1);
    step(&r, 1.0 / 60, RIG_EVENTS);
    double x = r.state.position.x;
    w.solids[1].offset = -9;
    assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
    step(&r, 1.0 / 60, RIG_EVENTS);
    assert_true(r.state.position.x > x);
    rig_close(&r);
}

/* One mover may step many characters: what it noted of one is not taken for another. */
static void a_mover_does_not_mix_characters(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_at_wall(&r, &w, 1);
    const tahr_state wall = r.state;
    tahr_state other = wall;
    other.position.y = 3;
    for (int i = 0; i < 10; i++) {
        r.state = other;
        step(&r, 1.0 / 60, RIG_EVENTS);
        other = r.state;
        r.state = wall;
        step(&r, 1.0 / 60, RIG_EVENTS);
        assert_memory_equal(&r.state, &wall, sizeof wall);
    }
    assert_true(other.position.y == 3);
    rig_close(&r);
}

/* A corridor with a dead end: pushing, standing, turning, jumping at random. */
static void sleep_on_equals_off_bit_for_bit(void **unused)
{
    fake_world w;
    rig on, off;
    tahr_config c = rig_config();
    oracle_random seed = {9};
    uint32_t slept = 0;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -2);
    fake_add_plane(&w, fake_vec(0, 1, 0), -1);
    fake_add_plane(&w, fake_vec(0.28, -0.96, 0), -1.2);
    rig_open(&on, &w, &c, fake_vec(0, 0, 1));
    c.sleep = 0;
    rig_open(&off, &w, &c, fake_vec(0, 0, 1));
    for (int i = 0; i < 20000; i++) {
        if (oracle_below(&seed, 20) == 0) {
            double a = oracle_uniform(&seed, 0, 6.2831853);
            on.input.move = oracle_below(&seed, 3) ? fake_vec(cos(a), sin(a), 0) : fake_vec(0, 0, 0);
            on.input.jump = oracle_below(&seed, 8) == 0;
        }
        off.input = on.input;
        double dt = oracle_below(&seed, 50) ? 1.0 / 60 : 1.0 / 30;
        uint32_t room = oracle_below(&seed, 10) ? RIG_EVENTS : oracle_below(&seed, 2);
        tahr_status a = step(&on, dt, room), b = step(&off, dt, room);
        slept += (uint32_t)asleep(&on);
        assert_false(asleep(&off));
        assert_memory_equal(&on.state, &off.state, sizeof on.state);
        assert_int_equal(a, b);
        assert_same_report(&on, &off);
    }
    print_message("    %u of 20000 steps asleep\n", slept);
    assert_true(slept > 2000);
    rig_close(&on);
    rig_close(&off);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pushing_a_wall_costs_nothing_and_reports_the_hit),
        cmocka_unit_test(any_change_wakes),
        cmocka_unit_test(fields_that_do_not_count_wake_nobody),
        cmocka_unit_test(who_sleeps_refuses_what_is_wrong_as_well),
        cmocka_unit_test(a_changed_world_lets_go),
        cmocka_unit_test(a_mover_does_not_mix_characters),
        cmocka_unit_test(sleep_on_equals_off_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

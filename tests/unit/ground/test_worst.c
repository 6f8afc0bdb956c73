/* SPDX-License-Identifier: MIT
 * test_worst.c: the facts about a step that are no errors, each as the status of a step, and which of them wins. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "fake_backend.h"
#include "rig.h"

/* The worst first, as mover.h promises. */
static const struct {
    uint32_t flag;
    tahr_status status;
} order[] = {{TAHR_REPORT_QUERY_CAP, TAHR_QUERY_CAP},
             {TAHR_REPORT_CRUSHED, TAHR_CRUSHED},
             {TAHR_REPORT_STUCK, TAHR_STUCK},
             {TAHR_REPORT_UNKNOWN, TAHR_UNKNOWN},
             {TAHR_REPORT_TRUNCATED, TAHR_TRUNCATED}};
enum { FACTS = sizeof order / sizeof order[0] };

static tahr_status worst_of(uint32_t flags)
{
    for (int i = 0; i < FACTS; i++) {
        if (flags & order[i].flag) {
            return order[i].status;
        }
    }
    return TAHR_OK;
}

/* A step with room for `events`; the status is the worst flag of its report. */
static tahr_status step(rig *r, double dt, uint32_t events)
{
    tahr_report report = {.struct_size = sizeof report, .events = r->events, .event_capacity = events};
    r->report = report;
    r->status = tahr_mover_step(r->mover, &r->input, dt, &r->state, &r->report);
    assert_int_equal(r->status, worst_of(r->report.flags));
    return r->status;
}

/* Stands under a ceiling that has come down to 1.5 m: 0.3 m less than the character is tall. */
static void open_under_press(rig *r, fake_world *w)
{
    fake_world_flat(w);
    rig_stand(r, w, NULL, fake_vec(0, 0, 1));
    fake_add_plane(w, fake_vec(0, 0, -1), -1.5);
    assert_int_equal(tahr_world_touch(r->world), TAHR_OK);
}

static void a_lowered_ceiling_crushes(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    open_under_press(&r, &w);
    r.input.move = fake_vec(1, 0, 0);
    assert_int_equal(step(&r, 1.0 / 60, RIG_EVENTS), TAHR_CRUSHED);
    assert_near(r.report.residual, -fake_clearance(&w, &r.config.shape, r.state.position), 1e-9);
    assert_true(r.report.residual >= 0.15 && r.report.residual <= 0.3125); /* no worse than it was; half each at best */
    const tahr_event *e = rig_event(&r, TAHR_EVENT_CRUSHED);
    assert_true(e && e->value == r.report.residual);
    assert_int_equal(step(&r, 1.0 / 60, 0), TAHR_CRUSHED); /* and truncated */
    assert_true(r.report.flags & TAHR_REPORT_TRUNCATED);
    rig_close(&r);
}

/* A wall that cannot be decided, from where the character stands on. */
static void walking_against_the_unknown_is_stuck(void **unused)
{
    fake_backend b;
    rig r;
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    rig_settle(&r);
    fake_add_plane(&b.world, fake_vec(-1, 0, 0), -3);
    b.unknown = UNKNOWN_ALONE;
    b.unknown_body = 1;
    r.input.move = fake_vec(1, 0, 0);
    int first = 0;
    tahr_status status = TAHR_OK;
    for (int i = 0; i < 120 && status != TAHR_STUCK; i++) {
        status = step(&r, 1.0 / 60, RIG_EVENTS);
        first += status == TAHR_UNKNOWN;
        assert_int_equal(rig_event(&r, TAHR_EVENT_STUCK) != NULL, status == TAHR_STUCK);
    }
    assert_int_equal(first, 1); /* got there first */
    assert_int_equal(status, TAHR_STUCK);
    assert_true(r.report.flags & TAHR_REPORT_UNKNOWN);
    assert_int_equal(step(&r, 1.0 / 60, 0), TAHR_STUCK);
    assert_true(r.report.flags & TAHR_REPORT_TRUNCATED);
    r.input.move = fake_vec(0, 0, 0); /* who wants nothing is not stuck */
    assert_int_not_equal(step(&r, 1.0 / 60, RIG_EVENTS), TAHR_STUCK);
    assert_null(rig_event(&r, TAHR_EVENT_STUCK));
    rig_close(&r);
}

/* Noise until every fact was the status of a step, and until each was there with each worse one. */
static void noise_shows_every_status_and_the_worst_wins(void **unused)
{
    const double dts[] = {1.0 / 60, 0.1, 1};
    fake_backend b;
    rig r;
    uint32_t seen[FACTS] = {0}, beside[FACTS][FACTS] = {{0}};
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    b.random = 1;
    /* Slices enough to ask more than a step may: nothing else comes to the cap. */
    tahr_config sliced = rig_config();
    sliced.integrator = TAHR_INTEGRATOR_STEPPED;
    sliced.max_substeps = 64;
    sliced.max_substep = 1.0 / 64;
    tahr_mover *movers[2] = {r.mover, NULL};
    assert_int_equal(tahr_mover_create(r.world, &sliced, &movers[1]), TAHR_OK);
    for (int i = 0; i < 40000; i++) {
        r.mover = movers[i % 4 == 3];
        if (i % 20 == 0) {
            r.input.move = dice_direction(&b.seed);
            r.input.jump = i % 40 == 0;
            r.state.velocity = fake_vec(0, 0, 0);
            r.state.position = fake_vec(0, 0, 1);
        }
        tahr_status status = step(&r, dts[i % 3], i % 2 ? RIG_EVENTS : 1);
        for (int k = 0; k < FACTS; k++) {
            seen[k] += status == order[k].status;
            for (int j = 0; j < k; j++) {
                beside[j][k] += (r.report.flags & order[j].flag) && (r.report.flags & order[k].flag);
            }
        }
    }
    for (int k = 0; k < FACTS; k++) {
        print_message("    %-9s %5u times the status; beside it", tahr_status_name(order[k].status), seen[k]);
        for (int j = k + 1; j < FACTS; j++) {
            print_message(" %s %u", tahr_status_name(order[j].status), beside[k][j]);
        }
        print_message("\n");
    }
    for (int k = 0; k < FACTS; k++) {
        assert_true(seen[k] > 0);
    }
    r.mover = movers[0];
    tahr_mover_destroy(movers[1]);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_lowered_ceiling_crushes),
                                       cmocka_unit_test(walking_against_the_unknown_is_stuck),
                                       cmocka_unit_test(noise_shows_every_status_and_the_worst_wins)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_walk_again.c: a slice that is walked again, because its path was bent before the floor ended, reports what
 * happened once, however little room there is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

/* A platform that ends at x = 2, with a wall along its left side at y = 1. */
static void platform(fake_world *w)
{
    fake_world_init(w);
    fake_add_box(w, fake_vec(-5, -5, -1), fake_vec(2, 5, 0));
    fake_add_plane(w, fake_vec(0, -1, 0), -1);
    fake_add_plane(w, fake_vec(0, 0, 1), -4);
}

/* The same step from the same state with room for `events` and `decisions` only. */
static tahr_status again(rig *r, double dt, tahr_state *state, tahr_report *report, tahr_event *events, uint32_t room,
                         uint32_t decisions)
{
    static tahr_decision kept[RIG_DECISIONS];
    *report = (tahr_report){.struct_size = sizeof *report,
                            .events = events,
                            .event_capacity = room,
                            .decisions = decisions ? kept : NULL,
                            .decision_capacity = decisions};
    return tahr_mover_step(r->mover, &r->input, dt, state, report);
}

/* Every room from none to more than enough: the first events, the others counted. */
static void check_rooms(rig *r, double dt, const tahr_state *before)
{
    const tahr_report *full = &r->report;
    uint32_t hits = 0;
    assert_int_equal(full->events_lost, 0);
    for (uint32_t e = 0; e < full->event_count; e++) {
        hits += r->events[e].type == TAHR_EVENT_HIT;
    }
    assert_int_equal(full->slides, hits);
    for (uint32_t room = 0; room <= full->event_count + 1; room++) {
        tahr_event events[RIG_EVENTS];
        tahr_report report;
        tahr_state state = *before;
        tahr_status status = again(r, dt, &state, &report, events, room, 0);
        uint32_t fits = room < full->event_count ? room : full->event_count;
        assert_int_equal(report.event_count, fits);
        assert_int_equal(report.events_lost, full->event_count - fits);
        assert_int_equal((report.flags & TAHR_REPORT_TRUNCATED) != 0, report.events_lost > 0);
        assert_int_equal(status, report.events_lost > 0 ? TAHR_TRUNCATED : TAHR_OK);
        assert_memory_equal(events, r->events, fits * sizeof events[0]);
        assert_memory_equal(&state, &r->state, sizeof state);
        assert_int_equal(report.slides, full->slides);
        assert_true(report.step_offset == full->step_offset);
    }
}

static void events_of_a_slice_walked_again_are_reported_once(void **unused)
{
    uint32_t both = 0;
    (void)unused;
    for (int i = 0; i < 16; i++) {
        const double dt = 0.2;
        fake_world w;
        rig r;
        platform(&w);
        tahr_config c = rig_config();
        c.sleep = 0;
        rig_stand(&r, &w, &c, fake_vec(-1 + 0.1 * i, 0.1, 1));
        r.input.move = fake_vec(0.8, 0.6, 0);
        for (int k = 0; k < 6; k++) {
            tahr_state before = r.state;
            rig_step(&r, dt);
            rig_assert_in_order(&r, dt);
            uint32_t hits = 0;
            for (uint32_t e = 0; e < r.report.event_count && r.events[e].type != TAHR_EVENT_LEFT_GROUND; e++) {
                hits += r.events[e].type == TAHR_EVENT_HIT && r.events[e].body == 1;
            }
            assert_true(hits <= 1);
            both += hits == 1 && rig_event(&r, TAHR_EVENT_LEFT_GROUND);
            check_rooms(&r, dt, &before);
        }
        rig_close(&r);
    }
    assert_true(both > 0); /* met the wall and left the platform in one step */
}

/* Blocks scattered over a platform and beyond its end: what is met in the void, at the height of the floor, is met only
 * by the first of two walks. */
static void what_only_the_first_walk_met_leaves_no_trace(void **unused)
{
    oracle_random seed = {4};
    (void)unused;
    for (int i = 0; i < 150; i++) {
        const double dt = 0.4;
        fake_world w;
        rig r;
        platform(&w);
        for (int k = 0; k < 12; k++) {
            tahr_vec3 at = fake_vec(oracle_uniform(&seed, 0.5, 5), oracle_uniform(&seed, -2, 1), -0.1);
            double high = oracle_uniform(&seed, 0.05, 1);
            fake_add_box(&w, at, fake_vec(at.x + 0.3, at.y + 0.3, high));
        }
        tahr_config c = rig_config();
        c.sleep = 0;
        rig_stand(&r, &w, &c, fake_vec(-1.5, -0.5, 1));
        for (int k = 0; k < 6; k++) {
            tahr_state before = r.state;
            r.input.move = fake_vec(1, oracle_uniform(&seed, -0.5, 0.5), 0);
            if (rig_step(&r, dt) == TAHR_OK) {
                check_rooms(&r, dt, &before);
            }
        }
        rig_close(&r);
    }
}

/* Decisions stay, of both times: a trace tells what was thought. That they do not fit is not forgotten. */
static void decisions_lost_in_the_first_walk_stay_lost(void **unused)
{
    fake_world w;
    rig r;
    uint32_t steps = 0;
    (void)unused;
    platform(&w);
    tahr_config c = rig_config();
    c.sleep = 0;
    rig_stand(&r, &w, &c, fake_vec(-1, 0.1, 1));
    r.input.move = fake_vec(0.8, 0.6, 0);
    for (int k = 0; k < 12; k++) {
        tahr_state before = r.state;
        rig_step(&r, 0.2);
        for (uint32_t room = 1; room < r.report.decision_count; room++) {
            tahr_event events[RIG_EVENTS];
            tahr_report report;
            tahr_state state = before;
            assert_int_equal(again(&r, 0.2, &state, &report, events, RIG_EVENTS, room), TAHR_TRUNCATED);
            assert_int_equal(report.decisions_lost, r.report.decision_count - room);
            assert_int_equal(report.event_count, r.report.event_count);
            steps++;
        }
    }
    assert_true(steps > 0);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(events_of_a_slice_walked_again_are_reported_once),
                                       cmocka_unit_test(what_only_the_first_walk_met_leaves_no_trace),
                                       cmocka_unit_test(decisions_lost_in_the_first_walk_stay_lost)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_counts.c: a replay reports the counts of the run that was recorded: what was asked, also by the sweeps that
 * contacts are derived from, and what it cost the backend. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "recording.h"
#include "room.h"

/* Callbacks, each call of which is counted. */
typedef struct counted {
    fake_world world;
    oracle_random dice;
    uint64_t calls, bodies; /* bodies: questions that no report counts */
    int lies;
} counted;

/* A lie: somewhere inside of something, every time anew. */
static tahr_status count_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    counted *c = user;
    c->calls++;
    if (!c->lies) {
        return fake_sweep(&c->world, query, hit);
    }
    hit->start_overlap = 1;
    hit->depth = oracle_uniform(&c->dice, 0, 0.2);
    hit->normal = dice_direction(&c->dice);
    return TAHR_OK;
}

static tahr_status count_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts,
                                  uint32_t capacity, uint32_t *count)
{
    counted *c = user;
    c->calls++;
    return fake_contacts(&c->world, query, contacts, capacity, count);
}

/* At rest at the origin. */
static tahr_status count_body(void *user, uint32_t body, tahr_body_motion *motion)
{
    counted *c = user;
    (void)body, (void)motion;
    c->bodies++;
    return TAHR_OK;
}

static void expect_same(const recording_counts *run, recording *file, uint64_t steps)
{
    replay p = {0};
    replay_run(&p, file);
    if (p.opened < 0 || p.read < 0 || p.differs || !p.ended) {
        fail_msg("step %llu: %s; %s", (unsigned long long)p.steps, p.how, file->message);
    }
    assert_true(p.steps == steps);
    for (int i = 0; i < RECORDING_COUNTS; i++) {
        assert_true(p.counts.sum[i] == run->sum[i]);
    }
    assert_true(p.counts.hash == run->hash);
    recording_free(file);
}

enum { STEPS = 150, LONG = 2000 }; /* seldom does a lie take all the queries of a step */

/* Walks and jumps between a wall and a box, or is lied to. Returns in how many steps the cap of queries was reached. */
static int walk(uint32_t flags, int lies, int has_contacts, int *more_than_asked)
{
    counted c = {.dice = {flags + 1}, .lies = lies};
    recording file = {0};
    recording_counts run = {0};
    uint64_t queries;
    int capped = 0;
    rig r;
    fake_world_flat(&c.world);
    fake_add_plane(&c.world, fake_vec(-1, 0, 0), -2);
    fake_add_box(&c.world, fake_vec(-2, 1, -1), fake_vec(1, 3, 0.3));
    tahr_callbacks callbacks = {
        .struct_size = sizeof callbacks, .flags = flags, .user = &c, .sweep = count_sweep, .body = count_body};
    callbacks.contacts = has_contacts ? count_contacts : NULL;
    rig_open_callbacks(&r, &callbacks, NULL, fake_vec(0, 0, 0.8)); /* 10 cm deep */
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    const int steps = lies ? LONG : STEPS;
    for (int i = 0; i < steps; i++) {
        r.input.move = fake_vec(i % 70 < 40 ? 1 : -1, i % 50 < 30, 0);
        r.input.jump = i % 40 == 20;
        assert_true(rig_step(&r, 1.0 / 60) >= 0);
        recording_count(&run, &r.report);
        capped += (r.report.flags & TAHR_REPORT_QUERY_CAP) != 0;
    }
    tahr_trace_size(trace, NULL, &queries, NULL);
    assert_int_equal(recording_end(trace, r.world), TAHR_OK);
    assert_true(queries == c.calls + c.bodies); /* every call of the user's functions, and nothing else */
    assert_true(run.sum[0] + run.sum[1] + run.sum[2] == c.calls);
    *more_than_asked = run.sum[1] > 0 && run.sum[4] > run.sum[1];
    expect_same(&run, &file, (uint64_t)steps);
    rig_close(&r);
    return capped;
}

static void a_replay_counts_the_sweeps_that_contacts_are_derived_from(void **unused)
{
    (void)unused;
    for (uint32_t flags = 0; flags < 4; flags++) {
        int more;
        walk(flags, 0, 0, &more);
        assert_true(more); /* else there was nothing to count */
        walk(flags, 0, 1, &more);
    }
}

/* It stops at the cap in the same steps: their status would differ. */
static void a_replay_reaches_the_cap_of_queries_where_the_run_did(void **unused)
{
    (void)unused;
    int capped = 0;
    for (uint32_t flags = 0; flags < 4; flags++) {
        int more;
        capped += walk(flags, 1, 0, &more);
    }
    assert_true(capped > 0);
}

/* Native gathers when a step is announced, and counts pairs and iterations in every query. */
static void a_replay_reports_what_the_backend_did(void **unused)
{
    (void)unused;
    recording file = {0};
    recording_counts run = {0};
    oracle_random dice = {7};
    rig r;
    room_open(&r, TAHR_PRESET_PRECISE, 1);
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    for (int n = 0; n < 300; n++) {
        room_move(&r, n);
        room_carry(&r, n);
        r.input = room_input(&dice);
        room_step(&r);
        recording_count(&run, &r.report);
    }
    assert_int_equal(recording_end(trace, r.world), TAHR_OK);
    assert_true(run.sum[0] > 0 && run.sum[4] > 0);
    expect_same(&run, &file, 300);
    rig_close(&r);
}

/* Movers that went the short way before somebody watched, over open ground and in free air, go on query by query. */
static void who_went_the_short_way_is_recorded_query_by_query(void **unused)
{
    (void)unused;
    const tahr_body_desc floor = native_box(fake_vec(0, 0, -1), fake_vec(100, 100, 1));
    recording file = {0};
    recording_counts run = {0};
    uint64_t queries, asked = 0;
    uint32_t saved = 0;
    rig r;
    rig_open_bodies(&r, &floor, 1, NULL, fake_vec(0, 0, 3));
    r.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 120; i++) { /* without a look at its decisions */
        tahr_report report = {.struct_size = sizeof report};
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report), TAHR_OK);
        saved += report.saved[TAHR_SHORTCUT_CLEAR_AIR] + report.saved[TAHR_SHORTCUT_KNOWN_FLOOR];
    }
    assert_true(saved > 100);
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    for (int i = 0; i < 200; i++) {
        tahr_report report = {.struct_size = sizeof report};
        r.input.jump = i % 100 == 20;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report), TAHR_OK);
        recording_count(&run, &report);
        asked += report.sweeps + report.contact_queries + report.rays;
    }
    tahr_trace_size(trace, NULL, &queries, NULL);
    assert_int_equal(recording_end(trace, r.world), TAHR_OK);
    assert_true(queries == asked);
    expect_same(&run, &file, 200);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_replay_counts_the_sweeps_that_contacts_are_derived_from),
        cmocka_unit_test(a_replay_reaches_the_cap_of_queries_where_the_run_did),
        cmocka_unit_test(a_replay_reports_what_the_backend_did),
        cmocka_unit_test(who_went_the_short_way_is_recorded_query_by_query),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

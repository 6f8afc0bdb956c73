/* SPDX-License-Identifier: MIT
 * test_steps.c: what a sink is told of steps is what was pushed, bit for bit, whatever was thinned out or dropped in
 * between; and every message is counted once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"

enum { CHARACTERS = 5, STEPS = 6000, DT_NS = 4000000 };

/* What was pushed, to compare with. */
typedef struct pushed {
    tahr_state before, after;
    tahr_input input;
    tahr_report report;
    tahr_event events[4];
} pushed;

typedef struct record {
    listener ear;
    pushed *steps; /* STEPS of each character */
} record;

static const pushed *find(record *r, const tahr_stamp *stamp, int64_t end)
{
    const int known = stamp->character < CHARACTERS && stamp->step < STEPS;
    listener_expect(&r->ear, known, "a step that was taken");
    listener_expect(&r->ear, stamp->time_ns == end, "the simulated time of the step");
    listener_expect(&r->ear, stamp->wall_ns > 0, "the time of day");
    return &r->steps[known ? stamp->character * STEPS + stamp->step : 0];
}

static int64_t end_of(const tahr_stamp *stamp)
{
    return (int64_t)(stamp->step + 1) * DT_NS;
}

static void see_state(void *test, const tahr_stamp *stamp, const tahr_state *state)
{
    record *r = test;
    const pushed *p = find(r, stamp, end_of(stamp));
    listener_expect(&r->ear, memcmp(&p->after, state, sizeof *state) == 0, "the state that was pushed");
}

static void see_snapshot(void *test, const tahr_stamp *stamp, const tahr_state *state)
{
    record *r = test;
    const pushed *p = find(r, stamp, end_of(stamp) - DT_NS);
    listener_expect(&r->ear, memcmp(&p->before, state, sizeof *state) == 0, "the state that the step began with");
}

static void see_event(void *test, const tahr_stamp *stamp, const tahr_event *event)
{
    record *r = test;
    const uint32_t i = event->type - 1;
    const pushed *p = find(r, stamp, end_of(stamp) - DT_NS + 1000000 * (int64_t)i);
    listener_expect(&r->ear, i < 4 && memcmp(&p->events[i], event, sizeof *event) == 0, "the event that was pushed");
}

static void see_input(void *test, const tahr_stamp *stamp, const tahr_sink_input *input)
{
    record *r = test;
    const pushed *p = find(r, stamp, end_of(stamp));
    listener_expect(&r->ear, memcmp(&p->input, input->input, sizeof p->input) == 0, "the input that was pushed");
    listener_expect(&r->ear, input->dt == 1e-9 * DT_NS && input->flags == TAHR_STEP_CROWD, "its dt and flags");
}

static void see_report(void *test, const tahr_stamp *stamp, const tahr_sink_report *report)
{
    record *r = test;
    const pushed *p = find(r, stamp, end_of(stamp));
    tahr_report plain = p->report;
    plain.events = NULL;
    listener_expect(&r->ear, memcmp(&plain, report->report, sizeof plain) == 0, "the report without its events");
    listener_expect(&r->ear, report->hash == tahr_state_hash(&p->after), "the hash of the state after the step");
    listener_expect(&r->ear, report->ns == stamp->step && report->status == TAHR_STUCK, "its ns and status");
}

static void record_init(record *r)
{
    listener_init(&r->ear, r);
    r->steps = malloc(sizeof *r->steps * CHARACTERS * STEPS);
    assert_non_null(r->steps);
    r->ear.on_state = see_state;
    r->ear.on_snapshot = see_snapshot;
    r->ear.on_event = see_event;
    r->ear.on_input = see_input;
    r->ear.on_report = see_report;
}

static void record_end(record *r)
{
    free(r->steps);
    listener_end(&r->ear);
}

/* Returns what tahr_telemetry_push does. Some states are written to in between. */
static tahr_status take(record *r, tahr_telemetry *t, made_up *m, uint32_t character, uint32_t step)
{
    pushed *p = &r->steps[character * STEPS + step];
    if (made_up_number(m) % 16 == 0) made_up_change(m);
    p->before = m->state;
    assert_true(tahr_telemetry_begin(t, 0, character, 0, &m->state) >= 0);
    made_up_step(m);
    p->after = m->state;
    p->input = m->input;
    p->report = m->report;
    memcpy(p->events, m->events, sizeof p->events);
    tahr_telemetry_step s = made_up_pushed(m, character);
    s.status = TAHR_STUCK;
    s.flags = TAHR_STEP_CROWD;
    s.ns = step;
    return tahr_telemetry_push(t, 0, &s);
}

/* Of every kind: received = delivered + failed, what is missing in the sequences was dropped, and all adds up. */
static void check_counts(const listener *l, const tahr_telemetry *t, int all_arrived)
{
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    assert_null(atomic_load(&l->wrong));
    for (int k = 0; k < TAHR_MESSAGE_COUNT; k++) {
        assert_int_equal(l->got[k], c.delivered[k] + c.failed[k]);
        assert_int_equal(l->failed[k], c.failed[k]);
        assert_int_equal(c.offered[k], c.thinned[k] + c.dropped[k] + c.delivered[k] + c.failed[k]);
        if (all_arrived) assert_int_equal(c.dropped[k], 0);
        assert_true(l->missed[k] <= c.dropped[k]); /* what was dropped last leaves no gap before it */
    }
}

static void expect_every_step(uint32_t flags)
{
    record r;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m[CHARACTERS];
    record_init(&r);
    listener_describe(&r.ear, CHARACTERS, &desc);
    desc.flags = flags;
    desc.ring_bytes = 64 << 20; /* room for all, however late the thread comes */
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    for (uint32_t i = 0; i < CHARACTERS; i++)
        made_up_init(&m[i], i);
    for (uint32_t step = 0; step < STEPS; step++)
        for (uint32_t i = 0; i < CHARACTERS; i++)
            assert_int_equal(take(&r, t, &m[i], i, step), TAHR_OK);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    check_counts(&r.ear, t, 1);
    assert_int_equal(r.ear.got[TAHR_MESSAGE_STATE], CHARACTERS * STEPS);
    assert_int_equal(r.ear.got[TAHR_MESSAGE_INPUT], CHARACTERS * STEPS);
    assert_int_equal(r.ear.got[TAHR_MESSAGE_REPORT], CHARACTERS * STEPS);
    assert_true(r.ear.got[TAHR_MESSAGE_SNAPSHOT] > STEPS / 16);
    assert_true(r.ear.flushes > 0);
    tahr_telemetry_destroy(t);
    record_end(&r);
}

static void every_step_arrives_bit_for_bit(void **unused)
{
    (void)unused;
    expect_every_step(0);
}

static void so_it_does_without_wide_vectors(void **unused)
{
    (void)unused;
    expect_every_step(TAHR_TELEMETRY_NARROW);
}

/* A ring that holds a dozen steps and a sink that waits now and then: most is dropped, and what arrives is right. */
static void what_is_left_by_drops_and_thinning_is_still_right(void **unused)
{
    record r;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m[CHARACTERS];
    uint64_t truncated = 0;
    (void)unused;
    record_init(&r);
    listener_describe(&r.ear, CHARACTERS, &desc);
    desc.ring_bytes = 8192;
    desc.every = 2;
    r.ear.fail_every = 7;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    for (uint32_t i = 0; i < CHARACTERS; i++)
        made_up_init(&m[i], i);
    for (uint32_t step = 0; step < STEPS; step++) {
        if (step % 64 == 0) listener_close(&r.ear);
        if (step % 64 == 20) listener_open(&r.ear);
        for (uint32_t i = 0; i < CHARACTERS; i++)
            truncated += take(&r, t, &m[i], i, step) == TAHR_TRUNCATED;
    }
    listener_open(&r.ear);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    check_counts(&r.ear, t, 0);
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    assert_true(truncated > 0 && c.dropped[TAHR_MESSAGE_INPUT] > 0 && c.dropped[TAHR_MESSAGE_EVENT] > 0);
    assert_true(c.dropped[TAHR_MESSAGE_REPORT] > c.dropped[TAHR_MESSAGE_INPUT]); /* inputs outlive reports */
    assert_int_equal(c.offered[TAHR_MESSAGE_STATE], CHARACTERS * STEPS);
    assert_int_equal(c.thinned[TAHR_MESSAGE_STATE], CHARACTERS * STEPS / 2);
    assert_int_equal(c.last_failure, TAHR_E_FILE);
    assert_true(c.most_filled > 0 && c.most_filled <= 8192);
    for (int k = TAHR_MESSAGE_STATE; k <= TAHR_MESSAGE_SNAPSHOT; k++)
        assert_true(r.ear.got[k] > 0 && c.failed[k] > 0);
    tahr_telemetry_destroy(t);
    record_end(&r);
}

/* A million and more, and at the end one of each that arrives, so that every gap in a sequence is seen. */
static void a_million_messages_are_received_or_counted_as_dropped(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    uint64_t events = 0, snapshots = 0;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    desc.ring_bytes = 16384;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 1);
    const uint32_t steps = 330000;
    for (uint32_t i = 0; i < steps; i++) {
        if (i % 4096 == 0) listener_close(&ear);
        if (i % 4096 == 512) listener_open(&ear);
        made_up_step(&m);
        if (i + 1 == steps) { /* the sink has read all that came before, and there is room */
            tahr_telemetry_counts c = {.struct_size = sizeof c};
            uint64_t waiting;
            do {
                assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
                waiting = 0;
                for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
                    waiting += c.offered[k] - c.dropped[k] - c.delivered[k];
            } while (waiting > 0);
            m.report.event_count = 1;
            m.events[0].type = 1;
        }
        if (i % 8 == 0 || i + 1 == steps) {
            made_up_change(&m);
            m.state.reserved[0] = (uint8_t)(m.state.reserved[0] + 1); /* another one in any case */
            tahr_telemetry_begin(t, 0, 0, 0, &m.state);
            snapshots++;
            m.state.reserved[1] = (uint8_t)(m.state.reserved[1] + 1);
        }
        const tahr_telemetry_step s = made_up_pushed(&m, 0);
        tahr_telemetry_push(t, 0, &s);
        events += m.report.event_count;
    }
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    check_counts(&ear, t, 0);
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    const uint64_t sent[] = {steps, events, steps, steps, snapshots};
    uint64_t all = 0;
    for (int k = TAHR_MESSAGE_STATE; k <= TAHR_MESSAGE_SNAPSHOT; k++) {
        assert_int_equal(c.offered[k], sent[k]);
        assert_int_equal(ear.got[k] + c.dropped[k], sent[k]);
        assert_int_equal(ear.missed[k], c.dropped[k]);
        assert_true(c.dropped[k] > 0 && ear.got[k] > 0);
        all += sent[k];
    }
    assert_true(all > 1000000);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

/* A quarter of the ring is left for what cannot be had again. */
static void inputs_and_events_outlive_states(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    desc.ring_bytes = 65536;
    listener_close(&ear);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    listener_wait_for_call(&ear); /* its first world: nothing is read any more */
    made_up_init(&m, 3);
    uint32_t until_state = 0, until_input = 0, steps = 0;
    for (; until_input == 0 && steps < 10000; steps++) {
        tahr_telemetry_counts c = {.struct_size = sizeof c};
        made_up_step(&m);
        m.report.event_count = 1;
        const tahr_telemetry_step s = made_up_pushed(&m, 0);
        tahr_telemetry_push(t, 0, &s);
        tahr_telemetry_get_counts(t, &c);
        if (c.dropped[TAHR_MESSAGE_STATE] && !until_state) until_state = steps;
        if (c.dropped[TAHR_MESSAGE_INPUT]) until_input = steps;
        assert_int_equal(c.dropped[TAHR_MESSAGE_INPUT], c.dropped[TAHR_MESSAGE_EVENT]);
        assert_int_equal(c.dropped[TAHR_MESSAGE_STATE], c.dropped[TAHR_MESSAGE_REPORT]);
    }
    assert_true(until_state > 50 && until_input > until_state + 40);
    listener_open(&ear);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], until_state);
    assert_int_equal(ear.got[TAHR_MESSAGE_INPUT], until_input);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void nothing_is_sent_or_counted_of_what_nobody_wants(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    const tahr_sink all = ear.sink;
    ear.sink = (tahr_sink){.struct_size = all.struct_size,
                           .abi_major = all.abi_major,
                           .abi_minor = all.abi_minor,
                           .name = "deaf",
                           .user = all.user};
    for (int only_events = 0; only_events < 2; only_events++) {
        tahr_telemetry_counts c = {.struct_size = sizeof c};
        uint64_t sum = 0;
        if (only_events) ear.sink.event = all.event;
        assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
        made_up_init(&m, 1);
        for (int i = 0; i < 100; i++) {
            assert_int_equal(tahr_telemetry_begin(t, 0, 0, 0, &m.state), TAHR_OK);
            made_up_step(&m);
            m.report.event_count = 2;
            const tahr_telemetry_step s = made_up_pushed(&m, 0);
            assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_OK);
        }
        assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_TOUCH, NULL, 0, 0, 2), TAHR_OK);
        assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
        assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
        for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
            sum += c.offered[k] + c.dropped[k] + c.thinned[k];
        assert_int_equal(sum, only_events ? 200 : 0);
        assert_int_equal(ear.got[TAHR_MESSAGE_EVENT], only_events ? 200 : 0);
        tahr_telemetry_destroy(t);
    }
    listener_end(&ear);
}

/* Of a step that failed nothing is sent: it did not happen. */
static void a_step_that_failed_is_not_there(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 1);
    for (int i = 0; i < 10; i++) {
        made_up_step(&m);
        tahr_telemetry_step s = made_up_pushed(&m, 0);
        s.status = i % 2 ? TAHR_E_BACKEND : TAHR_OK;
        assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_OK);
    }
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 5);
    assert_int_equal(ear.missed[TAHR_MESSAGE_STATE], 0);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_step_arrives_bit_for_bit),
        cmocka_unit_test(so_it_does_without_wide_vectors),
        cmocka_unit_test(what_is_left_by_drops_and_thinning_is_still_right),
        cmocka_unit_test(a_million_messages_are_received_or_counted_as_dropped),
        cmocka_unit_test(inputs_and_events_outlive_states),
        cmocka_unit_test(nothing_is_sent_or_counted_of_what_nobody_wants),
        cmocka_unit_test(a_step_that_failed_is_not_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_steps: built without libtahr_threads");
    return 77;
}
#endif

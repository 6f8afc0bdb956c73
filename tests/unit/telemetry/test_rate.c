/* SPDX-License-Identifier: MIT
 * test_rate.c: which states are due. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"

enum { MOST = 20000 };

typedef struct due {
    listener ear;
    uint32_t steps[MOST], count; /* whose states came */
} due;

static void see_state(void *test, const tahr_stamp *stamp, const tahr_state *state)
{
    due *d = test;
    (void)state;
    d->steps[d->count++] = (uint32_t)stamp->step;
}

/* Takes steps of dt after some slow ones of 0.1 s; returns the counts. */
static tahr_telemetry_counts run_after(due *d, const tahr_telemetry_desc *desc, uint32_t slow, uint32_t steps,
                                       double dt)
{
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    tahr_telemetry *t;
    made_up m;
    made_up_init(&m, 9);
    d->count = 0;
    memset(d->ear.got, 0, sizeof d->ear.got);
    memset(d->ear.next, 0, sizeof d->ear.next);
    assert_int_equal(tahr_telemetry_create(desc, &t), TAHR_OK);
    for (uint32_t i = 0; i < steps; i++) {
        made_up_step(&m);
        m.report.event_count = 1;
        tahr_telemetry_step s = made_up_pushed(&m, 0);
        s.dt = i < slow ? 0.1 : dt;
        assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_OK);
    }
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_int_equal(d->count, c.delivered[TAHR_MESSAGE_STATE]);
    assert_int_equal(c.offered[TAHR_MESSAGE_STATE], steps);
    assert_int_equal(c.offered[TAHR_MESSAGE_STATE], c.delivered[TAHR_MESSAGE_STATE] + c.thinned[TAHR_MESSAGE_STATE]);
    assert_int_equal(d->ear.got[TAHR_MESSAGE_EVENT], steps); /* never thinned */
    for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
        assert_int_equal(d->ear.missed[k], 0); /* what was not due has no number */
    return c;
}

static tahr_telemetry_counts run(due *d, const tahr_telemetry_desc *desc, uint32_t steps, double dt)
{
    return run_after(d, desc, 0, steps, dt);
}

static void due_init(due *d, tahr_telemetry_desc *desc)
{
    listener_init(&d->ear, d);
    d->ear.on_state = see_state;
    listener_describe(&d->ear, 1, desc);
    desc->ring_bytes = 16 << 20;
}

static void every_nth_state_is_sent_the_first_among_them(void **unused)
{
    static due d;
    tahr_telemetry_desc desc;
    (void)unused;
    due_init(&d, &desc);
    for (desc.every = 0; desc.every < 6; desc.every++) {
        const uint32_t n = desc.every ? desc.every : 1;
        const tahr_telemetry_counts c = run(&d, &desc, 600, 1.0 / 60);
        assert_int_equal(d.count, 600 / n);
        for (uint32_t i = 0; i < d.count; i++)
            assert_int_equal(d.steps[i], i * n);
        assert_int_equal(c.delivered[TAHR_MESSAGE_INPUT], 600);
        assert_int_equal(c.delivered[TAHR_MESSAGE_REPORT], 600);
    }
    listener_end(&d.ear);
}

static void a_rate_is_kept_on_average_and_never_made_up_for(void **unused)
{
    static due d;
    tahr_telemetry_desc desc;
    (void)unused;
    due_init(&d, &desc);
    const double rates[] = {1, 7, 25, 50};
    for (int i = 0; i < 4; i++) { /* 200 simulated seconds */
        desc.state_rate = rates[i];
        run(&d, &desc, 12000, 1.0 / 60);
        assert_int_equal(d.steps[0], 0);
        assert_true(d.count >= 200 * rates[i] - 1 && d.count <= 200 * rates[i] + 1);
        const uint32_t most = (uint32_t)(60 / rates[i]) + 1;
        for (uint32_t k = 1; k < d.count; k++)
            assert_true(d.steps[k] - d.steps[k - 1] <= most);
    }
    run(&d, &desc, 100, 0.1); /* slower than the rate: all */
    assert_int_equal(d.count, 100);
    run_after(&d, &desc, 100, 700, 1.0 / 60); /* and then no more than the rate */
    assert_true(d.count >= 100 + 499 && d.count <= 100 + 502);
    desc.every = 6; /* the scarcer of the two */
    desc.state_rate = 25;
    run(&d, &desc, 600, 1.0 / 60);
    assert_int_equal(d.count, 100);
    listener_end(&d.ear);
}

static void thin_all_sends_inputs_and_reports_with_the_states_that_are_due(void **unused)
{
    static due d;
    tahr_telemetry_desc desc;
    (void)unused;
    due_init(&d, &desc);
    desc.every = 4;
    desc.flags = TAHR_TELEMETRY_THIN_ALL;
    const tahr_telemetry_counts c = run(&d, &desc, 400, 1.0 / 60);
    assert_int_equal(c.delivered[TAHR_MESSAGE_STATE], 100);
    assert_int_equal(c.delivered[TAHR_MESSAGE_INPUT], 100);
    assert_int_equal(c.delivered[TAHR_MESSAGE_REPORT], 100);
    assert_int_equal(c.thinned[TAHR_MESSAGE_INPUT], 300);
    listener_end(&d.ear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_nth_state_is_sent_the_first_among_them),
        cmocka_unit_test(a_rate_is_kept_on_average_and_never_made_up_for),
        cmocka_unit_test(thin_all_sends_inputs_and_reports_with_the_states_that_are_due),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_rate: built without libtahr_threads");
    return 77;
}
#endif

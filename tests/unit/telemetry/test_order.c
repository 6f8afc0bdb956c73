/* SPDX-License-Identifier: MIT
 * test_order.c: whatever lanes they are in, a change of the world is told before the steps that see it, and after those
 * that do not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"
#include "threads/telemetry.h"

enum { LANES = 3, EACH = 4, EPOCHS = 2000 };

typedef struct order {
    listener ear;
    tahr_telemetry *telemetry;
    pthread_barrier_t begins, ends; /* of an epoch's steps */
    uint64_t epoch, changes, steps;
} order;

static void see_change(void *test, const tahr_sink_change *change)
{
    order *o = test;
    listener_expect(&o->ear, change->epoch == o->epoch + (change->kind != TAHR_CHANGE_SNAPSHOT), "epochs one by one");
    listener_expect(&o->ear, change->revision == 10 + change->epoch, "the revision after the change");
    o->epoch = change->epoch;
    o->changes += change->kind != TAHR_CHANGE_SNAPSHOT;
}

static void see_input(void *test, const tahr_stamp *stamp, const tahr_sink_input *input)
{
    order *o = test;
    (void)input;
    listener_expect(&o->ear, stamp->epoch == o->epoch, "the steps of an epoch after its change");
    o->steps++;
}

typedef struct stepper {
    order *order;
    uint32_t lane;
    uint64_t taken;
} stepper;

/* Lanes take different numbers of steps, and some take none. */
static void *step_all(void *user)
{
    stepper *s = user;
    made_up m[EACH];
    for (uint32_t i = 0; i < EACH; i++)
        made_up_init(&m[i], 100 * s->lane + i);
    for (int e = 0; e < EPOCHS; e++) {
        pthread_barrier_wait(&s->order->begins);
        for (uint64_t n = made_up_number(&m[0]) % 9; n > 0; n--) {
            const uint32_t i = (uint32_t)(n % EACH), character = s->lane * EACH + i;
            tahr_telemetry_begin(s->order->telemetry, s->lane, character, 0, &m[i].state);
            made_up_step(&m[i]);
            const tahr_telemetry_step step = made_up_pushed(&m[i], character);
            s->taken += tahr_telemetry_push(s->order->telemetry, s->lane, &step) == TAHR_OK;
        }
        pthread_barrier_wait(&s->order->ends);
    }
    return NULL;
}

static void changes_come_before_the_steps_that_see_them(void **unused)
{
    static order o;
    tahr_telemetry_desc desc;
    pthread_t threads[LANES];
    stepper steppers[LANES];
    uint64_t taken = 0;
    (void)unused;
    listener_init(&o.ear, &o);
    o.ear.on_change = see_change;
    o.ear.on_input = see_input;
    listener_describe(&o.ear, LANES * EACH, &desc);
    desc.lanes = LANES;
    desc.bodies = 2;
    desc.ring_bytes = 16 << 20; /* room for all, however late the thread comes */
    desc.drain_period = 1e-5;   /* looks while others write */
    assert_int_equal(tahr_telemetry_create(&desc, &o.telemetry), TAHR_OK);
    assert_int_equal(pthread_barrier_init(&o.begins, NULL, LANES + 1), 0);
    assert_int_equal(pthread_barrier_init(&o.ends, NULL, LANES + 1), 0);
    for (uint32_t i = 0; i < LANES; i++) {
        steppers[i] = (stepper){&o, i, 0};
        assert_int_equal(pthread_create(&threads[i], NULL, step_all, &steppers[i]), 0);
    }
    for (uint32_t e = 0; e < EPOCHS; e++) {
        const tahr_body_pose pose = {e % 2, 0, {{e, 0, 0}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_telemetry_change(o.telemetry, TAHR_CHANGE_MOVE, &pose, 1, 0.01, 11 + e), TAHR_OK);
        pthread_barrier_wait(&o.begins);
        pthread_barrier_wait(&o.ends);
    }
    for (uint32_t i = 0; i < LANES; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        taken += steppers[i].taken;
    }
    assert_int_equal(tahr_telemetry_stop(o.telemetry, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_null(atomic_load(&o.ear.wrong));
    assert_int_equal(o.changes, EPOCHS);
    assert_int_equal(o.steps, taken);
    assert_true(taken > EPOCHS);
    for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
        assert_int_equal(o.ear.missed[k], 0);
    tahr_telemetry_destroy(o.telemetry);
    pthread_barrier_destroy(&o.begins);
    pthread_barrier_destroy(&o.ends);
    listener_end(&o.ear);
}

/* Without its thread: what a pass does that read the epoch just before a change, and looked at the rings after it. */
static void a_step_of_a_later_epoch_waits_for_the_next_pass(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 2, &desc);
    desc.lanes = 2;
    tahr_telemetry *t = tahr__telemetry_lay_out(&desc);
    assert_non_null(t);
    made_up_init(&m, 1);
    const tahr_telemetry_step first = made_up_pushed(&m, 0), second = made_up_pushed(&m, 1);
    assert_int_equal(tahr_telemetry_push(t, 1, &second), TAHR_OK);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_TOUCH, NULL, 0, 0, 1), TAHR_OK);
    assert_int_equal(tahr_telemetry_push(t, 0, &first), TAHR_OK);
    assert_int_equal(tahr_telemetry_push(t, 1, &second), TAHR_OK);
    atomic_store(&t->epoch, 0);
    tahr__drain_pass(t);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 1);
    assert_int_equal(ear.got[TAHR_MESSAGE_BODY], 0);
    atomic_store(&t->epoch, 1);
    tahr__drain_pass(t);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 3);
    assert_int_equal(ear.got[TAHR_MESSAGE_BODY], 1);
    tahr__telemetry_free_memory(t);
    listener_end(&ear);
}

static void a_character_keeps_to_its_lane(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 2, &desc);
    desc.lanes = 2;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 1);
    const tahr_telemetry_step first = made_up_pushed(&m, 0), second = made_up_pushed(&m, 1);
    assert_int_equal(tahr_telemetry_begin(t, 1, 0, 0, &m.state), TAHR_OK);
    assert_int_equal(tahr_telemetry_push(t, 0, &second), TAHR_OK);
    assert_int_equal(tahr_telemetry_begin(t, 0, 0, 0, &m.state), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_push(t, 0, &first), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_push(t, 1, &second), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_push(t, 1, &first), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 2);
    listener_end(&ear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_come_before_the_steps_that_see_them),
        cmocka_unit_test(a_step_of_a_later_epoch_waits_for_the_next_pass),
        cmocka_unit_test(a_character_keeps_to_its_lane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_order: built without libtahr_threads");
    return 77;
}
#endif

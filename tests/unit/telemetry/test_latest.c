/* SPDX-License-Identifier: MIT
 * test_latest.c: the present of a character is whole, whoever asks and whatever the ring does. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"

enum { WRITES = 300000, LOOKS = 1000 };

typedef struct hammer {
    tahr_telemetry *telemetry;
    atomic_int ended;
    _Atomic uint64_t whole;
    uint64_t torn, steps_back;
} hammer;

/* All 64 words follow from the number of the step. */
static void write_words(tahr_state *state, uint64_t n)
{
    uint64_t words[64];
    for (uint64_t i = 0; i < 64; i++)
        words[i] = (n + 1) * (2 * i + 1);
    memcpy(state, words, sizeof *state);
}

static void *look(void *user)
{
    hammer *h = user;
    uint64_t last = 0;
    while (!atomic_load(&h->ended)) {
        tahr_state state, expected;
        tahr_stamp stamp;
        if (tahr_telemetry_latest(h->telemetry, 0, &state, &stamp) != TAHR_OK) continue; /* unknown: no pause */
        write_words(&expected, stamp.step);
        h->torn += memcmp(&state, &expected, sizeof state) != 0 || stamp.sequence != stamp.step ||
                   stamp.time_ns != 1000000 * ((int64_t)stamp.step + 1);
        h->steps_back += stamp.step < last;
        last = stamp.step;
        atomic_fetch_add(&h->whole, 1);
    }
    return NULL;
}

static void it_is_never_torn(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    pthread_t readers[2];
    static hammer looks[2];
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    desc.ring_bytes = 4096; /* most is dropped: that is no matter here */
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 1);
    tahr_telemetry_step s = made_up_pushed(&m, 0);
    s.dt = 0.001;
    write_words(&m.state, 0);
    tahr_telemetry_push(t, 0, &s);
    for (int i = 0; i < 2; i++) {
        looks[i].telemetry = t;
        assert_int_equal(pthread_create(&readers[i], NULL, look, &looks[i]), 0);
    }
    uint64_t n = 1;
    for (; n < WRITES || atomic_load(&looks[0].whole) < LOOKS || atomic_load(&looks[1].whole) < LOOKS; n++) {
        write_words(&m.state, n);
        tahr_telemetry_push(t, 0, &s);
    }
    for (int i = 0; i < 2; i++) {
        atomic_store(&looks[i].ended, 1);
        assert_int_equal(pthread_join(readers[i], NULL), 0);
        assert_int_equal(looks[i].torn, 0);
        assert_int_equal(looks[i].steps_back, 0);
    }
    tahr_state state, last;
    assert_int_equal(tahr_telemetry_latest(t, 0, &state, NULL), TAHR_OK);
    write_words(&last, n - 1);
    assert_memory_equal(&state, &last, sizeof state);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void it_is_what_was_seen_last(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    tahr_state state, untouched;
    tahr_stamp stamp;
    made_up m;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 3, &desc);
    desc.every = 2;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 4);
    memset(&untouched, 7, sizeof untouched);
    state = untouched;
    assert_int_equal(tahr_telemetry_latest(t, 2, &state, NULL), TAHR_E_NOT_FOUND);
    assert_memory_equal(&state, &untouched, sizeof state);
    assert_int_equal(tahr_telemetry_begin(t, 0, 2, 0, &m.state), TAHR_OK); /* all zero, and seen */
    assert_int_equal(tahr_telemetry_latest(t, 2, &state, &stamp), TAHR_OK);
    assert_memory_equal(&state, &m.state, sizeof state);
    for (uint64_t i = 0; i < 10; i++) {
        made_up_step(&m);
        const tahr_telemetry_step s = made_up_pushed(&m, 2);
        tahr_telemetry_change(t, TAHR_CHANGE_TOUCH, NULL, 0, 0, i);
        assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_OK);
        assert_int_equal(tahr_telemetry_latest(t, 2, &state, &stamp), TAHR_OK);
        assert_memory_equal(&state, &m.state, sizeof state);
        assert_int_equal(stamp.character, 2);
        assert_int_equal(stamp.step, i);
        assert_int_equal(stamp.sequence, (i + 1) / 2);
        assert_int_equal(stamp.epoch, i + 1);
        assert_int_equal(stamp.time_ns, 4000000 * (int64_t)(i + 1));
        assert_int_equal(stamp.wall_ns, 0);
    }
    made_up_step(&m); /* written to by the caller */
    assert_int_equal(tahr_telemetry_begin(t, 0, 2, 0, &m.state), TAHR_OK);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_int_equal(tahr_telemetry_latest(t, 2, &state, &stamp), TAHR_OK); /* still answers */
    assert_memory_equal(&state, &m.state, sizeof state);
    assert_int_equal(tahr_telemetry_latest(t, 3, &state, NULL), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_latest(t, 2, NULL, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_latest(NULL, 2, &state, NULL), TAHR_E_NULL);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_never_torn),
        cmocka_unit_test(it_is_what_was_seen_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_latest: built without libtahr_threads");
    return 77;
}
#endif

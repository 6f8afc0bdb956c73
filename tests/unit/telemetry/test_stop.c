/* SPDX-License-Identifier: MIT
 * test_stop.c: a telemetry ends in the time given, whatever its sink does, and every message is counted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"

/* Memory that tells when it is given back. */
typedef struct ward {
    tahr_allocator allocator;
    pthread_mutex_t lock;
    pthread_cond_t freed;
    int held; /* blocks */
} ward;

static void *ward_alloc(void *user, size_t size, size_t alignment)
{
    ward *w = user;
    w->held++;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void ward_free(void *user, void *memory, size_t size, size_t alignment)
{
    ward *w = user;
    (void)size, (void)alignment;
    free(memory);
    pthread_mutex_lock(&w->lock);
    w->held--;
    pthread_cond_signal(&w->freed);
    pthread_mutex_unlock(&w->lock);
}

static void ward_init(ward *w)
{
    w->held = 0;
    w->allocator = (tahr_allocator){w, ward_alloc, ward_free};
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->freed, NULL);
}

/* Returns whether all was given back within a minute. */
static int ward_wait(ward *w)
{
    struct timespec end;
    int woken = 0;
    clock_gettime(CLOCK_REALTIME, &end);
    end.tv_sec += 60;
    pthread_mutex_lock(&w->lock);
    while (w->held > 0 && woken == 0)
        woken = pthread_cond_timedwait(&w->freed, &w->lock, &end);
    const int all = w->held == 0;
    pthread_mutex_unlock(&w->lock);
    return all;
}

/* 100 steps into a ring that has room for them. */
static tahr_telemetry *start(listener *ear, ward *w, int closed)
{
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    listener_init(ear, NULL);
    listener_describe(ear, 1, &desc);
    ward_init(w);
    desc.allocator = &w->allocator;
    if (closed) listener_close(ear);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    if (closed) listener_wait_for_call(ear);
    made_up_init(&m, 2);
    for (int i = 0; i < 100; i++) {
        assert_int_equal(tahr_telemetry_begin(t, 0, 0, 0, &m.state), TAHR_OK);
        made_up_step(&m);
        const tahr_telemetry_step s = made_up_pushed(&m, 0);
        assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_OK);
    }
    return t;
}

static void check_sums(const tahr_telemetry *t, const listener *ear)
{
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    for (int k = 0; k < TAHR_MESSAGE_COUNT; k++) {
        assert_int_equal(c.offered[k], c.thinned[k] + c.dropped[k] + c.delivered[k] + c.failed[k]);
        assert_int_equal(c.delivered[k], ear->got[k]);
    }
    assert_int_equal(c.offered[TAHR_MESSAGE_STATE], 100);
}

static void drain_delivers_all_and_ends_with_the_totals(void **unused)
{
    listener ear;
    ward w;
    (void)unused;
    tahr_telemetry *t = start(&ear, &w, 0);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    check_sums(t, &ear);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 100);
    assert_true(ear.got[TAHR_MESSAGE_WORLD] >= 2);                           /* first and last of all */
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_ABANDON, 0), TAHR_OK); /* again */
    tahr_telemetry_destroy(t);
    assert_int_equal(w.held, 0);
    listener_end(&ear);
}

static void destroy_alone_drains(void **unused)
{
    listener ear;
    ward w;
    (void)unused;
    tahr_telemetry_destroy(start(&ear, &w, 0));
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 100);
    assert_int_equal(w.held, 0);
    tahr_telemetry_destroy(NULL);
    listener_end(&ear);
}

static void who_is_held_up_times_out_and_may_be_stopped_again(void **unused)
{
    for (uint32_t how = TAHR_STOP_DRAIN; how <= TAHR_STOP_ABANDON; how++) {
        listener ear;
        ward w;
        (void)unused;
        tahr_telemetry *t = start(&ear, &w, 1);
        assert_int_equal(tahr_telemetry_stop(t, how, 0.02), TAHR_E_TIMEOUT);
        assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 0), TAHR_E_TIMEOUT);
        listener_open(&ear);
        assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_TRUNCATED);
        check_sums(t, &ear);
        assert_int_equal(ear.got[TAHR_MESSAGE_WORLD], 1); /* the call under way, and none after it */
        assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 0);
        assert_int_equal(ear.got[TAHR_MESSAGE_INPUT], 0);
        assert_int_equal(ear.flushes, 0);
        assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
        tahr_telemetry_destroy(t);
        assert_int_equal(w.held, 0);
        listener_end(&ear);
    }
}

static void who_is_left_alone_frees_all_when_the_sink_returns(void **unused)
{
    listener ear;
    ward w;
    (void)unused;
    tahr_telemetry *t = start(&ear, &w, 1);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 0.02), TAHR_E_TIMEOUT);
    tahr_telemetry_destroy(t);
    assert_int_equal(w.held, 1);
    listener_open(&ear);
    assert_true(ward_wait(&w));
    assert_int_equal(ear.got[TAHR_MESSAGE_WORLD], 1);
    assert_int_equal(ear.got[TAHR_MESSAGE_STATE], 0);
    listener_end(&ear);
}

static void destroy_does_not_wait_for_ever(void **unused)
{
    listener ear;
    ward w;
    (void)unused;
    tahr_telemetry_destroy(start(&ear, &w, 1)); /* 2 s */
    assert_int_equal(w.held, 1);
    listener_open(&ear);
    assert_true(ward_wait(&w));
    listener_end(&ear);
}

static void abandon_counts_what_is_left_as_dropped(void **unused)
{
    listener ear;
    ward w;
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    (void)unused;
    tahr_telemetry *t = start(&ear, &w, 1);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_ABANDON, 0), TAHR_E_TIMEOUT);
    listener_open(&ear);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_ABANDON, 100), TAHR_TRUNCATED);
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    assert_int_equal(c.dropped[TAHR_MESSAGE_STATE], 100);
    assert_int_equal(c.dropped[TAHR_MESSAGE_INPUT], 100);
    assert_int_equal(c.dropped[TAHR_MESSAGE_REPORT], 100);
    assert_int_equal(c.dropped[TAHR_MESSAGE_SNAPSHOT], 1);
    assert_int_equal(c.dropped[TAHR_MESSAGE_EVENT], c.offered[TAHR_MESSAGE_EVENT]);
    check_sums(t, &ear);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void two_at_once_do_not_know_of_each_other(void **unused)
{
    listener ears[2];
    ward wards[2];
    (void)unused;
    tahr_telemetry *stalled = start(&ears[0], &wards[0], 1), *other = start(&ears[1], &wards[1], 0);
    assert_int_equal(tahr_telemetry_stop(other, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_int_equal(ears[1].got[TAHR_MESSAGE_STATE], 100);
    listener_open(&ears[0]);
    assert_int_equal(tahr_telemetry_stop(stalled, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_int_equal(ears[0].got[TAHR_MESSAGE_STATE], 100);
    tahr_telemetry_destroy(stalled);
    tahr_telemetry_destroy(other);
    listener_end(&ears[0]);
    listener_end(&ears[1]);
}

static void see_world(void *test, const tahr_sink_world *world)
{
    listener *ear = test;
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    listener_expect(ear, sigismember(&blocked, SIGTERM) == 1 && sigismember(&blocked, SIGUSR1) == 1,
                    "no signal of the application's on this thread");
    listener_expect(ear, strcmp(world->level, "yard") == 0 && strcmp(world->backend, "") == 0, "the names given");
    listener_expect(ear, world->level_hash == 77 && world->revision == 5 && world->characters == 3,
                    "the numbers given");
    listener_expect(ear, world->config_count == 1 && world->configs->preset == TAHR_PRESET_PRECISE, "the config given");
    listener_expect(ear, world->sequence == ear->got[TAHR_MESSAGE_WORLD], "its own sequence");
    listener_expect(ear, world->run > 0 && world->wall_ns >= world->run, "the time of the start, and now");
    listener_expect(ear, world->state_rate == 20, "the rate given");
}

static void the_world_is_told_of_first_of_all(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    char name[] = "yard";
    (void)unused;
    listener_init(&ear, &ear);
    ear.on_world = see_world;
    listener_describe(&ear, 3, &desc);
    desc.level = name;
    desc.level_hash = 77;
    desc.revision = 5;
    desc.state_rate = 20;
    desc.world_period = 0.01;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    name[0] = 'x'; /* everything was copied */
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    do { /* and again and again */
        assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    } while (c.delivered[TAHR_MESSAGE_WORLD] < 4);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    assert_null(atomic_load(&ear.wrong));
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drain_delivers_all_and_ends_with_the_totals),
        cmocka_unit_test(destroy_alone_drains),
        cmocka_unit_test(who_is_held_up_times_out_and_may_be_stopped_again),
        cmocka_unit_test(who_is_left_alone_frees_all_when_the_sink_returns),
        cmocka_unit_test(destroy_does_not_wait_for_ever),
        cmocka_unit_test(abandon_counts_what_is_left_as_dropped),
        cmocka_unit_test(two_at_once_do_not_know_of_each_other),
        cmocka_unit_test(the_world_is_told_of_first_of_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_stop: built without libtahr_threads");
    return 77;
}
#endif

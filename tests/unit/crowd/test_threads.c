/* SPDX-License-Identifier: MIT
 * test_threads.c: the pool of threads: every task once, whoever asks, and asleep in between. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include <tahr/crowd.h>

#ifdef TAHR_HAVE_THREADS
#include <pthread.h>
#include <tahr/threads.h>

enum { TASKS = 1000 };

typedef struct tally {
    atomic_uint done[TASKS];
    tahr_threads *threads;
} tally;

static void do_one(void *argument, uint32_t index)
{
    tally *t = argument;
    atomic_fetch_add(&t->done[index], 1);
}

static void clear(tally *t)
{
    for (int i = 0; i < TASKS; i++) {
        atomic_store(&t->done[i], 0);
    }
}

static void each_task_is_done_once_before_it_returns(void **unused)
{
    static const uint32_t counts[] = {0, 1, 2, 3, 8, 33};
    static tally t;
    (void)unused;
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        assert_int_equal(tahr_threads_create(NULL, counts[k], &t.threads), TAHR_OK);
        if (counts[k] > 0) {
            assert_int_equal(tahr_threads_count(t.threads), counts[k]);
        }
        for (uint32_t count = 0; count <= TASKS; count = 3 * count + 1) {
            clear(&t);
            tahr_threads_run(t.threads, do_one, &t, count);
            for (uint32_t i = 0; i < TASKS; i++) {
                assert_int_equal(atomic_load(&t.done[i]), i < count);
            }
        }
        tahr_threads_destroy(t.threads);
    }
}

static void many_short_rounds_follow_each_other(void **unused)
{
    static tally t;
    (void)unused;
    assert_int_equal(tahr_threads_create(NULL, 4, &t.threads), TAHR_OK);
    clear(&t);
    for (int i = 0; i < 2000; i++) {
        tahr_threads_run(t.threads, do_one, &t, 3);
    }
    for (int i = 0; i < 3; i++) {
        assert_int_equal(atomic_load(&t.done[i]), 2000);
    }
    tahr_threads_destroy(t.threads);
}

static void run_within(void *argument, uint32_t index)
{
    tally *t = argument;
    (void)index;
    tahr_threads_run(t->threads, do_one, t, 10);
}

static void a_task_may_hand_out_tasks(void **unused)
{
    static tally t;
    (void)unused;
    assert_int_equal(tahr_threads_create(NULL, 3, &t.threads), TAHR_OK);
    clear(&t);
    tahr_threads_run(t.threads, run_within, &t, 20);
    for (int i = 0; i < 10; i++) {
        assert_int_equal(atomic_load(&t.done[i]), 20);
    }
    tahr_threads_destroy(t.threads);
}

static void *ask(void *argument)
{
    tally *t = argument;
    for (int i = 0; i < 200; i++) {
        tahr_threads_run(t->threads, do_one, t, 20);
    }
    return NULL;
}

static void two_threads_may_ask_at_once(void **unused)
{
    static tally t;
    pthread_t other;
    (void)unused;
    assert_int_equal(tahr_threads_create(NULL, 3, &t.threads), TAHR_OK);
    clear(&t);
    assert_int_equal(pthread_create(&other, NULL, ask, &t), 0);
    ask(&t);
    pthread_join(other, NULL);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(atomic_load(&t.done[i]), 400);
    }
    tahr_threads_destroy(t.threads);
}

/* Threads that waited by looking would use half a second of the processor in half a second. */
static void who_waits_sleeps(void **unused)
{
    const struct timespec pause = {0, 200000000};
    tahr_threads *threads = NULL;
    struct timespec before, after;
    (void)unused;
    assert_int_equal(tahr_threads_create(NULL, 4, &threads), TAHR_OK);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    nanosleep(&pause, NULL);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    const double used = (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
    assert_true(used < 0.05);
    tahr_threads_destroy(threads);
}

static void *no_alloc(void *user, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    return NULL;
}

static void no_free(void *user, void *memory, size_t size, size_t alignment)
{
    (void)user, (void)memory, (void)size, (void)alignment;
}

static void what_is_wrong_is_refused(void **unused)
{
    const tahr_allocator none = {NULL, no_alloc, no_free};
    static tally t;
    tahr_threads *threads = NULL;
    (void)unused;
    assert_int_equal(tahr_threads_create(NULL, 2, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_threads_create(NULL, 257, &threads), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_threads_create(&none, 2, &threads), TAHR_E_MEMORY);
    assert_null(threads);
    assert_int_equal(tahr_threads_count(NULL), 0);
    tahr_threads_destroy(NULL);
    clear(&t);
    tahr_threads_run(NULL, do_one, &t, 5); /* all on this thread */
    assert_int_equal(atomic_load(&t.done[4]), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_task_is_done_once_before_it_returns),
        cmocka_unit_test(many_short_rounds_follow_each_other),
        cmocka_unit_test(a_task_may_hand_out_tasks),
        cmocka_unit_test(two_threads_may_ask_at_once),
        cmocka_unit_test(who_waits_sleeps),
        cmocka_unit_test(what_is_wrong_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_crowd_threads: built without libtahr_threads");
    return 77;
}
#endif

/* SPDX-License-Identifier: MIT
 * threads.c: a pool that sleeps on a condition and shares out the numbers of tasks by atomic counters.
 *
 * Each thread has a share of its own, the same part of the tasks in every round, so that what it worked on last is what
 * its processor has at hand. Who is done with his share helps with the next one's.
 *
 * A round is what one call of tahr_threads_run hands out. A thread joins it when the system lets it run, and only while
 * it is open, which ends with the last task handed out: nobody waits for a thread that comes too late to help, as on a
 * machine with other work to do many come; and the next round cannot begin while one that joined still looks at the
 * last. */
#include <tahr/threads.h>

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

#include "../common/malloc.h"

enum { MOST = 256 };

/* Tasks of one thread, on a line of memory of their own. */
typedef struct share {
    _Alignas(64) atomic_uint_fast64_t next; /* wider than end: each thread goes beyond it once */
    uint64_t end;
} share;

struct tahr_threads {
    share shares[MOST]; /* started + 1; the last is that of who hands out */
    tahr_allocator allocator;
    pthread_mutex_t lock;
    pthread_cond_t begun, done; /* a round, or the end of all; the round for all who joined */
    pthread_t thread[MOST];
    uint32_t started; /* of thread */
    uint32_t alive;   /* of them, that have a number */
    uint32_t at_work; /* of them, in this round */
    uint32_t busy;    /* 1: a round is under way, */
    uint32_t open;    /* and may be joined */
    uint32_t ends;
    uint64_t round;
    tahr_task_fn task;
    void *argument;
};

static void work(tahr_threads *t, uint32_t own, tahr_task_fn task, void *argument)
{
    const uint32_t shares = t->started + 1;
    for (uint32_t k = 0; k < shares; k++) {
        share *s = &t->shares[(own + k) % shares];
        for (;;) {
            uint64_t i = atomic_fetch_add_explicit(&s->next, 1, memory_order_relaxed);
            if (i >= s->end) break;
            task(argument, (uint32_t)i);
        }
    }
}

static void *live(void *user)
{
    tahr_threads *t = user;
    uint64_t seen = 0;
    pthread_mutex_lock(&t->lock);
    const uint32_t own = t->alive++;
    for (;;) {
        while ((t->round == seen || !t->open) && !t->ends)
            pthread_cond_wait(&t->begun, &t->lock);
        if (t->ends) break;
        seen = t->round;
        t->at_work++;
        tahr_task_fn task = t->task;
        void *argument = t->argument;
        pthread_mutex_unlock(&t->lock);
        work(t, own, task, argument);
        pthread_mutex_lock(&t->lock);
        if (--t->at_work == 0) pthread_cond_signal(&t->done);
    }
    pthread_mutex_unlock(&t->lock);
    return NULL;
}

static uint32_t processors(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : (n > MOST ? MOST : (uint32_t)n);
}

tahr_status tahr_threads_create(const tahr_allocator *allocator, uint32_t count, tahr_threads **threads)
{
    if (!threads) return TAHR_E_NULL;
    if (count > MOST) return TAHR_E_ARGUMENT;
    const tahr_allocator a = tahr__allocator_or_malloc(allocator);
    tahr_threads *t = a.alloc(a.user, sizeof *t, 64);
    if (!t) return TAHR_E_MEMORY;
    memset(t, 0, sizeof *t);
    t->allocator = a;
    for (uint32_t i = 0; i < MOST; i++)
        atomic_init(&t->shares[i].next, 0);
    pthread_mutex_init(&t->lock,
                       NULL); /* of the default kind: cannot fail where there is memory for it, and there is */
    pthread_cond_init(&t->begun, NULL);
    pthread_cond_init(&t->done, NULL);
    const uint32_t wanted = (count ? count : processors()) - 1;
    while (t->started < wanted && pthread_create(&t->thread[t->started], NULL, live, t) == 0)
        t->started++;
    if (t->started < wanted) {
        tahr_threads_destroy(t);
        return TAHR_E_MEMORY;
    }
    *threads = t;
    return TAHR_OK;
}

void tahr_threads_destroy(tahr_threads *t)
{
    if (!t) return;
    pthread_mutex_lock(&t->lock);
    t->ends = 1;
    pthread_cond_broadcast(&t->begun);
    pthread_mutex_unlock(&t->lock);
    for (uint32_t i = 0; i < t->started; i++)
        pthread_join(t->thread[i], NULL);
    pthread_cond_destroy(&t->done);
    pthread_cond_destroy(&t->begun);
    pthread_mutex_destroy(&t->lock);
    const tahr_allocator a = t->allocator;
    a.free(a.user, t, sizeof *t, 64);
}

uint32_t tahr_threads_count(const tahr_threads *t)
{
    return t ? t->started + 1 : 0;
}

/* Returns 0 if the pool is at work already. */
static int begin(tahr_threads *t, tahr_task_fn task, void *argument, uint32_t count)
{
    pthread_mutex_lock(&t->lock);
    const int is_free = !t->busy;
    if (is_free) {
        t->busy = t->open = 1;
        t->task = task;
        t->argument = argument;
        const uint64_t shares = t->started + 1;
        for (uint64_t k = 0; k < shares; k++) {
            t->shares[k].end = count * (k + 1) / shares;
            atomic_store_explicit(&t->shares[k].next, count * k / shares, memory_order_relaxed);
        }
        t->round++;
        pthread_cond_broadcast(&t->begun);
    }
    pthread_mutex_unlock(&t->lock);
    return is_free;
}

void tahr_threads_run(void *threads, tahr_task_fn task, void *argument, uint32_t count)
{
    tahr_threads *t = threads;
    if (!t || t->started == 0 || count < 2 || !begin(t, task, argument, count)) {
        for (uint32_t i = 0; i < count; i++)
            task(argument, i);
        return;
    }
    work(t, t->started, task, argument);
    pthread_mutex_lock(&t->lock);
    t->open = 0;
    while (t->at_work > 0)
        pthread_cond_wait(&t->done, &t->lock);
    t->busy = 0;
    pthread_mutex_unlock(&t->lock);
}

/* SPDX-License-Identifier: MIT
 * telemetry.c: the life of a telemetry, and what it answers. */
#include "telemetry.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <time.h>

#include "telemetry_check.h"

static const double DEFAULT_STOP = 2; /* s, of tahr_telemetry_destroy */

static void say(const tahr_telemetry *t, int32_t level, const char *text)
{
    if (t->log.write) t->log.write(t->log.user, level, text);
}

/* The thread takes no signal of the application's. */
static int start_thread(tahr_telemetry *t)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const int failed = pthread_create(&t->thread, NULL, tahr__drain_live, t);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return failed;
}

/* Returns 0 if the system gives neither. */
static int make_lock(tahr_telemetry *t)
{
    pthread_condattr_t attributes;
    if (pthread_mutex_init(&t->lock, NULL) != 0) return 0;
    int made = pthread_condattr_init(&attributes) == 0;
    if (made) {
        made = pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC) == 0 &&
               pthread_cond_init(&t->changed, &attributes) == 0;
        pthread_condattr_destroy(&attributes);
    }
    if (!made) pthread_mutex_destroy(&t->lock);
    return made;
}

tahr_status tahr_telemetry_create(const tahr_telemetry_desc *desc, tahr_telemetry **telemetry)
{
    if (!desc || !telemetry) return TAHR_E_NULL;
    const tahr_status wrong = tahr__telemetry_check(desc);
    if (wrong < 0) return wrong;
    tahr_telemetry *t = tahr__telemetry_lay_out(desc);
    if (!t) return tahr__telemetry_complain(desc, TAHR_E_MEMORY, "the allocator gives no memory");
    if (!make_lock(t)) {
        tahr__telemetry_free_memory(t);
        return tahr__telemetry_complain(desc, TAHR_E_MEMORY, "the system gives no lock");
    }
    if (start_thread(t) != 0) {
        tahr__telemetry_free(t);
        return tahr__telemetry_complain(desc, TAHR_E_MEMORY, "the system gives no thread");
    }
    *telemetry = t;
    return TAHR_OK;
}

static struct timespec later(struct timespec from, double seconds)
{
    const double whole = (double)(int64_t)seconds;
    from.tv_sec += (time_t)whole;
    from.tv_nsec += (long)((seconds - whole) * 1e9);
    if (from.tv_nsec >= 1000000000) {
        from.tv_nsec -= 1000000000;
        from.tv_sec++;
    }
    return from;
}

/* With the lock held. Returns whether the thread has finished. */
static int wait_until(tahr_telemetry *t, const struct timespec *end)
{
    int woken = 0;
    while (!t->finished && woken != ETIMEDOUT)
        woken = pthread_cond_timedwait(&t->changed, &t->lock, end);
    return t->finished != 0;
}

/* With the lock held: ending only ever grows. */
static void end_by(tahr_telemetry *t, uint32_t how)
{
    if (atomic_load_explicit(&t->ending, memory_order_relaxed) < how)
        atomic_store_explicit(&t->ending, how, memory_order_release);
    pthread_cond_broadcast(&t->changed);
}

static uint64_t sum_of(const tahr__tally *tally)
{
    uint64_t sum = 0;
    for (uint32_t k = 0; k < TAHR_MESSAGE_COUNT; k++)
        sum += tahr__tally_of(tally, k);
    return sum;
}

static tahr_status say_how_it_ended(tahr_telemetry *t, int finished)
{
    char text[160];
    if (!finished) {
        snprintf(
            text, sizeof text,
            "tahr_telemetry_stop: the sink '%.60s' does not return: its thread is left alone, and ends when it does",
            t->sink.name);
        say(t, TAHR_LOG_ERROR, text);
        return TAHR_E_TIMEOUT;
    }
    const uint64_t abandoned = sum_of(&t->drain.dropped);
    if (abandoned == 0) return TAHR_OK;
    snprintf(text, sizeof text, "tahr_telemetry_stop: %llu messages were abandoned", (unsigned long long)abandoned);
    say(t, TAHR_LOG_WARNING, text);
    return TAHR_TRUNCATED;
}

tahr_status tahr_telemetry_stop(tahr_telemetry *t, uint32_t how, double timeout)
{
    if (!t) return TAHR_E_NULL;
    if ((how != TAHR_STOP_DRAIN && how != TAHR_STOP_ABANDON) || !(timeout >= 0 && timeout <= 1e6))
        return TAHR_E_ARGUMENT;
    if (t->joined) return TAHR_OK;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const struct timespec half = later(now, 0.5 * timeout), end = later(now, timeout);
    pthread_mutex_lock(&t->lock);
    end_by(t, how);
    if (how == TAHR_STOP_DRAIN && !wait_until(t, &half)) end_by(t, TAHR_STOP_ABANDON);
    const int finished = wait_until(t, &end);
    pthread_mutex_unlock(&t->lock);
    if (finished) {
        pthread_join(t->thread, NULL);
        t->joined = 1;
    }
    return say_how_it_ended(t, finished);
}

void tahr_telemetry_destroy(tahr_telemetry *t)
{
    if (!t) return;
    if (atomic_load_explicit(&t->ending, memory_order_relaxed) == 0)
        tahr_telemetry_stop(t, TAHR_STOP_DRAIN, DEFAULT_STOP);
    if (!t->joined) {
        const pthread_t thread = t->thread;
        pthread_mutex_lock(&t->lock);
        const int finished = t->finished != 0;
        t->orphaned = !finished;
        if (!finished) pthread_detach(thread); /* from the unlock on it may free all this */
        pthread_mutex_unlock(&t->lock);
        if (!finished) return;
        pthread_join(thread, NULL);
    }
    tahr__telemetry_free(t);
}

tahr_status tahr_telemetry_latest(const tahr_telemetry *t, uint32_t character, tahr_state *state, tahr_stamp *stamp)
{
    tahr_state seen;
    tahr_stamp seen_stamp;
    if (!t || !state) return TAHR_E_NULL;
    if (character >= t->character_count) return TAHR_E_ARGUMENT;
    const tahr_status status = tahr__slot_read(&t->characters[character].slot, &seen, &seen_stamp);
    if (status != TAHR_OK) return status;
    seen_stamp.character = character;
    *state = seen;
    if (stamp) *stamp = seen_stamp;
    return TAHR_OK;
}

tahr_status tahr_telemetry_get_counts(const tahr_telemetry *t, tahr_telemetry_counts *counts)
{
    if (!t || !counts) return TAHR_E_NULL;
    if (counts->struct_size < sizeof *counts) return TAHR_E_STRUCT_SIZE;
    const tahr__drain *d = &t->drain;
    tahr_telemetry_counts c = {.struct_size = counts->struct_size};
    for (uint32_t k = 0; k < TAHR_MESSAGE_COUNT; k++) {
        c.delivered[k] = tahr__tally_of(&d->delivered, k);
        c.failed[k] = tahr__tally_of(&d->failed, k);
        c.dropped[k] = tahr__tally_of(&d->dropped, k);
        c.offered[k] = tahr__tally_of(&d->offered, k);
        for (uint32_t i = 0; i < t->lane_count; i++) {
            c.offered[k] += tahr__tally_of(&t->lanes[i].offered, k);
            c.thinned[k] += tahr__tally_of(&t->lanes[i].thinned, k);
            c.dropped[k] += tahr__tally_of(&t->lanes[i].dropped, k);
        }
    }
    c.last_failure = atomic_load_explicit(&d->last_failure, memory_order_relaxed);
    c.most_filled = (uint32_t)(8 * atomic_load_explicit(&d->most_filled, memory_order_relaxed));
    *counts = c;
    return TAHR_OK;
}

const char *tahr_message_name(uint32_t message)
{
    static const char *const names[TAHR_MESSAGE_COUNT] = {"state",    "event", "input", "report",
                                                          "snapshot", "body",  "world"};
    return message < TAHR_MESSAGE_COUNT ? names[message] : "?";
}

/* SPDX-License-Identifier: MIT
 * bench_telemetry.c: one crowd of wanderers, some ticks with telemetry and then as many without, so that both see the
 * same machine and the same memory. */
#include "bench_telemetry.h"

#include <stdio.h>

#ifdef TAHR_HAVE_THREADS
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <tahr/telemetry.h>

#include "bench_clock.h"
#include "bench_crowd.h"

enum { STEPS = 64000, BLOCK = 32, SETTLE = 2, EVENTS = 16, BATCH = 64, BATCHES = 2001 };

static const double DT = 1.0 / 60;

static atomic_int stalls; /* 1: no function of the sink returns */

static void nap(void)
{
    const struct timespec pause = {0, 200000};
    nanosleep(&pause, NULL);
}

static tahr_status take(void *user)
{
    while (atomic_load(&stalls))
        nap();
    ++*(uint64_t *)user;
    return TAHR_OK;
}

static tahr_status take_state(void *user, const tahr_stamp *stamp, const tahr_state *state)
{
    (void)stamp, (void)state;
    return take(user);
}

static tahr_status take_event(void *user, const tahr_stamp *stamp, const tahr_event *event)
{
    (void)stamp, (void)event;
    return take(user);
}

static tahr_status take_input(void *user, const tahr_stamp *stamp, const tahr_sink_input *input)
{
    (void)stamp, (void)input;
    return take(user);
}

static tahr_status take_report(void *user, const tahr_stamp *stamp, const tahr_sink_report *report)
{
    (void)stamp, (void)report;
    return take(user);
}

static tahr_status take_change(void *user, const tahr_sink_change *change)
{
    (void)change;
    return take(user);
}

static tahr_status take_world(void *user, const tahr_sink_world *world)
{
    (void)world;
    return take(user);
}

/* Everything is wanted. */
static tahr_status open_telemetry(const bench_crowd *c, uint64_t *taken, tahr_telemetry **telemetry)
{
    const tahr_sink sink = {.struct_size = sizeof sink,
                            .abi_major = TAHR_ABI_MAJOR,
                            .abi_minor = TAHR_ABI_MINOR,
                            .name = "count",
                            .user = taken,
                            .state = take_state,
                            .event = take_event,
                            .input = take_input,
                            .report = take_report,
                            .snapshot = take_state,
                            .change = take_change,
                            .world = take_world};
    tahr_telemetry_desc desc;
    tahr_telemetry_desc_init(&desc, sizeof desc);
    desc.sink = &sink;
    desc.characters = c->count;
    desc.configs = &c->config;
    desc.config_count = 1;
    return tahr_telemetry_create(&desc, telemetry);
}

typedef struct trial {
    bench_crowd crowd;
    tahr_telemetry *telemetry;
    uint32_t *times[2]; /* of steps without and with it */
    uint64_t taken[2];
} trial;

static uint64_t timed_step(trial *l, uint32_t i, const tahr_input *input, int on)
{
    tahr_event events[EVENTS];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = EVENTS};
    tahr_state *state = &l->crowd.states[i];
    const uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
    if (on) tahr_telemetry_begin(l->telemetry, 0, i, 0, state);
    const tahr_status status = tahr_mover_step(l->crowd.movers[i], input, DT, state, &report);
    if (on) {
        const tahr_telemetry_step step = {
            .character = i, .status = status, .input = input, .state = state, .report = &report, .dt = DT};
        tahr_telemetry_push(l->telemetry, 0, &step);
    }
    return bench_nanoseconds(CLOCK_MONOTONIC) - before;
}

static int tick(trial *l, const bench_opened *opened, const bench_world *world, int on, int counts)
{
    bench_crowd *c = &l->crowd;
    for (uint32_t i = 0; i < c->count; i++) {
        const uint64_t ns = timed_step(l, i, bench_world_wish(world, &c->wanderers[i], DT), on);
        if (counts) l->times[on][l->taken[on]++] = ns < UINT32_MAX ? (uint32_t)ns : UINT32_MAX;
        if (bench_crowd_is_lost(c, world, i) &&
            !scene_wander_spawn(opened->world, &c->config, &world->spawn, &c->seed, &c->states[i]))
            return 0;
    }
    return 1;
}

/* A frame has time to spare after its steps: the thread that drains is not left behind for ever, but it does work while
 * others step. Returns how many naps that took. */
static int let_drain(const tahr_telemetry *t)
{
    for (int naps = 0;; naps++) {
        if (atomic_load(&stalls)) return 0;
        tahr_telemetry_counts c = {.struct_size = sizeof c};
        uint64_t waiting = 0;
        tahr_telemetry_get_counts(t, &c);
        for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
            waiting += c.offered[k] - c.dropped[k] - c.delivered[k];
        if (waiting < 4000) return naps;
        nap();
    }
}

/* The median between two ticks of the clock, which may be 10 ns apart: the mean of the tenth in the middle. */
static double middle(const uint32_t *sorted, uint64_t count)
{
    const uint64_t first = count * 9 / 20, end = count * 11 / 20;
    double sum = 0;
    for (uint64_t i = first; i < end; i++)
        sum += sorted[i];
    return sum / (double)(end - first);
}

static void quantiles(uint32_t *times, uint64_t count, double *median, double *p99, double *p999)
{
    const double cost = bench_clock_cost();
    bench_sort(times, count);
    *median = middle(times, count) - cost;
    *p99 = times[count - 1 - count / 100] - cost;
    *p999 = times[count - 1 - count / 1000] - cost;
}

/* What a character does in a batch of steps in a row. */
typedef struct replay {
    tahr_state states[BATCH + 1];
    tahr_input inputs[BATCH];
    tahr_report reports[BATCH];
    tahr_event events[BATCH][EVENTS];
} replay;

static void record(trial *l, replay *r, const bench_world *world)
{
    const uint32_t i = 0;
    r->states[0] = l->crowd.states[i];
    for (int k = 0; k < BATCH; k++) {
        r->inputs[k] = *bench_world_wish(world, &l->crowd.wanderers[i], DT);
        r->reports[k] =
            (tahr_report){.struct_size = sizeof(tahr_report), .events = r->events[k], .event_capacity = EVENTS};
        tahr_mover_step(l->crowd.movers[i], &r->inputs[k], DT, &l->crowd.states[i], &r->reports[k]);
        r->states[k + 1] = l->crowd.states[i];
    }
}

/* The two calls alone, on what the first character of the crowd does, as if each of the characters did it. */
static double time_alone(trial *l, const bench_world *world)
{
    replay *r = malloc(sizeof *r);
    uint32_t *times = malloc(BATCHES * sizeof *times);
    double ns = -1;
    for (uint32_t b = 0; r && times && b < BATCHES; b++) {
        const uint32_t i = b % l->crowd.count;
        record(l, r, world);
        let_drain(l->telemetry);
        tahr_telemetry_begin(l->telemetry, 0, i, 0, &r->states[0]); /* a snapshot: it was elsewhere */
        const uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
        for (int k = 0; k < BATCH; k++) {
            tahr_telemetry_begin(l->telemetry, 0, i, 0, &r->states[k]);
            const tahr_telemetry_step step = {
                .character = i, .input = &r->inputs[k], .state = &r->states[k + 1], .report = &r->reports[k], .dt = DT};
            tahr_telemetry_push(l->telemetry, 0, &step);
        }
        times[b] = (uint32_t)(bench_nanoseconds(CLOCK_MONOTONIC) - before);
    }
    if (r && times) {
        bench_sort(times, BATCHES);
        ns = (times[BATCHES / 2] - bench_clock_cost()) / BATCH;
    }
    free(r);
    free(times);
    return ns;
}

/* The first ticks of a block do not count: they send snapshots of what happened meanwhile. Blocks without telemetry take
 * the naps of those with it: who slept finds less of his own in the caches. */
static int take_turns(trial *l, const bench_opened *opened, const bench_world *world)
{
    int naps[BLOCK] = {0};
    for (int t = 0; l->taken[0] + l->crowd.count <= STEPS || l->taken[1] + l->crowd.count <= STEPS; t++) {
        const int on = (t / BLOCK + 1) / 2 % 2; /* off on on off: what drifts, drifts for both */
        const int has_room = l->taken[on] + l->crowd.count <= STEPS;
        if (!tick(l, opened, world, on, t >= 2 * BLOCK && t % BLOCK >= SETTLE && has_room)) return 0;
        if (on) naps[t % BLOCK] = let_drain(l->telemetry);
        for (int i = 0; !on && i < naps[t % BLOCK]; i++)
            nap();
    }
    return 1;
}

int bench_telemetry_run(bench_opened *opened, const bench_world *world, uint32_t characters, int stalled,
                        bench_telemetry_result *result, char *error)
{
    static uint64_t taken; /* by the sink, until the telemetry has ended */
    atomic_store(&stalls, stalled);
    uint32_t *times = malloc(2 * STEPS * sizeof *times);
    trial l = {.crowd = {.count = characters, .seed = 17}, .times = {times, times + STEPS}};
    memset(result, 0, sizeof *result);
    result->characters = characters;
    int ok = times && characters <= STEPS && bench_crowd_make(&l.crowd, opened, world, error) &&
             open_telemetry(&l.crowd, &taken, &l.telemetry) == TAHR_OK && take_turns(&l, opened, world);
    if (ok) {
        tahr_telemetry_counts counts = {.struct_size = sizeof counts};
        result->steps = l.taken[1];
        quantiles(l.times[0], l.taken[0], &result->off_median, &result->off_p99, &result->off_p999);
        quantiles(l.times[1], l.taken[1], &result->on_median, &result->on_p99, &result->on_p999);
        result->alone = time_alone(&l, world);
        tahr_telemetry_get_counts(l.telemetry, &counts);
        for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
            result->dropped += counts.dropped[k];
    } else if (!error[0]) {
        snprintf(error, 256, "out of memory, too many characters, or one was lost");
    }
    atomic_store(&stalls, 0);
    tahr_telemetry_destroy(l.telemetry);
    bench_crowd_free(&l.crowd);
    free(times);
    return ok;
}
#else
int bench_telemetry_run(bench_opened *opened, const bench_world *world, uint32_t characters, int stalled,
                        bench_telemetry_result *result, char *error)
{
    (void)opened, (void)world, (void)characters, (void)stalled, (void)result;
    snprintf(error, 256, "built without libtahr_threads");
    return 0;
}
#endif

/* SPDX-License-Identifier: MIT
 * bench_telemetry.c: two crowds of the same wanderers take their ticks by turns, one with telemetry and one without,
 * so that both see the same machine. */
#include "bench_telemetry.h"

#include <stdio.h>

#ifdef TAHR_HAVE_THREADS
#include <stdlib.h>
#include <string.h>

#include <tahr/telemetry.h>

#include "bench_clock.h"
#include "bench_crowd.h"

enum { STEPS = 60000, WARM_UP = 4000, EVENTS = 16, BATCH = 64, BATCHES = 2001 };

static const double DT = 1.0 / 60;

static tahr_status take_state(void *user, const tahr_stamp *stamp, const tahr_state *state)
{
    (void)stamp, (void)state;
    ++*(uint64_t *)user;
    return TAHR_OK;
}

static tahr_status take_event(void *user, const tahr_stamp *stamp, const tahr_event *event)
{
    (void)stamp, (void)event;
    ++*(uint64_t *)user;
    return TAHR_OK;
}

static tahr_status take_input(void *user, const tahr_stamp *stamp, const tahr_sink_input *input)
{
    (void)stamp, (void)input;
    ++*(uint64_t *)user;
    return TAHR_OK;
}

static tahr_status take_report(void *user, const tahr_stamp *stamp, const tahr_sink_report *report)
{
    (void)stamp, (void)report;
    ++*(uint64_t *)user;
    return TAHR_OK;
}

static tahr_status take_change(void *user, const tahr_sink_change *change)
{
    (void)change;
    ++*(uint64_t *)user;
    return TAHR_OK;
}

static tahr_status take_world(void *user, const tahr_sink_world *world)
{
    (void)world;
    ++*(uint64_t *)user;
    return TAHR_OK;
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

/* One of the two crowds. */
typedef struct side {
    bench_crowd crowd;
    tahr_telemetry *telemetry; /* or NULL */
    uint32_t *times;
    uint64_t taken; /* of times */
} side;

static uint64_t timed_step(side *s, uint32_t i, const tahr_input *input)
{
    tahr_event events[EVENTS];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = EVENTS};
    tahr_state *state = &s->crowd.states[i];
    const uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
    if (s->telemetry) tahr_telemetry_begin(s->telemetry, 0, i, 0, state);
    const tahr_status status = tahr_mover_step(s->crowd.movers[i], input, DT, state, &report);
    if (s->telemetry) {
        const tahr_telemetry_step step = {
            .character = i, .status = status, .input = input, .state = state, .report = &report, .dt = DT};
        tahr_telemetry_push(s->telemetry, 0, &step);
    }
    return bench_nanoseconds(CLOCK_MONOTONIC) - before;
}

static int tick(side *s, const bench_opened *opened, const bench_world *world)
{
    bench_crowd *c = &s->crowd;
    for (uint32_t i = 0; i < c->count; i++) {
        const uint64_t ns = timed_step(s, i, bench_world_wish(world, &c->wanderers[i], DT));
        s->times[s->taken++] = ns < UINT32_MAX ? (uint32_t)ns : UINT32_MAX;
        if (bench_crowd_is_lost(c, world, i) &&
            !scene_wander_spawn(opened->world, &c->config, &world->spawn, &c->seed, &c->states[i]))
            return 0;
    }
    return 1;
}

/* A frame has time to spare after its steps: the thread that drains is not left behind for ever, but it does work while
 * others step. */
static void let_drain(const tahr_telemetry *t)
{
    const struct timespec pause = {0, 200000};
    for (;;) {
        tahr_telemetry_counts c = {.struct_size = sizeof c};
        uint64_t waiting = 0;
        tahr_telemetry_get_counts(t, &c);
        for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
            waiting += c.offered[k] - c.dropped[k] - c.delivered[k];
        if (waiting < 4000) return;
        nanosleep(&pause, NULL);
    }
}

static void quantiles(uint32_t *times, uint64_t count, double *median, double *p99, double *p999)
{
    const double cost = bench_clock_cost();
    bench_sort(times, count);
    *median = times[count / 2] - cost;
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

static void record(side *s, replay *r, const bench_world *world)
{
    const uint32_t i = 0;
    r->states[0] = s->crowd.states[i];
    for (int k = 0; k < BATCH; k++) {
        r->inputs[k] = *bench_world_wish(world, &s->crowd.wanderers[i], DT);
        r->reports[k] =
            (tahr_report){.struct_size = sizeof(tahr_report), .events = r->events[k], .event_capacity = EVENTS};
        tahr_mover_step(s->crowd.movers[i], &r->inputs[k], DT, &s->crowd.states[i], &r->reports[k]);
        r->states[k + 1] = s->crowd.states[i];
    }
}

/* The two calls alone, on what the first character of the crowd does, as if each of the characters did it. */
static double time_alone(side *s, const bench_world *world)
{
    replay *r = malloc(sizeof *r);
    uint32_t *times = malloc(BATCHES * sizeof *times);
    double ns = -1;
    for (uint32_t b = 0; r && times && b < BATCHES; b++) {
        const uint32_t i = b % s->crowd.count;
        record(s, r, world);
        let_drain(s->telemetry);
        tahr_telemetry_begin(s->telemetry, 0, i, 0, &r->states[0]); /* a snapshot: it was elsewhere */
        const uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
        for (int k = 0; k < BATCH; k++) {
            tahr_telemetry_begin(s->telemetry, 0, i, 0, &r->states[k]);
            const tahr_telemetry_step step = {
                .character = i, .input = &r->inputs[k], .state = &r->states[k + 1], .report = &r->reports[k], .dt = DT};
            tahr_telemetry_push(s->telemetry, 0, &step);
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

static int take_turns(side *off, side *on, bench_opened *opened, const bench_world *world)
{
    const uint64_t steps = STEPS + WARM_UP;
    for (int t = 0; on->taken + on->crowd.count <= steps; t++) {
        if (!tick(t % 2 ? on : off, opened, world) || !tick(t % 2 ? off : on, opened, world)) return 0;
        let_drain(on->telemetry);
    }
    return 1;
}

int bench_telemetry_run(bench_opened *opened, const bench_world *world, uint32_t characters,
                        bench_telemetry_result *result, char *error)
{
    static uint64_t taken; /* by the sink, until the telemetry has ended */
    const size_t most = STEPS + WARM_UP;
    side off = {.crowd = {.count = characters, .seed = 17}, .times = malloc(most * sizeof(uint32_t))};
    side on = {.crowd = {.count = characters, .seed = 17}, .times = malloc(most * sizeof(uint32_t))};
    memset(result, 0, sizeof *result);
    result->characters = characters;
    int ok = off.times && on.times && bench_crowd_make(&off.crowd, opened, world, error) &&
             bench_crowd_make(&on.crowd, opened, world, error) &&
             open_telemetry(&on.crowd, &taken, &on.telemetry) == TAHR_OK && take_turns(&off, &on, opened, world);
    if (ok) {
        tahr_telemetry_counts counts = {.struct_size = sizeof counts};
        const uint64_t steps = result->steps = on.taken - WARM_UP;
        quantiles(off.times + WARM_UP, steps, &result->off_median, &result->off_p99, &result->off_p999);
        quantiles(on.times + WARM_UP, steps, &result->on_median, &result->on_p99, &result->on_p999);
        result->alone = time_alone(&on, world);
        tahr_telemetry_get_counts(on.telemetry, &counts);
        for (int k = 0; k < TAHR_MESSAGE_COUNT; k++)
            result->dropped += counts.dropped[k];
    } else if (!error[0]) {
        snprintf(error, 256, "out of memory, or a character was lost");
    }
    tahr_telemetry_destroy(on.telemetry);
    bench_crowd_free(&on.crowd);
    bench_crowd_free(&off.crowd);
    free(on.times);
    free(off.times);
    return ok;
}
#else
int bench_telemetry_run(bench_opened *opened, const bench_world *world, uint32_t characters,
                        bench_telemetry_result *result, char *error)
{
    (void)opened, (void)world, (void)characters, (void)result;
    snprintf(error, 256, "built without libtahr_threads");
    return 0;
}
#endif

/* SPDX-License-Identifier: MIT
 * bench_run.c: steps characters and times each step.
 *
 * Median and 99th percentile come from single steps by the monotonic clock: on a machine shared with others the few
 * steps that are interrupted do not move them. The mean comes from the processor time of the thread: interruptions do
 * not count in it. */
#include "bench_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_clock.h"
#include "bench_crowd.h"

enum { WARM_UP_TICKS = 30 };

static const double DT = 1.0 / 60;

static void *count_alloc(void *user, size_t size, size_t alignment)
{
    bench_opened *opened = user;
    void *memory = aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    opened->held += memory ? size : 0;
    return memory;
}

static void count_free(void *user, void *memory, size_t size, size_t alignment)
{
    bench_opened *opened = user;
    (void)alignment;
    opened->held -= memory ? size : 0;
    free(memory);
}

static void complain(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level == TAHR_LOG_ERROR) {
        fprintf(stderr, "%s\n", message);
    }
}

tahr_status bench_open(bench_opened *opened, const bench_world *world, const scene_backend *backend)
{
    scene_options options;
    tahr_allocator allocator = {opened, count_alloc, count_free};
    tahr_log log = {NULL, complain};
    tahr_world_desc desc;
    memset(opened, 0, sizeof *opened);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bench_world_bodies(world, backend);
    desc.body_count = world->body_count;
    desc.allocator = &allocator;
    desc.log = &log;
    desc.options = scene_backend_options(backend, &options);
    uint64_t before = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    tahr_status status = tahr_world_open(backend->get(), &desc, &opened->world);
    opened->build_seconds = 1e-9 * (double)(bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID) - before);
    opened->bytes = tahr_world_memory(opened->world);
    return status;
}

void bench_close(bench_opened *opened)
{
    tahr_world_close(opened->world);
    opened->world = NULL;
}

static void count(bench_result *r, const tahr_report *report, const tahr_state *state)
{
    r->sweeps += report->sweeps;
    r->contact_queries += report->contact_queries;
    r->rays += report->rays;
    r->triangle_tests += (double)report->triangle_tests;
    r->iterations += (double)report->narrow_iterations;
    r->gathers += (double)report->gathers;
    r->escapes += (double)report->escapes;
    r->walking += state->mode == TAHR_MODE_WALKING;
    r->steps++;
}

/* One step of everybody. times may be NULL: not counted then. */
static int tick(bench_crowd *c, const bench_opened *opened, const bench_world *world, bench_result *r, uint32_t *times)
{
    for (uint32_t i = 0; i < c->count; i++) {
        tahr_report report = {.struct_size = sizeof report};
        const tahr_input *input = bench_world_wish(world, &c->wanderers[i], DT);
        uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
        tahr_status status = tahr_mover_step(c->movers[i], input, DT, &c->states[i], &report);
        uint64_t after = bench_nanoseconds(CLOCK_MONOTONIC);
        if (status < 0) {
            return 0;
        }
        if (times) {
            times[i] = after - before < UINT32_MAX ? (uint32_t)(after - before) : UINT32_MAX;
            count(r, &report, &c->states[i]);
        }
        if (bench_crowd_is_lost(c, world, i)) {
            r->lost++;
            if (!scene_wander_spawn(opened->world, &c->config, &world->spawn, &c->seed, &c->states[i])) {
                return 0;
            }
        }
    }
    return 1;
}

static void summarize(bench_result *r, uint32_t *times, double cpu)
{
    double *sums[8] = {&r->sweeps,     &r->contact_queries, &r->rays,    &r->triangle_tests,
                       &r->iterations, &r->gathers,         &r->escapes, &r->walking};
    double cost = bench_clock_cost(), n = (double)r->steps;
    bench_sort(times, r->steps);
    r->ns_median = (double)times[r->steps / 2] - cost;
    r->ns_p99 = (double)times[r->steps - 1 - r->steps / 100] - cost;
    r->ns_cpu = cpu / n - 2 * cost;
    for (int i = 0; i < 8; i++) {
        *sums[i] /= n;
    }
}

int bench_run(bench_opened *opened, const bench_world *world, uint32_t characters, uint32_t ticks, bench_result *result,
              char *error)
{
    uint64_t held = opened->held;
    bench_crowd c = {.count = characters, .seed = 17};
    uint32_t *times = malloc(sizeof *times * characters * ticks);
    memset(result, 0, sizeof *result);
    result->characters = characters;
    int ok = times != NULL && bench_crowd_make(&c, opened, world, error);
    result->bytes_per_mover = (opened->held - held) / characters;
    for (uint32_t t = 0; ok && t < WARM_UP_TICKS; t++) {
        ok = tick(&c, opened, world, result, NULL);
    }
    uint64_t before = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    for (uint32_t t = 0; ok && t < ticks; t++) {
        ok = tick(&c, opened, world, result, times + (size_t)t * characters);
    }
    uint64_t cpu = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID) - before;
    if (ok) {
        summarize(result, times, (double)cpu);
    } else if (!error[0]) {
        snprintf(error, 256, times ? "a step failed" : "out of memory");
    }
    bench_crowd_free(&c);
    free(times);
    return ok;
}

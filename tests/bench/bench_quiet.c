/* SPDX-License-Identifier: MIT
 * bench_quiet.c: characters that stand, alone or in a crowd, and characters in free fall, over a plane. */
#include "bench_quiet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <tahr/crowd.h>
#include <tahr/native.h>

#include "bench_clock.h"

enum { ASLEEP, CROWD, FALL };

static const char *const NAMES[BENCH_QUIET] = {"asleep", "asleep_crowd", "free_fall"};

/* BATCH: steps at least, so that reading the clock (20 to 50 ns) is nothing beside them. SETTLE: ticks until everybody
 * has found his floor and slept. */
enum { BATCHES = 200, BATCH = 4096, SETTLE = 30 };

static const double DT = 1.0 / 60;
static const double APART = 3;     /* m: nobody is near anybody */
static const double HEIGHT = 5000; /* m above the plane: out of sight */
static const uint32_t CACHE = 32;  /* triangles: 10 000 caches of the usual size would be 390 MB */

const char *bench_quiet_name(int index)
{
    return index >= 0 && index < BENCH_QUIET ? NAMES[index] : NULL;
}

typedef struct quiet {
    int kind;
    uint32_t count;
    tahr_world *world;
    tahr_mover **movers;
    tahr_crowd *crowd;
    tahr_input *inputs;
    tahr_state *states, *start;
} quiet;

static void close_quiet(quiet *q)
{
    for (uint32_t i = 0; q->movers && i < q->count; i++) {
        tahr_mover_destroy(q->movers[i]);
    }
    tahr_crowd_destroy(q->crowd);
    free(q->movers);
    free(q->inputs);
    free(q->states);
    free(q->start);
    tahr_world_close(q->world);
}

static tahr_status open_world(quiet *q)
{
    tahr_body_desc ground;
    tahr_world_desc desc;
    tahr_native_desc native = {.struct_size = sizeof native, .cache_triangles = CACHE};
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){1000, 1000, 1};
    ground.pose.position.z = -1;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &ground;
    desc.body_count = 1;
    desc.options = &native;
    return tahr_world_open(tahr_backend_v1_native(), &desc, &q->world);
}

static tahr_status make_steppers(quiet *q, const tahr_config *config)
{
    tahr_status status = TAHR_OK;
    if (q->kind == CROWD) {
        tahr_crowd_desc desc;
        tahr_crowd_desc_init(&desc, sizeof desc);
        desc.capacity = q->count;
        desc.configs = config;
        desc.config_count = 1;
        return tahr_crowd_create(q->world, &desc, &q->crowd);
    }
    for (uint32_t i = 0; i < q->count && status >= 0; i++) {
        status = tahr_mover_create(q->world, config, &q->movers[i]);
    }
    return status;
}

static tahr_status open_quiet(quiet *q)
{
    tahr_config config;
    const uint32_t side = (uint32_t)ceil(sqrt(q->count));
    q->movers = calloc(q->count, sizeof(tahr_mover *));
    q->inputs = calloc(q->count, sizeof *q->inputs);
    q->start = calloc(q->count, sizeof *q->start);
    q->states = aligned_alloc(64, q->count * sizeof *q->states);
    if (!q->movers || !q->inputs || !q->start || !q->states) {
        return TAHR_E_MEMORY;
    }
    tahr_status status = open_world(q);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    status = status < 0 ? status : make_steppers(q, &config);
    for (uint32_t i = 0; i < q->count && status >= 0; i++) {
        const double half = 0.5 * side, z = config.shape.half_height + (q->kind == FALL ? HEIGHT : 0.02);
        const tahr_vec3 at = {APART * (i % side - half), APART * (i / side - half), z};
        status = tahr_state_init(&q->start[i], &config, &at);
        q->inputs[i].struct_size = sizeof q->inputs[i];
    }
    return status;
}

/* Everybody once. reports may be NULL. Returns the lowest status. */
static tahr_status tick(const quiet *q, tahr_report *reports)
{
    tahr_status least = TAHR_OK;
    if (q->kind == CROWD) {
        tahr_crowd_tick t;
        tahr_crowd_tick_init(&t, sizeof t);
        t.count = q->count;
        t.dt = DT;
        t.inputs = q->inputs;
        t.states = q->states;
        t.reports = reports;
        return tahr_crowd_step(q->crowd, &t);
    }
    for (uint32_t i = 0; i < q->count; i++) {
        tahr_status status =
            tahr_mover_step(q->movers[i], &q->inputs[i], DT, &q->states[i], reports ? &reports[i] : NULL);
        least = status < least ? status : least;
    }
    return least;
}

static tahr_status begin(const quiet *q)
{
    tahr_status status = TAHR_OK;
    memcpy(q->states, q->start, q->count * sizeof *q->states);
    for (int i = 0; i < SETTLE && status >= 0; i++) {
        status = tick(q, NULL);
    }
    return status;
}

/* Are they what they are measured as? Counts a tick. */
static int count_tick(const quiet *q, bench_result *r)
{
    tahr_report *reports = calloc(q->count, sizeof *reports);
    uint32_t right = 0;
    for (uint32_t i = 0; reports && i < q->count; i++) {
        reports[i].struct_size = sizeof reports[i];
    }
    if (reports && tick(q, reports) >= 0) {
        for (uint32_t i = 0; i < q->count; i++) {
            const tahr_report *one = &reports[i];
            right += q->kind == FALL ? q->states[i].mode == TAHR_MODE_FALLING : (one->flags & TAHR_REPORT_ASLEEP) != 0;
            r->sweeps += one->sweeps / (double)q->count;
            r->contact_queries += one->contact_queries / (double)q->count;
            r->gathers += (double)one->gathers / q->count;
            r->walking += (q->states[i].mode == TAHR_MODE_WALKING) / (double)q->count;
        }
    }
    free(reports);
    return right == q->count;
}

static int time_batches(const quiet *q, bench_result *r)
{
    static uint32_t times[BATCHES]; /* ps a step */
    const uint32_t ticks = (BATCH + q->count - 1) / q->count, batches = q->count > BATCH ? BATCHES / 4 : BATCHES;
    const double steps = (double)ticks * q->count;
    double cpu = 0;
    for (uint32_t k = 0; k < batches; k++) {
        if (q->kind == FALL && begin(q) < 0) {
            return 0;
        }
        const uint64_t cpu_before = bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID);
        const uint64_t before = bench_nanoseconds(CLOCK_MONOTONIC);
        for (uint32_t i = 0; i < ticks; i++) {
            if (tick(q, NULL) < 0) {
                return 0;
            }
        }
        const uint64_t after = bench_nanoseconds(CLOCK_MONOTONIC);
        cpu += (double)(bench_nanoseconds(CLOCK_THREAD_CPUTIME_ID) - cpu_before);
        times[k] = (uint32_t)fmin(1e3 * (double)(after - before) / steps, 4e9);
    }
    bench_sort(times, batches);
    r->ns_median = 1e-3 * times[batches / 2];
    r->ns_p99 = 1e-3 * times[batches - 1 - batches / 100];
    r->ns_cpu = cpu / steps / batches;
    r->steps = (uint64_t)(steps * batches);
    return 1;
}

int bench_quiet_run(int index, uint32_t characters, bench_result *result, char *error)
{
    quiet q = {.kind = index, .count = characters};
    memset(result, 0, sizeof *result);
    result->characters = characters;
    tahr_status status = open_quiet(&q);
    status = status < 0 ? status : begin(&q);
    int ok = status >= 0 && count_tick(&q, result) && time_batches(&q, result);
    if (!ok) {
        snprintf(error, 256, "%s", status < 0 ? tahr_status_name(status) : "not everybody sleeps, or falls");
    }
    close_quiet(&q);
    return ok;
}

/* SPDX-License-Identifier: MIT
 * crowds.c: a tick of 1 to 100 000 characters: plain movers, which do not meet each other, and crowds on some threads.
 * Timed by the wall clock: that is what threads are for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <tahr/crowd.h>
#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.h>
#endif

#include "run.h"
#include "scene_level.h"
#include "setting.h"

enum { WARM_UP_TICKS = 10, MIN_TICKS = 5, MAX_TICKS = 2000 };

static const uint32_t COUNTS[] = {1, 10, 100, 1000, 10000, 100000};
enum { COUNT_SIZES = sizeof COUNTS / sizeof COUNTS[0] };

static const double DT = 1.0 / 60;
static const double APART = 2.0;      /* m between neighbours at the start: four shoulders */
static const double TICK_STEPS = 2e5; /* steps of all ticks of one measurement */
static const uint32_t CACHE = 32;     /* triangles: a default cache of 36 KB for each of 100 000 would be 3.6 GB */
static const double GROUND = 2.0;     /* m, cells of the hills: 20 triangles fall into a cached box */

/* Everybody, and what steps them: movers or a crowd. */
typedef struct throng {
    uint32_t count;
    tahr_world *world;
    tahr_mover **movers;
    tahr_crowd *crowd;
    void *threads; /* of libtahr_threads, or NULL */
    tahr_state *states;
    tahr_input *inputs;
    scene_wanderer *wanderers;
} throng;

static void throng_free(throng *t)
{
    for (uint32_t i = 0; t->movers && i < t->count; i++) {
        tahr_mover_destroy(t->movers[i]);
    }
    tahr_crowd_destroy(t->crowd);
#ifdef TAHR_HAVE_THREADS
    tahr_threads_destroy(t->threads);
#endif
    free(t->movers);
    free(t->states);
    free(t->inputs);
    free(t->wanderers);
    tahr_world_close(t->world);
}

/* In a square, on the ground: a ray finds it. */
static int stand_up(throng *t, const tahr_config *config)
{
    uint32_t side = (uint32_t)ceil(sqrt(t->count));
    for (uint32_t i = 0; i < t->count; i++) {
        double x = APART * (i % side - side / 2.0), y = APART * (i / side - side / 2.0);
        tahr_ray ray = {.origin = {x, y, 100}, .motion = {0, 0, -200}, .mask = ~0u, .ignore_body = TAHR_NO_BODY};
        tahr_hit hit;
        uint32_t count = 0;
        if (tahr_world_ray(t->world, &ray, &hit, &count) < 0 || count == 0) return 0;
        tahr_vec3 place = {x, y, hit.point.z + config->shape.half_height + 0.2};
        tahr_state_init(&t->states[i], config, &place);
        scene_wander_start(&t->wanderers[i], 1, i);
    }
    return 1;
}

static tahr_status make_crowd(throng *t, const tahr_config *config, uint32_t threads)
{
    (void)threads; /* without libtahr_threads there is one */
    tahr_crowd_desc desc;
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = t->count;
    desc.configs = config;
    desc.config_count = 1;
#ifdef TAHR_HAVE_THREADS
    tahr_threads *pool = NULL;
    if (threads > 1) {
        tahr_status status = tahr_threads_create(NULL, threads, &pool);
        if (status < 0) return status;
        desc.run_tasks = tahr_threads_run;
        desc.run_user = t->threads = pool;
    }
#endif
    return tahr_crowd_create(t->world, &desc, &t->crowd);
}

/* threads 0: plain movers. */
static tahr_status make_steppers(throng *t, const tahr_config *config, uint32_t threads)
{
    if (threads > 0) return make_crowd(t, config, threads);
    t->movers = calloc(t->count, sizeof *t->movers);
    tahr_status status = t->movers ? TAHR_OK : TAHR_E_MEMORY;
    for (uint32_t i = 0; status >= 0 && i < t->count; i++) {
        status = tahr_mover_create(t->world, config, &t->movers[i]);
    }
    return status;
}

static tahr_status throng_make(throng *t, const bench_world *level, uint32_t threads)
{
    chart_setting setting;
    chart_setting_default(level, &setting);
    tahr_native_desc native = {.struct_size = sizeof native, .cache_triangles = CACHE};
    memcpy(&setting.options, &native, sizeof native);
    t->states = calloc(t->count, sizeof *t->states);
    t->inputs = calloc(t->count, sizeof *t->inputs);
    t->wanderers = calloc(t->count, sizeof *t->wanderers);
    if (!t->states || !t->inputs || !t->wanderers) return TAHR_E_MEMORY;
    tahr_status status = chart_setting_open(&setting, level, &t->world);
    if (status >= 0) status = make_steppers(t, &setting.config, threads);
    if (status >= 0 && !stand_up(t, &setting.config)) status = TAHR_E_NOT_FOUND;
    return status;
}

/* Returns the wall-clock time of the steps alone, or less than 0 where one failed. */
static double tick(throng *t)
{
    tahr_status status = TAHR_OK;
    for (uint32_t i = 0; i < t->count; i++) {
        t->inputs[i] = *scene_wander_next(&t->wanderers[i], DT);
    }
    double before = chart_monotonic();
    if (t->crowd) {
        tahr_crowd_tick one;
        tahr_crowd_tick_init(&one, sizeof one);
        one.count = t->count;
        one.dt = DT;
        one.inputs = t->inputs;
        one.states = t->states;
        status = tahr_crowd_step(t->crowd, &one);
    } else {
        for (uint32_t i = 0; i < t->count && status >= 0; i++) {
            status = tahr_mover_step(t->movers[i], &t->inputs[i], DT, &t->states[i], NULL);
        }
    }
    double seconds = chart_monotonic() - before;
    return status < 0 ? -1 : seconds;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int time_ticks(throng *t, chart_row *row)
{
    static double ns[MAX_TICKS];
    uint32_t ticks = (uint32_t)fmin(MAX_TICKS, fmax(MIN_TICKS, TICK_STEPS / t->count));
    double sum = 0;
    for (uint32_t k = 0; k < WARM_UP_TICKS; k++) {
        if (tick(t) < 0) return 0;
    }
    for (uint32_t k = 0; k < ticks; k++) {
        double seconds = tick(t);
        if (seconds < 0) return 0;
        ns[k] = 1e9 * seconds / t->count;
        sum += ns[k];
    }
    qsort(ns, ticks, sizeof ns[0], by_value);
    row->ns_p50 = ns[ticks / 2];
    row->ns_p99 = ns[ticks - 1 - ticks / 100];
    row->ns_mean = sum / ticks;
    row->rate = 60;
    row->ns_second = row->ns_mean * 60;
    row->samples = (uint64_t)ticks * t->count;
    return 1;
}

static void measure(chart_run *run, const bench_world *level, uint32_t count, uint32_t threads)
{
    char name[48];
    chart_row row;
    throng t = {.count = count};
    tahr_status status = throng_make(&t, level, threads);
    chart_row_clear(&row);
    snprintf(name, sizeof name, threads ? "crowd; %u thread%s" : "movers; no obstacles", threads,
             threads == 1 ? "" : "s");
    row.scene = level->name;
    row.curve = row.setting = name;
    row.value = count;
    row.threads = threads ? threads : 1;
    if (status >= 0 && time_ticks(&t, &row)) {
        chart_run_write(run, &row);
    } else {
        chart_run_fail(run, name, status < 0 ? tahr_status_name(status) : "a step failed");
    }
    throng_free(&t);
}

static void make_ground(bench_world *level, int hills, uint32_t most)
{
    memset(level, 0, sizeof *level);
    level->name = hills ? "hills" : "plane";
    level->body_count = 1;
    if (hills) {
        int cells = (int)(ceil(sqrt(most)) * APART / GROUND) + 60; /* and 60 m to all sides for who walks on */
        scene_mesh_field(&level->mesh, cells, cells, GROUND, scene_hills);
        scene_level_body(&level->mesh, &level->one);
    } else {
        tahr_body_desc_init(&level->one, sizeof level->one, TAHR_BODY_BOX);
        level->one.half_extents = (tahr_vec3){1000, 1000, 1};
        level->one.pose.position.z = -1;
    }
}

void chart_crowds(chart_run *run)
{
    static const uint32_t all[] = {0, 1, 2, 4, 8}; /* threads, of which those that there are processors for */
#ifdef TAHR_HAVE_THREADS
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
#else
    long processors = 1;
#endif
    for (int hills = 0; hills < 2; hills++) {
        bench_world level = {.name = ""};
        if (!run->counting) make_ground(&level, hills, run->budget->max_characters);
        for (int k = 0; k < 5 && (k < 2 || (long)all[k] <= processors); k++) {
            for (int i = 0; i < COUNT_SIZES && COUNTS[i] <= run->budget->max_characters; i++) {
                char name[48];
                snprintf(name, sizeof name, "%u characters; %u threads", COUNTS[i], all[k]);
                if (chart_run_next(run, hills ? "hills" : "plane", name)) measure(run, &level, COUNTS[i], all[k]);
            }
        }
        bench_world_free(&level);
    }
}

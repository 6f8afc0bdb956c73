/* SPDX-License-Identifier: MIT
 * throng.c: characters in a square on the ground, and what steps them. */
#include "throng.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.h>
#endif

#include "run.h"
#include "scene_level.h"
#include "setting.h"

static const double DT = 1.0 / 60;
static const double APART = 2.0;  /* m between neighbours at the start: four shoulders */
static const uint32_t CACHE = 32; /* triangles: a default cache of 36 KB for each of 100 000 would be 3.6 GB */
static const double GROUND = 2.0; /* m, cells of the hills: 20 triangles fall into a cached box */

void chart_throng_free(chart_throng *t)
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
    free(t->members);
    free(t->delays);
    tahr_world_close(t->world);
}

/* In a square, on the ground: a ray finds it. */
static int stand_up(chart_throng *t, const tahr_config *config)
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

static tahr_status make_crowd(chart_throng *t, const tahr_config *config, uint32_t threads)
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
static tahr_status make_steppers(chart_throng *t, const tahr_config *config, uint32_t threads)
{
    if (threads > 0) return make_crowd(t, config, threads);
    t->movers = calloc(t->count, sizeof *t->movers);
    tahr_status status = t->movers ? TAHR_OK : TAHR_E_MEMORY;
    for (uint32_t i = 0; status >= 0 && i < t->count; i++) {
        status = tahr_mover_create(t->world, config, &t->movers[i]);
    }
    return status;
}

/* Everybody alone, with a budget. */
static tahr_status make_members(chart_throng *t, double budget)
{
    t->members = calloc(t->count, sizeof *t->members);
    t->delays = calloc(t->count, sizeof *t->delays);
    if (!t->members || !t->delays) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < t->count; i++) {
        t->members[i] = (tahr_member){.id = i, .flags = TAHR_MEMBER_ALONE, .budget = budget};
    }
    return TAHR_OK;
}

tahr_status chart_throng_make(chart_throng *t, const chart_throng_desc *desc)
{
    const bench_world *level = desc->level;
    *t = (chart_throng){.count = desc->count};
    chart_setting setting;
    chart_setting_default(level, &setting);
    tahr_native_desc native = {.struct_size = sizeof native, .cache_triangles = CACHE};
    memcpy(&setting.options, &native, sizeof native);
    t->states = calloc(t->count, sizeof *t->states);
    t->inputs = calloc(t->count, sizeof *t->inputs);
    t->wanderers = calloc(t->count, sizeof *t->wanderers);
    if (!t->states || !t->inputs || !t->wanderers) return TAHR_E_MEMORY;
    tahr_status status = chart_setting_open(&setting, level, &t->world);
    if (status >= 0) status = make_steppers(t, &setting.config, desc->threads);
    if (status >= 0 && desc->alone) status = make_members(t, desc->budget);
    if (status >= 0 && !stand_up(t, &setting.config)) status = TAHR_E_NOT_FOUND;
    return status;
}

double chart_throng_tick(chart_throng *t)
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
        one.members = t->members;
        one.delays = t->delays;
        status = tahr_crowd_step(t->crowd, &one);
    } else {
        for (uint32_t i = 0; i < t->count && status >= 0; i++) {
            status = tahr_mover_step(t->movers[i], &t->inputs[i], DT, &t->states[i], NULL);
        }
    }
    double seconds = chart_monotonic() - before;
    return status < 0 ? -1 : seconds;
}

void chart_throng_ground(bench_world *level, int hills, uint32_t most)
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

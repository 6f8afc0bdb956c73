/* SPDX-License-Identifier: MIT
 * throng.c: a crowd on the native backend, and an independent look at it. */
#include "throng.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void hear(void *user, int32_t level, const char *message)
{
    throng *t = user;
    (void)level;
    snprintf(t->said, sizeof t->said, "%s", message);
}

void throng_open(throng *t, const tahr_body_desc *bodies, uint32_t count)
{
    const tahr_log log = {t, hear};
    tahr_world_desc desc;
    memset(t, 0, sizeof *t);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.log = &log;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &t->world), TAHR_OK);
    tahr_config_init(&t->config, sizeof t->config, TAHR_PRESET_PRECISE);
    t->config.max_speed = 4;
    tahr_crowd_desc_init(&t->desc, sizeof t->desc);
    t->desc.configs = &t->config;
    t->desc.config_count = 1;
}

void throng_open_ground(throng *t)
{
    tahr_body_desc ground;
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){200, 200, 1};
    ground.pose.position.z = -1;
    throng_open(t, &ground, 1);
}

static void *many(uint32_t count, size_t size)
{
    void *memory = calloc(count, size);
    assert_non_null(memory);
    return memory;
}

void throng_make(throng *t, uint32_t count)
{
    t->count = count;
    t->desc.capacity = t->desc.capacity ? t->desc.capacity : count;
    t->desc.configs = t->desc.configs ? t->desc.configs : &t->config;
    assert_int_equal(tahr_crowd_create(t->world, &t->desc, &t->crowd), TAHR_OK);
    t->members = many(count, sizeof *t->members);
    t->inputs = many(count, sizeof *t->inputs);
    t->states = many(count, sizeof *t->states);
    t->before = many(count, sizeof *t->before);
    t->reports = many(count, sizeof *t->reports);
    t->statuses = many(count, sizeof *t->statuses);
    t->delays = many(count, sizeof *t->delays);
    for (uint32_t i = 0; i < count; i++) {
        t->members[i].id = i;
        t->inputs[i].struct_size = sizeof t->inputs[i];
        t->reports[i].struct_size = sizeof t->reports[i];
    }
    tahr_crowd_tick_init(&t->tick, sizeof t->tick);
    t->tick.count = count;
    t->tick.dt = 1.0 / 60;
    t->tick.members = t->members;
    t->tick.inputs = t->inputs;
    t->tick.states = t->states;
    t->tick.reports = t->reports;
    t->tick.statuses = t->statuses;
    t->tick.delays = t->delays;
}

void throng_close(throng *t)
{
    tahr_crowd_destroy(t->crowd);
    tahr_world_close(t->world);
    free(t->members);
    free(t->inputs);
    free(t->states);
    free(t->before);
    free(t->reports);
    free(t->statuses);
    free(t->delays);
    memset(t, 0, sizeof *t);
}

void throng_place(throng *t, uint32_t i, double x, double y)
{
    const tahr_config *c = &t->desc.configs[t->members[i].config];
    const tahr_vec3 at = {x, y, c->shape.half_height + c->skin * c->floor_target};
    assert_int_equal(tahr_state_init(&t->states[i], c, &at), TAHR_OK);
}

void throng_go(throng *t, uint32_t i, double x, double y)
{
    t->inputs[i].move = (tahr_vec3){x, y, 0};
}

tahr_status throng_step(throng *t)
{
    memcpy(t->before, t->states, t->count * sizeof *t->states);
    tahr_status status = tahr_crowd_step(t->crowd, &t->tick);
    for (uint32_t i = 0; i < t->count && status >= 0; i++) {
        const tahr_vec3 p = t->states[i].position, v = t->states[i].velocity;
        assert_true(isfinite(p.x + p.y + p.z + v.x + v.y + v.z));
        assert_true(t->statuses[i] >= 0);
    }
    return status;
}

double throng_gap(const tahr_state *a, const tahr_state *b)
{
    const long double x = (long double)a->position.x - b->position.x, y = (long double)a->position.y - b->position.y;
    const long double straight = (long double)a->half_height - a->radius + b->half_height - b->radius;
    long double z = fabsl((long double)a->position.z - b->position.z) - straight;
    z = z < 0 ? 0 : z;
    return (double)(sqrtl(x * x + y * y + z * z) - a->radius - b->radius);
}

double throng_least_gap(const throng *t)
{
    double least = INFINITY;
    for (uint32_t i = 0; i < t->count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            if (fabs(t->states[i].position.x - t->states[j].position.x) < 2) {
                least = fmin(least, throng_gap(&t->states[i], &t->states[j]));
            }
        }
    }
    return least;
}

double throng_deeper(const throng *t)
{
    double most = 0;
    for (uint32_t i = 0; i < t->count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            if (fabs(t->states[i].position.x - t->states[j].position.x) < 2) {
                double now = throng_gap(&t->states[i], &t->states[j]), was = throng_gap(&t->before[i], &t->before[j]);
                most = fmax(most, fmin(was, 0) - fmin(now, 0));
            }
        }
    }
    return most;
}

uint64_t throng_hash(const throng *t)
{
    uint64_t hash = 0;
    for (uint32_t i = 0; i < t->count; i++) { /* a sum: in whatever order they are */
        hash += tahr_state_hash(&t->states[i]) * (2 * (uint64_t)t->members[i].id + 1);
    }
    return hash;
}

void throng_backwards(void *user, tahr_task_fn task, void *argument, uint32_t count)
{
    uint32_t *calls = user;
    if (calls) {
        ++*calls;
    }
    for (uint32_t i = count; i-- > 0;) {
        task(argument, i);
    }
}

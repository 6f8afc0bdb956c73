/* SPDX-License-Identifier: MIT
 * test_gather_threads.c: characters of one world whose triangles the user hands over, stepped by several threads
 * at once: each goes its way bit for bit as it does alone. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "scene_level.h"
#include "soup.h"

enum { THREADS = 4, STEPS = 400 };

/* Reads the triangles and writes nothing, as a callback that is called from several threads must. */
static tahr_status gather_all(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out)
{
    const soup *s = user;
    (void)mask;
    for (uint32_t i = 0; i < s->count; i++) {
        const tahr_vec3 *v = s->triangles[i].corners;
        tahr_vec3 low = v_min(v[0], v_min(v[1], v[2])), high = v_max(v[0], v_max(v[1], v[2]));
        int apart = low.x > box->max.x || low.y > box->max.y || low.z > box->max.z || high.x < box->min.x ||
                    high.y < box->min.y || high.z < box->min.z;
        if (!apart && !out->add(out, &s->triangles[i])) break;
    }
    return TAHR_OK;
}

typedef struct walker {
    tahr_mover *mover;
    tahr_state state;
    uint64_t seed, hash;
    tahr_status status; /* of the step that failed; nothing is asserted beside the test's own thread */
} walker;

static void *walk(void *data)
{
    walker *w = data;
    oracle_random r = {w->seed};
    tahr_input input = {.struct_size = sizeof input};
    w->status = TAHR_OK;
    w->hash = 0;
    for (uint32_t i = 0; i < STEPS && w->status >= 0; i++) {
        if (i % 40 == 0) input.move = dice_direction(&r), input.move.z = 0;
        input.jump = i % 90 == 50;
        w->status = tahr_mover_step(w->mover, &input, 1.0 / 60, &w->state, NULL);
        w->hash = w->hash * 31 + tahr_state_hash(&w->state);
    }
    return NULL;
}

static void begin(walker *w, tahr_world *world, uint64_t seed)
{
    tahr_config config;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&w->state, &config, &(tahr_vec3){1 + 0.5 * (double)seed, 2, 1.5});
    w->seed = seed;
    assert_int_equal(tahr_mover_create(world, &config, &w->mover), TAHR_OK);
}

/* no_cache: every query gathers for itself. */
static void walk_together(soup *s, uint32_t no_cache)
{
    walker alone[THREADS], together[THREADS];
    pthread_t threads[THREADS];
    tahr_world *world = NULL;
    tahr_native_desc o = fixture_options();
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &o;
    o.gather = gather_all;
    o.gather_user = s;
    o.no_cache = no_cache;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    for (uint64_t i = 0; i < THREADS; i++) {
        begin(&alone[i], world, i);
        begin(&together[i], world, i);
        walk(&alone[i]);
    }
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, walk, &together[i]), 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(together[i].status, alone[i].status);
        assert_true(alone[i].status >= 0 && together[i].hash == alone[i].hash);
        assert_true(i == 0 || alone[i].hash != alone[0].hash);
        tahr_mover_destroy(alone[i].mover);
        tahr_mover_destroy(together[i].mover);
    }
    tahr_world_close(world);
}

static void threads_share_a_gather_callback(void **unused)
{
    scene_mesh mesh = {0};
    char why[256];
    tahr_body_desc body;
    soup s;
    (void)unused;
    assert_true(scene_level_make("playground", &mesh, why));
    scene_level_body(&mesh, &body);
    soup_make(&s, &body, 0);
    walk_together(&s, 0);
    walk_together(&s, 1);
    soup_free(&s);
    scene_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_share_a_gather_callback)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

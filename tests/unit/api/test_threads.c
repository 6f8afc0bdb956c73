/* SPDX-License-Identifier: MIT
 * test_threads.c: characters of one world may step on several threads at once, on every backend, and come to the bits
 * that they come to one after the other. (Run it under a thread sanitizer to see what it does not.) */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#include <tahr/native.h>
#include <tahr/tahr.h>

#if defined(__unix__) || defined(__APPLE__)
#define HAS_THREADS 1
#include <pthread.h>
#else
#define HAS_THREADS 0
#endif

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#if HAS_THREADS
enum { THREADS = 4, STEPS = 200, BODIES = 14 };

/* One character, and the hash of all its states. */
typedef struct walk {
    tahr_world *world;
    const tahr_config *config;
    uint64_t hash;
    tahr_status status;
    int number;
} walk;

static void *take_walk(void *user)
{
    walk *w = user;
    tahr_mover *mover = NULL;
    tahr_state state;
    tahr_vec3 at = {-6.0 + 3 * w->number, 3, 0};
    w->hash = 0;
    w->status = tahr_mover_create(w->world, w->config, &mover);
    if (w->status < 0) return NULL;
    tahr_state_init(&state, w->config, &at);
    for (int i = 0; i < STEPS && w->status >= 0; i++) {
        tahr_input input = {.struct_size = sizeof input, .move = {(i / 70 + w->number) % 2 ? -1 : 1, 0, 0}};
        input.jump = i % 40 == 7 * w->number;
        input.flags = i % 60 > 50 ? TAHR_INPUT_DROP : 0;
        w->status = tahr_mover_step(mover, &input, 1.0 / 60, &state, NULL);
        w->hash = 31 * w->hash + tahr_state_hash(&state);
    }
    tahr_mover_destroy(mover);
    return NULL;
}

/* Seen from the side: a floor, a wall at each end, steps, a one-way shelf, and a sensor; as deep as one needs. */
static tahr_status open_yard(const tahr_backend *backend, const void *options, tahr_world **world)
{
    tahr_body_desc b[BODIES];
    tahr_world_desc desc;
    for (int i = 0; i < BODIES; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].pose.position = (tahr_vec3){2.0 * i - 8, 0.1 * (i % 3) - 0.5, 0};
        b[i].half_extents = (tahr_vec3){1, 0.5, 4};
    }
    b[0].half_extents.y = b[9].half_extents.y = 4;
    b[10] = b[11] = b[12] = b[4];
    b[10].pose.position.y = 1.5;
    b[10].half_extents.y = 0.1;
    b[10].flags = TAHR_BODY_ONE_WAY;
    b[11].pose.position.y = 1.2;
    b[11].flags = TAHR_BODY_SENSOR;
    b[12].pose.position.x = 5;
    b[12].half_extents.y = 0.7;
    b[12].flags = TAHR_BODY_MOVABLE;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = b;
    desc.body_count = BODIES;
    desc.options = options;
    return tahr_world_open(backend, &desc, world);
}

static void walk_together(const tahr_backend *backend, const void *options)
{
    tahr_world *world = NULL;
    tahr_config config;
    walk alone[THREADS], together[THREADS];
    pthread_t threads[THREADS];
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PLATFORMER);
    config.gravity = (tahr_vec3){0, -9.81, 0};
    config.plane = (tahr_vec3){0, 0, 1};
    assert_int_equal(open_yard(backend, options, &world), TAHR_OK);
    tahr_body_pose pose = {12, 0, {{5, 0.3, 0}, {0, 0, 0, 1}}};
    assert_int_equal(tahr_world_move(world, &pose, 1, 1.0 / 60), TAHR_OK); /* something moves, and pushes */
    for (int i = 0; i < THREADS; i++) {
        together[i] = alone[i] = (walk){.world = world, .config = &config, .number = i};
        take_walk(&alone[i]);
        assert_true(alone[i].status >= 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, take_walk, &together[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_int_equal(together[i].status, alone[i].status);
        assert_true(together[i].hash == alone[i].hash);
        assert_true(i == 0 || alone[i].hash != alone[i - 1].hash); /* they do not all do the same */
    }
    tahr_world_close(world);
}

static void characters_of_one_world_step_on_threads_as_if_alone(void **unused)
{
    (void)unused;
    walk_together(tahr_backend_v1_native(), NULL);
#ifdef TAHR_HAVE_CCD
    walk_together(tahr_backend_v1_ccd(), NULL);
#endif
#ifdef TAHR_HAVE_FCL
    walk_together(tahr_backend_v1_fcl(), NULL);
#endif
#ifdef TAHR_HAVE_BOX2D
    const uint32_t engines[] = {TAHR_BOX2D_2, TAHR_BOX2D_3};
    int found = 0;
    for (int i = 0; i < 2; i++) {
        tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engines[i]};
        tahr_world *world = NULL;
        if (open_yard(tahr_backend_v1_box2d(), &options, &world) < 0) continue; /* not built */
        tahr_world_close(world);
        found++;
        walk_together(tahr_backend_v1_box2d(), &options);
    }
    assert_true(found > 0);
#endif
}
#else
static void characters_of_one_world_step_on_threads_as_if_alone(void **unused)
{
    (void)unused;
    print_message("SKIP: unit_api_threads: no POSIX threads\n");
    skip();
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(characters_of_one_world_step_on_threads_as_if_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

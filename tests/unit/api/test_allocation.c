/* SPDX-License-Identifier: MIT
 * test_allocation.c: every allocation may fail, nothing leaks, and a step allocates nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "chaos.h"
#include "rig.h"

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif
#include <tahr/native.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"
#endif
#include "scene_backend.h"
#include "scene_tiles.h"
#include "scene_wander.h"

/* Every call of the C library's allocator in this process, libccd's included: the user's allocator sees only what is
 * asked of it. */
static volatile uint64_t heap_calls; /* compilers know that malloc changes no variable */

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#endif

#if defined(SANITIZED)
extern int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void *, size_t),
                                                     void (*freed)(const volatile void *));

static void count_allocated(const volatile void *memory, size_t size)
{
    (void)memory, (void)size;
    heap_calls++;
}

static void count_freed(const volatile void *memory)
{
    (void)memory;
    heap_calls++;
}

static int watch_heap(void)
{
    return __sanitizer_install_malloc_and_free_hooks(count_allocated, count_freed) != 0;
}
#elif defined(__GLIBC__)
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *memory, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *memory);

/* A program's own functions of these names take the place of the library's, for shared libraries too. */
void *malloc(size_t size)
{
    heap_calls++;
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    heap_calls++;
    return __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size)
{
    heap_calls++;
    return __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    heap_calls++;
    return __libc_memalign(alignment, size);
}

void free(void *memory)
{
    heap_calls++;
    __libc_free(memory);
}

static int watch_heap(void)
{
    return 1;
}
#else
static int watch_heap(void)
{
    return 0;
}
#endif

static void describe(tahr_world_desc *desc, tahr_body_desc bodies[2], const tahr_allocator *allocator)
{
    static const double vertices[] = {-50, -50, 0, 50, -50, 0, 50, 50, 0, -50, 50, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_MESH);
    bodies[0].vertices = vertices;
    bodies[0].indices = indices;
    bodies[0].vertex_count = 4;
    bodies[0].triangle_count = 2;
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_BOX);
    bodies[1].half_extents = fake_vec(1, 1, 0.15);
    bodies[1].pose.position = fake_vec(4, 0, 0.15);
    tahr_world_desc_init(desc, sizeof *desc);
    desc->bodies = bodies;
    desc->body_count = 2;
    desc->allocator = allocator;
}

static tahr_status open_all(int native, fake_world *fake, const tahr_allocator *allocator, tahr_world **world,
                            tahr_mover **mover)
{
    tahr_callbacks callbacks = fake_callbacks(fake);
    tahr_world_desc desc;
    tahr_body_desc bodies[2];
    tahr_config c = rig_config();
    describe(&desc, bodies, allocator);
    tahr_status status = native ? tahr_world_open(tahr_backend_v1_native(), &desc, world)
                                : tahr_world_open_callbacks(&callbacks, &desc, world);
    return status < 0 ? status : tahr_mover_create(*world, &c, mover);
}

static void every_failing_allocation_is_reported_and_nothing_leaks(void **unused)
{
    (void)unused;
    for (int native = 0; native < 2; native++) {
        fake_world fake;
        uint64_t k = 1;
        fake_world_init(&fake);
        for (;; k++) {
            fake_memory memory = {.fail_at = k};
            tahr_allocator allocator = fake_allocator(&memory);
            tahr_world *world = NULL;
            tahr_mover *mover = NULL;
            tahr_status status = open_all(native, &fake, &allocator, &world, &mover);
            if (status != TAHR_OK) {
                assert_int_equal(status, TAHR_E_MEMORY);
                assert_null(mover);
            }
            tahr_mover_destroy(mover);
            tahr_world_close(world);
            assert_int_equal(memory.live_blocks, 0);
            assert_int_equal(memory.live_bytes, 0);
            assert_int_equal(memory.mismatches, 0);
            if (status == TAHR_OK) {
                break;
            }
            assert_true(k < 1000);
        }
        assert_true(k > 1);
    }
}

static void a_thousand_steps_allocate_nothing(void **unused)
{
    (void)unused;
    for (int native = 0; native < 2; native++) {
        fake_world fake;
        fake_memory memory = {0};
        tahr_allocator allocator = fake_allocator(&memory);
        tahr_world *world = NULL;
        tahr_mover *mover = NULL;
        tahr_state state;
        tahr_input input = {.struct_size = sizeof input};
        tahr_config c = rig_config();
        tahr_vec3 at = {0, 0, 1};
        fake_world_flat(&fake);
        fake_add_box(&fake, fake_vec(3, -1, 0), fake_vec(5, 1, 0.3));
        assert_int_equal(open_all(native, &fake, &allocator, &world, &mover), TAHR_OK);
        tahr_state_init(&state, &c, &at);
        uint64_t before = memory.requests, bytes = memory.live_bytes, blocks = memory.live_blocks;
        for (int i = 0; i < 1000; i++) {
            input.move = fake_vec(cos(i * 0.01), sin(i * 0.03), 0);
            input.jump = i % 100 == 0;
            assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, NULL) >= 0);
        }
        assert_int_equal(memory.requests, before);
        assert_int_equal(memory.live_bytes, bytes);
        assert_int_equal(memory.live_blocks, blocks);
        tahr_mover_destroy(mover);
        tahr_world_close(world);
        assert_int_equal(memory.live_blocks, 0);
        assert_int_equal(memory.mismatches, 0);
    }
}

/* Onto a box and off it, jumps, gravity that turns, an overlap to get out of, wrong input: with full reports. */
static void step_through_everything(tahr_world *world, const tahr_config *config, tahr_mover *mover)
{
    static tahr_event events[64];
    static tahr_decision decisions[256];
    tahr_input input = {.struct_size = sizeof input};
    tahr_vec3 at = {0, 0, 1};
    tahr_state state;
    tahr_state_init(&state, config, &at);
    for (int i = 0; i < 600; i++) {
        tahr_report report = {.struct_size = sizeof report,
                              .events = events,
                              .decisions = decisions,
                              .event_capacity = 64,
                              .decision_capacity = i % 2 ? 256 : 2};
        input.move = fake_vec(cos(i * 0.01), sin(i * 0.03), 0);
        input.jump = i % 100 == 0;
        input.flags = i % 150 > 140 ? TAHR_INPUT_GRAVITY | TAHR_INPUT_FACING : 0;
        input.gravity = fake_vec(i % 2 ? 3 : 0, 0, -9);
        input.facing = input.move;
        if (i % 60 == 59) {
            state.position = fake_vec(3.5, 0, 1); /* inside the box */
            state.velocity = fake_vec(1, 0, 0);
            state.floor_revision = 0;
        }
        tahr_mover_step(mover, &input, i % 10 == 9 ? 0.1 : 1.0 / 60, &state, &report);
        tahr_mover_step(mover, &input, -1, &state, NULL); /* an error allocates nothing either */
    }
    tahr_hit hits[4];
    tahr_contact contacts[4];
    uint32_t count;
    tahr_sweep sweep = {.shape = config->shape, .position = {4, 0, 3}, .up = {0, 0, 1}, .orientation = {0, 0, 0, 1}};
    sweep.motion = fake_vec(0, 0, -4), sweep.mask = ~0u, sweep.ignore_body = TAHR_NO_BODY;
    tahr_contact_query near = {.shape = config->shape, .position = {4, 0, 1}, .up = {0, 0, 1}};
    near.orientation.w = 1, near.margin = 0.5, near.mask = ~0u, near.ignore_body = TAHR_NO_BODY;
    tahr_ray ray = {.origin = {4, 0, 3}, .motion = {0, 0, -4}, .mask = ~0u, .ignore_body = TAHR_NO_BODY};
    tahr_world_sweep(world, &sweep, hits, 4, &count);
    tahr_world_contacts(world, &near, contacts, 4, &count);
    tahr_world_ray(world, &ray, hits, &count);
}

static void no_step_of_any_backend_touches_the_heap(void **unused)
{
    const tahr_backend *backends[] = {
        tahr_backend_v1_native(),
#ifdef TAHR_HAVE_CCD
        tahr_backend_v1_ccd(),
#endif
#ifdef TAHR_HAVE_FCL
        tahr_backend_v1_fcl(),
#endif
    };
    (void)unused;
    if (!watch_heap()) {
        print_message("SKIP: unit_api_allocation: no way to count this C library's allocations\n");
        skip();
    }
    uint64_t before = heap_calls;
    void *volatile probe = malloc(1);
    free(probe);
    assert_true(heap_calls >= before + 2); /* the count counts */
    for (size_t b = 0; b < sizeof backends / sizeof backends[0]; b++) {
        for (int box = 0; box < 2; box++) {
            tahr_native_desc options = {.struct_size = sizeof options};
            tahr_world_desc desc;
            tahr_body_desc bodies[2];
            tahr_world *world = NULL;
            tahr_mover *mover = NULL;
            tahr_config c = rig_config();
            if (box) {
                c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.3};
            }
            describe(&desc, bodies, NULL);
            desc.options = backends[b] == tahr_backend_v1_native() ? &options : NULL;
            assert_int_equal(tahr_world_open(backends[b], &desc, &world), TAHR_OK);
            assert_int_equal(tahr_mover_create(world, &c, &mover), TAHR_OK);
            before = heap_calls;
            step_through_everything(world, &c, mover);
            uint64_t calls = heap_calls - before;
            if (calls > 0) {
                fail_msg("%s: %llu calls of malloc or free in steps", backends[b]->name, (unsigned long long)calls);
            }
            tahr_mover_destroy(mover);
            tahr_world_close(world);
        }
    }
}

/* Running, jumping and dropping through tiles, stairs, slopes, walls and one-way platforms. */
static uint64_t heap_calls_in_a_plane(const scene_backend *backend, const scene_tiles *tiles)
{
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    uint64_t seed = 3, calls = 0;
    long modes[TAHR_MODE_CUSTOM + 1] = {0};
    tahr_config c;
    tahr_config_init(&c, sizeof c, TAHR_PRESET_PLATFORMER);
    assert_int_equal(
        scene_backend_open(backend, scene_tiles_for(tiles, backend->get()), SCENE_TILE_BODIES, NULL, &world), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, &c, &mover), TAHR_OK);
    for (uint32_t i = 0; i < 8; i++) {
        scene_wanderer wanderer;
        tahr_state state;
        assert_true(scene_wander_spawn(world, &c, &tiles->bounds, &seed, &state));
        scene_wander_start(&wanderer, 1, i);
        for (int n = 0; n < 300; n++) {
            tahr_input input = *scene_wander_next_side(&wanderer, 1.0 / 60);
            input.flags = n % 50 == 49 ? TAHR_INPUT_DROP : 0;
            input.crouch = n % 90 > 80;
            if (n % 100 == 99) { /* into the ground */
                state.position.y = -0.3;
                state.floor_revision = 0;
            }
            uint64_t before = heap_calls;
            assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, NULL) >= 0);
            calls += heap_calls - before;
            modes[state.mode]++;
        }
    }
    assert_true(modes[TAHR_MODE_WALKING] > 400 && modes[TAHR_MODE_FALLING] > 100);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return calls;
}

static void no_step_in_a_plane_touches_the_heap(void **unused)
{
    static scene_tiles tiles;
    (void)unused;
    if (!watch_heap()) {
        print_message("SKIP: unit_api_allocation: no way to count this C library's allocations\n");
        skip();
    }
    scene_tiles_make(&tiles);
    for (int i = 0; i < SCENE_BACKEND_COUNT; i++) {
        assert_int_equal(heap_calls_in_a_plane(&SCENE_BACKENDS[i], &tiles), 0);
    }
    for (int i = 0; i < SCENE_PLANAR_BACKEND_COUNT; i++) {
        assert_int_equal(heap_calls_in_a_plane(&SCENE_PLANAR_BACKENDS[i], &tiles), 0);
    }
}

#ifdef TAHR_HAVE_CCD
/* Every convex kind of body and shape, with both of libccd's tests; through a wall of solids, so that all is met. */
static uint64_t heap_calls_of_solids(const tahr_ccd_desc *options)
{
    static const double tetrahedron[] = {-1, -1, -1, 1, 1, -1, 1, -1, 1, -1, 1, 1};
    static const tahr_shape shapes[] = {
        {TAHR_SHAPE_SPHERE, 0, 0.3, 0.3, 0, 0}, {TAHR_SHAPE_CAPSULE, 0, 0.3, 0.9, 0, 0},
        {TAHR_SHAPE_BOX, 0, 0, 0.9, 0.3, 0.3},  {TAHR_SHAPE_CYLINDER, 0, 0.3, 0.9, 0, 0},
        {TAHR_SHAPE_CONE, 0, 0.3, 0.9, 0, 0},   {TAHR_SHAPE_ELLIPSOID, 0, 0, 0.9, 0.3, 0.3},
        {TAHR_SHAPE_HULL, 0, 0, 1, 1, 1},
    };
    enum { KINDS = 8 };
    tahr_body_desc bodies[KINDS];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_hit hits[4];
    tahr_contact contacts[8];
    uint32_t count;
    for (uint32_t i = 0; i < KINDS; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], i == 0 ? TAHR_BODY_HULL : TAHR_BODY_MESH + i);
        bodies[i].flags = i == 0 ? TAHR_BODY_TEMPLATE : 0;
        bodies[i].pose.position.x = i * 1.5;
        bodies[i].radius = bodies[i].half_height = 0.5;
        bodies[i].half_extents = (tahr_vec3){0.5, 0.4, 0.3};
        bodies[i].vertices = tetrahedron;
        bodies[i].vertex_count = 4;
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = KINDS;
    desc.options = options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_ccd(), &desc, &world), TAHR_OK);
    uint64_t before = heap_calls, found = 0;
    for (uint32_t i = 0; i < 7 * 120; i++) {
        tahr_sweep q = {.shape = shapes[i % 7], .position = {0.1 * i / 7, 0, 2}, .up = {0, 0, 1}, .margin = 0.01};
        q.orientation.w = 1;
        q.motion = (tahr_vec3){0.2, 0.1, -3};
        q.mask = 0xFFFFFFFFu;
        q.ignore_body = TAHR_NO_BODY;
        tahr_contact_query around = {q.shape, {0.1 * i / 7, 0, 0.2}, q.up, q.orientation, 0.1, q.mask, TAHR_NO_BODY, 0,
                                     0};
        assert_true(tahr_world_sweep(world, &q, hits, 4, &count) >= 0);
        found += count;
        assert_true(tahr_world_contacts(world, &around, contacts, 8, &count) >= 0);
        found += count;
    }
    uint64_t calls = heap_calls - before;
    assert_true(found > 500);
    tahr_world_close(world);
    return calls;
}

static void no_query_of_any_convex_shape_touches_the_heap(void **unused)
{
    const tahr_ccd_desc by_gjk = {sizeof by_gjk, TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_GJK, 0, {0}};
    const tahr_ccd_desc by_mpr = {sizeof by_mpr, TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_MPR, 0, {0}};
    (void)unused;
    if (!watch_heap()) {
        print_message("SKIP: unit_api_allocation: no way to count this C library's allocations\n");
        skip();
    }
    assert_int_equal(heap_calls_of_solids(NULL), 0);
    assert_int_equal(heap_calls_of_solids(&by_gjk), 0);
    assert_int_equal(heap_calls_of_solids(&by_mpr), 0);
}
#endif

/* Every kind of body, request and mode, with full reports: see chaos.h. */
static uint64_t heap_calls_of_chaos(const tahr_backend *backend, uint64_t seed, long modes[TAHR_MODE_CUSTOM + 1])
{
    static chaos_scene scene;
    static tahr_event events[64];
    static tahr_decision decisions[512];
    static tahr_query_record queries[256];
    oracle_random dice = {seed};
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_state state;
    tahr_config c;
    uint64_t calls = 0;
    do {
        c = chaos_config(&dice);
    } while (tahr_config_check(&c, NULL) < 0);
    chaos_build(&scene, &dice, 1);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = scene.bodies;
    desc.body_count = CHAOS_BODIES;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, &c, &mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&state, &c, &(tahr_vec3){0, 0, 0}), TAHR_OK);
    for (int n = 0; n < 60; n++) {
        tahr_body_pose moves[CHAOS_MOVABLES];
        tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 64};
        if (n % 2) {
            report.decisions = decisions, report.decision_capacity = 512;
            report.queries = queries, report.query_capacity = 256;
        }
        uint32_t count = chaos_drift(&scene, &dice, 0.02, moves);
        assert_int_equal(tahr_world_move(world, moves, count, 0.02), TAHR_OK);
        tahr_input input = chaos_input(&dice, n % 3, &c, &state);
        uint64_t before = heap_calls;
        assert_true(tahr_mover_step(mover, &input, chaos_dt(&dice, &c), &state, &report) >= 0);
        calls += heap_calls - before;
        modes[state.mode]++;
        if (!(fabs(state.position.x) + fabs(state.position.y) + fabs(state.position.z) < 50)) {
            tahr_state_teleport(&state, &(tahr_vec3){0, 0, 0});
        }
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return calls;
}

static void no_step_of_any_feature_touches_the_heap(void **unused)
{
    long modes[TAHR_MODE_CUSTOM + 1] = {0};
    (void)unused;
    if (!watch_heap()) {
        print_message("SKIP: unit_api_allocation: no way to count this C library's allocations\n");
        skip();
    }
    for (uint64_t seed = 1; seed <= 40; seed++) {
        assert_int_equal(heap_calls_of_chaos(tahr_backend_v1_native(), seed, modes), 0);
    }
    assert_true(modes[TAHR_MODE_WALKING] && modes[TAHR_MODE_FALLING] && modes[TAHR_MODE_SWIMMING]);
    assert_true(modes[TAHR_MODE_FLYING] != 0);
#ifdef TAHR_HAVE_CCD
    assert_int_equal(heap_calls_of_chaos(tahr_backend_v1_ccd(), 41, modes), 0);
#endif
}

/* A height field of 500 x 500 cells, two triangles each. */
enum { FIELD = 500 };

#ifdef TAHR_HAVE_THREADS
/* Neither by who steps nor by the thread that drains. */
static void no_call_of_telemetry_but_create_and_destroy_touches_the_heap(void **unused)
{
    const tahr_body_pose pose = {3, 0, {{1, 2, 3}, {0, 0, 0, 1}}};
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    tahr_telemetry_counts counts = {.struct_size = sizeof counts};
    tahr_state state;
    made_up m;
    (void)unused;
    if (!watch_heap()) {
        print_message("SKIP: unit_api_allocation: no way to count this C library's allocations\n");
        skip();
    }
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    desc.bodies = 4;
    desc.ring_bytes = 16384; /* full now and then */
    listener_close(&ear);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    listener_wait_for_call(&ear); /* the thread is there, with all that the system gives it */
    made_up_init(&m, 1);
    const uint64_t before = heap_calls;
    for (int i = 0; i < 2000; i++) {
        if (i == 1000) listener_open(&ear);
        tahr_telemetry_begin(t, 0, 0, 0, &m.state);
        made_up_step(&m);
        const tahr_telemetry_step step = made_up_pushed(&m, 0);
        tahr_telemetry_push(t, 0, &step);
        tahr_telemetry_change(t, TAHR_CHANGE_MOVE, &pose, 1, 0.1, (uint64_t)i);
        tahr_telemetry_latest(t, 0, &state, NULL);
        tahr_telemetry_get_counts(t, &counts);
    }
    while (counts.delivered[TAHR_MESSAGE_STATE] + counts.dropped[TAHR_MESSAGE_STATE] < 2000)
        tahr_telemetry_get_counts(t, &counts);
    assert_int_equal(heap_calls - before, 0);
    assert_true(counts.delivered[TAHR_MESSAGE_STATE] > 0 && counts.dropped[TAHR_MESSAGE_STATE] > 0);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}
#endif

static void a_large_mesh_stays_under_a_hundred_bytes_per_triangle(void **unused)
{
    const uint32_t triangles = 2 * FIELD * FIELD, corners = (FIELD + 1) * (FIELD + 1);
    double *vertices = malloc(3 * corners * sizeof *vertices);
    uint32_t *indices = malloc(3 * triangles * sizeof *indices), *next = indices;
    (void)unused;
    assert_true(vertices && indices);
    for (uint32_t i = 0; i < corners; i++) {
        double x = i % (FIELD + 1), y = i / (FIELD + 1);
        vertices[3 * i] = x;
        vertices[3 * i + 1] = y;
        vertices[3 * i + 2] = sin(0.1 * x) * cos(0.07 * y);
    }
    for (uint32_t i = 0; i < FIELD * FIELD; i++) {
        uint32_t a = i / FIELD * (FIELD + 1) + i % FIELD, b = a + FIELD + 1;
        const uint32_t quad[6] = {a, a + 1, b + 1, a, b + 1, b};
        memcpy(next, quad, sizeof quad);
        next += 6;
    }
    tahr_native_desc options = {.struct_size = sizeof options};
    fake_memory memory = {0};
    tahr_allocator allocator = fake_allocator(&memory);
    tahr_world_desc desc;
    tahr_body_desc body;
    tahr_world *world = NULL;
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
    body.vertices = vertices, body.vertex_count = corners;
    body.indices = indices, body.triangle_count = triangles;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &body, desc.body_count = 1;
    desc.options = &options;
    desc.allocator = &allocator;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    assert_int_equal(tahr_world_memory(world), memory.live_bytes); /* nothing went past the allocator */
    double each = (double)tahr_world_memory(world) / triangles;
    print_message("%.1f bytes per triangle\n", each);
    assert_true(each < 100);
    tahr_world_close(world);
    assert_int_equal(memory.live_bytes, 0);
    free(indices);
    free(vertices);
}

/* What native.h says of a character's cache: so many bytes for every triangle that it can hold. */
static void a_movers_cache_costs_what_the_header_says(void **unused)
{
    const double said = 288;
    (void)unused;
    const uint32_t held[2] = {192, 4096};
    uint64_t bytes[2];
    for (int i = 0; i < 2; i++) {
        tahr_native_desc options = {.struct_size = sizeof options};
        options.cache_triangles = held[i];
        fake_memory memory = {0};
        tahr_allocator allocator = fake_allocator(&memory);
        tahr_world_desc desc;
        tahr_body_desc bodies[2];
        tahr_world *world = NULL;
        tahr_mover *mover = NULL;
        tahr_config c = rig_config();
        describe(&desc, bodies, &allocator);
        desc.options = &options;
        assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
        uint64_t before = memory.live_bytes;
        assert_int_equal(tahr_mover_create(world, &c, &mover), TAHR_OK);
        bytes[i] = memory.live_bytes - before;
        assert_int_equal(tahr_world_memory(world), before); /* a mover's memory is not the world's */
        tahr_mover_destroy(mover);
        tahr_world_close(world);
    }
    double each = (double)(bytes[1] - bytes[0]) / (held[1] - held[0]);
    print_message("a mover of %u triangles has %llu bytes, %.1f for each more\n", held[0], (unsigned long long)bytes[0],
                  each);
    assert_near(each, said, 0);
    assert_true((double)bytes[0] < said * held[0] + 5632); /* config, the last step, the header, dear sweeps */
}

static void world_memory_is_what_the_allocator_holds(void **unused)
{
    (void)unused;
    for (int native = 0; native < 2; native++) {
        fake_world fake;
        fake_memory memory = {0};
        tahr_allocator allocator = fake_allocator(&memory);
        tahr_world *world = NULL;
        tahr_mover *mover = NULL;
        fake_world_init(&fake);
        assert_int_equal(open_all(native, &fake, &allocator, &world, &mover), TAHR_OK);
        tahr_mover_destroy(mover); /* its memory is not the world's */
        assert_int_equal(tahr_world_memory(world), memory.live_bytes);
        tahr_world_close(world);
    }
    assert_int_equal(tahr_world_memory(NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_failing_allocation_is_reported_and_nothing_leaks),
                                       cmocka_unit_test(a_thousand_steps_allocate_nothing),
                                       cmocka_unit_test(no_step_of_any_backend_touches_the_heap),
                                       cmocka_unit_test(no_step_of_any_feature_touches_the_heap),
                                       cmocka_unit_test(no_step_in_a_plane_touches_the_heap),
#ifdef TAHR_HAVE_CCD
                                       cmocka_unit_test(no_query_of_any_convex_shape_touches_the_heap),
#endif
#ifdef TAHR_HAVE_THREADS
                                       cmocka_unit_test(no_call_of_telemetry_but_create_and_destroy_touches_the_heap),
#endif
                                       cmocka_unit_test(a_large_mesh_stays_under_a_hundred_bytes_per_triangle),
                                       cmocka_unit_test(a_movers_cache_costs_what_the_header_says),
                                       cmocka_unit_test(world_memory_is_what_the_allocator_holds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

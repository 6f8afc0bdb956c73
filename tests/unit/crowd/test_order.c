/* SPDX-License-Identifier: MIT
 * test_order.c: the order of the arrays, of the tasks, and the number of threads and of parts change no bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "throng.h"
#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.h>
#endif

enum { COUNT = 160, TICKS = 60 };

/* How a run differs from another one in what must not matter. */
typedef struct manner {
    tahr_run_tasks_fn run;
    void *user;
    uint32_t tasks;
    int shuffles;
    double budget;
    uint32_t flags;
} manner;

static void swap(throng *t, uint32_t i, uint32_t j)
{
    const tahr_member m = t->members[i];
    const tahr_state s = t->states[i];
    const tahr_input in = t->inputs[i];
    const tahr_delay d = t->delays[i];
    t->members[i] = t->members[j], t->members[j] = m;
    t->states[i] = t->states[j], t->states[j] = s;
    t->inputs[i] = t->inputs[j], t->inputs[j] = in;
    t->delays[i] = t->delays[j], t->delays[j] = d;
}

/* What a character wants depends on its id, and on where it is. */
static void want(throng *t, uint32_t i, int tick)
{
    const uint32_t id = t->members[i].id;
    const tahr_vec3 p = t->states[i].position;
    const double d = fmax(hypot(p.x, p.y), 1e-9), side = id % 3 == 0 ? 0.5 : 0;
    throng_go(t, i, -p.x / d - side * p.y / d, -p.y / d + side * p.x / d);
    t->inputs[i].jump = (id + (uint32_t)tick) % 37 == 0;
    t->inputs[i].crouch = (id + (uint32_t)tick / 20) % 11 == 0;
}

/* A crowd around a lift, some overlapping from the start, of two sizes. Returns the hash of all ticks. */
static uint64_t run(const manner *how)
{
    tahr_body_desc b[2];
    tahr_config configs[2];
    oracle_random dice = {11};
    throng t;
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = i ? (tahr_vec3){3, 3, 0.2} : (tahr_vec3){60, 60, 1};
        b[i].pose.position.z = i ? -0.1 : -1;
    }
    b[1].flags = TAHR_BODY_MOVABLE;
    throng_open(&t, b, 2);
    configs[0] = configs[1] = t.config;
    configs[1].shape.radius = 0.5;
    configs[1].mass = 200;
    t.desc.configs = configs;
    t.desc.config_count = 2;
    t.desc.run_tasks = how->run;
    t.desc.run_user = how->user;
    t.desc.tasks = how->tasks;
    t.desc.flags = how->flags;
    throng_make(&t, COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        t.members[i].config = i % 5 == 0;
        t.members[i].budget = how->budget;
        throng_place(&t, i, (i % 13 - 6.0) * 0.8, (i / 13 - 6.0) * 0.8);
    }
    uint64_t hash = 0;
    for (int tick = 0; tick < TICKS; tick++) {
        tahr_body_pose pose = {.body = 1, .pose = {{0.01 * tick, 0, -0.1 + 0.005 * tick}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_world_move(t.world, &pose, 1, 1.0 / 60), TAHR_OK);
        for (uint32_t i = 1; how->shuffles && i < COUNT; i++) {
            swap(&t, i, oracle_below(&dice, i + 1));
        }
        for (uint32_t i = 0; i < COUNT; i++) {
            want(&t, i, tick);
        }
        assert_true(throng_step(&t) >= 0);
        hash = hash * 31 + throng_hash(&t);
    }
    throng_close(&t);
    return hash;
}

static void shuffled_arrays_give_the_same_bits(void **unused)
{
    (void)unused;
    for (int i = 0; i < 2; i++) {
        const double budget = i ? 0.05 : 0;
        assert_int_equal(run(&(manner){.budget = budget}), run(&(manner){.shuffles = 1, .budget = budget}));
    }
}

static void tasks_in_any_order_give_the_same_bits(void **unused)
{
    uint32_t calls = 0;
    (void)unused;
    const uint64_t hash = run(&(manner){.tasks = 1});
    assert_int_equal(run(&(manner){.run = throng_backwards, .user = &calls}), hash);
    assert_true(calls >= TICKS);
    assert_int_equal(run(&(manner){.run = throng_backwards, .tasks = 7, .shuffles = 1}), hash);
    assert_int_equal(run(&(manner){.tasks = 4096}), hash);
}

static void a_lean_crowd_gives_the_same_bits(void **unused)
{
    (void)unused;
    const manner fat = {.budget = 0.02, .flags = TAHR_CROWD_STAND_ON_HEADS};
    manner lean = fat;
    lean.flags |= TAHR_CROWD_LEAN;
    lean.shuffles = 1;
    assert_int_equal(run(&lean), run(&fat));
}

static void any_number_of_threads_gives_the_same_bits(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_THREADS
    static const uint32_t counts[] = {1, 2, 3, 8};
    const uint64_t hash = run(&(manner){.budget = 0.02});
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        tahr_threads *threads = NULL;
        assert_int_equal(tahr_threads_create(NULL, counts[i], &threads), TAHR_OK);
        assert_int_equal(run(&(manner){.run = tahr_threads_run, .user = threads, .budget = 0.02, .shuffles = i == 1}),
                         hash);
        tahr_threads_destroy(threads);
    }
#else
    printf("SKIP: any_number_of_threads_gives_the_same_bits: built without threads\n");
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shuffled_arrays_give_the_same_bits),
        cmocka_unit_test(tasks_in_any_order_give_the_same_bits),
        cmocka_unit_test(a_lean_crowd_gives_the_same_bits),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_asked.c: a dear sweep that is asked again is answered from memory: the same bits as without (no_vicinity), until
 * a body is placed or the frame changes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native/asked.h"
#include "native_fixture.h"
#include "oracle.h"

enum { CELLS = 8, SWEEPS = 3 * TAHR__ASKED };

static double peaks(double x, double y)
{
    return 0.3 * (double)(((int)floor(x) * 5 + (int)floor(y) * 3) & 3);
}

typedef struct worlds {
    double vertices[3 * (CELLS + 1) * (CELLS + 1)];
    uint32_t indices[6 * CELLS * CELLS];
    fixture with, without;
} worlds;

/* Hills, and a ball that may be placed. */
static void open_worlds(worlds *w)
{
    tahr_body_desc bodies[2];
    tahr_native_desc options = fixture_options();
    fixture_grid(CELLS, 1, peaks, w->vertices, w->indices);
    bodies[0] = fixture_mesh(w->vertices, (CELLS + 1) * (CELLS + 1), w->indices, 2 * CELLS * CELLS);
    bodies[1] = fixture_body(TAHR_BODY_SPHERE);
    bodies[1].radius = 0.5;
    bodies[1].flags |= TAHR_BODY_MOVABLE;
    bodies[1].pose.position = (tahr_vec3){2, 2, 30};
    fixture_init(&w->with);
    fixture_init(&w->without);
    assert_int_equal(fixture_open(&w->with, bodies, 2, &options, 1), TAHR_OK);
    options.no_vicinity = 1;
    assert_int_equal(fixture_open(&w->without, bodies, 2, &options, 1), TAHR_OK);
}

static void close_worlds(worlds *w)
{
    fixture_close(&w->with);
    fixture_close(&w->without);
}

static void announce(worlds *w, tahr_vec3 position)
{
    fixture_announce(&w->with, position, 6);
    fixture_announce(&w->without, position, 6);
}

/* Returns how much was measured with a memory. */
static uint64_t ask(worlds *w, const tahr_sweep *sweep)
{
    const uint64_t before = w->with.context.narrow_iterations;
    const tahr_hit a = fixture_hit(&w->with, sweep), b = fixture_hit(&w->without, sweep);
    assert_memory_equal(&a, &b, sizeof a);
    return w->with.context.narrow_iterations - before;
}

static tahr_sweep any_sweep(oracle_random *random)
{
    tahr_vec3 from = {oracle_uniform(random, 1, 6), oracle_uniform(random, 1, 6), oracle_uniform(random, 1.5, 2.5)};
    tahr_vec3 motion = {oracle_uniform(random, -3, 3), oracle_uniform(random, -3, 3), oracle_uniform(random, -1, 0)};
    return fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), from, motion, 0.01);
}

static void what_was_dear_is_measured_once_and_answered_alike(void **unused)
{
    static worlds w;
    oracle_random random = {.state = 3};
    uint32_t again = 0;
    (void)unused;
    open_worlds(&w);
    announce(&w, (tahr_vec3){3, 3, 2});
    for (int i = 0; i < 2000; i++) {
        const tahr_sweep sweep = any_sweep(&random);
        const uint64_t measured = ask(&w, &sweep), spared = w.with.context.spared;
        if (measured < TAHR__DEAR) continue;
        assert_int_equal(ask(&w, &sweep), 0);
        assert_int_equal(w.with.context.spared, spared + 1);
        tahr_sweep other = sweep;
        other.mask = 0;
        ask(&w, &other); /* another question, though from the same place */
        again++;
    }
    assert_true(again > 100);
    close_worlds(&w);
}

static void the_last_are_remembered_in_any_order(void **unused)
{
    static worlds w;
    oracle_random random = {.state = 4};
    tahr_sweep dear[SWEEPS];
    (void)unused;
    open_worlds(&w);
    announce(&w, (tahr_vec3){3, 3, 2});
    for (int i = 0; i < SWEEPS;) {
        dear[i] = any_sweep(&random);
        i += ask(&w, &dear[i]) >= TAHR__DEAR;
    }
    for (int i = SWEEPS - 1; i >= 0; i--)
        assert_true((ask(&w, &dear[i]) == 0) == (i >= SWEEPS - TAHR__ASKED));
    close_worlds(&w);
}

static void a_body_that_is_placed_and_another_frame_make_it_forget(void **unused)
{
    static worlds w;
    oracle_random random = {.state = 5};
    const tahr_backend *b = tahr_backend_v1_native();
    uint32_t blocked = 0;
    (void)unused;
    open_worlds(&w);
    for (int i = 0; i < 1000; i++) {
        const tahr_sweep sweep = any_sweep(&random);
        tahr_body_pose move = {.body = 1, .pose = {.orientation = {0, 0, 0, 1}}};
        announce(&w, (tahr_vec3){3, 3, 2});
        if (ask(&w, &sweep) < TAHR__DEAR) continue;
        announce(&w, (tahr_vec3){5, 3, 2}); /* of the next cell */
        assert_true(ask(&w, &sweep) > 0);
        move.pose.position = (tahr_vec3){sweep.position.x + 0.9 * sweep.motion.x / 3,
                                         sweep.position.y + 0.9 * sweep.motion.y / 3, sweep.position.z};
        assert_int_equal(b->place(w.with.self, &move, 1), TAHR_OK);
        assert_int_equal(b->place(w.without.self, &move, 1), TAHR_OK);
        ask(&w, &sweep);
        blocked += fixture_hit(&w.with, &sweep).body == 1;
        move.pose.position.z = 30;
        assert_int_equal(b->place(w.with.self, &move, 1), TAHR_OK);
        assert_int_equal(b->place(w.without.self, &move, 1), TAHR_OK);
        ask(&w, &sweep);
    }
    assert_true(blocked > 20);
    close_worlds(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_was_dear_is_measured_once_and_answered_alike),
                                       cmocka_unit_test(the_last_are_remembered_in_any_order),
                                       cmocka_unit_test(a_body_that_is_placed_and_another_frame_make_it_forget)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

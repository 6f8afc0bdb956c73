/* SPDX-License-Identifier: MIT
 * test_put_off.c: what waits until all that is beside the start is known is asked again alone: the same bits as if all
 * were asked again (no_vicinity), and less work. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_fixture.h"
#include "oracle.h"

enum { CELLS = 8, BOXES = 12 };

static double peaks(double x, double y)
{
    return 0.3 * (double)(((int)floor(x) * 5 + (int)floor(y) * 3) & 3);
}

/* Sweeps that begin in what they touch and in what they overlap, and go on far beyond it. Returns how much less was
 * measured, of all. */
static double compare(const tahr_body_desc *bodies, uint32_t count, double middle, uint64_t seed)
{
    oracle_random random = {.state = seed};
    tahr_native_desc options = fixture_options();
    fixture with, without;
    uint32_t hits = 0;
    fixture_init(&with);
    fixture_init(&without);
    assert_int_equal(fixture_open(&with, bodies, count, &options, 0), TAHR_OK);
    options.no_vicinity = 1;
    assert_int_equal(fixture_open(&without, bodies, count, &options, 0), TAHR_OK);
    for (int i = 0; i < 4000; i++) {
        tahr_shape shape = fixture_shape(i % 3 ? TAHR_SHAPE_CAPSULE : TAHR_SHAPE_SPHERE, 0.35, i % 3 ? 0.9 : 0.35);
        tahr_vec3 from = {middle + oracle_uniform(&random, -3, 3), middle + oracle_uniform(&random, -3, 3),
                          oracle_uniform(&random, 0.2, 2)};
        tahr_vec3 motion = {oracle_uniform(&random, -2, 2), oracle_uniform(&random, -2, 2),
                            oracle_uniform(&random, -1, 1)};
        tahr_sweep sweep = fixture_sweep(shape, from, motion, 0.01);
        sweep.flags = i % 2 ? TAHR_SWEEP_LEAVE_OVERLAP : 0u;
        tahr_hit a = fixture_hit(&with, &sweep), b = fixture_hit(&without, &sweep);
        assert_memory_equal(&a, &b, sizeof a);
        hits += a.blocking && !a.start_overlap;
    }
    assert_true(hits > 500);
    double less = 1 - (double)with.context.narrow_tests / (double)without.context.narrow_tests;
    fixture_close(&with);
    fixture_close(&without);
    return less;
}

static void who_waits_is_asked_alone_over_a_mesh(void **unused)
{
    double vertices[3 * (CELLS + 1) * (CELLS + 1)];
    uint32_t indices[6 * CELLS * CELLS];
    (void)unused;
    fixture_grid(CELLS, 1, peaks, vertices, indices);
    tahr_body_desc mesh = fixture_mesh(vertices, (CELLS + 1) * (CELLS + 1), indices, 2 * CELLS * CELLS);
    assert_true(compare(&mesh, 1, CELLS / 2, 1) > 0.05);
    mesh.flags |= TAHR_BODY_TWO_SIDED;
    assert_true(compare(&mesh, 1, CELLS / 2, 2) > 0.05);
}

static void who_waits_is_asked_alone_among_boxes(void **unused)
{
    oracle_random random = {.state = 7};
    tahr_body_desc boxes[BOXES];
    (void)unused;
    for (int kind = 0; kind < 2; kind++) {
        for (uint32_t i = 0; i < BOXES; i++) {
            boxes[i] = fixture_body(TAHR_BODY_BOX);
            boxes[i].half_extents = (tahr_vec3){oracle_uniform(&random, 0.2, 1), oracle_uniform(&random, 0.2, 1), 0.2};
            boxes[i].pose.position = (tahr_vec3){oracle_uniform(&random, -3, 3), oracle_uniform(&random, -3, 3),
                                                 oracle_uniform(&random, 0, 2)};
            boxes[i].flags |= kind && i % 2 ? TAHR_BODY_ONE_WAY : 0u;
        }
        assert_true(compare(boxes, BOXES, 0, 3) > 0.05);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(who_waits_is_asked_alone_over_a_mesh),
                                       cmocka_unit_test(who_waits_is_asked_alone_among_boxes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_flight.c: who passes an edge within what the narrow phase promises is free, after a few looks and not the
 * fifteen in which Newton's method comes down to a graze. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "native_fixture.h"

/* Past the upright edge of a box at (1, 1) along a straight way that comes `lowest` nearer than the margin to it.
 * Returns whether it is stopped. */
static int is_stopped(fixture *f, double half_way, double lowest)
{
    const double s = sqrt(0.5), off = 1 + s * (0.36 - lowest);
    tahr_vec3 from = {off - s * half_way, off + s * half_way, 0};
    tahr_vec3 motion = {2 * s * half_way, -2 * s * half_way, 0};
    tahr_sweep sweep = fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), from, motion, 0.01);
    return (int)fixture_hit(f, &sweep).blocking;
}

static void a_graze_is_passed_after_few_looks(void **unused)
{
    const double lowest[] = {-9.6e-11, -9.3e-11, 0, 3e-10};
    tahr_body_desc box = fixture_body(TAHR_BODY_BOX);
    tahr_native_desc options = fixture_options();
    fixture f;
    (void)unused;
    box.half_extents = (tahr_vec3){1, 1, 2};
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &box, 1, &options, 0), TAHR_OK);
    for (double half_way = 0.003; half_way < 0.1; half_way *= 1.3) {
        for (int i = 0; i < 4; i++) {
            const tahr_query_context before = f.context;
            assert_false(is_stopped(&f, half_way, lowest[i]));
            const uint64_t tests = f.context.narrow_tests - before.narrow_tests;
            assert_true(f.context.narrow_iterations - before.narrow_iterations <= 4 * tests);
        }
        assert_true(is_stopped(&f, half_way, 5e-9));
    }
    fixture_close(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_graze_is_passed_after_few_looks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_ray.c: rays of the native backend. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

static void rays_hit_fronts_and_slip_through_no_seam(void **state)
{
    (void)state;
    fixture f;
    static native_grid grid;
    tahr_body_desc bodies[NATIVE_HILLS];
    native_hills(&grid, bodies);
    native_open(&f, bodies, NATIVE_HILLS, 0);
    const tahr_backend *b = tahr_backend_v1_native();
    tahr_hit hit;
    uint32_t count = 0, solid = 0;
    for (int i = 1; i < 96; i++) {
        for (int j = 1; j < 96; j++) {
            /* Down, exactly on lattice lines and diagonals. */
            tahr_ray ray = {v_make(i * 0.125, j * 0.125, 5), v_make(0, 0, -10), 1, TAHR_NO_BODY};
            assert_int_equal(b->ray(f.self, &f.context, &ray, &hit, &count), TAHR_OK);
            assert_int_equal(count, 1);
            assert_true(hit.blocking && hit.normal.z > 0 && hit.fraction > 0 && hit.fraction < 1);
            /* And up: nothing of the hills, which have no back. */
            ray.origin.z = -5;
            ray.motion.z = 10;
            assert_int_equal(b->ray(f.self, &f.context, &ray, &hit, &count), TAHR_OK);
            assert_true(count == 0 || (hit.body != 0 && hit.normal.z < 0));
            solid += count;
        }
    }
    assert_true(solid > 100);
    tahr_ray ray = {v_make(7, 6, 5), v_make(0, 0, -10), 0xFFFFFFFFu, TAHR_NO_BODY};
    b->ray(f.self, &f.context, &ray, &hit, &count);
    assert_true(count == 1 && hit.body == 2 && fabs(hit.point.z - 1.3) < 1e-9 && fabs(hit.fraction - 0.37) < 1e-9);
    native_close(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_hit_fronts_and_slip_through_no_seam),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

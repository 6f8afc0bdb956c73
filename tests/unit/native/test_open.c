/* SPDX-License-Identifier: MIT
 * test_open.c: opening and closing worlds of the native backend: broken meshes, no memory, nothing in it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

static tahr_status open_broken(double *vertices, uint32_t vertex_count, uint32_t *indices, uint32_t triangles,
                               const char *expected)
{
    fixture f;
    fixture_init(&f);
    tahr_body_desc body = fixture_mesh(vertices, vertex_count, indices, triangles);
    tahr_status status = fixture_open(&f, &body, 1, NULL, 0);
    assert_null(f.self);
    assert_int_equal(f.bytes, 0);
    if (!strstr(f.message, expected)) fail_msg("message was '%s'", f.message);
    return status;
}

static void broken_geometry_is_named(void **state)
{
    (void)state;
    double v[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 2};
    uint32_t good[3] = {0, 1, 2}, far[3] = {0, 1, 9}, flat[6] = {0, 1, 1, 2, 2, 2};
    assert_int_equal(open_broken(v, 4, good, 0, "triangle_count is 0"), TAHR_E_GEOMETRY);
    assert_int_equal(open_broken(v, 4, far, 1, "index 9"), TAHR_E_GEOMETRY);
    assert_int_equal(open_broken(v, 4, flat, 2, "area"), TAHR_E_GEOMETRY);
    assert_int_equal(open_broken(NULL, 4, good, 1, "NULL"), TAHR_E_NULL);
    v[4] = NAN;
    assert_int_equal(open_broken(v, 4, good, 1, "vertex 1: y is"), TAHR_E_GEOMETRY);
    v[4] = 2e7;
    assert_int_equal(open_broken(v, 4, good, 1, "vertex 1: y is 2e+07"), TAHR_E_GEOMETRY);
}

static void every_failed_allocation_leaves_nothing(void **state)
{
    (void)state;
    static native_grid grid;
    tahr_body_desc bodies[NATIVE_HILLS];
    native_hills(&grid, bodies);
    for (size_t at = 1;; at++) {
        fixture f;
        fixture_init(&f);
        f.fail_at = at;
        tahr_status status = fixture_open(&f, bodies, NATIVE_HILLS, NULL, 0);
        if (status == TAHR_OK) {
            native_close(&f);
            if (f.asked >= at) continue; /* the exact copy of a tree is optional */
            assert_true(at > 20);
            return;
        }
        assert_int_equal(status, TAHR_E_MEMORY);
        assert_int_equal(f.bytes, 0);
    }
}

static void an_empty_world_is_free(void **state)
{
    (void)state;
    fixture f;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, NULL, 0, NULL, 1), TAHR_OK);
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.25, 0.25), v_make(9, 6, 3), v_make(0, 0, -4), 0.01);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    fixture_announce(&f, q.position, 5);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    native_close(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_geometry_is_named),
        cmocka_unit_test(every_failed_allocation_leaves_nothing),
        cmocka_unit_test(an_empty_world_is_free),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

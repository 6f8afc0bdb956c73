/* SPDX-License-Identifier: MIT
 * test_bodies.c: bodies of the native backend: moved ones, and those it refuses. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

static void moved_bodies_are_found_where_they_are(void **state)
{
    (void)state;
    fixture f;
    enum { MANY = 1000 };
    static tahr_body_desc bodies[MANY];
    for (uint32_t i = 0; i < MANY; i++) {
        bodies[i] = fixture_body(TAHR_BODY_SPHERE);
        bodies[i].radius = 0.5;
        bodies[i].flags = i % 2 ? TAHR_BODY_MOVABLE : 0;
        bodies[i].pose.position = v_make(3.0 * (i % 40), 3.0 * (i / 40), 0);
    }
    native_open(&f, bodies, MANY, 1);
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.25, 0.25), v_make(9, 6, 3), v_make(0, 0, -4), 0.01);
    fixture_announce(&f, q.position, 5);
    tahr_hit h = fixture_hit(&f, &q);
    assert_true(h.body == 83 && fabs(h.fraction - 2.24 / 4) < 1e-9);
    tahr_body_pose move = {83, 0, {v_make(9, 6, 1), {0, 0, 0, 1}}};
    const tahr_backend *b = tahr_backend_v1_native();
    assert_int_equal(b->place(f.self, &move, 1), TAHR_OK);
    h = fixture_hit(&f, &q);
    assert_true(h.body == 83 && fabs(h.fraction - 1.24 / 4) < 1e-9);
    move.pose.position.x = 500;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_OK);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    q.position.x = 500; /* far from everything that there was when the world was opened */
    h = fixture_hit(&f, &q);
    assert_true(h.body == 83 && fabs(h.fraction - 1.24 / 4) < 1e-9);
    move.body = 82;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_E_ARGUMENT);
    assert_non_null(strstr(f.message, "body 82: is not movable"));
    move.body = MANY;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_E_NOT_FOUND);
    move.body = 83;
    move.pose.position.x = NAN;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_E_ARGUMENT);
    native_close(&f);
}

static void broken_bodies_and_options_are_refused(void **state)
{
    const char *const named[] = {
        "radius is -1",        "half_height",       "pose.position",          "pose.orientation", "type is 7",
        "options.no_vicinity", "options.cache_tri", "options.cache_m",        "flags is 256",     "options.no_cache",
        "options.no_simd",     "options.no_fields", "options.no_capsule_ends"};
    (void)state;
    fixture f;
    for (int n = 0; n < 13; n++) {
        tahr_body_desc body = fixture_body(TAHR_BODY_CAPSULE);
        tahr_native_desc options = fixture_options();
        body.radius = 0.5;
        body.half_height = 1;
        if (n == 0) body.radius = -1;
        if (n == 1) body.half_height = 0.4;
        if (n == 2) body.pose.position.y = INFINITY;
        if (n == 3) body.pose.orientation.w = 2;
        if (n == 4) body.type = 7;
        if (n == 5) options.no_vicinity = 2;
        if (n == 6) options.cache_triangles = 5000;
        if (n == 7) options.cache_margin = NAN;
        if (n == 8) body.flags = TAHR_BODY_ONE_WAY << 1;
        if (n == 9) options.no_cache = 2;
        if (n == 10) options.no_simd = 2;
        if (n == 11) options.no_fields = 2;
        if (n == 12) options.no_capsule_ends = 2;
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &body, 1, &options, 0), TAHR_E_ARGUMENT);
        if (!strstr(f.message, named[n])) fail_msg("message %d was '%s'", n, f.message);
        assert_true(f.bytes == 0 && !f.self);
    }
    tahr_native_desc small = fixture_options();
    small.struct_size = 8;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, NULL, 0, &small, 0), TAHR_E_STRUCT_SIZE);
    assert_int_equal(f.bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moved_bodies_are_found_where_they_are),
        cmocka_unit_test(broken_bodies_and_options_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

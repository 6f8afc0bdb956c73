/* SPDX-License-Identifier: MIT
 * test_scene.c: the limits of poses and sizes of bodies, at their last accepted value; what is copied and what is
 * not. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_host.h"
#include "fake_world.h"
#include "scene.h"

static void poses_are_accepted_up_to_their_limits(void **unused)
{
    tahr_pose p = {{1e7, 0, 0}, {0, 0, 0, 1}};
    (void)unused;
    assert_null(tahr__bad_pose(&p, 0));
    p.position.x = nextafter(1e7, 1e8);
    assert_string_equal(tahr__bad_pose(&p, 0), "pose.position");
    p.position = fake_vec(1e300, 1e300, 1e300); /* its square is not finite */
    assert_string_equal(tahr__bad_pose(&p, 0), "pose.position");
    p.position = fake_vec(0, 0, 0);
    p.orientation.w = 0;
    assert_string_equal(tahr__bad_pose(&p, 0), "pose.orientation");
    assert_null(tahr__bad_pose(&p, 1)); /* zeroed: identity */
    p.orientation.w = 1 + 4e-7;         /* its square: 1 + 8e-7 */
    assert_null(tahr__bad_pose(&p, 0));
    p.orientation.w = 1 + 6e-7;
    assert_string_equal(tahr__bad_pose(&p, 0), "pose.orientation");
}

/* Reads one body; what the log then says, or NULL. */
static const char *read(tahr_body_desc body, fake_log *kept)
{
    fake_memory memory = {0};
    tahr_log log = fake_log_of(kept);
    tahr_host host = {.allocator = fake_allocator(&memory), .log = log};
    tahr_world_desc scene = {.struct_size = sizeof scene, .body_count = 1, .bodies = &body};
    tahr_body_desc *own = NULL;
    tahr_status status = tahr__bodies_read(&host, &log, &scene, &own);
    assert_null(own); /* of this size: nothing to copy */
    assert_true(scene.bodies == &body && memory.requests == 0);
    tahr__bodies_free(&host, own, 1);
    assert_int_equal(status<0, kept->count> 0);
    return kept->count > 0 ? kept->text : NULL;
}

static tahr_body_desc body_of(uint32_t type, double size)
{
    tahr_body_desc b;
    tahr_body_desc_init(&b, sizeof b, type);
    b.half_extents = fake_vec(size, size, size);
    b.radius = b.half_height = size;
    return b;
}

static void sizes_are_accepted_up_to_their_limits(void **unused)
{
    const double good[] = {1e-6, 1, 1e6}, bad[] = {0.9e-6, 1.1e6, NAN, -1};
    fake_log log;
    (void)unused;
    for (uint32_t type = TAHR_BODY_BOX; type <= TAHR_BODY_CAPSULE; type++) {
        for (int i = 0; i < 3; i++) {
            assert_null(read(body_of(type, good[i]), &log));
        }
        for (int i = 0; i < 4; i++) {
            assert_non_null(strstr(read(body_of(type, bad[i]), &log), "tahr_world_open: bodies[0]."));
        }
    }
}

/* The first field that is wrong, and no other. */
static void one_field_is_named(void **unused)
{
    fake_log log;
    (void)unused;
    tahr_body_desc b = body_of(TAHR_BODY_BOX, 1);
    b.half_extents.z = 0;
    assert_non_null(strstr(read(b, &log), "bodies[0].half_extents.z "));
    b = body_of(TAHR_BODY_CAPSULE, 1);
    b.half_height = 0.5; /* below the radius */
    assert_non_null(strstr(read(b, &log), "bodies[0].half_height "));
    b.radius = -1;
    assert_non_null(strstr(read(b, &log), "bodies[0].radius "));
    b.walkable_angle = INFINITY;
    assert_non_null(strstr(read(b, &log), "bodies[0].walkable_angle "));
    b.walkable_rule = 9;
    assert_non_null(strstr(read(b, &log), "bodies[0].walkable_rule "));
    b = body_of(TAHR_BODY_MESH, 1);
    assert_non_null(strstr(read(b, &log), "bodies[0].vertices "));
    b.vertices = &b.radius;
    assert_non_null(strstr(read(b, &log), "bodies[0].indices "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(poses_are_accepted_up_to_their_limits),
                                       cmocka_unit_test(sizes_are_accepted_up_to_their_limits),
                                       cmocka_unit_test(one_field_is_named)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

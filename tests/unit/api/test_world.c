/* SPDX-License-Identifier: MIT
 * test_world.c: opening, placing and closing worlds; wrong descriptions are refused by name. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_backend.h"
#include "fake_host.h"

#include <tahr/native.h>

static const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const uint32_t indices[] = {0, 1, 2};

static tahr_body_desc mesh(void)
{
    tahr_body_desc b;
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_MESH), TAHR_OK);
    b.vertices = vertices;
    b.indices = indices;
    b.vertex_count = 3;
    b.triangle_count = 1;
    return b;
}

/* A backend that holds no shapes but capsules, and a world of these bodies on it. */
static void describe(tahr_world_desc *desc, fake_backend *backend, const tahr_body_desc *bodies, uint32_t count)
{
    fake_backend_init(backend, TAHR_CAP_CAPSULE);
    assert_int_equal(tahr_world_desc_init(desc, sizeof *desc), TAHR_OK);
    desc->options = backend;
    desc->bodies = bodies;
    desc->body_count = count;
}

static void descriptions_start_zero_and_check_their_size(void **unused)
{
    tahr_world_desc d;
    tahr_body_desc b;
    (void)unused;
    assert_int_equal(tahr_world_desc_init(NULL, sizeof d), TAHR_E_NULL);
    assert_int_equal(tahr_world_desc_init(&d, sizeof d - 1), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_body_desc_init(NULL, sizeof b, TAHR_BODY_BOX), TAHR_E_NULL);
    assert_int_equal(tahr_body_desc_init(&b, sizeof b - 1, TAHR_BODY_BOX), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_world_desc_init(&d, sizeof d), TAHR_OK);
    assert_true(d.struct_size == sizeof d && d.body_count == 0 && !d.bodies && !d.allocator && !d.log && !d.options);
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_BOX), TAHR_OK);
    assert_true(b.type == TAHR_BODY_BOX && b.mask == 0xFFFFFFFFu && b.pose.orientation.w == 1);
}

/* Opens a world of one body: the status, and the body and field in the message. */
static void expect_body(tahr_body_desc body, tahr_status status, const char *field)
{
    fake_backend backend;
    fake_log log;
    tahr_log l = fake_log_of(&log);
    tahr_world_desc desc;
    tahr_world *world = (tahr_world *)&log;
    describe(&desc, &backend, &body, 1);
    desc.log = &l;
    tahr_status got = tahr_world_open(&backend.table, &desc, &world);
    if (got != status) {
        fail_msg("%s: %s instead of %s", field, tahr_status_name(got), tahr_status_name(status));
    }
    assert_true(world == (tahr_world *)&log);
    assert_int_equal(backend.opened, 0);
    assert_non_null(strstr(log.text, "bodies[0]"));
    assert_non_null(strstr(log.text, field));
}

static void bad_bodies_are_named(void **unused)
{
    const double bad[] = {NAN, INFINITY, -1, 0, 1e9};
    tahr_body_desc b = mesh();
    (void)unused;
    b.vertices = NULL;
    expect_body(b, TAHR_E_ARGUMENT, "vertices");
    b = mesh(), b.indices = NULL;
    expect_body(b, TAHR_E_ARGUMENT, "indices");
    b = mesh(), b.triangle_count = 0;
    expect_body(b, TAHR_E_GEOMETRY, "triangles");
    b = mesh(), b.type = 11;
    expect_body(b, TAHR_E_ARGUMENT, "type");
    b = mesh(), b.flags = 1u << 10;
    expect_body(b, TAHR_E_ARGUMENT, "flags");
    b = mesh(), b.walkable_rule = 4;
    expect_body(b, TAHR_E_ARGUMENT, "walkable_rule");
    b = mesh(), b.walkable_angle = NAN;
    expect_body(b, TAHR_E_ARGUMENT, "walkable_angle");
    b = mesh(), b.pose.position.y = NAN;
    expect_body(b, TAHR_E_ARGUMENT, "pose.position");
    b = mesh(), b.pose.position.y = 2e7;
    expect_body(b, TAHR_E_ARGUMENT, "pose.position");
    b = mesh(), b.pose.orientation.x = 1;
    expect_body(b, TAHR_E_ARGUMENT, "pose.orientation");
    b = mesh(), b.pose.orientation.w = NAN;
    expect_body(b, TAHR_E_ARGUMENT, "pose.orientation");
    b = mesh(), b.struct_size = 4;
    expect_body(b, TAHR_E_STRUCT_SIZE, "bodies[0]");
    for (int i = 0; i < 5; i++) {
        tahr_body_desc_init(&b, sizeof b, TAHR_BODY_BOX);
        b.half_extents = fake_vec(1, bad[i], 1);
        expect_body(b, TAHR_E_ARGUMENT, "half_extents.y");
        tahr_body_desc_init(&b, sizeof b, TAHR_BODY_SPHERE);
        b.radius = bad[i];
        expect_body(b, TAHR_E_ARGUMENT, "radius");
        tahr_body_desc_init(&b, sizeof b, TAHR_BODY_CAPSULE);
        b.radius = 1;
        b.half_height = bad[i] == 1e9 ? 0.5 : bad[i];
        expect_body(b, TAHR_E_ARGUMENT, "half_height");
    }
}

static void open_checks_backend_and_description(void **unused)
{
    fake_backend b;
    tahr_world_desc desc;
    tahr_world *world = NULL;
    fake_log log;
    tahr_log l = fake_log_of(&log);
    (void)unused;
    describe(&desc, &b, NULL, 0);
    desc.log = &l;
    const tahr_backend table = b.table;
    assert_int_equal(tahr_world_open(NULL, &desc, &world), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open: backend is NULL");
    assert_int_equal(tahr_world_open(&b.table, NULL, &world), TAHR_E_NULL);
    assert_int_equal(tahr_world_open(&b.table, &desc, NULL), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open: world is NULL");
    desc.struct_size = 8; /* where the log would be is not known */
    log.count = 0;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_STRUCT_SIZE);
    assert_int_equal(log.count, 0);
    desc.struct_size = sizeof desc;
    desc.body_count = 3;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_NULL);
    assert_non_null(strstr(log.text, "desc.bodies is NULL"));
    desc.body_count = 0;
    b.table.struct_size = 8;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_STRUCT_SIZE);
    b.table = table, b.table.abi_minor = 99;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_ABI);
    b.table = table, b.table.abi_major = 3;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_ABI);
    b.table = table, b.table.sweep = NULL;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open: backend.sweep is NULL, expected a function");
    b.table = table, b.table.name = NULL;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open: backend.name is NULL, expected a text");
    tahr_allocator broken = {NULL, NULL, NULL};
    b.table = table, desc.allocator = &broken;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_NULL);
    desc.allocator = NULL;
    b.open_answer = TAHR_E_GEOMETRY;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_E_GEOMETRY);
    assert_string_equal(log.text, "tahr_world_open: backend fake: a mesh or shape is malformed"); /* it said nothing */
    assert_null(world);
    assert_int_equal(b.closed, 0);
    b.open_answer = TAHR_OK;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_OK);
    assert_string_equal(tahr_world_backend_name(world), "fake");
    tahr_world_close(world);
    assert_int_equal(b.closed, 1);
    tahr_world_close(NULL);
}

/* Two bodies behind the fake backend, a movable one and one with these flags, and poses for them. */
static tahr_world *open_two(fake_backend *b, fake_log *log, uint32_t flags, tahr_body_pose poses[2])
{
    tahr_body_desc bodies[2] = {mesh(), mesh()};
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_log l = fake_log_of(log);
    bodies[0].flags = TAHR_BODY_MOVABLE;
    bodies[1].flags = flags;
    describe(&desc, b, bodies, 2);
    desc.log = &l;
    assert_int_equal(tahr_world_open(&b->table, &desc, &world), TAHR_OK);
    memset(poses, 0, 2 * sizeof poses[0]);
    poses[0].pose.orientation.w = poses[1].pose.orientation.w = 1;
    poses[1].body = 1;
    return world;
}

static void set_checks_every_pose_before_it_moves_one(void **unused)
{
    fake_backend b;
    fake_log log;
    tahr_body_pose poses[2];
    (void)unused;
    tahr_world *world = open_two(&b, &log, TAHR_BODY_MOVABLE, poses);
    uint64_t revision = tahr_world_revision(world);
    assert_int_equal(tahr_world_set(NULL, poses, 2), TAHR_E_NULL);
    assert_int_equal(tahr_world_set(world, NULL, 2), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_set: poses is NULL, but count is not 0");
    assert_int_equal(tahr_world_set(world, NULL, 0), TAHR_OK);
    poses[1].body = 2;
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_E_NOT_FOUND);
    assert_string_equal(log.text, "tahr_world_set: poses[1].body is 2, no such body");
    poses[1].body = 1, poses[1].flags = 1;
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_E_ARGUMENT);
    assert_non_null(strstr(log.text, "poses[1].flags"));
    poses[1].flags = 0, poses[1].pose.position.x = NAN;
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_E_ARGUMENT);
    assert_non_null(strstr(log.text, "poses[1].pose.position"));
    poses[1].pose.position.x = 0, poses[1].pose.orientation.w = 0;
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_E_ARGUMENT);
    assert_non_null(strstr(log.text, "poses[1].pose.orientation"));
    assert_int_equal(b.placed, 0);
    assert_int_equal(tahr_world_revision(world), revision);
    poses[1].pose.orientation.w = 1;
    poses[1].pose.position.x = 3;
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_OK);
    assert_int_equal(b.placed, 2);
    assert_int_not_equal(tahr_world_revision(world), revision);
    poses[1].pose.position.x = 0; /* a rollback puts bodies back, and with them the revision */
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_OK);
    assert_int_equal(tahr_world_revision(world), revision);
    tahr_world_close(world);
}

/* Whatever the backend: here one that would place anything. */
static void bodies_that_are_not_movable_are_named(void **unused)
{
    fake_backend b;
    fake_log log;
    tahr_body_pose poses[2];
    (void)unused;
    tahr_world *world = open_two(&b, &log, 0, poses);
    uint64_t revision = tahr_world_revision(world);
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_E_ARGUMENT);
    assert_string_equal(log.text, "tahr_world_set: poses[1].body is 1, a body without TAHR_BODY_MOVABLE");
    assert_int_equal(b.placed, 0);
    assert_int_equal(tahr_world_revision(world), revision);
    assert_int_equal(tahr_world_set(world, poses, 1), TAHR_OK);
    tahr_world_close(world);
}

/* abi.h promises it, and a backend does not know it. */
static void messages_of_backends_name_the_function(void **unused)
{
    const double broken[] = {0, 0, 0, 1, NAN, 0, 0, 1, 0};
    fake_log log;
    tahr_log l = fake_log_of(&log);
    tahr_body_desc b = mesh();
    tahr_native_desc options = {.struct_size = sizeof options, .no_fields = 2};
    tahr_world_desc desc;
    tahr_world *world = NULL;
    fake_memory memory = {0};
    tahr_allocator allocator = fake_allocator(&memory);
    (void)unused;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &b;
    desc.body_count = 1;
    desc.log = &l;
    desc.options = &options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_E_ARGUMENT);
    assert_string_equal(log.text, "tahr_world_open: options.no_fields is neither 0 nor 1");
    desc.options = NULL;
    b.vertices = broken;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_E_GEOMETRY);
    assert_non_null(strstr(log.text, "tahr_world_open: body 0: vertex 1: y is "));
    b.vertices = vertices;
    desc.allocator = &allocator;
    for (memory.fail_at = 1; world == NULL; memory.fail_at++, memory.requests = 0) {
        log.count = 0;
        if (tahr_world_open(tahr_backend_v1_native(), &desc, &world) == TAHR_OK) {
            break;
        }
        assert_int_equal(log.count, 1);
        assert_non_null(strstr(log.text, "tahr_world_open: "));
        assert_null(world);
    }
    assert_true(memory.fail_at > 5);
    tahr_world_close(world);
    assert_int_equal(memory.live_blocks, 0);
}

static void fixed_bodies_cannot_be_placed(void **unused)
{
    fake_backend b;
    tahr_body_desc body = mesh();
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_body_pose pose;
    (void)unused;
    describe(&desc, &b, &body, 1);
    b.table.place = NULL;
    assert_int_equal(tahr_world_open(&b.table, &desc, &world), TAHR_OK);
    memset(&pose, 0, sizeof pose);
    pose.pose.orientation.w = 1;
    assert_int_equal(tahr_world_set(world, &pose, 1), TAHR_E_UNSUPPORTED);
    tahr_world_close(world);
}

static void callbacks_are_checked(void **unused)
{
    fake_world fake;
    tahr_callbacks c = fake_callbacks(&fake);
    tahr_world *world = NULL;
    (void)unused;
    fake_world_init(&fake);
    fake_log log;
    tahr_log l = fake_log_of(&log);
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.log = &l;
    assert_int_equal(tahr_world_open_callbacks(NULL, NULL, &world), TAHR_E_NULL); /* without a log: no crash */
    assert_int_equal(tahr_world_open_callbacks(NULL, &desc, &world), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open_callbacks: callbacks is NULL");
    assert_int_equal(tahr_world_open_callbacks(&c, &desc, NULL), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open_callbacks: world is NULL");
    c.sweep = NULL;
    assert_int_equal(tahr_world_open_callbacks(&c, &desc, &world), TAHR_E_NULL);
    assert_string_equal(log.text, "tahr_world_open_callbacks: callbacks.sweep is NULL");
    c.sweep = fake_sweep, c.flags = 4;
    assert_int_equal(tahr_world_open_callbacks(&c, &desc, &world), TAHR_E_UNSUPPORTED);
    assert_non_null(strstr(log.text, "callbacks.flags"));
    c.flags = 0, c.struct_size = 4;
    assert_int_equal(tahr_world_open_callbacks(&c, &desc, &world), TAHR_E_STRUCT_SIZE);
    assert_non_null(strstr(log.text, "callbacks: "));
    assert_null(world);
    c.struct_size = sizeof c;
    assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
    assert_string_equal(tahr_world_backend_name(world), "callbacks");
    uint64_t revision = tahr_world_revision(world);
    assert_int_equal(tahr_world_touch(world), TAHR_OK);
    assert_int_equal(tahr_world_revision(world), revision + 1);
    assert_int_equal(tahr_world_touch(NULL), TAHR_E_NULL);
    assert_int_equal(tahr_world_revision(NULL), 0);
    tahr_world_close(world);
}

/* What a program compiled with a newer header hands over: longer elements, one after the other. */
typedef struct newer_body {
    tahr_body_desc known;
    double more[3];
} newer_body;

enum { NEWER = 3 };

static void describe_newer(tahr_world_desc *desc, newer_body bodies[NEWER])
{
    memset(bodies, 0, NEWER * sizeof bodies[0]);
    for (int i = 0; i < NEWER; i++) { /* a row of boxes along x, surfaces 10, 11, 12 */
        assert_int_equal(tahr_body_desc_init(&bodies[i].known, sizeof bodies[i], TAHR_BODY_BOX), TAHR_OK);
        bodies[i].known.half_extents = fake_vec(1, 1, 1);
        bodies[i].known.pose.position = fake_vec(10.0 * i, 0, 0);
        bodies[i].known.surface = 10 + (uint32_t)i;
    }
    tahr_world_desc_init(desc, sizeof *desc);
    desc->bodies = &bodies[0].known;
    desc->body_count = NEWER;
}

static void an_array_of_longer_bodies_opens_when_what_is_new_is_zero(void **unused)
{
    newer_body bodies[NEWER];
    tahr_world_desc desc;
    fake_memory memory = {0};
    (void)unused;
    tahr_allocator allocator = fake_allocator(&memory);
    describe_newer(&desc, bodies);
    desc.allocator = &allocator;
    for (uint32_t count = 1; count <= NEWER; count++) {
        tahr_world *world = NULL;
        desc.body_count = count;
        assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
        assert_int_equal(tahr_world_memory(world), memory.live_bytes);
        for (uint32_t i = 0; i < NEWER; i++) {
            tahr_ray ray = {.origin = {10.0 * i, 0, 5}, .motion = {0, 0, -8}, .mask = 1, .ignore_body = TAHR_NO_BODY};
            tahr_hit hit;
            uint32_t hits = 9;
            assert_int_equal(tahr_world_ray(world, &ray, &hit, &hits), TAHR_OK);
            assert_int_equal(hits, i < count);
            assert_true(i >= count || (hit.body == i && hit.surface == 10 + i));
        }
        tahr_world_close(world);
        assert_int_equal(memory.live_blocks, 0);
    }
}

static void an_array_of_longer_bodies_is_unsupported_when_something_new_is_asked_for(void **unused)
{
    newer_body bodies[NEWER];
    tahr_world_desc desc;
    fake_memory memory = {0};
    fake_log log;
    (void)unused;
    tahr_allocator allocator = fake_allocator(&memory);
    tahr_log l = fake_log_of(&log);
    for (int i = 0; i < NEWER; i++) {
        char name[32];
        tahr_world *world = NULL;
        describe_newer(&desc, bodies);
        desc.allocator = &allocator;
        desc.log = &l;
        bodies[i].more[2] = 1;
        assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_E_UNSUPPORTED);
        snprintf(name, sizeof name, "bodies[%d]", i);
        assert_non_null(strstr(log.text, name));
        assert_null(world);
        assert_int_equal(memory.live_blocks, 0);
        describe_newer(&desc, bodies); /* a bad field of a longer body is named like any other */
        desc.allocator = &allocator;
        desc.log = &l;
        bodies[i].known.half_extents.y = NAN;
        assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_E_ARGUMENT);
        assert_non_null(strstr(log.text, name));
        assert_int_equal(memory.live_blocks, 0);
    }
    describe_newer(&desc, bodies); /* elements of two sizes are no array */
    bodies[1].known.struct_size = sizeof(tahr_body_desc);
    tahr_world *world = NULL;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_E_STRUCT_SIZE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(descriptions_start_zero_and_check_their_size),
        cmocka_unit_test(bad_bodies_are_named),
        cmocka_unit_test(open_checks_backend_and_description),
        cmocka_unit_test(set_checks_every_pose_before_it_moves_one),
        cmocka_unit_test(bodies_that_are_not_movable_are_named),
        cmocka_unit_test(messages_of_backends_name_the_function),
        cmocka_unit_test(fixed_bodies_cannot_be_placed),
        cmocka_unit_test(an_array_of_longer_bodies_opens_when_what_is_new_is_zero),
        cmocka_unit_test(an_array_of_longer_bodies_is_unsupported_when_something_new_is_asked_for),
        cmocka_unit_test(callbacks_are_checked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

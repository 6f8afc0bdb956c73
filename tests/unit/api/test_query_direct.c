/* SPDX-License-Identifier: MIT
 * test_query_direct.c: the three questions that a program may ask a world itself: answers and refusals. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_fixture.h"
#include "fake_backend.h"
#include "rig.h"

/* The capsule of the preset, two metres over the plane, four metres down. */
static tahr_sweep good_sweep(void)
{
    return fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), fake_vec(0, 0, 2), fake_vec(0, 0, -4), 0.01);
}

/* Refused with a message that names the field. */
static void expect_refused(rig *r, const tahr_sweep *q, const char *field)
{
    tahr_hit hits[2], kept[2];
    uint32_t count = 99;
    memset(hits, 0x55, sizeof hits);
    memcpy(kept, hits, sizeof hits);
    r->log.text[0] = 0;
    assert_int_equal(tahr_world_sweep(r->world, q, hits, 2, &count), TAHR_E_ARGUMENT);
    if (!strstr(r->log.text, field)) {
        fail_msg("the message \"%s\" does not name %s", r->log.text, field);
    }
    assert_memory_equal(hits, kept, sizeof hits);
    assert_int_equal(count, 99);
}

static void direct_sweep_answers_and_checks(void **unused)
{
    fake_backend b;
    rig r;
    tahr_hit hits[2], kept[2];
    uint32_t count = 99;
    tahr_sweep q = good_sweep();
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    assert_int_equal(tahr_world_sweep(r.world, &q, hits, 2, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hits[0].fraction, (2 - 0.91) / 4, 1e-15);
    assert_near(hits[0].distance, 0.01, 1e-15);
    memset(hits, 0x55, sizeof hits);
    memcpy(kept, hits, sizeof hits);
    count = 99;
    assert_int_equal(tahr_world_sweep(NULL, &q, hits, 2, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_sweep(r.world, &q, hits, 0, &count), TAHR_E_ARGUMENT);
    const struct {
        const char *name;
        size_t offset;
        double value;
    } bad[] = {{"position", offsetof(tahr_sweep, position.y), NAN},
               {"up", offsetof(tahr_sweep, up.z), 1.1},
               {"orientation", offsetof(tahr_sweep, orientation.w), INFINITY},
               {"motion", offsetof(tahr_sweep, motion.x), NAN},
               {"margin", offsetof(tahr_sweep, margin), -1e-9},
               {"margin", offsetof(tahr_sweep, margin), NAN},
               {"shape.radius", offsetof(tahr_sweep, shape.radius), -1},
               {"shape.half_height", offsetof(tahr_sweep, shape.half_height), 0.1},
               {"motion", offsetof(tahr_sweep, motion.z), INFINITY},
               {"position", offsetof(tahr_sweep, position.x), 1e9}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        q = good_sweep();
        memcpy((char *)&q + bad[i].offset, &bad[i].value, sizeof(double));
        expect_refused(&r, &q, bad[i].name);
    }
    q = good_sweep();
    q.flags = 1u << 30;
    expect_refused(&r, &q, "flags");
    q = good_sweep();
    q.reserved = 3;
    expect_refused(&r, &q, "reserved");
    q = good_sweep();
    q.shape.hull = 3;
    expect_refused(&r, &q, "shape.hull");
    assert_memory_equal(hits, kept, sizeof hits);
    assert_int_equal(count, 99);
    rig_close(&r);
}

/* Unit, but their z axis is not up: tilted, on its head, and upright under another up. */
static void a_box_whose_z_axis_is_not_up_is_refused(void **unused)
{
    const tahr_quat tilted[] = {{0.6, 0, 0, 0.8}, {1, 0, 0, 0}, {0, 0.01, 0, 0.99994999874993749}};
    fake_backend b;
    rig r;
    tahr_hit hit;
    tahr_contact contact;
    uint32_t count;
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    tahr_sweep q = good_sweep(), round = q;
    q.shape = fixture_shape(TAHR_SHAPE_BOX, 0.3, 0.9);
    q.shape.half_y = 0.2;
    tahr_contact_query near = fixture_contacts(q.shape, q.position, 0);
    for (size_t i = 0; i < sizeof tilted / sizeof tilted[0]; i++) {
        q.orientation = near.orientation = tilted[i];
        r.log.text[0] = 0;
        assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
        assert_non_null(strstr(r.log.text, "orientation"));
        r.log.text[0] = 0;
        assert_int_equal(tahr_world_contacts(r.world, &near, &contact, 1, &count), TAHR_E_ARGUMENT);
        assert_non_null(strstr(r.log.text, "orientation"));
        round.orientation = tilted[i]; /* means nothing to a capsule */
        assert_int_equal(tahr_world_sweep(r.world, &round, &hit, 1, &count), TAHR_OK);
    }
    q.orientation = near.orientation = (tahr_quat){0, 0, 0.6, 0.8}; /* turned about up */
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(tahr_world_contacts(r.world, &near, &contact, 1, &count), TAHR_OK);
    q.up = near.up = fake_vec(1, 0, 0);
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_world_contacts(r.world, &near, &contact, 1, &count), TAHR_E_ARGUMENT);
    rig_close(&r);
}

static void null_arguments_are_named(void **unused)
{
    fake_backend b;
    rig r;
    tahr_hit hit;
    tahr_contact contact;
    uint32_t count;
    tahr_sweep q = good_sweep();
    tahr_contact_query near = fixture_contacts(q.shape, q.position, 0);
    tahr_ray ray = {.motion = {0, 0, -1}, .mask = 1, .ignore_body = TAHR_NO_BODY};
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    assert_int_equal(tahr_world_sweep(r.world, NULL, &hit, 1, &count), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_sweep: query is NULL");
    assert_int_equal(tahr_world_sweep(r.world, &q, NULL, 1, &count), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_sweep: hits is NULL");
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, NULL), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_sweep: count is NULL");
    assert_int_equal(tahr_world_contacts(r.world, NULL, &contact, 1, &count), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_contacts: query is NULL");
    assert_int_equal(tahr_world_contacts(r.world, &near, NULL, 1, &count), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_contacts: contacts is NULL");
    assert_int_equal(tahr_world_contacts(r.world, &near, &contact, 1, NULL), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_contacts: count is NULL");
    assert_int_equal(tahr_world_ray(r.world, NULL, &hit, &count), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_ray: query is NULL");
    assert_int_equal(tahr_world_ray(r.world, &ray, NULL, &count), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_ray: hit is NULL");
    assert_int_equal(tahr_world_ray(r.world, &ray, &hit, NULL), TAHR_E_NULL);
    assert_string_equal(r.log.text, "tahr_world_ray: count is NULL");
    ray.origin.y = NAN;
    assert_int_equal(tahr_world_ray(r.world, &ray, &hit, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_ray: origin is"));
    ray.origin.y = 0, ray.motion.x = INFINITY;
    assert_int_equal(tahr_world_ray(r.world, &ray, &hit, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_ray: motion is"));
    rig_close(&r);
}

static void direct_sweep_says_unknown_where_the_backend_gave_up(void **unused)
{
    fake_backend b;
    rig r;
    tahr_hit hit;
    uint32_t count = 0;
    tahr_sweep q = good_sweep();
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    fake_add_plane(&b.world, fake_vec(-1, 0, 0), -3);
    b.unknown = UNKNOWN_ALONE;
    b.unknown_body = 1;
    q.motion = fake_vec(4, 0, 0);
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_UNKNOWN);
    assert_int_equal(count, 1);
    assert_true(hit.unknown);
    assert_near(hit.fraction, (3 - 0.36) / 4, 1e-15);
    b.unknown = UNKNOWN_GARBAGE; /* nothing else of it was known: what is handed on is the wall that a step would see */
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_UNKNOWN);
    assert_true(hit.unknown && hit.normal.x == -1 && hit.surface_normal.x == -1 && hit.depth == 0);
    assert_true(hit.distance == q.margin && hit.walkable_rule == TAHR_WALKABLE_NEVER && hit.walkable_angle == 0);
    assert_near(hit.point.x, q.position.x + 3 - 0.36, 1e-12);
    rig_close(&r);
}

static void direct_sweep_leaves_outputs_untouched_when_the_backend_lies(void **unused)
{
    fake_backend b;
    rig r;
    tahr_hit hits[1], kept[1];
    uint32_t count = 99;
    tahr_sweep q = good_sweep();
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    for (int lie = 1; lie < LIES; lie++) {
        b.lie = lie;
        memset(hits, 0x55, sizeof hits);
        memcpy(kept, hits, sizeof hits);
        assert_int_equal(tahr_world_sweep(r.world, &q, hits, 1, &count), TAHR_E_BACKEND);
        assert_int_equal(count, 99);
        assert_memory_equal(hits, kept, sizeof hits);
    }
    rig_close(&r);
}

/* For a backend without the margin the shape is inflated: what is within the margin is then an overlap to it. */
static void without_margin_too_what_is_left_does_not_block(void **unused)
{
    fake_backend b;
    rig r;
    tahr_hit hit;
    uint32_t count = 0;
    tahr_sweep q = good_sweep();
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL & ~(uint32_t)TAHR_CAP_MARGIN);
    b.keeps_overlaps = 1;
    q.position.z = 0.905;
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_true(count == 1 && hit.blocking && !hit.start_overlap && hit.fraction == 0);
    assert_near(hit.distance, 0.005, 1e-12);
    q.motion = fake_vec(1, 0, 0.1);
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_true(count == 0 || !hit.blocking);
    rig_close(&r);
}

static void direct_contacts_answer_and_check(void **unused)
{
    fake_backend b;
    rig r;
    tahr_contact out[4], kept[4];
    uint32_t count = 99;
    tahr_contact_query q = fixture_contacts(good_sweep().shape, fake_vec(0, 0, 0.895), 0.01);
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    fake_add_plane(&b.world, fake_vec(-1, 0, 0), -0.35);
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, &count), TAHR_OK);
    assert_int_equal(count, 2);
    assert_near(out[0].distance, -0.005, 1e-15);
    assert_near(out[1].distance, 0, 1e-15);
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 1, &count), TAHR_TRUNCATED);
    assert_int_equal(count, 1);
    memset(out, 0x55, sizeof out);
    memcpy(kept, out, sizeof out);
    count = 99;
    assert_int_equal(tahr_world_contacts(NULL, &q, out, 4, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_contacts(r.world, NULL, out, 4, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_contacts(r.world, &q, NULL, 4, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, NULL), TAHR_E_NULL);
    q.margin = NAN;
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "margin"));
    q.margin = 0.01;
    q.shape.type = 0;
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "shape.type"));
    q.shape.type = TAHR_SHAPE_CAPSULE;
    q.reserved = 1;
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "reserved"));
    q.reserved = 0, q.flags = 1u << 30;
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "flags"));
    q.flags = 0;
    b.contact_lie = CONTACT_LIE_NORMAL;
    assert_int_equal(tahr_world_contacts(r.world, &q, out, 4, &count), TAHR_E_BACKEND);
    assert_int_equal(count, 99);
    assert_memory_equal(out, kept, sizeof out);
    rig_close(&r);
}

static void direct_ray_answers_and_checks(void **unused)
{
    fake_backend b;
    rig r;
    tahr_hit hit, kept;
    uint32_t count = 99;
    tahr_ray q = {.origin = {0, 0, 3}, .motion = {0, 0, -4}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    assert_int_equal(tahr_world_ray(r.world, &q, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hit.fraction, 0.75, 1e-15);
    memset(&hit, 0x55, sizeof hit);
    kept = hit;
    count = 99;
    assert_int_equal(tahr_world_ray(NULL, &q, &hit, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_ray(r.world, NULL, &hit, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_ray(r.world, &q, NULL, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_ray(r.world, &q, &hit, NULL), TAHR_E_NULL);
    q.motion.y = NAN;
    assert_int_equal(tahr_world_ray(r.world, &q, &hit, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "motion"));
    q.motion.y = 0;
    for (int lie = 1; lie < LIES; lie++) {
        b.lie = lie;
        assert_int_equal(tahr_world_ray(r.world, &q, &hit, &count), TAHR_E_BACKEND);
    }
    assert_int_equal(count, 99);
    assert_memory_equal(&hit, &kept, sizeof hit);
    rig_close(&r);
}

static void shapes_that_the_backend_lacks_are_unsupported(void **unused)
{
    fake_backend b;
    rig r;
    tahr_mover *mover = NULL;
    tahr_hit hit;
    uint32_t count;
    (void)unused;
    rig_open_backend(&r, &b, TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_CAPSULE);
    r.config.shape.type = TAHR_SHAPE_SPHERE;
    r.config.shape.half_height = 0.35;
    assert_int_equal(tahr_mover_create(r.world, &r.config, &mover), TAHR_E_UNSUPPORTED);
    assert_null(mover);
    tahr_sweep q = good_sweep();
    q.shape.type = TAHR_SHAPE_SPHERE;
    q.shape.half_height = 0.35;
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_E_UNSUPPORTED);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(direct_sweep_answers_and_checks),
                                       cmocka_unit_test(a_box_whose_z_axis_is_not_up_is_refused),
                                       cmocka_unit_test(null_arguments_are_named),
                                       cmocka_unit_test(direct_sweep_says_unknown_where_the_backend_gave_up),
                                       cmocka_unit_test(direct_sweep_leaves_outputs_untouched_when_the_backend_lies),
                                       cmocka_unit_test(without_margin_too_what_is_left_does_not_block),
                                       cmocka_unit_test(direct_contacts_answer_and_check),
                                       cmocka_unit_test(direct_ray_answers_and_checks),
                                       cmocka_unit_test(shapes_that_the_backend_lacks_are_unsupported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_callbacks.c: what the core derives for users who have only a sweep that says where. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_fixture.h"
#include "rig.h"

/* The least that a user may write: blocking, fraction, normal; or start_overlap, depth, normal. */
static tahr_status bare_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    tahr_hit full;
    memset(&full, 0, sizeof full);
    fake_sweep(user, q, &full);
    hit->blocking = full.blocking;
    hit->start_overlap = full.start_overlap;
    hit->fraction = full.fraction;
    hit->normal = full.normal;
    hit->depth = full.depth;
    return TAHR_OK;
}

static tahr_callbacks bare_callbacks(fake_world *w)
{
    tahr_callbacks c = {.struct_size = sizeof c, .user = w, .sweep = bare_sweep};
    return c;
}

static tahr_world *open_bare(fake_world *w)
{
    tahr_callbacks c = bare_callbacks(w);
    tahr_world *world = NULL;
    assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
    return world;
}

static void a_bare_sweep_walks_climbs_and_jumps_like_a_full_one(void **unused)
{
    fake_world w;
    rig full, bare;
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(2, -5, -1), fake_vec(40, 5, 0.3));
    tahr_callbacks callbacks = bare_callbacks(&w);
    rig_open(&full, &w, NULL, fake_vec(0, 0, 1));
    rig_open_callbacks(&bare, &callbacks, NULL, fake_vec(0, 0, 1));
    int jumps = 0;
    for (int i = 0; i < 150; i++) {
        full.input.move = bare.input.move = fake_vec(i > 20, 0, 0);
        full.input.jump = bare.input.jump = i == 100;
        rig_step(&full, 1.0 / 60);
        assert_int_equal(rig_step(&bare, 1.0 / 60), TAHR_OK);
        jumps += rig_event(&bare, TAHR_EVENT_JUMPED) != NULL;
        if (i < 30) { /* on the edge of the step the derived face is the contact's, and the way over it another one */
            assert_near(bare.state.position.x, full.state.position.x, 1e-9);
            assert_near(bare.state.position.z, full.state.position.z, 1e-9);
        }
        assert_true(fake_clearance(&w, &bare.config.shape, bare.state.position) > 0.01 - 1e-7);
    }
    assert_true(bare.state.position.z > 1.19);
    assert_int_equal(jumps, 1);
    rig_close(&bare);
    rig_close(&full);
}

static void missing_contacts_come_from_a_sweep_that_goes_nowhere(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    tahr_callbacks callbacks = bare_callbacks(&w);
    rig_open_callbacks(&r, &callbacks, NULL, fake_vec(0, 0, 0.8));
    assert_int_equal(rig_step(&r, 1.0 / 60), TAHR_OK);
    assert_near(fake_clearance(&w, &r.config.shape, r.state.position), 0.0125, 0.0025 + 1e-9);
    rig_close(&r);
}

static void missing_ray_is_a_thin_sphere(void **unused)
{
    fake_world w;
    tahr_ray q = {.origin = {0, 0, 2}, .motion = {0, 0, -4}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    tahr_hit hit;
    uint32_t count = 0;
    (void)unused;
    fake_world_flat(&w);
    tahr_world *world = open_bare(&w);
    assert_int_equal(tahr_world_ray(world, &q, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hit.fraction, 0.5, 1e-3);
    assert_near(hit.surface_normal.z, 1, 0);
    q.motion.z = 4;
    assert_int_equal(tahr_world_ray(world, &q, &hit, &count), TAHR_OK);
    assert_int_equal(count, 0);
    tahr_world_close(world);
}

static void derived_point_lies_on_the_surface(void **unused)
{
    fake_world w;
    tahr_sweep q =
        fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), fake_vec(1, 2, 2), fake_vec(0, 0, -4), 0.01);
    tahr_hit hit;
    uint32_t count = 0;
    (void)unused;
    fake_world_init(&w);
    fake_add_slope(&w, 30);
    tahr_world *world = open_bare(&w);
    assert_int_equal(tahr_world_sweep(world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hit.point.z, hit.point.x * tan(acos(-1.0) / 6), 1e-12);
    assert_near(hit.distance, 0.01, 0);
    tahr_world_close(world);
}

/* More surfaces than fit, and no surface_normal. */
static tahr_status crowded_contacts(void *user, const tahr_contact_query *q, tahr_contact *out, uint32_t capacity,
                                    uint32_t *count)
{
    (void)user, (void)q;
    for (uint32_t i = 0; i < capacity; i++) {
        out[i].distance = -0.1 + 0.01 * i;
        out[i].normal = fake_vec(0.6, 0, 0.8);
    }
    *count = capacity;
    return TAHR_TRUNCATED;
}

static void a_users_contacts_are_truncated_and_get_their_surface_normal(void **unused)
{
    fake_world w;
    tahr_callbacks c = {.struct_size = sizeof c, .user = &w, .sweep = bare_sweep, .contacts = crowded_contacts};
    tahr_world *world = NULL;
    tahr_contact_query q = fixture_contacts(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), fake_vec(0, 0, 0), 0);
    tahr_contact out[2];
    uint32_t count = 0;
    (void)unused;
    fake_world_init(&w);
    assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
    assert_int_equal(tahr_world_contacts(world, &q, out, 2, &count), TAHR_TRUNCATED);
    assert_int_equal(count, 2);
    for (int i = 0; i < 2; i++) {
        assert_memory_equal(&out[i].surface_normal, &out[i].normal, sizeof out[i].normal);
        assert_near(out[i].normal.z, 0.8, 1e-15);
    }
    tahr_world_close(world);
}

/* Everything is a sensor half-way. */
static tahr_status sensor_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    (void)user, (void)q;
    hit->sensor = 1;
    hit->fraction = 0.5;
    hit->normal = fake_vec(0, 0, 1);
    return TAHR_OK;
}

static tahr_status bare_ray(void *user, const tahr_ray *q, tahr_hit *hit)
{
    (void)q;
    hit->blocking = *(int *)user == 0;
    hit->sensor = *(int *)user == 1;
    hit->fraction = 0.375;
    hit->normal = fake_vec(0, 0.6, 0.8);
    return TAHR_OK;
}

static void a_sensor_is_no_hit_of_a_ray(void **unused)
{
    int sensor = 1;
    tahr_callbacks c = {.struct_size = sizeof c, .user = &sensor, .sweep = sensor_sweep};
    tahr_ray q = {.origin = {0, 0, 2}, .motion = {0, 0, -4}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    (void)unused;
    for (int own = 0; own < 2; own++) { /* derived from the sweep, and the user's own */
        tahr_world *world = NULL;
        tahr_hit hit;
        uint32_t count = 9;
        c.ray = own ? bare_ray : NULL;
        assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
        assert_int_equal(tahr_world_ray(world, &q, &hit, &count), TAHR_OK);
        assert_int_equal(count, 0);
        tahr_world_close(world);
    }
}

static void a_users_ray_without_point_gets_the_place_where_it_ends(void **unused)
{
    int sensor = 0;
    tahr_callbacks c = {.struct_size = sizeof c, .user = &sensor, .sweep = sensor_sweep, .ray = bare_ray};
    tahr_ray q = {.origin = {1, 2, 3}, .motion = {8, -16, 4}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    tahr_world *world = NULL;
    tahr_hit hit;
    uint32_t count = 0;
    (void)unused;
    assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
    assert_int_equal(tahr_world_ray(world, &q, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hit.point.x, 4, 0);
    assert_near(hit.point.y, -4, 0);
    assert_near(hit.point.z, 4.5, 0);
    assert_near(hit.surface_normal.y, hit.normal.y, 0);
    assert_near(hit.normal.z, 0.8, 1e-15);
    tahr_world_close(world);
}

static tahr_status refusing_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    (void)user, (void)q, (void)hit;
    return TAHR_E_MEMORY;
}

static void a_negative_status_ends_the_step(void **unused)
{
    tahr_callbacks c = {.struct_size = sizeof c, .sweep = refusing_sweep};
    rig r;
    (void)unused;
    rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 1));
    tahr_state before = r.state;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_E_BACKEND);
    assert_memory_equal(&r.state, &before, sizeof before);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_bare_sweep_walks_climbs_and_jumps_like_a_full_one),
                                       cmocka_unit_test(missing_contacts_come_from_a_sweep_that_goes_nowhere),
                                       cmocka_unit_test(missing_ray_is_a_thin_sphere),
                                       cmocka_unit_test(derived_point_lies_on_the_surface),
                                       cmocka_unit_test(a_users_contacts_are_truncated_and_get_their_surface_normal),
                                       cmocka_unit_test(a_sensor_is_no_hit_of_a_ray),
                                       cmocka_unit_test(a_users_ray_without_point_gets_the_place_where_it_ends),
                                       cmocka_unit_test(a_negative_status_ends_the_step)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

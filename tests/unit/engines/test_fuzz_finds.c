/* SPDX-License-Identifier: MIT
 * test_fuzz_finds.c: what the fuzzers found, each as the smallest case that failed. The inputs themselves are replayed
 * from fuzz/corpus. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "core.h"
#include "fake_backend.h"
#include "rig.h"
#include "trail.h"

#include <tahr/native.h>

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_BOX2D
#include "box2d_rig.h"

#include <tahr/box2d.h>
#endif

/* fuzz_liar, found_way_without_a_square: the event of a sensor left on a way of 1e-303 m had no time: 0 / 0. */
static void a_way_too_short_to_square_takes_no_time(void **state)
{
    static tahr__step step;
    static tahr__trail trail;
    (void)state;
    memset(&step, 0, sizeof step);
    memset(&trail, 0, sizeof trail);
    step.trail = &trail;
    step.state.position = trail.at = vec(5e-304, 0, 0);
    trail.count = 1;
    trail.legs[0].to = trail.at;
    tahr__trail_stamp(&step, 0.01, 0.02);
    assert_true(trail.legs[0].begin >= 0.01 && trail.legs[0].begin <= trail.legs[0].end);
    assert_true(trail.legs[0].end == 0.02);
    step.state.position = vec(2e-304, 0, 0);
    tahr__trail_cut(&step, vec(0, 0, 0), 0.5);
    assert_true(trail.legs[0].end >= 0.01 && trail.legs[0].end <= 0.02);
}

/* A hit that is undecided, of which nothing else is a number. */
static tahr_hit undecided(double fraction, int is_sensor)
{
    const tahr_vec3 none = {NAN, NAN, NAN};
    tahr_hit hit = {.unknown = 1, .fraction = fraction, .distance = NAN, .depth = NAN, .walkable_angle = NAN};
    hit.sensor = is_sensor != 0;
    hit.blocking = !is_sensor;
    hit.normal = hit.surface_normal = hit.point = none;
    return hit;
}

static tahr_status undecided_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                                   uint32_t capacity, uint32_t *count)
{
    (void)self, (void)context, (void)query;
    assert_true(capacity >= 2);
    hits[0] = undecided(0.25, 1);
    hits[1] = undecided(0.5, 0);
    *count = 2;
    return TAHR_OK;
}

static tahr_status undecided_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                                 uint32_t *count)
{
    (void)self, (void)context, (void)query;
    *hit = undecided(0.25, 0);
    *count = 1;
    return TAHR_OK;
}

/* A wall across the motion, here straight down, at that height. */
static void expect_wall_above(const tahr_hit *hit, double height)
{
    assert_true(hit->normal.x == 0 && hit->normal.y == 0 && hit->normal.z == 1);
    assert_true(hit->surface_normal.x == 0 && hit->surface_normal.y == 0 && hit->surface_normal.z == 1);
    assert_true(hit->point.x == 0 && hit->point.y == 0 && hit->point.z == height);
    assert_true(hit->depth == 0 && isfinite(hit->distance) && hit->walkable_angle == 0);
}

/* fuzz_liar, found_undecided_sensors_without_a_normal: of several undecided hits only the last was made a wall, and of
 * a ray none; the others had the backend's normals, which were no numbers. */
static void every_undecided_hit_is_handed_on_as_a_wall(void **state)
{
    fake_backend b;
    rig r;
    tahr_hit hits[4];
    uint32_t count = 0;
    tahr_sweep q = {.shape = {TAHR_SHAPE_CAPSULE, 0, 0.35, 0.9, 0, 0},
                    .position = {0, 0, 2},
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = {0, 0, -4},
                    .mask = 1,
                    .ignore_body = TAHR_NO_BODY};
    tahr_ray line = {.origin = {0, 0, 2}, .motion = {0, 0, -4}, .mask = 1, .ignore_body = TAHR_NO_BODY};
    (void)state;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    b.table.sweep = undecided_sweep;
    b.table.ray = undecided_ray;
    assert_int_equal(tahr_world_sweep(r.world, &q, hits, 4, &count), TAHR_UNKNOWN);
    assert_int_equal(count, 2);
    expect_wall_above(&hits[0], 1);
    expect_wall_above(&hits[1], 0);
    assert_int_equal(tahr_world_ray(r.world, &line, hits, &count), TAHR_OK);
    assert_int_equal(count, 1);
    expect_wall_above(&hits[0], 1);
    rig_close(&r);
}

#ifdef TAHR_HAVE_BOX2D
/* What a sphere of 0.4 m at (x, y) is in, of two of 8 m at (0, 0) and (1, 0): at least the one that it is deepest in,
 * of which the way out ends inside of the other one. */
static void expect_depth(uint32_t engine, double x, double y)
{
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_contact found[4];
    uint32_t count = 0;
    const tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engine};
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_SPHERE);
        bodies[i].radius = 8;
        bodies[i].pose.position.x = i;
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies, desc.body_count = 2, desc.options = &options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_box2d(), &desc, &world), TAHR_OK);
    const tahr_contact_query near = {.shape = {TAHR_SHAPE_SPHERE, 0, 0.4, 0.4, 0, 0},
                                     .position = {x, y, 0},
                                     .up = {0, 1, 0},
                                     .orientation = {-0.70710678118654757, 0, 0, 0.70710678118654757},
                                     .margin = 0.01,
                                     .mask = 1,
                                     .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_contacts(world, &near, found, 4, &count), TAHR_OK);
    assert_true(count >= 1);
    double nearest = fmin(sqrt(x * x + y * y), sqrt((x - 1) * (x - 1) + y * y));
    assert_true(fabs(found[0].distance - (nearest - 8.4)) < 1e-9);
    tahr_world_close(world);
}

/* fuzz_engines, found_in_two_round_bodies_and_in_neither: each of two round bodies was taken for a neighbour that fills
 * the place where the way out of the other one ends, and nothing was reported at all. */
static void who_is_inside_of_two_round_bodies_is_inside(void **state)
{
    uint32_t engines[2];
    (void)state;
    for (int count = box2d_engines(engines), i = 0; i < count; i++) {
        expect_depth(engines[i], 0.5, 0); /* as deep in both */
        expect_depth(engines[i], 0.25, 0);
        expect_depth(engines[i], 0.75, 0);
        expect_depth(engines[i], 0.5, 0.125);
    }
}
#endif

/* A box of 1 m; another beside it, whose one face is in the plane of the first one's end but for nanometres. */
static void expect_beside(const tahr_backend *backend)
{
    tahr_body_desc body;
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_BOX);
    body.half_extents = vec(0.5, 0.5, 0.5);
    body.pose.position = vec(-3.000000002, -4, -4);
    body.pose.orientation = (tahr_quat){0, sqrt(0.5), 0, sqrt(0.5)};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &body;
    desc.body_count = 1;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    for (int i = -100; i <= 100; i++) {
        tahr_contact_query near = {.shape = {.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.25},
                                   .position = vec(-3.2 + 1e-10 * i, -3.2, -4),
                                   .up = vec(0, 0, 1),
                                   .orientation = {0, 0, 0, 1},
                                   .margin = 0.1,
                                   .mask = 0xFFFFFFFFu,
                                   .ignore_body = TAHR_NO_BODY};
        tahr_contact found;
        uint32_t count = 0;
        assert_int_equal(tahr_world_contacts(world, &near, &found, 1, &count), TAHR_OK);
        assert_int_equal(count, 1);
        assert_true(fabs(found.distance - 0.05) < 1e-9 && found.normal.y > 1 - 1e-12);
    }
    tahr_world_close(world);
}

/* fuzz_engines, found_beside_the_end_of_a_box: of points that are equally near but for rounding one was found whose
 * direction is off by 1e-8, by which each triangle of the face took its neighbour for nearer: no contact was left. */
static void who_stands_beside_the_end_of_a_box_touches_it(void **state)
{
    (void)state;
    expect_beside(tahr_backend_v1_native());
#ifdef TAHR_HAVE_CCD
    expect_beside(tahr_backend_v1_ccd());
#endif
}

/* fuzz_steps, found_triangle_without_area: the fuzzer held it for a wire. It is not there, however it has none. */
static void a_triangle_without_area_is_not_there(void **state)
{
    const double corners[] = {-1, 0, 0, 1, 0, 0, 0, 0, 1e-11, 0, 0, 3e-9, 0, 0, -9, 1, 0, -9, 0, 1, -9};
    const uint32_t flat[] = {4, 5, 6, 0, 1, 1, 0, 1, 2}, thin[] = {0, 1, 3};
    (void)state;
    for (uint32_t there = 0; there < 2; there++) {
        rig r;
        tahr_hit hit;
        uint32_t count = 0, indices[12];
        tahr_sweep q = {.shape = {TAHR_SHAPE_CAPSULE, 0, 0.35, 0.9, 0, 0},
                        .position = {0, -2, 0},
                        .up = {0, 0, 1},
                        .orientation = {0, 0, 0, 1},
                        .motion = {0, 4, 0},
                        .margin = 0.01,
                        .mask = 1,
                        .ignore_body = TAHR_NO_BODY};
        tahr_body_desc body;
        tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
        memcpy(indices, flat, sizeof flat);
        memcpy(indices + 9, there ? thin : flat, sizeof thin);
        body.flags = TAHR_BODY_TWO_SIDED;
        body.vertices = corners, body.vertex_count = 7;
        body.indices = indices, body.triangle_count = 4;
        rig_open_bodies(&r, &body, 1, NULL, vec(0, -2, 3));
        assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
        assert_int_equal(count, there);
        rig_close(&r);
    }
}

/* fuzz_steps, found_flight_over_a_step: who flies (or swims) went the rest of a motion over a step in no time, and then
 * used that time for another one. */
static void who_flies_up_a_step_gains_no_way(void **state)
{
    (void)state;
    for (int i = 0; i < RIG_RATES; i++) {
        const double dt = 1 / rig_rates[i];
        int steps = 0;
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_box(&w, vec(3, -5, -1), vec(20, 5, 0.4));
        rig_open(&r, &w, NULL, vec(0, 0, 0.91));
        r.state.mode = TAHR_MODE_FLYING;
        r.input.move = vec(1, 0, 0);
        while (r.time < 1.5) {
            const double before = r.state.position.x;
            rig_step(&r, dt);
            assert_true(r.state.position.x - before <= r.config.fly_speed * dt + 1e-6);
            steps += rig_event(&r, TAHR_EVENT_STEPPED_UP) != NULL;
        }
        assert_true(steps >= 1);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_without_area_is_not_there),
        cmocka_unit_test(who_flies_up_a_step_gains_no_way),
        cmocka_unit_test(who_stands_beside_the_end_of_a_box_touches_it),
        cmocka_unit_test(a_way_too_short_to_square_takes_no_time),
        cmocka_unit_test(every_undecided_hit_is_handed_on_as_a_wall),
#ifdef TAHR_HAVE_BOX2D
        cmocka_unit_test(who_is_inside_of_two_round_bodies_is_inside),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

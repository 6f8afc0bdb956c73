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

/* fuzz_liar, found_undecided_sensors_without_a_normal: of several undecided hits only the last was made a wall, and of a
 * ray none; the others had the backend's normals, which were no numbers. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_way_too_short_to_square_takes_no_time),
        cmocka_unit_test(every_undecided_hit_is_handed_on_as_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

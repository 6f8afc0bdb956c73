/* SPDX-License-Identifier: MIT
 * test_template.c: the backend to copy answers like the native one, which shares nothing with it but the core
 * distance. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#include <tahr/tahr.h>

#include "dice.h"
#include "fake_host.h"

TAHR_API const tahr_backend *tahr_backend_v1_template(void);

enum { BODIES = 12, QUERIES = 3000 };

static tahr_vec3 at(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

static tahr_quat random_turn(oracle_random *dice)
{
    const tahr_vec3 axis = dice_direction(dice);
    const double half = oracle_uniform(dice, 0, 1.5);
    return (tahr_quat){axis.x * sin(half), axis.y * sin(half), axis.z * sin(half), cos(half)};
}

static void random_bodies(oracle_random *dice, tahr_body_desc bodies[BODIES])
{
    static const uint32_t types[] = {TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE};
    for (int i = 0; i < BODIES; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], types[i % 3]);
        bodies[i].pose.position = dice_vec(dice, -4, 4);
        bodies[i].pose.orientation = random_turn(dice);
        bodies[i].half_extents = dice_vec(dice, 0.2, 1.5);
        bodies[i].radius = oracle_uniform(dice, 0.1, 0.8);
        bodies[i].half_height = bodies[i].radius + oracle_uniform(dice, 0, 1);
        bodies[i].flags = TAHR_BODY_MOVABLE;
        bodies[i].surface = (uint32_t)i + 100;
    }
}

static tahr_world *open_on(const tahr_backend *backend, const void *options, const tahr_body_desc *bodies)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies, desc.body_count = BODIES, desc.options = options;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    return world;
}

static tahr_sweep random_sweep(oracle_random *dice)
{
    tahr_sweep q = {.shape = {TAHR_SHAPE_CAPSULE, 0, 0.3, 0.8, 0, 0},
                    .position = dice_vec(dice, -5, 5),
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = dice_vec(dice, -5, 5),
                    .margin = oracle_below(dice, 2) ? 0.01 : 0,
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    if (oracle_below(dice, 3) == 0) {
        q.shape = (tahr_shape){TAHR_SHAPE_SPHERE, 0, 0.4, 0.4, 0, 0};
    }
    return q;
}

/* Sizes are some metres: native is good to 1e-9 m, the tangents to 1e-10 m, and a grazing motion multiplies that
 * by the way over the gap; 1e-6 m is far above both and far below what a movement notices. */
static void sweeps_agree_with_the_native_backend(void **unused)
{
    oracle_random dice = {11};
    tahr_body_desc bodies[BODIES];
    int met = 0, overlaps = 0;
    (void)unused;
    random_bodies(&dice, bodies);
    tahr_world *mine = open_on(tahr_backend_v1_template(), NULL, bodies);
    tahr_world *native = open_on(tahr_backend_v1_native(), NULL, bodies);
    for (int i = 0; i < QUERIES; i++) {
        const tahr_sweep q = random_sweep(&dice);
        const double way = sqrt(q.motion.x * q.motion.x + q.motion.y * q.motion.y + q.motion.z * q.motion.z);
        tahr_hit a, b;
        uint32_t count_a, count_b;
        assert_true(tahr_world_sweep(mine, &q, &a, 1, &count_a) >= 0);
        assert_true(tahr_world_sweep(native, &q, &b, 1, &count_b) >= 0);
        assert_int_equal(count_a, count_b);
        if (count_a == 0) {
            continue;
        }
        assert_int_equal(a.start_overlap, b.start_overlap);
        assert_int_equal(a.body, b.body);
        assert_int_equal(a.surface, a.body + 100);
        assert_true(fabs(a.fraction - b.fraction) * way < 1e-6);
        assert_true(fabs(a.depth - b.depth) < 1e-6);
        met += !a.start_overlap;
        overlaps += (int)a.start_overlap;
    }
    assert_true(met > 300 && overlaps > 100);
    tahr_world_close(mine);
    tahr_world_close(native);
}

static void contacts_are_ordered_and_the_farthest_are_dropped(void **unused)
{
    oracle_random dice = {12};
    tahr_body_desc bodies[BODIES];
    tahr_contact all[BODIES], some[3];
    uint32_t count, few;
    int most = 0;
    (void)unused;
    random_bodies(&dice, bodies);
    tahr_world *world = open_on(tahr_backend_v1_template(), NULL, bodies);
    for (int i = 0; i < 200; i++) {
        const tahr_sweep s = random_sweep(&dice);
        const tahr_contact_query q = {s.shape, s.position, s.up, s.orientation, 2.0, s.mask, s.ignore_body, 0, 0};
        assert_int_equal(tahr_world_contacts(world, &q, all, BODIES, &count), TAHR_OK);
        for (uint32_t c = 1; c < count; c++) {
            assert_true(all[c - 1].distance <= all[c].distance);
        }
        tahr_status status = tahr_world_contacts(world, &q, some, 3, &few);
        assert_int_equal(status, count > 3 ? TAHR_TRUNCATED : TAHR_OK);
        assert_int_equal(few, count < 3 ? count : 3);
        assert_memory_equal(some, all, few * sizeof some[0]);
        most = (int)count > most ? (int)count : most;
    }
    assert_true(most > 3);
    tahr_world_close(world);
}

static void what_is_placed_is_met_where_it_is(void **unused)
{
    oracle_random dice = {13};
    tahr_body_desc bodies[BODIES];
    tahr_hit hit;
    uint32_t count;
    (void)unused;
    random_bodies(&dice, bodies);
    tahr_world *world = open_on(tahr_backend_v1_template(), NULL, bodies);
    const tahr_body_pose pose = {1, 0, {at(100, 0, 0), {0, 0, 0, 1}}};
    assert_int_equal(tahr_world_set(world, &pose, 1), TAHR_OK);
    const tahr_ray ray = {at(110, 0, 0), at(-20, 0, 0), 0xFFFFFFFFu, TAHR_NO_BODY};
    assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_int_equal(hit.body, 1);
    assert_true(fabs(hit.point.x - (100 + bodies[1].radius)) < 1e-9); /* a sphere */
    assert_true(hit.normal.x == 1);
    tahr_world_close(world);
}

static void what_it_does_not_claim_is_refused_by_name(void **unused)
{
    static const struct {
        uint32_t type, flags;
        const char *named, *lacks;
    } cases[] = {{TAHR_BODY_CYLINDER, 0, "is TAHR_BODY_CYLINDER, ", "TAHR_CAP_ROUND_SOLIDS"},
                 {TAHR_BODY_ELLIPSOID, 0, "is TAHR_BODY_ELLIPSOID, ", "TAHR_CAP_ROUND_SOLIDS"},
                 {TAHR_BODY_BOX, TAHR_BODY_SENSOR, "is TAHR_BODY_SENSOR, ", "TAHR_CAP_SENSORS"},
                 {TAHR_BODY_BOX, TAHR_BODY_FLUID, "is TAHR_BODY_FLUID, ", "TAHR_CAP_SENSORS"},
                 {TAHR_BODY_BOX, TAHR_BODY_ONE_WAY, "is TAHR_BODY_ONE_WAY, ", "TAHR_CAP_ONE_WAY"}};
    fake_log messages = {0};
    const tahr_log log = fake_log_of(&messages);
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_config config;
    (void)unused;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies, desc.body_count = 2, desc.log = &log;
    for (size_t i = 0; i <= sizeof cases / sizeof cases[0]; i++) {
        const int last = i == sizeof cases / sizeof cases[0];
        for (int b = 0; b < 2; b++) {
            tahr_body_desc_init(&bodies[b], sizeof bodies[b], b && !last ? cases[i].type : TAHR_BODY_BOX);
            bodies[b].half_extents = at(1, 1, 1), bodies[b].radius = bodies[b].half_height = 1;
        }
        bodies[1].flags = last ? 0 : cases[i].flags;
        tahr_status status = tahr_world_open(tahr_backend_v1_template(), &desc, &world);
        assert_int_equal(status, last ? TAHR_OK : TAHR_E_UNSUPPORTED);
        if (!last) {
            assert_non_null(strstr(messages.text, "bodies[1] "));
            assert_non_null(strstr(messages.text, cases[i].named));
            assert_non_null(strstr(messages.text, cases[i].lacks));
        }
    }
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    config.shape.type = TAHR_SHAPE_CYLINDER;
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_E_UNSUPPORTED);
    assert_non_null(strstr(messages.text, "shape.type "));
    assert_non_null(strstr(messages.text, "backend template sweeps: it lacks TAHR_CAP_CYLINDER"));
    tahr_world_close(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sweeps_agree_with_the_native_backend),
        cmocka_unit_test(contacts_are_ordered_and_the_farthest_are_dropped),
        cmocka_unit_test(what_is_placed_is_met_where_it_is),
        cmocka_unit_test(what_it_does_not_claim_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

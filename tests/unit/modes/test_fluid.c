/* SPDX-License-Identifier: MIT
 * test_fluid.c: how deep an upright shape is in fluids, through every backend that holds them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "fake_backend.h"
#include "fake_host.h"
#include "near.h"

#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif

typedef const tahr_backend *(*backend_fn)(void);
static const backend_fn backends[] = {
    tahr_backend_v1_native,
#ifdef TAHR_HAVE_CCD
    tahr_backend_v1_ccd,
#endif
};
enum { BACKENDS = sizeof backends / sizeof backends[0] };

static tahr_body_desc fluid_body(uint32_t type, tahr_vec3 at)
{
    tahr_body_desc b;
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, type), TAHR_OK);
    b.flags = TAHR_BODY_FLUID | TAHR_BODY_MOVABLE;
    b.pose.position = at;
    b.half_extents = fake_vec(1.5, 2, 0.7);
    b.radius = 0.8;
    b.half_height = 1.7;
    return b;
}

static tahr_world *open_world(const tahr_backend *backend, const tahr_body_desc *bodies, uint32_t count, fake_log *said)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_log log = fake_log_of(said);
    memset(said, 0, sizeof *said);
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.log = &log;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    return world;
}

static tahr_fluid_query query_at(tahr_vec3 at, tahr_vec3 up)
{
    tahr_fluid_query q = {.position = at, .up = up, .radius = 0.35, .half_height = 0.9, .mask = 0xFFFFFFFFu};
    return q;
}

static tahr_fluid ask(tahr_world *world, tahr_vec3 at, tahr_vec3 up)
{
    tahr_fluid_query q = query_at(at, up);
    tahr_fluid f;
    assert_int_equal(tahr_world_fluid(world, &q, &f), TAHR_OK);
    return f;
}

static void immersion_in_an_upright_box_is_the_part_below_its_top(void **unused)
{
    const tahr_vec3 up = {0, 0, 1};
    (void)unused;
    for (int k = 0; k < BACKENDS; k++) {
        fake_log said;
        tahr_body_desc b = fluid_body(TAHR_BODY_BOX, fake_vec(10, 20, -5));
        b.half_extents = fake_vec(3, 3, 5); /* its top is z = 0 */
        b.surface_velocity = fake_vec(0.5, 0, 0);
        b.fluid_friction = 0.25;
        tahr_world *world = open_world(backends[k](), &b, 1, &said);
        for (double z = -3; z < 3; z += 0.0625) {
            tahr_fluid f = ask(world, fake_vec(12.9, 20, z), up);
            assert_near(f.immersion, fmin(fmax((0.9 - z) / 1.8, 0), 1), 1e-15);
            assert_int_equal(f.body, f.immersion > 0 ? 0 : TAHR_NO_BODY);
            assert_true(f.friction == (f.immersion > 0 ? 0.25 : 0) && f.velocity.x == (f.immersion > 0 ? 0.5 : 0));
        }
        assert_true(ask(world, fake_vec(13.001, 20, -3), up).immersion == 0);
        tahr_world_close(world);
    }
}

static tahr_quat random_turn(oracle_random *seed)
{
    tahr_vec3 axis = dice_direction(seed);
    double angle = oracle_uniform(seed, -3, 3), sine = sin(angle / 2);
    return (tahr_quat){axis.x * sine, axis.y * sine, axis.z * sine, cos(angle / 2)};
}

/* Does the body hold the point? */
static int holds(const tahr_body_desc *b, tahr_vec3 at)
{
    tahr_vec3 d = {at.x - b->pose.position.x, at.y - b->pose.position.y, at.z - b->pose.position.z};
    d = fake_turn_back(b->pose.orientation, d);
    if (b->type == TAHR_BODY_BOX) {
        return fabs(d.x) <= b->half_extents.x && fabs(d.y) <= b->half_extents.y && fabs(d.z) <= b->half_extents.z;
    }
    double reach = b->type == TAHR_BODY_CAPSULE ? b->half_height - b->radius : 0;
    double off = fmax(fabs(d.z) - reach, 0);
    return d.x * d.x + d.y * d.y + off * off <= b->radius * b->radius;
}

/* Points along the axis, counted: independent of any clipping. */
static void immersion_is_the_part_of_the_axis_inside_however_the_body_is_turned(void **unused)
{
    enum { POINTS = 2000 };
    const uint32_t types[] = {TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE};
    oracle_random seed = {20};
    int partly = 0;
    (void)unused;
    for (int round = 0; round < 300; round++) {
        fake_log said;
        tahr_body_desc b = fluid_body(types[round % 3], dice_vec(&seed, -5, 5));
        b.pose.orientation = random_turn(&seed);
        tahr_vec3 up = fake_turn(random_turn(&seed), fake_vec(0, 0, 1)), off = dice_vec(&seed, -1.5, 1.5);
        tahr_vec3 at = {b.pose.position.x + off.x, b.pose.position.y + off.y, b.pose.position.z + off.z};
        int inside = 0;
        for (int i = 0; i < POINTS; i++) {
            double t = 0.9 * ((2 * i + 1.0) / POINTS - 1);
            inside += holds(&b, fake_vec(at.x + t * up.x, at.y + t * up.y, at.z + t * up.z));
        }
        partly += inside > 0 && inside < POINTS;
        double first = -1;
        for (int k = 0; k < BACKENDS; k++) {
            tahr_world *world = open_world(backends[k](), &b, 1, &said);
            double m = ask(world, at, up).immersion;
            assert_near(m, (double)inside / POINTS, 1.01 / POINTS);
            assert_true(k == 0 || m == first); /* one code, one answer */
            first = m;
            tahr_world_close(world);
        }
    }
    assert_true(partly > 100);
}

static void the_deepest_fluid_answers_and_the_first_among_equals(void **unused)
{
    (void)unused;
    for (int k = 0; k < BACKENDS; k++) {
        fake_log said;
        tahr_body_desc b[4];
        for (int i = 0; i < 4; i++) {
            b[i] = fluid_body(TAHR_BODY_BOX, fake_vec(0, 0, i == 2 ? -0.5 : -1));
            b[i].surface_velocity = fake_vec(0, 0, i);
        }
        b[0].flags = TAHR_BODY_SENSOR; /* no fluid at all */
        b[3].mask = 2;
        b[3].pose.position.z = 0;
        tahr_world *world = open_world(backends[k](), b, 4, &said);
        tahr_fluid_query q = query_at(fake_vec(0, 0, 0), fake_vec(0, 0, 1));
        tahr_fluid f;
        q.mask = 1;
        assert_int_equal(tahr_world_fluid(world, &q, &f), TAHR_OK);
        assert_int_equal(f.body, 2);
        assert_near(f.immersion, 1.1 / 1.8, 1e-15); /* from the foot at -0.9 to the top at 0.2 */
        q.mask = 2;
        assert_int_equal(tahr_world_fluid(world, &q, &f), TAHR_OK);
        assert_int_equal(f.body, 3);
        q.mask = 0;
        assert_int_equal(tahr_world_fluid(world, &q, &f), TAHR_OK);
        assert_true(f.body == TAHR_NO_BODY && f.immersion == 0);
        tahr_world_close(world);
        b[2].pose.position.z = -1;
        world = open_world(backends[k](), b, 3, &said);
        assert_int_equal(ask(world, q.position, q.up).body, 1);
        tahr_world_close(world);
    }
}

static void a_fluid_that_is_moved_takes_its_surface_and_its_current_along(void **unused)
{
    (void)unused;
    for (int k = 0; k < BACKENDS; k++) {
        fake_log said;
        tahr_body_desc b = fluid_body(TAHR_BODY_BOX, fake_vec(0, 0, 0));
        b.surface_velocity = fake_vec(2, 0, 0);
        tahr_world *world = open_world(backends[k](), &b, 1, &said);
        const tahr_vec3 up = {0, 0, 1}, at = {50, 0, 0.7};
        assert_true(ask(world, at, up).immersion == 0);
        tahr_body_pose pose = {.body = 0, .pose = {{50, 0, 0}, {0, 0, sqrt(0.5), sqrt(0.5)}}}; /* a quarter turn */
        assert_int_equal(tahr_world_set(world, &pose, 1), TAHR_OK);
        tahr_fluid f = ask(world, at, up);
        assert_near(f.immersion, 0.5, 1e-15);
        assert_near(f.velocity.x, 0, 1e-15);
        assert_near(f.velocity.y, 2, 1e-15);
        tahr_world_close(world);
    }
}

static void a_direct_question_is_checked(void **unused)
{
    fake_log said;
    tahr_body_desc b = fluid_body(TAHR_BODY_SPHERE, fake_vec(0, 0, 0));
    tahr_world *world = open_world(tahr_backend_v1_native(), &b, 1, &said);
    const tahr_fluid_query good = query_at(fake_vec(0, 0, 0), fake_vec(0, 0, 1));
    tahr_fluid f, before;
    (void)unused;
    memset(&before, 0x5A, sizeof before);
    f = before;
    for (int i = 0; i < 7; i++) {
        static const char *const names[] = {"position", "up", "half_height", "half_height", "radius", "reserved", "up"};
        tahr_fluid_query q = good;
        switch (i) {
        case 0: q.position.y = NAN; break;
        case 1: q.up.z = 1.01; break;
        case 2: q.half_height = 0; break;
        case 3: q.half_height = INFINITY; break;
        case 4: q.radius = -1; break;
        case 5: q.reserved = 1; break;
        default: q.up.x = NAN; break;
        }
        assert_int_equal(tahr_world_fluid(world, &q, &f), TAHR_E_ARGUMENT);
        assert_non_null(strstr(said.text, names[i]));
        assert_memory_equal(&f, &before, sizeof f);
    }
    assert_int_equal(tahr_world_fluid(NULL, &good, &f), TAHR_E_NULL);
    assert_int_equal(tahr_world_fluid(world, NULL, &f), TAHR_E_NULL);
    assert_int_equal(tahr_world_fluid(world, &good, NULL), TAHR_E_NULL);
    tahr_world_close(world);
}

static void a_backend_that_knows_no_fluids_refuses_a_scene_with_one(void **unused)
{
    tahr_backend dry = *tahr_backend_v1_native();
    tahr_body_desc b = fluid_body(TAHR_BODY_BOX, fake_vec(0, 0, 0));
    tahr_world_desc desc;
    tahr_world *world = NULL;
    fake_log said = {0};
    tahr_log log = fake_log_of(&said);
    (void)unused;
    dry.fluid = NULL;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = &b;
    desc.body_count = 1;
    desc.log = &log;
    assert_int_equal(tahr_world_open(&dry, &desc, &world), TAHR_E_UNSUPPORTED);
    assert_null(world);
    assert_non_null(strstr(said.text, "backend.fluid"));
    b.flags = TAHR_BODY_SENSOR;
    assert_int_equal(tahr_world_open(&dry, &desc, &world), TAHR_OK);
    tahr_world_close(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(immersion_in_an_upright_box_is_the_part_below_its_top),
        cmocka_unit_test(immersion_is_the_part_of_the_axis_inside_however_the_body_is_turned),
        cmocka_unit_test(the_deepest_fluid_answers_and_the_first_among_equals),
        cmocka_unit_test(a_fluid_that_is_moved_takes_its_surface_and_its_current_along),
        cmocka_unit_test(a_direct_question_is_checked),
        cmocka_unit_test(a_backend_that_knows_no_fluids_refuses_a_scene_with_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_graze.c: what passes an edge at exactly its margin is not stopped by it, on every engine: the head of who walks
 * under a ceiling that is one skin above it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#include <tahr/tahr.h>

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "near.h"

enum { TILES = 30, SHAPES = 3, ENGINES = 5, HEIGHTS = 4 };

/* [out] world: opened, or NULL where this build has no such engine. */
static void open_world(int engine, const tahr_body_desc *bodies, uint32_t count, tahr_world **world)
{
    const tahr_backend *backend = engine == 0 ? tahr_backend_v1_native() : NULL;
    tahr_world_desc desc;
    *world = NULL;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = count;
#ifdef TAHR_HAVE_CCD
    if (engine == 1) backend = tahr_backend_v1_ccd();
#endif
#ifdef TAHR_HAVE_FCL
    if (engine == 2) backend = tahr_backend_v1_fcl();
#endif
#ifdef TAHR_HAVE_BOX2D
    tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engine == 3 ? TAHR_BOX2D_2 : TAHR_BOX2D_3};
    if (engine >= 3) {
        backend = tahr_backend_v1_box2d();
        desc.options = &options;
    }
#endif
    tahr_status status = backend ? tahr_world_open(backend, &desc, world) : TAHR_E_UNSUPPORTED;
    assert_true(status == TAHR_OK || (status == TAHR_E_UNSUPPORTED && (!backend || engine >= 3)));
}

static tahr_body_desc box(double left, double right, double low, double high)
{
    tahr_body_desc b;
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_BOX), TAHR_OK);
    b.pose.position = (tahr_vec3){(left + right) / 2, (low + high) / 2, 0};
    b.half_extents = (tahr_vec3){(right - left) / 2, (high - low) / 2, 2};
    return b;
}

static tahr_shape shape_of(int i)
{
    static const tahr_shape shapes[SHAPES] = {
        {.type = TAHR_SHAPE_SPHERE, .radius = 0.35, .half_height = 0.35},
        {.type = TAHR_SHAPE_CAPSULE, .radius = 0.35, .half_height = 0.9},
        {.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.35, .half_y = 0.35},
    };
    return shapes[i];
}

/* A level motion whose top passes the lower edge of a block, `above` it. Where its front is when it is stopped, from
 * the edge on; or INFINITY. */
static double pass(tahr_world *world, int i, double margin, double edge, double above)
{
    tahr_shape shape = shape_of(i);
    double reach = shape.type == TAHR_SHAPE_BOX ? shape.half_x : 0;
    tahr_hit hit;
    uint32_t count = 9;
    tahr_sweep q = {.shape = shape,
                    .position = {edge - 1 - reach, 3 - above - shape.half_height, 0},
                    .up = {0, 1, 0},
                    .orientation = {-0.70710678118654757, 0, 0, 0.70710678118654757},
                    .motion = {2, 0, 0},
                    .margin = margin,
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_sweep(world, &q, &hit, 1, &count), TAHR_OK);
    return count ? 2 * hit.fraction - 1 : INFINITY;
}

/* Of a round head it is the middle of its round that has the distance radius + margin from the edge. */
static void an_edge_at_the_margin_is_passed_and_one_below_it_is_not(void **unused)
{
    static const double MARGINS[] = {0.001, 0.01, 0.05}, EDGES[] = {0, 37.3, -1000.7}, BELOW = 3e-6;
    (void)unused;
    for (int k = 0; k < ENGINES * 3; k++) {
        tahr_world *world;
        double edge = EDGES[k % 3];
        tahr_body_desc block = box(edge, edge + 4, 3, 4);
        open_world(k / 3, &block, 1, &world);
        for (int i = 0; world && i < SHAPES * 3; i++) {
            double margin = MARGINS[i % 3], r = margin + shape_of(i / 3).radius;
            assert_true(pass(world, i / 3, margin, edge, margin) == INFINITY);
            assert_true(pass(world, i / 3, margin, edge, margin + 1e-12) == INFINITY);
            assert_true(pass(world, i / 3, margin, edge, margin + 1e-7) == INFINITY);
            /* A nanometre of distance is up to a micrometre of way here. */
            assert_near(pass(world, i / 3, margin, edge, margin - BELOW), -sqrt(BELOW * (2 * r - BELOW)), 3e-6);
        }
        tahr_world_close(world);
    }
}

/* From -10 to 15 m at y = height, and 3 m from the start a ceiling of tiles that leaves a character and two skins. */
static void lay(tahr_body_desc *bodies, const tahr_config *c, double height)
{
    double low = height + 2 * c->shape.half_height + 2 * c->skin;
    for (int i = 0; i < TILES; i++) {
        bodies[i] = box(3 + 0.3 * i, 3 + 0.3 * (i + 1), low, low + 1);
    }
    bodies[TILES] = box(-10, 15, height - 1, height);
}

static void walk_under(tahr_world *world, const tahr_config *c, double height, double rate)
{
    tahr_mover *mover;
    tahr_state state;
    tahr_vec3 at = {0, height + c->shape.half_height + c->skin, 0};
    tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}};
    assert_int_equal(tahr_mover_create(world, c, &mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&state, c, &at), TAHR_OK);
    while (state.position.x < 11) {
        double before = state.position.x;
        assert_true(tahr_mover_step(mover, &input, 1 / rate, &state, NULL) >= 0);
        /* After 1 m of the way it is as fast as it gets: 6^2 / (2 * 20.48) = 0.88 m. */
        double way = state.position.x - before;
        assert_true(before < 1 ? way > 0 : fabs(way - c->max_speed / rate) < 1e-6);
    }
    tahr_mover_destroy(mover);
}

/* Heights, for where what an engine rounds lies. */
static void a_ceiling_a_skin_above_the_head_slows_nobody_down(void **unused)
{
    static const double RATES[] = {30, 60, 144}, LEVELS[HEIGHTS] = {0, 0.137, 0.959, 2.603};
    (void)unused;
    for (int k = 0; k < ENGINES * SHAPES * HEIGHTS * 3; k++) {
        static tahr_body_desc bodies[TILES + 1];
        tahr_world *world;
        tahr_config c;
        double height = LEVELS[k / 3 % HEIGHTS];
        assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
        c.gravity = (tahr_vec3){0, -9.81, 0};
        c.plane = (tahr_vec3){0, 0, 1};
        c.shape = shape_of(k / 3 / HEIGHTS % SHAPES);
        c.floor_target = c.floor_max = 1;
        lay(bodies, &c, height);
        open_world(k / 3 / HEIGHTS / SHAPES, bodies, TILES + 1, &world);
        if (world) {
            walk_under(world, &c, height, RATES[k % 3]);
        }
        tahr_world_close(world);
    }
}

/* Beside a block whose corner is the origin, `gap` from its wall x = 0, the lowest point of what is straight `low`
 * above its top. How far a motion goes, in parts of it; or 2. */
static double beside(tahr_world *world, int i, double gap, double low, tahr_vec3 motion)
{
    tahr_shape shape = shape_of(i);
    double straight = i == 2 ? shape.half_height : shape.half_height - shape.radius;
    tahr_hit hit;
    uint32_t count = 9;
    tahr_sweep q = {.shape = shape,
                    .position = {(i == 2 ? shape.half_x : shape.radius) + gap, low + straight, 0},
                    .up = {0, 1, 0},
                    .orientation = {-0.70710678118654757, 0, 0, 0.70710678118654757},
                    .motion = motion,
                    .margin = 0.01,
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_sweep(world, &q, &hit, 1, &count), TAHR_OK);
    return count > 0 ? hit.fraction : 2;
}

/* Deep inside the margin rounding turns the normal of an edge, by 1e-7 at 1e-9 m. */
static void a_motion_along_a_wall_is_free_however_near_its_edge(void **state)
{
    (void)state;
    static const double GAPS[] = {1e-9, 3e-9, 1e-8, 1e-7, 1e-6}, LOWS[] = {0, 1e-15, -1e-15, -0.1, -0.3};
    static const tahr_vec3 ALONG[] = {{0, -0.05, 0}, {0, 0.05, 0}, {0, 0, 0.05}, {0, 0.03, -0.04}};
    for (int engine = 0; engine < 3; engine++) {
        tahr_world *world;
        tahr_body_desc block = box(-5, 0, -5, 0);
        open_world(engine, &block, 1, &world);
        for (int k = 0; world && k < SHAPES * 25; k++) {
            double gap = GAPS[k / SHAPES % 5], low = LOWS[k / SHAPES / 5];
            for (int m = 0; m < 4; m++) {
                double way = beside(world, k % SHAPES, gap, low, ALONG[m]);
                if (way < 2) {
                    fail_msg("engine %d shape %d gap %g low %g motion %d: %g", engine, k % SHAPES, gap, low, m, way);
                }
            }
            /* And into it not. */
            tahr_vec3 into = {-0.05, -0.001, 0};
            assert_true(beside(world, k % SHAPES, gap, low, into) == 0);
        }
        tahr_world_close(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_motion_along_a_wall_is_free_however_near_its_edge),
        cmocka_unit_test(an_edge_at_the_margin_is_passed_and_one_below_it_is_not),
        cmocka_unit_test(a_ceiling_a_skin_above_the_head_slows_nobody_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_box2d_native.c: the same level as boxes of space on the native backend and as boxes of a plane on Box2D:
 * every step of a random walk begins from one state and must end in one place. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "box2d_rig.h"

#ifndef TAHR_HAVE_BOX2D
int main(void)
{
    puts("SKIP: unit_engines_box2d_native: built without Box2D");
    return 77;
}
#else
#include "oracle.h"
#include "near.h"

#include <tahr/native.h>

enum { BODIES = 24, STEPS = 6000 };

static uint32_t engines[2];
static int engine_count;
static tahr_body_desc bodies[BODIES];
static uint32_t body_count;

static tahr_body_desc *put(double x, double y, double half_width, double half_height, double angle)
{
    tahr_body_desc *b = &bodies[body_count++];
    *b = box2d_box(x, y, half_width, half_height);
    b->half_extents.z = 5;
    b->pose.orientation = (tahr_quat){0, 0, sin(angle / 2), cos(angle / 2)};
    return b;
}

/* A pit between two walls: a floor, stairs, slopes of 20 and 35 degrees up and down, a low ceiling, a pillar, a
 * ledge, a boulder and a conveyor. Nothing is flush with anything else: native feels seams between
 * bodies, box2d does not. */
static void furnish(void)
{
    body_count = 0;
    put(-12, 5, 0.5, 6, 0);
    put(14, 5, 0.5, 6, 0);
    put(1, -0.5, 14, 0.5, 0);
    put(-9.6, 0, 2.1, 0.3, 0);
    put(-9.9, 0.2, 1.8, 0.4, 0);
    put(-10.2, 0.4, 1.5, 0.5, 0);
    put(-4, 0, 2, 0.3, 0.35);
    put(-0.5, 0, 1.5, 0.3, -0.61);
    put(4, 2.6, 1, 0.4, 0);
    put(6, 1.25, 0.25, 1.5, 0);
    put(8.5, 2.2, 1, 0.2, 0);
    put(9, 0.2, 1, 0.3, 0)->surface_velocity = (tahr_vec3){1.5, 0, 0};
    tahr_body_desc *ball = put(0, 0, 1, 1, 0);
    assert_int_equal(tahr_body_desc_init(ball, sizeof *ball, TAHR_BODY_SPHERE), TAHR_OK);
    ball->pose.position = (tahr_vec3){11.8, -0.4, 0};
    ball->radius = 1;
}

static tahr_world *open_native(void)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = body_count;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    return world;
}

static void wish(oracle_random *dice, tahr_input *input)
{
    if (oracle_below(dice, 20) == 0) {
        input->move.x = oracle_uniform(dice, -1.3, 1.3);
    }
    input->jump = oracle_below(dice, 60) == 0;
    input->crouch = oracle_below(dice, 100) == 0 ? !input->crouch : input->crouch;
}

/* Gaps of both are within 1e-9 m: at a graze that is sqrt(2 r 1e-9) = 2.6e-5 m of the way. */
static const double GRAZE = 2.7e-5;

static void walk(uint32_t engine, uint32_t shape, uint64_t seed)
{
    oracle_random dice = {seed};
    box2d_rig r;
    tahr_mover *other;
    tahr_config c = box2d_config();
    int different = 0, walked = 0;
    c.jump_speed = 5.5;
    c.shape.type = shape;
    c.shape.half_height = shape == TAHR_SHAPE_SPHERE ? 0.35 : 0.9;
    c.shape.radius = shape == TAHR_SHAPE_BOX ? 0 : 0.35;
    c.shape.half_x = c.shape.half_y = shape == TAHR_SHAPE_BOX ? 0.35 : 0;
    c.crouched_half_height = shape == TAHR_SHAPE_SPHERE ? 0.35 : 0.5;
    furnish();
    box2d_rig_open(&r, engine, bodies, body_count, &c, 2, 1.5);
    tahr_world *native = open_native();
    assert_int_equal(tahr_mover_create(native, &c, &other), TAHR_OK);
    for (int i = 0; i < STEPS; i++) {
        tahr_state twin = r.state;
        twin.floor_revision = twin.floor_revision ? tahr_world_revision(native) : 0;
        wish(&dice, &r.input);
        box2d_rig_steps(&r, 1, 1.0 / 60);
        assert_true(tahr_mover_step(other, &r.input, 1.0 / 60, &twin, NULL) >= 0);
        walked += r.state.mode == TAHR_MODE_WALKING;
        double off = fmax(fabs(twin.position.x - r.state.position.x), fabs(twin.position.y - r.state.position.y));
        different += off > GRAZE || twin.mode != r.state.mode;
        assert_near(r.state.position.z, 0, 0);
    }
    assert_true(walked > STEPS / 3);
    /* Who stands on a corner that just holds stands or slips: a rounding may tip a step, and both are right. */
    assert_true(different <= STEPS / 1000);
    tahr_mover_destroy(other);
    tahr_world_close(native);
    box2d_rig_close(&r);
}

static void a_walk_is_the_same_as_in_space(void **unused)
{
    (void)unused;
    for (int k = 0; k < engine_count * 3; k++) {
        walk(engines[k / 3], 1 + (uint32_t)k % 3, 77 + (uint64_t)k % 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walk_is_the_same_as_in_space),
    };
    engine_count = box2d_engines(engines);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif

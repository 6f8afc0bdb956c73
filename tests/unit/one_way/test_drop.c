/* SPDX-License-Identifier: MIT
 * test_drop.c: falling through one-way bodies: one layer for each press, at every frame rate, whatever the layers are
 * made of and however they move. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "layers.h"

static const double SKIN = 0.01;

static int stands_at(const layers *l, const rig *r, double height)
{
    double gap = layers_foot(l, r) - height;
    return r->state.mode == TAHR_MODE_WALKING && gap >= SKIN - 1e-5 && gap <= 1.5 * SKIN + 1e-5;
}

static void press(rig *r, double dt)
{
    r->input.flags |= TAHR_INPUT_DROP;
    rig_step(r, dt);
}

static void release(rig *r, double dt)
{
    r->input.flags &= ~(uint32_t)TAHR_INPUT_DROP;
    rig_step(r, dt);
}

/* Steps until it stands; keeps the button as it is. */
static void await_floor(rig *r, double dt)
{
    for (int i = 0; r->state.mode != TAHR_MODE_WALKING; i++) {
        assert_true(i * dt < 5);
        rig_step(r, dt);
    }
}

/* Layers this far apart, standing on the uppermost at x. kind: of the layers; shape: 0 capsule, 1 box. */
static int stand_on_stack(layers *l, rig *r, int world, int kind, double apart, int shape, double x)
{
    if (!layers_begin(l, world)) {
        return 0;
    }
    layers_add(l, LAYER_BOX, -20, 20, 0, 0);
    for (int i = 1; i <= 5; i++) {
        layers_add(l, kind, -5, 5, i * apart, TAHR_BODY_ONE_WAY);
    }
    tahr_config c = layers_config(l, TAHR_PRESET_PRECISE);
    if (shape) {
        c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.35, .half_y = 0.35};
    }
    layers_open(l, r, &c, x, 5 * apart + 0.3);
    rig_settle(r);
    assert_true(stands_at(l, r, 5 * apart));
    return 1;
}

/* Held or let go, a press is one layer: at 10 Hz a step of the fall passes several of those 0.3 m apart. */
static void each_press_passes_exactly_one_layer(void **unused)
{
    (void)unused;
    static const double APART[] = {0.3, 1, 3};
    for (int world = 0; world < LAYERS_GATHERED; world++) {
        for (int k = 0; k < LAYER_KINDS * 3 * 2; k++) {
            for (int i = world < 2 ? 0 : k % 3; i < RIG_RATES; i += world < 2 ? 1 : 3) {
                static layers l;
                rig r;
                double apart = APART[k % 3], dt = 1 / rig_rates[i];
                if (!stand_on_stack(&l, &r, world, k / 6, apart, k / 3 % 2, 0.25 * (k % 5))) {
                    break;
                }
                for (int layer = 4; layer >= 0; layer--) {
                    press(&r, dt);
                    await_floor(&r, dt); /* still held */
                    assert_true(stands_at(&l, &r, layer * apart));
                    rig_steps(&r, 2, dt);
                    assert_true(stands_at(&l, &r, layer * apart));
                    release(&r, dt);
                }
                press(&r, dt); /* the ground is no platform */
                assert_true(stands_at(&l, &r, 0));
                assert_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
                assert_int_equal(r.state.drop_body, TAHR_NO_BODY);
                rig_close(&r);
            }
        }
    }
}

static void a_drop_says_so_and_is_forgotten(void **unused)
{
    (void)unused;
    static layers l;
    rig r;
    assert_true(stand_on_stack(&l, &r, 0, LAYER_BOX, 1, 0, 0));
    press(&r, 1.0 / 60);
    const tahr_event *left = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
    assert_non_null(left);
    assert_true(left->value == TAHR_LEFT_DROP && left->time == 0 && left->body == 5);
    const tahr_decision *decision = rig_decision(&r, TAHR_RULE_DROP);
    assert_true(decision && decision->accepted == 1 && decision->body == 5);
    assert_true(r.state.flags & TAHR_STATE_DROPPING);
    assert_true(r.state.flags & TAHR_STATE_DROP_HELD);
    assert_int_equal(r.state.drop_body, 5);
    release(&r, 0.2);
    rig_step(&r, 1.0 / 60); /* by now 0.23 m below: no part of its foot, 0.175 m high, is above the layer */
    assert_false(r.state.flags & (TAHR_STATE_DROPPING | TAHR_STATE_DROP_HELD));
    assert_int_equal(r.state.drop_body, TAHR_NO_BODY);
    rig_close(&r);
}

/* In the air, on a solid floor, and where something solid holds too: nothing happens, and the press is spent. */
static void a_press_that_finds_no_platform_is_spent(void **unused)
{
    (void)unused;
    static layers l;
    rig r;
    layers_begin(&l, 0);
    layers_add(&l, LAYER_BOX, -5, 0, 1, 0);
    layers_add(&l, LAYER_BOX, 0, 5, 1, TAHR_BODY_ONE_WAY);
    layers_open(&l, &r, NULL, 2, 1.5);
    press(&r, 1.0 / 60); /* in the air, and held until it stands */
    await_floor(&r, 1.0 / 60);
    rig_steps(&r, 10, 1.0 / 60);
    assert_true(stands_at(&l, &r, 1));
    rig_close(&r);
    static const double X[] = {-2, -0.2, 0, 0.05}; /* at 0.05 the solid's edge is 5 mm beyond the skin */
    for (int i = 0; i < 4; i++) {
        layers_open(&l, &r, NULL, X[i], 1.1);
        rig_settle(&r);
        press(&r, 1.0 / 60);
        assert_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
        assert_true(stands_at(&l, &r, 1));
        rig_close(&r);
    }
}

/* Down and jump together: the jump neither starts nor waits. */
static void a_drop_takes_the_jump_of_the_same_press(void **unused)
{
    (void)unused;
    static layers l;
    rig r;
    layers_begin(&l, 0);
    layers_add(&l, LAYER_BOX, -5, 5, 0, 0);
    layers_add(&l, LAYER_BOX, -5, 5, 3, TAHR_BODY_ONE_WAY);
    tahr_config c = layers_config(&l, TAHR_PRESET_PRECISE);
    c.air_jumps = 2;
    c.coyote_time = c.jump_buffer = 0.5;
    layers_open(&l, &r, &c, 0, 3.1);
    rig_settle(&r);
    r.input.jump = 1;
    press(&r, 1.0 / 60);
    for (int i = 0; r.state.mode != TAHR_MODE_WALKING; i++) {
        assert_null(rig_event(&r, TAHR_EVENT_JUMPED));
        assert_true(i < 200);
        rig_step(&r, 1.0 / 60);
    }
    assert_true(stands_at(&l, &r, 0));
    rig_close(&r);
}

/* A row of lifts side by side, rising or sinking or shuttling; drops onto the ground while standing on the seam of
 * two. */
static void one_drops_through_platforms_that_move(void **unused)
{
    (void)unused;
    static const double SPEEDS[][2] = {{0, 2}, {0, -2}, {3, 0}, {-2, 1}, {0, 5}};
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int k = 0; k < 5; k++) {
            for (int i = 0; i < RIG_RATES; i += world < 2 ? 1 : 2) {
                static layers l;
                rig r;
                double dt = 1 / rig_rates[i];
                if (!layers_begin(&l, world)) {
                    break;
                }
                layers_add(&l, LAYER_BOX, -40, 40, 0, 0);
                layers_add(&l, LAYER_TILES, -4, 4, 6, TAHR_BODY_ONE_WAY | TAHR_BODY_MOVABLE);
                layers_open(&l, &r, NULL, 0, 6.05);
                rig_settle(&r);
                tahr_body_pose poses[8];
                int steps = 0, dropped = 0;
                while (r.state.mode != TAHR_MODE_WALKING || layers_foot(&l, &r) > 0.1) {
                    double t = (double)++steps * dt;
                    assert_true(t < 5);
                    for (uint32_t b = 0; b < 8; b++) {
                        poses[b] = (tahr_body_pose){.body = b + 1, .pose = l.bodies[b + 1].pose};
                        poses[b].pose.position = layers_at(&l, SPEEDS[k][0] * t, SPEEDS[k][1] * t);
                    }
                    assert_int_equal(tahr_world_move(r.world, poses, 8, dt), TAHR_OK);
                    if (t > 0.45 && !dropped) {
                        assert_true(stands_at(&l, &r, 6 + SPEEDS[k][1] * (t - dt)));
                        dropped = 1;
                        press(&r, dt);
                        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
                    } else {
                        rig_step(&r, dt);
                        assert_true(!dropped || r.state.mode == TAHR_MODE_FALLING || layers_foot(&l, &r) < 0.1);
                    }
                }
                assert_true(stands_at(&l, &r, 0));
                rig_close(&r);
            }
        }
    }
}

/* The whole world of this one is the plane z = 0, one way. */
static tahr_status sweep_plane(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    const tahr_vec3 up = {0, 0, 1};
    double gap = q->position.z - q->shape.half_height, to_margin = gap - q->margin, falls = -q->motion.z;
    (void)user;
    if (falls > 0 && to_margin <= falls && tahr_one_way_blocks(&q->up, &up, gap, q->margin, q->flags)) {
        hit->blocking = 1;
        hit->fraction = to_margin > 0 ? to_margin / falls : 0;
        hit->normal = up;
        hit->body = 7;
    }
    return TAHR_OK;
}

static tahr_status plane_motion(void *user, uint32_t body, tahr_body_motion *motion)
{
    (void)user;
    motion->flags = TAHR_BODY_ONE_WAY;
    return body == 7 ? TAHR_OK : TAHR_E_NOT_FOUND;
}

static void callbacks_say_what_is_one_way(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .sweep = sweep_plane, .body = plane_motion};
        rig_open_callbacks(&r, &callbacks, NULL, (tahr_vec3){0, 0, 1});
        r.state.velocity.z = 8; /* passes it from below first */
        r.state.position.z = -1;
        await_floor(&r, 1 / rig_rates[i]);
        rig_settle(&r);
        assert_near(r.state.position.z, 0.9125, 2.6e-3);
        press(&r, 1 / rig_rates[i]);
        assert_true(rig_event(&r, TAHR_EVENT_LEFT_GROUND)->value == TAHR_LEFT_DROP);
        assert_int_equal(r.state.drop_body == 7, (r.state.flags & TAHR_STATE_DROPPING) != 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_true(r.state.position.z < -3);
        rig_close(&r);
    }
}

/* The settings of the field, whose sweeps keep no margin. */
static void one_drops_with_the_unreal_preset_too(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        static layers l;
        rig r;
        layers_begin(&l, 0);
        layers_add(&l, LAYER_BOX, -5, 5, 0, 0);
        layers_add(&l, LAYER_TILES, -5, 5, 2, TAHR_BODY_ONE_WAY);
        layers_add(&l, LAYER_SHEET, -5, 5, 4, TAHR_BODY_ONE_WAY);
        tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
        layers_open(&l, &r, &c, 0.3, 4.1);
        double dt = 1 / rig_rates[i];
        await_floor(&r, dt);
        rig_step(&r, dt);
        for (int layer = 1; layer >= 0; layer--) {
            press(&r, dt);
            assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
            await_floor(&r, dt);
            release(&r, dt);
            double gap = layers_foot(&l, &r) - 2 * layer;
            assert_true(gap > 0.018 && gap < 0.025);
        }
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_press_passes_exactly_one_layer),
        cmocka_unit_test(a_drop_says_so_and_is_forgotten),
        cmocka_unit_test(a_press_that_finds_no_platform_is_spent),
        cmocka_unit_test(a_drop_takes_the_jump_of_the_same_press),
        cmocka_unit_test(one_drops_through_platforms_that_move),
        cmocka_unit_test(callbacks_say_what_is_one_way),
        cmocka_unit_test(one_drops_with_the_unreal_preset_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

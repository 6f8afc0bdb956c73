/* SPDX-License-Identifier: MIT
 * test_joint.c: one press drops through all of a surface that is joined from several one-way bodies, wherever the foot
 * rests on it and however it runs, and through no more than that. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "layers.h"

static const double RADIAN = 0.017453292519943295, TOP = 4, SKIN = 0.01;

/* Two sheets that meet at (0, TOP): how far each rises away from there, which of them is the first body, and how far
 * under TOP the next layer is. */
typedef struct joint {
    double left, right; /* degrees */
    int swapped;
    double below;
} joint;

static void add_half(layers *l, double angle, int is_right)
{
    double out = 3 * cos(angle * RADIAN), height = TOP + 3 * sin(angle * RADIAN);
    tahr_vec3 end = {is_right ? out : -out, height, 0}, at = {0, TOP, 0};
    layers_slope(l, is_right ? at : end, is_right ? end : at, TAHR_BODY_ONE_WAY);
}

static int begin(layers *l, int world, const joint *j)
{
    if (!layers_begin(l, world)) {
        return 0;
    }
    layers_add(l, LAYER_BOX, -40, 40, 0, 0);
    layers_add(l, LAYER_SHEET, -40, 40, TOP - j->below, TAHR_BODY_ONE_WAY);
    add_half(l, j->swapped ? j->right : j->left, j->swapped);
    add_half(l, j->swapped ? j->left : j->right, !j->swapped);
    return 1;
}

/* Presses at x, running at `speed`: the next that it stands on is the layer below. */
static void drop_once(layers *l, const joint *j, const tahr_config *c, double x, double speed, double dt)
{
    rig r;
    layers_open(l, &r, c, x, TOP + 1.5);
    rig_settle(&r);
    if (speed != 0) {
        r.input.move = layers_at(l, speed / 6, 0);
        r.state.velocity = layers_at(l, speed, 0);
        rig_steps(&r, 2, 1.0 / 144);
    }
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_true(layers_foot(l, &r) > TOP - 2);
    r.input.flags |= TAHR_INPUT_DROP;
    rig_step(&r, dt);
    const tahr_event *left = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
    assert_true(left && left->value == TAHR_LEFT_DROP);
    for (double time = 0; r.state.mode != TAHR_MODE_WALKING; time += dt) {
        assert_true(time < 3);
        rig_step(&r, dt);
    }
    assert_near(layers_foot(l, &r), TOP - j->below + 1.25 * SKIN, 0.25 * SKIN + 1e-5);
    rig_close(&r);
}

static void drop_everywhere(const joint *j, int world, int more, double speed)
{
    static const double SPEEDS[] = {0, 0.5, -0.5, 1, -1}, RATES[] = {30, 60, 144};
    layers l;
    if (!begin(&l, world, j)) {
        return;
    }
    for (int k = 0; k < 2 * 5 * 3; k += world < 1 ? 1 : 7) {
        tahr_config c = layers_config(&l, k % 4 < 2 ? TAHR_PRESET_PRECISE : TAHR_PRESET_PLATFORMER);
        if (k % 2) {
            c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.35, .half_y = 0.35};
        }
        for (int i = -3; i <= 3; i++) { /* in 0.17 m: with a foot of 0.7 m on one side, on both, on the other */
            drop_once(&l, j, &c, 0.17 * i + 0.013 * (more % 7), speed * SPEEDS[k / 2 % 5], 1 / RATES[k / 10]);
        }
        if (k % 2) { /* a side of the box in the plane of the ends */
            drop_once(&l, j, &c, 0.35, speed * SPEEDS[k / 2 % 5], 1 / RATES[k / 10]);
            drop_once(&l, j, &c, -0.35, speed * SPEEDS[k / 2 % 5], 1 / RATES[k / 10]);
        }
    }
}

/* Half a metre under the lowest point of the joint the next layer holds. */
static void one_press_drops_through_a_valley_and_no_farther(void **unused)
{
    (void)unused;
    static const double ANGLES[][2] = {{15, 0}, {30, 0}, {0, 40}, {15, 15}, {30, 30}, {40, 20}, {20, 40}, {0, 0}};
    for (int world = 0; world < LAYERS_GATHERED; world++) {
        for (int i = 0; i < 16; i++) {
            joint j = {ANGLES[i / 2][0], ANGLES[i / 2][1], i % 2, 0.5};
            drop_everywhere(&j, world, i, 6);
        }
    }
}

/* Standing: who runs off a crest flies. The ends lie 1.5 m lower at most. */
static void one_press_drops_through_a_crest_and_no_farther(void **unused)
{
    (void)unused;
    static const double ANGLES[][2] = {{0, -30}, {-20, 0}, {30, -30}, {-20, 20}, {-20, 40}, {-15, -15}};
    for (int world = 0; world < LAYERS_GATHERED; world++) {
        for (int i = 0; i < 12; i++) {
            joint j = {ANGLES[i / 2][0], ANGLES[i / 2][1], i % 2, 2.5};
            drop_everywhere(&j, world, i, 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_press_drops_through_a_valley_and_no_farther),
        cmocka_unit_test(one_press_drops_through_a_crest_and_no_farther),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_boxes.c: characters with corners, which turn: none gets deeper into another one unless it says that it is
 * crushed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "dice.h"
#include "throng.h"

enum { COUNT = 32 };

/* How far apart two upright boxes are along the best of the axes that can separate them: their sides, and up; negative
 * where they overlap. The axes of a box turned by 2 atan(z / w) about z. */
static double box_gap(const tahr_state *a, const tahr_state *b, const tahr_shape *shape)
{
    const tahr_state *both[2] = {a, b};
    const double dx = a->position.x - b->position.x, dy = a->position.y - b->position.y;
    double best = fabs(a->position.z - b->position.z) - a->half_height - b->half_height, axis[4][2];
    for (int i = 0; i < 2; i++) {
        const double z = both[i]->orientation.z, w = both[i]->orientation.w;
        axis[2 * i][0] = axis[2 * i + 1][1] = w * w - z * z;
        axis[2 * i][1] = 2 * w * z;
        axis[2 * i + 1][0] = -2 * w * z;
    }
    for (int k = 0; k < 4; k++) {
        double gap = fabs(dx * axis[k][0] + dy * axis[k][1]);
        for (int i = 0; i < 4; i++) {
            const double half = i % 2 ? shape->half_y : shape->half_x;
            gap -= half * fabs(axis[i][0] * axis[k][0] + axis[i][1] * axis[k][1]);
        }
        best = fmax(best, gap);
    }
    return best;
}

/* 1e-6 m: what the crowd takes for a touch, and rounding. */
static int is_deeper(const throng *t, uint32_t i, uint32_t j)
{
    const double now = box_gap(&t->states[i], &t->states[j], &t->config.shape);
    const double was = box_gap(&t->before[i], &t->before[j], &t->config.shape);
    return fmin(was, 0) - fmin(now, 0) > 1e-6;
}

/* They want to the middle, and turn to wherever. Returns how many steps ended crushed. */
static uint32_t press(uint64_t seed, int turns)
{
    oracle_random dice = {seed};
    throng t;
    uint32_t crushed = 0;
    throng_open_ground(&t);
    t.config.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_x = 0.3, .half_y = 0.2, .half_height = 0.8};
    throng_make(&t, COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        throng_place(&t, i, 1.2 * (i % 6) - 3, 1.2 * (i / 6) - 3);
    }
    for (int tick = 0; tick < 200; tick++) {
        for (uint32_t i = 0; i < COUNT; i++) {
            const tahr_vec3 p = t.states[i].position;
            const double d = fmax(hypot(p.x, p.y), 1e-9);
            throng_go(&t, i, -p.x / d, -p.y / d);
            t.inputs[i].flags = turns ? (uint32_t)TAHR_INPUT_FACING : 0u;
            if (oracle_below(&dice, 20) == 0) {
                t.inputs[i].facing = dice_vec(&dice, -1, 1);
            }
        }
        assert_true(throng_step(&t) >= 0);
        for (uint32_t i = 0; i < COUNT; i++) {
            crushed += t.statuses[i] == TAHR_CRUSHED;
            for (uint32_t j = 0; j < i; j++) {
                if (is_deeper(&t, i, j) && t.statuses[i] != TAHR_CRUSHED && t.statuses[j] != TAHR_CRUSHED) {
                    fail_msg("seed %u, tick %d: %u is deeper in %u, and nobody says so", (unsigned)seed, tick, i, j);
                }
            }
        }
    }
    throng_close(&t);
    return crushed;
}

static void boxes_that_keep_their_facing_are_never_crushed(void **unused)
{
    (void)unused;
    assert_int_equal(press(1, 0), 0);
}

static void boxes_that_turn_overlap_only_where_they_say_so(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        press(seed, 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_that_keep_their_facing_are_never_crushed),
        cmocka_unit_test(boxes_that_turn_overlap_only_where_they_say_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

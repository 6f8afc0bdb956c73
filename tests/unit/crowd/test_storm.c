/* SPDX-License-Identifier: MIT
 * test_storm.c: a full room in which anything is asked of anybody: as long as nothing that moves squeezes them, nobody
 * gets deeper into another one, nobody into the room, and all that is said is finite. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "throng.h"

enum { COUNT = 48, WALLS = 8 };

/* A room of 9 x 9 x 6 m with two blocks in it to climb, and, if it moves, a lift and a slab that sweeps across. */
static uint32_t make_room(tahr_body_desc b[WALLS + 2], int moves)
{
    static const double at[WALLS][6] = {{0, 0, -1, 20, 20, 1}, {0, 0, 7, 20, 20, 1},     {-5.5, 0, 3, 1, 9, 5},
                                        {5.5, 0, 3, 1, 9, 5},  {0, -5.5, 3, 9, 1, 5},    {0, 5.5, 3, 9, 1, 5},
                                        {2, 2, 0, 1, 1, 0.3},  {-2, 1, 0.3, 1, 0.5, 0.5}};
    for (int i = 0; i < WALLS + 2; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        if (i < WALLS) {
            b[i].pose.position = (tahr_vec3){at[i][0], at[i][1], at[i][2]};
            b[i].half_extents = (tahr_vec3){at[i][3], at[i][4], at[i][5]};
        } else {
            b[i].flags = TAHR_BODY_MOVABLE;
            b[i].pose.position = i == WALLS ? (tahr_vec3){-2, -2, -0.3} : (tahr_vec3){0, 3, -0.2};
            b[i].half_extents = i == WALLS ? (tahr_vec3){1, 1, 0.31} : (tahr_vec3){1, 1, 0.3};
        }
    }
    return moves ? WALLS + 2 : WALLS;
}

static void ask(throng *t, uint32_t i, oracle_random *dice)
{
    tahr_input *in = &t->inputs[i];
    if (oracle_below(dice, 12) == 0) {
        *in = (tahr_input){.struct_size = sizeof *in, .move = dice_vec(dice, -1, 1)};
        in->jump = oracle_below(dice, 4) == 0;
        in->crouch = oracle_below(dice, 4) == 0;
    }
    in->flags = 0;
    if (oracle_below(dice, 60) == 0) {
        in->flags = TAHR_INPUT_LAUNCH;
        in->launch = dice_vec(dice, -25, 25);
    }
    if (oracle_below(dice, 20) == 0) {
        in->flags |= TAHR_INPUT_FACING;
        in->facing = dice_vec(dice, -1, 1);
    }
}

static void move_bodies(throng *t, int tick)
{
    const double lift = 0.5 - 0.5 * cos(0.02 * tick), slab = sin(0.01 * tick);
    tahr_body_pose poses[2] = {{.body = WALLS, .pose = {{-2, -2, -0.3 + 1.5 * lift}, {0, 0, 0, 1}}},
                               {.body = WALLS + 1, .pose = {{2 * slab, 3, -0.2}, {0, 0, 0, 1}}}};
    assert_int_equal(tahr_world_move(t->world, poses, 2, 1.0 / 60), TAHR_OK);
}

/* Is a character within the walls, and not in the floor or the ceiling? */
static int is_inside(const tahr_state *s)
{
    const tahr_vec3 p = s->position;
    return fabs(p.x) < 4.5 - s->radius + 1e-6 && fabs(p.y) < 4.5 - s->radius + 1e-6 && p.z > s->half_height - 1e-6 &&
           p.z < 6 - s->half_height + 1e-6;
}

static void storm(uint64_t seed, int ticks, int moves, uint32_t flags, int32_t preset)
{
    tahr_body_desc b[WALLS + 2];
    oracle_random dice = {seed};
    throng t;
    const uint32_t bodies = make_room(b, moves);
    throng_open(&t, b, bodies);
    t.desc.flags = flags;
    tahr_config_init(&t.config, sizeof t.config, preset);
    throng_make(&t, COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        throng_place(&t, i, 1.1 * (i % 7) - 3.4, 1.1 * (i / 7) - 3.4);
        t.states[i].position.z += 1.3;
        t.members[i].budget = i % 4 == 0 ? 0.1 : 0;
    }
    for (int tick = 0; tick < ticks; tick++) {
        if (moves) {
            move_bodies(&t, tick);
        }
        for (uint32_t i = 0; i < COUNT; i++) {
            ask(&t, i, &dice);
        }
        assert_true(throng_step(&t) >= 0);
        if (!moves && throng_deeper(&t) > 1e-6) {
            fail_msg("seed %u, tick %d: deeper by %g m", (unsigned)seed, tick, throng_deeper(&t));
        }
        for (uint32_t i = 0; i < COUNT; i++) {
            if (!is_inside(&t.states[i])) {
                const tahr_vec3 p = t.states[i].position;
                fail_msg("seed %u, tick %d: %u is at (%g, %g, %g)", (unsigned)seed, tick, i, p.x, p.y, p.z);
            }
        }
    }
    throng_close(&t);
}

static void in_a_room_nobody_gets_deeper_into_another_one(void **unused)
{
    (void)unused;
    storm(1, 300, 0, 0, TAHR_PRESET_PRECISE);
    storm(2, 300, 0, TAHR_CROWD_STAND_ON_HEADS, TAHR_PRESET_PRECISE);
    storm(107, 320, 0, TAHR_CROWD_STAND_ON_HEADS, TAHR_PRESET_UNREAL); /* one grows to twice its height in the air */
}

static void among_lifts_nobody_leaves_the_room(void **unused)
{
    (void)unused;
    storm(3, 300, 1, 0, TAHR_PRESET_PRECISE);
    storm(4, 300, 1, TAHR_CROWD_STAND_ON_HEADS, TAHR_PRESET_UNREAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_a_room_nobody_gets_deeper_into_another_one),
        cmocka_unit_test(among_lifts_nobody_leaves_the_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

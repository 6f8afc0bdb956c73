/* SPDX-License-Identifier: MIT
 * test_delay.c: distant characters take one step for several ticks: never farther off than their budget, never through
 * anything. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "near.h"
#include "throng.h"

enum { COUNT = 60, TICKS = 400 };

/* A step of several ticks and as many of one are the same closed form but for rounding, which no event makes larger. */
#define SAME 1e-9

static double off(const throng *a, const throng *b, uint32_t i)
{
    const tahr_vec3 p = a->states[i].position, q = b->states[i].position;
    return sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
}

/* New headings at random times, some of them to stand, for two crowds alike. */
static void wander(throng *a, throng *b, oracle_random *dice)
{
    for (uint32_t i = 0; i < COUNT; i++) {
        if (oracle_below(dice, 50) == 0) {
            const double speed = oracle_below(dice, 4) ? 1 : 0, turn = oracle_uniform(dice, 0, 6.28);
            throng_go(a, i, speed * cos(turn), speed * sin(turn));
            a->inputs[i].jump = oracle_below(dice, 3) == 0;
        }
    }
    memcpy(b->inputs, a->inputs, COUNT * sizeof *a->inputs);
}

static tahr_crowd_counts counts_of(const throng *t)
{
    tahr_crowd_counts counts = {.struct_size = sizeof counts};
    assert_int_equal(tahr_crowd_get_counts(t->crowd, &counts), TAHR_OK);
    return counts;
}

static void place(throng *t, double budget)
{
    throng_make(t, COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        t->members[i].budget = budget;
        t->members[i].flags = TAHR_MEMBER_ALONE;
        throng_place(t, i, 9.0 * (i % 8) - 31, 9.0 * (i / 8) - 31);
    }
}

static void on_open_ground_the_budget_holds(void **unused)
{
    static const double budgets[] = {0.003, 0.03, 0.3};
    (void)unused;
    for (int k = 0; k < 3; k++) {
        oracle_random dice = {(uint64_t)k + 1};
        throng exact, shown;
        double worst = 0;
        uint64_t deferred = 0;
        throng_open_ground(&exact);
        throng_open_ground(&shown);
        place(&exact, 0);
        place(&shown, budgets[k]);
        for (int tick = 0; tick < TICKS; tick++) {
            wander(&exact, &shown, &dice);
            throng_step(&exact);
            throng_step(&shown);
            for (uint32_t i = 0; i < COUNT; i++) {
                worst = fmax(worst, off(&exact, &shown, i));
                deferred += shown.reports[i].saved[TAHR_SHORTCUT_DEFERRED];
            }
        }
        assert_true(worst <= budgets[k] + SAME);
        assert_int_equal(deferred, counts_of(&shown).deferred);
        assert_true(deferred > COUNT * TICKS / 4); /* it was not for nothing, */
        assert_true(k == 0 || worst > 1e-4);       /* nor because nothing was shown */
        /* Left alone for longer than one step ahead takes, all come to where the exact ones are. */
        for (int tick = 0; tick < 60; tick++) {
            memset(exact.inputs, 0, sizeof *exact.inputs); /* the first one changes its mind once more */
            exact.inputs[0].struct_size = sizeof *exact.inputs;
            memcpy(shown.inputs, exact.inputs, COUNT * sizeof *exact.inputs);
            throng_step(&exact);
            throng_step(&shown);
        }
        assert_near(off(&exact, &shown, 0), 0, SAME);
        throng_close(&exact);
        throng_close(&shown);
    }
}

static void without_a_budget_not_a_bit_is_different(void **unused)
{
    oracle_random dice = {7};
    throng exact, other;
    (void)unused;
    throng_open_ground(&exact);
    throng_open_ground(&other);
    place(&exact, 0);
    place(&other, 0);
    exact.tick.delays = NULL;
    for (int tick = 0; tick < 100; tick++) {
        wander(&exact, &other, &dice);
        throng_step(&exact);
        throng_step(&other);
        assert_memory_equal(exact.states, other.states, COUNT * sizeof *exact.states);
    }
    assert_int_equal(counts_of(&other).deferred, 0);
    throng_close(&exact);
    throng_close(&other);
}

/* Thin walls in both directions, with gaps, and low steps. */
enum { WALLS = 40 };
static void make_maze(tahr_body_desc b[WALLS])
{
    oracle_random dice = {21};
    for (int i = 0; i < WALLS; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = i % 3 == 0 ? (tahr_vec3){3, 0.05, 2} : (tahr_vec3){0.05, 3, 2};
        b[i].half_extents = i % 5 == 4 ? (tahr_vec3){1.5, 1.5, 0.1 + 0.02 * (i % 8)} : b[i].half_extents;
        b[i].pose.position = (tahr_vec3){oracle_uniform(&dice, -35, 35), oracle_uniform(&dice, -35, 35), 0};
    }
    b[0].half_extents = (tahr_vec3){60, 60, 1};
    b[0].pose.position = (tahr_vec3){0, 0, -1};
}

/* m from a box to the axis of an upright capsule, less its radius: level and upright apart, as both are aligned. */
static double clearance(const tahr_body_desc *b, const tahr_state *s)
{
    const tahr_vec3 c = b->pose.position, h = b->half_extents, p = s->position;
    const double x = fmax(fabs(p.x - c.x) - h.x, 0), y = fmax(fabs(p.y - c.y) - h.y, 0);
    const double z = fmax(fabs(p.z - c.z) - h.z - (s->half_height - s->radius), 0);
    return sqrt(x * x + y * y + z * z) - s->radius;
}

static void among_walls_nobody_goes_through_and_the_budget_holds(void **unused)
{
    const double budget = 0.05;
    oracle_random dice = {5};
    tahr_body_desc b[WALLS];
    throng exact, shown;
    (void)unused;
    make_maze(b);
    throng_open(&exact, b, WALLS);
    throng_open(&shown, b, WALLS);
    place(&exact, 0);
    place(&shown, budget);
    for (uint32_t i = 0; i < COUNT; i++) { /* nobody begins inside of a wall */
        exact.states[i].position.z += 2.5;
        shown.states[i].position.z += 2.5;
    }
    uint32_t off_budget = 0;
    for (int tick = 0; tick < TICKS; tick++) {
        wander(&exact, &shown, &dice);
        throng_step(&exact);
        throng_step(&shown);
        for (uint32_t i = 0; i < COUNT; i++) {
            off_budget += off(&exact, &shown, i) > budget + 1e-6;
            for (int k = 0; k < WALLS; k++) {
                assert_true(clearance(&b[k], &shown.states[i]) > -1e-6);
            }
            /* No way of one tick is as long as a wall with its two skins is thick, so that none is jumped. */
            const tahr_vec3 p = shown.before[i].position, q = shown.states[i].position;
            assert_true(hypot(p.x - q.x, p.y - q.y) < 0.35 + 0.1);
        }
    }
    assert_int_equal(off_budget, 0);
    assert_true(counts_of(&shown).deferred > COUNT * TICKS / 5);
    throng_close(&exact);
    throng_close(&shown);
}

static void who_is_put_elsewhere_goes_on_from_there(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    place(&t, 0.5);
    for (int tick = 0; tick < 100; tick++) {
        throng_go(&t, 3, 1, 0);
        throng_step(&t);
        if (tick % 11 == 5) {
            const tahr_vec3 there = {50.0 + tick, 20, t.states[3].position.z};
            assert_int_equal(tahr_state_teleport(&t.states[3], &there), TAHR_OK);
            throng_step(&t);
            assert_true(fabs(t.states[3].position.x - there.x) < 0.1 && fabs(t.states[3].position.y - 20) < 1e-9);
        }
    }
    throng_close(&t);
}

static void who_comes_near_is_met(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    throng_make(&t, 2);
    t.members[0].budget = t.members[1].budget = 0.2;
    throng_place(&t, 0, -6, 0);
    throng_place(&t, 1, 6, 0);
    throng_go(&t, 0, 1, 0);
    throng_go(&t, 1, -1, 0);
    for (int tick = 0; tick < 200; tick++) {
        throng_step(&t);
        assert_true(throng_least_gap(&t) >= t.config.skin - 1e-9);
    }
    assert_true(counts_of(&t).deferred > 50);
    assert_true(throng_least_gap(&t) < 0.1);
    throng_close(&t);
}

/* A wall that comes along at 3 m/s pushes who is only shown on his way as it does any other. */
static void a_body_that_moves_in_is_met(void **unused)
{
    tahr_body_desc b[2];
    throng t;
    (void)unused;
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = i ? (tahr_vec3){0.5, 3, 2} : (tahr_vec3){60, 60, 1};
        b[i].pose.position = i ? (tahr_vec3){-14, 0, 0} : (tahr_vec3){0, 0, -1};
    }
    b[1].flags = TAHR_BODY_MOVABLE;
    throng_open(&t, b, 2);
    throng_make(&t, 1);
    t.members[0].budget = 0.5;
    throng_place(&t, 0, 0, 0);
    throng_go(&t, 0, 0, 0.1);
    for (int tick = 1; tick <= 360; tick++) {
        const double x = -14 + 0.05 * tick;
        tahr_body_pose pose = {.body = 1, .pose = {{x, 0, 0}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_world_move(t.world, &pose, 1, 1.0 / 60), TAHR_OK);
        throng_step(&t);
        assert_true(t.states[0].position.x > x + 0.5 + 0.35 - 1e-6);
    }
    assert_true(counts_of(&t).deferred > 20);
    assert_true(t.states[0].position.x > 4);
    throng_close(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_open_ground_the_budget_holds),
        cmocka_unit_test(without_a_budget_not_a_bit_is_different),
        cmocka_unit_test(among_walls_nobody_goes_through_and_the_budget_holds),
        cmocka_unit_test(who_is_put_elsewhere_goes_on_from_there),
        cmocka_unit_test(who_comes_near_is_met),
        cmocka_unit_test(a_body_that_moves_in_is_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

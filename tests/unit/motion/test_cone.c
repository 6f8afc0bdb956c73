/* SPDX-License-Identifier: MIT
 * test_cone.c: the projection against the conditions of Kuhn and Tucker and against brute force. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cone.h"
#include "dice.h"
#include "near.h"

/* Dykstra's alternating projection: slow, but shares nothing with enumeration, and converges to the nearest point. */
static vec3 dykstra(const tahr__plane *planes, uint32_t count, vec3 u)
{
    vec3 x = u, correction[TAHR__MAX_PLANES];
    memset(correction, 0, sizeof correction);
    for (int round = 0; round < 20000; round++) {
        vec3 before = x;
        for (uint32_t i = 0; i < count; i++) {
            vec3 y = add(x, correction[i]);
            double gap = planes[i].offset - dot(planes[i].normal, y);
            x = gap > 0 ? add_scaled(y, planes[i].normal, gap) : y;
            correction[i] = sub(y, x);
        }
        if (length(sub(x, before)) < 1e-15 && round > 200) {
            break;
        }
    }
    return x;
}

static void projection_is_the_nearest_feasible_point(void **unused)
{
    oracle_random seed = {3};
    (void)unused;
    for (int run = 0; run < 3000; run++) {
        tahr__plane planes[TAHR__MAX_PLANES];
        uint32_t count = 1 + (uint32_t)(run % 6);
        vec3 inside = scale(dice_direction(&seed), oracle_uniform(&seed, 0, 1)),
             u = scale(dice_direction(&seed), oracle_uniform(&seed, 0, 3)), x;
        for (uint32_t i = 0; i < count; i++) {
            memset(&planes[i], 0, sizeof planes[i]);
            planes[i].normal = dice_direction(&seed);
            planes[i].feature = i;
            planes[i].offset =
                run % 2 ? 0
                        : dot(planes[i].normal, inside) - oracle_uniform(&seed, 0, 0.5); /* a cone, or a polyhedron */
        }
        assert_int_equal(tahr__project(planes, count, u, &x), 1);
        for (uint32_t i = 0; i < count; i++) {
            assert_true(dot(planes[i].normal, x) >= planes[i].offset - 1e-9);
        }
        /* Never worse than brute force, where that has converged (in needle-thin cones it takes millions of rounds). */
        vec3 slow = dykstra(planes, count, u);
        double worst = 0;
        for (uint32_t i = 0; i < count; i++) {
            worst = max_of(worst, planes[i].offset - dot(planes[i].normal, slow));
        }
        if (worst < 1e-7) {
            assert_true(length(sub(x, u)) <= length(sub(slow, u)) + 1e-5);
        }
    }
}

static void feasible_wish_is_returned_bit_for_bit(void **unused)
{
    tahr__plane planes[2] = {{.normal = {0, 0, 1}}, {.normal = {1, 0, 0}, .feature = 1}};
    vec3 u = vec(0.1, -0.7, 0.3), x;
    (void)unused;
    assert_int_equal(tahr__project(planes, 2, u, &x), 1);
    assert_true(vec_equal(u, x));
    assert_int_equal(tahr__project(planes, 0, u, &x), 1);
    assert_true(vec_equal(u, x));
}

static void plane_and_crease_are_the_textbook_formulas(void **unused)
{
    double s = sqrt(0.5);
    tahr__plane planes[2] = {{.normal = {0, 0, 1}}, {.normal = {-s, s, 0}, .feature = 1}};
    vec3 x;
    (void)unused;
    tahr__project(planes, 1, vec(1, 2, -3), &x);
    assert_true(vec_equal(x, vec(1, 2, 0)));
    tahr__project(planes, 2, vec(2, 0, -3), &x); /* onto the crease (1, 1, 0) / sqrt 2 */
    assert_near(x.x, 1, 1e-15);
    assert_near(x.y, 1, 1e-15);
    assert_near(x.z, 0, 1e-15);
}

static void projection_never_lengthens_in_a_cone(void **unused)
{
    oracle_random seed = {5};
    (void)unused;
    for (int run = 0; run < 20000; run++) {
        tahr__plane planes[TAHR__MAX_PLANES];
        uint32_t count = 1 + (uint32_t)(run % 8);
        vec3 u = dice_direction(&seed), x;
        for (uint32_t i = 0; i < count; i++) {
            memset(&planes[i], 0, sizeof planes[i]);
            planes[i].normal = dice_direction(&seed);
        }
        tahr__project(planes, count, u, &x);
        assert_true(length(x) <= 1 + 1e-12);
        assert_true(dot(x, u) >= -1e-9); /* never against the wish */
    }
}

static void order_of_discovery_does_not_matter(void **unused)
{
    oracle_random seed = {9};
    (void)unused;
    for (int run = 0; run < 2000; run++) {
        tahr__plane a[TAHR__MAX_PLANES], b[TAHR__MAX_PLANES], all[8];
        uint32_t na = 0, nb = 0;
        vec3 u = dice_direction(&seed), xa, xb;
        for (uint32_t i = 0; i < 8; i++) {
            memset(&all[i], 0, sizeof all[i]);
            all[i].normal = dice_direction(&seed);
            all[i].body = i % 3;
            all[i].feature = i;
        }
        for (uint32_t i = 0; i < 8; i++) {
            tahr__planes_add(a, &na, &all[i]);
            tahr__planes_add(b, &nb, &all[7 - i]);
        }
        assert_int_equal(na, 8);
        assert_memory_equal(a, b, sizeof a[0] * na);
        tahr__project(a, na, u, &xa);
        tahr__project(b, nb, u, &xb);
        assert_true(vec_equal(xa, xb));
    }
}

static void same_feature_replaces_and_parallel_merges_to_the_tighter(void **unused)
{
    tahr__plane set[TAHR__MAX_PLANES], p = {.normal = {0, 0, 1}, .offset = 1, .body = 1, .feature = 2};
    uint32_t count = 0;
    (void)unused;
    tahr__planes_add(set, &count, &p);
    p.normal = vec(0, 1, 0);
    tahr__planes_add(set, &count, &p); /* the same feature, seen anew */
    assert_int_equal(count, 1);
    assert_true(set[0].normal.y == 1);
    p.feature = 3, p.offset = 2;
    tahr__planes_add(set, &count, &p);
    assert_int_equal(count, 1);
    assert_true(set[0].offset == 2 && set[0].feature == 3);
    p.feature = 4, p.offset = 1.5;
    tahr__planes_add(set, &count, &p);
    assert_int_equal(count, 1);
    assert_true(set[0].offset == 2);
}

static void a_full_set_takes_no_more(void **unused)
{
    tahr__plane set[TAHR__MAX_PLANES];
    oracle_random seed = {1};
    uint32_t count = 0;
    (void)unused;
    for (uint32_t i = 0; i < 40; i++) {
        tahr__plane p = {.normal = dice_direction(&seed), .feature = i};
        tahr__planes_add(set, &count, &p);
    }
    assert_int_equal(count, TAHR__MAX_PLANES);
    for (uint32_t i = 0; i < count; i++) { /* the first ones stay */
        assert_int_equal(set[i].feature, i);
    }
}

/* robustness: a corridor of half width 0.28 for a radius of 0.30, 3 mm off centre: the answer is the middle. */
static void empty_intersection_gives_the_least_squares_point(void **unused)
{
    tahr__plane walls[3] = {{.normal = {1, 0, 0}, .offset = 0.02 - 0.003},
                            {.normal = {-1, 0, 0}, .offset = 0.02 + 0.003, .feature = 1},
                            {.normal = {0, 0, 1}, .offset = 0, .feature = 2}};
    vec3 x;
    (void)unused;
    assert_int_equal(tahr__project(walls, 3, vec(0, 0, 0), &x), 0);
    assert_near(x.x, -0.003, 1e-7);
    assert_near(x.y, 0, 1e-12);
    assert_near(x.z, 0, 1e-12);
}

static double violation(const tahr__plane *planes, uint32_t count, vec3 x)
{
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        double v = planes[i].offset - dot(planes[i].normal, x);
        sum += v > 0 ? v * v : 0;
    }
    return sum;
}

static void least_squares_beats_every_neighbour(void **unused)
{
    oracle_random seed = {21};
    int empty = 0;
    (void)unused;
    for (int run = 0; run < 2000; run++) {
        tahr__plane planes[8];
        uint32_t count = 4 + (uint32_t)(run % 5);
        vec3 x;
        for (uint32_t i = 0; i < count; i++) {
            memset(&planes[i], 0, sizeof planes[i]);
            planes[i].normal = dice_direction(&seed);
            planes[i].offset = oracle_uniform(&seed, 0, 0.1);
            planes[i].feature = i;
        }
        if (tahr__project(planes, count, vec(0, 0, 0), &x)) {
            continue;
        }
        empty++;
        double here = violation(planes, count, x);
        for (int k = 0; k < 200; k++) {
            vec3 y = add_scaled(x, dice_direction(&seed), oracle_uniform(&seed, 0, 0.02));
            assert_true(violation(planes, count, y) >= here - 1e-7);
        }
    }
    assert_true(empty > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(projection_is_the_nearest_feasible_point),
                                       cmocka_unit_test(feasible_wish_is_returned_bit_for_bit),
                                       cmocka_unit_test(plane_and_crease_are_the_textbook_formulas),
                                       cmocka_unit_test(projection_never_lengthens_in_a_cone),
                                       cmocka_unit_test(order_of_discovery_does_not_matter),
                                       cmocka_unit_test(same_feature_replaces_and_parallel_merges_to_the_tighter),
                                       cmocka_unit_test(a_full_set_takes_no_more),
                                       cmocka_unit_test(empty_intersection_gives_the_least_squares_point),
                                       cmocka_unit_test(least_squares_beats_every_neighbour)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

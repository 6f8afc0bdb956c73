/* SPDX-License-Identifier: MIT
 * test_apart.c: the direction and the gap between two shapes, against convexity: nothing but support functions written
 * again in long double, and a search over directions. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "apart.h"
#include "dice.h"
#include "near.h"

typedef long double real;

/* The farthest of the points of a shape along d, found from what it is made of: corners, rims cut into many, caps. */
static real reach(const tahr__solid *s, tahr_vec3 d)
{
    const tahr_shape *h = s->shape;
    const tahr_vec3 x = rotate(s->orientation, (tahr_vec3){1, 0, 0}), y = rotate(s->orientation, (tahr_vec3){0, 1, 0});
    const real dx = dot(d, x), dy = dot(d, y), dz = dot(d, s->up), size = sqrtl(dx * dx + dy * dy + dz * dz);
    const real across = sqrtl(dx * dx + dy * dy), high = h->half_height;
    switch (h->type) {
    case TAHR_SHAPE_SPHERE: return h->radius * size;
    case TAHR_SHAPE_CAPSULE: return h->radius * size + (high - h->radius) * fabsl(dz);
    case TAHR_SHAPE_CYLINDER: return h->radius * across + high * fabsl(dz);
    case TAHR_SHAPE_CONE: return fmaxl(high * dz, h->radius * across - high * dz);
    case TAHR_SHAPE_ELLIPSOID: return sqrtl(powl(h->half_x * dx, 2) + powl(h->half_y * dy, 2) + powl(high * dz, 2));
    default: return h->half_x * fabsl(dx) + h->half_y * fabsl(dy) + high * fabsl(dz);
    }
}

static real gap_along(const tahr__solid *a, const tahr__solid *b, tahr_vec3 c, tahr_vec3 n)
{
    return (real)dot(n, c) - reach(a, scale(n, -1)) - reach(b, n);
}

/* The gap is the largest over all directions, and on the sphere of directions with a positive one it has no second
 * summit: whoever is not on it finds a way up, among directions at random, nearer and nearer. */
static real climb(const tahr__solid *a, const tahr__solid *b, tahr_vec3 c, tahr_vec3 from, oracle_random *dice)
{
    tahr_vec3 best = from;
    real most = gap_along(a, b, c, best);
    for (double stride = 0.5; stride > 1e-8;) {
        int better = 0;
        for (int k = 0; k < 24; k++) {
            const tahr_vec3 n = unit(add_scaled(best, dice_direction(dice), stride));
            const real now = gap_along(a, b, c, n);
            if (now > most) {
                most = now;
                best = n;
                better++;
            }
        }
        stride = better > 4 ? stride : 0.6 * stride;
    }
    return most;
}

static tahr_shape shape_of(uint32_t type, oracle_random *dice)
{
    tahr_shape s = {.type = type, .half_height = oracle_uniform(dice, 0.5, 1.2)};
    if (type == TAHR_SHAPE_BOX || type == TAHR_SHAPE_ELLIPSOID) {
        s.half_x = oracle_uniform(dice, 0.2, 0.6);
        s.half_y = oracle_uniform(dice, 0.2, 0.6);
    } else {
        s.radius = oracle_uniform(dice, 0.2, 0.45);
        s.half_height = type == TAHR_SHAPE_SPHERE ? s.radius : s.half_height;
    }
    return s;
}

/* Upright, as most are, turned about its axis; every third leans. */
static tahr__solid solid_of(const tahr_shape *shape, oracle_random *dice, int leans)
{
    tahr_vec3 up = leans ? dice_direction(dice) : (tahr_vec3){0, 0, 1};
    tahr_quat lean = quat_between((tahr_vec3){0, 0, 1}, up);
    const double turn = oracle_uniform(dice, 0, 3);
    tahr_quat yaw = {0, 0, sin(turn), cos(turn)};
    return (tahr__solid){shape, up, quat_multiply(lean, yaw)};
}

/* A gap that is too large lets two meet, whatever the direction; one that is too small keeps them from each other. */
static void gap_is_the_distance_for_every_pair_of_shapes(void **unused)
{
    oracle_random dice = {3};
    (void)unused;
    for (uint32_t i = 0; i < 1500; i++) {
        const uint32_t p = 1 + i % 6, q = 1 + i / 6 % 6;
        const tahr_shape sa = shape_of(p, &dice), sb = shape_of(q, &dice);
        const tahr__solid a = solid_of(&sa, &dice, i % 3 == 0), b = solid_of(&sb, &dice, i % 3 == 0);
        const tahr_vec3 c = scale(dice_direction(&dice), oracle_uniform(&dice, 0.3, 4));
        const tahr__apart r = tahr__apart_of(&a, &b, c, 0);
        assert_near(length(r.normal), 1, 1e-12);
        assert_near(r.gap, (double)gap_along(&a, &b, c, r.normal), 1e-12);
        assert_near(r.extent, (double)reach(&b, r.normal), 1e-12);
        const real truth = fmaxl(climb(&a, &b, c, r.normal, &dice), climb(&a, &b, c, unit(c), &dice));
        if (truth > 1e-6) {
            assert_true(r.gap > (double)truth - 1e-7);
        } else {
            assert_true(r.gap < 1e-6); /* out of an overlap: any direction will do that leads out */
        }
    }
}

static void spheres_and_capsules_are_exact(void **unused)
{
    const tahr_shape capsule = {.type = TAHR_SHAPE_CAPSULE, .radius = 0.25, .half_height = 1};
    const tahr_shape sphere = {.type = TAHR_SHAPE_SPHERE, .radius = 0.5, .half_height = 0.5};
    const tahr__solid a = {&capsule, {0, 0, 1}, {0, 0, 0, 1}}, b = {&sphere, {0, 0, 1}, {0, 0, 0, 1}};
    (void)unused;
    /* The lower end of the axis at 0.75 m below c: (3, 4, 0) from the sphere's centre, 5 m; radii 0.75 m. */
    tahr__apart r = tahr__apart_of(&a, &b, (tahr_vec3){3, 4, 0.75}, 0);
    assert_near(r.gap, 4.25, 1e-15);
    assert_near(r.normal.x, 0.6, 1e-15);
    assert_near(r.normal.y, 0.8, 1e-15);
    /* Beside the straight part: level. */
    r = tahr__apart_of(&a, &b, (tahr_vec3){-2, 0, 0.3}, 0);
    assert_near(r.gap, 1.25, 1e-15);
    assert_near(r.normal.x, -1, 0);
    /* Overlapping by 0.15 m: the same formula, negative. */
    r = tahr__apart_of(&a, &b, (tahr_vec3){0, 0.6, 0}, 0);
    assert_near(r.gap, -0.15, 1e-15);
}

static void in_two_dimensions_the_third_counts_nowhere(void **unused)
{
    oracle_random dice = {9};
    (void)unused;
    for (uint32_t i = 0; i < 300; i++) {
        const tahr_shape sa = shape_of(1 + i % 3, &dice), sb = shape_of(1 + i / 3 % 3, &dice);
        const tahr_quat upright = {0, 0, 0, 1};
        const tahr__solid a = {&sa, {0, 1, 0}, upright}, b = {&sb, {0, 1, 0}, upright};
        tahr_vec3 c = scale(dice_direction(&dice), oracle_uniform(&dice, 0, 3));
        const tahr__apart r = tahr__apart_of(&a, &b, c, 1);
        c.z = 0;
        const tahr__apart flat = tahr__apart_of(&a, &b, c, 1);
        assert_near(r.normal.z, 0, 0);
        assert_near(r.gap, flat.gap, 0);
    }
}

static void whoever_is_first_both_find_the_same_plane(void **unused)
{
    oracle_random dice = {5};
    (void)unused;
    for (uint32_t i = 0; i < 500; i++) {
        const tahr_shape sa = shape_of(1 + i % 2, &dice), sb = shape_of(1 + i / 2 % 2, &dice);
        const tahr__solid a = solid_of(&sa, &dice, 1), b = solid_of(&sb, &dice, 1);
        const tahr_vec3 c = scale(dice_direction(&dice), oracle_uniform(&dice, 0.5, 3));
        const tahr__apart r = tahr__apart_of(&a, &b, c, 0), s = tahr__apart_of(&b, &a, scale(c, -1), 0);
        assert_near(r.gap, s.gap, 1e-9);
        if (r.gap > 0.01) {
            assert_near(length(add(r.normal, s.normal)), 0, 1e-7);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gap_is_the_distance_for_every_pair_of_shapes),
        cmocka_unit_test(spheres_and_capsules_are_exact),
        cmocka_unit_test(in_two_dimensions_the_third_counts_nowhere),
        cmocka_unit_test(whoever_is_first_both_find_the_same_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

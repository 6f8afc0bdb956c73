/* SPDX-License-Identifier: MIT
 * test_arc.c: where the arc of a fall meets a plane, against the root of the quadratic equation that says so. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "arc.h"
#include "dice.h"

/* A parabola: no wish, nothing that brakes, no terminal speed that it comes near. */
static tahr__arc parabola(vec3 level, double rise, double gravity)
{
    tahr__arc a;
    memset(&a, 0, sizeof a);
    a.axis = vec(0, 0, 1);
    a.level = level;
    a.rise = rise;
    a.gravity = gravity;
    a.terminal = 1000;
    return a;
}

/* The first root of (g n.z / 2) t^2 - v t - d = 0 for a way that approaches: v <= 0 is the speed along n, d = -goal. In
 * long double, by the form that does not cancel. */
static double truth(const tahr__arc *a, vec3 n, double goal)
{
    const long double v = (long double)n.x * a->level.x + (long double)n.y * a->level.y + (long double)n.z * a->rise;
    const long double half = 0.5L * n.z * a->gravity;
    return (double)(2 * -goal / (-v + sqrtl(v * v + 4 * half * -goal)));
}

/* The same Newton without anything remembered of its rounds. */
static double all_rounds(const tahr__arc *a, vec3 n, double goal, double duration)
{
    double low = 0, high = duration, t = 0.5 * duration;
    for (int i = 0; i < 24; i++) {
        vec3 v;
        const double value = dot(n, tahr__arc_at(a, t, &v)) - goal, slope = dot(n, v);
        *(value > 0 ? &low : &high) = t;
        double next = slope < 0 ? t - value / slope : 0.5 * (low + high);
        next = next >= low && next <= high ? next : 0.5 * (low + high);
        if (next == t) {
            break;
        }
        t = next;
    }
    return t;
}

static void check(const tahr__arc *a, vec3 n, double goal, double duration)
{
    const double t = truth(a, n, goal);
    if (!(t > 0 && t < duration)) {
        return;
    }
    const tahr__arc_point met = tahr__arc_meet(a, n, scale(n, goal), duration);
    vec3 v, way = tahr__arc_at(a, met.t, &v);
    assert_true(fabs(met.t - t) <= 1e-9 * t);
    assert_true(met.t == all_rounds(a, n, dot(n, scale(n, goal)), duration));
    assert_true(fabs(dot(n, way) - goal) <= 4e-16 * (length(way) + fabs(goal)));
    assert_memory_equal(&met.way, &way, sizeof way);
    assert_memory_equal(&met.velocity, &v, sizeof v);
}

static void an_arc_meets_a_plane_at_the_root_of_its_equation(void **unused)
{
    oracle_random dice = {7};
    int met = 0;
    (void)unused;
    for (int i = 0; i < 20000; i++) {
        const vec3 n = dice_direction(&dice), level = dice_vec(&dice, -6, 6);
        const tahr__arc a = parabola(vec(level.x, level.y, 0), oracle_uniform(&dice, -8, 4), 9.81);
        const double goal = -pow(10, oracle_uniform(&dice, -8, -0.5));
        if (n.z > 0.05 && dot(n, vec(a.level.x, a.level.y, a.rise)) < 0) {
            check(&a, n, goal, 1.0 / 60);
            met++;
        }
    }
    assert_true(met > 2000);
}

/* Along a face, as after a slide, and pulled into it: the root is that of a square, to which a Newton only halves. */
static void an_arc_that_leaves_a_plane_flat_meets_it_again(void **unused)
{
    (void)unused;
    for (double depth = 1e-12; depth < 1e-3; depth *= 7) {
        const tahr__arc a = parabola(vec(3, 1, 0), 0, 9.81);
        check(&a, vec(0, 0, 1), -depth, 1.0 / 60);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_arc_meets_a_plane_at_the_root_of_its_equation),
        cmocka_unit_test(an_arc_that_leaves_a_plane_flat_meets_it_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

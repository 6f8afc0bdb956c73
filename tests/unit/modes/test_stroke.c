/* SPDX-License-Identifier: MIT
 * test_stroke.c: the linear equation of swimming against a numeric solution of it (Runge-Kutta in long double), from no
 * damping at all to honey. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "near.h"
#include "stroke.h"

static const double DRAGS[] = {0, 1e-9, 0.3, 3, 6.83, 25, 400};
static const double SPRINGS[] = {0, 1e-7, 0.5, 5.45, 38};
enum { DRAG_COUNT = sizeof DRAGS / sizeof DRAGS[0], SPRING_COUNT = sizeof SPRINGS / sizeof SPRINGS[0] };

static tahr__stroke stroke(double drag, double spring)
{
    tahr__stroke s = {
        .up = {0, 0, 1}, .target = {1.5, -0.5, 0}, .rate = drag, .drag = drag, .push = 4.7, .spring = spring};
    return s;
}

/* The classic method of fourth order in n steps. */
static void solve(const tahr__stroke *s, double v0, double t, int n, long double *z, long double *v)
{
    long double h = (long double)t / n, k = s->drag, a = s->push, w = s->spring;
    *z = 0;
    *v = v0;
    for (int i = 0; i < n; i++) {
        long double z1 = *v, v1 = a - k * *v - w * *z;
        long double z2 = *v + h / 2 * v1, v2 = a - k * z2 - w * (*z + h / 2 * z1);
        long double z3 = *v + h / 2 * v2, v3 = a - k * z3 - w * (*z + h / 2 * z2);
        long double z4 = *v + h * v3, v4 = a - k * z4 - w * (*z + h * z3);
        *z += h / 6 * (z1 + 2 * z2 + 2 * z3 + z4);
        *v += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    }
}

static void a_stroke_solves_its_equation(void **unused)
{
    (void)unused;
    for (int d = 0; d < DRAG_COUNT; d++) {
        for (int k = 0; k < SPRING_COUNT; k++) {
            const tahr__stroke s = stroke(DRAGS[d], SPRINGS[k]);
            double t = fmin(tahr__stroke_longest(&s), 0.4);
            long double z, v;
            tahr_vec3 then, way = tahr__stroke_at(&s, vec(-2, 1, -1.25), t, &then);
            solve(&s, -1.25, t, 20000, &z, &v);
            assert_near(way.z, (double)z, 1e-12);
            assert_near(then.z, (double)v, 1e-11);
            double f = DRAGS[d], left = exp(-f * t), mean = f > 0 ? -expm1(-f * t) / f : t;
            assert_near(way.x, 1.5 * t - 3.5 * mean, 1e-12);
            assert_near(then.y, -0.5 + 1.5 * left, 1e-12);
        }
    }
}

static void two_halves_are_the_whole(void **unused)
{
    (void)unused;
    for (int d = 0; d < DRAG_COUNT; d++) {
        for (int k = 0; k < SPRING_COUNT; k++) {
            tahr__stroke s = stroke(DRAGS[d], SPRINGS[k]);
            double t = fmin(tahr__stroke_longest(&s), 2);
            tahr_vec3 v = vec(1, 2, 3), whole_v, v1, v2;
            tahr_vec3 whole = tahr__stroke_at(&s, v, t, &whole_v), first = tahr__stroke_at(&s, v, 0.3 * t, &v1);
            s.push -= s.spring * first.z; /* what is carried there */
            tahr_vec3 second = tahr__stroke_at(&s, v1, 0.7 * t, &v2);
            assert_near(first.z + second.z, whole.z, 1e-12);
            assert_near(first.x + second.x, whole.x, 1e-12);
            assert_near(v2.z, whole_v.z, 1e-12);
        }
    }
}

/* The first time outside, against a fine walk along it. */
static void a_stroke_is_seen_to_leave_where_it_first_does(void **unused)
{
    oracle_random seed = {5};
    int left = 0;
    (void)unused;
    for (int round = 0; round < 2000; round++) {
        tahr__stroke s = stroke(DRAGS[oracle_below(&seed, DRAG_COUNT)], SPRINGS[oracle_below(&seed, SPRING_COUNT)]);
        s.push = oracle_uniform(&seed, -20, 20);
        tahr_vec3 v = vec(0, 0, oracle_uniform(&seed, -3, 3)), then;
        double t = fmin(tahr__stroke_longest(&s), 0.3);
        double low = -oracle_uniform(&seed, 0, 0.2), high = oracle_uniform(&seed, 0, 0.2);
        double at = tahr__stroke_leaves(&s, v, t, low, high), first = t;
        for (int i = 1; i <= 2000 && first == t; i++) {
            double z = tahr__stroke_at(&s, v, t * i / 2000, &then).z;
            first = z < low || z > high ? t * i / 2000 : t;
        }
        left += at < t;
        assert_true(at <= first && at >= first - t / 2000 * 1.001);
        if (at < t) {
            double z = tahr__stroke_at(&s, v, at, &then).z;
            assert_near(z, z > 0 ? high : low, 1e-12);
        }
    }
    assert_true(left > 500);
}

static void a_part_of_the_way_is_covered_at_its_time(void **unused)
{
    (void)unused;
    for (int d = 0; d < DRAG_COUNT; d++) {
        tahr__stroke s = stroke(DRAGS[d], 0);
        tahr_vec3 v = vec(1, 0.2, 2), then, whole = tahr__stroke_at(&s, v, 0.5, &then);
        for (double part = 0.1; part < 1; part += 0.2) {
            double t = tahr__stroke_time(&s, v, 0.5, whole, part);
            tahr_vec3 way = tahr__stroke_at(&s, v, t, &then);
            assert_near(dot(way, whole) / dot(whole, whole), part, 1e-12);
        }
        assert_true(tahr__stroke_time(&s, v, 0.5, whole, 0) == 0 && tahr__stroke_time(&s, v, 0.5, whole, 1) == 0.5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stroke_solves_its_equation),
        cmocka_unit_test(two_halves_are_the_whole),
        cmocka_unit_test(a_stroke_is_seen_to_leave_where_it_first_does),
        cmocka_unit_test(a_part_of_the_way_is_covered_at_its_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

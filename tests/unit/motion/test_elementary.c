/* SPDX-License-Identifier: MIT
 * test_elementary.c: the elementary functions against libm in long double. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "elementary.h"
#include "near.h"

/* Error in units of the last place of the true value. */
static double ulps(double got, long double truth)
{
    double t = (double)truth;
    int e;
    if (t == 0) {
        return got == 0 ? 0 : 1e300;
    }
    (void)frexp(t, &e);
    return (double)(fabsl((long double)got - truth) / ldexpl(1, e - DBL_MANT_DIG));
}

static void expm1_is_within_two_ulp(void **unused)
{
    double worst = 0;
    (void)unused;
    for (int i = -40000; i <= 40000; i++) {
        double x = i * 0.0171234567;
        double error = ulps(tahr__expm1(x), expm1l((long double)x));
        worst = error > worst ? error : worst;
        double small = ldexp(1 + (i & 1023) / 1024.0, -(abs(i) % 1000)) * (i < 0 ? -1 : 1);
        error = ulps(tahr__expm1(small), expm1l((long double)small));
        worst = error > worst ? error : worst;
    }
    assert_near(worst, 0, 2);
}

static void log1p_is_within_two_ulp(void **unused)
{
    double worst = 0;
    (void)unused;
    for (int i = 0; i <= 80000; i++) {
        double x = -1 + ldexp(1 + (i & 255) / 256.0, i / 256 % 1000 - 50);
        double small = ldexp(1 + (i & 1023) / 1024.0, -(i % 1000) - 1) * (i & 1 ? -1 : 1);
        double near = -0.9999 + i * 0.0001;
        double tries[] = {x, small, near};
        for (int k = 0; k < 3; k++) {
            double error = ulps(tahr__log1p(tries[k]), log1pl((long double)tries[k]));
            worst = error > worst ? error : worst;
        }
    }
    assert_near(worst, 0, 2);
}

static void sine_and_cosine_are_within_two_ulp_of_one(void **unused)
{
    double worst = 0;
    (void)unused;
    for (int i = -40000; i <= 40000; i++) {
        double x = i * 1e-4, s, c;
        tahr__sincos(x, &s, &c);
        double es = (double)fabsl((long double)s - sinl((long double)x));
        double ec = (double)fabsl((long double)c - cosl((long double)x));
        worst = es > worst ? es : worst;
        worst = ec > worst ? ec : worst;
    }
    assert_near(worst, 0, 2 * DBL_EPSILON);
}

static void zero_gives_exact_zero(void **unused)
{
    double s, c;
    (void)unused;
    tahr__sincos(0, &s, &c);
    assert_true(tahr__expm1(0) == 0 && tahr__log1p(0) == 0 && s == 0 && c == 1);
}

static void expm1_and_log1p_are_inverse(void **unused)
{
    (void)unused;
    for (int i = 1; i < 2000; i++) {
        double x = i * 0.01;
        assert_near(tahr__log1p(tahr__expm1(x)), x, 4 * DBL_EPSILON * x + 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expm1_is_within_two_ulp), cmocka_unit_test(log1p_is_within_two_ulp),
        cmocka_unit_test(sine_and_cosine_are_within_two_ulp_of_one), cmocka_unit_test(zero_gives_exact_zero),
        cmocka_unit_test(expm1_and_log1p_are_inverse)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

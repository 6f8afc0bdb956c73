/* SPDX-License-Identifier: MIT
 * elementary.c: expm1, log1p, sine and cosine from range reduction and series. */
#include "elementary.h"

#include <stdint.h>
#include <string.h>

#include "vec.h"

/* ln 2 in two parts: the high one has 32 zero bits at its end, so that k * LN2_HIGH is exact for |k| < 2^11. */
static const double LN2_HIGH = 6.93147180369123816490e-01;
static const double LN2_LOW = 1.90821492927058770002e-10;
static const double INVERSE_LN2 = 1.44269504088896338700e+00;

static double power_of_two(int k)
{
    uint64_t bits = (uint64_t)(1023 + k) << 52;
    double result;
    memcpy(&result, &bits, sizeof result);
    return result;
}

/* Taylor series of e^r - 1 for |r| <= ln 2 / 2: the first term left out is r^15 / 15! < 1e-19. */
static double expm1_series(double r)
{
    static const double inverse_factorial[] = {0.5,
                                               0.16666666666666666,
                                               0.041666666666666664,
                                               0.008333333333333333,
                                               0.001388888888888889,
                                               0.0001984126984126984,
                                               2.48015873015873e-05,
                                               2.7557319223985893e-06,
                                               2.755731922398589e-07,
                                               2.505210838544172e-08,
                                               2.08767569878681e-09,
                                               1.6059043836821613e-10,
                                               1.1470745597729725e-11};
    double sum = inverse_factorial[12];
    for (int n = 11; n >= 0; n--) {
        sum = inverse_factorial[n] + sum * r;
    }
    return r + r * r * sum; /* the first term stays exact */
}

double tahr__expm1(double x)
{
    if (x > -0.34 && x < 0.34) {
        return expm1_series(x);
    }
    double shifted = x * INVERSE_LN2;
    int k = (int)(shifted < 0 ? shifted - 0.5 : shifted + 0.5);
    double r = (x - k * LN2_HIGH) - k * LN2_LOW;
    double e = expm1_series(r);
    if (k == 0) {
        return e;
    }
    if (k < -60) {
        return -1;
    }
    double p = power_of_two(k);
    return p * e + (p - 1);
}

/* 2 atanh(s) = ln((1 + s) / (1 - s)) with s = f / (2 + f), for 1 + f between sqrt 1/2 and sqrt 2. |s| <= 0.172:
 * 0.0295^12 / 25 < 1e-19; for s^2 < 1e-5 three terms do: 1e-20 / 9. */
static double log1p_series(double f)
{
    static const double inverse_odd[] = {0.3333333333333333,   0.2,
                                         0.14285714285714285,  0.1111111111111111,
                                         0.09090909090909091,  0.07692307692307693,
                                         0.06666666666666667,  0.058823529411764705,
                                         0.05263157894736842,  0.047619047619047616,
                                         0.043478260869565216, 0.04};
    double s = f / (2 + f);
    double z = s * s;
    double sum = 0;
    for (int n = z < 1e-5 ? 2 : 11; n >= 0; n--) {
        sum = (sum + inverse_odd[n]) * z;
    }
    return 2 * s + 2 * s * sum;
}

double tahr__log1p(double x)
{
    if (x > -0.29 && x < 0.41) {
        return log1p_series(x); /* x is exact, 1 + x is not */
    }
    double u = 1 + x;
    double lost = u - 1 == x ? 0 : (x - (u - 1)) / u; /* what rounding 1 + x threw away, relative to u */
    uint64_t bits;
    memcpy(&bits, &u, sizeof bits);
    int k = (int)(bits >> 52) - 1023;
    double f;
    bits = (bits & 0x000FFFFFFFFFFFFFu) | ((uint64_t)1023 << 52);
    memcpy(&f, &bits, sizeof f);
    if (f > 1.41421356237309514547) {
        f *= 0.5;
        k++;
    }
    return k * LN2_HIGH + (log1p_series(f - 1) + (lost + k * LN2_LOW));
}

/* Reduction by quarter turns, then Taylor series for |r| <= pi / 4: r^19 / 19! < 1e-19. */
void tahr__sincos(double x, double *sine, double *cosine)
{
    /* pi / 2 in two parts, the high one with 32 zero bits at its end. */
    const double high = 1.57079632673412561417e+00, low = 6.07710050650619224932e-11;
    double quarters = x * 6.36619772367581382433e-01;
    int k = (int)(quarters < 0 ? quarters - 0.5 : quarters + 0.5);
    double r = (x - k * high) - k * low;
    double z = -r * r, s = 1, c = 1;
    for (int n = 8; n >= 1; n--) {
        s = 1 + s * z / (2 * n * (2 * n + 1));
        c = 1 + c * z / (2 * n * (2 * n - 1));
    }
    s *= r;
    *sine = k & 1 ? c : s;
    *cosine = k & 1 ? s : c;
    if (k & 2) {
        *sine = -*sine;
    }
    if ((k + 1) & 2) {
        *cosine = -*cosine;
    }
}

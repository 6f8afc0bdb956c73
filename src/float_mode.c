/* SPDX-License-Identifier: MIT
 * float_mode.c: probes contraction, rounding and flushing to zero at run time. Host programs set these flags behind a
 * library's back (crtfastmath at load, an audio thread's denormal switch), and FMA contraction alone moves a slide by
 * centimetres. */
#include "float_mode.h"

#include <float.h>

#include "vec.h"

static double contracted(volatile double *x)
{
    double a = *x;
    return a * a - 1.0; /* (1 + 2^-30)^2 - 1: the 2^-60 survives only in a fused multiply-add */
}

const char *tahr__float_mode_problem(void)
{
    volatile double x = 1 + 1.0 / (1 << 30);
    volatile double one = 1, half_ulp = DBL_EPSILON / 2, more = DBL_EPSILON * 0.75, small = DBL_MIN;
    if (contracted(&x) != 1.0 / (1 << 29)) {
        return "multiplications and additions are contracted (build with -ffp-contract=off)";
    }
    volatile double down = one + half_ulp, up = one + more, minus = -one - more;
    if (down != 1 || up == 1 || minus == -1) {
        return "rounding is not to nearest";
    }
    volatile double tiny = small * 0.5;
    if (tiny == 0) {
        return "denormal numbers are flushed to zero";
    }
    volatile float narrow = 1.0f, epsilon = FLT_EPSILON / 2;
    volatile float sum = narrow + epsilon + epsilon;
    return sum != 1.0f ? "float expressions are evaluated with more precision (x87)" : 0;
}

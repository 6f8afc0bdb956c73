/* SPDX-License-Identifier: MIT
 * near.c: see near.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"

void near_assert(double a, double b, double tolerance, const char *what, const char *file, int line)
{
    if (!(fabs(a - b) <= tolerance)) {
        print_error("%s: %.17g and %.17g differ by %.3g, more than %.3g\n", what, a, b, a - b, tolerance);
        _fail(file, line);
    }
}

/* SPDX-License-Identifier: MIT
 * test_float_mode.c: a floating-point environment that would change the bits is noticed when a world is opened. */
#include <fenv.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"
#include "float_mode.h"

static void the_test_machine_is_fit(void **unused)
{
    (void)unused;
    assert_null(tahr__float_mode_problem());
}

static void other_rounding_modes_are_noticed(void **unused)
{
    const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    (void)unused;
    for (int i = 0; i < 3; i++) {
        fake_world w;
        tahr_callbacks c = fake_callbacks(&w);
        tahr_world *world = NULL;
        assert_int_equal(fesetround(modes[i]), 0);
        const char *problem = tahr__float_mode_problem();
        tahr_status status = tahr_world_open_callbacks(&c, NULL, &world);
        fesetround(FE_TONEAREST);
        assert_non_null(problem);
        assert_int_equal(status, TAHR_E_FLOAT_MODE);
        assert_null(world);
    }
}

#ifdef __SSE2__
#include <xmmintrin.h>
static void flushing_to_zero_is_noticed(void **unused)
{
    (void)unused;
    unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8000u);
    const char *flushed = tahr__float_mode_problem();
    _mm_setcsr(before | 0x0040u);
    const char *denormals_are_zero = tahr__float_mode_problem();
    _mm_setcsr(before);
    assert_non_null(flushed);
    assert_non_null(denormals_are_zero);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
#ifdef __SSE2__
        cmocka_unit_test(flushing_to_zero_is_noticed),
#endif
        cmocka_unit_test(the_test_machine_is_fit), cmocka_unit_test(other_rounding_modes_are_noticed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

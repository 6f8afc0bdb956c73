/* SPDX-License-Identifier: MIT
 * test_pace.c: messages never go out faster than they may. How much slower is up to the system. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#ifndef TAHR_HAVE_LCM
int main(void)
{
    puts("SKIP: unit_lcm_pace: built without LCM");
    return 77;
}
#else
#include <time.h>

#include "lcm/pace.h"

static int64_t now_us(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static int64_t time_of(uint32_t burst, uint32_t rate, int count, uint32_t size)
{
    tahr__lcm_pace pace;
    tahr__lcm_pace_open(&pace, burst, rate);
    const int64_t begun = now_us();
    for (int i = 0; i < count; i++)
        tahr__lcm_pace_keep(&pace, size);
    return now_us() - begun;
}

/* Half a millisecond may be made good at once. */
enum { SLACK = 500 };

static void no_more_goes_out_in_a_second_than_may(void **unused)
{
    (void)unused;
    assert_true(time_of(0, 0, 640, 300) >= 10000 - SLACK);
    assert_true(time_of(16, 64000, 640, 300) >= 10000 - SLACK);
    assert_true(time_of(1, 10000, 100, 300) >= 10000 - SLACK);
    assert_true(time_of(64, 6400, 64, 300) >= 10000 - SLACK);
}

static void a_long_message_counts_for_each_of_its_kilobytes(void **unused)
{
    (void)unused;
    assert_true(time_of(16, 64000, 10, 63 * 1024) >= 10000 - SLACK);
}

static void a_burst_is_no_longer_than_a_second(void **unused)
{
    tahr__lcm_pace pace;
    (void)unused;
    tahr__lcm_pace_open(&pace, 0, 3);
    assert_int_equal(pace.burst, 3);
    tahr__lcm_pace_open(&pace, 0, 0);
    assert_int_equal(pace.burst, 16);
    assert_int_equal(pace.rate, 64000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_more_goes_out_in_a_second_than_may),
        cmocka_unit_test(a_long_message_counts_for_each_of_its_kilobytes),
        cmocka_unit_test(a_burst_is_no_longer_than_a_second),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif

/* SPDX-License-Identifier: MIT
 * test_message.c: the words of a log message, and what happens without a log or with too many words. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_host.h"
#include "message.h"

static int32_t last_level;
static size_t last_length;

static void keep_level(void *user, int32_t level, const char *message)
{
    (void)user;
    last_level = level;
    last_length = strlen(message);
}

static void a_message_names_function_argument_and_fault(void **unused)
{
    fake_log kept;
    tahr_log log = fake_log_of(&kept);
    (void)unused;
    assert_int_equal(tahr__complain(&log, TAHR_E_NULL, "tahr_f", "x", "is NULL"), TAHR_E_NULL);
    assert_string_equal(kept.text, "tahr_f: x is NULL");
    assert_int_equal(tahr__complain_value(&log, TAHR_E_ARGUMENT, "tahr_f", "x", 0.1, "too small"), TAHR_E_ARGUMENT);
    assert_string_equal(kept.text, "tahr_f: x is 0.10000000000000001, too small"); /* all digits: NaN hunts need them */
    assert_int_equal(tahr__complain_value(&log, TAHR_E_ARGUMENT, "tahr_f", "x", -INFINITY, "too small"),
                     TAHR_E_ARGUMENT);
    assert_string_equal(kept.text, "tahr_f: x is -inf, too small");
    tahr__say(&log, TAHR_LOG_INFO, "tahr_f", "all is well");
    assert_string_equal(kept.text, "tahr_f: all is well");
    assert_int_equal(kept.count, 4);
}

static void levels_reach_the_log_and_long_texts_are_cut(void **unused)
{
    char text[2000];
    tahr_log log = {NULL, keep_level};
    (void)unused;
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = 0;
    tahr__say(&log, TAHR_LOG_WARNING, "tahr_f", text);
    assert_true(last_level == TAHR_LOG_WARNING && last_length == 255);
    tahr__complain(&log, TAHR_E_NULL, "tahr_f", text, text);
    assert_true(last_level == TAHR_LOG_ERROR && last_length == 255);
    tahr__complain_value(&log, TAHR_E_NULL, text, "x", 1, text);
    assert_true(last_level == TAHR_LOG_ERROR && last_length == 255);
}

static void without_a_log_the_status_is_all(void **unused)
{
    tahr_log empty = {NULL, NULL};
    (void)unused;
    assert_int_equal(tahr__complain(NULL, TAHR_E_NULL, "f", "x", "y"), TAHR_E_NULL);
    assert_int_equal(tahr__complain(&empty, TAHR_E_ABI, "f", "x", "y"), TAHR_E_ABI);
    assert_int_equal(tahr__complain_value(NULL, TAHR_E_NULL, "f", "x", 1, "y"), TAHR_E_NULL);
    assert_int_equal(tahr__complain_value(&empty, TAHR_E_ABI, "f", "x", 1, "y"), TAHR_E_ABI);
    tahr__say(NULL, TAHR_LOG_ERROR, "f", "x");
    tahr__say(&empty, TAHR_LOG_ERROR, "f", "x");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_message_names_function_argument_and_fault),
                                       cmocka_unit_test(levels_reach_the_log_and_long_texts_are_cut),
                                       cmocka_unit_test(without_a_log_the_status_is_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

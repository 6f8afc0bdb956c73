/* SPDX-License-Identifier: MIT
 * test_status.c: names, messages, version, the ABI handshake. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

static void every_status_has_a_name_and_a_message(void **unused)
{
    (void)unused;
#define CHECK(constant, value, name, message)              \
    assert_string_equal(tahr_status_name(constant), name); \
    assert_string_equal(tahr_status_message(constant), message);
    TAHR_STATUS_TABLE(CHECK)
#undef CHECK
    assert_string_equal(tahr_status_name(-99), "?");
    assert_non_null(tahr_status_message(1234));
}

static void modes_events_and_rules_have_names(void **unused)
{
    (void)unused;
    assert_string_equal(tahr_mode_name(TAHR_MODE_NONE), "none");
    assert_string_equal(tahr_mode_name(TAHR_MODE_WALKING), "walking");
    assert_string_equal(tahr_mode_name(TAHR_MODE_FALLING), "falling");
    assert_string_equal(tahr_mode_name(7), "?");
    assert_string_equal(tahr_event_name(TAHR_EVENT_LANDED), "landed");
    assert_string_equal(tahr_event_name(TAHR_EVENT_STEPPED_DOWN), "stepped_down");
    assert_string_equal(tahr_event_name(TAHR_EVENT_MODE), "mode");
    for (uint32_t type = TAHR_EVENT_LANDED; type <= TAHR_EVENT_CUSTOM; type++) {
        for (uint32_t other = 0; other < type; other++) {
            assert_string_not_equal(tahr_event_name(type), tahr_event_name(other));
        }
    }
    assert_string_equal(tahr_event_name(0), "?");
    assert_string_equal(tahr_event_name(22), "?");
    assert_string_equal(tahr_event_name(0xFFFFFFFFu), "?");
#define CHECK(constant, value, name) assert_string_equal(tahr_rule_name(constant), name);
    TAHR_RULE_TABLE(CHECK)
#undef CHECK
    assert_string_equal(tahr_rule_name(0), "?");
#define CHECK(constant, value, name) assert_string_equal(tahr_shortcut_name(constant), name);
    TAHR_SHORTCUT_TABLE(CHECK)
#undef CHECK
    assert_string_equal(tahr_shortcut_name(TAHR_SHORTCUT_COUNT), "?");
    assert_string_not_equal(tahr_shortcut_name(TAHR_SHORTCUT_COUNT - 1), "?");
}

static void the_abi_of_another_range_is_refused(void **unused)
{
    (void)unused;
    assert_int_equal(tahr_abi_check(TAHR_ABI), TAHR_OK);
    assert_int_equal(tahr_abi_check(TAHR_ABI + 1), TAHR_E_ABI);
    assert_int_equal(tahr_abi_check(TAHR_ABI + (1u << 16)), TAHR_E_ABI);
    assert_int_equal(tahr_abi_check(0), TAHR_E_ABI);
    assert_string_equal(tahr_version(), "0.1.0");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_status_has_a_name_and_a_message),
                                       cmocka_unit_test(modes_events_and_rules_have_names),
                                       cmocka_unit_test(the_abi_of_another_range_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

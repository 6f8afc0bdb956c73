/* SPDX-License-Identifier: MIT
 * file://: an ordinary event log of LCM, and what happens when it cannot be written any more. */
#include "inbox.h"
#include "quiet.h"

#include <tahr/lcm.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char path[64];

static int make_path(void **unused)
{
    (void)unused;
    snprintf(path, sizeof path, "/tmp/tahr_log_XXXXXX");
    const int file = mkstemp(path);
    if (file < 0) return -1;
    return close(file);
}

static int remove_path(void **unused)
{
    (void)unused;
    return unlink(path);
}

static tahr_lcm *open_log(const char *format)
{
    char url[128];
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    snprintf(url, sizeof url, format, path);
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = url;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    return lcm;
}

static tahr_status publish_state(const tahr_sink *sink, uint32_t character, uint64_t step)
{
    const tahr_stamp stamp = {.character = character, .step = step, .sequence = step};
    const tahr_state state = {.radius = 0.25 + (double)step, .mode = TAHR_MODE_FLYING};
    return sink->state(sink->user, &stamp, &state);
}

/* Reads the next event and expects a state on that channel. Returns its time. */
static int64_t expect_state(lcm_eventlog_t *log, const char *channel, int32_t character, int64_t step)
{
    lcm_eventlog_event_t *event = lcm_eventlog_read_next_event(log);
    tahr_state_t state;
    assert_non_null(event);
    assert_int_equal(event->channellen, strlen(channel));
    assert_memory_equal(event->channel, channel, strlen(channel));
    assert_int_equal(tahr_state_t_decode(event->data, 0, event->datalen, &state), event->datalen);
    assert_int_equal(state.character, character);
    assert_int_equal(state.step, step);
    assert_true(state.radius == 0.25 + (double)step);
    assert_int_equal(state.mode, TAHR_MODE_FLYING);
    const int64_t time = event->timestamp;
    lcm_eventlog_free_event(event);
    return time;
}

static void a_log_holds_what_was_told_in_order(void **unused)
{
    enum { COUNT = 1000 };
    int64_t last = 0;
    (void)unused;
    tahr_lcm *lcm = open_log("file://%s");
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    for (uint64_t i = 0; i < COUNT; i++)
        assert_int_equal(publish_state(sink, (uint32_t)i % 7, i), TAHR_OK);
    tahr_lcm_close(lcm);

    lcm_eventlog_t *log = lcm_eventlog_create(path, "r");
    assert_non_null(log);
    for (int64_t i = 0; i < COUNT; i++) {
        const int64_t time = expect_state(log, "TAHR_STATE", (int32_t)i % 7, i);
        assert_true(time >= last);
        last = time;
    }
    assert_null(lcm_eventlog_read_next_event(log));
    /* LCM puts 28 bytes before a channel. */
    assert_int_equal(ftell(log->f),
                     COUNT * (28 + (long)strlen("TAHR_STATE") + tahr_state_t_encoded_size(&(tahr_state_t){0})));
    lcm_eventlog_destroy(log);
}

static void what_was_flushed_is_there_before_the_log_is_closed(void **unused)
{
    (void)unused;
    tahr_lcm *lcm = open_log("file://%s?mode=w");
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    assert_int_equal(publish_state(sink, 1, 0), TAHR_OK);
    sink->flush(sink->user);
    lcm_eventlog_t *log = lcm_eventlog_create(path, "r");
    assert_non_null(log);
    expect_state(log, "TAHR_STATE", 1, 0);
    lcm_eventlog_destroy(log);
    tahr_lcm_close(lcm);
}

static void a_log_is_written_anew(void **unused)
{
    (void)unused;
    for (uint64_t i = 0; i < 2; i++) {
        tahr_lcm *lcm = open_log("file://%s");
        assert_int_equal(publish_state(tahr_lcm_sink(lcm), 0, i), TAHR_OK);
        tahr_lcm_close(lcm);
    }
    lcm_eventlog_t *log = lcm_eventlog_create(path, "r");
    assert_non_null(log);
    expect_state(log, "TAHR_STATE", 0, 1);
    assert_null(lcm_eventlog_read_next_event(log));
    lcm_eventlog_destroy(log);
}

/* liblcm's own provider reads it, too. */
static void subscribers_hear_a_log(void **unused)
{
    char url[128];
    inbox box;
    (void)unused;
    tahr_lcm *lcm = open_log("file://%s");
    for (uint64_t i = 0; i < 10; i++)
        assert_int_equal(publish_state(tahr_lcm_sink(lcm), 5, i), TAHR_OK);
    tahr_lcm_close(lcm);
    snprintf(url, sizeof url, "file://%s?speed=0", path);
    lcm_t *player = lcm_create(url);
    assert_non_null(player);
    inbox_open(&box, player, "", "");
    assert_true(inbox_wait(&box, TAHR_MESSAGE_STATE, 10));
    assert_int_equal(box.state.step, 9);
    inbox_close(&box);
    lcm_destroy(player);
}

/* /dev/full is a file that can be opened, and takes nothing. */
static void a_full_disk_is_an_error_that_is_told_once(void **unused)
{
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    quiet q;
    uint32_t failed = 0;
    (void)unused;
    if (access("/dev/full", W_OK) != 0) {
        print_message("SKIP: a_full_disk_is_an_error_that_is_told_once: there is no /dev/full\n");
        skip();
    }
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = "file:///dev/full";
    quiet_begin(&q);
    desc.log = &q.log;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    const tahr_status first = publish_state(sink, 0, 0); /* held back */
    sink->flush(sink->user);
    for (uint64_t i = 1; i < 1000; i++)
        failed += publish_state(sink, 0, i) == TAHR_E_FILE;
    sink->flush(sink->user);
    tahr_lcm_close(lcm);
    assert_int_equal(quiet_end(&q), 0);
    assert_int_equal(first, TAHR_OK);
    assert_int_equal(failed, 999);
    assert_int_equal(q.count, 1);
    assert_non_null(strstr(q.message, "the log ends here, a write failed: No space left on device"));
}

/* The same, where nobody flushes: the buffer of the file runs full. */
static void a_full_disk_is_noticed_without_a_flush(void **unused)
{
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    uint32_t failed = 0;
    (void)unused;
    if (access("/dev/full", W_OK) != 0) {
        print_message("SKIP: a_full_disk_is_noticed_without_a_flush: there is no /dev/full\n");
        skip();
    }
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = "file:///dev/full";
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    for (uint64_t i = 0; i < 1000; i++)
        failed += publish_state(tahr_lcm_sink(lcm), 0, i) == TAHR_E_FILE;
    tahr_lcm_close(lcm);
    assert_in_range(failed, 900, 999);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_log_holds_what_was_told_in_order),
        cmocka_unit_test(what_was_flushed_is_there_before_the_log_is_closed),
        cmocka_unit_test(a_log_is_written_anew),
        cmocka_unit_test(subscribers_hear_a_log),
        cmocka_unit_test(a_full_disk_is_an_error_that_is_told_once),
        cmocka_unit_test(a_full_disk_is_noticed_without_a_flush),
    };
    return cmocka_run_group_tests(tests, make_path, remove_path);
}

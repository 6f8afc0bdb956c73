/* SPDX-License-Identifier: MIT
 * Opening a sink: what is wrong is named in the log, by nobody on stderr, and nothing is left behind. */
#include "inbox.h"
#include "quiet.h"

#include <tahr/lcm.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct counted {
    tahr_allocator allocator;
    long blocks, bytes;
    int fails;
} counted;

static void *take(void *user, size_t size, size_t alignment)
{
    counted *c = user;
    (void)alignment;
    if (c->fails) return NULL;
    c->blocks++;
    c->bytes += (long)size;
    return malloc(size);
}

static void give_back(void *user, void *memory, size_t size, size_t alignment)
{
    counted *c = user;
    (void)alignment;
    c->blocks--;
    c->bytes -= (long)size;
    free(memory);
}

/* Opens, expects it to fail so, with words in the message, without a print, a block that is kept, or a handle. */
static void expect_refused(tahr_lcm_desc desc, tahr_status expected, const char *words)
{
    counted memory = {.allocator = {&memory, take, give_back}};
    tahr_lcm *const untouched = (tahr_lcm *)&memory, *lcm = untouched;
    quiet q;

    quiet_begin(&q);
    desc.log = &q.log;
    desc.allocator = &memory.allocator;
    const tahr_status status = tahr_lcm_open(&desc, &lcm);
    const long printed = quiet_end(&q);
    if (status != expected || !strstr(q.message, words))
        print_message("%s: status %d, '%s'\n", desc.url ? desc.url : "", status, q.message);
    assert_int_equal(status, expected);
    assert_non_null(strstr(q.message, words));
    assert_int_equal(q.count, 1);
    assert_int_equal(printed, 0);
    assert_ptr_equal(lcm, untouched);
    assert_int_equal(memory.blocks, 0);
    assert_int_equal(memory.bytes, 0);
}

static tahr_lcm_desc described(const char *url)
{
    tahr_lcm_desc desc;
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = url;
    return desc;
}

static void wrong_urls_are_refused_and_named(void **unused)
{
    static const struct {
        const char *url;
        tahr_status status;
        const char *words;
    } wrong[] = {
        {"", TAHR_E_ARGUMENT, "begins with udpm://, file:// or memq://"},
        {"somewhere", TAHR_E_ARGUMENT, "'somewhere': no URL"},
        {"udpm:/239.255.76.67", TAHR_E_ARGUMENT, "no URL"},
        {"tcpq://localhost:7700", TAHR_E_UNSUPPORTED, "tcpq:// waits for ever"},
        {"http://localhost", TAHR_E_UNSUPPORTED, "unknown scheme 'http'; known: udpm, file, memq"},
        {"UDPM://", TAHR_E_UNSUPPORTED, "unknown scheme 'UDPM'"},
        {"udpm2://", TAHR_E_UNSUPPORTED, "unknown scheme 'udpm2'"},
        {"://", TAHR_E_UNSUPPORTED, "unknown scheme ''"},
        {"udpm://127.0.0.1:7667", TAHR_E_ARGUMENT, "'127.0.0.1' is no multicast group"},
        {"udpm://223.255.255.255", TAHR_E_ARGUMENT, "'223.255.255.255' is no multicast group"},
        {"udpm://240.0.0.1", TAHR_E_ARGUMENT, "'240.0.0.1' is no multicast group"},
        {"udpm://239.255.76", TAHR_E_ARGUMENT, "'239.255.76' is no multicast group"},
        {"udpm://239.255.76.67.89.123.45", TAHR_E_ARGUMENT, "is no multicast group"},
        {"udpm://:7667", TAHR_E_ARGUMENT, "'' is no multicast group"},
        {"udpm://here:7667", TAHR_E_ARGUMENT, "'here' is no multicast group"},
        {"udpm://239.255.76.67:", TAHR_E_ARGUMENT, "'' is no port"},
        {"udpm://239.255.76.67:0", TAHR_E_ARGUMENT, "'0' is no port"},
        {"udpm://239.255.76.67:65536", TAHR_E_ARGUMENT, "'65536' is no port"},
        {"udpm://239.255.76.67:-7", TAHR_E_ARGUMENT, "'-7' is no port"},
        {"udpm://239.255.76.67:80x", TAHR_E_ARGUMENT, "'80x' is no port"},
        {"udpm://239.255.76.67:99999999999999999999999999", TAHR_E_ARGUMENT, "is no port"},
        {"udpm://?ttl=256", TAHR_E_ARGUMENT, "ttl=256 is not within"},
        {"udpm://?ttl=", TAHR_E_ARGUMENT, "ttl= is not within"},
        {"udpm://?ttl", TAHR_E_ARGUMENT, "ttl= is not within"},
        {"udpm://?ttl=-1", TAHR_E_ARGUMENT, "ttl=-1 is not within"},
        {"udpm://?recv_buf_size=much", TAHR_E_ARGUMENT, "recv_buf_size=much is no number"},
        {"udpm://?ttl=0&speed=2", TAHR_E_ARGUMENT, "unknown option 'speed'; known: ttl, recv_buf_size"},
        {"udpm://?ttl=0,mode=w", TAHR_E_ARGUMENT, "unknown option 'mode'"},
        {"file://", TAHR_E_ARGUMENT, "names no file"},
        {"file://?mode=w", TAHR_E_ARGUMENT, "names no file"},
        {"file:///tmp/x?mode=r", TAHR_E_ARGUMENT, "mode=r: what is published to is written"},
        {"file:///tmp/x?mode", TAHR_E_ARGUMENT, "mode=: what is published to is written"},
        {"file:///tmp/x?speed=2", TAHR_E_ARGUMENT, "unknown option 'speed'; known: mode"},
        {"file:///there/is/no/such/folder/log", TAHR_E_FILE, "No such file or directory: /there/is/no"},
        {"file:///tmp", TAHR_E_FILE, "Is a directory: /tmp"},
        {"memq://here", TAHR_E_ARGUMENT, "'here' is one too many"},
        {"memq://?ttl=0", TAHR_E_ARGUMENT, "unknown option 'ttl'; known: none"},
    };
    (void)unused;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        expect_refused(described(wrong[i].url), wrong[i].status, wrong[i].words);
}

static void a_path_of_any_length_is_refused_whole(void **unused)
{
    static char url[10000];
    (void)unused;
    memset(url, 'x', sizeof url - 1);
    memcpy(url, "file:///", 8);
    expect_refused(described(url), TAHR_E_ARGUMENT, "the path has 9992 letters, more than 4095");
    url[7 + 4095] = 0; /* "file://" and the longest path: too long for the system */
    expect_refused(described(url), TAHR_E_FILE, "File name too long: /xxx");
}

static void the_environment_is_asked_where_no_url_is_given(void **unused)
{
    tahr_lcm *lcm;
    tahr_lcm_desc desc = described(NULL);
    (void)unused;
    assert_int_equal(setenv("LCM_DEFAULT_URL", "tcpq://localhost", 1), 0);
    expect_refused(described(NULL), TAHR_E_UNSUPPORTED, "LCM_DEFAULT_URL 'tcpq://localhost': tcpq://");
    assert_int_equal(setenv("LCM_DEFAULT_URL", "memq://", 1), 0);
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    tahr_lcm_close(lcm);
    assert_int_equal(unsetenv("LCM_DEFAULT_URL"), 0);
}

static void wrong_descriptions_are_refused_and_named(void **unused)
{
    tahr_lcm_desc desc = described("memq://");
    tahr_lcm *lcm;
    (void)unused;

    assert_int_equal(tahr_lcm_open(NULL, &lcm), TAHR_E_NULL);
    assert_int_equal(tahr_lcm_open(&desc, NULL), TAHR_E_NULL);
    desc.struct_size = sizeof desc - 1;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_E_STRUCT_SIZE);
    desc.struct_size = 1u << 30;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_E_STRUCT_SIZE);
    desc = described("memq://");
    desc.flags = TAHR_LCM_ID_SUFFIX | 2;
    expect_refused(desc, TAHR_E_UNSUPPORTED, "desc.flags 0x3 has unknown ones");
    desc = described("memq://");
    desc.burst = 65537;
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.burst 65537 is not within 1 to 65536");
    desc = described("memq://");
    desc.burst = 11;
    desc.rate = 10;
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.burst 11 is more than desc.rate 10");
    desc = described("memq://");
    desc.prefix = "0123456789abcdef0123456789abcdef0";
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.prefix is not of up to 32 printable letters");
    desc.prefix = "two words";
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.prefix");
    desc.prefix = "line\n";
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.prefix");
    desc.prefix = "\x7f";
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.prefix");
    desc.prefix = "g\xc3\xa4mse";
    expect_refused(desc, TAHR_E_ARGUMENT, "desc.prefix");
}

static void a_longer_description_is_taken_if_its_rest_is_zero(void **unused)
{
    struct {
        tahr_lcm_desc desc;
        uint64_t newer;
    } longer;
    quiet q;
    tahr_lcm *lcm;
    (void)unused;
    assert_int_equal(tahr_lcm_desc_init(&longer.desc, sizeof longer), TAHR_OK);
    assert_int_equal(longer.desc.struct_size, sizeof longer);
    assert_int_equal(longer.newer, 0);
    quiet_begin(&q);
    longer.desc.log = &q.log;
    longer.desc.url = "memq://";
    const tahr_status taken = tahr_lcm_open(&longer.desc, &lcm);
    if (taken >= 0) tahr_lcm_close(lcm);
    longer.newer = 1ull << 40;
    const tahr_status refused = tahr_lcm_open(&longer.desc, &lcm);
    assert_int_equal(quiet_end(&q), 0);
    assert_int_equal(taken, TAHR_OK);
    assert_int_equal(refused, TAHR_E_UNSUPPORTED);
    assert_non_null(strstr(q.message, "fields of a newer version"));
}

static void a_description_begins_with_nothing_but_its_size(void **unused)
{
    tahr_lcm_desc desc;
    const tahr_lcm_desc zero = {.struct_size = sizeof zero};
    (void)unused;
    memset(&desc, 0xA5, sizeof desc);
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    assert_memory_equal(&desc, &zero, sizeof desc);
    assert_int_equal(tahr_lcm_desc_init(NULL, sizeof desc), TAHR_E_NULL);
    memset(&desc, 0xA5, sizeof desc);
    const tahr_lcm_desc before = desc;
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc - 1), TAHR_E_STRUCT_SIZE);
    assert_memory_equal(&desc, &before, sizeof desc);
}

static void memory_that_is_missing_is_an_error(void **unused)
{
    counted memory = {.allocator = {&memory, take, give_back}, .fails = 1};
    tahr_lcm_desc desc = described("memq://");
    tahr_lcm *lcm;
    quiet q;
    (void)unused;
    quiet_begin(&q);
    desc.allocator = &memory.allocator;
    desc.log = &q.log;
    const tahr_status without = tahr_lcm_open(&desc, &lcm);
    memory.fails = 0;
    const tahr_status with = tahr_lcm_open(&desc, &lcm);
    assert_int_equal(quiet_end(&q), 0);
    assert_int_equal(without, TAHR_E_MEMORY);
    assert_non_null(strstr(q.message, "no memory for"));
    assert_int_equal(with, TAHR_OK);

    /* A world that finds no room is not told, and the next one is. */
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    const tahr_sink_world world = {.characters = 1};
    memory.fails = 1;
    assert_int_equal(sink->world(sink->user, &world), TAHR_E_MEMORY);
    memory.fails = 0;
    assert_int_equal(sink->world(sink->user, &world), TAHR_OK);
    const long kept = memory.blocks;
    assert_int_equal(sink->world(sink->user, &world), TAHR_OK);
    assert_int_equal(memory.blocks, kept);
    tahr_lcm_close(lcm);
    assert_int_equal(memory.blocks, 0);
    assert_int_equal(memory.bytes, 0);
}

static void nothing_is_closed_and_asked_without_harm(void **unused)
{
    (void)unused;
    tahr_lcm_close(NULL);
    assert_null(tahr_lcm_sink(NULL));
}

static void a_sink_says_what_it_is(void **unused)
{
    tahr_lcm_desc desc = described("memq://");
    tahr_lcm *lcm;
    (void)unused;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    assert_int_equal(sink->struct_size, sizeof *sink);
    assert_int_equal(sink->abi_major, TAHR_ABI_MAJOR);
    assert_int_equal(sink->abi_minor, TAHR_ABI_MINOR);
    assert_string_equal(sink->name, "lcm");
    tahr_lcm_close(lcm);
}

/* One after the other, and two at once that write two files. */
static void sinks_know_nothing_of_each_other(void **unused)
{
    tahr_lcm_desc desc = described("memq://");
    tahr_lcm *lcm[2];
    (void)unused;
    for (int i = 0; i < 100; i++) {
        assert_int_equal(tahr_lcm_open(&desc, &lcm[0]), TAHR_OK);
        assert_int_equal(tahr_lcm_open(&desc, &lcm[1]), TAHR_OK);
        tahr_lcm_close(lcm[i % 2]);
        const tahr_sink *sink = tahr_lcm_sink(lcm[1 - i % 2]);
        const tahr_sink_change change = {.kind = TAHR_CHANGE_TOUCH};
        assert_int_equal(sink->change(sink->user, &change), TAHR_OK);
        tahr_lcm_close(lcm[1 - i % 2]);
    }
}

/* An lcm_t that was given is used, whatever the URL says, and outlives the sink. */
static void an_lcm_that_was_given_stays(void **unused)
{
    lcm_t *own = lcm_create("memq://");
    tahr_lcm_desc desc = described("no URL at all");
    const tahr_sink_change change = {.kind = TAHR_CHANGE_TOUCH};
    inbox box;
    tahr_lcm *lcm;
    (void)unused;
    assert_non_null(own);
    desc.lcm = own;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    inbox_open(&box, own, "", "");
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    assert_int_equal(sink->change(sink->user, &change), TAHR_OK);
    tahr_lcm_close(lcm);
    assert_true(inbox_wait(&box, TAHR_MESSAGE_BODY, 1));
    inbox_close(&box);
    lcm_destroy(own);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_urls_are_refused_and_named),
        cmocka_unit_test(a_path_of_any_length_is_refused_whole),
        cmocka_unit_test(the_environment_is_asked_where_no_url_is_given),
        cmocka_unit_test(wrong_descriptions_are_refused_and_named),
        cmocka_unit_test(a_longer_description_is_taken_if_its_rest_is_zero),
        cmocka_unit_test(a_description_begins_with_nothing_but_its_size),
        cmocka_unit_test(memory_that_is_missing_is_an_error),
        cmocka_unit_test(nothing_is_closed_and_asked_without_harm),
        cmocka_unit_test(a_sink_says_what_it_is),
        cmocka_unit_test(sinks_know_nothing_of_each_other),
        cmocka_unit_test(an_lcm_that_was_given_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT
 * test_lcm_log.c: LCM event logs as the shell reads them: whole ones as liblcm does, damaged ones event by event, with
 * the byte of the damage; and messages, which are told apart from whatever else may come. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef TAHR_HAVE_LCM

#include "lcm_log.h"
#include "lcm/message.h"
#include "log_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { EVENTS = 20, HEAD = 28 };

static char folder[] = "/tmp/tahr-log.XXXXXX";
static char path[64], said[64];

/* Events of different lengths, in one of them what looks like the head of an event. */
static void write_events(void)
{
    struct log_copy log = {0};
    uint8_t data[300];
    for (size_t i = 0; i < EVENTS; i++) {
        char channel[16];
        for (size_t k = 0; k < sizeof data; k++) {
            data[k] = (uint8_t)(i * 31 + k * 7);
        }
        if (i == 7) {
            memcpy(data + 3, (const uint8_t[]){0xED, 0xA1, 0xDA, 0x01}, 4);
        }
        snprintf(channel, sizeof channel, "CHANNEL_%zu", i);
        log_copy_add(&log, channel, data, 10 + i * 13);
    }
    log_copy_write(&log, path);
    log_copy_free(&log);
}

static void write_part(const uint8_t *bytes, size_t size)
{
    file_write(path, bytes, size);
}

/* Reads the file, with what it says on standard error in a file of its own. numbers: of the events, EVENTS at most. */
static size_t read_log(int64_t numbers[EVENTS], uint64_t *damages)
{
    struct log_event event;
    size_t count = 0;
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    assert_non_null(freopen(said, "w", stderr));
    struct log_file *log = log_file_open(path);
    *damages = 0;
    if (log != NULL) {
        while (log_file_next(log, &event)) {
            assert_true(count < EVENTS);
            numbers[count++] = event.number;
        }
        *damages = log_file_damages(log);
        assert_true(log_file_position(log) <= log_file_size(log));
        log_file_close(log);
    }
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    return count;
}

static void assert_said(const char *words)
{
    size_t size = 0;
    char *text = (char *)file_bytes(said, &size);
    if (strstr(text, words) == NULL) {
        fail_msg("no '%s' in '%s'", words, text);
    }
    free(text);
}

static void whole_logs_are_read_as_liblcm_reads_them(void **state)
{
    struct log_copy theirs = {0};
    struct log_event ours;
    (void)state;
    write_events();
    log_copy_read(&theirs, path);
    assert_int_equal(theirs.count, EVENTS);
    struct log_file *log = log_file_open(path);
    assert_non_null(log);
    uint64_t at = 0;
    for (size_t i = 0; i < theirs.count; i++) {
        assert_true(log_file_next(log, &ours));
        assert_int_equal(ours.number, i);
        assert_int_equal(ours.at, at);
        assert_int_equal(ours.time_us, theirs.entries[i].time_us);
        assert_string_equal(ours.channel, theirs.entries[i].channel);
        assert_int_equal(ours.size, theirs.entries[i].size);
        assert_memory_equal(ours.data, theirs.entries[i].data, ours.size);
        at += HEAD + strlen(ours.channel) + ours.size;
    }
    assert_false(log_file_next(log, &ours));
    assert_int_equal(log_file_damages(log), 0);
    assert_int_equal(at, log_file_size(log));
    log_file_close(log);
    log_copy_free(&theirs);
}

/* Where each event begins, and where the last one ends. */
static void find_places(size_t places[EVENTS + 1])
{
    struct log_event event;
    struct log_file *log = log_file_open(path);
    assert_non_null(log);
    for (size_t i = 0; i < EVENTS; i++) {
        assert_true(log_file_next(log, &event));
        places[i] = (size_t)event.at;
        places[i + 1] = (size_t)event.at + HEAD + strlen(event.channel) + event.size;
    }
    log_file_close(log);
}

static void a_log_cut_off_at_any_byte_keeps_the_events_before_it(void **state)
{
    size_t size = 0, places[EVENTS + 1], whole = 0;
    int64_t numbers[EVENTS];
    uint64_t damages = 0;
    char words[80];
    (void)state;
    write_events();
    find_places(places);
    uint8_t *bytes = file_bytes(path, &size);
    for (size_t cut = 1; cut < size; cut++) {
        whole += cut >= places[whole + 1];
        write_part(bytes, cut);
        assert_int_equal(read_log(numbers, &damages), whole);
        const int between = cut == places[whole];
        assert_int_equal(damages, !between);
        if (!between) {
            snprintf(words, sizeof words, "byte %zu: the file is cut off in", places[whole]);
            assert_said(words);
        }
    }
    free(bytes);
}

static void garbage_at_any_byte_costs_at_most_one_event(void **state)
{
    size_t size = 0, places[EVENTS + 1], hit = 0;
    int64_t numbers[EVENTS];
    uint64_t damages = 0;
    (void)state;
    write_events();
    find_places(places);
    uint8_t *bytes = file_bytes(path, &size), *spoiled = malloc(size + 100);
    assert_non_null(spoiled);
    for (size_t at = 0; at < size; at++) {
        hit += at >= places[hit + 1];
        memcpy(spoiled, bytes, at);
        memset(spoiled + at, 0xED, 33); /* as a sync word begins */
        memcpy(spoiled + at + 33, bytes + at, size - at);
        write_part(spoiled, size + 33);
        const size_t count = read_log(numbers, &damages);
        assert_true(damages > 0);
        assert_true(count >= EVENTS - 1);
        assert_int_equal(count, at == places[hit] ? EVENTS : count);
        size_t read = 0;
        for (size_t number = 0; number < EVENTS; number++) {
            const int is_there = read < count && numbers[read] == (int64_t)number;
            assert_true(is_there || number == hit);
            read += (size_t)is_there;
        }
        assert_int_equal(read, count);
    }
    free(bytes);
    free(spoiled);
}

static void an_event_with_a_wrong_length_swallows_no_other(void **state)
{
    size_t size = 0, places[EVENTS + 1];
    int64_t numbers[EVENTS];
    uint64_t damages = 0;
    (void)state;
    write_events();
    find_places(places);
    uint8_t *bytes = file_bytes(path, &size);
    bytes[places[4] + 26] ^= 1; /* 256 bytes more */
    write_part(bytes, size);
    assert_int_equal(read_log(numbers, &damages), EVENTS - 1);
    assert_int_equal(damages, 1);
    assert_int_equal(numbers[4], 5);
    assert_said("an event whose length is wrong");
    free(bytes);
}

static void the_first_bytes_tell_what_a_file_is(void **state)
{
    enum log_kind kind = LOG_UNKNOWN;
    (void)state;
    write_events();
    assert_int_equal(log_file_kind(path, &kind), 0);
    assert_int_equal(kind, LOG_EVENTS);
    write_part((const uint8_t *)"TAHRTRC\0rest", 12);
    assert_int_equal(log_file_kind(path, &kind), 0);
    assert_int_equal(kind, LOG_TRACE);
    write_part((const uint8_t *)"TAHRTRC rest", 12);
    assert_int_equal(log_file_kind(path, &kind), 0);
    assert_int_equal(kind, LOG_UNKNOWN);
    write_part((const uint8_t *)"", 0);
    assert_int_equal(log_file_kind(path, &kind), -1);
}

/* One message of a kind, with its variable parts. */
static size_t encode(uint32_t kind, uint8_t *bytes, size_t size)
{
    uint8_t own[64] = {1, 2, 3};
    const int most = (int)size;
    switch (kind) {
    case TAHR_MESSAGE_STATE: return (size_t)tahr_state_t_encode(bytes, 0, most, &(tahr_state_t){.character = 3});
    case TAHR_MESSAGE_EVENT: return (size_t)tahr_event_t_encode(bytes, 0, most, &(tahr_event_t){.character = 3});
    case TAHR_MESSAGE_INPUT: return (size_t)tahr_input_t_encode(bytes, 0, most, &(tahr_input_t){.character = 3});
    case TAHR_MESSAGE_REPORT: return (size_t)tahr_report_t_encode(bytes, 0, most, &(tahr_report_t){.character = 3});
    case TAHR_MESSAGE_SNAPSHOT:
        return (size_t)tahr_snapshot_t_encode(bytes, 0, most,
                                              &(tahr_snapshot_t){.character = 3, .size = 64, .state = own});
    case TAHR_MESSAGE_BODY: return (size_t)tahr_body_t_encode(bytes, 0, most, &(tahr_body_t){.body = 3});
    default:
        return (size_t)tahr_world_t_encode(bytes, 0, most,
                                           &(tahr_world_t){.level = (char[]){"level"},
                                                           .backend = (char[]){""},
                                                           .version = (char[]){"0.1"},
                                                           .size = 64,
                                                           .configs = own});
    }
}

static void messages_are_known_by_channel_fingerprint_and_length(void **state)
{
    (void)state;
    for (uint32_t kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        uint8_t bytes[1024];
        struct message m;
        char channel[64];
        const size_t size = encode(kind, bytes, sizeof bytes - 1);
        const char *const names[] = {"", "robot/", "TAHR_STATE_"};
        for (size_t i = 0; i < 6; i++) {
            snprintf(channel, sizeof channel, "%s%s%s", names[i % 3], message_channel(kind), i < 3 ? "" : "_17");
            assert_int_equal(message_read(&m, channel, bytes, size), MESSAGE_OURS);
            assert_int_equal(m.kind, kind);
            assert_int_equal(m.prefix, strlen(names[i % 3]));
            assert_int_equal(m.character, kind == TAHR_MESSAGE_BODY || kind == TAHR_MESSAGE_WORLD ? -1 : 3);
            message_free(&m);
        }
        assert_int_equal(message_read(&m, "TAHR_OTHER", bytes, size), MESSAGE_OTHER);
        snprintf(channel, sizeof channel, "%s_x", message_channel(kind));
        assert_int_equal(message_read(&m, channel, bytes, size), MESSAGE_OTHER);
        snprintf(channel, sizeof channel, "%s", message_channel(kind));
        for (size_t cut = 0; cut < size; cut++) {
            uint8_t *exact = malloc(cut + 1); /* so that a look behind it is found out */
            assert_non_null(exact);
            memcpy(exact, bytes, cut);
            assert_int_equal(message_read(&m, channel, exact, cut), MESSAGE_FOREIGN);
            free(exact);
        }
        assert_int_equal(message_read(&m, channel, bytes, size + 1), MESSAGE_FOREIGN);
        bytes[3] ^= 1; /* of the fingerprint: another version */
        assert_int_equal(message_read(&m, channel, bytes, size), MESSAGE_FOREIGN);
    }
}

static void lengths_inside_of_messages_are_not_trusted(void **state)
{
    static const uint32_t kinds[] = {TAHR_MESSAGE_SNAPSHOT, TAHR_MESSAGE_WORLD};
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        uint8_t bytes[1024];
        const size_t size = encode(kinds[k], bytes, sizeof bytes);
        for (size_t at = 8; at + 4 <= size; at++) { /* whatever four bytes are a length: negative, huge, off by one */
            for (int how = 0; how < 4; how++) {
                static const uint8_t lies[4][4] = {
                    {255, 255, 255, 255}, {127, 255, 255, 255}, {128, 0, 0, 0}, {0, 0, 0, 65}};
                uint8_t *exact = malloc(size);
                struct message m;
                assert_non_null(exact);
                memcpy(exact, bytes, size);
                memcpy(exact + at, lies[how], 4);
                if (message_read(&m, message_channel(kinds[k]), exact, size) == MESSAGE_OURS) {
                    message_free(&m);
                }
                free(exact);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_logs_are_read_as_liblcm_reads_them),
        cmocka_unit_test(a_log_cut_off_at_any_byte_keeps_the_events_before_it),
        cmocka_unit_test(garbage_at_any_byte_costs_at_most_one_event),
        cmocka_unit_test(an_event_with_a_wrong_length_swallows_no_other),
        cmocka_unit_test(the_first_bytes_tell_what_a_file_is),
        cmocka_unit_test(messages_are_known_by_channel_fingerprint_and_length),
        cmocka_unit_test(lengths_inside_of_messages_are_not_trusted),
    };
    if (mkdtemp(folder) == NULL) {
        return 1;
    }
    snprintf(path, sizeof path, "%s/a.lcmlog", folder);
    snprintf(said, sizeof said, "%s/said", folder);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    remove(path);
    remove(said);
    rmdir(folder);
    return failed;
}

#else

int main(void)
{
    puts("SKIP: cli_lcm_log: this tahr was built without LCM");
    return 77;
}

#endif

/* SPDX-License-Identifier: MIT
 * test_lcm_verify.c: `tahr replay LOG --verify` proves a recording, and finds every error that is planted into one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef TAHR_HAVE_LCM

#include "captured.h"
#include "lcm_log.h"
#include "lcm/message.h"
#include "replay.h"
#include "run.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/tahr-verify.XXXXXX";
static char recorded[64], spoiled[64];
static struct log_copy whole; /* 6 characters for 22 s: snapshots at 0, 10 and 20 s */

enum { CHARACTERS = 6, RATE = 60, SECONDS = 22, STEPS = RATE * SECONDS, PERIOD = 10 * RATE };

static void assert_proven(uint64_t steps)
{
    char words[64];
    snprintf(words, sizeof words, "proven     %llu steps", (unsigned long long)steps);
    assert_said(words);
}

static int verify(const struct log_copy *log)
{
    log_copy_write(log, spoiled);
    return captured(replay_command, (const char *const[]){"replay", spoiled, "--verify", NULL});
}

static void record(const char *path, const char *prefix, const char *seconds)
{
    char url[100];
    snprintf(url, sizeof url, "file://%s", path);
    assert_int_equal(
        captured(run_command, (const char *const[]){"run", "--characters", "6", "--seconds", seconds, "--check", "off",
                                                    "--lcm", url, "--lcm-prefix", prefix, NULL}),
        EXIT_GOOD);
    assert_said("; 0 dropped, 0 failed");
}

/* The n-th message of a kind, of a character (-1: of whatever body), from a step on. Read into *m, to be freed. */
static struct log_entry *find(struct log_copy *log, uint32_t kind, int32_t character, int64_t step, struct message *m)
{
    for (size_t i = 0; i < log->count; i++) {
        struct log_entry *entry = &log->entries[i];
        if (entry->gone || strcmp(entry->channel, message_channel(kind)) != 0) {
            continue;
        }
        assert_int_equal(message_read(m, entry->channel, entry->data, entry->size), MESSAGE_OURS);
        if (m->character == character && m->step >= step) {
            return entry;
        }
        message_free(m);
    }
    fail_msg("no %s of %d from %lld on", message_channel(kind), character, (long long)step);
    return NULL;
}

/* Takes one out. Returns its step. */
static int64_t lose(struct log_copy *log, uint32_t kind, int32_t character, int64_t step)
{
    struct message m;
    find(log, kind, character, step, &m)->gone = 1;
    const int64_t found = m.step;
    message_free(&m);
    return found;
}

static void a_recording_is_proven(void **state)
{
    (void)state;
    assert_int_equal(verify(&whole), EXIT_GOOD);
    assert_proven(CHARACTERS * STEPS);
    assert_said("\nok");
}

static void an_input_with_one_bit_changed_is_named_with_the_fields_that_differ(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    struct message m;
    (void)state;
    struct log_entry *entry = find(&log, TAHR_MESSAGE_INPUT, 2, 200, &m);
    uint64_t bits = 0;
    memcpy(&bits, &m.is.input.move[0], sizeof bits);
    bits ^= UINT64_C(1) << 40;
    memcpy(&m.is.input.move[0], &bits, sizeof bits);
    tahr_input_t_encode(entry->data, 0, (int)entry->size, &m.is.input);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("DIFFERS    character 2, step 200: state ");
    assert_said("position.x is ");
    assert_said("character 2, from step 200 to 599: it differs");
    assert_proven(CHARACTERS * STEPS - 400);
    log_copy_free(&log);
}

static void a_report_with_another_hash_is_named(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    struct message m;
    (void)state;
    struct log_entry *entry = find(&log, TAHR_MESSAGE_REPORT, 5, 17, &m);
    m.is.report.state_hash ^= 1;
    tahr_report_t_encode(entry->data, 0, (int)entry->size, &m.is.report);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("DIFFERS    character 5, step 17: state ");
    assert_said("\nNOT PROVEN");
    log_copy_free(&log);
}

static void a_state_that_its_hash_does_not_stand_for_is_named(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    struct message m;
    (void)state;
    struct log_entry *entry = find(&log, TAHR_MESSAGE_STATE, 4, 100, &m);
    m.is.state.velocity[1] += 1e-9;
    m.is.state.floor_walkable ^= 1;
    tahr_state_t_encode(entry->data, 0, (int)entry->size, &m.is.state);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("WRONG      character 4, step 100: its message of kind state is not what happened: velocity.y is ");
    assert_said("; floor_walkable is ");
    assert_proven(CHARACTERS * STEPS); /* by their hashes */
    log_copy_free(&log);
}

static void an_event_that_did_not_happen_so_is_named(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    struct message m;
    char wrong[100];
    (void)state;
    struct log_entry *entry = find(&log, TAHR_MESSAGE_EVENT, 1, 50, &m);
    m.is.event.body += 1;
    m.is.event.position[2] += 1e-9;
    tahr_event_t_encode(entry->data, 0, (int)entry->size, &m.is.event);
    snprintf(wrong, sizeof wrong,
             "WRONG      character 1, step %d: its message of kind event is not what happened: body", (int)m.step);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said(wrong);
    assert_said("; position.z is ");
    log_copy_free(&log);
}

static void a_lost_input_is_a_gap_up_to_the_next_snapshot(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    lose(&log, TAHR_MESSAGE_INPUT, 1, 30);
    lose(&log, TAHR_MESSAGE_INPUT, 3, STEPS - 1);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("character 1, from step 30 to 599: an input was lost");
    assert_said("character 3, from step 1319 to 1319: an input was lost");
    assert_said("not proven 571 steps, in 2 gaps");
    assert_proven(CHARACTERS * STEPS - 571);
    log_copy_free(&log);
}

/* Of the change that makes an epoch the body with this index, or all of them with -1. */
static void lose_bodies(struct log_copy *log, int64_t epoch, int32_t index)
{
    struct message m;
    for (size_t i = 0; i < log->count; i++) {
        struct log_entry *entry = &log->entries[i];
        if (strcmp(entry->channel, "TAHR_BODY") == 0) {
            message_read(&m, entry->channel, entry->data, entry->size);
            entry->gone |= m.is.body.epoch == epoch && (index < 0 || m.is.body.index == index);
        }
    }
}

static void a_lost_body_is_a_gap_of_everybody(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    lose_bodies(&log, 101, 1); /* the second body of the change before step 100 */
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("from step 100 to 599: a body of a change of the world was lost");
    assert_said("in 6 gaps");
    assert_proven(CHARACTERS * (STEPS - 500));
    log_copy_free(&log);
}

static void a_lost_change_of_the_world_is_a_gap_of_everybody(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    lose_bodies(&log, 101, -1);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("from step 100 to 599: a");
    assert_proven(CHARACTERS * (STEPS - 500));
    log_copy_free(&log);
}

static void a_body_that_was_somewhere_else_is_told_by_the_revision(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    struct message m;
    (void)state;
    for (size_t i = 0; i < log.count; i++) {
        struct log_entry *entry = &log.entries[i];
        if (strcmp(entry->channel, "TAHR_BODY") == 0) {
            message_read(&m, entry->channel, entry->data, entry->size);
            if (m.is.body.epoch == 201 && m.is.body.index == 2) {
                m.is.body.position[0] += 1e-9;
                tahr_body_t_encode(entry->data, 0, (int)entry->size, &m.is.body);
            }
        }
    }
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("from step 200 to 599: the world came to another revision than was recorded");
    assert_proven(CHARACTERS * (STEPS - 400));
    log_copy_free(&log);
}

static void the_first_snapshot_is_needed_and_later_ones_are_not(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    assert_int_equal(lose(&log, TAHR_MESSAGE_SNAPSHOT, 0, 1), PERIOD);
    assert_int_equal(verify(&log), EXIT_GOOD);
    assert_proven(CHARACTERS * STEPS);
    assert_said("lost       1 of kind snapshot");
    lose(&log, TAHR_MESSAGE_SNAPSHOT, 4, 0);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("character 4, from step 0 to 599: the recording has no snapshot before it");
    assert_proven(CHARACTERS * STEPS - PERIOD);
    log_copy_free(&log);
}

static void a_lost_report_leaves_nothing_unproven_but_at_the_end(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    for (int64_t step = 50; step < 60; step++) {
        lose(&log, TAHR_MESSAGE_REPORT, 2, step);
    }
    assert_int_equal(verify(&log), EXIT_GOOD);
    assert_proven(CHARACTERS * STEPS);
    assert_said("lost       10 of kind report");
    lose(&log, TAHR_MESSAGE_REPORT, 2, STEPS - 1);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("character 2, from step 1319 to 1319: their reports were lost");
    log_copy_free(&log);
}

static void a_lost_event_is_a_gap_of_its_step(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    char words[80];
    (void)state;
    const int64_t step = lose(&log, TAHR_MESSAGE_EVENT, 3, 100);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    snprintf(words, sizeof words, "character 3, from step %lld to %lld: events of it were lost", (long long)step,
             (long long)step);
    assert_said(words);
    assert_said("lost       1 of kind event");
    assert_proven(CHARACTERS * STEPS - 1);
    log_copy_free(&log);
}

static void a_snapshot_that_is_not_what_its_hash_says_is_not_believed(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    struct message m;
    (void)state;
    struct log_entry *entry = find(&log, TAHR_MESSAGE_SNAPSHOT, 1, PERIOD, &m);
    message_free(&m);
    entry->data[entry->size - 300] ^= 4;
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("broken     1 messages");
    assert_proven(CHARACTERS * STEPS);
    log_copy_free(&log);
}

static void a_recording_that_begins_in_the_middle_is_proven_from_its_snapshots_on(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    size_t i = 0;
    for (int inputs = 0; inputs < CHARACTERS * 120; i++) { /* two seconds */
        inputs += strcmp(log.entries[i].channel, "TAHR_INPUT") == 0;
        log.entries[i].gone = strcmp(log.entries[i].channel, "TAHR_WORLD") != 0;
    }
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("character 0, from step 120 to 599: ");
    assert_proven(CHARACTERS * (STEPS - PERIOD));
    log_copy_free(&log);
}

static void what_others_send_on_our_channels_is_counted_and_ignored(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    log_copy_add(&log, "TAHR_STATE", "12345678 of another package", 27);
    log_copy_add(&log, "TAHR_INPUT", "", 0);
    log_copy_add(&log, "POSE", "somebody else's", 15);
    assert_int_equal(verify(&log), EXIT_GOOD);
    assert_proven(CHARACTERS * STEPS);
    assert_said("ignored    2 messages of another package or version");
    log_copy_free(&log);
}

static void a_damaged_file_is_proven_as_far_as_it_can_be_read(void **state)
{
    size_t size = 0;
    char words[100];
    (void)state;
    uint8_t *bytes = file_bytes(recorded, &size), *longer = malloc(size + 40);
    assert_non_null(longer);
    file_write(spoiled, bytes, size - 5);
    assert_int_equal(captured(replay_command, (const char *const[]){"replay", spoiled, "--verify", NULL}),
                     EXIT_CHECK_FAILED);
    assert_said("the file is cut off in");
    assert_said("damaged    the file, in 1 place");
    memcpy(longer, bytes, size / 2);
    memset(longer + size / 2, 'x', 40);
    memcpy(longer + size / 2 + 40, bytes + size / 2, size - size / 2);
    file_write(spoiled, longer, size + 40);
    assert_int_equal(captured(replay_command, (const char *const[]){"replay", spoiled, "--verify", NULL}),
                     EXIT_CHECK_FAILED);
    snprintf(words, sizeof words, "'%s', byte ", spoiled);
    assert_said(words);
    assert_said("damaged    the file, in 1 place");
    free(bytes);
    free(longer);
}

/* Appends another recording. */
static void append(struct log_copy *log, const struct log_copy *more)
{
    for (size_t i = 0; i < more->count; i++) {
        log_copy_add(log, more->entries[i].channel, more->entries[i].data, more->entries[i].size);
    }
}

static void runs_one_after_the_other_are_proven_each_and_mixed_ones_refused(void **state)
{
    struct log_copy log = log_copy_of(&whole), second = {0};
    (void)state;
    record(spoiled, "", "2");
    log_copy_read(&second, spoiled);
    append(&log, &second);
    assert_int_equal(verify(&log), EXIT_GOOD);
    assert_proven(CHARACTERS * STEPS);
    assert_proven(CHARACTERS * 2 * RATE);
    append(&log, &whole);
    assert_int_equal(verify(&log), EXIT_USAGE);
    assert_said("two runs at once on the same channels");
    log_copy_free(&log);
    log_copy_free(&second);
}

static void channels_of_several_publishers_are_told_apart_by_their_prefix(void **state)
{
    struct log_copy log = log_copy_of(&whole), second = {0};
    (void)state;
    record(spoiled, "B_", "2");
    log_copy_read(&second, spoiled);
    append(&log, &second);
    assert_int_equal(verify(&log), EXIT_USAGE);
    assert_said("more than one publisher");
    assert_int_equal(
        captured(replay_command, (const char *const[]){"replay", spoiled, "--verify", "--channel", "B_*", NULL}),
        EXIT_GOOD);
    assert_proven(CHARACTERS * 2 * RATE);
    log_copy_free(&log);
    log_copy_free(&second);
}

/* A world that is not this one: what is changed, and what is said. */
static void try_world(void (*change)(tahr_world_t *world), const char *words)
{
    struct log_copy log = log_copy_of(&whole);
    uint8_t bytes[4096];
    for (size_t i = 0; i < log.count; i++) {
        struct message m;
        if (strcmp(log.entries[i].channel, "TAHR_WORLD") == 0) {
            assert_int_equal(message_read(&m, "TAHR_WORLD", log.entries[i].data, log.entries[i].size), MESSAGE_OURS);
            change(&m.is.world);
            const int size = tahr_world_t_encode(bytes, 0, sizeof bytes, &m.is.world);
            assert_true(size > 0 && (size_t)size <= log.entries[i].size);
            memcpy(log.entries[i].data, bytes, (size_t)size);
            log.entries[i].size = (size_t)size;
            message_free(&m);
        }
    }
    assert_int_equal(verify(&log), EXIT_USAGE);
    assert_said(words);
    log_copy_free(&log);
}

static void other_level(tahr_world_t *world)
{
    world->level_hash ^= 1;
}

static void other_library(tahr_world_t *world)
{
    world->abi += 1;
}

static void other_settings(tahr_world_t *world)
{
    world->config_size -= 8;
    world->size -= 8;
}

static void other_backend(tahr_world_t *world)
{
    world->backend[0] = 'x';
}

static void no_characters(tahr_world_t *world)
{
    world->characters = 0;
}

static void another_world_is_refused_with_what_was_expected(void **state)
{
    struct log_copy log = log_copy_of(&whole);
    (void)state;
    try_world(other_level, "was recorded in level 'playground' with hash");
    try_world(other_library, "another version of the library");
    try_world(other_settings, "settings of another size");
    try_world(other_backend, "was recorded on backend 'xative', which this tahr does not know");
    try_world(no_characters, "a number of characters that cannot be");
    for (size_t i = 0; i < log.count; i++) {
        log.entries[i].gone = strcmp(log.entries[i].channel, "TAHR_INPUT") == 0;
    }
    assert_int_equal(verify(&log), EXIT_USAGE);
    assert_said("nothing to prove: expected inputs");
    log_copy_free(&log);
}

static void a_lost_input_of_one_in_a_crowd_is_a_gap_of_all_of_it(void **state)
{
    struct log_copy log = {0};
    char url[100];
    (void)state;
    snprintf(url, sizeof url, "file://%s", spoiled);
    assert_int_equal(captured(run_command, (const char *const[]){"run", "--crowd", "--characters", "6", "--seconds",
                                                                 "12", "--check", "off", "--lcm", url, NULL}),
                     EXIT_GOOD);
    log_copy_read(&log, spoiled);
    assert_int_equal(verify(&log), EXIT_GOOD);
    assert_proven(CHARACTERS * 12 * RATE);
    lose(&log, TAHR_MESSAGE_INPUT, 2, 30);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("character 2, from step 30 to 599: an input was lost");
    assert_said("character 0, from step 30 to 599: not all of its crowd is known in that step");
    assert_said("in 6 gaps");
    assert_proven(CHARACTERS * (12 * RATE - 570));
    log_copy_free(&log);
}

/* Whatever the bytes say: an exit code, and no more. */
static void spoiled_bytes_are_survived(void **state)
{
    size_t size = 0;
    uint32_t random = 1;
    (void)state;
    record(spoiled, "", "0.5");
    uint8_t *bytes = file_bytes(spoiled, &size), *other = malloc(size);
    assert_non_null(other);
    for (int i = 0; i < 300; i++) {
        memcpy(other, bytes, size);
        for (int k = 0; k < 1 + i % 20; k++) {
            random = random * 1664525u + 1013904223u; /* Numerical Recipes' quick one */
            other[(random >> 4) % (i % 2 ? size : 4000)] ^= (uint8_t)(1u << (random >> 29)); /* the world is in front */
        }
        file_write(spoiled, other, size);
        const int code = captured(replay_command, (const char *const[]){"replay", spoiled, "--verify", NULL});
        assert_in_range(code, EXIT_GOOD, EXIT_USAGE);
    }
    free(bytes);
    free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lost_input_of_one_in_a_crowd_is_a_gap_of_all_of_it),
        cmocka_unit_test(spoiled_bytes_are_survived),
        cmocka_unit_test(a_recording_is_proven),
        cmocka_unit_test(an_input_with_one_bit_changed_is_named_with_the_fields_that_differ),
        cmocka_unit_test(a_report_with_another_hash_is_named),
        cmocka_unit_test(a_state_that_its_hash_does_not_stand_for_is_named),
        cmocka_unit_test(an_event_that_did_not_happen_so_is_named),
        cmocka_unit_test(a_lost_input_is_a_gap_up_to_the_next_snapshot),
        cmocka_unit_test(a_lost_body_is_a_gap_of_everybody),
        cmocka_unit_test(a_lost_change_of_the_world_is_a_gap_of_everybody),
        cmocka_unit_test(a_body_that_was_somewhere_else_is_told_by_the_revision),
        cmocka_unit_test(the_first_snapshot_is_needed_and_later_ones_are_not),
        cmocka_unit_test(a_lost_report_leaves_nothing_unproven_but_at_the_end),
        cmocka_unit_test(a_lost_event_is_a_gap_of_its_step),
        cmocka_unit_test(a_snapshot_that_is_not_what_its_hash_says_is_not_believed),
        cmocka_unit_test(a_recording_that_begins_in_the_middle_is_proven_from_its_snapshots_on),
        cmocka_unit_test(what_others_send_on_our_channels_is_counted_and_ignored),
        cmocka_unit_test(a_damaged_file_is_proven_as_far_as_it_can_be_read),
        cmocka_unit_test(runs_one_after_the_other_are_proven_each_and_mixed_ones_refused),
        cmocka_unit_test(channels_of_several_publishers_are_told_apart_by_their_prefix),
        cmocka_unit_test(another_world_is_refused_with_what_was_expected),
    };
    if (mkdtemp(folder) == NULL) {
        return 1;
    }
    snprintf(recorded, sizeof recorded, "%s/a.lcmlog", folder);
    snprintf(spoiled, sizeof spoiled, "%s/b.lcmlog", folder);
    record(recorded, "", "22");
    log_copy_read(&whole, recorded);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    log_copy_free(&whole);
    remove(recorded);
    remove(spoiled);
    rmdir(folder);
    return failed;
}

#else

int main(void)
{
    puts("SKIP: cli_lcm_verify: this tahr was built without LCM");
    return 77;
}

#endif

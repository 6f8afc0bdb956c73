/* SPDX-License-Identifier: MIT
 * test_file.c: a trace that is cut off, spoiled, forged or not written to the end is a status and a message. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recording.h"
#include "stage.h"

enum { HEAD = 88, FRAME = 16, STEPS = 12 };

/* A few steps beside a lift, placed in every way; every kind of record but those of callbacks. */
static uint64_t record_little(recording *file, tahr_status *closed)
{
    rig r;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(3, 0, 0), fake_vec(1, 1, 0.5))};
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 0.95));
    tahr_trace *trace = recording_begin(file, r.world, TAHR_TRACE_FLUSH);
    for (int i = 0; i < STEPS; i++) {
        const tahr_body_pose pose = {1, 0, {fake_vec(3, 0, 0.02 * i), STAGE_LEVEL}};
        assert_int_equal(i == 5   ? tahr_world_set(r.world, &pose, 1)
                         : i == 6 ? tahr_world_touch(r.world)
                                  : tahr_world_move(r.world, &pose, 1, 1.0 / 60),
                         TAHR_OK);
        r.input.move = fake_vec(1, 0, 0);
        r.input.jump = i == 9;
        rig_step(&r, 1.0 / 60);
    }
    if (trace) {
        *closed = recording_end(trace, r.world);
    }
    const uint64_t hash = tahr_state_hash(&r.state);
    rig_close(&r);
    return hash;
}

static uint64_t fnv(uint64_t hash, const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001B3u;
    }
    return hash;
}

static void sign_head(recording *file)
{
    const uint64_t hash = fnv(0xCBF29CE484222325u, file->bytes, HEAD - 8);
    memcpy(file->bytes + HEAD - 8, &hash, 8);
}

/* Makes every checksum fit what is there now. */
static void sign_blocks(recording *file)
{
    for (size_t at = HEAD; at + FRAME < file->size;) {
        uint32_t size;
        memcpy(&size, file->bytes + at, 4);
        if (size > file->size - at - FRAME) {
            return;
        }
        const uint64_t hash = fnv(fnv(0xCBF29CE484222325u, file->bytes + at, 8), file->bytes + at + FRAME, size);
        memcpy(file->bytes + at + 8, &hash, 8);
        at += FRAME + size;
    }
}

static recording little(void)
{
    recording file = {0};
    tahr_status closed = TAHR_E_FILE;
    record_little(&file, &closed);
    assert_int_equal(closed, TAHR_OK);
    return file;
}

static void a_file_cut_off_anywhere_is_repeated_so_far_and_the_byte_is_named(void **unused)
{
    recording file = little();
    const size_t whole = file.size;
    uint64_t most = 0;
    (void)unused;
    for (file.size = 0; file.size < whole; file.size++) {
        replay p = {0};
        char byte[32];
        file.messages = 0;
        replay_run(&p, &file);
        assert_true(!p.ended);
        const tahr_status status = p.opened < 0 ? p.opened : p.read;
        assert_int_equal(status, TAHR_E_FILE);
        assert_true(p.steps >= most);
        most = p.steps;
        snprintf(byte, sizeof byte, "byte %zu: ", file.size);
        if (!strstr(file.message, "expected") || !strstr(file.message, byte)) {
            fail_msg("cut off at %zu: %s", file.size, file.message);
        }
    }
    assert_int_equal(most, STEPS);
    replay p = {0};
    replay_run(&p, &file);
    assert_true(p.ended && !p.differs && p.steps == STEPS);
    recording_free(&file);
}

static void a_spoiled_byte_is_found(void **unused)
{
    recording file = little();
    (void)unused;
    for (size_t i = 0; i < file.size; i++) {
        for (int bit = 0; bit < 8; bit += 3) {
            replay p = {0};
            file.bytes[i] ^= (unsigned char)(1 << bit);
            replay_run(&p, &file);
            const tahr_status status = p.opened < 0 ? p.opened : p.read;
            if (p.ended || status != TAHR_E_FILE) {
                fail_msg("bit %d of byte %zu: %s", bit, i, tahr_status_name(status));
            }
            assert_false(p.differs && p.how[0]);
            assert_non_null(strstr(file.message, "expected"));
            file.bytes[i] ^= (unsigned char)(1 << bit);
        }
    }
    recording_free(&file);
}

/* With checksums that fit: whatever comes of it, it ends, and without a crash. */
static void a_forged_file_harms_nobody(void **unused)
{
    recording file = little();
    unsigned char *good = malloc(file.size);
    oracle_random dice = {3};
    int refused = 0, ran = 0;
    (void)unused;
    assert_non_null(good);
    memcpy(good, file.bytes, file.size);
    for (int n = 0; n < 3000; n++) {
        replay p = {0};
        memcpy(file.bytes, good, file.size);
        for (int changes = 1 + n % 3; changes > 0; changes--) {
            const size_t at = HEAD + oracle_below(&dice, (uint32_t)(file.size - HEAD));
            file.bytes[at] = (unsigned char)oracle_below(&dice, 256);
        }
        sign_blocks(&file);
        replay_run(&p, &file);
        refused += p.opened < 0 || p.read < 0;
        ran += p.steps > 0;
    }
    assert_true(refused > 100 && ran > 100);
    free(good);
    recording_free(&file);
}

static void another_version_or_no_trace_is_told_apart(void **unused)
{
    recording file = little();
    replay p = {0};
    (void)unused;
    file.bytes[8] = 1;
    sign_head(&file);
    replay_run(&p, &file);
    assert_int_equal(p.opened, TAHR_E_ABI);
    assert_non_null(
        strstr(file.message, "byte 8: recorded as version 1 of the format with ABI 0.1, expected 4 with 0.1"));
    file.bytes[8] = 4, file.bytes[12] = 7;
    sign_head(&file);
    replay_run(&p, &file);
    assert_int_equal(p.opened, TAHR_E_ABI);
    assert_non_null(strstr(file.message, "with ABI 0.7, expected 4 with 0.1"));
    file.bytes[12] = 1, file.bytes[16] ^= 8;
    sign_head(&file);
    replay_run(&p, &file);
    assert_int_equal(p.opened, TAHR_E_ABI);
    assert_non_null(strstr(file.message, "other sizes of structs"));
    file.bytes[0] = 'X';
    replay_run(&p, &file);
    assert_int_equal(p.opened, TAHR_E_FILE);
    assert_non_null(strstr(file.message, "byte 0: no trace, expected the letters TAHRTRC"));
    recording_free(&file);
}

static void bytes_behind_the_end_are_found(void **unused)
{
    recording file = little();
    replay p = {0};
    (void)unused;
    file.bytes = realloc(file.bytes, file.size + 1);
    file.bytes[file.size++] = 0;
    replay_run(&p, &file);
    assert_int_equal(p.read, TAHR_E_FILE);
    assert_non_null(strstr(file.message, "expected the end of the file"));
    recording_free(&file);
}

static void pieces_of_any_size_make_the_same_file(void **unused)
{
    recording whole = little();
    (void)unused;
    for (size_t chunk = 1; chunk < 40; chunk += 6) {
        recording file = {.chunk = chunk};
        replay p = {0};
        tahr_status closed = TAHR_E_FILE;
        record_little(&file, &closed);
        assert_int_equal(closed, TAHR_OK);
        assert_int_equal(file.size, whole.size);
        assert_memory_equal(file.bytes, whole.bytes, file.size);
        replay_run(&p, &file);
        assert_true(p.ended && !p.differs);
        recording_free(&file);
    }
    recording_free(&whole);
}

static void a_write_that_fails_ends_the_recording_and_no_step_notices(void **unused)
{
    recording whole = little();
    tahr_status closed = TAHR_OK;
    (void)unused;
    recording none = {.fail_at = 1};
    const uint64_t hash = record_little(&none, &closed); /* the head fails: nothing is recorded */
    assert_int_equal(none.messages, 1);
    assert_non_null(strstr(none.message, "a write failed"));
    recording_free(&none);
    for (size_t fail_at = HEAD; fail_at < whole.size; fail_at += 5) {
        recording file = {.fail_at = fail_at};
        closed = TAHR_OK;
        assert_true(record_little(&file, &closed) == hash);
        assert_int_equal(closed, TAHR_E_FILE);
        assert_int_equal(file.messages, 1);
        assert_non_null(strstr(file.message, "recording ends after "));
        assert_memory_equal(file.bytes, whole.bytes, file.size);
        recording_free(&file);
    }
    recording_free(&whole);
}

static void a_full_disk_is_noticed_at_the_latest_when_closing(void **unused)
{
    const tahr_trace_desc desc = {.struct_size = sizeof desc, .path = "/dev/full"};
    tahr_trace *trace = NULL;
    FILE *full = fopen("/dev/full", "wb");
    (void)unused;
    if (!full) {
        printf("SKIP: unit_trace_file: there is no /dev/full\n");
        skip();
    }
    fclose(full);
    if (tahr_trace_open(&desc, &trace) == TAHR_OK) { /* the head may still be in a buffer */
        assert_int_equal(tahr_trace_close(trace), TAHR_E_FILE);
    }
}

static size_t nowhere(void *user, const void *bytes, size_t size)
{
    (void)user, (void)bytes;
    return size + 1; /* more than there was */
}

static void wrong_descriptions_are_refused(void **unused)
{
    tahr_trace_desc desc = {.struct_size = sizeof desc};
    struct {
        tahr_trace_desc desc;
        uint64_t tail;
    } newer = {{.struct_size = sizeof newer, .path = "nowhere/x"}, 1};
    tahr_trace *trace = NULL;
    tahr_trace_reader *reader = NULL;
    fake_log messages = {0};
    const tahr_log log = fake_log_of(&messages);
    (void)unused;
    assert_int_equal(tahr_trace_open(NULL, &trace), TAHR_E_NULL);
    assert_int_equal(tahr_trace_open(&desc, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_E_NULL);
    assert_int_equal(tahr_trace_read(&desc, &reader), TAHR_E_NULL);
    desc.log = &log;
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_E_NULL);
    assert_string_equal(messages.text, "tahr_trace_open: desc.path is NULL, and so is desc.write");
    desc.path = "nowhere/at/all";
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_E_FILE);
    assert_string_equal(messages.text, "tahr_trace_open: nowhere/at/all cannot be opened for writing");
    assert_int_equal(tahr_trace_read(&desc, &reader), TAHR_E_NOT_FOUND);
    assert_string_equal(messages.text, "tahr_trace_read: nowhere/at/all cannot be opened");
    desc.flags = 64;
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_E_UNSUPPORTED);
    desc.flags = TAHR_TRACE_FLUSH;
    assert_int_equal(tahr_trace_read(&desc, &reader), TAHR_E_UNSUPPORTED);
    desc.struct_size = 4;
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_trace_read(&desc, &reader), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_trace_open(&newer.desc, &trace), TAHR_E_UNSUPPORTED);
    desc = (tahr_trace_desc){.struct_size = sizeof desc, .write = nowhere};
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_E_FILE);
    assert_null(trace);
    assert_null(reader);
    assert_int_equal(tahr_trace_close(NULL), TAHR_OK);
    assert_null(tahr_trace_recorder(NULL));
    tahr_trace_reader_close(NULL);
}

static void a_trace_is_of_one_world(void **unused)
{
    fake_world w;
    rig a, b;
    recording file = {0};
    (void)unused;
    fake_world_flat(&w);
    rig_open(&a, &w, NULL, fake_vec(0, 0, 1));
    rig_open(&b, &w, NULL, fake_vec(0, 0, 1));
    tahr_trace *trace = recording_begin(&file, a.world, 0);
    assert_int_equal(tahr_world_record(b.world, tahr_trace_recorder(trace)), TAHR_E_ARGUMENT);
    assert_non_null(strstr(file.message, "a trace is of one world"));
    rig_step(&b, 1.0 / 60); /* as if nothing had been */
    rig_step(&a, 1.0 / 60);
    rig_close(&a); /* closing the world ends the recording too */
    assert_int_equal(tahr_trace_close(trace), TAHR_OK);
    rig_close(&b);
    replay p = {0};
    replay_run(&p, &file);
    assert_true(p.ended && p.steps == 1);
    recording_free(&file);
}

static void the_backend_under_a_replay_answers_nothing_by_itself(void **unused)
{
    tahr_world_desc desc;
    tahr_world *world;
    tahr_hit hit;
    uint32_t count;
    const tahr_ray down = {fake_vec(0, 0, 1), fake_vec(0, 0, -5), 0xFFFFFFFFu, TAHR_NO_BODY};
    (void)unused;
    tahr_world_desc_init(&desc, sizeof desc);
    assert_int_equal(tahr_world_open(tahr_backend_v1_trace(), &desc, &world), TAHR_OK);
    assert_int_equal(tahr_world_ray(world, &down, &hit, &count), TAHR_E_BACKEND);
    assert_string_equal(tahr_world_backend_name(world), "trace");
    tahr_world_close(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_cut_off_anywhere_is_repeated_so_far_and_the_byte_is_named),
        cmocka_unit_test(a_spoiled_byte_is_found),
        cmocka_unit_test(a_forged_file_harms_nobody),
        cmocka_unit_test(another_version_or_no_trace_is_told_apart),
        cmocka_unit_test(bytes_behind_the_end_are_found),
        cmocka_unit_test(pieces_of_any_size_make_the_same_file),
        cmocka_unit_test(a_write_that_fails_ends_the_recording_and_no_step_notices),
        cmocka_unit_test(a_full_disk_is_noticed_at_the_latest_when_closing),
        cmocka_unit_test(wrong_descriptions_are_refused),
        cmocka_unit_test(a_trace_is_of_one_world),
        cmocka_unit_test(the_backend_under_a_replay_answers_nothing_by_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

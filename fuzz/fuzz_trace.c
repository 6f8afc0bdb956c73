/* SPDX-License-Identifier: MIT
 * fuzz_trace.c: trace files: any bytes are refused with a status and a message, or are events up to where they break;
 * and `tahr replay` ends on them. Checksums would stop nearly all of them at the door: each file is tried once as it is
 * and once with its head and its checksums put right, as somebody would who forges one. */
#include "../bindings/cli/replay_trace.h"
#include "scratch.h"
#include "target.h"

#include <string.h>
#include <tahr/trace.h>

enum { MOST_BYTES = 1 << 16, FRAME = 16 };

/* The head of a file, as backends/trace/README.md describes it. */
typedef struct head {
    char magic[8];
    uint32_t version, abi, sizes[16];
    uint64_t checksum;
} head;

typedef struct file {
    const uint8_t *at;
    size_t left;
} file;

static size_t give(void *user, void *bytes, size_t size)
{
    file *f = user;
    size_t n = size < f->left ? size : f->left;
    if (n > 0) memcpy(bytes, f->at, n);
    f->at += n;
    f->left -= n;
    return n;
}

static char said[256];

static void hear(void *user, int32_t level, const char *message)
{
    (void)user, (void)level;
    snprintf(said, sizeof said, "%s", message);
}

/* Every event, without a world. */
static void read_events(const uint8_t *data, size_t size)
{
    file f = {data, size};
    tahr_log log = {NULL, hear};
    tahr_trace_desc desc = {.struct_size = sizeof desc, .read = give, .user = &f, .log = &log};
    tahr_trace_reader *reader = NULL;
    said[0] = 0;
    tahr_status status = tahr_trace_read(&desc, &reader);
    FUZZ_CHECK((status == TAHR_OK) == (reader != NULL), "%s", tahr_status_name(status));
    FUZZ_CHECK(status == TAHR_OK || said[0], "refused without a word: %s", tahr_status_name(status));
    for (uint64_t events = 0; reader && status == TAHR_OK; events++) {
        tahr_trace_event event;
        memset(&event, 0, sizeof event);
        said[0] = 0;
        status = tahr_trace_next(reader, &event);
        if (status == TAHR_OK && event.kind == TAHR_TRACE_END) break;
        FUZZ_CHECK(status == TAHR_OK || said[0], "broken without a word: %s", tahr_status_name(status));
        FUZZ_CHECK(events <= size, "more events than bytes");
    }
    tahr_trace_reader_close(reader);
}

/* FNV-1a, going on from a hash. */
static uint64_t hash_on(uint64_t hash, const void *bytes, size_t size)
{
    const uint8_t *b = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ b[i]) * 0x100000001B3u;
    return hash;
}

static const uint64_t NO_HASH = 0xCBF29CE484222325u;

static head head_of_this_version(void)
{
    head h = {.magic = "TAHRTRC",
              .version = 2,
              .abi = TAHR_ABI,
              .sizes = {sizeof(tahr_sweep), sizeof(tahr_contact_query), sizeof(tahr_ray), sizeof(tahr_fluid_query),
                        sizeof(tahr_hit), sizeof(tahr_contact), sizeof(tahr_fluid), sizeof(tahr_body_motion),
                        sizeof(tahr_body_pose), sizeof(tahr_record_body), sizeof(tahr_state), sizeof(tahr_config),
                        sizeof(tahr_input), sizeof(head)}};
    h.checksum = hash_on(NO_HASH, &h, offsetof(head, checksum));
    return h;
}

/* The head of this version; blocks of the sizes that they claim as far as there is something, in order. */
static void put_right(uint8_t *data, size_t size)
{
    const head h = head_of_this_version();
    memcpy(data, &h, sizeof h);
    size_t at = sizeof h;
    for (uint32_t number = 0; at + FRAME < size; number++) {
        uint8_t *content = data + at + FRAME;
        size_t left = size - at - FRAME;
        uint32_t frame[2];
        memcpy(frame, data + at, sizeof frame);
        if (frame[0] == 0 || frame[0] > left) frame[0] = (uint32_t)left;
        frame[1] = number;
        memcpy(data + at, frame, sizeof frame);
        uint64_t checksum = hash_on(hash_on(NO_HASH, frame, sizeof frame), content, frame[0]);
        memcpy(data + at + sizeof frame, &checksum, sizeof checksum);
        at += FRAME + frame[0];
    }
}

static void repeat(const uint8_t *data, size_t size)
{
    struct replayed found;
    const char *path = scratch_file(data, size, "trace");
    scratch_quiet();
    int status = replay_file(path, &found);
    scratch_loud();
    FUZZ_CHECK(status < 0 || !found.whole || !found.differs, "whole, and different: %s", found.how);
    FUZZ_CHECK(status == 0 || found.steps == 0, "steps of no trace");
    FUZZ_CHECK(!found.differs || found.how[0], "different without a word");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t right[MOST_BYTES];
    read_events(data, size);
    if (size <= sizeof(head) || size > MOST_BYTES) return 0;
    memcpy(right, data, size);
    put_right(right, size);
    read_events(right, size);
    FUZZ_CHECK(!strstr(said, "checksum") && !strstr(said, "expected the letters"), "not put right: %s", said);
    repeat(right, size);
    return 0;
}

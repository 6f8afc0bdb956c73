/* SPDX-License-Identifier: MIT
 * fuzz_trace.c: trace files: any bytes are refused with a status and a message, or are events up to where they break. */
#include "target.h"

#include <string.h>
#include <tahr/trace.h>

#ifdef TAHR_HAVE_TRACE_READER
typedef struct file {
    const uint8_t *at;
    size_t left;
} file;

static size_t give(void *user, void *bytes, size_t size)
{
    file *f = user;
    size_t n = size < f->left ? size : f->left;
    memcpy(bytes, f->at, n);
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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
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
        FUZZ_CHECK(events <= 8 * (uint64_t)size + 16, "more events than bytes could tell of");
    }
    tahr_trace_reader_close(reader);
    return 0;
}
#else
/* This build has no reader of traces. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    (void)data, (void)size;
    return 0;
}
#endif

/* SPDX-License-Identifier: MIT
 * log_file.c: reading an LCM event log, damaged ones too. An event is a sync word, its number and time (8 bytes each),
 * the lengths of its channel and its data (4 each), and these two; numbers are highest byte first. */
#include "log_file.h"

#include "say.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEAD = 28,          /* bytes of an event before its channel */
    CHANNEL_MOST = 63,  /* letters of a channel: LCM_MAX_CHANNEL_NAME_LENGTH */
    DATA_MOST = 1 << 28 /* bytes: LCM_MAX_MESSAGE_SIZE */
};

#define DAMAGES_SAID 10 /* that a damaged file is told of one by one */

static const uint8_t sync_word[4] = {0xED, 0xA1, 0xDA, 0x01};

struct log_file {
    FILE *file;
    char *path;
    uint64_t size, position; /* position: of the next byte that fread gives */
    uint8_t head[HEAD];      /* of the next event, or what there is of it */
    uint64_t head_at;
    size_t head_size;
    uint8_t next[HEAD]; /* of the one behind it, once its body was read: nothing is read twice */
    size_t next_size;
    uint8_t *body; /* channel, a zero, data */
    size_t capacity;
    uint64_t damages;
};

static uint64_t number_at(const uint8_t *bytes, int count)
{
    uint64_t x = 0;
    for (int i = 0; i < count; i++) {
        x = x << 8 | bytes[i];
    }
    return x;
}

static size_t channel_size(const uint8_t *head)
{
    return (size_t)number_at(head + 20, 4);
}

static size_t data_size(const uint8_t *head)
{
    return (size_t)number_at(head + 24, 4);
}

/* Bytes of an event, or 0 if this is no head of one. */
static uint64_t event_size(const uint8_t *head)
{
    const size_t channel = channel_size(head), data = data_size(head);
    const int fits = channel >= 1 && channel <= CHANNEL_MOST && data <= DATA_MOST;
    return fits && memcmp(head, sync_word, sizeof sync_word) == 0 ? HEAD + channel + data : 0;
}

static size_t read_bytes(struct log_file *log, uint64_t at, void *bytes, size_t size)
{
    if (at != log->position && fseeko(log->file, (off_t)at, SEEK_SET) != 0) {
        return 0;
    }
    const size_t got = fread(bytes, 1, size, log->file);
    log->position = at + got;
    return got;
}

/* Does an event begin here that ends where the next one begins, or the file? */
static int is_event(struct log_file *log, uint64_t at)
{
    uint8_t head[HEAD], next[4];
    if (read_bytes(log, at, head, HEAD) < HEAD || event_size(head) == 0) {
        return 0;
    }
    const uint64_t end = at + event_size(head);
    return end == log->size ||
           (read_bytes(log, end, next, sizeof next) == sizeof next && memcmp(next, sync_word, sizeof next) == 0);
}

/* The first event that begins in [from, to); to if there is none. */
static uint64_t find_event(struct log_file *log, uint64_t from, uint64_t to)
{
    uint8_t bytes[4096];
    for (uint64_t at = from; at < to;) {
        const size_t got = read_bytes(log, at, bytes, sizeof bytes);
        if (got < sizeof sync_word) {
            break;
        }
        for (size_t i = 0; i + sizeof sync_word <= got && at + i < to; i++) {
            if (memcmp(bytes + i, sync_word, sizeof sync_word) == 0 && is_event(log, at + i)) {
                return at + i;
            }
        }
        at += got - (sizeof sync_word - 1);
    }
    return to;
}

static void read_head(struct log_file *log, uint64_t at)
{
    log->head_at = at;
    log->head_size = at < log->size ? read_bytes(log, at, log->head, HEAD) : 0;
}

/* From the damage at a byte on to where something can be read again. */
static void skip(struct log_file *log, uint64_t at, uint64_t to, const char *what)
{
    if (++log->damages <= DAMAGES_SAID) {
        if (to < log->size) {
            say_error("'%s', byte %" PRIu64 ": %s; goes on at byte %" PRIu64, log->path, at, what, to);
        } else {
            say_error("'%s', byte %" PRIu64 ": %s; nothing more can be read", log->path, at, what);
        }
    }
    read_head(log, to);
}

/* The body of the event whose head was read. 0: what the head says cannot be, and was skipped. */
static int read_body(struct log_file *log, uint64_t *end)
{
    const uint64_t at = log->head_at;
    const size_t channel = channel_size(log->head), data = data_size(log->head);
    *end = at + event_size(log->head);
    if (*end > log->size) {
        char what[100];
        snprintf(what, sizeof what, "the file is cut off in an event of %" PRIu64 " bytes, %" PRIu64 " are there",
                 *end - at, log->size - at);
        skip(log, at, find_event(log, at + 1, log->size), what);
        return 0;
    }
    log->body = memory_grow(log->body, &log->capacity, channel + 1 + data, 1);
    if (read_bytes(log, at + HEAD, log->body, channel) < channel ||
        read_bytes(log, at + HEAD + channel, log->body + channel + 1, data) < data) {
        skip(log, at, log->size, "cannot read");
        return 0;
    }
    log->body[channel] = 0;
    log->next_size = read_bytes(log, *end, log->next, HEAD);
    if (*end < log->size &&
        (log->next_size < sizeof sync_word || memcmp(log->next, sync_word, sizeof sync_word) != 0)) {
        const uint64_t inside = find_event(log, at + 1, *end); /* then it is the length that is wrong */
        if (inside < *end) {
            skip(log, at, inside, "an event whose length is wrong");
            return 0;
        }
    }
    return 1;
}

int log_file_next(struct log_file *log, struct log_event *event)
{
    uint64_t end = 0;
    while (log->head_size > 0) {
        if (log->head_size < HEAD) {
            skip(log, log->head_at, log->size, "the file is cut off in the head of an event");
        } else if (event_size(log->head) == 0) {
            const uint64_t to = find_event(log, log->head_at + 1, log->size);
            skip(log, log->head_at, to, "no event begins here (expected the sync word ED A1 DA 01 and its lengths)");
        } else if (read_body(log, &end)) {
            const size_t channel = channel_size(log->head);
            *event = (struct log_event){(int64_t)number_at(log->head + 4, 8),
                                        (int64_t)number_at(log->head + 12, 8),
                                        (const char *)log->body,
                                        log->body + channel + 1,
                                        data_size(log->head),
                                        log->head_at};
            memcpy(log->head, log->next, log->next_size);
            log->head_size = log->next_size;
            log->head_at = end;
            return 1;
        }
    }
    return 0;
}

static FILE *open_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL || fgetc(file) == EOF) {
        const int failed = file == NULL || ferror(file);
        say_error("cannot read '%s': %s", path, failed ? strerror(errno) : "byte 0: the file is empty");
        if (file != NULL) {
            fclose(file);
        }
        return NULL;
    }
    rewind(file);
    return file;
}

int log_file_kind(const char *path, enum log_kind *kind)
{
    static const uint8_t trace[8] = {'T', 'A', 'H', 'R', 'T', 'R', 'C', 0}; /* as trace.h says */
    uint8_t bytes[8] = {0};
    FILE *file = open_file(path);
    if (file == NULL) {
        return -1;
    }
    const size_t got = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    *kind = got == sizeof trace && memcmp(bytes, trace, sizeof trace) == 0               ? LOG_TRACE
            : got >= sizeof sync_word && memcmp(bytes, sync_word, sizeof sync_word) == 0 ? LOG_EVENTS
                                                                                         : LOG_UNKNOWN;
    return 0;
}

struct log_file *log_file_open(const char *path)
{
    FILE *file = open_file(path);
    if (file == NULL) {
        return NULL;
    }
    struct log_file *log = memory_new(1, sizeof *log);
    log->file = file;
    log->path = memory_text(path);
    if (fseeko(file, 0, SEEK_END) != 0 || ftello(file) < 0) {
        say_error("cannot read '%s': %s", path, strerror(errno));
        log_file_close(log);
        return NULL;
    }
    log->size = (uint64_t)ftello(file);
    log->position = log->size;
    read_head(log, 0);
    return log;
}

void log_file_close(struct log_file *log)
{
    if (log != NULL) {
        fclose(log->file);
        free(log->path);
        free(log->body);
        free(log);
    }
}

uint64_t log_file_size(const struct log_file *log)
{
    return log->size;
}

uint64_t log_file_position(const struct log_file *log)
{
    return log->head_at;
}

uint64_t log_file_damages(const struct log_file *log)
{
    return log->damages;
}

/* SPDX-License-Identifier: MIT
 * lcm_log.c: LCM event logs held in memory. */
#ifdef TAHR_HAVE_LCM

#include "lcm_log.h"

#include <lcm/lcm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "lcm_log: %s\n", what);
        abort();
    }
}

void log_copy_add(struct log_copy *log, const char *channel, const void *data, size_t size)
{
    if (log->count == log->capacity) {
        log->capacity = log->capacity ? 2 * log->capacity : 1024;
        log->entries = realloc(log->entries, log->capacity * sizeof *log->entries);
        need(log->entries != NULL, "no memory");
    }
    struct log_entry *entry = &log->entries[log->count];
    *entry = (struct log_entry){.time_us = (int64_t)log->count, .data = malloc(size + 1), .size = size};
    log->count++;
    need(entry->data != NULL, "no memory");
    memcpy(entry->data, data, size);
    snprintf(entry->channel, sizeof entry->channel, "%s", channel);
}

void log_copy_read(struct log_copy *log, const char *path)
{
    lcm_eventlog_t *file = lcm_eventlog_create(path, "r");
    need(file != NULL, "cannot read the log");
    for (lcm_eventlog_event_t *event = NULL; (event = lcm_eventlog_read_next_event(file)) != NULL;) {
        log_copy_add(log, event->channel, event->data, (size_t)event->datalen);
        log->entries[log->count - 1].time_us = event->timestamp;
        lcm_eventlog_free_event(event);
    }
    lcm_eventlog_destroy(file);
}

void log_copy_write(const struct log_copy *log, const char *path)
{
    lcm_eventlog_t *file = lcm_eventlog_create(path, "w");
    need(file != NULL, "cannot write the log");
    for (size_t i = 0; i < log->count; i++) {
        struct log_entry *entry = &log->entries[i];
        lcm_eventlog_event_t event = {.timestamp = entry->time_us,
                                      .channellen = (int32_t)strlen(entry->channel),
                                      .datalen = (int32_t)entry->size,
                                      .channel = entry->channel,
                                      .data = entry->data};
        need(entry->gone || lcm_eventlog_write_event(file, &event) == 0, "cannot write an event");
    }
    lcm_eventlog_destroy(file);
}

struct log_copy log_copy_of(const struct log_copy *log)
{
    struct log_copy copy = {0};
    for (size_t i = 0; i < log->count; i++) {
        log_copy_add(&copy, log->entries[i].channel, log->entries[i].data, log->entries[i].size);
        copy.entries[i].time_us = log->entries[i].time_us;
        copy.entries[i].gone = log->entries[i].gone;
    }
    return copy;
}

void log_copy_free(struct log_copy *log)
{
    for (size_t i = 0; i < log->count; i++) {
        free(log->entries[i].data);
    }
    free(log->entries);
    *log = (struct log_copy){0};
}

uint8_t *file_bytes(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    need(file != NULL && fseek(file, 0, SEEK_END) == 0, "cannot read a file");
    *size = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = malloc(*size + 1);
    need(bytes != NULL && fread(bytes, 1, *size, file) == *size, "cannot read a file");
    fclose(file);
    bytes[*size] = 0;
    return bytes;
}

void file_write(const char *path, const uint8_t *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    need(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0, "cannot write a file");
}

#else

typedef int lcm_log_is_empty;

#endif

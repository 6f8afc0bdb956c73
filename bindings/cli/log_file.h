/* SPDX-License-Identifier: MIT
 * log_file.h: reading an LCM event log, damaged ones too: what is broken is said with its byte, what is readable is
 * kept. (liblcm's own reader looks for the next event without a word, and gives up the one before the damage.) */
#ifndef TAHR_CLI_LOG_FILE_H
#define TAHR_CLI_LOG_FILE_H

#include <stddef.h>
#include <stdint.h>

/* One message, as it was recorded. Valid until the next one is read. */
struct log_event {
    int64_t number;  /* counted by who recorded it */
    int64_t time_us; /* when it was received, since 1970 */
    const char *channel;
    const uint8_t *data;
    size_t size;
    uint64_t at; /* byte of the file where it begins */
};

struct log_file;

/* What the first bytes of a file say that it is. */
enum log_kind { LOG_UNKNOWN, LOG_TRACE, LOG_EVENTS };

/* -1 after a message that the file cannot be read. */
int log_file_kind(const char *path, enum log_kind *kind);

/* NULL after a message. */
struct log_file *log_file_open(const char *path);
void log_file_close(struct log_file *log);

/* 1: *event is the next one; 0: the end of the file. What is skipped on the way is said. */
int log_file_next(struct log_file *log, struct log_event *event);

/* Bytes of the file, read so far, and how often it was damaged. */
uint64_t log_file_size(const struct log_file *log);
uint64_t log_file_position(const struct log_file *log);
uint64_t log_file_damages(const struct log_file *log);

#endif

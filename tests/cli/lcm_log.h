/* SPDX-License-Identifier: MIT
 * lcm_log.h: LCM event logs held in memory, for tests that make a copy with an error in it. */
#ifndef TESTS_CLI_LCM_LOG_H
#define TESTS_CLI_LCM_LOG_H

#include <stddef.h>
#include <stdint.h>

struct log_entry {
    char channel[64];
    int64_t time_us;
    uint8_t *data;
    size_t size;
    int gone; /* 1: not written */
};

struct log_copy {
    struct log_entry *entries;
    size_t count, capacity;
};

/* By liblcm alone. */
void log_copy_read(struct log_copy *log, const char *path);
void log_copy_write(const struct log_copy *log, const char *path);
void log_copy_add(struct log_copy *log, const char *channel, const void *data, size_t size);
/* A copy of its own. */
struct log_copy log_copy_of(const struct log_copy *log);
void log_copy_free(struct log_copy *log);

/* A whole file. */
uint8_t *file_bytes(const char *path, size_t *size);
void file_write(const char *path, const uint8_t *bytes, size_t size);

#endif

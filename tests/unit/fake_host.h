/* SPDX-License-Identifier: MIT
 * fake_host.h: what a program gives the library to use: memory that counts and fails, a log that remembers. */
#ifndef FAKE_HOST_H
#define FAKE_HOST_H

#include <tahr/tahr.h>

/* Fails the fail_at-th request and all that follow, or that one only (1 = the first; 0 = never). */
typedef struct fake_memory {
    uint64_t live_blocks, live_bytes, requests, fail_at;
    int fail_once;
    int mismatches; /* free with another size or alignment than alloc, or of NULL */
} fake_memory;
tahr_allocator fake_allocator(fake_memory *memory);

/* A log that keeps the last message. */
typedef struct fake_log {
    char text[512];
    int count;
} fake_log;
tahr_log fake_log_of(fake_log *log);

#endif

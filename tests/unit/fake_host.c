/* SPDX-License-Identifier: MIT
 * fake_host.c: see fake_host.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_host.h"

/* In front of every block: what was asked for, and where malloc's memory begins. */
typedef struct block {
    void *start;
    size_t size, alignment;
} block;

static void *memory_alloc(void *user, size_t size, size_t alignment)
{
    fake_memory *m = user;
    m->requests++;
    if (m->fail_at && (m->fail_once ? m->requests == m->fail_at : m->requests >= m->fail_at)) {
        return NULL;
    }
    char *start = malloc(size + alignment + sizeof(block));
    assert_non_null(start);
    size_t at = ((size_t)(uintptr_t)start + sizeof(block) + alignment - 1) & ~(alignment - 1);
    char *memory = start + (at - (size_t)(uintptr_t)start);
    block b = {start, size, alignment};
    memcpy(memory - sizeof b, &b, sizeof b);
    memset(memory, 0xA5, size);
    m->live_blocks++;
    m->live_bytes += size;
    return memory;
}

static void memory_free(void *user, void *memory, size_t size, size_t alignment)
{
    fake_memory *m = user;
    block b;
    if (!memory) {
        m->mismatches++;
        return;
    }
    memcpy(&b, (char *)memory - sizeof b, sizeof b);
    m->mismatches += b.size != size || b.alignment != alignment;
    m->live_blocks--;
    m->live_bytes -= b.size;
    free(b.start);
}

tahr_allocator fake_allocator(fake_memory *memory)
{
    tahr_allocator a = {memory, memory_alloc, memory_free};
    return a;
}

static void keep_message(void *user, int32_t level, const char *message)
{
    fake_log *log = user;
    (void)level;
    log->count++;
    snprintf(log->text, sizeof log->text, "%s", message);
}

tahr_log fake_log_of(fake_log *log)
{
    tahr_log l = {log, keep_message};
    memset(log, 0, sizeof *log);
    return l;
}

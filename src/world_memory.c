/* SPDX-License-Identifier: MIT
 * world_memory.c: the default allocator, and one that counts what a world holds. */
#include "world_memory.h"

#include <stdlib.h>

/* Alignment without aligned_alloc (missing on some systems): the true start is kept in front of what is handed out. */
static void *plain_alloc(void *user, size_t size, size_t alignment)
{
    (void)user;
    if (size > SIZE_MAX - alignment - sizeof(void *)) {
        return NULL;
    }
    void *start = malloc(size + alignment + sizeof(void *));
    if (!start) {
        return NULL;
    }
    uintptr_t at = ((uintptr_t)start + sizeof(void *) + alignment - 1) & ~(uintptr_t)(alignment - 1);
    ((void **)at)[-1] = start;
    return (void *)at;
}

static void plain_free(void *user, void *memory, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    if (memory) {
        free(((void **)memory)[-1]);
    }
}

const tahr_allocator tahr__malloc = {NULL, plain_alloc, plain_free};

static void *counting_alloc(void *user, size_t size, size_t alignment)
{
    tahr__memory *m = user;
    void *memory = m->user.alloc(m->user.user, size, alignment);
    if (memory) {
        m->bytes += size;
    }
    return memory;
}

static void counting_free(void *user, void *memory, size_t size, size_t alignment)
{
    tahr__memory *m = user;
    if (memory) { /* nothing was counted for NULL */
        m->bytes -= size;
        m->user.free(m->user.user, memory, size, alignment);
    }
}

tahr_allocator tahr__counting_allocator(tahr__memory *memory)
{
    tahr_allocator allocator = {memory, counting_alloc, counting_free};
    return allocator;
}

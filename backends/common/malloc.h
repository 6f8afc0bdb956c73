/* SPDX-License-Identifier: MIT
 * malloc.h: the allocator that is meant where none is given, for libraries beside libtahr, which has its own. */
#ifndef TAHR_COMMON_MALLOC_H
#define TAHR_COMMON_MALLOC_H

#include <stdlib.h>

#include <tahr/abi.h>

static inline void *tahr__malloc_alloc(void *user, size_t size, size_t alignment)
{
    (void)user;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static inline void tahr__malloc_free(void *user, void *memory, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    free(memory);
}

/* What was given, or malloc for NULL. */
static inline tahr_allocator tahr__allocator_or_malloc(const tahr_allocator *given)
{
    const tahr_allocator plain = {NULL, tahr__malloc_alloc, tahr__malloc_free};
    return given ? *given : plain;
}

#endif

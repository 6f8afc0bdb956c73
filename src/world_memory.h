/* SPDX-License-Identifier: MIT
 * world_memory.h: the default allocator, and one that counts what a world holds. */
#ifndef TAHR_WORLD_MEMORY_H
#define TAHR_WORLD_MEMORY_H

#include "core.h"

/* malloc and free with alignment. */
extern const tahr_allocator tahr__malloc;

/* An allocator in front of memory->user that keeps memory->bytes up to date. */
tahr_allocator tahr__counting_allocator(tahr__memory *memory);

#endif

/* SPDX-License-Identifier: MIT
 * room.h: memory of the host: count objects of a size, zeroed. */
#ifndef TAHR_COMMON_ROOM_H
#define TAHR_COMMON_ROOM_H

#include <tahr/backend.h>

#include <string.h>

/* NULL for none, or without memory. */
static inline void *tahr__room_get(const tahr_host *host, size_t count, size_t size)
{
    void *room = count > 0 ? host->allocator.alloc(host->allocator.user, count * size, 64) : NULL;
    return room ? memset(room, 0, count * size) : NULL;
}

static inline void tahr__room_put(const tahr_host *host, void *room, size_t count, size_t size)
{
    if (room) host->allocator.free(host->allocator.user, room, count * size, 64);
}

#endif

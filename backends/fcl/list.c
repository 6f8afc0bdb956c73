/* SPDX-License-Identifier: MIT
 * list.c: the candidates of a query: on the stack, or beyond that by the host's allocator. */
#include "engine.h"

#include <stdlib.h>
#include <string.h>

void tahr__fcl_list_begin(tahr__fcl_list *list, const tahr_host *host, tahr__fcl_part *room, uint32_t capacity)
{
    list->host = host;
    list->parts = room;
    list->count = 0;
    list->capacity = capacity;
    list->grown = 0;
    list->status = TAHR_OK;
}

void tahr__fcl_list_free(tahr__fcl_list *list)
{
    const tahr_allocator *a = &list->host->allocator;

    if (list->grown) a->free(a->user, list->parts, list->capacity * sizeof *list->parts, 16);
    list->grown = 0;
}

static void grow(tahr__fcl_list *list)
{
    const tahr_allocator *a = &list->host->allocator;
    uint32_t capacity = list->capacity * 2;
    tahr__fcl_part *parts =
        list->capacity < 1u << 30 ? a->alloc(a->user, capacity * sizeof *parts, 16) : (tahr__fcl_part *)NULL;

    if (!parts) {
        list->status = TAHR_E_MEMORY;
        return;
    }
    memcpy(parts, list->parts, list->count * sizeof *parts);
    tahr__fcl_list_free(list);
    list->parts = parts;
    list->capacity = capacity;
    list->grown = 1;
}

void tahr__fcl_list_add(tahr__fcl_list *list, const tahr__fcl_part *part)
{
    if (list->count == list->capacity) grow(list);
    if (list->status >= 0) list->parts[list->count++] = *part;
}

/* Cells in the order of an octree's leaves, in which they come: the highest bit that differs decides, z before y before
 * x. */
static int compare_keys(const uint16_t a[3], const uint16_t b[3])
{
    int first = 2;

    for (int i = 1; i >= 0; i--) {
        unsigned d = a[i] ^ b[i], e = a[first] ^ b[first];
        if (e < d && e < (e ^ d)) first = i; /* d has the higher bit */
    }
    return a[first] < b[first] ? -1 : a[first] > b[first];
}

static int compare(const tahr__fcl_part *a, const tahr__fcl_part *b)
{
    if (a->body != b->body) return a->body < b->body ? -1 : 1;
    if (a->triangle != b->triangle) return a->triangle < b->triangle ? -1 : 1;
    return compare_keys(a->key, b->key);
}

/* Most lists are short, or in order already. qsort of long ones may allocate (glibc's merge sort beyond a kilobyte), so
 * a heap sorts them in place. */
static void sift(tahr__fcl_part *p, uint32_t at, uint32_t count)
{
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare(&p[child], &p[child + 1]) < 0) child++;
        if (compare(&p[at], &p[child]) >= 0) return;
        tahr__fcl_part swap = p[at];
        p[at] = p[child];
        p[child] = swap;
    }
}

void tahr__fcl_list_sort(tahr__fcl_list *list)
{
    tahr__fcl_part *p = list->parts;
    uint32_t n = list->count, sorted = 1;

    while (sorted < n && compare(&p[sorted - 1], &p[sorted]) <= 0)
        sorted++;
    if (sorted >= n) return;
    for (uint32_t i = n / 2; i-- > 0;)
        sift(p, i, n);
    for (uint32_t i = n; i-- > 1;) {
        tahr__fcl_part swap = p[0];
        p[0] = p[i];
        p[i] = swap;
        sift(p, 0, i);
    }
}

/* SPDX-License-Identifier: MIT
 * places.c: a table of poses by id: open addressing, at most half full, nothing is ever taken out. The cost of a change
 * is that of what it names, not of all bodies. */
#include "places.h"

/* The number of a body, or capacity: no room. */
static uint32_t number_of(tahr__places *b, uint32_t body, int *is_new)
{
    const uint32_t mask = b->bucket_count - 1;
    uint32_t i = (body * 0x9E3779B1u) >> 7 & mask; /* 2^32 / golden ratio: spreads ids in a row */
    *is_new = 0;
    for (; b->buckets[i]; i = (i + 1) & mask)
        if (b->now[b->buckets[i] - 1].body == body) return b->buckets[i] - 1;
    if (b->count == b->capacity) return b->capacity;
    b->buckets[i] = ++b->count;
    *is_new = 1;
    return b->count - 1;
}

int tahr__places_set(tahr__places *b, const tahr_body_pose *poses, uint32_t count)
{
    int all = 1, is_new;
    for (uint32_t i = 0; b->capacity > 0 && i < count; i++) {
        const uint32_t k = number_of(b, poses[i].body, &is_new);
        if (k < b->capacity)
            b->before[k] = b->now[k] = poses[i];
        else
            all = 0;
    }
    return all;
}

/* Who is not named again rests where the last motion put him. */
static void settle(tahr__places *b)
{
    for (uint32_t i = 0; i < b->last_count; i++) {
        const uint32_t k = b->last[i];
        b->now[k].flags = 0;
        b->before[k] = b->now[k];
    }
    b->last_count = 0;
    b->unknown = 0;
}

int tahr__places_move(tahr__places *b, const tahr_body_pose *poses, uint32_t count, double dt, uint64_t epoch)
{
    int all = 1, is_new;
    settle(b);
    b->dt = dt;
    for (uint32_t i = 0; b->capacity > 0 && i < count; i++) {
        const uint32_t k = number_of(b, poses[i].body, &is_new);
        if (k == b->capacity) {
            all = 0;
            continue;
        }
        if (is_new) {
            b->before[k] = poses[i];
            b->before[k].flags = 0;
            b->unknown = 1;
        }
        b->now[k] = poses[i];
        if (b->moved[k] != epoch) b->last[b->last_count++] = k; /* once, also if it is named twice */
        b->moved[k] = epoch;
    }
    return all;
}

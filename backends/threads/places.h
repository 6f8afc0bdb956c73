/* SPDX-License-Identifier: MIT
 * places.h: where the bodies are that were named so far, for snapshots of the world. */
#ifndef TAHR_THREADS_PLACES_H
#define TAHR_THREADS_PLACES_H

#include <tahr/world.h>

typedef struct tahr__places {
    tahr_body_pose *before, *now; /* in the order in which they were first named */
    uint64_t *moved;              /* in which epoch: 0, never */
    uint32_t *last;               /* numbers of those that took part in the last motion, last_count of them */
    uint32_t *buckets;            /* numbers and 1, by a hash of the id; bucket_count of them, a power of two */
    uint32_t count, capacity;
    uint32_t last_count, bucket_count;
    uint32_t unknown; /* 1: one of them was named for the first time in the last motion: where that began nobody said */
    uint32_t reserved;
    double dt; /* of the last motion; 0: there was none */
} tahr__places;

/* tahr_world_set. Returns 0 if there was no room for all. */
int tahr__places_set(tahr__places *places, const tahr_body_pose *poses, uint32_t count);

/* tahr_world_move, the change that makes the epoch. Returns 0 if there was no room for all. */
int tahr__places_move(tahr__places *places, const tahr_body_pose *poses, uint32_t count, double dt, uint64_t epoch);

#endif

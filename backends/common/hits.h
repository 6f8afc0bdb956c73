/* SPDX-License-Identifier: MIT
 * hits.h: putting what a sweep met into the order of the contract: sensors up to the first blocking hit, then that
 * hit. Any backend may find them in any order. */
#ifndef TAHR_COMMON_HITS_H
#define TAHR_COMMON_HITS_H

#include "surface.h"
#include "vec.h"

/* Sensor bodies reported by one sweep; more are dropped, the farthest first. */
enum { TAHR__MAX_SENSORS = 16 };

typedef struct tahr__hits {
    double hair; /* the part of the motion that counts as the same time */
    uint32_t sensor_count, lost;
    uint32_t found, reserved;
    tahr_hit best; /* blocking, if found */
    tahr_hit sensors[TAHR__MAX_SENSORS];
} tahr__hits;

void tahr__hits_begin(tahr__hits *hits, double motion_length);

/* Fills in what the body says. */
void tahr__hit_of(const tahr__surface *surface, tahr_hit *hit);

/* Keeps a hit if it counts. */
void tahr__hits_keep(tahr__hits *hits, const tahr_hit *hit);

/* What is met later than this cannot matter any more; negative: nothing can. */
double tahr__hits_limit(const tahr__hits *hits);

/* Writes the answer of the sweep slot and returns its status. */
tahr_status tahr__hits_write(const tahr__hits *hits, tahr_hit *out, uint32_t capacity, uint32_t *count);

/* Order of answers: where, then who. Overlaps at the start come first, the deepest of them first. */
int tahr__hit_before(const tahr_hit *a, const tahr_hit *b);

#endif

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

/* Relative: a normal's rounding is 1e-16 by projection; motion flatter than this to a surface is parallel. */
#define TAHR__PARALLEL 1e-12

static inline int tahr__approaches(tahr_vec3 motion, double motion_length, tahr_vec3 normal)
{
    return v_dot(motion, normal) < -TAHR__PARALLEL * motion_length;
}

/* Is a contact of a sweep news? Only what is approached blocks; an overlap at the start does so whatever the motion,
 * unless it may be left. A sensor does not block, so there is nothing to leave: its overlap is always news. */
static inline int tahr__hit_counts(uint32_t sweep_flags, const tahr__surface *surface, double distance, int approaches)
{
    int leaves = sweep_flags & TAHR_SWEEP_LEAVE_OVERLAP && !(surface->flags & TAHR_BODY_SENSOR);
    return approaches || (distance < 0 && !leaves);
}

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

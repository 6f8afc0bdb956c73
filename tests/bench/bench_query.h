/* SPDX-License-Identifier: MIT
 * bench_query.h: what single queries cost on a backend, and how far off they are. */
#ifndef TAHR_BENCH_QUERY_H
#define TAHR_BENCH_QUERY_H

#include "bench_world.h"

enum { BENCH_MAX_QUERIES = 4000 };

/* The sweeps and contact queries that wandering characters asked in a world, on the exact backend. */
typedef struct bench_queries {
    tahr_world *exact; /* native: gaps within 1e-9 m of the quad-precision truth */
    tahr_world *plain; /* the same bodies, but those of one way are there from all sides: it measures */
    const bench_world *world;
    tahr_sweep sweeps[BENCH_MAX_QUERIES];
    tahr_contact_query contacts[BENCH_MAX_QUERIES];
    uint32_t sweep_count, contact_count;
} bench_queries;

typedef struct bench_query_result {
    double sweep_ns, contacts_ns;      /* per query, by processor time; without a character's cache */
    double gap_p50, gap_p99, gap_max;  /* m: off the margin at the place where a sweep stops */
    double depth_max;                  /* m: off the exact depth of what begins half a margin deep */
    uint32_t hits, misses, false_hits; /* what margins of 1e-6 m more or less do not explain is a miss or a false hit */
    uint32_t at_start, overlaps;       /* hits at fraction 0; places half a margin deep */
    uint32_t sweeps, contact_queries;
} bench_query_result;

/* Walks and records. Returns 0 and an explanation in error (capacity 256) if it could not. */
int bench_queries_make(bench_queries *queries, const bench_world *world, char *error);
void bench_queries_free(bench_queries *queries);

/* Asks them all on a backend. Returns a status. */
tahr_status bench_queries_run(const bench_queries *queries, const bench_world *world, const scene_backend *backend,
                              bench_query_result *result);

#endif

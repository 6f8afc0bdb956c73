/* SPDX-License-Identifier: MIT
 * oracle.h: an independent answer to "how far apart?" for tests of distances and sweeps: brute force in long double. */
#ifndef TAHR_TEST_ORACLE_H
#define TAHR_TEST_ORACLE_H

#include <stdint.h>

/* A core is a centre and 0, 1 or 3 half axes. */
typedef struct oracle_core {
    int axis_count;
    double centre[3], axis[3][3];
} oracle_core;

/* Distance of the core, moved by t * motion, to the triangle. Enumerates every combination of active constraints of
 * the nearest-point problem (3^axes faces of the core times 7 of the triangle) and solves each as least squares; no
 * case of the geometry is treated specially. */
long double oracle_distance(const oracle_core *core, const double motion[3], long double t, double tri[3][3]);

/* Smallest distance over t in [0, 1], by ternary search: the distance is convex in t. */
long double oracle_smallest(const oracle_core *core, const double motion[3], double tri[3][3]);

/* A small generator for tests: the same numbers everywhere. */
typedef struct oracle_random {
    uint64_t state;
} oracle_random;

double oracle_uniform(oracle_random *random, double low, double high);
uint32_t oracle_below(oracle_random *random, uint32_t bound);

#endif

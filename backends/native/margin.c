/* SPDX-License-Identifier: MIT
 * margin.c: how far around what was announced to gather. Far: seldom, but all that lies there is formed, and every
 * query looks at it. What is best depends on how dense the scene is there, which is known from what was gathered
 * last. It decides nothing but the time: queries answer the same from the cache and from the trees. */
#include "scene.h"

/* What things cost, in instructions (callgrind, gcc -O3 with AVX2, walkers in a dungeon and on hills of 0.25 m): a
 * gather without its primitives; forming one; having one more in the cache for a step of two or three queries. */
#define GATHER 2500.0
#define FORM 220.0
#define KEEP 12.0
/* Steps that a gather lasts for every metre of the margin: a character that wanders at 5 m/s and 60 Hz takes twelve to
 * walk one straight on; measured over margins of 0.25 to 2 m. */
#define STEPS_PER_METRE 10.7
/* More than fits anywhere. */
#define DENSE 1e30

/* Fractions of the margin that is allowed, and one over each; below an eighth a gather does not last for two steps. */
static const double FRACTIONS[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
static const double INVERSE[] = {1, 1 / 0.75, 2, 1 / 0.375, 4, 1 / 0.1875, 8};
enum { CHOICES = sizeof FRACTIONS / sizeof FRACTIONS[0] };

/* Instructions per step with every margin: surfaces grow with the square of the width. */
double tahr__margin_best(const tahr__native *world, double width, double density)
{
    double most = world->cache_margin, often = 1 / (STEPS_PER_METRE * most), best = most, least = 1e300;
    if (world->fixed_margin || density <= 0) return most;
    for (int i = 0; i < CHOICES; i++) {
        double m = FRACTIONS[i] * most, side = width + 2 * m, n = density * (side * side);
        double c = (GATHER + FORM * n) * (INVERSE[i] * often) + KEEP * n;
        /* What does not fit is not gathered at all. */
        if (c >= least || (n > world->capacity && i + 1 < CHOICES)) continue;
        least = c;
        best = m;
    }
    return best;
}

double tahr__margin_next(const tahr__native *world, double width, double margin, uint32_t count, double *density)
{
    double least = FRACTIONS[CHOICES - 1] * world->cache_margin, side = width + 2 * margin;
    *density = count > world->capacity ? DENSE : count / (side * side);
    if (world->fixed_margin || margin <= least) return margin;
    if (count > world->capacity) return d_max(0.5 * margin, least);
    double best = tahr__margin_best(world, width, *density);
    /* To form what was found costs more than to look again only where it is much too much. */
    return best <= 0.5 * margin ? best : margin;
}

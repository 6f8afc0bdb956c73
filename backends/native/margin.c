/* SPDX-License-Identifier: MIT
 * margin.c: how far around what was announced to gather. Far: seldom, but all that lies there is formed, and every
 * query looks at it. What is best depends on how dense the scene is there, which is known from what was gathered
 * last. It decides nothing but the time: queries answer the same from the cache and from the trees. */
#include "scene.h"

/* What things cost, in instructions (callgrind, gcc -O3 with AVX2, walkers in a dungeon): a gather without its
 * primitives, and what is found out anew after it; forming one; having one more in the cache for a step of two or three
 * queries. */
#define GATHER 3500.0
#define FORM 150.0
#define KEEP 8.0
/* Steps that a gather lasts for every metre of the margin: a character that wanders at 5 m/s and 60 Hz takes twelve to
 * walk one straight on; measured over margins of 0.25 to 2 m. */
#define STEPS_PER_METRE 10.7

/* A character of 0.7 m has at 60 Hz a box 1.1 m wide, and the margin of 0.5 m that is usual is less than one. Who is
 * small goes a short way in a step: what is farther than a box of it would only fill the cache. */
#define BOXES 1.0

/* Fractions of the margin that is allowed, and one over each; below an eighth a gather does not last for two steps. */
static const double FRACTIONS[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
static const double INVERSE[] = {1, 1 / 0.75, 2, 1 / 0.375, 4, 1 / 0.1875, 8};
enum { CHOICES = sizeof FRACTIONS / sizeof FRACTIONS[0] };

double tahr__margin_most(const tahr__native *world, double width)
{
    return world->fixed_margin ? world->cache_margin : d_min(world->cache_margin, BOXES * width);
}

/* The fraction with the fewest instructions per step: surfaces grow with the square of the width. density: primitives
 * per m2. */
static double best_of(const tahr__native *world, double width, double density)
{
    double most = tahr__margin_most(world, width), often = 1 / (STEPS_PER_METRE * most), best = FRACTIONS[CHOICES - 1],
           least = 1e300;
    for (int i = 0; i < CHOICES; i++) {
        double side = width + 2 * FRACTIONS[i] * most, n = density * (side * side);
        double c = (GATHER + FORM * n) * (INVERSE[i] * often) + KEEP * n;
        if (c >= least || n > world->capacity) continue; /* what does not fit is not gathered at all */
        least = c;
        best = FRACTIONS[i];
    }
    return best * most;
}

int tahr__margin_choose(const tahr__native *world, double width, uint32_t count, double *margin)
{
    double most = tahr__margin_most(world, width), least = FRACTIONS[CHOICES - 1] * most, was = *margin;
    double side = width + 2 * was;
    if (world->fixed_margin) return 0;
    if (count > world->capacity) {
        *margin = d_max(0.5 * was, least);
        return was > least;
    }
    *margin = best_of(world, width, count / (side * side));
    /* To look again pays only where what was found is much too much to form. */
    return *margin <= 0.5 * was;
}

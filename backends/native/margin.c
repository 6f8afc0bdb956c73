/* SPDX-License-Identifier: MIT
 * margin.c: how far around what was announced to gather. Far: seldom, but all that lies there is formed, and every
 * query looks at it. What is best depends on how dense the scene is there, which is found out by counting. It
 * decides nothing but the time: queries answer the same from the cache and from the trees. */
#include "scene.h"

/* What things cost, in instructions (callgrind, gcc -O3 with AVX2, walkers in a dungeon and on hills of 0.25 m): a
 * gather without its primitives; forming one; having one more in the cache for a step of two or three queries. */
#define GATHER 2500.0
#define FORM 220.0
#define KEEP 12.0
/* Steps that a gather lasts for every metre of the margin: a character that wanders at 5 m/s and 60 Hz takes twelve to
 * walk one straight on; measured over margins of 0.25 to 2 m. */
#define STEPS_PER_METRE 10.7

/* Of a character of 0.7 m at 60 Hz the box is 1.1 m wide, and the margin of 0.5 m that is usual less than one. */
#define BOXES 1.0

/* Fractions of the margin that is allowed; below an eighth a gather does not last for two steps. */
static const double FRACTIONS[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
enum { CHOICES = sizeof FRACTIONS / sizeof FRACTIONS[0] };

/* What fills less of the cache than one in this many may be dense enough with twice the margin. */
enum { SPARSE = 4 };

static tahr_bounds grown(const tahr_bounds *box, double margin)
{
    tahr_vec3 m = v_make(margin, margin, margin);
    return (tahr_bounds){v_sub(box->min, m), v_add(box->max, m)};
}

/* Instructions per step with a margin, of surfaces: their number grows with the square of the width. */
static double cost(double count, double width, double counted, double margin)
{
    double side = (width + 2 * margin) / (width + 2 * counted), n = count * side * side;
    return (GATHER + FORM * n) / (STEPS_PER_METRE * margin) + KEEP * n;
}

int tahr__margin_choose(const tahr__query *query, const tahr_bounds *announced, double *counted, double *margin)
{
    const tahr__native *world = query->world;
    const double width = announced->max.x - announced->min.x;
    /* Who is small goes a short way in a step: what is farther than some of its boxes would only fill the cache. */
    const double most = d_min(world->cache_margin, BOXES * width);
    double at = *counted > 0 ? d_min(*counted, most) : most;
    uint32_t room = world->capacity, count;
    int fitted = 0;
    *margin = world->fixed_margin ? world->cache_margin : most;
    if (world->fixed_margin) return 1;
    for (;;) {
        tahr_bounds box = grown(announced, at);
        count = tahr__tree_count(query, &world->fixed, &box, room);
        if (count <= room && (at >= most || count > room / SPARSE || fitted < 0)) break;
        if (count > room && at <= FRACTIONS[CHOICES - 1] * most) break;
        if (count > room) fitted = -1;
        at = count > room ? 0.5 * at : d_min(2 * at, most);
    }
    *counted = at;
    /* It will not fit much farther on either. */
    if (count > room) {
        *margin = 0.5 * most;
        return 0;
    }
    double least = 1e300;
    for (int i = 0; i < CHOICES; i++) {
        double m = FRACTIONS[i] * most, c = cost(count, width, at, m);
        if (m > at || c >= least) continue;
        least = c;
        *margin = m;
    }
    return 1;
}

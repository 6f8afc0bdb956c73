/* SPDX-License-Identifier: MIT
 * convex.h: convex shapes by their support functions, the distance between any two of them, and the way out of each
 * other.
 *
 * Unlike core.h, which has a closed form for each of its pairs, this works for every pair: it is an iteration (GJK:
 * Gilbert, Johnson, Keerthi 1988), in double, with a certificate: the gap between the two planes that touch the shapes
 * from the inside of the gap is never more than the distance. Coordinates should be relative to one of the shapes. */
#ifndef TAHR_COMMON_CONVEX_H
#define TAHR_COMMON_CONVEX_H

#include "vec.h"

enum {
    TAHR__CONVEX_SUM = 0,   /* centre and `count` half axes (0: a point, 1: a segment, 3: a box) */
    TAHR__CONVEX_POINTS,    /* the hull of `count` points, relative to the centre and turned */
    TAHR__CONVEX_CYLINDER,  /* axis[0] from the centre to the middle of the top, radius */
    TAHR__CONVEX_CONE,      /* axis[0] from the centre to the apex, as far from the centre as the base; radius of it */
    TAHR__CONVEX_ELLIPSOID, /* axis[0..2]: semi-axes, perpendicular to each other */
};

typedef struct tahr__convex {
    uint32_t kind;
    uint32_t count;
    tahr_vec3 centre;
    tahr_vec3 axis[3];
    double radius;
    const tahr_vec3 *points; /* POINTS: times scale, turned by *turn if that is not NULL */
    const tahr__mat *turn;
    double scale;
} tahr__convex;

/* The farthest point along direction, which need not be unit and must not be zero. [out] index (may be NULL): which of
 * the points it is, else 0. */
tahr_vec3 tahr__convex_support(const tahr__convex *c, tahr_vec3 direction, uint32_t *index);

/* Extent along the unit vector n: the highest of its points, measured along n. */
static inline double tahr__convex_extent(const tahr__convex *c, tahr_vec3 n)
{
    return v_dot(tahr__convex_support(c, n, NULL), n);
}

typedef struct tahr__gap {
    double distance;  /* between the witness points: not less than the true distance; 0: they overlap */
    double lower;     /* the gap between the planes across normal, the largest that was found: not more than the true
                       * distance; negative where no plane was found that passes between them */
    tahr_vec3 normal; /* unit, from b to a */
    tahr_vec3 on_a, on_b; /* not set where the distance is 0 */
    double weight[3];     /* of the first three points of b, if it has so many: where on_b lies between them */
    uint32_t iterations;  /* support points asked for */
    uint32_t given_up;    /* 1: the cap on iterations ended it; lower and distance hold all the same */
    uint32_t clear;       /* 1: tahr__convex_clear ended it early */
    uint32_t reserved;
} tahr__gap;

/* Distance of a and b. first: a guess of the normal, or zero. With shapes about 1 m in size lower and distance differ
 * by 1e-12 m, more only where given_up says so. */
void tahr__convex_distance(const tahr__convex *a, const tahr__convex *b, tahr_vec3 first, tahr__gap *gap);

/* What a question about a motion of a need not know better: that it stays farther than reach, and how far it is beyond
 * that while it is far. */
typedef struct tahr__clearance {
    tahr_vec3 motion;
    double reach;
} tahr__clearance;

/* The same, ended as soon as there is a plane whose gap is wider than reach even at the end of the motion (clear: only
 * lower and normal are set then), or as lower tells what is beyond reach to a tenth. */
void tahr__convex_clear(const tahr__convex *a, const tahr__convex *b, tahr_vec3 first, const tahr__clearance *enough,
                        tahr__gap *gap);

/* How far a must move along the unit vector n to leave b: exact for this direction; negative if they are apart along
 * it. */
static inline double tahr__convex_way(const tahr__convex *a, const tahr__convex *b, tahr_vec3 n)
{
    return tahr__convex_extent(b, n) + tahr__convex_extent(a, v_scale(n, -1));
}

/* A short way for a out of b. guesses: directions worth a look (unit; tried both ways). The depth is exact for the
 * normal that is returned, moving by it separates the two; no direction near it is shorter, and it is the shortest of
 * all wherever that is among the guesses or is reached from one of the four best of them and of 26 fixed directions.
 * size: about that of the smaller shape. */
double tahr__convex_leave(const tahr__convex *a, const tahr__convex *b, const tahr_vec3 *guesses, uint32_t count,
                          double size, tahr_vec3 *normal);

#endif

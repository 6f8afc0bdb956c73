/* SPDX-License-Identifier: MIT
 * convex_near.h: signed distance, way out and faces where a cylinder, cone, ellipsoid or hull is on either side: what
 * core.h, with a closed form for each of its pairs, cannot tell. Directions come out of an iteration, so that they are
 * less sure than those of cores, and everything that compares them knows by how much. */
#ifndef TAHR_COMMON_CONVEX_NEAR_H
#define TAHR_COMMON_CONVEX_NEAR_H

#include "convex.h"
#include "core.h"
#include "hull_planes.h"

/* The distance is certain to 1e-12 of the size of shapes of about 1 m, and so a direction to its square root.
 * Directions closer than this are one, and so are places (m). */
#define TAHR__SAME_DIRECTION 3e-6
#define TAHR__SAME_PLACE 1e-5

/* Where a shape is nearest to a piece of a body. */
typedef struct tahr__near {
    double distance;  /* signed, between the surfaces */
    double lean;      /* sine of the angle by which rounding may have turned the normal of two that hardly part; or 0 */
    tahr_vec3 normal; /* unit, from the piece to the shape, or the way out */
    tahr_vec3 point;  /* on the surface of the piece */
    uint32_t part;    /* of a triangle: TAHR__FACE, TAHR__EDGE + i, TAHR__CORNER + i */
    uint32_t rough;   /* 1: by iteration: directions and places are those within TAHR__SAME_DIRECTION, _PLACE */
} tahr__near;

/* One of the two. */
typedef struct tahr__convex_side {
    tahr__convex convex;             /* without the radius */
    double radius;                   /* around it */
    const tahr__hull_planes *planes; /* of a hull, else NULL */
    uint32_t ways_out;               /* of a triangle, else 0: as sides of tahr__core_leave_triangle */
    uint32_t reserved;
} tahr__convex_side;

/* The winding's normal of a triangle. */
tahr_vec3 tahr__convex_triangle_normal(const tahr_vec3 v[3]);

/* The nearest points of a shape and a piece, whose triangles are three points around a centre at the origin. enough:
 * NULL, or what a motion need not know better (convex.h): then beyond its reach distance and normal are a plane between
 * the two that the motion does not cross before they say so, and the rest is not sure. */
void tahr__convex_measure(const tahr__convex_side *shape, const tahr__convex_side *piece, const tahr__clearance *enough,
                          tahr__near *near);

/* Where a touches b that it has just left along normal, by depth: of two flat faces some point that both hold. */
void tahr__convex_touch(const tahr__convex *a, const tahr__convex *b, double depth, tahr_vec3 normal, tahr__gap *gap);

/* convex_face.c: of a cylinder, cone, ellipsoid or hull the face along direction among those at the nearest point. */
void tahr__convex_face(const tahr__convex_side *piece, const tahr__near *near, tahr_vec3 direction, tahr_vec3 *face);
/* Which of the faces of a hull is most along a direction. */
uint32_t tahr__convex_hull_face(const tahr__convex_side *piece, tahr_vec3 direction);

#endif

/* SPDX-License-Identifier: MIT
 * piece.h: one convex piece of a body as a query sees it (a triangle of a mesh, a box, a sphere, a capsule, a half
 * space, or any other convex body), with everything that the core distance decides about it: signed distance, both
 * normals, which face, and whether an edge of a mesh is to be felt. All coordinates are relative to the start of the
 * query and in its unit. */
#ifndef TAHR_COMMON_PIECE_H
#define TAHR_COMMON_PIECE_H

#include "convex_near.h"
#include "core.h"
#include "hull.h"
#include "mesh.h"

enum { TAHR__TRIANGLE = 0, TAHR__BOX = 1, TAHR__ROUND = 2, TAHR__HALF_SPACE = 3, TAHR__CONVEX = 4 };

/* Where the frame of a body is: corners are base + turn * local * scale. */
typedef struct tahr__placement {
    tahr_vec3 base; /* relative to the start of the query */
    tahr__mat turn;
    double scale;    /* units of the query in a metre: a power of two, which rounds nothing */
    uint32_t turned; /* 0: turn is the identity */
    uint32_t reserved;
} tahr__placement;

typedef struct tahr__piece {
    uint32_t kind;
    uint32_t two_sided; /* triangles and half spaces (a plane) */
    const tahr__placement *frame;
    const tahr__mesh *mesh;
    uint32_t triangle; /* in leaf order of the mesh */
    uint32_t is_cell;  /* 1: a box that is a cell of a larger solid */
    tahr__facet facet;
    /* Boxes: centre and half axes. Round bodies: centre, half the axis, radius. Half spaces: a point on the surface
     * and, as axis[0], the unit normal. */
    tahr__core solid;
    tahr_vec3 middle, half; /* half: of boxes */
    double radius;
    tahr__convex_side convex; /* cylinders, cones, ellipsoids, hulls */
} tahr__piece;

/* A shape as core and radius, or if is_convex as convex, without a radius. Not to be copied: convex points into it. */
typedef struct tahr__shape {
    tahr__core core;
    double radius;
    uint32_t is_convex, reserved;
    tahr__mat turn; /* of hulls */
    tahr__convex_side convex;
} tahr__shape;

/* Extent along n from the centre. */
static inline double tahr__shape_extent(const tahr__shape *shape, tahr_vec3 n)
{
    return shape->is_convex ? tahr__convex_extent(&shape->convex.convex, n) : tahr__core_extent(&shape->core, n);
}

/* Where a query starts, in metres, and its unit. */
typedef struct tahr__start {
    tahr_vec3 origin;
    double scale;
} tahr__start;

/* A frame from a position and a turn, seen from there. */
void tahr__placement_make(tahr_vec3 position, const tahr__mat *turn, const tahr__start *start, tahr__placement *frame);

/* Fill in a piece; the frame must live as long as it. Round bodies: reach is half the axis along z. */
void tahr__piece_triangle(const tahr__placement *frame, const tahr__mesh *mesh, uint32_t triangle, tahr__piece *piece);
void tahr__piece_box(const tahr__placement *frame, tahr_vec3 middle, tahr_vec3 half, tahr__piece *piece);
void tahr__piece_round(const tahr__placement *frame, double radius, double reach, tahr__piece *piece);
void tahr__piece_half_space(const tahr__placement *frame, tahr_vec3 normal, double offset, tahr__piece *piece);

/* Cylinders and cones (reach: half the height along z), ellipsoids (half: their semi-axes); kind: TAHR__CONVEX_*. */
void tahr__piece_swept(const tahr__placement *frame, uint32_t kind, double radius, double reach, tahr__piece *piece);
void tahr__piece_ellipsoid(const tahr__placement *frame, tahr_vec3 half, tahr__piece *piece);
void tahr__piece_hull(const tahr__placement *frame, const tahr__hull *hull, tahr__piece *piece);

/* A query's shape. */
typedef struct tahr__shape_source {
    const tahr_shape *shape;
    tahr_vec3 up;
    tahr_quat orientation;
    const tahr__hull *hull; /* who lends the vertices of a TAHR_SHAPE_HULL, or NULL */
    double scale;           /* see tahr__placement */
} tahr__shape_source;

/* A point, for rays. */
void tahr__shape_point(tahr__shape *out);
/* TAHR_OK; TAHR_E_UNSUPPORTED for no kind of shape; TAHR_E_ARGUMENT if it is not finite, or without its hull. */
tahr_status tahr__shape_make(const tahr__shape_source *source, tahr__shape *out);

/* Both by their support functions. */
void tahr__shape_side(const tahr__shape *shape, tahr_vec3 centre, tahr__convex_side *side);
void tahr__piece_side(const tahr__piece *piece, tahr__convex_side *side);

/* Nearest points, or the way out, of a shape at centre. */
void tahr__piece_measure(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, tahr__near *near);

/* Can it be felt from here at all? One-sided triangles are not there for what is behind them. */
int tahr__piece_in_front(const tahr__piece *piece, const tahr__near *near);

/* The face along direction among those at the nearest point; the contact normal becomes the face's if it is that up to
 * rounding. Returns 0 if a neighbour at a shared edge or corner is nearer: an internal edge, not to be felt. */
int tahr__piece_face(const tahr__piece *piece, tahr_vec3 direction, tahr__near *near, tahr_vec3 *face);

/* Triangle of the caller, face of a box (-x, +x, -y, +y, -z, +z), face of a hull, 0. */
uint32_t tahr__piece_feature(const tahr__piece *piece, tahr_vec3 normal);

typedef enum tahr__verdict { TAHR__FREE, TAHR__HIT, TAHR__UNKNOWN } tahr__verdict;

typedef struct tahr__motion {
    const tahr__shape *shape;
    tahr_vec3 motion;
    double margin;
    uint64_t *iterations; /* counted up */
    uint32_t unsure;      /* 1: the fraction that an advance begins at may be late */
    uint32_t reserved;
} tahr__motion;

/* Nearest points at a fraction of a motion: within the margin; beyond it as well as a tangent needs: a plane between
 * the two that the motion does not cross before near->distance and near->normal say so. The rest of near is not sure
 * there. */
void tahr__piece_measure_far(const tahr__motion *motion, const tahr__piece *piece, double fraction, tahr__near *near);

/* The first fraction in [*fraction, limit] of a motion at which the distance falls to margin, by tangents of the convex
 * distance: never late. *fraction: 0 or known to be free, unless the motion is unsure of it. */
tahr__verdict tahr__piece_advance(const tahr__motion *motion, const tahr__piece *piece, double limit, double *fraction,
                                  tahr__near *near);

#endif

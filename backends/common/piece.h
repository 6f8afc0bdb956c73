/* SPDX-License-Identifier: MIT
 * piece.h: one convex piece of a body as a query sees it (a triangle of a mesh, a box, a sphere, a capsule, a half
 * space), with everything that the core distance decides about it: signed distance, both normals, which face, and
 * whether an edge of a mesh is to be felt. All coordinates are relative to the start of the query. */
#ifndef TAHR_COMMON_PIECE_H
#define TAHR_COMMON_PIECE_H

#include "core.h"
#include "mesh.h"

enum { TAHR__TRIANGLE = 0, TAHR__BOX = 1, TAHR__ROUND = 2, TAHR__HALF_SPACE = 3 };

/* Where the frame of a body is: corners are base + turn * local. */
typedef struct tahr__placement {
    tahr_vec3 base; /* relative to the start of the query */
    tahr__mat turn;
    uint32_t turned; /* 0: turn is the identity */
    uint32_t reserved;
} tahr__placement;

typedef struct tahr__piece {
    uint32_t kind;
    uint32_t two_sided; /* triangles and half spaces (a plane) */
    const tahr__placement *frame;
    const tahr__mesh *mesh;
    uint32_t triangle; /* in leaf order of the mesh */
    uint32_t reserved;
    tahr__facet facet;
    /* Boxes: centre and half axes. Round bodies: centre, half the axis, radius. Half spaces: a point on the surface and,
     * as axis[0], the unit normal. */
    tahr__core solid;
    tahr_vec3 middle, half; /* half: of boxes */
    double radius;
} tahr__piece;

/* A shape as core and radius. */
typedef struct tahr__shape {
    tahr__core core;
    double radius;
} tahr__shape;

/* The nearest points of a shape and a piece. */
typedef struct tahr__near {
    double distance;  /* signed, between the surfaces */
    tahr_vec3 normal; /* unit, from the piece to the shape, or the way out */
    tahr_vec3 point;  /* on the surface of the piece */
    uint32_t part;    /* of a triangle: TAHR__FACE, TAHR__EDGE + i, TAHR__CORNER + i */
    uint32_t reserved;
} tahr__near;

/* A frame from a pose, seen from the start of a query. */
void tahr__placement_make(const tahr_vec3 *position, const tahr__mat *turn, tahr_vec3 start, tahr__placement *frame);

/* Fill in a piece; the frame must live as long as it. Round bodies: reach is half the axis along z. */
void tahr__piece_triangle(const tahr__placement *frame, const tahr__mesh *mesh, uint32_t triangle, tahr__piece *piece);
void tahr__piece_box(const tahr__placement *frame, tahr_vec3 middle, tahr_vec3 half, tahr__piece *piece);
void tahr__piece_round(const tahr__placement *frame, double radius, double reach, tahr__piece *piece);
void tahr__piece_half_space(const tahr__placement *frame, tahr_vec3 normal, double offset, tahr__piece *piece);

/* The shape of a query; 0 if it is none of sphere, capsule, box or not finite. */
int tahr__shape_make(const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation, tahr__shape *out);

/* Nearest points, or the way out, of a shape at centre. */
void tahr__piece_measure(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, tahr__near *near);

/* Can it be felt from here at all? One-sided triangles are not there for what is behind them. */
int tahr__piece_in_front(const tahr__piece *piece, const tahr__near *near);

/* The face along direction among those at the nearest point; the contact normal becomes the face's if it is that up to
 * rounding. Returns 0 if a neighbour at a shared edge or corner is nearer: an internal edge, not to be felt. */
int tahr__piece_face(const tahr__piece *piece, tahr_vec3 direction, tahr__near *near, tahr_vec3 *face);

/* Triangle of the caller, face of a box (-x, +x, -y, +y, -z, +z), 0. */
uint32_t tahr__piece_feature(const tahr__piece *piece, tahr_vec3 normal);

/* The first fraction in [*fraction, limit] of a motion at which the distance falls to margin, from a fraction that is
 * known to be free, by tangents of the convex distance: never late. */
typedef enum tahr__verdict { TAHR__FREE, TAHR__HIT, TAHR__UNKNOWN } tahr__verdict;

typedef struct tahr__motion {
    const tahr__shape *shape;
    tahr_vec3 motion;
    double margin;
    uint64_t *iterations; /* counted up */
} tahr__motion;

tahr__verdict tahr__piece_advance(const tahr__motion *motion, const tahr__piece *piece, double limit, double *fraction,
                                  tahr__near *near);

#endif

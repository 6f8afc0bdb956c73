/* SPDX-License-Identifier: MIT
 * flat.h: signed distance of two convex shapes in the plane, in double. */
#ifndef TAHR_BOX2D_FLAT_H
#define TAHR_BOX2D_FLAT_H

#include <math.h>

#if defined(__FAST_MATH__)
#error "Tahr must not be compiled with -ffast-math: answers would depend on the compiler"
#endif
#if defined(__clang__) && !defined(__cplusplus)
#pragma STDC FP_CONTRACT OFF
#endif

typedef struct tahr__vec2 {
    double x, y;
} tahr__vec2;

static inline tahr__vec2 f_make(double x, double y)
{
    tahr__vec2 v;
    v.x = x;
    v.y = y;
    return v;
}

static inline tahr__vec2 f_add(tahr__vec2 a, tahr__vec2 b)
{
    return f_make(a.x + b.x, a.y + b.y);
}

static inline tahr__vec2 f_sub(tahr__vec2 a, tahr__vec2 b)
{
    return f_make(a.x - b.x, a.y - b.y);
}

/* a + b * s */
static inline tahr__vec2 f_mad(tahr__vec2 a, tahr__vec2 b, double s)
{
    return f_make(a.x + b.x * s, a.y + b.y * s);
}

static inline double f_dot(tahr__vec2 a, tahr__vec2 b)
{
    return a.x * b.x + a.y * b.y;
}

static inline double f_length(tahr__vec2 a)
{
    return sqrt(f_dot(a, a));
}

/* The unit vector along a; a itself must not be zero. */
static inline tahr__vec2 f_unit(tahr__vec2 a)
{
    double s = 1.0 / f_length(a);
    return f_make(a.x * s, a.y * s);
}

/* A quarter turn to the right: the outside of an edge whose ring runs counter-clockwise. */
static inline tahr__vec2 f_right(tahr__vec2 a)
{
    return f_make(a.y, -a.x);
}

enum { TAHR__FLAT_CORNERS = 256 };

/* A convex ring, counter-clockwise, grown by radius. One corner: a point; two: a segment, whose faces are 0, on the
 * right of who goes from corner 0 to corner 1, and 1, the other side. Face i lies between the corners i and i + 1. */
typedef struct tahr__flat {
    int count;
    int one_sided; /* a segment: only face 0 is there */
    int lone;      /* a segment: it may be left past its ends */
    double radius;
    tahr__vec2 corner[TAHR__FLAT_CORNERS];
} tahr__flat;

/* A character: at most four corners around its centre. */
typedef struct tahr__flat_shape {
    int count;
    double radius;
    tahr__vec2 corner[4];
} tahr__flat_shape;

/* Parts: face i is i, corner i is this plus i. */
enum { TAHR__FLAT_CORNER = 1024 };

typedef struct tahr__flat_near {
    double distance;   /* signed, between the surfaces */
    tahr__vec2 normal; /* unit, from the piece to the shape, or the way out */
    tahr__vec2 point;  /* on the piece's surface */
    int part;
    int crosses; /* 1: the cores touch or cross, and normal is the shortest way out */
} tahr__flat_near;

/* The shape with its centre there against a piece. closed: bits of faces (of the first 32) that are no way out. */
void tahr__flat_measure(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, unsigned closed,
                        tahr__flat_near *near);

static inline int tahr__flat_face_count(const tahr__flat *piece)
{
    return piece->count > 1 ? piece->count : 0;
}

/* Unit, outward. */
tahr__vec2 tahr__flat_normal(const tahr__flat *piece, int face);
/* Distance of the shape's core from the line through a face, and the range of its nearest corners along the face. */
double tahr__flat_height(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, int face,
                         double range[2]);
/* Length of a face. */
double tahr__flat_length(const tahr__flat *piece, int face);
/* The face whose normal is nearest to a direction; 0 of a point. */
int tahr__flat_facing(const tahr__flat *piece, tahr__vec2 direction);

#endif

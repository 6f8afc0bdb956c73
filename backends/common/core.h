/* SPDX-License-Identifier: MIT
 * core.h: exact distance between the core of a shape and a triangle, and the way out when the cores overlap.
 *
 * A sphere is a point with a radius, a capsule a segment with a radius, a box is its own core. All three are a centre
 * plus 0, 1 or 3 half axes (generators), which makes penetration the same formula for each. A triangle may be
 * degenerate: a segment (two corners equal) or a point (three equal), which is how round bodies enter. */
#ifndef TAHR_COMMON_CORE_H
#define TAHR_COMMON_CORE_H

#include "vec.h"

typedef struct tahr__core {
    int axis_count;    /* 0: point, 1: segment, 3: box */
    tahr_vec3 axis[3]; /* half extents as vectors, any direction; those of a box are perpendicular */
} tahr__core;

/* Which part of the triangle is nearest: its face, edge i (corner i to corner i+1) or corner i. */
enum { TAHR__FACE = 0, TAHR__EDGE = 1, TAHR__CORNER = 4 };

typedef struct tahr__witness {
    double distance;  /* between core and triangle, >= 0; 0: they touch or cross, then normal is not set */
    tahr_vec3 point;  /* on the triangle */
    tahr_vec3 normal; /* unit, from the triangle to the core */
    uint32_t feature; /* TAHR__FACE, TAHR__EDGE + i, TAHR__CORNER + i */
    uint32_t beside;  /* 1: nearest to something between the ends of an edge of the core */
} tahr__witness;

/* A triangle with what every measurement of it needs; what its plane needs comes first, in one line of memory. */
typedef struct tahr__facet {
    tahr_vec3 cross; /* (v[1] - v[0]) x (v[2] - v[0]) */
    double length;   /* of cross: twice the area */
    tahr_vec3 v[3];
} tahr__facet;

static inline void tahr__facet_finish(tahr__facet *f)
{
    f->cross = v_cross(v_sub(f->v[1], f->v[0]), v_sub(f->v[2], f->v[0]));
    f->length = v_length(f->cross);
}

/* Core at centre against the triangle v[0..2]. For a point core on the face the normal is set even at distance 0 (the
 * winding's side). Exact up to rounding, for slivers too: no step divides by an area. */
void tahr__core_distance(const tahr__core *core, tahr_vec3 centre, const tahr_vec3 v[3], tahr__witness *out);
/* The same, same bits, for who keeps the facet. */
void tahr__facet_distance(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out);

/* The same, same bits, of a segment near where `out` was found beside it: 1 if the same edge or corner is nearest
 * again, clear of all else; 0: it has to be asked for. A third of the work. */
int tahr__segment_again(const tahr__core *core, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out);

/* Does a box only touch the triangle, up to rounding? Then the direction between the nearest points is rounding, and
 * the way out of the triangle may lead anywhere: an axis that separates them is the normal, the triangle's own before
 * others. Sets all but the distance. */
int tahr__box_touches(const tahr__core *box, tahr_vec3 centre, const tahr__facet *f, tahr__witness *out);

/* The pieces of it. A point sets everything but beside. */
void tahr__point_facet(tahr_vec3 q, const tahr__facet *f, tahr__witness *out);

/* The same of a point that is known to lie straight over the face. */
static inline void tahr__point_face(tahr_vec3 q, const tahr__facet *f, tahr__witness *out)
{
    double inverse = 1.0 / f->length, height = v_dot(f->cross, v_sub(q, f->v[0])) * inverse;
    tahr_vec3 unit = v_scale(f->cross, inverse);
    out->feature = TAHR__FACE;
    out->distance = fabs(height);
    out->normal = height < 0 ? v_scale(unit, -1) : unit;
    out->point = v_mad(q, unit, -height);
}
/* Squared distance of the segments p0 p1 and q0 q1; *s, *t in [0,1] say where. Segments may be points. */
double tahr__segment_segment(tahr_vec3 p0, tahr_vec3 p1, tahr_vec3 q0, tahr_vec3 q1, double *s, double *t);

/* Half the extent of the core along n (n need not be unit). */
static inline double tahr__core_extent(const tahr__core *core, tahr_vec3 n)
{
    double sum = 0;
    for (int i = 0; i < core->axis_count; i++)
        sum += fabs(v_dot(core->axis[i], n));
    return sum;
}

/* How far the core must move, and along which unit normal, to leave a triangle that it touches or crosses. sides: bit 0
 * the front, bit 1 the back, bit 2 past the edges. Returns the depth (>= 0); with no possible way the front is
 * taken. */
double tahr__core_leave_triangle(const tahr__core *core, tahr_vec3 centre, const tahr_vec3 v[3], unsigned sides,
                                 tahr_vec3 *normal);

/* The same out of a solid with centre solid_centre and the half axes of solid (a box, or the segment of a capsule).
 * Returns a negative number if they do not overlap, or if together they have no volume. */
double tahr__core_leave_solid(const tahr__core *core, tahr_vec3 centre, const tahr__core *solid, tahr_vec3 solid_centre,
                              tahr_vec3 *normal);

#endif

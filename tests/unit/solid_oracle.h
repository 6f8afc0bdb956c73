/* SPDX-License-Identifier: MIT
 * solid_oracle.h: what proves or disproves an answer about two convex shapes, without a distance between them: extents
 * along a direction, and the distance of a point to one shape, in long double and closed form (of an ellipsoid by
 * bisection of its one equation). A gap between extents is a lower bound of the distance of two shapes, a point of one
 * and its distance to the other an upper one. */
#ifndef TAHR_SOLID_ORACLE_H
#define TAHR_SOLID_ORACLE_H

#include <tahr/tahr.h>

#include "oracle.h"

typedef long double solid_real;

typedef struct solid_vec {
    solid_real x, y, z;
} solid_vec;

enum { SOLID_VERTICES = 12, SOLID_FACES = 2 * SOLID_VERTICES };

/* type: TAHR_BODY_*, whose numbers a shape's kinds are mapped to; a MESH is one triangle, vertices[0..2]. */
typedef struct solid {
    uint32_t type;
    solid_real radius, half_height;
    solid_vec half;
    solid_vec at;
    solid_vec frame[3]; /* its axes, world */
    solid_vec vertices[SOLID_VERTICES];
    int vertex_count;
    int faces[SOLID_FACES][3]; /* of a hull, counter-clockwise from outside */
    int face_count;
} solid;

void solid_place(solid *s, tahr_vec3 at, tahr_quat orientation);
/* Finds the faces of a hull by looking at every three of its vertices. */
void solid_hull(solid *s);
/* The highest of its points along a unit direction. */
solid_real solid_extent(const solid *s, solid_vec n);
/* 0 inside. */
solid_real solid_point_distance(const solid *s, tahr_vec3 p);
/* How far a must go along n to be clear of b, motion (or zero) and all: negative if they are apart along n. */
solid_real solid_way(const solid *a, tahr_vec3 motion, const solid *b, tahr_vec3 n);
/* The least way over many directions, by trial: ends early at one below enough. */
solid_real solid_least_way(const solid *a, tahr_vec3 motion, const solid *b, solid_real enough, oracle_random *dice);
/* The same from a direction that is known to be good. */
solid_real solid_least_way_near(const solid *a, tahr_vec3 motion, const solid *b, tahr_vec3 best, solid_real enough,
                                oracle_random *dice);

#endif

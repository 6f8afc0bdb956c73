/* SPDX-License-Identifier: MIT
 * hull_planes.h: the outward normals of the faces of a convex hull, for who has its vertices and a support function,
 * and wants to know on which of its faces a point lies. */
#ifndef TAHR_COMMON_HULL_PLANES_H
#define TAHR_COMMON_HULL_PLANES_H

#include "vec.h"

#include <tahr/backend.h>

/* 4 to 256 vertices in general position have at most 2 * 256 - 4 faces. */
enum { TAHR__HULL_VERTICES = 256, TAHR__HULL_PLANES = 508 };

typedef struct tahr__hull_planes {
    tahr_vec3 *normals; /* unit, no two of them within a millionth */
    double *offsets;    /* of the planes: the highest of the vertices along the normal */
    uint32_t count;
    uint32_t capacity;
} tahr__hull_planes;

/* The faces of the hull of count points. TAHR_OK; TAHR_E_GEOMETRY if they are too many, too few, not finite or beyond
 * 1e7 m, or lie in a plane (within 1e-9 of their extent), with *reason saying so; TAHR_E_MEMORY. */
tahr_status tahr__hull_planes_build(const tahr_host *host, const tahr_vec3 *points, uint32_t count,
                                    tahr__hull_planes *planes, const char **reason);
void tahr__hull_planes_free(const tahr_host *host, tahr__hull_planes *planes);

#endif

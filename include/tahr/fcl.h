/* SPDX-License-Identifier: MIT
 * fcl.h: the backend on FCL, the Flexible Collision Library. Not part of libtahr: link libtahr_fcl. */
#ifndef TAHR_FCL_H
#define TAHR_FCL_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The FCL backend: FCL finds the candidates (its AABB tree of bodies, its BVH of triangles, its octrees), the core
 * distance decides. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_fcl(void);

#ifdef __cplusplus
}
#endif
#endif

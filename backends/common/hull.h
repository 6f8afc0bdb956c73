/* SPDX-License-Identifier: MIT
 * hull.h: a convex hull as a body describes it: its vertices, their extents, its faces. */
#ifndef TAHR_COMMON_HULL_H
#define TAHR_COMMON_HULL_H

#include "hull_planes.h"

typedef struct tahr__hull {
    tahr_vec3 *vertices; /* local */
    uint32_t count, reserved;
    tahr_vec3 middle, half; /* of their extents, local */
    tahr__hull_planes planes;
} tahr__hull;

/* To be closed in any case. TAHR_OK; TAHR_E_GEOMETRY, and says why in the log of the host; TAHR_E_MEMORY. */
tahr_status tahr__hull_open(const tahr_host *host, const tahr_body_desc *desc, uint32_t id, tahr__hull *hull);
void tahr__hull_close(const tahr_host *host, tahr__hull *hull);

#endif

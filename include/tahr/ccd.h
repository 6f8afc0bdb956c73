/* SPDX-License-Identifier: MIT
 * ccd.h: the backend on libccd. Not part of libtahr: link libtahr_ccd. */
#ifndef TAHR_CCD_H
#define TAHR_CCD_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The libccd backend: triangle meshes, boxes, spheres, capsules; for tahr_world_open, whose desc.options is not used.
 * Sweeps bisect libccd's boolean test of the swept shape; distances, contacts and rays come from the core distance.
 * Queries allocate nothing and may run on several threads. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_ccd(void);

#ifdef __cplusplus
}
#endif
#endif

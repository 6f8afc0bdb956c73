/* SPDX-License-Identifier: MIT
 * ccd.h: the backend on libccd. Not part of libtahr: link libtahr_ccd. */
#ifndef TAHR_CCD_H
#define TAHR_CCD_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How the first contact of a motion is found. BISECTION: libccd's boolean test of the swept shape, halving the motion,
 * and the last micrometre by the distance. ADVANCE: by the distance all the way; libccd is not asked. */
enum { TAHR_CCD_SWEEP_BISECTION = 1, TAHR_CCD_SWEEP_ADVANCE = 2 };

/* Which of libccd's two boolean tests. */
enum { TAHR_CCD_BOOLEAN_GJK = 1, TAHR_CCD_BOOLEAN_MPR = 2 };

/* Settings, for tahr_world_desc.options; 0 means the default. All of them give the same answers within 1e-9 of the
 * shape's size along the contact normal; they differ in cost. */
typedef struct tahr_ccd_desc {
    uint32_t struct_size;
    uint32_t sweep;          /* TAHR_CCD_SWEEP_*, default ADVANCE */
    uint32_t boolean;        /* TAHR_CCD_BOOLEAN_*, default MPR; BISECTION only */
    uint32_t max_iterations; /* of one boolean test, 1..10000, default 100: the distance decides what it leaves open */
    uint32_t reserved[4];    /* 0 */
} tahr_ccd_desc;

/* The libccd backend: triangle meshes, boxes, spheres, capsules, cylinders, cones, ellipsoids and convex hulls, as
 * bodies and all but meshes as characters; for tahr_world_open, whose desc.options is a tahr_ccd_desc or NULL
 * (TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED or TAHR_E_ARGUMENT if a setting of it is not known). Sweeps, contacts, rays
 * and distances are exact within 1e-9 of the shape's size, depths as backends/ccd/README.md says. Queries allocate
 * nothing and may run on several threads. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_ccd(void);

#ifdef __cplusplus
}
#endif
#endif

/* SPDX-License-Identifier: MIT
 * fluid.h: the bodies with TAHR_BODY_FLUID, and how deep a shape is in them. */
#ifndef TAHR_COMMON_FLUID_H
#define TAHR_COMMON_FLUID_H

#include "vec.h"

#include <tahr/backend.h>

typedef struct tahr__fluid_body {
    uint32_t id, type, mask, reserved;
    tahr_vec3 position;
    tahr__mat turn;         /* local to world */
    tahr_vec3 half_extents; /* boxes */
    double radius;          /* spheres, capsules */
    double reach;           /* capsules: half the length of the axis */
    tahr_vec3 current;      /* m/s, local */
    double friction;        /* 1/s */
} tahr__fluid_body;

/* By ascending id; zero it before it is opened. */
typedef struct tahr__fluids {
    tahr__fluid_body *bodies;
    uint32_t count;
} tahr__fluids;

/* Takes the fluids out of a scene. TAHR_OK or TAHR_E_MEMORY; nothing is kept on failure. */
tahr_status tahr__fluids_open(tahr__fluids *fluids, const tahr_host *host, const tahr_world_desc *desc);
void tahr__fluids_close(tahr__fluids *fluids, const tahr_host *host);

/* Follows the fluids among these bodies. */
void tahr__fluids_place(tahr__fluids *fluids, const tahr_body_pose *poses, uint32_t count);

/* The fluid that holds the largest part of the segment from foot to head on the axis of the shape, the lowest id among
 * equals; fluid stays as it is where there is none. Exact for boxes, spheres and capsules, turned or not. Where several
 * fluids share the segment they do not add up: a body of water is best one body. */
void tahr__fluids_ask(const tahr__fluids *fluids, const tahr_fluid_query *query, tahr_fluid *fluid);

#endif

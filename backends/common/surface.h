/* SPDX-License-Identifier: MIT
 * surface.h: what answers say about the body that was met: its name, its flags, its rule of walking. */
#ifndef TAHR_COMMON_SURFACE_H
#define TAHR_COMMON_SURFACE_H

#include <tahr/backend.h>

typedef struct tahr__surface {
    uint32_t id, flags, mask, surface;
    uint32_t walkable_rule, reserved;
    double walkable_angle;
} tahr__surface;

static inline tahr__surface tahr__surface_of(const tahr_body_desc *d, uint32_t id)
{
    tahr__surface s;
    s.id = id;
    s.flags = d->flags;
    s.mask = d->mask ? d->mask : 0xFFFFFFFFu;
    s.surface = d->surface;
    s.walkable_rule = d->walkable_rule;
    s.reserved = 0;
    s.walkable_angle = d->walkable_angle;
    return s;
}

#endif

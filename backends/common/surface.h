/* SPDX-License-Identifier: MIT
 * surface.h: what answers say about the body that was met: its name, its flags, its rule of walking; and which bodies a
 * query wants to meet. */
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

/* What a query may not want to meet. */
enum { TAHR__SOLIDS = 1, TAHR__SENSORS = 2 };

typedef struct tahr__filter {
    uint32_t mask, ignore_body;
    uint32_t only_body;  /* 1: nothing is there but ignore_body */
    uint32_t leaves_out; /* 0, or TAHR__SOLIDS or TAHR__SENSORS */
} tahr__filter;

static inline tahr__filter tahr__filter_of_sweep(const tahr_sweep *query, uint32_t capacity)
{
    tahr__filter f = {query->mask, query->ignore_body, (query->flags & TAHR_SWEEP_ONLY_BODY) != 0, 0};
    if (query->flags & TAHR_SWEEP_SENSORS)
        f.leaves_out = TAHR__SOLIDS;
    else if (capacity == 1) /* which is the blocking hit's */
        f.leaves_out = TAHR__SENSORS;
    return f;
}

static inline tahr__filter tahr__filter_of_contacts(const tahr_contact_query *query)
{
    tahr__filter f = {query->mask, query->ignore_body, 0, 0};
    if (query->flags & TAHR_CONTACTS_SOLID) f.leaves_out = TAHR__SENSORS;
    return f;
}

static inline tahr__filter tahr__filter_of_ray(const tahr_ray *query)
{
    tahr__filter f = {query->mask, query->ignore_body, 0, TAHR__SENSORS};
    return f;
}

static inline int tahr__filter_passes(const tahr__filter *filter, const tahr__surface *surface)
{
    uint32_t kind = surface->flags & TAHR_BODY_SENSOR ? TAHR__SENSORS : TAHR__SOLIDS;
    return !(surface->flags & TAHR_BODY_TEMPLATE) && filter->leaves_out != kind &&
           (surface->mask & filter->mask) != 0 && (surface->id == filter->ignore_body) == (filter->only_body != 0);
}

#endif

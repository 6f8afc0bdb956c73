/* SPDX-License-Identifier: MIT
 * form.h: making cached primitives out of the triangles of meshes, as far as they are needed. */
#ifndef TAHR_NATIVE_FORM_H
#define TAHR_NATIVE_FORM_H

#include "scene.h"

/* The names of gathered triangles: all of a primitive that does not need its corners. */
void tahr__form_heads(const tahr__body *body, uint32_t id, const uint32_t *items, uint32_t count, tahr__prim *prims);
/* The lanes of all that have only a head. */
void tahr__form_lanes(const tahr__native *world, const tahr__frame *frame, tahr__prim *prims, float *blocks,
                      uint32_t count);
/* What is missing of one with a head. */
void tahr__form_rest(const tahr__native *world, const tahr__frame *frame, tahr__prim *prim);

/* One of the query's cache, whole. */
static inline tahr__prim *tahr__formed(const tahr__query *query, uint32_t index)
{
    tahr__prim *prim = &tahr__cache_prims(query->world, query->cache)[index];
    if (prim->kind & TAHR__UNFORMED) tahr__form_rest(query->world, query->frame, prim);
    return prim;
}

/* Lanes of raw triangles; lanes: their first place in its block. Where the processor has AVX2, and AVX-512. */
void tahr__form_4(const tahr__map *map, const tahr__raw *raw, float *lanes);
void tahr__form_8(const tahr__map *map, const tahr__raw *raw, float *lanes);

#endif

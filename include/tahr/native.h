/* SPDX-License-Identifier: MIT
 * native.h: what only the native backend offers. It is part of libtahr. */
#ifndef TAHR_NATIVE_H
#define TAHR_NATIVE_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How gathered corners are rounded: FLOAT local to a 4 m grid cell (gaps within 2e-6 m), DOUBLE (1e-9 m). */
enum { TAHR_NATIVE_FLOAT = 0, TAHR_NATIVE_DOUBLE = 1 };

/* Zero means default for every field but struct_size. Out of range: tahr_world_open returns TAHR_E_ARGUMENT. */
typedef struct tahr_native_desc {
    uint32_t struct_size;
    uint32_t precision;       /* TAHR_NATIVE_FLOAT or _DOUBLE */
    uint32_t cache_triangles; /* per character, 280 bytes each, default 128, at most 4096; what does not fit is
                               * slower */
    uint32_t no_cache;        /* 1: every query walks the tree; same bits */
    uint32_t no_simd;         /* 1: the scalar twin; same bits */
    uint32_t reserved;        /* 0 */
    double cache_margin;      /* m around the announced box, default 1; 0..1000 */
} tahr_native_desc;

/* The native backend: plain C, triangle meshes, boxes, spheres, capsules; for tahr_world_open, whose desc.options is a
 * tahr_native_desc or NULL. Queries allocate nothing and may run on several threads. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_native(void);

#ifdef __cplusplus
}
#endif
#endif

/* SPDX-License-Identifier: MIT
 * native.h: what only the native backend offers. It is part of libtahr. */
#ifndef TAHR_NATIVE_H
#define TAHR_NATIVE_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One triangle of yours, in the world frame, its corners counter-clockwise seen from the front. Where two triangles of
 * a body meet let them have exactly the same corners: then their edge is not felt. Name it by body and feature, the
 * same name whenever it is handed over and no other with it: ties between surfaces go by it. Zero what you do not
 * use. */
typedef struct tahr_triangle {
    tahr_vec3 corners[3];   /* m, finite, |x| <= 1e7 */
    double walkable_angle;  /* rad, with INCREASE and DECREASE */
    uint32_t body;          /* at least tahr_world_desc.body_count: the lower ones are the described bodies */
    uint32_t feature;       /* handed back in hits and contacts */
    uint32_t surface;       /* likewise */
    uint32_t walkable_rule; /* TAHR_WALKABLE_* */
    uint32_t flags; /* TAHR_BODY_TWO_SIDED, TAHR_BODY_ONE_WAY: the same for all triangles of a body. TAHR_INPUT_DROP
                             * drops through them. No rule that asks a body for its flags knows of them: who grabs a
                             * ledge, steps up or walks over a crest takes them for solid; describe such as bodies */
    uint32_t mask;  /* 0: all bits */
} tahr_triangle;

/* Takes triangles. Call add(out, &triangle) for each; it copies what it needs. It answers 0 when no more are needed,
 * which may be passed over. */
typedef struct tahr_gather tahr_gather;
struct tahr_gather {
    int32_t (*add)(tahr_gather *out, const tahr_triangle *triangle);
};

/* Your geometry. [in] box, world, whole cells of 4 m; mask; [out] out: hand over every triangle that touches the box
 * and that mask concerns; more do not harm, nor does one handed over twice. A triangle that touches two boxes must be
 * handed over for both, with the same bits, and a box must give the same triangles in the same order until
 * tahr_world_touch. Called from every thread that steps or asks, several at once, never from within itself. Return
 * TAHR_OK, or a negative status to end the step with TAHR_E_BACKEND, state untouched; so does a triangle that breaks a
 * rule above (the log names triangle and field). */
typedef tahr_status (*tahr_gather_fn)(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out);

/* Zero means default for every field but struct_size. Out of range: tahr_world_open returns TAHR_E_ARGUMENT. */
typedef struct tahr_native_desc {
    uint32_t struct_size;
    uint32_t no_vicinity; /* 1: every query looks at all that was gathered, however clear the air is, at a corner over
                               * each of its triangles, and at all again where one waits for the rest, or the same is
                               * asked twice; same bits */
    uint32_t cache_triangles; /* per character, default 128, at most 4096, 288 bytes each; what exceeds it is slower */
    uint32_t no_cache;        /* 1: every query walks the tree; same bits */
    uint32_t no_simd;         /* 1: the scalar twin; same bits */
    uint32_t no_fields;       /* 1: a mesh that is a field of heights stays a mesh (tahr_world_describe); same bits */
    uint32_t no_capsule_ends; /* 1: a capsule is measured as a whole, also where an end of it is nearest; same bits */
    uint32_t reserved;        /* 0 */
    double cache_margin;      /* m around the announced box, 0..1000; 0: by how dense the scene is there, at most 1 */
    /* NULL: the described bodies are all there is. Else these triangles besides them (which may be none): they answer
     * bit for bit as a mesh of them would. They carry nobody and are no sensors: describe what moves, and sensors, as
     * bodies. tahr_world_touch says that they have changed. 408 bytes a triangle in the cache instead of 288; without
     * a cache, or where it is too small, every query gathers for itself. */
    tahr_gather_fn gather;
    void *gather_user;
} tahr_native_desc;

/* The native backend: plain C. Bodies: triangle meshes, boxes, spheres, capsules, convex hulls and fields of heights;
 * characters: spheres, capsules and boxes. For tahr_world_open, whose desc.options is a tahr_native_desc or NULL.
 * Gaps are within 1e-9 m. Queries allocate nothing and may run on several threads. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_native(void);

#ifdef __cplusplus
}
#endif
#endif

/* SPDX-License-Identifier: MIT
 * form.c: what a cull needs of gathered triangles, some at a time out of the mesh, and the rest of a triangle when a
 * query first comes near it: of a hundred that are gathered a dozen are ever measured. The bits are those of
 * tahr__prim_triangle and tahr__lanes_put. */
#include "form.h"

#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

/* The corners of this many triangles later are fetched while one is formed: some 100 ns ahead. */
enum { AHEAD = 8 };

void tahr__form_heads(const tahr__body *body, uint32_t id, const uint32_t *items, uint32_t count, tahr__prim *prims)
{
    tahr__prim head;
    tahr__prim_begin(body, id, &head);
    for (uint32_t i = 0; i < count; i++) {
        prims[i].item = items[i];
        prims[i].kind = head.kind | TAHR__UNFORMED;
        prims[i].body = id;
        prims[i].mask = head.mask;
    }
}

void tahr__form_rest(const tahr__native *world, const tahr__frame *frame, tahr__prim *prim)
{
    const tahr__body *body = &world->bodies[prim->body];
    tahr__map map = tahr__map_make(frame, body);
    uint32_t item = prim->item;
    tahr__prim_begin(body, prim->body, prim);
    if (body->type == TAHR_BODY_HEIGHTS) {
        tahr_vec3 v[3];
        tahr__heights_triangle(&body->heights, item, v);
        tahr__prim_heights(&map, body, item, v, prim);
    } else {
        tahr__prim_triangle(&map, body, item, prim);
    }
}

static void form_one(const tahr__native *world, const tahr__frame *frame, tahr__prim *prim, float *blocks, uint32_t at)
{
    tahr__form_rest(world, frame, prim);
    const tahr_vec3 *v = prim->facet.v;
    tahr_bounds box = {v_min(v[0], v_min(v[1], v[2])), v_max(v[0], v_max(v[1], v[2]))};
    tahr__lanes_put(blocks, at, &box, prim->kind & TAHR__PLANELESS ? NULL : &prim->facet);
}

static void load_raw(const tahr__body *body, const tahr__prim *prims, uint32_t width, tahr__raw *raw)
{
    for (uint32_t i = 0; i < width; i++) {
        tahr_vec3 v[3];
        uint32_t item = prims[i].item;
        if (body->type == TAHR_BODY_HEIGHTS) {
            tahr__heights_triangle(&body->heights, item, v);
            raw->thin[i] = 0;
        } else {
            const tahr__triangle *t = &body->mesh.triangles[item];
            for (int k = 0; k < 3; k++)
                v[k] = body->mesh.vertices[t->vertex[k]];
            raw->thin[i] = t->source & TAHR__MESH_THIN ? 1 : 0;
        }
        for (int k = 0; k < 3; k++) {
            raw->corner[k][0][i] = v[k].x;
            raw->corner[k][1][i] = v[k].y;
            raw->corner[k][2][i] = v[k].z;
        }
    }
}

/* Do as many from there on come from one body, with no lane across two blocks? Fields with triangles that may be thin
 * find out one by one. */
static int alike(const tahr__native *world, const tahr__prim *prims, uint32_t at, uint32_t count, uint32_t width)
{
    if (world->bodies[prims[at].body].heights.may_be_thin || width == 1 || at % width != 0 || at + width > count)
        return 0;
    for (uint32_t i = at; i < at + width; i++) {
        if (!(prims[i].kind & TAHR__UNFORMED) || prims[i].body != prims[at].body) return 0;
    }
    return 1;
}

#if defined(__GNUC__)
static void fetch(const tahr__native *world, const tahr__prim *prim)
{
    if (!(prim->kind & TAHR__UNFORMED)) return; /* its body may be the user's */
    const tahr__mesh *mesh = &world->bodies[prim->body].mesh;
    if (!mesh->triangles) return;
    __builtin_prefetch(&mesh->vertices[mesh->triangles[prim->item].vertex[0]]);
    __builtin_prefetch(&mesh->vertices[mesh->triangles[prim->item].vertex[2]]);
}
#else
static void fetch(const tahr__native *world, const tahr__prim *prim)
{
    (void)world;
    (void)prim;
}
#endif

void tahr__form_lanes(const tahr__native *world, const tahr__frame *frame, tahr__prim *prims, float *blocks,
                      uint32_t count)
{
    const tahr__former *former = &world->former;
    uint32_t of = TAHR__NONE;
    tahr__map map;
    tahr__raw raw;
    for (uint32_t at = 0; at < count;) {
        for (uint32_t i = at + AHEAD; i < at + AHEAD + former->width && i < count; i++)
            fetch(world, &prims[i]);
        if (!(prims[at].kind & TAHR__UNFORMED)) {
            at++;
            continue;
        }
        if (!alike(world, prims, at, count, former->width)) {
            form_one(world, frame, &prims[at], blocks, at);
            at++;
            continue;
        }
        if (prims[at].body != of) {
            of = prims[at].body;
            map = tahr__map_make(frame, &world->bodies[of]);
        }
        load_raw(&world->bodies[of], &prims[at], former->width, &raw);
        former->form(&map, &raw, blocks + tahr__lane(at, 0));
        at += former->width;
    }
}

#if defined(__GNUC__)

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

enum { WIDTH = 2 };

typedef double lane __attribute__((vector_size(16)));
typedef int64_t mask __attribute__((vector_size(16)));
typedef float half __attribute__((vector_size(8)));

static inline lane root(lane a)
{
#if defined(__SSE2__)
    return (lane)_mm_sqrt_pd((__m128d)a);
#else
    return (lane){sqrt(a[0]), sqrt(a[1])};
#endif
}

static inline lane choose(mask m, lane a, lane b)
{
    return (lane)(((mask)a & m) | ((mask)b & ~m));
}

static inline lane lower(lane a, lane b)
{
    return choose((mask)(a < b), a, b);
}

static inline lane higher(lane a, lane b)
{
    return choose((mask)(a > b), a, b);
}

static inline void put(float *to, lane x)
{
    half h = {(float)x[0], (float)x[1]};
    memcpy(to, &h, sizeof h);
}

static inline lane load(const double *a)
{
    return (lane){a[0], a[1]};
}

#include "form_kernel.h"

static void form_2(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    form(map, raw, lanes);
}

#endif

tahr__former tahr__former_of_two(void)
{
#if defined(__GNUC__)
    return (tahr__former){form_2, 2, 0};
#else
    return (tahr__former){NULL, 1, 0};
#endif
}

tahr__former tahr__former_best(uint32_t simd)
{
    if (!simd) return (tahr__former){NULL, 1, 0};
#if defined(__GNUC__) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return (tahr__former){tahr__form_4, 4, 0};
#endif
    return tahr__former_of_two();
}

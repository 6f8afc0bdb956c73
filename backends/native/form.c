/* SPDX-License-Identifier: MIT
 * form.c: what a cull needs of gathered triangles, some at a time out of the mesh, and the rest of a triangle when a
 * query first comes near it: of a hundred that are gathered a dozen are ever measured. The bits are those of
 * tahr__prim_triangle and tahr__lanes_put. */
#include "form.h"

#include "../common/processor.h"

#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

/* The corners of this many triangles later are fetched while one is formed: some 100 ns ahead. */
enum { AHEAD = 8 };

#if defined(__GNUC__)
static void fetch_names(const tahr__body *body, uint32_t item)
{
    if (body->mesh.triangles) __builtin_prefetch(&body->mesh.triangles[item]);
}
#else
static void fetch_names(const tahr__body *body, uint32_t item)
{
    (void)body;
    (void)item;
}
#endif

void tahr__form_heads(const tahr__body *body, uint32_t id, const uint32_t *items, uint32_t count, tahr__prim *prims)
{
    tahr__prim head;
    tahr__prim_begin(body, id, &head);
    for (uint32_t i = 0; i < count; i++) {
        fetch_names(body, items[i]);
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

/* Triangles one after the other in the cache that have heads of one body. */
typedef struct run {
    const tahr__body *body;
    tahr__map map;
    const tahr__prim *prims;
    uint32_t end;
    /* Of a field: the row of the last cell, and the first cell of it. */
    uint32_t row, row_cell;
    tahr_vec3 corners[TAHR__FORMED][4];
} run;

/* The corners of a cell. Cells come row by row: to divide each time would cost as much as all the rest. */
static void put_cell(run *r, uint32_t cell, tahr_vec3 corners[4])
{
    const tahr__heights *h = &r->body->heights;
    const uint32_t wide = h->columns - 1;
    if (cell - r->row_cell >= wide) { /* below zero: far above */
        r->row = cell / wide;
        r->row_cell = r->row * wide;
    }
    tahr__heights_cell(h, cell - r->row_cell, r->row, corners);
}

/* width of them, of which there are count; the last stands for those that there are not. Two of one cell share its
 * corners. */
static void load_field(run *r, uint32_t at, uint32_t count, uint32_t width, tahr__raw *raw)
{
    uint32_t last = TAHR__NONE;
    const tahr_vec3 *c = NULL;
    for (uint32_t i = 0; i < width; i++) {
        const uint32_t item = r->prims[at + (i < count ? i : count - 1)].item, k = item & 1;
        if (item / 2 != last) {
            c = r->corners[i];
            last = item / 2;
            put_cell(r, last, r->corners[i]);
        }
        raw->corner[0][i] = &c[0];
        raw->corner[1][i] = &c[1 + k];
        raw->corner[2][i] = &c[2 + k];
    }
}

/* The same of a mesh. Returns which are thin, one bit each. */
static uint32_t load_mesh(const run *r, uint32_t at, uint32_t count, uint32_t width, tahr__raw *raw)
{
    const tahr__mesh *mesh = &r->body->mesh;
    uint32_t thin = 0;
    for (uint32_t i = 0; i < width; i++) {
        const tahr__triangle *t = &mesh->triangles[r->prims[at + (i < count ? i : count - 1)].item];
        for (int k = 0; k < 3; k++)
            raw->corner[k][i] = &mesh->vertices[t->vertex[k]];
        thin |= (t->source >> 31) << i;
    }
    return thin;
}

#if defined(__GNUC__)
static void fetch(const run *r, uint32_t at)
{
    const tahr__mesh *mesh = &r->body->mesh;
    if (!mesh->triangles || at >= r->end) return;
    const tahr__triangle *t = &mesh->triangles[r->prims[at].item];
    __builtin_prefetch(&mesh->vertices[t->vertex[0]]);
    __builtin_prefetch(&mesh->vertices[t->vertex[2]]);
}
#else
static void fetch(const run *r, uint32_t at)
{
    (void)r;
    (void)at;
}
#endif

/* Of one place in a block to another. */
static void copy_lanes(float *to, const float *from, uint32_t count)
{
    for (uint32_t row = 0; row < TAHR__LANE_ROWS; row++)
        memcpy(to + row * TAHR__LANES, from + row * TAHR__LANES, count * sizeof *to);
}

static void clear_planes(float *lanes)
{
    for (uint32_t row = TAHR__LANE_NORMAL; row < TAHR__LANE_ROWS; row++)
        lanes[row * TAHR__LANES] = 0;
}

/* Forms all that is left of a group that lies at the same places of a block. What lies beyond them is somebody
 * else's, unless it is the end. */
static uint32_t form_group(const tahr__former *former, run *r, float *blocks, uint32_t at, int last)
{
    float apart[TAHR__LANE_ROWS * TAHR__LANES], *lanes = blocks + tahr__lane(at, 0);
    uint32_t left = former->width - at % former->width, count = left < r->end - at ? left : r->end - at;
    tahr__raw raw;
    uint32_t thin = 0;
    if (r->body->mesh.triangles)
        thin = load_mesh(r, at, count, former->width, &raw);
    else
        load_field(r, at, count, former->width, &raw);
    if (left == former->width && (count == left || last)) {
        former->form(&r->map, &raw, lanes);
    } else {
        former->form(&r->map, &raw, apart);
        copy_lanes(lanes, apart, count);
    }
    for (uint32_t i = 0; thin != 0 && i < count; i++) {
        if (thin >> i & 1) clear_planes(lanes + i);
    }
    return count;
}

void tahr__form_lanes(const tahr__native *world, const tahr__frame *frame, tahr__prim *prims, float *blocks,
                      uint32_t count)
{
    const tahr__former *former = &world->former;
    run r;
    r.prims = prims;
    for (uint32_t at = 0; at < count;) {
        uint32_t id = prims[at].body;
        r.body = &world->bodies[id];
        if (!(prims[at].kind & TAHR__UNFORMED)) {
            at++; /* its body may be the user's */
        } else if (former->width == 1 || r.body->heights.may_be_thin) {
            form_one(world, frame, &prims[at], blocks, at);
            at++;
        } else {
            r.map = tahr__map_make(frame, r.body);
            r.row = r.row_cell = 0; /* those of another field are no rows of this one */
            for (r.end = at; r.end < count && prims[r.end].body == id && prims[r.end].kind & TAHR__UNFORMED;)
                r.end++;
            while (at < r.end) {
                for (uint32_t i = 0; i < former->width; i++)
                    fetch(&r, at + AHEAD + i);
                at += form_group(former, &r, blocks, at, r.end == count);
            }
        }
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

typedef struct vec {
    lane x, y, z;
} vec;

static inline lane one_over_root(lane a)
{
#if defined(__SSE2__)
    return (lane)_mm_cvtps_pd(_mm_div_ps(_mm_set1_ps(1), _mm_sqrt_ps(_mm_cvtpd_ps((__m128d)a))));
#else
    return (lane){tahr__lanes_scale(a[0]), tahr__lanes_scale(a[1])};
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

static inline vec load(const tahr_vec3 *const v[TAHR__FORMED])
{
    return (vec){{v[0]->x, v[1]->x}, {v[0]->y, v[1]->y}, {v[0]->z, v[1]->z}};
}

#include "form_kernel.h"

static void form_2(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    form(map, raw, lanes);
}

#endif

tahr__former tahr__former_of(uint32_t most)
{
    if (most >= 8 && tahr__has_avx512()) return (tahr__former){tahr__form_8, 8, 0};
    if (most >= 4 && tahr__has_avx2()) return (tahr__former){tahr__form_4, 4, 0};
#if defined(__GNUC__)
    /* Two at a time, which every machine has by its compiler's vectors. */
    if (most >= 2) return (tahr__former){form_2, 2, 0};
#endif
    return (tahr__former){NULL, 1, 0};
}

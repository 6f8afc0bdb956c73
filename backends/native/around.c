/* SPDX-License-Identifier: MIT
 * around.c: the triangles at an edge or corner where there are no rings: in
 * fields of heights, from the grid, and among the user's triangles, from all
 * that have that corner. Apart from resolve.c, whose way must stay short. */
#include "scene.h"

enum { FAN = TAHR__FAN, NEAR = 2 * FAN };

typedef struct place {
    const tahr__query *query;
    const tahr__prim *prim;
    const tahr__body *body; /* of a field of heights, with its map; NULL: the
                             user's triangles */
    tahr__map map;
    tahr_vec3 own[3];    /* exact corners */
    const tahr_vec3 *at; /* see tahr__source_around */
    int whole;           /* 1: all of near are connected over edges */
    tahr__near near[NEAR];
} place;

static int equal(tahr_vec3 a, tahr_vec3 b)
{
    return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}

static uint32_t corner_at(const tahr__near *n, tahr_vec3 corner)
{
    return equal(n->corner[0], corner) ? 0 : equal(n->corner[1], corner) ? 1 : equal(n->corner[2], corner) ? 2 : 3;
}

static void begin(place *p, const tahr__query *query, const tahr__prim *prim, const tahr_vec3 *at)
{
    p->query = query;
    p->prim = prim;
    p->at = at;
    p->body = NULL;
    if (prim->kind & TAHR__GATHERED) {
        const tahr_vec3 *exact = tahr__source_corners(query, prim);
        for (int i = 0; i < 3; i++)
            p->own[i] = exact[i];
    } else {
        p->body = &query->world->bodies[prim->body];
        p->map = tahr__map_make(query->frame, p->body);
        tahr__heights_triangle(&p->body->heights, prim->item, p->own);
    }
}

/* Of a field, with nothing but their corners and names; whole: 1 if none is
 * missing, so that they are all connected. */
static uint32_t heights_around(place *p, uint32_t corner)
{
    const tahr__heights *h = &p->body->heights;
    uint32_t around[6], count = tahr__heights_around(h, p->prim->item, corner, around), kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        tahr__near *n = &p->near[kept];
        if (around[i] == p->prim->item || !tahr__heights_triangle(h, around[i], n->corner)) continue;
        n->feature = around[i];
        n->two_sided = p->body->flags & TAHR_BODY_TWO_SIDED;
        kept++;
    }
    p->whole = kept + 1 == count;
    return kept;
}

/* All triangles but this one that have a corner of it, in p->near. */
static uint32_t all_around(place *p, uint32_t corner)
{
    if (p->body) return heights_around(p, corner);
    p->whole = 0;
    return tahr__source_around(p->query, p->prim, p->own[corner], p->at, p->near, NEAR);
}

static int resolve(const place *p, tahr__resolving *resolving, tahr__near *n)
{
    if (p->body) {
        for (int k = 0; k < 3; k++)
            n->v[k] = tahr__map_point(&p->map, n->corner[k]);
        n->face = tahr__heights_normal(n->corner);
        if (p->map.turned) n->face = m_apply(&p->map.turn, n->face);
    }
    return tahr__resolve_near(resolving, n);
}

/* A field has one triangle at most on the other side. */
static uint32_t heights_across(place *p, uint32_t edge)
{
    const uint32_t across = tahr__heights_across(&p->body->heights, p->prim->item, edge);
    tahr__near *n = &p->near[0];
    if (across == p->prim->item || !tahr__heights_triangle(&p->body->heights, across, n->corner)) return 0;
    n->feature = across;
    n->two_sided = p->body->flags & TAHR_BODY_TWO_SIDED;
    return 1;
}

static void around_edge(place *p, uint32_t edge, tahr__resolving *resolving)
{
    uint32_t count = p->body ? heights_across(p, edge) : all_around(p, edge);
    for (uint32_t i = 0; i < count; i++) {
        tahr__near *n = &p->near[i];
        n->at = corner_at(n, p->own[edge]);
        n->to = corner_at(n, p->own[(edge + 1) % 3]);
        if (n->to < 3 && resolve(p, resolving, n)) return;
    }
}

/* Do two triangles at a corner share an edge there? at: their corner that it
 * is. */
static int share_edge(const tahr_vec3 a[3], uint32_t at_a, const tahr_vec3 b[3], uint32_t at_b)
{
    const tahr_vec3 *a1 = &a[(at_a + 1) % 3], *a2 = &a[(at_a + 2) % 3];
    const tahr_vec3 *b1 = &b[(at_b + 1) % 3], *b2 = &b[(at_b + 2) % 3], *corner = &a[at_a];
    return ((equal(*a1, *b1) | equal(*a1, *b2)) & !equal(*a1, *corner)) |
           ((equal(*a2, *b1) | equal(*a2, *b2)) & !equal(*a2, *corner));
}

/* Those that are connected to this one over edges at that corner. */
static void around_corner(place *p, uint32_t corner, tahr__resolving *resolving)
{
    uint32_t count = all_around(p, corner), fan[FAN], known = 0, taken[NEAR] = {0};
    for (uint32_t k = 0; k < count; k++) {
        p->near[k].at = corner_at(&p->near[k], p->own[corner]);
        p->near[k].to = 3;
        if (p->whole && resolve(p, resolving, &p->near[k])) return;
    }
    if (p->whole) return;
    for (uint32_t i = 0; i <= known && i < FAN; i++) {
        const tahr_vec3 *from = p->own;
        uint32_t at = corner;
        if (i > 0) {
            tahr__near *n = &p->near[fan[i - 1]];
            if (resolve(p, resolving, n)) return;
            from = n->corner;
            at = n->at;
        }
        for (uint32_t k = 0; k < count && known < FAN - 1; k++) {
            if (taken[k] || !share_edge(from, at, p->near[k].corner, p->near[k].at)) continue;
            taken[k] = 1;
            fan[known++] = k;
        }
    }
}

void tahr__around(const tahr__query *query, const tahr__prim *prim, const tahr__witness *witness,
                  tahr__resolving *resolving)
{
    place p;
    begin(&p, query, prim, &witness->point);
    if (witness->feature < TAHR__CORNER)
        around_edge(&p, witness->feature - TAHR__EDGE, resolving);
    else
        around_corner(&p, witness->feature - TAHR__CORNER, resolving);
}

int tahr__stands_alone(const tahr__query *query, const tahr__prim *prim)
{
    place p;
    if (!(prim->kind & (TAHR__GATHERED | TAHR__FACELESS))) {
        const tahr__triangle *t = &query->world->bodies[prim->body].mesh.triangles[prim->item];
        return t->ring[0] == prim->item && t->ring[1] == prim->item && t->ring[2] == prim->item;
    }
    begin(&p, query, prim, NULL);
    for (uint32_t edge = 0; edge < 3; edge++) {
        uint32_t count = all_around(&p, edge);
        for (uint32_t i = 0; i < count; i++) {
            if (corner_at(&p.near[i], p.own[(edge + 1) % 3]) < 3) return 0;
        }
    }
    return 1;
}

tahr_vec3 tahr__heights_face(const tahr__query *query, const tahr__prim *prim)
{
    const tahr__body *body = &query->world->bodies[prim->body];
    tahr__map map = tahr__map_make(query->frame, body);
    tahr_vec3 v[3], n;
    tahr__heights_triangle(&body->heights, prim->item, v);
    n = tahr__heights_normal(v);
    return map.turned ? m_apply(&map.turn, n) : n;
}

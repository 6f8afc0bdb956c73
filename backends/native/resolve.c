/* SPDX-License-Identifier: MIT
 * resolve.c: from the nearest point of one triangle to a contact of the surface: true face normals, one-sidedness, and
 * edges that are only there because a surface is made of triangles. */
#include "scene.h"

/* A one-sided face is met from the front if the contact normal is not more than this behind it (sine of the angle). */
#define BEHIND 1e-6
/* Slope at which a neighbour counts as nearer than the shared edge: well above rounding (1e-15 / 0.01 m), so that two
 * neighbours never both give way to the other. */
#define NEARER 1e-9
/* Contact normals this close to a face's normal are that face's: below it lies what rounding corners to float (2.4e-7 m
 * over a few centimetres) or to double makes of a flat surface. Without it a walker would feel that it is made of
 * triangles. */
#define SNAP_FLOAT 3e-5
#define SNAP_DOUBLE 1e-7
/* Triangles looked at around a corner; a fan larger than this is looked at in part. */
enum { FAN = 32 };

typedef struct work {
    const tahr__core *core;
    const tahr__body *body;
    tahr__map map;
    tahr_vec3 centre, motion;
    tahr__contact_normals *out;
    double best; /* of motion . face so far */
    int measure, nearer;
} work;

/* Unit face normal in the local frame, from the unrounded corners. */
static tahr_vec3 face_normal(const work *w, uint32_t triangle)
{
    tahr_vec3 n = w->body->mesh.normals[triangle];
    return w->map.turned ? m_apply(&w->map.turn, n) : n;
}

/* Does the triangle (corners v, local) lead from its corner `at` nearer to the core than the touched feature? to: the
 * other corner of a touched edge, 3 for a touched corner. */
static int leads_nearer(tahr_vec3 n, const tahr_vec3 v[3], uint32_t at, uint32_t to)
{
    for (uint32_t i = 1; i < 3; i++) {
        uint32_t k = (at + i) % 3;
        if (k == to) continue;
        tahr_vec3 d = v_sub(v[k], v[at]);
        if (to != 3) {
            /* Of a touched edge only the way into the face counts, straight across. */
            tahr_vec3 e = v_sub(v[to], v[at]);
            double e2 = v_dot(e, e);
            if (e2 > 0) d = v_mad(d, e, -(v_dot(d, e) / e2));
        }
        double rise = v_dot(n, d);
        if (rise > 0 && rise * rise > NEARER * NEARER * v_dot(d, d)) return 1;
    }
    return 0;
}

/* A neighbour at the touched edge or corner: is it nearer than that feature, does its face oppose the motion more? 1:
 * no need to look at others. */
static int look_at(work *w, uint32_t triangle, uint32_t at, uint32_t to)
{
    tahr_vec3 n = w->out->normal, f = face_normal(w, triangle), v[3];
    if (v_dot(f, n) < -BEHIND) {
        if (!(w->body->flags & TAHR_BODY_TWO_SIDED)) return 0;
        f = v_scale(f, -1);
    }
    tahr__map_triangle(&w->map, w->body, triangle, v);
    if (leads_nearer(n, v, at, to)) {
        w->nearer = 1;
        if (!w->measure) return 1;
        tahr__witness other;
        tahr__core_distance(w->core, w->centre, v, &other);
        w->out->closer = d_min(w->out->closer, other.distance);
    }
    double along = v_dot(w->motion, f);
    if (along < w->best) {
        w->best = along;
        w->out->face = f;
    }
    return 0;
}

static uint32_t corner_of(const tahr__triangle *t, uint32_t vertex)
{
    return t->vertex[0] == vertex ? 0 : t->vertex[1] == vertex ? 1 : t->vertex[2] == vertex ? 2 : 3;
}

static void around_edge(work *w, uint32_t triangle, uint32_t edge)
{
    const tahr__triangle *all = w->body->mesh.triangles, *own = &all[triangle];
    uint32_t a = own->vertex[edge], b = own->vertex[(edge + 1) % 3];
    uint32_t next = own->ring[edge];
    for (int i = 0; i < FAN && next != triangle; i++) {
        const tahr__triangle *t = &all[next];
        uint32_t at = corner_of(t, a), to = corner_of(t, b);
        if (look_at(w, next, at, to)) return;
        next = t->ring[(at + 1) % 3 == to ? at : to];
    }
}

/* All triangles at a corner that are connected to this one over edges at that corner. */
static void around_corner(work *w, uint32_t triangle, uint32_t corner)
{
    const tahr__triangle *all = w->body->mesh.triangles;
    uint32_t vertex = all[triangle].vertex[corner], fan[FAN], count = 1;
    fan[0] = triangle;
    for (uint32_t i = 0; i < count; i++) {
        const tahr__triangle *t = &all[fan[i]];
        uint32_t at = corner_of(t, vertex), edges[2] = {at, (at + 2) % 3};
        if (i > 0 && look_at(w, fan[i], at, 3)) return;
        for (int k = 0; k < 2; k++) {
            for (uint32_t next = t->ring[edges[k]]; next != fan[i] && count < FAN;) {
                uint32_t known = 0;
                while (known < count && fan[known] != next)
                    known++;
                if (known == count) fan[count++] = next;
                const tahr__triangle *o = &all[next];
                uint32_t a = corner_of(o, t->vertex[edges[k]]), b = corner_of(o, t->vertex[(edges[k] + 1) % 3]);
                next = o->ring[(a + 1) % 3 == b ? a : b];
            }
        }
    }
}

int tahr__resolve(const tahr__query *query, const tahr__prim *prim, tahr_vec3 centre, const tahr__witness *witness,
                  tahr_vec3 motion, int measure, tahr__contact_normals *out)
{
    out->normal = out->face = witness->normal;
    out->closer = witness->distance;
    if (prim->item & (TAHR__ITEM_ROUND | TAHR__ITEM_SOLID)) return TAHR__ACCEPTED;
    tahr_vec3 own = prim->face;
    double facing = v_dot(own, witness->normal);
    if (facing < -BEHIND) {
        if (!(prim->kind & TAHR__TWO_SIDED)) return TAHR__REJECTED;
        own = v_scale(own, -1);
    }
    out->face = own;
    if (witness->feature == TAHR__FACE) {
        /* Met by a face, an edge or a corner of the core: the triangle's normal is the contact's all the same. */
        if (fabs(facing) > 0.999) out->normal = own;
        return TAHR__ACCEPTED;
    }
    work w;
    w.core = &query->core;
    w.body = &query->world->bodies[prim->body];
    w.map = tahr__map_make(query->frame, w.body);
    w.centre = centre;
    w.motion = motion;
    w.out = out;
    w.best = v_dot(motion, own);
    w.measure = measure;
    w.nearer = 0;
    if (witness->feature < TAHR__CORNER)
        around_edge(&w, prim->item, witness->feature - TAHR__EDGE);
    else
        around_corner(&w, prim->item, witness->feature - TAHR__CORNER);
    if (w.nearer) return TAHR__NEIGHBOUR;
    double snap = query->frame->round ? SNAP_FLOAT : SNAP_DOUBLE;
    tahr_vec3 d = v_sub(out->normal, out->face);
    if (v_dot(d, d) < snap * snap) out->normal = out->face;
    return TAHR__ACCEPTED;
}

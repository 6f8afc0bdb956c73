/* SPDX-License-Identifier: MIT
 * resolve.c: from the nearest point of one triangle to a contact of the surface: true face normals, one-sidedness, and
 * edges that are only there because a surface is made of triangles. */
#include "scene.h"

/* A one-sided face is met from the front if the contact normal is not more than this behind it (sine of the angle). */
#define BEHIND 1e-6
/* Slope at which a neighbour counts as nearer than the shared edge: two neighbours must never both give way to the
 * other. Of places whose distances differ by rounding alone any may be found nearest: directions to them are apart by
 * the square root of that, 2e-8 or a little more. */
#define NEARER 1e-7
/* What rounding makes of the difference of two places some metres away, and more: at less than 0.1 um it turns a normal
 * by more than NEARER. */
#define ROUNDING 1e-14
/* Contact normals this close to a face's normal are that face's: below it lies what rounding makes of a flat surface
 * whose corners are known to 2e-9 m (at 1e7 m) over a few centimetres. Without it a walker would feel that it is made
 * of triangles. */
#define SNAP 1e-7
/* The same for a normal that leans up or down from an upright face: who comes down into a gap that is exactly as wide
 * as itself has arrived at both edges at once where their normals lean by less than the root of TAHR__ARRIVED over the
 * radius (1.7e-5 for 0.36 m), and would hang by them. Along the face the lower end of an upright segment comes nearer
 * to the edge by half of the square of this of the radius, 1.6e-10 m; what is sideways must be right as elsewhere. */
#define LEAN 3e-5
/* However near, where rounding turns a normal more: what leans by more is no face's. */
#define SNAP_MOST 1e-2
enum { FAN = TAHR__FAN };

typedef struct work {
    const tahr__query *query;
    const tahr__prim *prim;
    const tahr__body *body; /* of a mesh, with its map */
    tahr__map map;
    tahr_vec3 centre, motion;
    tahr__contact_normals *out;
    tahr_vec3 flat; /* the normal, or that of a face which it is but for rounding */
    double tilt2;   /* square of how far the normal is off it, at most */
    double slope;   /* at which a neighbour counts as nearer */
    double best;    /* of motion . face so far */
    uint32_t best_feature, flat_feature;
    int measure, nearer;
    int tied; /* 1: two faces that are not one oppose the motion alike, or are as flat */
} work;

/* Unit face normal in the local frame, from the unrounded corners. */
static tahr_vec3 face_normal(const work *w, uint32_t triangle)
{
    tahr_vec3 n = tahr__mesh_normal(&w->body->mesh, triangle);
    return w->map.turned ? m_apply(&w->map.turn, n) : n;
}

/* Does the triangle (corners v, local) lead from its corner `at` nearer to the core than the touched feature? to: the
 * other corner of a touched edge, 3 for a touched corner. */
static int leads_nearer(const work *w, const tahr_vec3 v[3], uint32_t at, uint32_t to)
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
        double rise = v_dot(w->out->normal, d);
        if (rise > 0 && rise * rise > w->slope * w->slope * v_dot(d, d)) return 1;
    }
    return 0;
}

/* The face as the shape meets it; 0: only from behind. */
static int meets(const work *w, uint32_t two_sided, tahr_vec3 *face)
{
    if (v_dot(*face, w->out->normal) >= -BEHIND) return 1;
    *face = v_scale(*face, -1);
    return two_sided != 0;
}

/* The square of how far the contact's normal is off a face's, but for what it may lean. */
static double tilt2_to(const work *w, tahr_vec3 face)
{
    tahr_vec3 d = v_sub(w->out->normal, face);
    if (w->query->core.axis_count < 2 && fabs(face.z) <= SNAP && fabs(d.z) <= LEAN) d.z = 0;
    return v_dot(d, d);
}

/* Is the contact's normal that of this face? Then a motion along the face does not approach, whichever face at the edge
 * opposes it most. Of several the one that it is nearest to, of those the lowest name. */
static void flatten(work *w, tahr_vec3 face, uint32_t feature)
{
    double tilt2 = tilt2_to(w, face);
    if (tilt2 == w->tilt2 && !tahr__same_vec(&face, &w->flat)) w->tied = 1;
    if (tilt2 > w->tilt2 || (tilt2 == w->tilt2 && feature >= w->flat_feature)) return;
    w->tilt2 = tilt2;
    w->flat_feature = feature;
    w->flat = face;
}

/* A neighbour at the touched edge or corner: is it nearer than that feature, does its face oppose the motion more? 1:
 * no need to look at others. Of faces that oppose it alike the lowest name counts, whatever the order they are found
 * in. */
static int weigh(work *w, tahr_vec3 face, const tahr_vec3 v[3], uint32_t at, uint32_t to, uint32_t feature)
{
    if (leads_nearer(w, v, at, to)) {
        w->nearer = 1;
        if (!w->measure) return 1;
        tahr__witness other;
        tahr__core_distance(&w->query->core, w->centre, v, &other);
        w->out->closer = d_min(w->out->closer, other.distance);
        if (w->out->closer <= w->out->enough) return 1;
    }
    flatten(w, face, feature);
    double along = v_dot(w->motion, face);
    if (along == w->best && !tahr__same_vec(&face, &w->out->face)) w->tied = 1;
    if (along < w->best || (along == w->best && feature < w->best_feature)) {
        w->best = along;
        w->best_feature = feature;
        w->out->face = face;
    }
    return 0;
}

static int look_at(work *w, uint32_t triangle, uint32_t at, uint32_t to)
{
    tahr_vec3 f = face_normal(w, triangle), v[3];
    if (!meets(w, w->body->flags & TAHR_BODY_TWO_SIDED, &f)) return 0;
    tahr__map_triangle(&w->map, w->body, triangle, v);
    return weigh(w, f, v, at, to, tahr__triangle_source(&w->body->mesh.triangles[triangle]));
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

/* All triangles at a corner that are connected to this one over edges at that corner. Returns how many; 0: not all. */
static uint32_t around_corner(work *w, uint32_t triangle, uint32_t corner, uint32_t fan[FAN])
{
    const tahr__triangle *all = w->body->mesh.triangles;
    uint32_t vertex = all[triangle].vertex[corner], count = 1;
    fan[0] = triangle;
    for (uint32_t i = 0; i < count; i++) {
        const tahr__triangle *t = &all[fan[i]];
        uint32_t at = corner_of(t, vertex), edges[2] = {at, (at + 2) % 3};
        if (i > 0 && look_at(w, fan[i], at, 3)) return 0;
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
    return count < FAN ? count : 0;
}

/* Who has come to a corner over one of its triangles has weighed them all. Over another one he weighs the same, but
 * that his own counts before others that are alike: where no two that differ are alike, all is the same, bit for bit.
 * The first one lay behind the corner, and so leads no nearer, as the others were found not to. */
static void remember(const work *w, const tahr__witness *witness, tahr__corner_met *c, uint32_t count)
{
    c->count = count;
    c->body = w->prim->body;
    c->point = witness->point;
    c->direction = witness->normal;
    c->distance = witness->distance;
    c->normal = w->out->normal;
    c->face = w->out->face;
    c->flat = w->flat;
    c->along = w->best;
    c->tilt2 = w->tilt2;
}

static int recall(work *w, const tahr__witness *witness, const tahr__corner_met *c, tahr_vec3 own)
{
    uint32_t i = 0;
    if (c->count == 0 || c->body != w->prim->body || c->distance != witness->distance ||
        !tahr__same_vec(&c->point, &witness->point) || !tahr__same_vec(&c->direction, &witness->normal)) {
        return 0;
    }
    while (i < c->count && c->fan[i] != w->prim->item)
        i++;
    int first = v_dot(w->motion, own) > c->along || tahr__same_vec(&own, &c->face);
    int flat = tilt2_to(w, own) > c->tilt2 || tahr__same_vec(&own, &c->flat);
    if (i == c->count || !first || !flat) return 0;
    w->out->normal = c->normal;
    w->out->face = c->face;
    return 1;
}

int tahr__resolve_near(tahr__resolving *resolving, const tahr__near *n)
{
    work *w = (work *)(void *)resolving;
    tahr_vec3 f = n->face;
    return meets(w, n->two_sided, &f) && weigh(w, f, n->v, n->at, n->to, n->feature);
}

static uint32_t look_around(work *w, const tahr__witness *witness, uint32_t fan[FAN])
{
    int is_edge = witness->feature < TAHR__CORNER;
    uint32_t which = witness->feature - (is_edge ? TAHR__EDGE : TAHR__CORNER);
    if (w->prim->kind & (TAHR__GATHERED | TAHR__FACELESS))
        tahr__around(w->query, w->prim, witness, (tahr__resolving *)(void *)w);
    else if (is_edge)
        around_edge(w, w->prim->item, which);
    else
        return around_corner(w, w->prim->item, which, fan);
    return 0;
}

/* What rounding makes of a normal. */
static double snap_at(double distance)
{
    return ROUNDING < SNAP_MOST * distance ? d_max(SNAP, ROUNDING / distance) : SNAP_MOST;
}

int tahr__resolve(const tahr__query *query, const tahr__prim *prim, tahr_vec3 centre, const tahr__witness *witness,
                  tahr_vec3 motion, tahr__contact_normals *out)
{
    out->normal = out->face = witness->normal;
    out->closer = witness->distance;
    if (prim->item & (TAHR__ITEM_ROUND | TAHR__ITEM_SOLID)) return TAHR__ACCEPTED;
    tahr_vec3 own = prim->kind & TAHR__FACELESS ? tahr__heights_face(query, prim) : prim->face;
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
    double snap = snap_at(witness->distance);
    work w;
    w.query = query;
    w.prim = prim;
    if (!(prim->kind & (TAHR__GATHERED | TAHR__FACELESS))) {
        w.body = &query->world->bodies[prim->body];
        w.map = tahr__map_make(query->frame, w.body);
    }
    w.centre = centre;
    w.motion = motion;
    w.out = out;
    w.slope = witness->distance * NEARER < ROUNDING ? ROUNDING / witness->distance : NEARER;
    w.best = v_dot(motion, own);
    w.best_feature = 0;
    w.measure = (int)out->measure;
    w.nearer = w.tied = 0;
    w.flat = out->normal;
    w.flat_feature = 0;
    w.tilt2 = snap * snap;
    tahr__corner_met *corner = query->corner;
    int keeps = corner && witness->feature >= TAHR__CORNER && !(prim->kind & (TAHR__GATHERED | TAHR__FACELESS));
    if (keeps && recall(&w, witness, corner, own)) return TAHR__ACCEPTED;
    uint32_t own_fan[FAN];
    flatten(&w, own, 0);
    if (keeps) corner->count = 0;
    const uint32_t count = look_around(&w, witness, keeps ? corner->fan : own_fan);
    if (w.nearer) return TAHR__NEIGHBOUR;
    out->normal = tilt2_to(&w, out->face) < snap * snap ? out->face : w.flat;
    if (keeps && !w.tied) remember(&w, witness, corner, count);
    return TAHR__ACCEPTED;
}

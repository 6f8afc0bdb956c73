/* SPDX-License-Identifier: MIT
 * piece_face.c: which faces of a piece are felt, and by which normal. */
#include "piece.h"

/* A contact whose normal leans behind a one-sided face by more than this came from behind and is none. */
#define BEHIND (-1e-6)
/* Slope at which a neighbour leads toward the shape, or near->lean if that is more. Of places whose distances differ by
 * rounding alone any may be found nearest: directions to them are apart by the square root of that, 2e-8 or a little
 * more. */
#define NEARER 1e-7
/* Contact normals this close to the face's are the face's: what is left of rounding at an edge of a flat surface. */
#define SNAP 1e-7
#define SNAP_MOST 1e-2 /* however near; what leans more is no face's */
/* How far beside a face (m) its points may lie by rounding, and how far a normal may lean off it. */
#define ON_FACE 1e-9

static tahr_vec3 facet_normal(const tahr__facet *f)
{
    return f->length > 0 ? v_scale(f->cross, 1.0 / f->length) : v_make(0, 0, 1);
}

int tahr__piece_in_front(const tahr__piece *piece, const tahr__near *near)
{
    if (piece->kind != TAHR__TRIANGLE || piece->two_sided) return 1;
    return v_dot(near->normal, facet_normal(&piece->facet)) >= BEHIND;
}

static uint32_t box_face(const tahr__piece *piece, tahr_vec3 direction, tahr_vec3 *normal)
{
    uint32_t best = 0;
    double most = -2;

    for (uint32_t i = 0; i < 3; i++) {
        tahr_vec3 n = v_unit(piece->solid.axis[i]);
        double along = v_dot(n, direction);
        if (fabs(along) <= most) continue;
        most = fabs(along);
        best = 2 * i + (along > 0);
        *normal = along > 0 ? n : v_scale(n, -1);
    }
    return best;
}

uint32_t tahr__piece_feature(const tahr__piece *piece, tahr_vec3 normal)
{
    tahr_vec3 n;

    if (piece->kind == TAHR__TRIANGLE) return tahr__triangle_source(&piece->mesh->triangles[piece->triangle]);
    if (piece->kind == TAHR__CONVEX && piece->convex.planes) return tahr__convex_hull_face(&piece->convex, normal);
    return piece->kind == TAHR__BOX ? box_face(piece, normal, &n) : 0;
}

/* What rounding makes of the normal of a contact. */
static double snap_of(const tahr__near *near)
{
    return near->rough ? TAHR__SAME_DIRECTION : d_min(SNAP_MOST, d_max(SNAP, near->lean));
}

/* Is the contact's normal that of this face? Then a motion along the face does not approach, whichever face at the edge
 * opposes it most. */
static void flatten(const tahr__near *near, tahr_vec3 face, tahr_vec3 *flat)
{
    tahr_vec3 tilt = v_sub(near->normal, face);
    double snap = snap_of(near);

    if (v_dot(tilt, tilt) < snap * snap) *flat = face;
}

/* Of the faces of a box that hold the nearest point, the one along direction. */
static void box_surface(const tahr__piece *piece, const tahr__near *near, tahr_vec3 direction, tahr_vec3 *face,
                        tahr_vec3 *flat)
{
    tahr_vec3 at = v_sub(near->point, piece->middle);
    double most = -2, beside = near->rough ? TAHR__SAME_PLACE : ON_FACE;
    double lean = near->rough ? TAHR__SAME_DIRECTION : ON_FACE;

    box_face(piece, near->normal, face);
    for (int i = 0; i < 6; i++) {
        double half = v_length(piece->solid.axis[i / 2]);
        tahr_vec3 outward = v_scale(piece->solid.axis[i / 2], (i & 1 ? 1 : -1) / half);
        if (!near->rough && v_dot(at, outward) >= half - beside) flatten(near, outward, flat);
        if (v_dot(at, outward) < half - beside || v_dot(outward, near->normal) <= lean ||
            v_dot(outward, direction) <= most)
            continue;
        most = v_dot(outward, direction);
        *face = outward;
    }
}

/* Which corner of a triangle a vertex is, or 3. */
static uint32_t corner_of(const tahr__triangle *t, uint32_t vertex)
{
    return t->vertex[0] == vertex ? 0 : t->vertex[1] == vertex ? 1 : t->vertex[2] == vertex ? 2 : 3;
}

/* Is a neighbour nearer than the edge (corners at, to) or corner (at == to) that it shares? It is if its face leads
 * from there toward the shape. Judged by slope, not by two distances: those would differ by rounding and each could
 * hide the other. */
static int is_nearer(const tahr__facet *other, uint32_t at, uint32_t to, const tahr__near *near)
{
    tahr_vec3 edge = v_sub(other->v[to], other->v[at]);

    for (uint32_t i = 0; i < 3; i++) {
        tahr_vec3 into = v_sub(other->v[i], other->v[at]);
        if (i == at || i == to) continue;
        if (at != to) into = v_mad(into, edge, -v_dot(into, edge) / v_dot(edge, edge));
        if (v_dot(near->normal, into) > d_max(NEARER, near->lean) * v_length(into)) return 1;
    }
    return 0;
}

/* The normal of a triangle, turned to the side of the contact if it has two. */
static tahr_vec3 facing_normal(const tahr__facet *f, uint32_t two_sided, tahr_vec3 contact)
{
    tahr_vec3 n = facet_normal(f);
    return two_sided && v_dot(n, contact) < 0 ? v_scale(n, -1) : n;
}

/* What is known at a shared edge or corner so far. */
typedef struct fan {
    const tahr__piece *piece;
    const tahr__near *near;
    uint32_t a, b; /* vertices of the edge; equal at a corner */
    tahr_vec3 direction;
    double most;
    tahr_vec3 *face, *flat;
} fan;

/* Looks at one neighbour; 0 if it is nearer. */
static int look_at(fan *f, uint32_t triangle)
{
    const tahr__mesh *mesh = f->piece->mesh;
    uint32_t from = corner_of(&mesh->triangles[triangle], f->a), to = corner_of(&mesh->triangles[triangle], f->b);
    tahr__piece other;

    if (triangle == f->piece->triangle || from == 3 || to == 3) return 1;
    tahr__piece_triangle(f->piece->frame, mesh, triangle, &other);
    tahr_vec3 normal = facing_normal(&other.facet, f->piece->two_sided, f->near->normal);
    if (v_dot(normal, f->near->normal) < BEHIND) return 1;
    if (is_nearer(&other.facet, from, to, f->near)) return 0;
    flatten(f->near, normal, f->flat);
    if (v_dot(normal, f->direction) > f->most) {
        f->most = v_dot(normal, f->direction);
        *f->face = normal;
    }
    return 1;
}

/* The triangles of an edge are linked in a ring; those of a corner are found where it is. */
static int edge_surface(fan *f, uint32_t edge)
{
    const tahr__mesh *mesh = f->piece->mesh;
    uint32_t i = mesh->triangles[f->piece->triangle].ring[edge];

    while (i != f->piece->triangle) {
        const tahr__triangle *t = &mesh->triangles[i];
        uint32_t a = corner_of(t, f->a), b = corner_of(t, f->b);
        if (!look_at(f, i)) return 0;
        i = t->ring[(a + 1) % 3 == b ? a : b];
    }
    return 1;
}

static int corner_surface(fan *f)
{
    const tahr__mesh *mesh = f->piece->mesh;
    tahr_bounds at = {mesh->vertices[f->a], mesh->vertices[f->a]};
    tahr__wide_walk walk;
    uint32_t i;

    tahr__wide_walk_begin(&walk, &mesh->tree, &at, 0, NULL);
    while (tahr__wide_walk_next(&walk, &i)) {
        if (!look_at(f, i)) return 0;
    }
    return 1;
}

static int mesh_surface(const tahr__piece *piece, const tahr__near *near, tahr_vec3 direction, tahr_vec3 *face,
                        tahr_vec3 *flat)
{
    const tahr__triangle *t = &piece->mesh->triangles[piece->triangle];
    int is_corner = near->part >= TAHR__CORNER;
    uint32_t i = is_corner ? near->part - TAHR__CORNER : near->part - TAHR__EDGE;
    fan f = {piece,        near,
             t->vertex[i], is_corner ? t->vertex[i] : t->vertex[(i + 1) % 3],
             direction,    v_dot(*face, direction),
             face,         flat};

    return is_corner ? corner_surface(&f) : edge_surface(&f, i);
}

int tahr__piece_face(const tahr__piece *piece, tahr_vec3 direction, tahr__near *near, tahr_vec3 *face)
{
    tahr_vec3 flat = near->normal;

    *face = near->normal;
    if (piece->kind == TAHR__BOX) box_surface(piece, near, direction, face, &flat);
    if (piece->kind == TAHR__CONVEX) tahr__convex_face(&piece->convex, near, direction, face);
    if (piece->kind != TAHR__TRIANGLE && !near->rough) {
        near->normal = flat;
        return 1;
    }
    if (piece->kind == TAHR__TRIANGLE) {
        *face = facing_normal(&piece->facet, piece->two_sided, near->normal);
        flatten(near, *face, &flat);
        if (near->part != TAHR__FACE && !mesh_surface(piece, near, direction, face, &flat)) return 0;
    }
    /* By iteration the way out of an overlap is as long as it is for its own normal. */
    if (near->rough && near->distance < 0) return 1;
    flatten(near, *face, &flat);
    near->normal = flat;
    return 1;
}

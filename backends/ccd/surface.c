/* SPDX-License-Identifier: MIT
 * surface.c: which face of a piece a contact belongs to, and whether an edge or corner of a mesh is to be felt. */
#include "scene.h"

/* Slope at which a neighbour leads toward the shape: rounding makes 1e-13 of a centimetre. */
#define NEARER 1e-9
/* Contact normals this close to the face's are the face's: what is left of rounding at an edge of a flat surface. */
#define SNAP 1e-7

static uint32_t box_face(const tahr__ccd_piece *piece, tahr_vec3 direction, tahr_vec3 *normal)
{
    uint32_t best = 0;
    double most = -2;

    for (uint32_t i = 0; i < 6; i++) {
        tahr_vec3 n = v_sub(piece->corner[1u << (i / 2)], piece->corner[0]);
        n = v_scale(v_unit(n), i & 1 ? 1 : -1);
        if (v_dot(n, direction) > most) {
            most = v_dot(n, direction);
            best = i;
            *normal = n;
        }
    }
    return best;
}

/* A hull by itself: where it lies does not matter for its faces. */
static uint32_t hull_face(const tahr__ccd_body *body, tahr_vec3 direction)
{
    const tahr__convex_side side = {.convex.turn = &body->turn, .planes = &body->hull.planes};
    return tahr__convex_hull_face(&side, direction);
}

uint32_t tahr__ccd_feature(const tahr__ccd_piece *piece, const tahr__ccd_near *near)
{
    tahr_vec3 n;

    if (piece->body->type == TAHR_BODY_MESH)
        return tahr__triangle_source(&piece->body->mesh.triangles[piece->triangle]);
    if (piece->body->type == TAHR_BODY_HULL) return hull_face(piece->body, near->normal);
    return piece->body->type == TAHR_BODY_BOX ? box_face(piece, near->normal, &n) : 0;
}

/* --- Boxes --- */

/* Of the faces of a box that hold the nearest point, the one along direction. */
static void box_surface(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                        tahr_vec3 direction, tahr_vec3 *face)
{
    double most = -2, same = probe->is_core ? 1e-9 : TAHR__SAME_PLACE;
    double toward = probe->is_core ? 1e-9 : TAHR__SAME_DIRECTION;

    box_face(piece, near->normal, face);
    for (int i = 0; i < 3; i++) {
        tahr_vec3 n = v_unit(v_sub(piece->corner[1 << i], piece->corner[0]));
        for (int side = -1; side <= 1; side += 2) {
            tahr_vec3 outward = v_scale(n, side);
            double height = v_dot(v_sub(near->point, piece->corner[side > 0 ? 7 : 0]), outward);
            if (height < -same || v_dot(outward, near->normal) <= toward || v_dot(outward, direction) <= most) continue;
            most = v_dot(outward, direction);
            *face = outward;
        }
    }
}

/* --- Meshes --- */

/* Which corner of a triangle a vertex is, or 3. */
static uint32_t corner_of(const tahr__triangle *t, uint32_t vertex)
{
    return t->vertex[0] == vertex ? 0 : t->vertex[1] == vertex ? 1 : t->vertex[2] == vertex ? 2 : 3;
}

/* Is a neighbour nearer than the edge (corners at, to) or corner (at == to) that it shares? It is if its face leads
 * from there toward the shape. Judged by slope, not by two distances: those would differ by rounding and each could
 * hide the other. */
static int is_nearer(const tahr__ccd_piece *other, uint32_t at, uint32_t to, tahr_vec3 normal)
{
    tahr_vec3 edge = v_sub(other->corner[to], other->corner[at]);

    for (uint32_t i = 0; i < 3; i++) {
        tahr_vec3 into = v_sub(other->corner[i], other->corner[at]);
        if (i == at || i == to) continue;
        if (at != to) into = v_mad(into, edge, -v_dot(into, edge) / v_dot(edge, edge));
        if (v_dot(normal, into) > NEARER * v_length(into)) return 1;
    }
    return 0;
}

/* The face of a mesh triangle, turned to the side of the contact if it has two. */
static tahr_vec3 facing_normal(const tahr__ccd_piece *piece, tahr_vec3 contact)
{
    tahr_vec3 n = tahr__convex_triangle_normal(piece->corner);
    return piece->body->surface.flags & TAHR_BODY_TWO_SIDED && v_dot(n, contact) < 0 ? v_scale(n, -1) : n;
}

static int mesh_surface(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                        tahr_vec3 direction, tahr_vec3 *face)
{
    const tahr__mesh *mesh = &piece->body->mesh;
    const tahr__triangle *t = &mesh->triangles[piece->triangle];
    uint32_t corner = near->part >= TAHR__CORNER ? near->part - TAHR__CORNER : near->part - TAHR__EDGE, first, count;
    uint32_t a = t->vertex[corner], b = near->part >= TAHR__CORNER ? a : t->vertex[(corner + 1) % 3];
    tahr_bounds at = {mesh->vertices[a], mesh->vertices[a]};
    double most = v_dot(*face, direction);
    tahr__bvh_walk walk;

    tahr__bvh_walk_begin(&walk, &mesh->bvh, &at, 0, mesh->vertices[a]);
    while (tahr__bvh_walk_next(&walk, &first, &count)) {
        for (uint32_t i = first; i < first + count; i++) {
            uint32_t from = corner_of(&mesh->triangles[i], a), to = corner_of(&mesh->triangles[i], b);
            tahr__ccd_piece other;
            if (i == piece->triangle || from == 3 || to == 3) continue;
            tahr__ccd_triangle(probe, piece->body, i, &other);
            tahr_vec3 normal = facing_normal(&other, near->normal);
            if (v_dot(normal, near->normal) < TAHR__CCD_BEHIND) continue;
            if (is_nearer(&other, from, to, near->normal)) return 0;
            if (v_dot(normal, direction) <= most) continue;
            most = v_dot(normal, direction);
            *face = normal;
        }
    }
    return 1;
}

int tahr__ccd_face(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 direction,
                   tahr__ccd_near *near, tahr_vec3 *face)
{
    int exact = probe->is_core && !tahr__ccd_is_convex(piece);
    double snap = exact ? SNAP : TAHR__SAME_DIRECTION;
    tahr_vec3 tilt;

    *face = near->normal;
    if (tahr__ccd_is_round(piece)) return 1;
    if (piece->body->type == TAHR_BODY_BOX) {
        box_surface(probe, piece, near, direction, face);
        if (exact) return 1;
    } else if (piece->body->type != TAHR_BODY_MESH) {
        tahr__convex_side side;
        tahr__ccd_side(probe, piece, &side);
        tahr__convex_face(&side, near, direction, face);
    } else {
        *face = facing_normal(piece, near->normal);
        if (near->part != TAHR__FACE && !mesh_surface(probe, piece, near, direction, face)) return 0;
    }
    /* The way out of an overlap is as long as it is for its own normal. */
    if (!exact && near->distance < 0) return 1;
    tilt = v_sub(near->normal, *face);
    if (v_dot(tilt, tilt) < snap * snap) near->normal = *face;
    return 1;
}

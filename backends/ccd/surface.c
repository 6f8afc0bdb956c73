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

/* The face of a hull that is most along a direction. */
static uint32_t hull_face(const tahr__ccd_body *body, tahr_vec3 direction, tahr_vec3 *normal)
{
    tahr_vec3 local = m_unapply(&body->turn, direction);
    uint32_t best = 0;

    for (uint32_t i = 1; i < body->planes.count; i++) {
        if (v_dot(body->planes.normals[i], local) > v_dot(body->planes.normals[best], local)) best = i;
    }
    *normal = m_apply(&body->turn, body->planes.normals[best]);
    return best;
}

uint32_t tahr__ccd_feature(const tahr__ccd_piece *piece, const tahr__ccd_near *near)
{
    tahr_vec3 n;

    if (piece->body->type == TAHR_BODY_MESH)
        return tahr__triangle_source(&piece->body->mesh.triangles[piece->triangle]);
    if (piece->body->type == TAHR_BODY_HULL) return hull_face(piece->body, near->normal, &n);
    return piece->body->type == TAHR_BODY_BOX ? box_face(piece, near->normal, &n) : 0;
}

/* --- Boxes --- */

/* Of the faces of a box that hold the nearest point, the one along direction. */
static void box_surface(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                        tahr_vec3 direction, tahr_vec3 *face)
{
    double most = -2, same = probe->is_core ? 1e-9 : TAHR__CCD_SAME_PLACE;
    double toward = probe->is_core ? 1e-9 : TAHR__CCD_SAME_DIRECTION;

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

/* --- Cylinders, cones, ellipsoids, hulls --- */

/* Takes a face that holds the nearest point, if it is more along direction than the one so far. */
static void take_face(tahr_vec3 n, const tahr__ccd_near *near, tahr_vec3 direction, tahr_vec3 *face, double *most)
{
    if (v_dot(n, near->normal) <= TAHR__CCD_SAME_DIRECTION || v_dot(n, direction) <= *most) return;
    *most = v_dot(n, direction);
    *face = n;
}

/* A level direction in the frame of a round body: from its axis to a point, or where that is on the axis along what the
 * question is about. */
static tahr_vec3 outward_of(tahr_vec3 p, tahr_vec3 direction)
{
    double length = sqrt(p.x * p.x + p.y * p.y), own = sqrt(direction.x * direction.x + direction.y * direction.y);
    if (length > TAHR__CCD_SAME_PLACE) return v_make(p.x / length, p.y / length, 0);
    return own > 0 ? v_make(direction.x / own, direction.y / own, 0) : v_make(1, 0, 0);
}

static void cylinder_surface(const tahr__ccd_body *b, double unit, const tahr__ccd_near *at, tahr_vec3 direction,
                             tahr_vec3 *face)
{
    tahr_vec3 p = at->point, side = outward_of(p, direction);
    double h = b->reach * unit, r = b->radius * unit, most = -2;

    if (p.z > h - TAHR__CCD_SAME_PLACE) take_face(v_make(0, 0, 1), at, direction, face, &most);
    if (p.z < -h + TAHR__CCD_SAME_PLACE) take_face(v_make(0, 0, -1), at, direction, face, &most);
    if (v_dot(p, side) > r - TAHR__CCD_SAME_PLACE) take_face(side, at, direction, face, &most);
}

static void cone_surface(const tahr__ccd_body *b, double unit, const tahr__ccd_near *at, tahr_vec3 direction,
                         tahr_vec3 *face)
{
    tahr_vec3 p = at->point, side = outward_of(p, direction);
    double h = b->reach * unit, r = b->radius * unit, most = -2;
    /* The side leans inward by r over the whole height. */
    tahr_vec3 n = v_unit(v_mad(v_make(0, 0, r), side, 2 * h));

    if (p.z < -h + TAHR__CCD_SAME_PLACE) take_face(v_make(0, 0, -1), at, direction, face, &most);
    if (v_dot(n, v_sub(p, v_make(0, 0, h))) > -TAHR__CCD_SAME_PLACE) take_face(n, at, direction, face, &most);
}

static void ellipsoid_surface(const tahr__ccd_body *b, tahr_vec3 p, tahr_vec3 *face)
{
    tahr_vec3 h = b->half_extents, n = v_make(p.x / (h.x * h.x), p.y / (h.y * h.y), p.z / (h.z * h.z));
    if (v_dot(n, n) > 0) *face = v_unit(n);
}

static void hull_surface(const tahr__ccd_body *b, double unit, const tahr__ccd_near *at, tahr_vec3 direction,
                         tahr_vec3 *face)
{
    double most = -2;
    for (uint32_t i = 0; i < b->planes.count; i++) {
        double height = v_dot(b->planes.normals[i], at->point) - b->planes.offsets[i] * unit;
        if (height > -TAHR__CCD_SAME_PLACE) take_face(b->planes.normals[i], at, direction, face, &most);
    }
}

/* In the frame of the body, and back. */
static void convex_surface(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                           tahr_vec3 direction, tahr_vec3 *face)
{
    const tahr__ccd_body *b = piece->body;
    tahr__ccd_near local = *near;
    tahr_vec3 n;

    local.point = m_unapply(&b->turn, v_sub(near->point, piece->corner[0]));
    local.normal = n = m_unapply(&b->turn, near->normal);
    direction = m_unapply(&b->turn, direction);
    switch (b->type) {
    case TAHR_BODY_CYLINDER: cylinder_surface(b, probe->unit, &local, direction, &n); break;
    case TAHR_BODY_CONE: cone_surface(b, probe->unit, &local, direction, &n); break;
    case TAHR_BODY_ELLIPSOID: ellipsoid_surface(b, local.point, &n); break;
    default: hull_surface(b, probe->unit, &local, direction, &n); break;
    }
    *face = m_apply(&b->turn, n);
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
    tahr_vec3 n = tahr__ccd_triangle_normal(piece->corner);
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
    double snap = exact ? SNAP : TAHR__CCD_SAME_DIRECTION;
    tahr_vec3 tilt;

    *face = near->normal;
    if (tahr__ccd_is_round(piece)) return 1;
    if (piece->body->type == TAHR_BODY_BOX) {
        box_surface(probe, piece, near, direction, face);
        if (exact) return 1;
    } else if (piece->body->type != TAHR_BODY_MESH) {
        convex_surface(probe, piece, near, direction, face);
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

/* SPDX-License-Identifier: MIT
 * measure.c: signed distances, contact normals and surface normals of the pieces, by core distance. libccd has no
 * distance, its depths are wrong by up to the whole depth, and its normals by up to 90 degrees at edges. */
#include "scene.h"

/* Nearer than this the direction between the nearest points is rounding: the way out is taken instead. */
#define TOUCHING 1e-10
/* Slope at which a neighbour leads toward the shape: rounding makes 1e-13 of a centimetre. */
#define NEARER 1e-9
/* Contact normals this close to the face's are the face's: what is left of rounding at an edge of a flat surface. */
#define SNAP 1e-7

static int is_round(const tahr__ccd_piece *piece)
{
    return piece->body->type == TAHR_BODY_SPHERE || piece->body->type == TAHR_BODY_CAPSULE;
}

static tahr_vec3 triangle_normal(const tahr_vec3 v[3])
{
    tahr_vec3 n = v_cross(v_sub(v[1], v[0]), v_sub(v[2], v[0]));
    return v_dot(n, n) > 0 ? v_unit(n) : v_make(0, 0, 1);
}

/* Corners of a box by bit: +x 1, +y 2, +z 4. Two triangles per face. */
static const unsigned char box_triangles[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};

static void measure_triangles(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                              tahr__witness *best)
{
    int count = piece->corner_count == 8 ? 12 : 1;

    for (int i = 0; i < count; i++) {
        tahr_vec3 v[3];
        tahr__witness w;
        for (int j = 0; j < 3; j++)
            v[j] = piece->corner[count == 12 ? box_triangles[i][j] : j];
        tahr__core_distance(&probe->core, centre, v, &w);
        if (i == 0 || w.distance < best->distance) *best = w;
    }
}

/* The piece as a centre and half axes. */
static tahr_vec3 solid_of(const tahr__ccd_piece *piece, tahr__core *solid)
{
    const tahr__ccd_body *b = piece->body;
    tahr_vec3 diagonal = b->type == TAHR_BODY_BOX ? piece->corner[7] : piece->corner[1];

    solid->axis_count = b->type == TAHR_BODY_BOX ? 3 : b->reach > 0 ? 1 : 0;
    if (solid->axis_count == 1) solid->axis[0] = v_scale(v_sub(piece->corner[1], piece->corner[0]), 0.5);
    for (int i = 0; i < 3 && solid->axis_count == 3; i++) {
        solid->axis[i] = v_scale(v_sub(piece->corner[1 << i], piece->corner[0]), 0.5);
    }
    return v_scale(v_add(piece->corner[0], diagonal), 0.5);
}

/* Two axes that meet along a line, or a point on an axis: out sideways, by any direction across. */
static tahr_vec3 across(const tahr__ccd_probe *probe, const tahr__core *solid)
{
    tahr_vec3 along = probe->core.axis_count > 0 ? probe->core.axis[0] : solid->axis[0];

    if (probe->core.axis_count + solid->axis_count == 0) return v_make(0, 0, 1);
    return v_unit(v_cross(fabs(along.x) <= fabs(along.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), along));
}

/* Depth of the cores in each other, or a negative number. */
static double core_depth(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre, double distance,
                         tahr_vec3 *normal)
{
    tahr__core solid;
    unsigned sides = piece->body->flags & TAHR_BODY_TWO_SIDED ? 3 : 1;

    if (piece->body->type != TAHR_BODY_MESH) {
        tahr_vec3 middle = solid_of(piece, &solid);
        if (distance > TOUCHING && is_round(piece)) return -1;
        double depth = tahr__core_leave_solid(&probe->core, centre, &solid, middle, normal);
        if (depth >= 0 || distance > TOUCHING) return depth;
        /* They touch: the axis that almost separates them is the way, if there is any. */
        if (depth < -2 * TOUCHING) *normal = across(probe, &solid);
        return 0;
    }
    if (distance > TOUCHING) return -1;
    const tahr__triangle *t = &piece->body->mesh.triangles[piece->triangle];
    int alone = 1;
    for (int i = 0; i < 3; i++)
        alone &= t->ring[i] == piece->triangle;
    return tahr__core_leave_triangle(&probe->core, centre, piece->corner, sides == 3 && alone ? 7 : sides, normal);
}

void tahr__ccd_measure(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                       tahr__ccd_near *near)
{
    tahr__witness w = {0};
    tahr_vec3 way_out;
    double depth;

    measure_triangles(probe, piece, centre, &w);
    near->point = w.point;
    near->part = w.feature;
    near->reserved = 0;
    depth = core_depth(probe, piece, centre, w.distance, &way_out);
    near->normal = depth >= 0 ? way_out : w.normal;
    near->distance = (depth >= 0 ? -depth : w.distance) - probe->radius - piece->radius;
    if (depth >= 0) near->part = TAHR__FACE;
    if (depth >= 0 && piece->body->type == TAHR_BODY_BOX) {
        near->point = v_mad(centre, near->normal, depth - tahr__core_extent(&probe->core, near->normal));
    }
    near->point = v_mad(near->point, near->normal, piece->radius);
}

int tahr__ccd_in_front(const tahr__ccd_piece *piece, const tahr__ccd_near *near)
{
    if (piece->body->type != TAHR_BODY_MESH || piece->body->flags & TAHR_BODY_TWO_SIDED) return 1;
    return v_dot(near->normal, triangle_normal(piece->corner)) >= TAHR__CCD_BEHIND;
}

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

uint32_t tahr__ccd_feature(const tahr__ccd_piece *piece, const tahr__ccd_near *near)
{
    tahr_vec3 n;

    if (piece->body->type == TAHR_BODY_MESH)
        return tahr__triangle_source(&piece->body->mesh.triangles[piece->triangle]);
    return piece->body->type == TAHR_BODY_BOX ? box_face(piece, near->normal, &n) : 0;
}

/* Of the faces of a box that hold the nearest point, the one along direction. */
static void box_surface(const tahr__ccd_piece *piece, const tahr__ccd_near *near, tahr_vec3 direction, tahr_vec3 *face)
{
    double most = -2;

    box_face(piece, near->normal, face);
    for (int i = 0; i < 3; i++) {
        tahr_vec3 n = v_unit(v_sub(piece->corner[1 << i], piece->corner[0]));
        for (int side = -1; side <= 1; side += 2) {
            tahr_vec3 outward = v_scale(n, side);
            double height = v_dot(v_sub(near->point, piece->corner[side > 0 ? 7 : 0]), outward);
            if (height < -1e-9 || v_dot(outward, near->normal) <= 1e-9 || v_dot(outward, direction) <= most) continue;
            most = v_dot(outward, direction);
            *face = outward;
        }
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
    tahr_vec3 n = triangle_normal(piece->corner);
    return piece->body->flags & TAHR_BODY_TWO_SIDED && v_dot(n, contact) < 0 ? v_scale(n, -1) : n;
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
    tahr_vec3 tilt;

    *face = near->normal;
    if (is_round(piece)) return 1;
    if (piece->body->type == TAHR_BODY_BOX) {
        box_surface(piece, near, direction, face);
        return 1;
    }
    *face = facing_normal(piece, near->normal);
    if (near->part != TAHR__FACE && !mesh_surface(probe, piece, near, direction, face)) return 0;
    tilt = v_sub(near->normal, *face);
    if (v_dot(tilt, tilt) < SNAP * SNAP) near->normal = *face;
    return 1;
}

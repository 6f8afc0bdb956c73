/* SPDX-License-Identifier: MIT
 * mesh.h: a triangle mesh made fit for movement at load: checked, welded, cleaned, with neighbours and a tree.
 *
 * Vertices with exactly equal coordinates are welded. Dropped are triangles without area (thinner than 1e-10 of their
 * longest edge: they are no surface, and what they connect is covered by their neighbours or open to a radius of at
 * least a millimetre) and exact duplicates (same corners, same winding; the lowest index stays). Triangles are stored
 * in leaf order of the tree; source says which triangle of the caller one is. */
#ifndef TAHR_COMMON_MESH_H
#define TAHR_COMMON_MESH_H

#include "wide.h"

/* Height over longest edge: below the first a triangle has no usable normal; below the second (an aspect of 1e4) its
 * normal is not trusted to rule a contact out early. */
#define TAHR__NO_AREA 1e-10
#define TAHR__THIN 1e-4

/* Bit of tahr__triangle.source: a sliver, its normal decides nothing early. */
#define TAHR__MESH_THIN 0x80000000u

typedef struct tahr__triangle {
    uint32_t vertex[3];
    /* Per edge (corner i to i+1): the next triangle at the same edge, cyclic; the triangle itself if it is alone.
     * A ring holds any number of triangles, so edges where more than two meet need no special case. */
    uint32_t ring[3];
    uint32_t source; /* the caller's index, and TAHR__MESH_THIN */
} tahr__triangle;

typedef struct tahr__mesh {
    tahr_vec3 *vertices;
    tahr__triangle *triangles;
    uint32_t vertex_count, triangle_count;
    uint32_t vertex_capacity, triangle_capacity;
    uint32_t dropped, reserved; /* triangles of the caller that are not there */
    tahr__wide tree;
    tahr_bounds bounds; /* of the vertices in use */
} tahr__mesh;

/* What to build from; body is only for messages. */
typedef struct tahr__mesh_source {
    const double *vertices;
    const uint32_t *indices;
    uint32_t vertex_count, triangle_count;
    uint32_t body;
    uint32_t reserved;
} tahr__mesh_source;

/* Is it fit to be built from? As tahr__mesh_build. */
tahr_status tahr__mesh_check(const tahr_host *host, const tahr__mesh_source *source);
/* TAHR_OK, TAHR_E_NULL, TAHR_E_GEOMETRY (with a message in the log), TAHR_E_MEMORY; nothing is kept on failure. */
tahr_status tahr__mesh_build(const tahr_host *host, const tahr__mesh_source *source, tahr__mesh *mesh);
void tahr__mesh_free(const tahr_host *host, tahr__mesh *mesh);

static inline uint32_t tahr__triangle_source(const tahr__triangle *t)
{
    return t->source & ~TAHR__MESH_THIN;
}

/* Of a triangle: unit, from its exact corners. Made anew each time: to read it would cost a line of memory. */
static inline tahr_vec3 tahr__mesh_normal(const tahr__mesh *mesh, uint32_t triangle)
{
    const uint32_t *v = mesh->triangles[triangle].vertex;
    tahr_vec3 a = mesh->vertices[v[0]];
    return v_unit(v_cross(v_sub(mesh->vertices[v[1]], a), v_sub(mesh->vertices[v[2]], a)));
}

/* Height over longest edge, 0 for no area at all. */
static inline double tahr__slimness(tahr_vec3 a, tahr_vec3 b, tahr_vec3 c)
{
    tahr_vec3 ab = v_sub(b, a), bc = v_sub(c, b), ca = v_sub(a, c);
    double longest2 = d_max(v_dot(ab, ab), d_max(v_dot(bc, bc), v_dot(ca, ca)));
    return longest2 > 0 ? v_length(v_cross(ab, ca)) / longest2 : 0;
}

/* Logs an error: "body 3: <text>". */
void tahr__log_body(const tahr_host *host, uint32_t body, const char *text);

#endif

/* SPDX-License-Identifier: MIT
 * hull_planes.c: faces of a convex hull, point by point: a point that lies in front of some faces replaces them by
 * faces to the rim of the hole that they leave. At most 256 points, at open only: nothing clever is needed. */
#include "hull_planes.h"

#include "room.h"

/* Of the extent: a point less in front of a face lies on it. A vertex that is left out by that is so little outside of
 * the faces; support functions know it all the same. */
#define ON_FACE 1e-9
/* Normals this close (1 - cosine) are one face. */
#define SAME 5e-13
#define COORDINATE_LIMIT 1e7

typedef struct face {
    uint32_t v[3]; /* counter-clockwise from outside */
    tahr_vec3 normal;
    double offset;
} face;

typedef struct builder {
    const tahr_vec3 *points;
    face *faces;
    uint32_t count;
    uint32_t reserved;
    double slack;
} builder;

static tahr_vec3 cross_of(const tahr_vec3 *p, uint32_t a, uint32_t b, uint32_t c)
{
    return v_cross(v_sub(p[b], p[a]), v_sub(p[c], p[a]));
}

static void add_face(builder *b, uint32_t i, uint32_t j, uint32_t k)
{
    tahr_vec3 n = cross_of(b->points, i, j, k);
    double length = v_length(n);
    face *f = &b->faces[b->count++];
    f->v[0] = i;
    f->v[1] = j;
    f->v[2] = k;
    f->normal = length > 0 ? v_scale(n, 1 / length) : v_make(0, 0, 0);
    f->offset = v_dot(f->normal, b->points[i]);
}

static int sees(const builder *b, const face *f, uint32_t point)
{
    return v_dot(f->normal, b->points[point]) - f->offset > b->slack;
}

/* Is the edge from i to j the border of a face that is kept? Then the point does not see across it. */
static int is_rim(const builder *b, uint32_t i, uint32_t j, uint32_t point)
{
    for (uint32_t k = 0; k < b->count; k++) {
        const face *f = &b->faces[k];
        for (int e = 0; e < 3; e++) {
            if (f->v[e] == j && f->v[(e + 1) % 3] == i) return !sees(b, f, point);
        }
    }
    return 0;
}

static void add_point(builder *b, uint32_t point)
{
    uint32_t rim[2 * TAHR__HULL_PLANES][2], edges = 0, kept = 0;
    for (uint32_t k = 0; k < b->count; k++) {
        const face *f = &b->faces[k];
        if (!sees(b, f, point)) continue;
        for (int e = 0; e < 3; e++) {
            uint32_t i = f->v[e], j = f->v[(e + 1) % 3];
            if (edges == 2 * TAHR__HULL_PLANES || !is_rim(b, i, j, point)) continue;
            rim[edges][0] = i;
            rim[edges++][1] = j;
        }
    }
    for (uint32_t k = 0; k < b->count; k++) {
        if (!sees(b, &b->faces[k], point)) b->faces[kept++] = b->faces[k];
    }
    b->count = kept;
    for (uint32_t e = 0; e < edges && b->count < TAHR__HULL_PLANES; e++)
        add_face(b, rim[e][0], rim[e][1], point);
}

/* Four corners as far apart as a look each finds them. Returns 0 if all lie in a plane. */
static int first_corners(const builder *b, uint32_t count, uint32_t corner[4])
{
    const tahr_vec3 *p = b->points;
    double most = -1;
    memset(corner, 0, 4 * sizeof *corner);
    for (uint32_t i = 0; i < count; i++) {
        if (p[i].x < p[corner[0]].x) corner[0] = i;
    }
    for (int k = 1; k < 4; k++, most = -1) {
        tahr_vec3 a = p[corner[0]], e = v_sub(p[corner[1]], a), n = cross_of(p, corner[0], corner[1], corner[2]);
        for (uint32_t i = 0; i < count; i++) {
            tahr_vec3 d = v_sub(p[i], a), c = v_cross(e, d);
            double far = k == 1 ? v_dot(d, d) : k == 2 ? v_dot(c, c) : fabs(v_dot(n, d));
            if (!(far > most)) continue;
            most = far;
            corner[k] = i;
        }
    }
    tahr_vec3 n = cross_of(p, corner[0], corner[1], corner[2]);
    double length = v_length(n), height = v_dot(n, v_sub(p[corner[3]], p[corner[0]]));
    if (!(length > 0) || !(fabs(height) > b->slack * length)) return 0;
    if (height > 0) { /* the first face looks away from the fourth corner */
        uint32_t swap = corner[1];
        corner[1] = corner[2];
        corner[2] = swap;
    }
    return 1;
}

static const char *bad_points(const tahr_vec3 *points, uint32_t count)
{
    if (count < 4 || count > TAHR__HULL_VERTICES) return "vertex_count: a hull has 4 to 256 vertices";
    for (uint32_t i = 0; i < count; i++) {
        tahr_vec3 p = v_abs(points[i]);
        if (p.x <= COORDINATE_LIMIT && p.y <= COORDINATE_LIMIT && p.z <= COORDINATE_LIMIT) continue;
        return "vertices: a hull's are finite numbers within 1e7 m";
    }
    return NULL;
}

static void keep_planes(const builder *b, uint32_t count, tahr__hull_planes *planes)
{
    for (uint32_t i = 0; i < b->count; i++) {
        tahr_vec3 n = b->faces[i].normal;
        int known = !(v_dot(n, n) > 0);
        for (uint32_t k = 0; k < planes->count && !known; k++)
            known = v_dot(n, planes->normals[k]) > 1 - SAME;
        if (known) continue;
        double most = v_dot(n, b->points[0]);
        for (uint32_t k = 1; k < count; k++)
            most = d_max(most, v_dot(n, b->points[k]));
        planes->normals[planes->count] = n;
        planes->offsets[planes->count++] = most;
    }
}

tahr_status tahr__hull_planes_build(const tahr_host *host, const tahr_vec3 *points, uint32_t count,
                                    tahr__hull_planes *planes, const char **reason)
{
    builder b = {.points = points};
    uint32_t corner[4];
    memset(planes, 0, sizeof *planes);
    *reason = bad_points(points, count);
    if (*reason) return TAHR_E_GEOMETRY;
    tahr_vec3 low = points[0], high = points[0];
    for (uint32_t i = 1; i < count; i++) {
        low = v_min(low, points[i]);
        high = v_max(high, points[i]);
    }
    b.slack = ON_FACE * v_length(v_sub(high, low));
    if (!first_corners(&b, count, corner)) {
        *reason = "vertices: all of a hull's lie in a plane";
        return TAHR_E_GEOMETRY;
    }
    b.faces = tahr__room_get(host, TAHR__HULL_PLANES, sizeof *b.faces);
    planes->normals = tahr__room_get(host, TAHR__HULL_PLANES, sizeof *planes->normals);
    planes->offsets = tahr__room_get(host, TAHR__HULL_PLANES, sizeof *planes->offsets);
    planes->capacity = TAHR__HULL_PLANES;
    tahr_status status = b.faces && planes->normals && planes->offsets ? TAHR_OK : TAHR_E_MEMORY;
    if (status == TAHR_OK) {
        add_face(&b, corner[0], corner[1], corner[2]);
        add_face(&b, corner[0], corner[2], corner[3]);
        add_face(&b, corner[2], corner[1], corner[3]);
        add_face(&b, corner[1], corner[0], corner[3]);
        for (uint32_t i = 0; i < count; i++)
            add_point(&b, i);
        keep_planes(&b, count, planes);
    } else {
        tahr__hull_planes_free(host, planes);
    }
    tahr__room_put(host, b.faces, TAHR__HULL_PLANES, sizeof *b.faces);
    return status;
}

void tahr__hull_planes_free(const tahr_host *host, tahr__hull_planes *planes)
{
    tahr__room_put(host, planes->normals, planes->capacity, sizeof *planes->normals);
    tahr__room_put(host, planes->offsets, planes->capacity, sizeof *planes->offsets);
    memset(planes, 0, sizeof *planes);
}

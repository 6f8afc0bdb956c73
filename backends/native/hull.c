/* SPDX-License-Identifier: MIT
 * hull.c: convex hulls as bodies: a closed mesh of their faces, and the way out of their inside.
 *
 * Points are added one by one: the faces that see a point go, their outline is joined to it. Who sees what is decided
 * exactly, and a point in the plane of a face is not seen, so the outline is always one closed ring. */
#include "orient.h"
#include "scene.h"

#include <stdio.h>
#include <string.h>

enum { POINTS = 256, FACES = 2 * POINTS };
#define COORDINATE_LIMIT 1e7
/* Far below the finest size (1e-6 m): less is zero, so that exact products of three do not underflow. */
#define TINY 1e-30
/* Faces within this angle of each other (rad) are one, with one feature. */
#define ONE_FACE 1e-7

typedef struct builder {
    tahr_vec3 point[POINTS];
    uint32_t face[FACES][3]; /* counter-clockwise seen from outside */
    uint32_t count;
    uint16_t seen[POINTS][POINTS]; /* [a][b]: point + 1, for which the face with the edge a b went */
} builder;

static tahr_status read_points(const tahr_host *host, const tahr_body_desc *d, uint32_t body, builder *b)
{
    for (uint32_t i = 0; i < 3 * d->vertex_count; i++) {
        double x = d->vertices[i];
        if (x >= -COORDINATE_LIMIT && x <= COORDINATE_LIMIT) continue;
        char text[160];
        snprintf(text, sizeof text, "vertex %u: %c is %g, not a finite number within 1e7 m", i / 3, "xyz"[i % 3], x);
        tahr__log_body(host, body, text);
        return TAHR_E_GEOMETRY;
    }
    for (uint32_t i = 0; i < d->vertex_count; i++) {
        const double *v = d->vertices + 3 * (size_t)i;
        b->point[i] = v_make(fabs(v[0]) < TINY ? 0 : v[0], fabs(v[1]) < TINY ? 0 : v[1], fabs(v[2]) < TINY ? 0 : v[2]);
    }
    return TAHR_OK;
}

static void put_face(builder *b, uint32_t p, uint32_t q, uint32_t r)
{
    uint32_t *f = b->face[b->count++];
    f[0] = p;
    f[1] = q;
    f[2] = r;
}

/* Four points that are not in one plane: far apart as seen from the first, so that rounding rarely matters. 0: there
 * are none. */
static int begin(builder *b, uint32_t count)
{
    uint32_t q = 0, r = 0;
    double most = 0;
    for (uint32_t i = 1; i < count; i++) {
        tahr_vec3 d = v_sub(b->point[i], b->point[0]);
        if (v_dot(d, d) > most) most = v_dot(d, d), q = i;
    }
    tahr_vec3 axis = v_sub(b->point[q], b->point[0]);
    most = 0;
    for (uint32_t i = 1; i < count; i++) {
        tahr_vec3 n = v_cross(axis, v_sub(b->point[i], b->point[0]));
        if (v_dot(n, n) > most) most = v_dot(n, n), r = i;
    }
    for (uint32_t s = 1; s < count && r > 0; s++) {
        int side = tahr__orient(b->point[0], b->point[q], b->point[r], b->point[s]);
        if (side == 0) continue;
        uint32_t first = side < 0 ? q : r, second = side < 0 ? r : q;
        put_face(b, 0, first, second);
        put_face(b, 0, s, first);
        put_face(b, first, s, second);
        put_face(b, second, s, 0);
        return 1;
    }
    return 0;
}

static int sees(const builder *b, uint32_t p, const uint32_t f[3])
{
    return tahr__orient(b->point[f[0]], b->point[f[1]], b->point[f[2]], b->point[p]) > 0;
}

static void add_point(builder *b, uint32_t p)
{
    uint32_t gone[FACES][3], gone_count = 0, kept = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t *f = b->face[i];
        if (sees(b, p, f)) {
            memcpy(gone[gone_count++], f, sizeof gone[0]);
            for (int k = 0; k < 3; k++)
                b->seen[f[k]][f[(k + 1) % 3]] = (uint16_t)(p + 1);
        } else {
            memmove(b->face[kept++], f, sizeof gone[0]);
        }
    }
    b->count = kept;
    for (uint32_t i = 0; i < gone_count; i++) {
        for (int k = 0; k < 3; k++) {
            uint32_t from = gone[i][k], to = gone[i][(k + 1) % 3];
            if (b->seen[to][from] != p + 1) put_face(b, from, to, p);
        }
    }
}

/* Gives all triangles of a face its number, in the order of their lowest source. */
static void name_faces(tahr__mesh *mesh)
{
    uint32_t at[FACES], name[FACES], stack[FACES], names = 0;
    memset(at, 0xff, sizeof at);
    memset(name, 0xff, sizeof name);
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        at[tahr__triangle_source(&mesh->triangles[i])] = i;
    for (uint32_t source = 0; source < FACES; source++) {
        uint32_t top = 0;
        if (at[source] == TAHR__NONE || name[at[source]] != TAHR__NONE) continue;
        name[at[source]] = names++;
        for (stack[top++] = at[source]; top > 0;) {
            uint32_t t = stack[--top];
            for (int k = 0; k < 3; k++) {
                uint32_t next = mesh->triangles[t].ring[k];
                tahr_vec3 d = v_sub(tahr__mesh_normal(mesh, next), tahr__mesh_normal(mesh, at[source]));
                if (name[next] != TAHR__NONE || v_dot(d, d) > ONE_FACE * ONE_FACE) continue;
                name[next] = names - 1;
                stack[top++] = next;
            }
        }
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        tahr__triangle *t = &mesh->triangles[i];
        t->source = (t->source & TAHR__MESH_THIN) | name[i];
    }
}

tahr_status tahr__hull_build(const tahr_host *host, const tahr_body_desc *d, uint32_t body, tahr__mesh *mesh)
{
    builder *b = host->allocator.alloc(host->allocator.user, sizeof *b, 64);
    if (!b) return TAHR_E_MEMORY;
    memset(b, 0, sizeof *b);
    tahr_status status = read_points(host, d, body, b);
    if (status == TAHR_OK && !begin(b, d->vertex_count)) {
        tahr__log_body(host, body, "vertices: all of the hull lie in one plane");
        status = TAHR_E_GEOMETRY;
    }
    for (uint32_t i = 1; status == TAHR_OK && i < d->vertex_count; i++)
        add_point(b, i);
    if (status == TAHR_OK) {
        tahr__mesh_source source = {&b->point[0].x, &b->face[0][0], d->vertex_count, b->count, body, 0};
        status = tahr__mesh_build(host, &source, mesh);
    }
    host->allocator.free(host->allocator.user, b, sizeof *b, 64);
    if (status == TAHR_OK) name_faces(mesh);
    return status;
}

uint32_t tahr__hull_face(const tahr__mesh *mesh, tahr_vec3 direction)
{
    uint32_t best = 0, face = TAHR__NONE;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        double along = v_dot(tahr__mesh_normal(mesh, i), direction),
               most = v_dot(tahr__mesh_normal(mesh, best), direction);
        uint32_t source = tahr__triangle_source(&mesh->triangles[i]);
        if (face == TAHR__NONE || along > most || (along == most && source < face)) {
            best = i;
            face = source;
        }
    }
    return face;
}

/* The least way out so far, in body coordinates. */
typedef struct way {
    tahr__core core;
    tahr_vec3 centre, normal;
    double depth; /* negative: outside */
} way;

/* Across the direction n (any length), in which the hull ends at the point `end`. */
static void try_way(way *w, tahr_vec3 n, tahr_vec3 end)
{
    double length = v_length(n);
    double depth = (v_dot(n, v_sub(end, w->centre)) + tahr__core_extent(&w->core, n)) / length;
    if (depth >= w->depth) return;
    w->depth = depth;
    w->normal = v_scale(n, 1 / length);
}

/* Along the edge k of a triangle and an axis of the core, where both touch at once: the hull ends at the edge if
 * neither triangle at it rises above. */
static void try_edge(way *w, const tahr__mesh *mesh, uint32_t triangle, uint32_t k)
{
    const tahr__triangle *t = &mesh->triangles[triangle], *o = &mesh->triangles[t->ring[k]];
    const tahr_vec3 *v = mesh->vertices;
    tahr_vec3 a = v[t->vertex[k]], edge = v_sub(v[t->vertex[(k + 1) % 3]], a);
    for (int i = 0; i < w->core.axis_count; i++) {
        tahr_vec3 n = v_cross(edge, w->core.axis[i]);
        /* Less than this between them is parallel, and a face answers. */
        if (v_dot(n, n) <= 1e-20 * v_dot(edge, edge) * v_dot(w->core.axis[i], w->core.axis[i])) continue;
        for (int side = 0; side < 2; side++, n = v_scale(n, -1)) {
            int ends = 1;
            for (int c = 0; c < 3; c++) {
                ends &= v_dot(n, v_sub(v[t->vertex[c]], a)) <= 1e-12 * v_length(n) * v_length(edge);
                ends &= v_dot(n, v_sub(v[o->vertex[c]], a)) <= 1e-12 * v_length(n) * v_length(edge);
            }
            if (ends) try_way(w, n, a);
        }
    }
}

/* Across the faces of a box. */
static void try_axis(way *w, const tahr__mesh *mesh, tahr_vec3 n)
{
    for (int side = 0; side < 2; side++, n = v_scale(n, -1)) {
        tahr_vec3 end = mesh->vertices[0];
        for (uint32_t i = 1; i < mesh->vertex_count; i++)
            end = v_dot(n, mesh->vertices[i]) > v_dot(n, end) ? mesh->vertices[i] : end;
        try_way(w, n, end);
    }
}

/* The sum of the hull and the core is convex; its faces are those of either, and one for each pair of an edge and an
 * axis. The nearest of them is the way out. */
double tahr__hull_leave(const tahr__core *core, tahr_vec3 centre, const tahr__mesh *mesh, const tahr__map *map,
                        tahr_vec3 *normal)
{
    way w = {.core = *core, .centre = m_unapply(&map->turn, v_sub(centre, map->offset)), .depth = INFINITY};
    for (int i = 0; i < core->axis_count; i++)
        w.core.axis[i] = m_unapply(&map->turn, core->axis[i]);
    for (uint32_t i = 0; i < mesh->triangle_count && w.depth >= 0; i++)
        try_way(&w, tahr__mesh_normal(mesh, i), mesh->vertices[mesh->triangles[i].vertex[0]]);
    for (uint32_t i = 0; i < mesh->triangle_count && w.depth >= 0; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            if (mesh->triangles[i].ring[k] >= i) try_edge(&w, mesh, i, k);
        }
    }
    for (int i = 0; i < core->axis_count && core->axis_count == 3 && w.depth >= 0; i++)
        try_axis(&w, mesh, w.core.axis[i]);
    *normal = map->turned ? m_apply(&map->turn, w.normal) : w.normal;
    return w.depth;
}

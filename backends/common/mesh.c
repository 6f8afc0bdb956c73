/* SPDX-License-Identifier: MIT
 * mesh.c: checking, welding, cleaning and connecting a triangle mesh at load. */
#include "mesh.h"

#include "room.h"

#include <stdio.h>

/* Beyond this a double has no nanometres left, and products of coordinates in the narrow phase lose micrometres. */
#define COORDINATE_LIMIT 1e7
/* Keeps every table below 2^31 entries. */
#define MAX_TRIANGLES (1u << 28)
#define MAX_VERTICES (3u << 28)
#define NONE 0xFFFFFFFFu

void tahr__log_body(const tahr_host *host, uint32_t body, const char *text)
{
    char line[192];
    snprintf(line, sizeof line, "body %u: %s", (unsigned)body, text);
    host->log.write(host->log.user, TAHR_LOG_ERROR, line);
}

tahr_status tahr__mesh_check(const tahr_host *host, const tahr__mesh_source *s)
{
    char text[160];
    if (s->triangle_count == 0) {
        tahr__log_body(host, s->body, "triangle_count is 0: a mesh needs at least one triangle");
        return TAHR_E_GEOMETRY;
    }
    if (!s->vertices || !s->indices) {
        tahr__log_body(host, s->body, "vertices or indices is NULL");
        return TAHR_E_NULL;
    }
    if (s->triangle_count > MAX_TRIANGLES || s->vertex_count > MAX_VERTICES) {
        tahr__log_body(host, s->body, "triangle_count is above 2^28 or vertex_count above 3 * 2^28");
        return TAHR_E_UNSUPPORTED;
    }
    for (size_t i = 0; i < (size_t)s->vertex_count * 3; i++) {
        double x = s->vertices[i];
        if (x >= -COORDINATE_LIMIT && x <= COORDINATE_LIMIT) continue;
        snprintf(text, sizeof text, "vertex %zu: %c is %g, not a finite number within 1e7 m", i / 3, "xyz"[i % 3], x);
        tahr__log_body(host, s->body, text);
        return TAHR_E_GEOMETRY;
    }
    for (size_t i = 0; i < (size_t)s->triangle_count * 3; i++) {
        if (s->indices[i] < s->vertex_count) continue;
        snprintf(text, sizeof text, "triangle %zu: index %u is not below vertex_count %u", i / 3,
                 (unsigned)s->indices[i], (unsigned)s->vertex_count);
        tahr__log_body(host, s->body, text);
        return TAHR_E_GEOMETRY;
    }
    return TAHR_OK;
}

static uint32_t table_size(size_t items)
{
    uint32_t size = 16;
    while (size < items + items / 2)
        size += size;
    return size;
}

static uint32_t mix(uint64_t h)
{
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53ULL;
    return (uint32_t)(h ^ (h >> 33));
}

static uint32_t hash_vertex(const double *v)
{
    uint64_t h = 0;
    for (int i = 0; i < 3; i++) {
        double x = v[i] + 0.0; /* -0 and +0 are the same place */
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        h = h * 0x9e3779b97f4a7c15ULL + bits;
    }
    return mix(h);
}

/* remap[i] = the first vertex at the same place as vertex i. */
static tahr_status weld(const tahr_host *host, const tahr__mesh_source *s, uint32_t *remap)
{
    uint32_t size = table_size(s->vertex_count), *table = tahr__room_get(host, size, sizeof *table);
    if (!table) return TAHR_E_MEMORY;
    memset(table, 0xff, size * sizeof *table);
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        const double *v = s->vertices + 3 * (size_t)i;
        uint32_t slot = hash_vertex(v) & (size - 1);
        while (table[slot] != NONE) {
            const double *w = s->vertices + 3 * (size_t)table[slot];
            if (v[0] == w[0] && v[1] == w[1] && v[2] == w[2]) break;
            slot = (slot + 1) & (size - 1);
        }
        if (table[slot] == NONE) table[slot] = i;
        remap[i] = table[slot];
    }
    tahr__room_put(host, table, size, sizeof *table);
    return TAHR_OK;
}

static tahr_vec3 source_vertex(const tahr__mesh_source *s, uint32_t i)
{
    const double *v = s->vertices + 3 * (size_t)i;
    return v_make(v[0] + 0.0, v[1] + 0.0, v[2] + 0.0); /* one zero, whichever of the welded ones is taken */
}

/* The triangle's corners turned so that the smallest comes first: equal for equal triangles of the same winding. */
static void canonical(const uint32_t v[3], uint32_t out[3])
{
    int k = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
    for (int i = 0; i < 3; i++)
        out[i] = v[(k + i) % 3];
}

/* Fills triangles (welded vertex ids of the caller, source) without those that have no area or came before. */
static tahr_status clean(const tahr_host *host, const tahr__mesh_source *s, const uint32_t *remap,
                         tahr__triangle *triangles, uint32_t *count)
{
    uint32_t size = table_size(s->triangle_count), *table = tahr__room_get(host, size, sizeof *table), kept = 0;
    if (!table) return TAHR_E_MEMORY;
    memset(table, 0xff, size * sizeof *table);
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        const uint32_t *index = s->indices + 3 * (size_t)i;
        uint32_t raw[3] = {remap[index[0]], remap[index[1]], remap[index[2]]}, v[3];
        double slim = tahr__slimness(source_vertex(s, raw[0]), source_vertex(s, raw[1]), source_vertex(s, raw[2]));
        if (!(slim > TAHR__NO_AREA)) continue;
        canonical(raw, v);
        uint32_t slot = mix(((uint64_t)v[0] << 32 | v[1]) * 0x9e3779b97f4a7c15ULL + v[2]) & (size - 1);
        while (table[slot] != NONE) {
            uint32_t other[3];
            canonical(triangles[table[slot]].vertex, other);
            if (memcmp(v, other, sizeof v) == 0) break;
            slot = (slot + 1) & (size - 1);
        }
        if (table[slot] != NONE) continue;
        table[slot] = kept;
        memcpy(triangles[kept].vertex, raw, sizeof raw);
        triangles[kept].source = i | (slim < TAHR__THIN ? TAHR__MESH_THIN : 0);
        kept++;
    }
    tahr__room_put(host, table, size, sizeof *table);
    *count = kept;
    return TAHR_OK;
}

/* Takes the vertices that are in use, in their old order, and renumbers the triangles. remap is overwritten. */
static tahr_status compact(const tahr_host *host, const tahr__mesh_source *s, uint32_t *remap, tahr__mesh *mesh)
{
    for (uint32_t i = 0; i < s->vertex_count; i++)
        remap[i] = NONE;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            remap[mesh->triangles[i].vertex[k]] = 0;
    }
    uint32_t used = 0;
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        if (remap[i] != NONE) remap[i] = used++;
    }
    mesh->vertices = tahr__room_get(host, used, sizeof *mesh->vertices);
    if (!mesh->vertices) return TAHR_E_MEMORY;
    mesh->vertex_count = mesh->vertex_capacity = used;
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        if (remap[i] == NONE) continue;
        tahr_vec3 v = source_vertex(s, i);
        mesh->vertices[remap[i]] = v;
        if (remap[i] == 0) mesh->bounds.min = mesh->bounds.max = v;
        mesh->bounds.min = v_min(mesh->bounds.min, v);
        mesh->bounds.max = v_max(mesh->bounds.max, v);
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            mesh->triangles[i].vertex[k] = remap[mesh->triangles[i].vertex[k]];
    }
    return TAHR_OK;
}

static tahr_status build_tree(const tahr_host *host, tahr__mesh *mesh)
{
    uint32_t n = mesh->triangle_count;
    tahr__bvh_box *boxes = tahr__room_get(host, n, sizeof *boxes);
    uint32_t *order = tahr__room_get(host, n, sizeof *order);
    tahr__triangle *sorted = tahr__room_get(host, n, sizeof *sorted);
    tahr_vec3 centre = v_scale(v_add(mesh->bounds.min, mesh->bounds.max), 0.5);
    tahr_status status = boxes && order && sorted ? TAHR_OK : TAHR_E_MEMORY;
    for (uint32_t i = 0; status == TAHR_OK && i < n; i++) {
        const uint32_t *v = mesh->triangles[i].vertex;
        tahr_vec3 a = mesh->vertices[v[0]], b = mesh->vertices[v[1]], c = mesh->vertices[v[2]];
        tahr_bounds bounds = {v_min(a, v_min(b, c)), v_max(a, v_max(b, c))};
        boxes[i] = tahr__bvh_box_make(&bounds, centre);
    }
    if (status == TAHR_OK) status = tahr__wide_build(host, boxes, order, n, centre, &mesh->tree);
    tahr__room_put(host, boxes, n, sizeof *boxes);
    if (status == TAHR_OK) {
        for (uint32_t i = 0; i < n; i++)
            sorted[i] = mesh->triangles[order[i]];
        tahr__triangle *old = mesh->triangles;
        mesh->triangles = sorted;
        sorted = old;
        uint32_t capacity = mesh->triangle_capacity;
        mesh->triangle_capacity = n;
        tahr__room_put(host, sorted, capacity, sizeof *sorted);
    } else {
        tahr__room_put(host, sorted, n, sizeof *sorted);
    }
    tahr__room_put(host, order, n, sizeof *order);
    return status;
}

/* Rings: all triangles at one edge linked in a circle, found through a table keyed by the edge's two corners. */
static tahr_status connect(const tahr_host *host, tahr__mesh *mesh)
{
    uint32_t edges = mesh->triangle_count * 3, size = table_size(edges),
             *table = tahr__room_get(host, size, sizeof *table);
    if (!table) return TAHR_E_MEMORY;
    memset(table, 0xff, size * sizeof *table);
    for (uint32_t e = 0; e < edges; e++) {
        tahr__triangle *t = &mesh->triangles[e / 3];
        uint32_t a = t->vertex[e % 3], b = t->vertex[(e % 3 + 1) % 3];
        uint32_t low = a < b ? a : b, high = a < b ? b : a;
        uint32_t slot = mix(((uint64_t)low << 32 | high) * 0x9e3779b97f4a7c15ULL) & (size - 1);
        t->ring[e % 3] = e / 3;
        while (table[slot] != NONE) {
            tahr__triangle *o = &mesh->triangles[table[slot] / 3];
            uint32_t k = table[slot] % 3, c = o->vertex[k], d = o->vertex[(k + 1) % 3];
            if ((c == a && d == b) || (c == b && d == a)) {
                t->ring[e % 3] = o->ring[k];
                o->ring[k] = e / 3;
                break;
            }
            slot = (slot + 1) & (size - 1);
        }
        if (table[slot] == NONE) table[slot] = e;
    }
    tahr__room_put(host, table, size, sizeof *table);
    return TAHR_OK;
}

tahr_status tahr__mesh_build(const tahr_host *host, const tahr__mesh_source *source, tahr__mesh *mesh)
{
    tahr__mesh m;
    memset(&m, 0, sizeof m);
    tahr_status status = tahr__mesh_check(host, source);
    if (status != TAHR_OK) return status;
    uint32_t *remap = tahr__room_get(host, source->vertex_count, sizeof *remap);
    m.triangles = tahr__room_get(host, source->triangle_count, sizeof *m.triangles);
    m.triangle_capacity = source->triangle_count;
    status = remap && m.triangles ? weld(host, source, remap) : TAHR_E_MEMORY;
    if (status == TAHR_OK) status = clean(host, source, remap, m.triangles, &m.triangle_count);
    m.dropped = source->triangle_count - m.triangle_count;
    if (status == TAHR_OK && m.triangle_count == 0) {
        tahr__log_body(host, source->body, "no triangle of the mesh has an area");
        status = TAHR_E_GEOMETRY;
    }
    if (status == TAHR_OK) status = compact(host, source, remap, &m);
    tahr__room_put(host, remap, source->vertex_count, sizeof *remap);
    if (status == TAHR_OK) status = build_tree(host, &m);
    if (status == TAHR_OK) status = connect(host, &m);
    if (status == TAHR_OK)
        *mesh = m;
    else
        tahr__mesh_free(host, &m);
    return status;
}

void tahr__mesh_free(const tahr_host *host, tahr__mesh *mesh)
{
    tahr__room_put(host, mesh->vertices, mesh->vertex_capacity, sizeof *mesh->vertices);
    tahr__room_put(host, mesh->triangles, mesh->triangle_capacity, sizeof *mesh->triangles);
    tahr__wide_free(host, &mesh->tree);
    memset(mesh, 0, sizeof *mesh);
}

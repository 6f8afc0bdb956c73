/* SPDX-License-Identifier: MIT
 * level_file.c: levels from files, through Assimp. */
#include "level.h"
#include "level_io.h"
#include "say.h"
#include "vec.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A row-major affine map, in double so that deep node trees do not lose bits. */
typedef struct affine {
    double m[3][4];
} affine;

/* Everything that one file's triangles are gathered in. Vertices are welded by a hash table of their exact
 * coordinates. */
typedef struct gather {
    const struct aiScene *scene;
    const char *path;
    char up_axis;
    double *vertices;
    uint32_t *indices;
    size_t vertex_count, index_count, vertex_capacity, index_capacity;
    uint32_t *table; /* vertex + 1, or 0 */
    size_t table_size;
} gather;

/* The most vertices and indices that the 32-bit counts of a body description can hold. */
#define MAX_ITEMS 0xFFFFFF00u

/* Above any sensible scene graph; a deeper one would only overflow the stack. */
#define MAX_NODE_DEPTH 512

static affine affine_of_node(const affine *parent, const struct aiMatrix4x4 *t)
{
    const double own[4][4] = {{(double)t->a1, (double)t->a2, (double)t->a3, (double)t->a4},
                              {(double)t->b1, (double)t->b2, (double)t->b3, (double)t->b4},
                              {(double)t->c1, (double)t->c2, (double)t->c3, (double)t->c4},
                              {0, 0, 0, 1}};
    affine result;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            double sum = column == 3 ? parent->m[row][3] : 0;
            for (int k = 0; k < 3; k++) {
                sum += parent->m[row][k] * own[k][column];
            }
            result.m[row][column] = sum;
        }
    }
    return result;
}

static size_t hash_vertex(const double v[3])
{
    uint64_t hash = 14695981039346656037u; /* 64-bit FNV-1a over 8-byte words */
    for (int k = 0; k < 3; k++) {
        double x = v[k] + 0.0; /* -0 and 0 are the same place */
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
        hash ^= hash >> 29;
    }
    return (size_t)hash;
}

static void rebuild_table(gather *g)
{
    free(g->table);
    g->table_size = g->table_size ? g->table_size * 2 : 4096;
    g->table = memory_new(g->table_size, sizeof *g->table);
    for (size_t i = 0; i < g->vertex_count; i++) {
        size_t slot = hash_vertex(g->vertices + 3 * i) & (g->table_size - 1);
        while (g->table[slot] != 0) {
            slot = (slot + 1) & (g->table_size - 1);
        }
        g->table[slot] = (uint32_t)i + 1;
    }
}

static uint32_t weld_vertex(gather *g, const double v[3])
{
    if (2 * (g->vertex_count + 1) > g->table_size) {
        rebuild_table(g);
    }
    size_t slot = hash_vertex(v) & (g->table_size - 1);
    while (g->table[slot] != 0) {
        const double *known = g->vertices + 3 * (size_t)(g->table[slot] - 1);
        if (known[0] == v[0] && known[1] == v[1] && known[2] == v[2]) {
            return g->table[slot] - 1;
        }
        slot = (slot + 1) & (g->table_size - 1);
    }
    g->vertices = memory_grow(g->vertices, &g->vertex_capacity, 3 * (g->vertex_count + 1), sizeof *g->vertices);
    memcpy(g->vertices + 3 * g->vertex_count, v, 3 * sizeof *v);
    g->table[slot] = (uint32_t)++g->vertex_count;
    return g->table[slot] - 1;
}

/* Places one vertex of a mesh in the level. Turning Y up to Z up is a permutation with one sign, so no bit is lost. */
static int place_vertex(gather *g, const struct aiMesh *mesh, uint32_t index, const affine *map, uint32_t *placed)
{
    const struct aiVector3D *p = &mesh->mVertices[index];
    double world[3], turned[3];
    for (int row = 0; row < 3; row++) {
        const double *m = map->m[row];
        world[row] = m[0] * (double)p->x + m[1] * (double)p->y + m[2] * (double)p->z + m[3];
    }
    turned[0] = world[0];
    turned[1] = g->up_axis == 'y' ? -world[2] : world[1];
    turned[2] = g->up_axis == 'y' ? world[1] : world[2];
    for (int k = 0; k < 3; k++) {
        if (!(fabs(turned[k]) <= 1e7)) {
            say_error("%s: vertex %u of mesh '%s' is not finite or beyond 1e7 m", g->path, index, mesh->mName.data);
            return -1;
        }
    }
    *placed = weld_vertex(g, turned);
    return 0;
}

static int gather_mesh(gather *g, const struct aiMesh *mesh, const affine *map)
{
    for (unsigned f = 0; f < mesh->mNumFaces; f++) {
        const struct aiFace *face = &mesh->mFaces[f];
        if (face->mNumIndices != 3) {
            continue; /* points and lines block nobody */
        }
        if (g->index_count + 3 > MAX_ITEMS) {
            say_error("%s: more triangles than a body can hold", g->path);
            return -1;
        }
        g->indices = memory_grow(g->indices, &g->index_capacity, g->index_count + 3, sizeof *g->indices);
        for (int k = 0; k < 3; k++) {
            if (face->mIndices[k] >= mesh->mNumVertices) {
                say_error("%s: face %u of mesh '%s' names vertex %u of %u", g->path, f, mesh->mName.data,
                          face->mIndices[k], mesh->mNumVertices);
                return -1;
            }
            if (place_vertex(g, mesh, face->mIndices[k], map, &g->indices[g->index_count + (size_t)k]) != 0) {
                return -1;
            }
        }
        g->index_count += 3;
    }
    return 0;
}

static int gather_node(gather *g, const struct aiNode *node, const affine *parent, int depth)
{
    affine map = affine_of_node(parent, &node->mTransformation);
    if (depth > MAX_NODE_DEPTH) {
        say_error("%s: nodes are nested deeper than %d", g->path, MAX_NODE_DEPTH);
        return -1;
    }
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        if (gather_mesh(g, g->scene->mMeshes[node->mMeshes[i]], &map) != 0) {
            return -1;
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        if (gather_node(g, node->mChildren[i], &map, depth + 1) != 0) {
            return -1;
        }
    }
    return 0;
}

static const struct aiScene *import_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    int first = file != NULL ? fgetc(file) : EOF;
    if (file == NULL || ferror(file)) {
        say_error("cannot read level '%s': %s", path, strerror(errno));
    } else if (first == EOF) {
        say_error("level '%s' is empty", path);
    }
    if (file != NULL) {
        fclose(file);
    }
    if (first == EOF) {
        return NULL;
    }
    struct aiFileIO io = level_io();
    const struct aiScene *scene = aiImportFileEx(path, aiProcess_Triangulate | aiProcess_SortByPType, &io);
    if (scene == NULL || scene->mRootNode == NULL) {
        say_error("cannot load level '%s': %s", path, aiGetErrorString());
        aiReleaseImport(scene);
        return NULL;
    }
    return scene;
}

int level_load(struct level *level, const char *path, char up_axis)
{
    const affine identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    if (level_is_octree(path)) {
        return level_load_octree(level, path);
    }
    gather g = {.scene = import_file(path), .path = path, .up_axis = up_axis};
    *level = (struct level){0};
    if (g.scene == NULL) {
        return -1;
    }
    int failed = gather_node(&g, g.scene->mRootNode, &identity, 0);
    aiReleaseImport(g.scene);
    free(g.table);
    if (!failed && g.index_count == 0) {
        say_error("level '%s' holds no triangles", path);
        failed = -1;
    }
    if (failed) {
        free(g.vertices);
        free(g.indices);
        return -1;
    }
    const char *base = strrchr(path, '/');
    level->name = memory_text(base != NULL ? base + 1 : path);
    level_add_mesh(level, g.vertices, (uint32_t)g.vertex_count, g.indices, (uint32_t)(g.index_count / 3));
    return 0;
}

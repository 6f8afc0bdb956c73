/* SPDX-License-Identifier: MIT
 * level_octree.c: maps of voxels (.bt, .ot) as levels. Only the fcl backend holds them; it also reads them, and tells
 * the cells, whose faces the checker and the plot get. */
#include "level.h"

#include "say.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int level_is_octree(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && (strcmp(dot, ".bt") == 0 || strcmp(dot, ".ot") == 0);
}

#ifndef TAHR_HAVE_FCL
int level_load_octree(struct level *level, const char *path)
{
    *level = (struct level){0};
    say_error("cannot load level '%s': maps of voxels need the fcl backend, and this shell was built without it", path);
    return -1;
}

int level_options(const struct level *level, const struct backend_choice *backend, struct level_options *room,
                  const void **options)
{
    (void)level, (void)room;
    *options = backend->options;
    return 0;
}
#else

/* A cell by the index of its lowest corner, in the smallest cells that there are. */
struct cell {
    int32_t size, z, y, x;
};

struct cells {
    tahr_bounds *boxes;
    size_t count, capacity;
    double smallest; /* m */
    struct cell *sorted;
};

static void take_cell(void *user, uint32_t octree, const tahr_bounds *box)
{
    struct cells *cells = user;
    double size = box->max.x - box->min.x;
    (void)octree;
    cells->boxes = memory_grow(cells->boxes, &cells->capacity, cells->count + 1, sizeof *cells->boxes);
    cells->boxes[cells->count] = *box;
    if (cells->count++ == 0 || size < cells->smallest) {
        cells->smallest = size;
    }
}

static struct cell index_of(const struct cells *cells, const tahr_bounds *box)
{
    double s = cells->smallest;
    return (struct cell){(int32_t)lround((box->max.x - box->min.x) / s), (int32_t)lround(box->min.z / s),
                         (int32_t)lround(box->min.y / s), (int32_t)lround(box->min.x / s)};
}

static int compare(const void *left, const void *right)
{
    const struct cell *a = left, *b = right;
    if (a->size != b->size) {
        return a->size < b->size ? -1 : 1;
    }
    if (a->z != b->z) {
        return a->z < b->z ? -1 : 1;
    }
    if (a->y != b->y) {
        return a->y < b->y ? -1 : 1;
    }
    return a->x < b->x ? -1 : a->x > b->x;
}

/* Is there a cell of the same size behind this face? Faces are those of level_box_corners: -z, +z, -y, +y, -x, +x. */
static int is_covered(const struct cells *cells, struct cell cell, int face)
{
    int32_t step = face & 1 ? cell.size : -cell.size;
    cell.z += face / 2 == 0 ? step : 0;
    cell.y += face / 2 == 1 ? step : 0;
    cell.x += face / 2 == 2 ? step : 0;
    return bsearch(&cell, cells->sorted, cells->count, sizeof cell, compare) != NULL;
}

/* Faces between two cells of one size are inside; those between cells of different sizes stay, and nobody who keeps out
 * of the solid ever meets the part of them that is inside. */
static void add_faces(struct level *level, struct cells *cells)
{
    cells->sorted = memory_new(cells->count, sizeof *cells->sorted);
    for (size_t i = 0; i < cells->count; i++) {
        cells->sorted[i] = index_of(cells, &cells->boxes[i]);
    }
    qsort(cells->sorted, cells->count, sizeof *cells->sorted, compare);
    for (size_t i = 0; i < cells->count; i++) {
        const tahr_bounds *b = &cells->boxes[i];
        struct cell cell = index_of(cells, b);
        tahr_vec3 half = {(b->max.x - b->min.x) / 2, (b->max.y - b->min.y) / 2, (b->max.z - b->min.z) / 2};
        tahr_pose pose = {{b->min.x + half.x, b->min.y + half.y, b->min.z + half.z}, {0, 0, 0, 1}};
        tahr_vec3 corners[LEVEL_BOX_CORNERS];
        level_box_corners(&pose, half, corners);
        for (int face = 0; face < 6; face++) {
            if (!is_covered(cells, cell, face)) {
                level_add_triangle(level, &corners[6 * face]);
                level_add_triangle(level, &corners[6 * face + 3]);
            }
        }
    }
    free(cells->sorted);
}

int level_load_octree(struct level *level, const char *path)
{
    const tahr_log log = say_log();
    const char *base = strrchr(path, '/');
    struct cells cells = {0};
    tahr_fcl_octree octree = {.path = path};
    tahr_fcl_desc fcl = {
        .struct_size = sizeof fcl, .octree_count = 1, .octrees = &octree, .cell = take_cell, .cell_user = &cells};
    tahr_world_desc desc;
    tahr_world *world = NULL;
    *level = (struct level){0};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.log = &log;
    desc.options = &fcl;
    tahr_status status = tahr_world_open(tahr_backend_v1_fcl(), &desc, &world);
    tahr_world_close(world);
    if (status < 0) {
        say_error("cannot load level '%s': %s", path, tahr_status_message(status));
        free(cells.boxes);
        return -1;
    }
    add_faces(level, &cells);
    free(cells.boxes);
    level->name = memory_text(base != NULL ? base + 1 : path);
    level->octree = memory_text(path);
    return 0;
}

int level_options(const struct level *level, const struct backend_choice *backend, struct level_options *room,
                  const void **options)
{
    *options = backend->options;
    if (level->octree == NULL) {
        return 0;
    }
    if (backend->get != tahr_backend_v1_fcl) {
        say_error("level '%s' is a map of voxels, which backend '%s' does not hold: --backend fcl does", level->name,
                  backend->name);
        return -1;
    }
    room->octree = (tahr_fcl_octree){.path = level->octree};
    room->fcl = (tahr_fcl_desc){.struct_size = sizeof room->fcl, .octree_count = 1, .octrees = &room->octree};
    *options = &room->fcl;
    return 0;
}
#endif

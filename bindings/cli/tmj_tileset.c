/* SPDX-License-Identifier: MIT
 * tmj_tileset.c: tilesets, embedded or in a file of their own, and the collision shapes of their tiles. */
#include "say.h"
#include "tmj.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double count_range[2] = {0, 1e7};
static const double tile_range[2] = {1, 1e5};

static int read_shapes(struct tmj *tmj, const json_t *group, struct tmj_tile *tile)
{
    size_t before = tmj_enter(tmj, ".objectgroup");
    const json_t *objects = tmj_list(tmj, group, "objects");
    int failed = objects == NULL;
    tile->shapes = memory_new(json_array_size(objects), sizeof *tile->shapes);
    for (size_t i = 0; i < json_array_size(objects) && !failed; i++) {
        size_t here = tmj_enter(tmj, ".objects[%zu]", i);
        tile->shapes[tile->count].traits = tile->traits;
        failed = tmj_shape(tmj, json_array_get(objects, i), &tile->shapes[tile->count]);
        tile->count += !failed;
        tmj_leave(tmj, here);
    }
    tmj_leave(tmj, before);
    return failed;
}

/* Of a collection every tile is an image of its own size, and where one was taken out its number is free. */
static int read_image(struct tmj *tmj, const json_t *object, struct tmj_tileset *set, struct tmj_tile *tile)
{
    if (tmj_number(tmj, object, "imagewidth", tile_range, &tile->width) != 0 ||
        tmj_number(tmj, object, "imageheight", tile_range, &tile->height) != 0) {
        return -1;
    }
    set->count = tile->id < set->count ? set->count : tile->id + 1;
    return 0;
}

static int read_tile(struct tmj *tmj, const json_t *object, struct tmj_tileset *set)
{
    struct tmj_tile *tile = &set->tiles[set->tile_count++];
    int is_image = json_object_get(object, "image") != NULL;
    const double id_range[2] = {0, is_image ? count_range[1] : (double)set->count - 1};
    const json_t *group = json_object_get(object, "objectgroup");
    if (!json_is_object(object)) {
        return tmj_complain(tmj, "expected an object");
    }
    if (tmj_whole(tmj, object, "id", id_range, &tile->id) != 0 || tmj_traits(tmj, object, &tile->traits) != 0 ||
        (is_image && read_image(tmj, object, set, tile) != 0)) {
        return -1;
    }
    tile->traits.foreign = 0; /* a tile's class may be anything: its shapes are what counts */
    return group != NULL ? read_shapes(tmj, group, tile) : 0;
}

static int by_id(const void *left, const void *right)
{
    const struct tmj_tile *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

static int read_tiles(struct tmj *tmj, const json_t *object, struct tmj_tileset *set)
{
    if (json_object_get(object, "tiles") == NULL) {
        return 0;
    }
    const json_t *list = tmj_list(tmj, object, "tiles");
    int failed = list == NULL;
    set->tiles = memory_new(json_array_size(list), sizeof *set->tiles);
    for (size_t i = 0; i < json_array_size(list) && !failed; i++) {
        size_t before = tmj_enter(tmj, ".tiles[%zu]", i);
        failed = read_tile(tmj, json_array_get(list, i), set);
        tmj_leave(tmj, before);
    }
    if (set->tile_count > 0) {
        qsort(set->tiles, set->tile_count, sizeof *set->tiles, by_id);
    }
    return failed;
}

/* At which part of a tile an object holds it: Tiled's objectalignment. */
static int read_alignment(struct tmj *tmj, const json_t *object, struct tmj_tileset *set)
{
    static const struct {
        const char *name;
        double x, y;
    } places[] = {{"unspecified", 0, 1}, {"topleft", 0, 0},    {"top", 0.5, 0},   {"topright", 1, 0},
                  {"left", 0, 0.5},      {"center", 0.5, 0.5}, {"right", 1, 0.5}, {"bottomleft", 0, 1},
                  {"bottom", 0.5, 1},    {"bottomright", 1, 1}};
    const char *name = json_string_value(json_object_get(object, "objectalignment"));
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (strcmp(name != NULL ? name : "unspecified", places[i].name) == 0) {
            set->align_x = places[i].x;
            set->align_y = places[i].y;
            return 0;
        }
    }
    return tmj_complain(tmj, "objectalignment '%s': expected unspecified, center or a side or corner", name);
}

static int read_set(struct tmj *tmj, const json_t *object, struct tmj_tileset *set)
{
    const double offset_range[2] = {-1e5, 1e5};
    const json_t *offset = json_object_get(object, "tileoffset");
    if (tmj_whole(tmj, object, "tilecount", count_range, &set->count) != 0 ||
        tmj_number(tmj, object, "tilewidth", tile_range, &set->width) != 0 ||
        tmj_number(tmj, object, "tileheight", tile_range, &set->height) != 0) {
        return -1;
    }
    if (offset != NULL && (tmj_number(tmj, offset, "x", offset_range, &set->offset_x) != 0 ||
                           tmj_number(tmj, offset, "y", offset_range, &set->offset_y) != 0)) {
        return -1;
    }
    return read_alignment(tmj, object, set) != 0 ? -1 : read_tiles(tmj, object, set);
}

/* A tileset in a file of its own is named relative to the map. */
static int read_external(struct tmj *tmj, const char *source, struct tmj_tileset *set)
{
    const char *slash = tmj->path != NULL ? strrchr(tmj->path, '/') : NULL;
    size_t folder = slash != NULL && source[0] != '/' ? (size_t)(slash - tmj->path) + 1 : 0;
    size_t length = folder + strlen(source) + 1;
    char *path = memory_new(length, 1);
    snprintf(path, length, "%.*s%s", (int)folder, tmj->path, source);
    set->root = tmj_file(path, "tileset");
    int failed = set->root == NULL;
    if (!failed) {
        struct tmj inside = {.path = path};
        failed = read_set(&inside, set->root, set);
    }
    free(path);
    return failed ? -1 : 0;
}

int tmj_tilesets(struct tmj *tmj, const json_t *map)
{
    if (json_object_get(map, "tilesets") == NULL) {
        return 0;
    }
    const json_t *list = tmj_list(tmj, map, "tilesets");
    const double first_range[2] = {1, 0x0FFFFFFF};
    int failed = list == NULL;
    tmj->tilesets = memory_new(json_array_size(list), sizeof *tmj->tilesets);
    for (size_t i = 0; i < json_array_size(list) && !failed; i++) {
        struct tmj_tileset *set = &tmj->tilesets[tmj->tileset_count++];
        const json_t *object = json_array_get(list, i);
        const char *source = json_string_value(json_object_get(object, "source"));
        size_t before = tmj_enter(tmj, "tilesets[%zu]", i);
        failed = tmj_whole(tmj, object, "firstgid", first_range, &set->first) != 0 ||
                 (source != NULL ? read_external(tmj, source, set) : read_set(tmj, object, set)) != 0;
        tmj_leave(tmj, before);
    }
    return failed ? -1 : 0;
}

void tmj_tilesets_free(struct tmj *tmj)
{
    for (size_t i = 0; i < tmj->tileset_count; i++) {
        struct tmj_tileset *set = &tmj->tilesets[i];
        for (size_t k = 0; k < set->tile_count; k++) {
            for (size_t n = 0; n < set->tiles[k].count; n++) {
                tmj_shape_free(&set->tiles[k].shapes[n]);
            }
            free(set->tiles[k].shapes);
        }
        free(set->tiles);
        json_decref(set->root);
    }
    free(tmj->tilesets);
}

const struct tmj_tileset *tmj_tileset_of(struct tmj *tmj, uint32_t number)
{
    for (size_t i = 0; i < tmj->tileset_count; i++) {
        const struct tmj_tileset *set = &tmj->tilesets[i];
        if (number >= set->first && number - set->first < set->count) {
            return set;
        }
    }
    char known[160] = "0";
    for (size_t i = 0; i < tmj->tileset_count; i++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, ", %u to %u", tmj->tilesets[i].first,
                 tmj->tilesets[i].first + tmj->tilesets[i].count - 1);
    }
    tmj_complain(tmj, "tile %u is in no tileset; expected %s", number, known);
    return NULL;
}

static const struct tmj_tile *find_tile(const struct tmj_tileset *set, uint32_t id)
{
    const struct tmj_tile key = {.id = id};
    return set->tile_count > 0 ? bsearch(&key, set->tiles, set->tile_count, sizeof key, by_id) : NULL;
}

void tmj_tile_size(const struct tmj_tileset *set, uint32_t number, double *width, double *height)
{
    const struct tmj_tile *tile = find_tile(set, (number & TMJ_TILE) - set->first);
    *width = tile != NULL && tile->width > 0 ? tile->width : set->width;
    *height = tile != NULL && tile->height > 0 ? tile->height : set->height;
}

/* As Tiled turns a tile: along the diagonal first, then left and right, then up and down. */
static void flip(struct tmj_shape *shape, const struct tmj_tileset *set, uint32_t number)
{
    double width, height;
    tmj_tile_size(set, number, &width, &height);
    for (size_t i = 0; i < shape->count; i++) {
        struct outline_point p = shape->points[i];
        if (number & TMJ_FLIP_XY) {
            p = (struct outline_point){p.y, p.x};
        }
        p.x = number & TMJ_FLIP_X ? width - p.x : p.x;
        p.y = number & TMJ_FLIP_Y ? height - p.y : p.y;
        shape->points[i] = p;
    }
}

static struct tmj_shape whole_tile(const struct tmj_tileset *set, uint32_t number, const struct tmj_traits *traits)
{
    double width, height;
    tmj_tile_size(set, number, &width, &height);
    const struct outline_point corners[4] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    const struct tmj_shape shape = {
        .form = TMJ_POLYGON, .points = (struct outline_point *)corners, .count = 4, .traits = *traits};
    return tmj_shape_copy(&shape);
}

struct tmj_shape *tmj_tile_shapes(const struct tmj_tileset *set, uint32_t number, const struct tmj_traits *layer,
                                  size_t *count)
{
    const struct tmj_tile *tile = find_tile(set, (number & TMJ_TILE) - set->first);
    size_t own = tile != NULL ? tile->count : 0;
    struct tmj_traits traits = tile != NULL ? tile->traits : *layer;
    traits.kind = traits.kind == TMJ_PLAIN ? layer->kind : traits.kind;
    *count = 0;
    if (layer->kind == TMJ_DECORATION || (own == 0 && traits.kind == TMJ_PLAIN && traits.belt == 0)) {
        return NULL;
    }
    struct tmj_shape *shapes = memory_new(own + 1, sizeof *shapes);
    for (size_t i = 0; i < own; i++) {
        shapes[i] = tmj_shape_copy(&tile->shapes[i]);
        shapes[i].traits.foreign = 0;
        if (shapes[i].traits.kind == TMJ_PLAIN) {
            shapes[i].traits.kind = layer->kind;
        }
        flip(&shapes[i], set, number);
    }
    if (own == 0) {
        shapes[0] = whole_tile(set, number, &traits);
    }
    *count = own > 0 ? own : 1;
    return shapes;
}

/* SPDX-License-Identifier: MIT
 * tmj_layer.c: tile layers, object layers and groups of them. */
#include "say.h"
#include "tmj.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_GROUPS 32 /* inside each other */
#define MAX_TILES 4e6 /* of one layer or chunk */

static const double offset_range[2] = {-4e6, 4e6};

/* A layer under way: where it begins, and what it makes of its tiles and objects. */
struct layer {
    const json_t *json;
    double x, y; /* pixels */
    struct tmj_traits traits;
};

static int place_tile(struct tmj *tmj, const struct layer *layer, uint32_t number, int column, int row)
{
    const struct tmj_tileset *set = tmj_tileset_of(tmj, number & TMJ_TILE);
    size_t count = 0;
    double tile_width, tile_height;
    int failed = 0;
    if (set == NULL) {
        return -1;
    }
    tmj_tile_size(set, number, &tile_width, &tile_height);
    struct tmj_shape *shapes = tmj_tile_shapes(set, number, &layer->traits, &count);
    tmj->bare += shapes == NULL;
    for (size_t i = 0; i < count; i++) {
        /* A tile larger than the grid grows to the right and up. */
        tmj_shape_move(&shapes[i], layer->x + column * tmj->tile_width + set->offset_x,
                       layer->y + (row + 1) * tmj->tile_height - tile_height + set->offset_y);
        failed = failed || tmj_tile_piece(tmj, &shapes[i]) != 0;
        tmj_shape_free(&shapes[i]);
    }
    free(shapes);
    return failed ? -1 : 0;
}

/* A rectangle of tiles: a layer, or a chunk of an endless one, which is placed on the grid by x and y. */
static int read_grid(struct tmj *tmj, const struct layer *layer, const json_t *grid, int is_chunk)
{
    const double side_range[2] = {1, MAX_TILES}, place_range[2] = {-1e5, 1e5};
    uint32_t width = 0, height = 0;
    double x = 0, y = 0;
    if (tmj_whole(tmj, grid, "width", side_range, &width) != 0 ||
        tmj_whole(tmj, grid, "height", side_range, &height) != 0 ||
        (is_chunk &&
         (tmj_number(tmj, grid, "x", place_range, &x) != 0 || tmj_number(tmj, grid, "y", place_range, &y) != 0))) {
        return -1;
    }
    if (x != floor(x) || y != floor(y)) {
        return tmj_complain(tmj, "%s %g: expected a whole number", x != floor(x) ? "x" : "y", x != floor(x) ? x : y);
    }
    if ((double)width * height > MAX_TILES) {
        return tmj_complain(tmj, "%u by %u tiles: expected at most %g", width, height, MAX_TILES);
    }
    uint32_t *numbers = tmj_data(tmj, grid, layer->json, (size_t)width * height);
    int failed = numbers == NULL;
    for (size_t i = 0; !failed && i < (size_t)width * height; i++) {
        if ((numbers[i] & TMJ_TILE) != 0) {
            size_t before = tmj_enter(tmj, ".data[%zu]", i);
            failed = place_tile(tmj, layer, numbers[i], (int)x + (int)(i % width), (int)y + (int)(i / width)) != 0;
            tmj_leave(tmj, before);
        }
    }
    free(numbers);
    return failed ? -1 : 0;
}

static int read_tiles(struct tmj *tmj, const struct layer *layer)
{
    const json_t *chunks = json_object_get(layer->json, "chunks");
    int failed = 0;
    if (chunks == NULL) {
        return read_grid(tmj, layer, layer->json, 0);
    }
    if (tmj_list(tmj, layer->json, "chunks") == NULL) {
        return -1;
    }
    for (size_t i = 0; i < json_array_size(chunks) && !failed; i++) {
        size_t before = tmj_enter(tmj, ".chunks[%zu]", i);
        failed = read_grid(tmj, layer, json_array_get(chunks, i), 1);
        tmj_leave(tmj, before);
    }
    return failed;
}

/* An object that is a tile: the tile's shapes, stretched to its size, above its lower left corner (or where else the
 * tileset's alignment holds it). */
static int read_tile_object(struct tmj *tmj, const struct layer *layer, const json_t *object)
{
    const double number_range[2] = {1, 4294967295.0}, size_range[2] = {1e-3, 4e6}, turn_range[2] = {-1e6, 1e6};
    struct tmj_traits traits = layer->traits;
    double number = 0, x = 0, y = 0, width = 0, height = 0, degrees = 0;
    if (tmj_number(tmj, object, "gid", number_range, &number) != 0 ||
        tmj_number(tmj, object, "x", offset_range, &x) != 0 || tmj_number(tmj, object, "y", offset_range, &y) != 0 ||
        tmj_number(tmj, object, "width", size_range, &width) != 0 ||
        tmj_number(tmj, object, "height", size_range, &height) != 0 ||
        (json_object_get(object, "rotation") != NULL &&
         tmj_number(tmj, object, "rotation", turn_range, &degrees) != 0) ||
        tmj_traits(tmj, object, &traits) != 0) {
        return -1;
    }
    const struct tmj_tileset *set = tmj_tileset_of(tmj, (uint32_t)number & TMJ_TILE);
    size_t count = 0;
    if (set == NULL) {
        return -1;
    }
    double tile_width, tile_height;
    tmj_tile_size(set, (uint32_t)number, &tile_width, &tile_height);
    struct tmj_shape *shapes = tmj_tile_shapes(set, (uint32_t)number, &traits, &count);
    int failed = 0;
    for (size_t i = 0; i < count; i++) {
        if (traits.kind != TMJ_PLAIN) {
            shapes[i].traits.kind = traits.kind;
        }
        shapes[i].traits.mover |= traits.mover;
        if (traits.mover) {
            traits.kind = shapes[i].traits.kind;
            shapes[i].traits = traits;
        }
        tmj_shape_move(&shapes[i], set->offset_x - set->align_x * tile_width,
                       set->offset_y - set->align_y * tile_height);
        tmj_shape_scale(&shapes[i], width / tile_width, height / tile_height);
        tmj_shape_turn(&shapes[i], degrees);
        tmj_shape_move(&shapes[i], layer->x + x, layer->y + y);
        failed = failed || tmj_object_piece(tmj, &shapes[i]) != 0;
        tmj_shape_free(&shapes[i]);
    }
    free(shapes);
    return failed ? -1 : 0;
}

/* Enemies, lights and the like: whatever form they have, they are none of ours. Negative after a message. */
static int is_foreign(struct tmj *tmj, const json_t *object, const struct layer *layer)
{
    struct tmj_traits traits = layer->traits;
    if (!json_is_object(object) || json_object_get(object, "text") != NULL) {
        return 0;
    }
    if (tmj_traits(tmj, object, &traits) != 0) {
        return -1;
    }
    return traits.foreign && traits.kind == TMJ_PLAIN && !traits.mover && traits.belt == 0;
}

static int read_object(struct tmj *tmj, const struct layer *layer, const json_t *object)
{
    if (json_object_get(object, "gid") != NULL) {
        return read_tile_object(tmj, layer, object);
    }
    struct tmj_shape shape = {.traits = layer->traits};
    int foreign = is_foreign(tmj, object, layer);
    if (foreign != 0) {
        return foreign < 0 ? -1 : 0;
    }
    if (tmj_shape(tmj, object, &shape) != 0) {
        return -1;
    }
    tmj_shape_move(&shape, layer->x, layer->y);
    int failed = tmj_object_piece(tmj, &shape);
    tmj_shape_free(&shape);
    return failed;
}

static int read_objects(struct tmj *tmj, const struct layer *layer)
{
    const json_t *list = tmj_list(tmj, layer->json, "objects");
    int failed = list == NULL ? -1 : 0;
    for (size_t i = 0; i < json_array_size(list) && !failed; i++) {
        size_t before = tmj_enter(tmj, ".objects[%zu]", i);
        failed = read_object(tmj, layer, json_array_get(list, i));
        tmj_leave(tmj, before);
    }
    return failed;
}

static int read_layers(struct tmj *tmj, const json_t *list, const struct layer *parent, int depth);

static int read_layer(struct tmj *tmj, const json_t *json, const struct layer *parent, int depth)
{
    struct layer layer = {.json = json, .x = parent->x, .y = parent->y, .traits = parent->traits};
    const char *type = json_string_value(json_object_get(json, "type"));
    double x = 0, y = 0;
    if (type == NULL) {
        return tmj_complain(tmj, "expected a layer: an object with a type");
    }
    if ((json_object_get(json, "offsetx") != NULL && tmj_number(tmj, json, "offsetx", offset_range, &x) != 0) ||
        (json_object_get(json, "offsety") != NULL && tmj_number(tmj, json, "offsety", offset_range, &y) != 0)) {
        return -1;
    }
    json_t *own = json_copy((json_t *)(uintptr_t)json); /* without its type, which is no class of ours */
    json_object_del(own, "type");
    int failed = tmj_traits(tmj, own, &layer.traits);
    json_decref(own);
    layer.traits.foreign = 0;
    layer.x += x;
    layer.y += y;
    if (failed || layer.traits.kind == TMJ_DECORATION || strcmp(type, "imagelayer") == 0) {
        return failed;
    }
    if (strcmp(type, "tilelayer") == 0) {
        return read_tiles(tmj, &layer);
    }
    if (strcmp(type, "objectgroup") == 0) {
        return read_objects(tmj, &layer);
    }
    if (strcmp(type, "group") == 0) {
        return read_layers(tmj, json_object_get(json, "layers"), &layer, depth + 1);
    }
    return tmj_complain(tmj, "type '%s': expected tilelayer, objectgroup, imagelayer or group", type);
}

static int read_layers(struct tmj *tmj, const json_t *list, const struct layer *parent, int depth)
{
    int failed = 0;
    if (!json_is_array(list)) {
        return tmj_complain(tmj, "%slayers: expected a list", list == NULL ? "missing " : "");
    }
    if (depth > MAX_GROUPS) {
        return tmj_complain(tmj, "groups are nested deeper than %d", MAX_GROUPS);
    }
    for (size_t i = 0; i < json_array_size(list) && !failed; i++) {
        size_t before = tmj_enter(tmj, depth > 0 ? ".layers[%zu]" : "layers[%zu]", i);
        failed = read_layer(tmj, json_array_get(list, i), parent, depth);
        tmj_leave(tmj, before);
    }
    return failed;
}

int tmj_layers(struct tmj *tmj, const json_t *list)
{
    return read_layers(tmj, list, &(struct layer){0}, 0);
}

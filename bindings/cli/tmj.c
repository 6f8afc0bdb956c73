/* SPDX-License-Identifier: MIT
 * tmj.c: reads Tiled's JSON map format (doc.mapeditor.org: JSON Map Format, 1.0 to 1.11): orthogonal maps, bounded or
 * not. */
#include "tmj.h"

#include "levels.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>

static int check_map(struct tmj *tmj, const json_t *map)
{
    const char *type = json_string_value(json_object_get(map, "type"));
    const char *orientation = json_string_value(json_object_get(map, "orientation"));
    if (!json_is_object(map) || (type != NULL && strcmp(type, "map") != 0)) {
        return tmj_complain(tmj, "expected a map of Tiled: an object of type \"map\"");
    }
    if (orientation != NULL && strcmp(orientation, "orthogonal") != 0) {
        return tmj_complain(tmj, "orientation '%s': expected orthogonal", orientation);
    }
    if (json_object_get(map, "layers") == NULL) {
        return tmj_complain(tmj, "missing layers: expected a list");
    }
    return 0;
}

/* The row of pixels that is y = 0: the lower edge of the map; of an endless one, Tiled's own zero. */
static int read_size(struct tmj *tmj, const json_t *map, const struct side_options *options)
{
    const double tile_range[2] = {1, 1e5}, side_range[2] = {0, 1e5};
    uint32_t height = 0;
    int failed = 0;
    if (tmj_number(tmj, map, "tilewidth", tile_range, &tmj->tile_width) != 0 ||
        tmj_number(tmj, map, "tileheight", tile_range, &tmj->tile_height) != 0 ||
        tmj_whole(tmj, map, "height", side_range, &height) != 0) {
        return -1;
    }
    tmj->bottom = json_is_true(json_object_get(map, "infinite")) ? 0 : height * tmj->tile_height;
    double own = tmj_map_property(tmj, map, "pixels_per_metre", &failed);
    tmj->pixels_per_metre = options->pixels_per_metre > 0 ? options->pixels_per_metre
                            : own > 0                     ? own
                                                          : tmj->tile_height;
    return failed;
}

static int read_map(struct tmj *tmj, const json_t *map, const struct side_options *options)
{
    if (check_map(tmj, map) != 0 || read_size(tmj, map, options) != 0 || tmj_tilesets(tmj, map) != 0) {
        return -1;
    }
    int failed = tmj_layers(tmj, json_object_get(map, "layers"));
    tmj_join_tiles(tmj);
    if (!failed && tmj->shaped == 0) {
        failed = tmj->bare > 0
                     ? tmj_complain(tmj,
                                    "none of its %zu tiles has a collision shape; draw some in Tiled's collision "
                                    "editor, or give the tile or the layer the class \"solid\"",
                                    tmj->bare)
                     : tmj_complain(tmj, "holds nothing to stand on: neither tiles nor objects");
    }
    return failed;
}

int side_load(struct side *side, const char *path, const struct side_options *options)
{
    struct tmj tmj = {.path = path != NULL ? path : "side.tmj", .side = side, .separate = options->separate};
    json_t *map = path != NULL ? tmj_file(path, "level") : json_loads(level_text(LEVEL_SIDE), 0, NULL);
    *side = (struct side){0};
    if (map == NULL) {
        return -1;
    }
    int failed = read_map(&tmj, map, options);
    tmj_tilesets_free(&tmj);
    json_decref(map);
    if (failed) {
        side_free(side);
    }
    return failed;
}

/* SPDX-License-Identifier: MIT
 * tmj.h: the parts that read Tiled's JSON map format. Lengths are pixels, y down, until a piece is made of them. */
#ifndef TAHR_CLI_TMJ_H
#define TAHR_CLI_TMJ_H

#include "outline.h"
#include "side.h"

#include <jansson.h>

/* What a class or a custom property makes of a shape. PLAIN: none of them said anything. */
enum tmj_kind {
    TMJ_PLAIN,
    TMJ_SOLID,
    TMJ_ONE_WAY,
    TMJ_WATER,
    TMJ_SENSOR,
    TMJ_GOAL,
    TMJ_START,
    TMJ_DECORATION /* neither met nor drawn */
};

struct tmj_traits {
    enum tmj_kind kind;
    int foreign; /* has a class that is none of these */
    int mover;
    double belt;             /* m/s */
    double swing_x, swing_y; /* pixels, y down */
    double period, pause;    /* s */
};

enum tmj_form { TMJ_POLYGON, TMJ_LINE, TMJ_CIRCLE, TMJ_POINT, TMJ_TEXT };

struct tmj_shape {
    enum tmj_form form;
    struct outline_point *points; /* y down here */
    size_t count;
    double radius;
    struct tmj_traits traits;
    const char *name; /* in the JSON */
};

struct tmj_tile {
    uint32_t id;
    double width, height; /* its own, of a collection of images; 0: the tileset's */
    struct tmj_traits traits;
    struct tmj_shape *shapes;
    size_t count;
};

struct tmj_tileset {
    uint32_t first, count;
    double width, height, offset_x, offset_y;
    double align_x, align_y; /* the part of a tile at which objects hold it; y down */
    struct tmj_tile *tiles;  /* those that say something, by id */
    size_t tile_count;
    json_t *root; /* of an external one, or NULL */
};

/* A file under way. `where` is the place in it, as "layers[2].data[17]". */
struct tmj {
    const char *path;
    char where[256];
    size_t depth; /* length of where */
    struct side *side;
    double tile_width, tile_height;
    double pixels_per_metre;
    double bottom; /* the pixel row that is y = 0 */
    int separate;
    struct tmj_tileset *tilesets;
    size_t tileset_count;
    struct outline solids, planks, lines; /* of tiles: solid polygons, one-way polygons, one-way lines */
    struct outline_point *boxes;          /* of water: pairs of corners */
    size_t box_count, box_capacity;
    double belts[64]; /* speeds by tag */
    uint32_t belt_count;
    size_t shaped; /* tiles and objects that became something */
    size_t bare;   /* tiles without a collision shape */
};

/* tmj_json.c: strict access; every message names the file and the place. */
json_t *tmj_file(const char *path, const char *what);
int tmj_complain(const struct tmj *tmj, const char *format, ...);
size_t tmj_enter(struct tmj *tmj, const char *format, ...); /* returns what tmj_leave wants */
void tmj_leave(struct tmj *tmj, size_t before);
int tmj_number(struct tmj *tmj, const json_t *object, const char *key, const double range[2], double *value);
int tmj_whole(struct tmj *tmj, const json_t *object, const char *key, const double range[2], uint32_t *value);
const json_t *tmj_list(struct tmj *tmj, const json_t *object, const char *key); /* NULL after a message */
int tmj_traits(struct tmj *tmj, const json_t *object, struct tmj_traits *traits);
double tmj_map_property(struct tmj *tmj, const json_t *map, const char *name, int *failed);

/* tmj_shape.c */
int tmj_shape(struct tmj *tmj, const json_t *object, struct tmj_shape *shape);
void tmj_shape_free(struct tmj_shape *shape);
void tmj_shape_move(struct tmj_shape *shape, double x, double y);
void tmj_shape_scale(struct tmj_shape *shape, double x, double y);
void tmj_shape_turn(struct tmj_shape *shape, double degrees); /* clockwise as seen, about the origin */
struct tmj_shape tmj_shape_copy(const struct tmj_shape *shape);

/* tmj_tileset.c */
int tmj_tilesets(struct tmj *tmj, const json_t *map);
void tmj_tilesets_free(struct tmj *tmj);

/* The highest bits of a tile's number say how it is turned. */
#define TMJ_FLIP_X 0x80000000u
#define TMJ_FLIP_Y 0x40000000u
#define TMJ_FLIP_XY 0x20000000u
#define TMJ_FLIP_HEX 0x10000000u
#define TMJ_TILE (~(TMJ_FLIP_X | TMJ_FLIP_Y | TMJ_FLIP_XY | TMJ_FLIP_HEX))

/* The tileset of a number without flips, or NULL after a message. */
const struct tmj_tileset *tmj_tileset_of(struct tmj *tmj, uint32_t number);
/* In pixels: the tileset's, or of a collection of images the image's. */
void tmj_tile_size(const struct tmj_tileset *set, uint32_t number, double *width, double *height);
/* The shapes of a tile, or of a whole one where the traits make it something; a new list of *count, turned as the
 * number says, with (0, 0) its upper left corner. NULL: none. */
struct tmj_shape *tmj_tile_shapes(const struct tmj_tileset *set, uint32_t number, const struct tmj_traits *layer,
                                  size_t *count);

/* tmj_layer.c, tmj_data.c */
int tmj_layers(struct tmj *tmj, const json_t *list);
/* Numbers of a tile layer or chunk: `count` of them, to be freed; NULL after a message. */
uint32_t *tmj_data(struct tmj *tmj, const json_t *holder, const json_t *layer, size_t count);

/* tmj_piece.c: shapes become pieces. */
int tmj_tile_piece(struct tmj *tmj, struct tmj_shape *shape);
int tmj_object_piece(struct tmj *tmj, struct tmj_shape *shape);
void tmj_join_tiles(struct tmj *tmj);

#endif

/* SPDX-License-Identifier: MIT
 * side.h: a level of two dimensions, seen from the side: its pieces as they were drawn, before they become bodies. x to
 * the right, y up, m. */
#ifndef TAHR_CLI_SIDE_H
#define TAHR_CLI_SIDE_H

#include "level.h"

enum side_kind { SIDE_SOLID, SIDE_ONE_WAY, SIDE_WATER, SIDE_SENSOR, SIDE_GOAL };

/* LOOP: counter-clockwise if it is solid inside, clockwise round a hole. LINE: open; its front is on the right hand of
 * who goes along it. BOX: upright, points are its lower left and upper right corner. CIRCLE: one point and a radius. */
enum side_form { SIDE_LOOP, SIDE_LINE, SIDE_BOX, SIDE_CIRCLE };

struct side_point {
    double x, y;
};

struct side_piece {
    enum side_kind kind;
    enum side_form form;
    struct side_point *points;
    size_t count;
    double radius;
    double belt; /* m/s to the right, of its surface */
    int part;    /* of a closed outline in several lines: 1: the next piece goes on, 2: the last */
    int both;    /* a line that blocks from both sides */
    int moves;   /* a box that goes along swing and back */
    struct side_point swing;
    double period, pause; /* s, as of level_mover */
    char *name;           /* of a sensor or goal, or NULL */
    uint32_t body;        /* by side_build */
    double reached;       /* s, when somebody first came into a sensor or goal; -1: not yet */
};

struct side {
    struct side_piece *pieces;
    size_t count, capacity;
    struct side_point start; /* of the feet */
    int has_start;
    struct side_label {
        char *text;
        struct side_point at;
    } * labels;
    size_t label_count, label_capacity;
};

/* How far a level is drawn out along z for engines of three dimensions, to both sides, m. */
#define SIDE_DEPTH 4.0

/* What a .tmj is read with. */
struct side_options {
    double pixels_per_metre; /* 0: as the map says, or one tile */
    int separate;            /* 1: one body per tile */
};

/* Reads Tiled's JSON map format, or the bundled level where path is NULL. 0, or -1 after a message that names the file
 * and the place in it. */
int side_load(struct side *side, const char *path, const struct side_options *options);

/* The pieces as bodies: chains for a backend of two dimensions, ribbons along z for one of three; and what the checker
 * and the plot look at. The level owns the side from then on. */
void side_build(struct level *level, struct side *side, const char *name, int planar);

/* Says in a line what was drawn, how its tiles were taken (separate: as side_options) and what becomes of it. */
void side_describe(const struct side *side, int separate, int planar, const tahr_log *to);

/* Settings of a character on such a level: up is y, and it stays in the plane. */
void side_config(tahr_config *config);
tahr_shape side_shape(uint32_t type, const tahr_shape *like);

/* The centre of a character that stands at the level's start. */
tahr_vec3 side_start(const struct side *side, const tahr_config *config);

/* Whether a place is inside of something solid, which does not move. */
int side_is_solid(const struct side *side, double x, double y);

/* Whether a piece is watched: a sensor or a goal. */
int side_is_place(const struct side_piece *piece);

/* Somebody came into this body at this time. */
void side_reach(struct side *side, uint32_t body, double time);

/* The corners of a box, counter-clockwise from its lower left one. */
void side_corners(const struct side_piece *box, struct side_point corners[4]);

/* Adds a piece, of which the points are copied. */
struct side_piece *side_add(struct side *side, const struct side_piece *piece);
void side_free(struct side *side);

#endif

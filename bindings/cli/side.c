/* SPDX-License-Identifier: MIT
 * side.c: the pieces of a level of two dimensions, and the bodies made of them. */
#include "side.h"

#include "say.h"
#include "vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct side_piece *side_add(struct side *side, const struct side_piece *piece)
{
    side->pieces = memory_grow(side->pieces, &side->capacity, side->count + 1, sizeof *side->pieces);
    struct side_piece *own = &side->pieces[side->count++];
    *own = *piece;
    own->points = memory_new(piece->count, sizeof *own->points);
    memcpy(own->points, piece->points, piece->count * sizeof *own->points);
    own->name = piece->name != NULL ? memory_text(piece->name) : NULL;
    return own;
}

void side_free(struct side *side)
{
    for (size_t i = 0; i < side->count; i++) {
        free(side->pieces[i].points);
        free(side->pieces[i].name);
    }
    for (size_t i = 0; i < side->label_count; i++) {
        free(side->labels[i].text);
    }
    free(side->pieces);
    free(side->labels);
    *side = (struct side){0};
}

static tahr_vec3 in_plane(struct side_point p)
{
    return (tahr_vec3){p.x, p.y, 0};
}

static uint32_t flags_of(const struct side_piece *piece)
{
    switch (piece->kind) {
    case SIDE_ONE_WAY: return TAHR_BODY_ONE_WAY;
    case SIDE_WATER: return TAHR_BODY_FLUID;
    case SIDE_SENSOR:
    case SIDE_GOAL: return TAHR_BODY_SENSOR;
    default: return 0;
    }
}

static size_t segment_count(const struct side_piece *piece)
{
    return piece->form == SIDE_LINE ? piece->count - 1 : piece->form == SIDE_LOOP ? piece->count : 0;
}

/* A wall of two triangles per segment, whose front is on the right hand of who goes along it. */
static void add_ribbon(const struct side_piece *piece, tahr_body_desc *body)
{
    double *vertices = memory_new(6 * piece->count, sizeof *vertices);
    uint32_t *indices = memory_new(6 * segment_count(piece), sizeof *indices);
    for (size_t i = 0; i < piece->count; i++) {
        const double pair[6] = {piece->points[i].x, piece->points[i].y, -SIDE_DEPTH,
                                piece->points[i].x, piece->points[i].y, SIDE_DEPTH};
        memcpy(vertices + 6 * i, pair, sizeof pair);
    }
    for (size_t i = 0; i < segment_count(piece); i++) {
        uint32_t a = (uint32_t)(2 * i), b = (uint32_t)(2 * ((i + 1) % piece->count));
        const uint32_t two[6] = {a, b, b + 1, a, b + 1, a + 1};
        memcpy(indices + 6 * i, two, sizeof two);
    }
    body->vertices = vertices;
    body->indices = indices;
    body->vertex_count = (uint32_t)(2 * piece->count);
    body->triangle_count = (uint32_t)(2 * segment_count(piece));
}

static void add_chain(const struct side_piece *piece, tahr_body_desc *body)
{
    double *vertices = memory_new(3 * piece->count, sizeof *vertices);
    for (size_t i = 0; i < piece->count; i++) {
        vertices[3 * i] = piece->points[i].x;
        vertices[3 * i + 1] = piece->points[i].y;
    }
    body->vertices = vertices;
    body->vertex_count = (uint32_t)piece->count;
    body->flags |= piece->form == SIDE_LOOP ? (uint32_t)TAHR_BODY_LOOP : 0u;
}

static void add_body(struct level *level, const struct side_piece *piece, int planar)
{
    static const uint32_t types[] = {[SIDE_LOOP] = TAHR_BODY_CHAIN,
                                     [SIDE_LINE] = TAHR_BODY_CHAIN,
                                     [SIDE_BOX] = TAHR_BODY_BOX,
                                     [SIDE_CIRCLE] = TAHR_BODY_SPHERE};
    int ribbon = types[piece->form] == TAHR_BODY_CHAIN && !planar;
    tahr_body_desc *body = level_add_body(level, ribbon ? (uint32_t)TAHR_BODY_MESH : types[piece->form]);
    body->flags = flags_of(piece) | (piece->both ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u);
    body->surface_velocity.x = piece->belt;
    if (piece->form == SIDE_BOX) {
        struct side_point low = piece->points[0], high = piece->points[1];
        body->pose.position = (tahr_vec3){(low.x + high.x) / 2, (low.y + high.y) / 2, 0};
        body->half_extents = (tahr_vec3){(high.x - low.x) / 2, (high.y - low.y) / 2, SIDE_DEPTH};
    } else if (piece->form == SIDE_CIRCLE) {
        body->pose.position = in_plane(piece->points[0]);
        body->radius = piece->radius;
    } else if (ribbon) {
        add_ribbon(piece, body);
    } else {
        add_chain(piece, body);
    }
}

static void add_mover(struct level *level, const struct side_piece *piece)
{
    struct side_point low = piece->points[0], high = piece->points[1];
    level_add_mover(level,
                    &(struct level_mover){.half_extents = {(high.x - low.x) / 2, (high.y - low.y) / 2, SIDE_DEPTH},
                                          .center = {(low.x + high.x) / 2, (low.y + high.y) / 2, 0},
                                          .swing = in_plane(piece->swing),
                                          .period = piece->period,
                                          .pause = piece->pause,
                                          .one_way = piece->kind == SIDE_ONE_WAY});
    level->bodies[level->body_count - 1].surface_velocity.x = piece->belt;
}

/* What the checker looks at, independent of how bodies are made of it. */
static void add_surfaces(struct level *level, const struct side_piece *piece)
{
    if (piece->form == SIDE_CIRCLE) {
        level_add_round(level, in_plane(piece->points[0]), in_plane(piece->points[0]), piece->radius);
        return;
    }
    struct side_point corners[4];
    const struct side_point *points = piece->points;
    size_t count = piece->count;
    if (piece->form == SIDE_BOX) {
        side_corners(piece, corners);
        points = corners;
        count = 4;
    }
    for (size_t i = 0; i + (piece->form == SIDE_LINE) < count; i++) {
        tahr_vec3 a = in_plane(points[i]), b = in_plane(points[(i + 1) % count]);
        if (piece->kind == SIDE_SOLID) {
            level_add_wall(level, a, b);
        } else if (piece->kind == SIDE_ONE_WAY && b.x < a.x) { /* it looks up */
            level_add_thin(level, b, a);
        }
    }
}

void side_corners(const struct side_piece *box, struct side_point corners[4])
{
    corners[0] = box->points[0];
    corners[1] = (struct side_point){box->points[1].x, box->points[0].y};
    corners[2] = box->points[1];
    corners[3] = (struct side_point){box->points[0].x, box->points[1].y};
}

void side_config(tahr_config *config)
{
    config->gravity = (tahr_vec3){0, -vec_length(config->gravity), 0};
    config->plane = (tahr_vec3){0, 0, 1};
}

tahr_shape side_shape(uint32_t type, const tahr_shape *like)
{
    double radius = like->type == TAHR_SHAPE_BOX ? like->half_x : like->radius;
    switch (type) {
    case TAHR_SHAPE_BOX:
        return (tahr_shape){.type = type, .half_height = like->half_height, .half_x = radius, .half_y = radius};
    case TAHR_SHAPE_SPHERE: return (tahr_shape){.type = type, .radius = radius, .half_height = radius};
    default: return (tahr_shape){.type = type, .radius = radius, .half_height = like->half_height};
    }
}

tahr_vec3 side_start(const struct side *side, const tahr_config *config)
{
    double clearance = config->skin * config->floor_target;
    return (tahr_vec3){side->start.x, side->start.y + config->shape.half_height + clearance, 0};
}

/* How often the closed outlines that this piece is of, or a part of, go round a place: the crossings of a line from
 * there to the right, upward less downward. */
static int turns_round(const struct side_piece *piece, double x, double y)
{
    struct side_point corners[4];
    const struct side_point *points = piece->points;
    size_t count = piece->count;
    int turns = 0;
    if (piece->form == SIDE_CIRCLE) {
        double dx = x - points[0].x, dy = y - points[0].y;
        return dx * dx + dy * dy < piece->radius * piece->radius;
    }
    if (piece->form == SIDE_BOX) {
        side_corners(piece, corners);
        points = corners;
        count = 4;
    }
    for (size_t i = 0; i + (piece->form == SIDE_LINE) < count; i++) {
        struct side_point a = points[i], b = points[(i + 1) % count];
        double side = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
        turns += a.y <= y && b.y > y && side > 0;
        turns -= a.y > y && b.y <= y && side < 0;
    }
    return turns;
}

int side_is_solid(const struct side *side, double x, double y)
{
    int turns = 0;
    for (size_t i = 0; i < side->count; i++) {
        const struct side_piece *piece = &side->pieces[i];
        int closed = piece->form != SIDE_LINE || piece->part != 0;
        turns += piece->kind == SIDE_SOLID && !piece->moves && closed ? turns_round(piece, x, y) : 0;
    }
    return turns > 0;
}

int side_is_place(const struct side_piece *piece)
{
    return piece->kind == SIDE_SENSOR || piece->kind == SIDE_GOAL;
}

void side_reach(struct side *side, uint32_t body, double time)
{
    for (size_t i = 0; i < side->count; i++) {
        struct side_piece *piece = &side->pieces[i];
        if (side_is_place(piece) && piece->body == body && piece->reached < 0) {
            piece->reached = time;
        }
    }
}

void side_build(struct level *level, struct side *side, const char *name, int planar)
{
    *level = (struct level){.name = memory_text(name), .side = memory_new(1, sizeof *level->side)};
    *level->side = *side;
    *side = (struct side){0};
    for (size_t i = 0; i < level->side->count; i++) {
        struct side_piece *piece = &level->side->pieces[i];
        if (piece->moves) {
            add_mover(level, piece);
        } else {
            add_body(level, piece, planar);
            add_surfaces(level, piece);
        }
        piece->body = (uint32_t)level->body_count - 1;
        piece->reached = -1;
    }
}

void side_describe(const struct side *side, int separate, int planar, const tahr_log *to)
{
    size_t counts[SIDE_CIRCLE + 1] = {0};
    char text[256];
    for (size_t i = 0; i < side->count; i++) {
        counts[side->pieces[i].form]++;
    }
    snprintf(text, sizeof text,
             "two dimensions: %zu outlines, %zu lines, %zu boxes, %zu circles; tiles that meet: %s; path: %s",
             counts[SIDE_LOOP], counts[SIDE_LINE], counts[SIDE_BOX], counts[SIDE_CIRCLE],
             separate ? "a body each (--tiles separate)" : "one outline, without seams",
             planar ? "as drawn, the backend has two dimensions"
                    : "drawn out along z, the backend has three dimensions");
    to->write(to->user, TAHR_LOG_INFO, text);
}
